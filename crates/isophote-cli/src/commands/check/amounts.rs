//! The quantities of a scene that have one value per colour component.

use isophote::light::{Light, LightKind};
use isophote::scene::{Lighting, Scene};

/// I₀ of a point light, E₀ of a parallel one.
pub(super) fn intensity_of(light: &Light) -> f64 {
    match &light.kind {
        LightKind::Point(point) => point.intensity,
        LightKind::Parallel(parallel) => parallel.irradiance,
    }
}

pub(super) fn power_of(light: &Light) -> f64 {
    match &light.kind {
        LightKind::Point(point) => point.power(),
        LightKind::Parallel(_) => 0.0,
    }
}

/// L_a, 0 where there is no ambient light.
pub(super) fn radiance_of(lighting: &Lighting) -> f64 {
    lighting.ambient.map_or(0.0, |ambient| ambient.radiance)
}

/// An amount per component if they differ, otherwise the single number.
pub(super) fn components(scene: &Scene, of: impl Fn(&Lighting) -> f64, one: f64) -> Result<[f64; 3], f64> {
    let Some(color) = scene.color() else { return Err(one) };
    let amounts = color.lighting.map(of);
    if amounts.is_even() { Err(amounts.red) } else { Ok(amounts.into_array()) }
}
