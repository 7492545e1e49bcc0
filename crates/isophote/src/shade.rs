//! The formula: from light to brightness (3.1) to (3.6). It stands here once, for every number type.

use crate::light::Light;
use crate::real::{Real, Sum};
use crate::reflectance::BrightnessFormula;
use crate::shape::SurfacePoint;
use crate::vector::Vector;

/// What a surface point sends to the eye, summed over all lights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shading<T = f64> {
    /// E = Σ E_j (3.1), W/m² or lx.
    pub irradiance: T,
    /// The diffuse part of B, in the convention's unit.
    pub diffuse: T,
    /// The specular part of B, in the convention's unit.
    pub specular: T,
}

impl<T: Real> Shading<T> {
    /// B, in the convention's unit.
    #[must_use]
    #[inline(always)]
    pub fn brightness(&self) -> T {
        self.diffuse + self.specular
    }
}

/// Sums the brightness of a surface point over the lights, in their order.
///
/// `visibility(j)` is v_j of (3.1): 1, or 0 in shadow. `each(j, term)` sees every light's own term.
#[inline(always)]
pub fn shade<T: Real>(
    point: &SurfacePoint<T>,
    lights: &[Light],
    formula: &BrightnessFormula,
    visibility: impl Fn(usize) -> T,
    mut each: impl FnMut(usize, &LightTerm<T>),
) -> Shading<T> {
    let (mut irradiance, mut diffuse, mut specular) = (Sum::new(), Sum::new(), Sum::new());
    for (index, light) in lights.iter().enumerate() {
        let term = light_term(point, light, formula, visibility(index));
        irradiance.add(term.irradiance);
        diffuse.add(term.diffuse);
        specular.add(term.specular);
        each(index, &term);
    }
    Shading { irradiance: irradiance.value(), diffuse: diffuse.value(), specular: specular.value() }
}

/// One light's term of the sum, with the steps that lead to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightTerm<T = f64> {
    /// v_j.
    pub visibility: T,
    /// L_j, the unit vector to the light.
    pub direction: Vector<T>,
    /// r_j, in metres.
    pub distance: T,
    /// I_j(ω) towards the point, W/sr or cd.
    pub intensity: T,
    /// cosθ_i = max(0, N·L_j).
    pub cos_theta_i: T,
    /// L_j + V, not normalised: H_j is its direction.
    pub half: Vector<T>,
    /// cos²θ_h = (N·H_j)².
    pub cos_squared_theta_h: T,
    /// sin²θ_h.
    pub sin_squared_theta_h: T,
    /// E_j (3.1), W/m² or lx.
    pub irradiance: T,
    /// E_j times the diffuse factor of the convention.
    pub diffuse: T,
    /// E_j times the specular factor of the convention.
    pub specular: T,
}

/// E_j = v_j I_j cosθ_i / r_j² (3.1) and its share of the brightness (3.2) to (3.6).
#[inline(always)]
pub fn light_term<T: Real>(
    point: &SurfacePoint<T>,
    light: &Light,
    formula: &BrightnessFormula,
    visibility: T,
) -> LightTerm<T> {
    let to_light = (Vector::from_f64(light.position) - point.anchor) - point.offset;
    let distance_squared = to_light.dot(to_light);
    let distance = distance_squared.sqrt();
    let direction = to_light * (T::from_f64(1.0) / distance);
    let intensity = light.intensity_towards(-direction);
    let cos_theta_i = point.normal.dot(direction).max(T::zero());
    let irradiance = visibility * intensity * cos_theta_i / distance_squared;

    // H is never normalised. It has no length only when the light stands straight behind the surface: then
    // cosθ_i or cosθ_o is zero, and with it the term; the guard keeps 0/0 out of it.
    let half = direction + point.view;
    let length_squared = half.dot(half).max(T::from_f64(f64::MIN_POSITIVE));
    let along_normal = point.normal.dot(half).max(T::zero());
    let across_normal = point.normal.cross(half);
    let cos_squared_theta_h = along_normal * along_normal / length_squared;
    let sin_squared_theta_h = across_normal.dot(across_normal) / length_squared;

    let specular = formula.specular_factor(point.cos_theta_o, cos_squared_theta_h, sin_squared_theta_h);
    LightTerm {
        visibility,
        direction,
        distance,
        intensity,
        cos_theta_i,
        half,
        cos_squared_theta_h,
        sin_squared_theta_h,
        irradiance,
        diffuse: irradiance * formula.diffuse_factor(point.cos_theta_o),
        specular: irradiance * specular,
    }
}
