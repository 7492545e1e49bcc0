//! From irradiance to brightness: the conventions (3.1) to (3.6), (3.11) and (3.12).

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::real::Real;
use crate::scalar::Scalar;
use crate::units::{Keyword, UnitSystem};

/// Which formula turns irradiance into brightness. People publish several that disagree by constant factors or by
/// a cosine, so a scene names its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Convention {
    /// B = Σ E_j (3.1), W/m²: no material, no viewer.
    Irradiance,
    /// B = k_d Σ E_j (3.2), W/m².
    Lambert,
    /// B = Σ E_j (k_d cosθ_o + k_s (N·H_j)ⁿ) (3.3), W/m².
    Lab,
    /// B = Σ E_j (k_d + k_s (N·H_j)ⁿ) (3.4), W/(m²·sr) with coefficients in sr⁻¹.
    Course,
    /// B = (1/π) Σ E_j (k_d + k_s (N·H_j)ⁿ) (3.5), W/(m²·sr).
    CoursePi,
    /// B = Σ E_j (k_d/π + k_s c(n) (N·H_j)ⁿ) (3.6), W/(m²·sr), with [`lobe_constant`] c(n).
    Radiance,
    /// B = Σ (k_d E_j + k_s v_j I_j/r_j² (N·H_j)ⁿ) where cosθ_i > 0 (3.11), W/(m²·sr) with coefficients in sr⁻¹: the
    /// Blinn–Phong formula of real-time graphics, whose highlight has no cosθ_i.
    BlinnPhong,
    /// The same divided by π (3.12), W/(m²·sr).
    BlinnPhongPi,
}

impl Keyword for Convention {
    const ALL: &'static [Self] = &[
        Self::Irradiance,
        Self::Lambert,
        Self::Lab,
        Self::Course,
        Self::CoursePi,
        Self::Radiance,
        Self::BlinnPhong,
        Self::BlinnPhongPi,
    ];

    fn name(self) -> &'static str {
        match self {
            Self::Irradiance => "irradiance",
            Self::Lambert => "lambert",
            Self::Lab => "lab",
            Self::Course => "course",
            Self::CoursePi => "course-pi",
            Self::Radiance => "radiance",
            Self::BlinnPhong => "blinn-phong",
            Self::BlinnPhongPi => "blinn-phong-pi",
        }
    }
}

impl Convention {
    /// The number of its formula in the documentation.
    #[must_use]
    pub fn formula_number(self) -> &'static str {
        match self {
            Self::Irradiance => "3.1",
            Self::Lambert => "3.2",
            Self::Lab => "3.3",
            Self::Course => "3.4",
            Self::CoursePi => "3.5",
            Self::Radiance => "3.6",
            Self::BlinnPhong => "3.11",
            Self::BlinnPhongPi => "3.12",
        }
    }

    /// Its formula in readable form.
    #[must_use]
    pub fn formula(self) -> &'static str {
        match self {
            Self::Irradiance => "B = Σ E_j",
            Self::Lambert => "B = k_d Σ E_j",
            Self::Lab => "B = Σ E_j (k_d cosθ_o + k_s (N·H_j)^n)",
            Self::Course => "B = Σ E_j (k_d + k_s (N·H_j)^n)",
            Self::CoursePi => "B = (1/π) Σ E_j (k_d + k_s (N·H_j)^n)",
            Self::Radiance => "B = Σ E_j (k_d/π + k_s c(n) (N·H_j)^n)",
            Self::BlinnPhong => "B = Σ (k_d E_j + k_s v_j I_j/r_j² (N·H_j)^n)",
            Self::BlinnPhongPi => "B = (1/π) Σ (k_d E_j + k_s v_j I_j/r_j² (N·H_j)^n)",
        }
    }

    /// Name and formula number, such as `lab (3.3)`.
    #[must_use]
    pub fn label(self) -> String {
        format!("{} ({})", self.name(), self.formula_number())
    }

    /// The unit of B.
    #[must_use]
    pub fn unit(self, units: UnitSystem) -> &'static str {
        match self {
            Self::Irradiance | Self::Lambert | Self::Lab => units.irradiance_unit(),
            Self::Course | Self::CoursePi | Self::Radiance | Self::BlinnPhong | Self::BlinnPhongPi => {
                units.radiance_unit()
            }
        }
    }

    /// Whether it uses the coefficients of a material at all.
    #[must_use]
    pub fn uses_material(self) -> bool {
        self != Self::Irradiance
    }

    /// Whether it uses the specular coefficient and the shininess of a material.
    #[must_use]
    pub fn has_specular_part(self) -> bool {
        !matches!(self, Self::Irradiance | Self::Lambert)
    }

    /// Whether k_d is an albedo: the fraction of light that the diffuse part reflects, so at most 1.
    #[must_use]
    pub fn bounds_diffuse(self) -> bool {
        matches!(self, Self::Lambert | Self::CoursePi | Self::Radiance | Self::BlinnPhongPi)
    }

    /// Whether k_s is an albedo: the fraction of light that the highlight reflects at normal incidence, so at most 1.
    #[must_use]
    pub fn bounds_specular(self) -> bool {
        self == Self::Radiance
    }

    /// The albedo of a material at normal incidence: the fraction of light that it reflects, in all directions together. For
    /// `lab`, whose B is no radiance, the largest B/E; 0 without a material.
    #[must_use]
    pub fn albedo(self, material: &Reflectance) -> f64 {
        let Reflectance { diffuse, specular, shininess } = *material;
        let of_lobe = || specular / lobe_constant(shininess);
        match self {
            Self::Irradiance => 0.0,
            Self::Lambert => diffuse,
            Self::Lab | Self::Radiance => diffuse + specular,
            Self::Course | Self::BlinnPhong => PI * diffuse + of_lobe(),
            Self::CoursePi | Self::BlinnPhongPi => diffuse + of_lobe() / PI,
        }
    }

    /// The [albedo](Self::albedo) in readable form, with A(n) = 1/c(n).
    #[must_use]
    pub fn albedo_formula(self) -> &'static str {
        match self {
            Self::Irradiance => "0",
            Self::Lambert => "k_d",
            Self::Lab | Self::Radiance => "k_d + k_s",
            Self::Course | Self::BlinnPhong => "π k_d + k_s A(n)",
            Self::CoursePi | Self::BlinnPhongPi => "k_d + k_s A(n)/π",
        }
    }

    /// Whether its highlight is multiplied by cosθ_i like the rest of E_j. Where it is not, it jumps at the terminator.
    #[must_use]
    pub fn has_cosine_in_highlight(self) -> bool {
        !matches!(self, Self::BlinnPhong | Self::BlinnPhongPi)
    }
}

