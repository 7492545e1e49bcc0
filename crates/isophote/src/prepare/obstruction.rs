//! Ambient light, and how much of it the scene blocks (3.9).

use super::{Hit, PreparedScene};
use crate::hammersley::points;
use crate::light::Ambient;
use crate::ray::Ray;
use crate::real::Real;
use crate::shape::Primitive;
use crate::vector::Vector;

/// The irradiance of a surface point due to the ambient light.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct AmbientIrradiance {
    /// E_a, in W/m² or lx.
    pub irradiance: f64,
    /// Its standard error: 0 where nothing is sampled.
    pub standard_error: f64,
}

/// The part of the ambient light that arrives at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct AmbientShare {
    share: f64,
    standard_error: f64,
}

impl AmbientShare {
    pub(crate) const ALL: Self = Self { share: 1.0, standard_error: 0.0 };

    /// The irradiance due to this environment, if there is one.
    pub(crate) fn of(self, ambient: Option<&Ambient>) -> AmbientIrradiance {
        let whole = ambient.map_or(0.0, Ambient::unobstructed_irradiance);
        AmbientIrradiance { irradiance: whole * self.share, standard_error: whole * self.standard_error }
    }
}

impl PreparedScene {
    /// E_a of a hit: π L_a, or the part of it that the shapes of the scene let through.
    ///
    /// ```text
    /// E_a = L_a ∫ V(ω) cosθ dω ≈ π L_a m/n
    /// ```
    ///
    /// Of n directions, spread over the hemisphere with a density proportional to cosθ and always the same relative to the
    /// normal, m hit nothing. The standard error is that of n independent directions, π L_a √(p(1 − p)/n) with p = (m + 1)/(n
    /// + 2), Laplace's estimate, which is never certain; evenly spread directions do better.
    #[must_use]
    pub fn ambient_irradiance(&self, hit: &Hit) -> AmbientIrradiance {
        self.ambient_share(hit).of(self.scene.ambient())
    }

    /// The part of the ambient light that arrives at a hit, whatever its radiance.
    pub(crate) fn ambient_share(&self, hit: &Hit) -> AmbientShare {
        let Some(ambient) = &self.scene.ambient else { return AmbientShare::ALL };
        let is_walled_in = hit.from_inside && ambient.obstruction.is_some();
        if is_walled_in {
            return AmbientShare { share: 0.0, standard_error: 0.0 };
        }
        sampled(self.obstructed_hemisphere(true), hit.point.normal, |direction| {
            let ray = Ray { anchor: hit.point.anchor, offset: hit.point.offset + hit.shadow_ray_offset, direction };
            self.sees_environment(&[hit.primitive], &ray)
        })
    }

    /// The directions in which the ambient light of a point may be blocked, if it may: one convex primitive does not block
    /// that of its own points.
    pub(crate) fn obstructed_hemisphere(&self, is_on_shape: bool) -> Option<&Hemisphere> {
        self.hemisphere.as_deref().filter(|_| self.primitive_count() > u32::from(is_on_shape))
    }

    /// Whether nothing stands between the start of a ray, on its `own` primitives, and the environment.
    pub(crate) fn sees_environment(&self, own: &[Primitive], ray: &Ray) -> bool {
        self.nearest_blocker(own, ray, None).blocker.is_none()
    }
}

/// Directions of a hemisphere, with a density proportional to the cosine: they are lifted from evenly spread points of a
/// disc, because the density of their projections onto the disc goes as the cosine.
#[derive(Clone, Debug)]
pub(crate) struct Hemisphere {
    directions: Vec<HemisphereDirection>,
}

/// A direction relative to a normal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HemisphereDirection {
    /// cosφ and sinφ around the normal.
    around: [f64; 2],
    /// The components across and along it.
    parts: [f64; 2],
}

impl HemisphereDirection {
    /// The unit vector about a normal, of which two unit vectors across it are given.
    #[inline(always)]
    pub(crate) fn about<T: Real>(&self, normal: Vector<T>, [first, second]: [Vector<T>; 2]) -> Vector<T> {
        let number = |number| normal.x.splat_like(number);
        let ([cosine, sine], [across, along]) = (self.around, self.parts);
        ((first * number(cosine) + second * number(sine)) * number(across) + normal * number(along)).normalized()
    }
}

impl Hemisphere {
    /// With this many directions.
    pub(super) fn new(count: u32) -> Self {
        let direction = |[across, around]: [f64; 2]| {
            let angle = std::f64::consts::TAU * around;
            HemisphereDirection {
                around: [libm::cos(angle), libm::sin(angle)],
                parts: [across.sqrt(), (1.0 - across).sqrt()],
            }
        };
        Self { directions: points(count).into_iter().map(direction).collect() }
    }

    /// All directions.
    pub(crate) fn directions(&self) -> &[HemisphereDirection] {
        &self.directions
    }

    /// The share of the ambient light that arrives if this many of the directions see the environment.
    #[expect(clippy::cast_precision_loss, reason = "there are few")]
    pub(crate) fn share(&self, free: usize) -> AmbientShare {
        let (free, samples) = (free as f64, self.directions.len() as f64);
        let estimate = (free + 1.0) / (samples + 2.0);
        AmbientShare { share: free / samples, standard_error: (estimate * (1.0 - estimate) / samples).sqrt() }
    }
}

/// The part of the ambient light that arrives on the side of a normal: all of it, or the fraction of a hemisphere's
/// directions that see the environment.
pub(super) fn sampled(
    hemisphere: Option<&Hemisphere>,
    normal: Vector,
    sees_the_environment: impl Fn(Vector) -> bool,
) -> AmbientShare {
    let Some(hemisphere) = hemisphere else { return AmbientShare::ALL };
    let across = normal.perpendiculars();
    let directions = hemisphere.directions.iter().map(|direction| direction.about(normal, across));
    hemisphere.share(directions.filter(|direction| sees_the_environment(*direction)).count())
}
