//! Validates shapes that are read from files of their own.

use crate::message;
use std::sync::Arc;

use super::Validator;
use super::shapes::{ShapeSource, shape_head};
use crate::import::{self, ImportError, MaterialSlots, Resolver, TriangleMesh};
use crate::map::SourceFile;
use crate::reflectance::Convention;
use crate::scene::Scene;
use crate::scene::document::Path;
use crate::scene::limits;
use crate::scene::problems::short;
use crate::scene::source::{MeshSource, RotationSource, SceneSource, ShadowSource, SpheresSource};
use crate::shape::{Geometry, Mesh, MeshData, MeshPlacing, Sphere, Spheres};
use crate::vector::Vector;

impl ShapeSource for MeshSource {
    shape_head!();

    fn is_from_file(&self) -> bool {
        true
    }

    fn geometry(&self, validator: &mut Validator<'_>, path: &Path) -> Option<Geometry> {
        let form = MeshForm::of(self);
        if let Some((_, geometry)) = validator.kept.meshes.iter().find(|(known, _)| *known == form) {
            let geometry = geometry.clone();
            validator.note_kept(self.file.as_deref());
            return Some(geometry);
        }
        let placing = validator.mesh_placing(path, self);
        let mesh = if self.vertices.is_some() || self.faces.is_some() || self.normals.is_some() {
            validator.mesh_of_arrays(path, self)?
        } else {
            validator.imported(path, self.file.as_deref(), import::read_mesh)?
        };
        let TriangleMesh { vertices, triangles, normals, materials, degenerate } = mesh;
        let (slots, materials) = validator.slots(path, materials, self.material.is_some())?;
        let normals = normals.filter(|_| self.smooth.unwrap_or(true));
        let data = MeshData { vertices, triangles, normals, slots, materials };
        match Mesh::new(data, &placing?) {
            Ok(mesh) => {
                let without_area = degenerate + mesh.left_out() as u64;
                if without_area > 0 {
                    let message = message!(
                        "{without_area} triangles of `{path}` have no area and were left out",
                        without_area,
                        path
                    );
                    validator.warn(&path.key("file"), message, message!("mend the file if they were meant to be seen"));
                }
                Some(Geometry::Mesh(Arc::new(mesh)))
            }
            Err(error) => {
                validator.wrong(
                    &path.key("file"),
                    message!("`{path}` is no mesh: {fault}", path, fault = error.message()),
                    message!("mend the file or the scale"),
                );
                None
            }
        }
    }
}

impl ShapeSource for SpheresSource {
    shape_head!();

    fn is_from_file(&self) -> bool {
        true
    }

    fn geometry(&self, validator: &mut Validator<'_>, path: &Path) -> Option<Geometry> {
        if let Some((_, geometry)) = validator.kept.clouds.iter().find(|(form, _)| *form == CloudForm::of(self)) {
            let geometry = geometry.clone();
            validator.note_kept(self.file.as_deref());
            return Some(geometry);
        }
        let list = validator.imported(path, self.file.as_deref(), import::read_spheres)?;
        let length = validator.length;
        let mut spheres = Vec::with_capacity(list.radii.len());
        for (center, radius) in list.centers.into_iter().zip(list.radii) {
            let center = Vector::from(center.map(|coordinate| length.to_metres(coordinate)));
            let radius = length.to_metres(radius);
            let is_near = center.to_array().iter().all(|coordinate| coordinate.abs() <= limits::COORDINATE);
            if !is_near || !(limits::SMALLEST..=limits::COORDINATE).contains(&radius) {
                let message = message!(
                    "sphere {number} of `{path}` is too far away, too small or too large",
                    number = spheres.len(),
                    path
                );
                let [least, most] =
                    [limits::SMALLEST, limits::COORDINATE].map(|bound| format!("{:e}", length.from_metres(bound)));
                let help = message!("allowed: radii from {least} to {most}, coordinates to {most}", least, most);
                validator.wrong(&path.key("file"), message, help);
                return None;
            }
            spheres.push(Sphere { center, radius });
        }
        let (slots, materials) = validator.slots(path, list.materials, self.material.is_some())?;
        // A slot without a material was rejected, since no other material is given.
        let materials = slots.into_iter().filter_map(|slot| materials[usize::from(slot)]).collect();
        Some(Geometry::Spheres(Arc::new(Spheres::new(spheres, materials))))
    }
}

