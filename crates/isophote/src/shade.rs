//! The brightness formulas (3.1) to (3.12), implemented once for every number type.

use crate::color::Rgb;
use crate::light::{Emitter, PlacedEmitter};
use crate::real::Real;
use crate::reflectance::{BrightnessFormula, Lobe};
use crate::scalar::Scalar;
use crate::shape::SurfacePoint;
use crate::sum::Sum;
use crate::vector::Vector;

/// The light that a surface point sends to the eye, summed over all lights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shading<T = f64> {
    /// E = Σ E_j + E_a (3.1), (3.9), W/m² or lx.
    pub irradiance: T,
    /// The ambient part of E (3.9), W/m² or lx.
    pub ambient: T,
    /// The diffuse part of B, in the convention's unit.
    pub diffuse: T,
    /// The specular part of B, in the convention's unit.
    pub specular: T,
}

impl<T: Real> Shading<T> {
    /// The brightness that a formula gives for E (ambient light included) and Σ E_j (N·H_j)ⁿ.
    #[inline(always)]
    pub fn new(irradiance: T, lobes: T, ambient: T, formula: &BrightnessFormula, cos_theta_o: T) -> Self {
        let (diffuse, specular) = (formula.diffuse_factor(cos_theta_o), formula.specular_factor(cos_theta_o));
        Self { irradiance, ambient, diffuse: irradiance * diffuse, specular: lobes * specular }
    }

    /// B, in the convention's unit.
    #[must_use]
    #[inline(always)]
    pub fn brightness(&self) -> T {
        self.diffuse + self.specular
    }
}

impl Shading {
    /// The shading of a scene with colours, from the shadings of its components: every number is their luminance (3.10).
    #[must_use]
    pub fn luminance(components: &Rgb<Self>, weights: Rgb) -> Self {
        let of = |number: fn(&Self) -> f64| components.map(number).weighted_by(weights);
        Self {
            irradiance: of(|shading| shading.irradiance),
            ambient: of(|shading| shading.ambient),
            diffuse: of(|shading| shading.diffuse),
            specular: of(|shading| shading.specular),
        }
    }
}

/// Sums the brightness of a surface point over the emitters, in order.
///
/// `visibility(k)` is v of (3.1) for emitter k: 1, or 0 in shadow, or the visible fraction. `ambient` is E_a of (3.9).
/// `each(j, term)` is called with every emitter's term and the index of its light.
#[inline(always)]
pub fn shade<T: Scalar>(
    point: &SurfacePoint<T>,
    emitters: &[Emitter],
    formula: &BrightnessFormula,
    ambient: T,
    visibility: impl Fn(usize) -> T,
    mut each: impl FnMut(usize, &LightTerm<T>),
) -> Shading<T> {
    let (mut irradiance, mut lobes) = (Sum::new(), Sum::new());
    let lobe = formula.lobe();
    for (index, emitter) in emitters.iter().enumerate() {
        let term = light_term(point, &emitter.seen_from(point.anchor), visibility(index), &lobe);
        irradiance.add(term.irradiance);
        lobes.add(term.lobe_irradiance * term.lobe);
        each(emitter.light, &term);
    }
    irradiance.add(ambient);
    Shading::new(irradiance.value(), lobes.value(), ambient, formula, point.cos_theta_o)
}

/// The irradiances of selected lights, accumulated from the terms that [`shade`] visits.
#[derive(Clone, Debug, PartialEq)]
pub struct ByLight(Vec<(usize, f64)>);

impl ByLight {
    /// Selects the lights with these indices; all irradiances start at 0.
    pub fn of(lights: impl IntoIterator<Item = usize>) -> Self {
        Self(lights.into_iter().map(|light| (light, 0.0)).collect())
    }

    /// Adds a term if its light is selected.
    pub fn take(&mut self, light: usize, term: &LightTerm) {
        for (_, irradiance) in self.0.iter_mut().filter(|(wanted, _)| *wanted == light) {
            *irradiance += term.irradiance;
        }
    }

    /// The irradiances of all selected lights, in W/m² or lx.
    pub fn irradiances(&self) -> impl Iterator<Item = f64> {
        self.0.iter().map(|(_, irradiance)| *irradiance)
    }

    /// E_j of a light, in W/m² or lx; 0 if the light is not selected.
    #[must_use]
    pub fn irradiance(&self, light: usize) -> f64 {
        self.0.iter().find(|(wanted, _)| *wanted == light).map_or(0.0, |(_, irradiance)| *irradiance)
    }
}

