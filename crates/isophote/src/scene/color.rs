//! What a scene with colours has three of.

use super::Material;
use crate::color::{ColorSpace, Rgb};
use crate::light::{Ambient, Light};

/// What a coloured scene has three of.
#[derive(Clone, Debug)]
pub struct SceneColor {
    /// Which primaries the components are amounts of.
    pub space: ColorSpace,
    /// The materials and lights of each component.
    pub lighting: Rgb<Lighting>,
}

/// What depends on the component: names, places and the order of lights and materials are the scene's.
#[derive(Clone, Debug)]
pub struct Lighting {
    /// The materials.
    pub materials: Vec<Material>,
    /// The lights.
    pub lights: Vec<Light>,
    /// The light from all around.
    pub ambient: Option<Ambient>,
}