/// Shapes that an earlier scene has read from files, with the source that they were read for.
#[derive(Default)]
pub(super) struct GeometryCache {
    meshes: Vec<(MeshForm, Geometry)>,
    clouds: Vec<(CloudForm, Geometry)>,
    files: Vec<SourceFile>,
}

/// The parts of a mesh's source that determine its geometry.
#[derive(PartialEq)]
struct MeshForm {
    file: Option<String>,
    vertices: Option<Vec<[f64; 3]>>,
    faces: Option<Vec<[u64; 3]>>,
    normals: Option<Vec<[f64; 3]>>,
    scale: [f64; 3],
    rotation: Option<RotationSource>,
    position: [f64; 3],
    is_smooth: bool,
    has_one_material: bool,
}

impl MeshForm {
    fn of(source: &MeshSource) -> Self {
        Self {
            file: source.file.clone(),
            vertices: source.vertices.clone(),
            faces: source.faces.clone(),
            normals: source.normals.clone(),
            scale: source.scale.unwrap_or([1.0; 3]),
            rotation: source.rotation,
            position: source.position.unwrap_or_default(),
            is_smooth: source.smooth.unwrap_or(true),
            has_one_material: source.material.is_some(),
        }
    }
}

/// The parts of a cloud's source that determine its geometry.
#[derive(PartialEq)]
struct CloudForm {
    file: Option<String>,
    has_one_material: bool,
}

impl CloudForm {
    fn of(source: &SpheresSource) -> Self {
        Self { file: source.file.clone(), has_one_material: source.material.is_some() }
    }
}

impl GeometryCache {
    /// The shapes that another scene would read in the same way.
    pub(super) fn of(earlier: &Scene, source: &SceneSource) -> Self {
        let before = &earlier.source;
        let uses_material = source.convention.unwrap_or(Convention::Radiance).uses_material();
        let is_alike = before.origin.is_same_place(&source.origin)
            && before.length == source.length
            && before.material.keys().eq(source.material.keys())
            && earlier.convention.uses_material() == uses_material;
        if !is_alike {
            return Self::default();
        }
        let geometries = || earlier.shapes.iter().map(|shape| shape.geometry.clone());
        let meshes = geometries().filter(|geometry| matches!(geometry, Geometry::Mesh(_)));
        let clouds = geometries().filter(|geometry| matches!(geometry, Geometry::Spheres(_)));
        // Shapes of one kind are in the order of the file.
        Self {
            meshes: before.mesh.iter().map(MeshForm::of).zip(meshes).collect(),
            clouds: before.spheres.iter().map(CloudForm::of).zip(clouds).collect(),
            files: earlier.files.clone(),
        }
    }
}