/// c(n) = (n+2)(n+4) / (8π (n + 2^(−n/2))): the constant with which the lobe (N·H)ⁿ reflects exactly all the light that
/// falls on it at normal incidence (3.6). Its inverse is the albedo A(n) of the bare lobe.
///
/// `shininess` is positive; the result is in sr⁻¹.
#[must_use]
pub fn lobe_constant(shininess: f64) -> f64 {
    let n = shininess;
    (n + 2.0) * (n + 4.0) / (8.0 * PI * (n + libm::exp2(-0.5 * n)))
}

/// The material coefficients of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reflectance {
    /// k_d: up to 1 where the convention makes it an albedo; in sr⁻¹ in `course` and `blinn-phong`.
    pub diffuse: f64,
    /// k_s, likewise.
    pub specular: f64,
    /// n > 0.
    pub shininess: f64,
}

/// How (N·H)ⁿ is computed from numbers proportional to cos²θ_h and sin²θ_h.
pub trait Lobe<T: Real> {
    /// (N·H)ⁿ; `inverse` is 1/(cos² + sin²) wherever the light is above the horizon.
    fn value(&self, cos_squared: T, sin_squared: T, inverse: T) -> T;

    /// What the lobe is multiplied by besides v I/r², times r: cosθ_i r, given that (at least 0) and r.
    #[inline(always)]
    fn weight(&self, along_lit: T, _distance: T) -> T {
        along_lit
    }
}

/// The [weight](Lobe::weight) of a highlight without cosθ_i, (3.11) and (3.12): r above the horizon, 0 below.
#[inline(always)]
pub fn weight_without_cosine<T: Real>(along_lit: T, distance: T) -> T {
    let zero = along_lit.splat_like(0.0);
    T::select(zero.is_less(along_lit), distance, zero)
}

/// The lobe for single numbers; without a shininess there is none, and it is 0 everywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScalarLobe {
    shininess: Option<f64>,
    has_cosine: bool,
}

impl<T: Scalar> Lobe<T> for ScalarLobe {
    #[inline(always)]
    fn value(&self, cos_squared: T, sin_squared: T, _: T) -> T {
        // Divided, not multiplied by the inverse, because n amplifies each rounding error.
        let squares = (cos_squared + sin_squared).max(T::from_f64(f64::MIN_POSITIVE));
        match self.shininess {
            Some(shininess) => T::cosine_power(cos_squared / squares, sin_squared / squares, shininess),
            None => T::zero(),
        }
    }

    #[inline(always)]
    fn weight(&self, along_lit: T, distance: T) -> T {
        if self.has_cosine { along_lit } else { weight_without_cosine(along_lit, distance) }
    }
}

/// A convention applied to a material: every formula of section 3 is
/// B = Σ E_j (a + b cosθ_o + s (N·H_j)ⁿ) with its own a, b and s; (3.11) and (3.12) have E_j/cosθ_i in the last term.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BrightnessFormula {
    diffuse_constant: f64,
    diffuse_cosine: f64,
    /// s, the factor of the lobe.
    pub(crate) specular: f64,
    /// n.
    pub(crate) shininess: f64,
    has_cosine_in_highlight: bool,
    depends_on_viewer: bool,
}

