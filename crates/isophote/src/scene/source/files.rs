//! Shapes that are read from files of their own, as they are written.

use super::declare::tables;
use super::{RotationSource, ShadowSource};
use crate::scene::limits;

tables! {
    /// A mesh of triangles.
    #[serde(deny_unknown_fields)]
    pub struct MeshSource {
        /// A name of its own; by default `mesh[0]`, `mesh[1]` and so on.
        pub name: Option<String>,
        /// An OBJ, PLY, STL or binary glTF file; a relative path starts at the scene file. Either this or `vertices` and
        /// `faces`.
        pub file: Option<String>,
        /// The points of the mesh itself, instead of a file.
        pub vertices: Option<Vec<[f64; 3]>>,
        /// The three corners of each triangle: which of the `vertices`, counted from 0; counter-clockwise as seen from outside.
        pub faces: Option<Vec<[u64; 3]>>,
        /// A direction at each of the `vertices`, for smooth shading.
        pub normals: Option<Vec<[f64; 3]>>,
        /// Factors along the file's own axes, in the scene's unit of length per unit of the file.
        #[schemars(inner(range(min = *limits::SCALE.start(), max = *limits::SCALE.end())), extend("default" = [1, 1, 1]))]
        pub scale: Option<[f64; 3]>,
        /// How it is turned about its origin.
        pub rotation: Option<RotationSource>,
        /// Where its origin goes.
        #[schemars(extend("default" = [0, 0, 0]))]
        pub position: Option<[f64; 3]>,
        /// Whether the file's directions at the corners, if it has any, make it look smooth.
        #[schemars(extend("default" = true))]
        pub smooth: Option<bool>,
        /// Name of the material of all triangles. Without it the file's own names of materials are looked for in the scene.
        pub material: Option<String>,
        /// What it has to do with shadows.
        #[serde(flatten)]
        pub shadow: ShadowSource,
    }

    /// Many spheres.
    #[serde(deny_unknown_fields)]
    pub struct SpheresSource {
        /// A name of its own; by default `spheres[0]`, `spheres[1]` and so on.
        pub name: Option<String>,
        /// A CSV, NPY or PLY file of centres and radii, in the scene's unit of length; a relative path starts at the scene
        /// file.
        #[schemars(required)]
        pub file: Option<String>,
        /// Name of the material of all spheres. Without it the file's own names of materials are looked for in the scene.
        pub material: Option<String>,
        /// What they have to do with shadows.
        #[serde(flatten)]
        pub shadow: ShadowSource,
    }
}
