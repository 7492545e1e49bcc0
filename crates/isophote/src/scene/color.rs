//! The parts that a scene with colours has three of.

use super::Material;
use crate::color::{ColorSpace, Rgb};
use crate::light::{Ambient, Light};

/// The parts that a scene with colours has three of.
#[derive(Clone, Debug)]
pub struct SceneColor {
    /// The colour space whose primaries the components are amounts of.
    pub space: ColorSpace,
    /// The materials and lights of each component.
    pub lighting: Rgb<Lighting>,
}

/// The parts that depend on the component: names, positions and the order of lights and materials are the scene's.
#[derive(Clone, Debug)]
pub struct Lighting {
    /// The materials.
    pub materials: Vec<Material>,
    /// The lights.
    pub lights: Vec<Light>,
    /// The ambient light.
    pub ambient: Option<Ambient>,
}
