//! Ambient light, and how much of it the scene blocks (3.9).

use super::{Hit, PreparedScene};
use crate::hammersley::points;
use crate::light::Ambient;
use crate::ray::Ray;
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
    pub(super) const ALL: Self = Self { share: 1.0, standard_error: 0.0 };

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
        let hemisphere = self.hemisphere.as_deref().filter(|_| self.has_shapes_beside_one());
        sampled(hemisphere, hit.point.normal, |direction| {
            let ray = Ray { anchor: hit.point.anchor, offset: hit.point.offset + hit.shadow_ray_offset, direction };
            self.nearest_blocker(&[hit.primitive], &ray, None).blocker.is_none()
        })
    }
}

/// Directions of a hemisphere, with a density proportional to the cosine: they are lifted from evenly spread points of a
/// disc, because the density of their projections onto the disc goes as the cosine.
#[derive(Clone, Debug)]
pub(super) struct Hemisphere {
    /// cosφ and sinφ around the normal, then the components across and along it.
    directions: Vec<[f64; 4]>,
}

impl Hemisphere {
    /// With this many directions.
    pub(super) fn new(count: u32) -> Self {
        let direction = |[across, around]: [f64; 2]| {
            let angle = std::f64::consts::TAU * around;
            [libm::cos(angle), libm::sin(angle), across.sqrt(), (1.0 - across).sqrt()]
        };
        Self { directions: points(count).into_iter().map(direction).collect() }
    }

    /// The directions about a normal, unit vectors.
    fn about(&self, normal: Vector) -> impl Iterator<Item = Vector> {
        let [first, second] = normal.perpendiculars();
        self.directions.iter().map(move |[cosine, sine, across, along]| {
            ((first * *cosine + second * *sine) * *across + normal * *along).normalized()
        })
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
    let free = hemisphere.about(normal).filter(|direction| sees_the_environment(*direction)).count();
    #[expect(clippy::cast_precision_loss, reason = "there are few")]
    let (free, samples) = (free as f64, hemisphere.directions.len() as f64);
    let estimate = (free + 1.0) / (samples + 2.0);
    AmbientShare { share: free / samples, standard_error: (estimate * (1.0 - estimate) / samples).sqrt() }
}