/// One emitter's (or light's) term of the sum, with the intermediate results.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightTerm<T = f64> {
    /// v_j.
    pub visibility: T,
    /// L_j, the unit vector to the light.
    pub direction: Vector<T>,
    /// r_j, in metres; 1 for a parallel light, which has no distance.
    pub distance: T,
    /// I_j(ω) towards the point, W/sr or cd; E₀ of a parallel light, W/m² or lx.
    pub intensity: T,
    /// cosθ_i = max(0, N·L_j).
    pub cos_theta_i: T,
    /// L_j + V, not normalised: H_j is its direction.
    pub half: Vector<T>,
    /// cosθ_h = N·H_j, 0 where it is negative.
    pub cos_theta_h: T,
    /// E_j (3.1), W/m² or lx.
    pub irradiance: T,
    /// What the lobe is multiplied by: E_j, or v_j I_j/r_j² where cosθ_i > 0 in (3.11) and (3.12), W/m² or lx.
    pub lobe_irradiance: T,
    /// (N·H_j)ⁿ; 0 where the formula has no highlight.
    pub lobe: T,
}

impl LightTerm {
    /// Adds the term of another emitter of the same light. Directions and cosines stay those of the first one.
    pub fn add(&mut self, other: &Self) {
        let (before, intensity) = (self.lobe_irradiance * self.lobe, self.intensity + other.intensity);
        self.irradiance += other.irradiance;
        self.lobe_irradiance += other.lobe_irradiance;
        if self.lobe_irradiance > 0.0 {
            self.lobe = (before + other.lobe_irradiance * other.lobe) / self.lobe_irradiance;
        }
        if intensity > 0.0 {
            self.visibility = (self.visibility * self.intensity + other.visibility * other.intensity) / intensity;
        }
        self.intensity = intensity;
    }
}

impl<T: Real> LightTerm<T> {
    /// This light's share of the diffuse part of B, in the convention's unit.
    pub fn diffuse(&self, formula: &BrightnessFormula, point: &SurfacePoint<T>) -> T {
        self.irradiance * formula.diffuse_factor(point.cos_theta_o)
    }

    /// This light's share of the specular part of B, in the convention's unit.
    pub fn specular(&self, formula: &BrightnessFormula, point: &SurfacePoint<T>) -> T {
        self.lobe_irradiance * self.lobe * formula.specular_factor(point.cos_theta_o)
    }
}

/// E_j = v_j I_j cosθ_i / r_j² (3.1) or v_j E₀ cosθ_i (3.8), and the lobe (N·H_j)ⁿ of (3.3) to (3.6), (3.11) and (3.12).
///
/// Neither L nor H is normalised. r H is split into its component along N, (cosθ_i + cosθ_o) r, and the component across;
/// the squares of the two are in the ratio of cos²θ_h to sin²θ_h. Each component stays accurate where the other one is
/// small. Divisions are combined: a single one by r³ for the irradiance, and by the sum of the squares for the lobe.
///
/// (Fields of the term that the sums do not use cost nothing: the compiler removes them.)
#[inline(always)]
pub fn light_term<T: Real>(
    point: &SurfacePoint<T>,
    emitter: &PlacedEmitter<T>,
    visibility: T,
    lobe: &impl Lobe<T>,
) -> LightTerm<T> {
    let to_light = emitter.from_point(point.offset);
    let distance_squared = to_light.dot(to_light);
    let distance = distance_squared.sqrt();
    let along = point.normal.dot(to_light);
    let along_lit = along.max_zero();

    let view_across = point.normal.mul_add(-point.cos_theta_o, point.view);
    let half_across = point.normal.mul_add(-along, view_across.mul_add(distance, to_light));
    let sin_squared = half_across.dot(half_across);

    // H has zero length only when the light is straight behind the surface, where nothing is visible or nothing is lit. To
    // avoid 0/0 there, the sum of the squares is that of the nearest lit and visible place.
    let least = distance.splat_like(T::NEGLIGIBLE_SQUARE.sqrt());
    let lit_along = distance.mul_add(point.cos_theta_o.max(least), along_lit);
    let squares = lit_along.mul_add(lit_along, sin_squared);
    let cubed = distance_squared * distance;
    let inverse = distance.splat_like(1.0) / (cubed * squares);
    let inverse_squares = cubed * inverse;
    let inverse_cubed = squares * inverse;
    let intensity = emitter.intensity_towards(to_light, distance_squared * inverse_cubed);
    let inverse_distance = distance.splat_like(1.0) / distance;
    let direction = to_light * inverse_distance;
    let half_along = distance.mul_add(point.cos_theta_o, along).max_zero();
    let cos_squared = half_along * half_along;
    let negligible = distance_squared * distance.splat_like(T::NEGLIGIBLE_SQUARE);
    LightTerm {
        visibility,
        direction,
        distance,
        intensity,
        cos_theta_i: along_lit * inverse_distance,
        half: direction + point.view,
        cos_theta_h: half_along / (cos_squared + sin_squared).max(negligible).sqrt(),
        irradiance: visibility * intensity * along_lit * inverse_cubed,
        lobe_irradiance: visibility * intensity * lobe.weight(along_lit, distance) * inverse_cubed,
        lobe: lobe.value(cos_squared, sin_squared, inverse_squares),
    }
}
