//! Point lights.

use super::Emission;
use crate::vector::Vector;

/// A light whose irradiance falls with the square of the distance (3.1).
#[derive(Clone, Debug, PartialEq)]
pub struct PointLight {
    /// S, its position, in metres.
    pub position: Vector,
    /// I₀: radiant intensity (W/sr) on the axis, or luminous intensity (cd).
    pub intensity: f64,
    /// How the intensity depends on the direction.
    pub emission: Emission,
}

impl PointLight {
    /// The total power that the light emits, in W or lm.
    #[must_use]
    pub fn power(&self) -> f64 {
        self.intensity * self.emission.solid_angle()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::{Emitters, Light, LightKind, Spot};

    /// ∫ I(ω) dω over the sphere of directions, by the midpoint rule in cosine and azimuth about a slanted axis.
    #[test]
    fn the_power_of_a_light_is_the_integral_of_its_intensity() {
        let axis = Vector::new(1.0, 2.0, -2.0) * (1.0 / 3.0);
        let spots = [[0.0, 30.0], [20.0, 40.0], [0.0, 90.0], [70.0, 90.0]];
        let spots = spots
            .map(|[inner, outer]: [f64; 2]| Emission::Spot(Spot::new(axis, inner.to_radians(), outer.to_radians())));
        for emission in [Emission::Isotropic, Emission::Lambertian { axis }].into_iter().chain(spots) {
            let light = PointLight { position: Vector::default(), intensity: 3.5, emission };
            let lamp =
                Light { name: String::new(), kind: LightKind::Point(light.clone()), casts_shadows: true, is_on: true };
            let [emitter] = *Emitters::of(&[lamp]).all() else { panic!("a point light is one emitter") };
            let (cosines, turns) = (1000, 1000);
            let mut power = 0.0;
            for i in 0..cosines {
                let z = (f64::from(i) + 0.5) / f64::from(cosines) * 2.0 - 1.0;
                for j in 0..turns {
                    let (sine, cosine) = (std::f64::consts::TAU * (f64::from(j) + 0.5) / f64::from(turns)).sin_cos();
                    let ring = (1.0 - z * z).sqrt();
                    let away = Vector::new(ring * cosine, ring * sine, z);
                    power += emitter.seen_from::<f64>(away).intensity_towards(-away, 1.0);
                }
            }
            power *= 4.0 * std::f64::consts::PI / f64::from(cosines * turns);
            assert!((power / light.power() - 1.0).abs() < 1e-5, "{emission:?}");
        }
    }
}
