//! Ambient light, and what the scene takes of it (3.9).

use super::{Hit, PreparedScene};
use crate::hammersley::points;
use crate::light::Ambient;
use crate::shape::Ray;
use crate::vector::Vector;

/// The irradiance of a surface point by the ambient light.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct AmbientIrradiance {
    /// E_a, in W/m² or lx.
    pub irradiance: f64,
    /// Its standard error: 0 where nothing is sampled.
    pub standard_error: f64,
}

impl PreparedScene {
    /// E_a of a hit: π L_a, or the part of it that comes past the shapes of the scene.
    ///
    /// ```text
    /// E_a = L_a ∫ V(ω) cosθ dω ≈ π L_a m/n
    /// ```
    ///
    /// m of n directions, spread over the hemisphere in proportion to cosθ and always the same about the normal, meet
    /// nothing. The standard error is that of n independent directions, π L_a √(p(1 − p)/n) with p = m/n; spread
    /// directions do better.
    #[must_use]
    pub fn ambient_irradiance(&self, hit: &Hit) -> AmbientIrradiance {
        let Some(ambient) = &self.scene.ambient else { return AmbientIrradiance::default() };
        let is_walled_in = hit.from_inside && ambient.obstruction.is_some();
        if is_walled_in {
            return AmbientIrradiance::default();
        }
        let samples = ambient.obstruction.filter(|_| self.has_shapes_beside_one());
        sampled(ambient, samples, hit.point.normal, |direction| {
            let ray = Ray { anchor: hit.point.anchor, offset: hit.point.offset + hit.lift, direction };
            self.nearest_blocker(&[hit.primitive], &ray, None).blocker.is_none()
        })
    }
}

/// E_a on the side of a normal: all of it, or the part of so many samples that see the environment.
pub(super) fn sampled(
    ambient: &Ambient,
    samples: Option<u32>,
    normal: Vector,
    sees_the_environment: impl Fn(Vector) -> bool,
) -> AmbientIrradiance {
    let whole = ambient.unobstructed_irradiance();
    let Some(samples) = samples else { return AmbientIrradiance { irradiance: whole, standard_error: 0.0 } };
    let direction = |point: &[f64; 2]| direction_about(normal, *point);
    let free = points(samples).iter().filter(|point| sees_the_environment(direction(point))).count();
    #[expect(clippy::cast_precision_loss, reason = "there are few")]
    let share = free as f64 / f64::from(samples);
    let standard_error = whole * (share * (1.0 - share) / f64::from(samples)).sqrt();
    AmbientIrradiance { irradiance: whole * share, standard_error }
}

/// One of the directions about a normal: that of a point of the unit square.
fn direction_about(normal: Vector, [across, around]: [f64; 2]) -> Vector {
    let [first, second] = perpendiculars(normal);
    let angle = std::f64::consts::TAU * around;
    let ring = first * libm::cos(angle) + second * libm::sin(angle);
    // Points of a disc, spread evenly, under the hemisphere: their density on it goes as the cosine.
    (ring * across.sqrt() + normal * (1.0 - across).sqrt()).normalized()
}

/// Two unit vectors at right angles to a unit vector and to each other. (Duff et al., "Building an orthonormal basis,
/// revisited", Journal of Computer Graphics Techniques 6(1), 2017.)
fn perpendiculars(normal: Vector) -> [Vector; 2] {
    let sign = 1.0_f64.copysign(normal.z);
    let a = -1.0 / (sign + normal.z);
    let b = normal.x * normal.y * a;
    [
        Vector::new(1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x),
        Vector::new(b, sign + normal.y * normal.y * a, -normal.y),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_basis_is_orthonormal(direction in prop::array::uniform3(-1.0..1.0_f64)) {
            prop_assume!(Vector::from(direction).length() > 1e-3);
            let normal = Vector::from(direction).normalized();
            let [first, second] = perpendiculars(normal);
            for (product, expected) in [
                (first.dot(first), 1.0),
                (second.dot(second), 1.0),
                (first.dot(second), 0.0),
                (first.dot(normal), 0.0),
                (second.dot(normal), 0.0),
            ] {
                prop_assert!((product - expected).abs() < 1e-15, "{product}");
            }
        }
    }
}