impl BrightnessFormula {
    /// The formula of a convention for a material.
    #[must_use]
    pub fn new(convention: Convention, material: &Reflectance) -> Self {
        let Reflectance { diffuse, specular, shininess } = *material;
        let (diffuse_constant, diffuse_cosine, specular) = match convention {
            Convention::Irradiance => (1.0, 0.0, 0.0),
            Convention::Lambert => (diffuse, 0.0, 0.0),
            Convention::Lab => (0.0, diffuse, specular),
            Convention::Course | Convention::BlinnPhong => (diffuse, 0.0, specular),
            Convention::CoursePi | Convention::BlinnPhongPi => (diffuse / PI, 0.0, specular / PI),
            Convention::Radiance => (diffuse / PI, 0.0, specular * lobe_constant(shininess)),
        };
        let depends_on_viewer = convention.uses_material();
        let has_cosine_in_highlight = convention.has_cosine_in_highlight();
        Self { diffuse_constant, diffuse_cosine, specular, shininess, has_cosine_in_highlight, depends_on_viewer }
    }

    /// The factor of E in the diffuse part. Zero where the surface faces away from the viewer (θ_o ≥ 90°), except for the
    /// irradiance itself, which does not depend on a viewer.
    #[inline(always)]
    pub fn diffuse_factor<T: Real>(&self, cos_theta_o: T) -> T {
        let constant = cos_theta_o.splat_like(self.diffuse_constant);
        let factor = cos_theta_o.splat_like(self.diffuse_cosine).mul_add(cos_theta_o, constant);
        if self.depends_on_viewer { Self::towards_viewer(cos_theta_o, factor) } else { factor }
    }

    /// The factor of Σ E_j (N·H_j)ⁿ (of Σ v_j I_j/r_j² (N·H_j)ⁿ in (3.11) and (3.12)) in the specular part; zero where the surface faces away from the viewer.
    #[inline(always)]
    pub fn specular_factor<T: Real>(&self, cos_theta_o: T) -> T {
        Self::towards_viewer(cos_theta_o, cos_theta_o.splat_like(self.specular))
    }

    /// n, if the formula has a highlight.
    #[must_use]
    pub fn sharpness(&self) -> Option<f64> {
        (self.specular != 0.0).then_some(self.shininess)
    }

    /// (N·H)ⁿ for single numbers.
    #[must_use]
    pub fn lobe(&self) -> ScalarLobe {
        ScalarLobe { shininess: self.sharpness(), has_cosine: self.has_cosine_in_highlight }
    }

    /// Whether B jumps at the terminator: it has a highlight that is not multiplied by cosθ_i.
    #[must_use]
    pub fn jumps_at_terminator(&self) -> bool {
        self.specular != 0.0 && !self.has_cosine_in_highlight
    }

    #[inline(always)]
    fn towards_viewer<T: Real>(cos_theta_o: T, factor: T) -> T {
        let zero = cos_theta_o.splat_like(0.0);
        T::select(zero.is_less(cos_theta_o), factor, zero)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By Simpson's rule in cosθ at normal incidence, where θ_h = θ/2.
    #[test]
    fn the_albedo_is_the_integral_of_what_is_reflected() {
        let (diffuse, specular, shininess) = (0.7, 0.9, 40.0);
        let material = Reflectance { diffuse, specular, shininess };
        for convention in Convention::ALL.iter().skip(3) {
            let formula = BrightnessFormula::new(*convention, &material);
            let steps = 20_000;
            let integrand = |k: i32| {
                let cosine = f64::from(k) / f64::from(steps);
                let lobe = f64::midpoint(1.0, cosine).powf(0.5 * shininess);
                (formula.diffuse_factor(cosine) + formula.specular_factor(cosine) * lobe) * cosine * 2.0 * PI
            };
            let inner: f64 = (1..steps).map(|k| integrand(k) * if k % 2 == 1 { 4.0 } else { 2.0 }).sum();
            let expected = (integrand(0) + integrand(steps) + inner) / (3.0 * f64::from(steps));
            let found = convention.albedo(&material);
            assert!((found - expected).abs() < 1e-10, "{convention:?}: {found} {expected}");
        }
        assert!((Convention::CoursePi.albedo(&material) - 0.856).abs() < 5e-4);
    }

    #[test]
    fn the_lobe_constant_has_its_published_value() {
        assert!((lobe_constant(80.0) - 3.425_810).abs() < 5e-7);
    }

    /// ∫ c(n) (N·H)ⁿ cosθ_i dω = 1 at normal incidence, where θ_h = θ/2: by Simpson's rule in cosθ.
    #[test]
    fn the_normalised_lobe_reflects_all_that_falls_on_it() {
        for shininess in [0.5, 1.0, 2.0, 10.0, 20.0, 80.0, 500.0] {
            let steps = 200_000;
            let integrand = |k: i32| {
                let cosine = f64::from(k) / f64::from(steps);
                let half_cosine_squared = f64::midpoint(1.0, cosine);
                half_cosine_squared.powf(0.5 * shininess) * cosine * 2.0 * PI
            };
            let inner: f64 = (1..steps).map(|k| integrand(k) * if k % 2 == 1 { 4.0 } else { 2.0 }).sum();
            let albedo = (integrand(0) + integrand(steps) + inner) / (3.0 * f64::from(steps));
            assert!((albedo * lobe_constant(shininess) - 1.0).abs() < 1e-10, "n = {shininess}");
        }
    }
}
