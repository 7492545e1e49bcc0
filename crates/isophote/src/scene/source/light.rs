//! Lights, as they are written.

use schemars::JsonSchema;
use serde::Serialize;

use super::declare::tables;
use super::{Amount, amount};
use crate::scene::limits;
use crate::units::Keyword;

tables! {
    /// A light.
    #[serde(deny_unknown_fields)]
    pub struct LightSource {
        /// A name of its own; by default `light[0]`, `light[1]` and so on.
        pub name: Option<String>,
        /// Where it stands: not inside a sphere, unless the eye is inside the same one. Required, but for a parallel light,
        /// which has no place.
        pub position: Option<[f64; 3]>,
        /// Intensity on the axis in W/sr or cd. Either this or `power`.
        #[schemars(with = "Option<amount::Strength>")]
        pub intensity: Option<Amount>,
        /// Power sent out in all directions, in W or lm; isotropic: 4π times the intensity, lambertian: π times,
        /// spot: π (2 − cos α − cos β) times, for the half angles α and β of its cones.
        #[schemars(with = "Option<amount::Strength>")]
        pub power: Option<Amount>,
        /// How the intensity depends on the direction: not at all, as the cosine of the angle from the axis, or by two cones;
        /// or that the light comes from one direction, like the sun's.
        #[schemars(extend("default" = "isotropic"))]
        pub emission: Option<EmissionName>,
        /// The axis of a lambertian light or of a spot, of any length but zero. Either this or `target`.
        pub axis: Option<[f64; 3]>,
        /// A point at which a lambertian light or a spot is aimed. Either this or `axis`.
        pub target: Option<[f64; 3]>,
        /// The angle of its axis, or of the direction of a parallel light, from −z, in degrees: 0 is straight down −z, 90
        /// horizontal. With `azimuth`, instead of `axis`, `target` or `direction`.
        #[schemars(range(min = 0.0, max = limits::TILT))]
        pub tilt: Option<f64>,
        /// The way that it leans, in degrees from +x towards +y. Needed where `tilt` is neither 0 nor 180.
        #[schemars(range(min = -limits::AZIMUTH, max = limits::AZIMUTH))]
        pub azimuth: Option<f64>,
        /// Half the opening of the cone in which a spot has its full intensity, in degrees from the axis.
        #[schemars(range(min = 0.0, max = limits::CONE - limits::CONE_STEP))]
        pub inner_angle: Option<f64>,
        /// Half the opening of the cone outside which a spot sends nothing, in degrees from the axis; at least half a degree more
        /// than `inner_angle`.
        #[schemars(range(min = limits::CONE_STEP, max = limits::CONE))]
        pub outer_angle: Option<f64>,
        /// The direction in which the light of a parallel light travels, of any length but zero.
        pub direction: Option<[f64; 3]>,
        /// What a parallel light gives to a plane at right angles to its direction, in W/m² or lx.
        #[schemars(with = "Option<amount::Strength>")]
        pub irradiance: Option<Amount>,
        /// Whether shapes keep its light from each other, if the scene has shadows.
        #[schemars(extend("default" = true))]
        pub casts_shadows: Option<bool>,
        /// Whether it is switched on. A light that is off keeps its name and its place in listings, and gives no light.
        #[schemars(extend("default" = true))]
        pub on: Option<bool>,
    }

    /// Light that comes from all around, with the same radiance from every direction.
    #[serde(deny_unknown_fields)]
    pub struct AmbientSource {
        /// Its radiance L_a in W/(m²·sr) or cd/m²: every surface receives π L_a of it.
        #[schemars(required, with = "Option<amount::Strength>")]
        pub radiance: Option<Amount>,
        /// Whether shapes keep it from each other.
        #[schemars(extend("default" = false))]
        pub obstructed: Option<bool>,
        /// In how many directions each point looks for shapes that are in the way.
        #[schemars(range(min = 1, max = limits::SAMPLES), extend("default" = 64))]
        pub samples: Option<u64>,
    }
}

/// The emission patterns by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum EmissionName {
    /// The same intensity in every direction.
    Isotropic,
    /// I₀ cosγ, γ the angle from the axis.
    Lambertian,
    /// I₀ within a cone, 0 outside another, a smooth step between.
    Spot,
    /// From one direction, without loss: the sun.
    Parallel,
}

impl Keyword for EmissionName {
    const ALL: &'static [Self] = &[Self::Isotropic, Self::Lambertian, Self::Spot, Self::Parallel];

    fn name(self) -> &'static str {
        match self {
            Self::Isotropic => "isotropic",
            Self::Lambertian => "lambertian",
            Self::Spot => "spot",
            Self::Parallel => "parallel",
        }
    }
}