impl Validator<'_> {
    /// Notes a file whose content an earlier scene has read.
    fn note_kept(&self, file: Option<&str>) {
        for file in self.kept.files.iter().filter(|known| Some(known.name.as_str()) == file) {
            self.files.note(file.clone());
        }
    }

    /// The contents of a file; relative paths start at the scene file.
    fn imported<T>(
        &mut self,
        path: &Path,
        file: Option<&str>,
        read: impl FnOnce(&dyn Resolver, &str) -> Result<T, ImportError>,
    ) -> Option<T> {
        let Some(file) = file else {
            self.problems.missing(path, "file", message!("write `file = \"…\"`, a path that starts at the scene file"));
            return None;
        };
        match read(&self.files, file) {
            Ok(content) => Some(content),
            Err(error) => {
                let help = match &error {
                    ImportError::Unread { failure, .. } => failure.help(),
                    ImportError::Suffix { .. } => message!("the suffix says how the file is read"),
                    ImportError::Content { .. } => message!("mend the file, or name another one"),
                };
                self.wrong(&path.key("file"), error.message(), help);
                None
            }
        }
    }

    /// A mesh that is written out.
    fn mesh_of_arrays(&mut self, path: &Path, mesh: &MeshSource) -> Option<TriangleMesh> {
        if mesh.file.is_some() {
            let message = message!("`{path}` has a `file`, and `vertices`, `faces` or `normals` too", path);
            self.wrong(&path.key("file"), message, message!("allowed: a file, or the mesh itself"));
            return None;
        }
        if mesh.vertices.is_none() {
            self.problems.missing(
                path,
                "vertices",
                message!("write `vertices = [[x, y, z], …]`, the points of the mesh"),
            );
        }
        if mesh.faces.is_none() {
            self.problems.missing(
                path,
                "faces",
                message!("write `faces = [[0, 1, 2], …]`, the corners of each triangle"),
            );
        }
        let (vertices, faces) = (mesh.vertices.as_ref()?, mesh.faces.as_ref()?);
        if let Some(normals) = &mesh.normals
            && normals.len() != vertices.len()
        {
            let message = message!(
                "`{path}` has {normals} normals for {vertices} vertices",
                path,
                normals = normals.len(),
                vertices = vertices.len()
            );
            self.wrong(&path.key("normals"), message, message!("allowed: one for each vertex"));
            return None;
        }
        match import::mesh_from_arrays(vertices, faces, mesh.normals.as_deref()) {
            Ok(mesh) => Some(mesh),
            Err(fault) => {
                self.wrong(
                    &path.key("faces"),
                    message!("`{path}` is no mesh: {fault}", path, fault = fault.message()),
                    message!("mend its arrays"),
                );
                None
            }
        }
    }

    /// The slot of each part and the scene's material of each slot; both empty if one material is given for all.
    fn slots(
        &mut self,
        path: &Path,
        written: Option<MaterialSlots>,
        has_one_for_all: bool,
    ) -> Option<(Vec<u16>, Vec<Option<u32>>)> {
        let Some(MaterialSlots { names, slots }) =
            written.filter(|_| !has_one_for_all && self.convention.uses_material())
        else {
            return Some((Vec::new(), Vec::new()));
        };
        let mut materials = Vec::with_capacity(names.len());
        for name in names {
            let index = name.as_ref().and_then(|name| self.materials.get(name).copied());
            if index.is_none() {
                let message = match &name {
                    Some(name) => {
                        message!(
                            "the file names the material \"{name}\", which the scene does not have",
                            name = short(name)
                        )
                    }
                    None => message!("the file names a material for some of its parts only"),
                };
                let help = message!("write a table [material.NAME] for it, or `{path}.material` for all parts", path);
                self.wrong(&path.key("file"), message, help);
                return None;
            }
            materials.push(index.and_then(|index| u32::try_from(index).ok()));
        }
        Some((slots, materials))
    }

    fn mesh_placing(&mut self, path: &Path, mesh: &MeshSource) -> Option<MeshPlacing> {
        let factors = mesh.scale.unwrap_or([1.0; 3]);
        let mut all_allowed = true;
        for (index, factor) in factors.into_iter().enumerate() {
            if !limits::SCALE.contains(&factor) {
                let place = path.key("scale").index(index);
                let help = message!(
                    "allowed: {least} to {most}",
                    least = format!("{:e}", limits::SCALE.start()),
                    most = format!("{:e}", limits::SCALE.end())
                );
                self.wrong(&place, message!("`{path}` is {value}", path = place, value = factor), help);
                all_allowed = false;
            }
        }
        let rotation = self.rotation(path, mesh.rotation);
        let position = self.point(&path.key("position"), mesh.position.unwrap_or_default());
        let scale = Vector::from(factors.map(|factor| self.length.to_metres(factor)));
        all_allowed.then_some(MeshPlacing { scale, rotation: rotation?, position: position? })
    }
}
