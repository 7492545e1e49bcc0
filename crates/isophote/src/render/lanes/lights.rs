//! The lights of a scene as the points of one shape see them.

use crate::lanes::{Element, Precision};
use crate::light::{Ambient, Emission, Light, PlacedLight, Rays};
use crate::prepare::PreparedScene;
use crate::render::lanes::power::Power;
use crate::shape::{Primitive, Sphere};
use crate::vector::Vector;

/// The lights as seen from the centre of a shape, lengths in its radii: irradiances then come out right when
/// intensities are divided by the radius squared.
pub struct ShapeLights<E> {
    /// Those that can light it.
    pub lights: Vec<PlacedLight<E>>,
    /// Bounds of every [`BLOCK`] lights in their order, none where one of them is parallel; empty where there are so few
    /// lights that each is simply summed.
    blocks: Vec<Option<Ball>>,
    /// Those whose irradiance is asked for by itself.
    pub asked_for: Vec<PlacedLight<E>>,
    /// E_a (3.9).
    pub ambient: E,
    /// How the lobe is computed.
    pub power: Power,
}

/// Lights whose sum is plain before it goes into the compensated one, and that are skipped together when they are
/// behind the horizon together.
pub const BLOCK: usize = 64;

/// A ball that holds the lights of a block.
#[derive(Clone, Copy)]
struct Ball {
    center: Vector,
    radius: f64,
}

/// Everything that lanes need of a shape besides its outline.
pub enum ShapeShading {
    /// In single precision.
    Single(ShapeLights<f32>),
    /// In double precision.
    Double(ShapeLights<f64>),
}

/// In single precision a lobe with a larger n would lose more digits than [`SINGLE`](crate::tolerance::SINGLE) allows.
const LARGEST_SHININESS_IN_SINGLE: f64 = 32.0;

/// A distance, in radii, whose powers single precision can hold; and intensities, over R².
const FARTHEST_IN_SINGLE: f64 = 1e5;

/// Nearer to the surface, in radii, the difference of two rounded places has too few digits left for 1/r².
const NEAREST_IN_SINGLE: f64 = 0.1;

/// A sharper edge of a spot, per radian, would multiply the rounding of directions beyond what
/// [`SINGLE`](crate::tolerance::SINGLE) allows.
const STEEPEST_IN_SINGLE: f64 = 6.0;
const INTENSITIES_IN_SINGLE: std::ops::Range<f64> = 1e-18..1e18;

impl ShapeShading {
    /// The lights of a scene as a shape sees them, in an [order](by_place). `wanted` are those whose irradiance is asked for by itself.
    pub fn new(
        scene: &PreparedScene,
        primitive: Primitive,
        sphere: &Sphere,
        order: &[usize],
        wanted: &[usize],
        precision: Precision,
    ) -> Self {
        let description = scene.scene();
        let Sphere { center, radius } = *sphere;
        let place = |&index: &usize| {
            let light = description.lights()[index].seen_from::<f64>(center);
            match light.rays {
                Rays::Point(_) => PlacedLight {
                    position: light.position * (1.0 / radius),
                    intensity: light.intensity / (radius * radius),
                    ..light
                },
                Rays::Parallel => light,
            }
        };
        // What sends nothing is nothing to sum.
        let lights: Vec<PlacedLight> = order.iter().map(place).filter(|light| light.intensity > 0.0).collect();
        let asked_for: Vec<PlacedLight> = wanted.iter().map(place).collect();
        let shininess = scene.formula(primitive).sharpness();
        // One convex shape, or none of several, obstructs it: only such scenes are rendered here.
        let ambient = description.ambient().map_or(0.0, Ambient::unobstructed_irradiance);
        if precision == Precision::Single && fits_single(&lights, ambient, shininess) {
            Self::Single(ShapeLights::new(&lights, &asked_for, ambient, shininess))
        } else {
            Self::Double(ShapeLights::new(&lights, &asked_for, ambient, shininess))
        }
    }
}

/// Whether single precision holds the lights as a shape sees them, and the lobe of a shininess.
pub fn fits_single(lights: &[PlacedLight], ambient: f64, shininess: Option<f64>) -> bool {
    let fits = |light: &PlacedLight| {
        let distance = light.position.length();
        let is_near = distance < FARTHEST_IN_SINGLE && distance - 1.0 >= NEAREST_IN_SINGLE;
        let has_digits = match light.rays {
            Rays::Parallel => true,
            Rays::Point(Emission::Spot(spot)) => is_near && spot.steepest() <= STEEPEST_IN_SINGLE,
            Rays::Point(_) => is_near,
        };
        has_digits && INTENSITIES_IN_SINGLE.contains(&light.intensity)
    };
    let ambient_fits = ambient == 0.0 || INTENSITIES_IN_SINGLE.contains(&ambient);
    ambient_fits && shininess.is_none_or(|n| n <= LARGEST_SHININESS_IN_SINGLE) && lights.iter().all(fits)
}

/// The lights of a scene in the order in which they are summed: that of the scene; where they make blocks, along a curve
/// that keeps neighbours together (Morton's), so that blocks are small in space, and parallel lights, which have no place,
/// in the end.
pub fn by_place(lights: &[Light]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..lights.len()).collect();
    if lights.len() <= BLOCK {
        return order;
    }
    let coordinates = || lights.iter().filter_map(Light::position).flat_map(Vector::to_array);
    let low = coordinates().fold(f64::INFINITY, f64::min);
    let size = (coordinates().fold(f64::NEG_INFINITY, f64::max) - low).max(f64::MIN_POSITIVE);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and 2^20")]
    let cell = |x: f64| ((x - low) / size * 1_048_575.0) as u64;
    order.sort_by_cached_key(|&index| {
        let Some(position) = lights[index].position() else { return u64::MAX };
        let cells = position.to_array().map(cell);
        (0..20).rev().fold(0_u64, |key, bit| cells.iter().fold(key, |key, cell| (key << 1) | ((cell >> bit) & 1)))
    });
    order
}

impl<E: Element> ShapeLights<E> {
    fn new(lights: &[PlacedLight], asked_for: &[PlacedLight], ambient: f64, shininess: Option<f64>) -> Self {
        let convert = |light: &PlacedLight| light.map(E::from_f64);
        Self {
            lights: lights.iter().map(convert).collect(),
            blocks: if lights.len() > BLOCK { lights.chunks(BLOCK).map(Ball::around).collect() } else { Vec::new() },
            asked_for: asked_for.iter().map(convert).collect(),
            ambient: E::from_f64(ambient),
            power: Power::new(shininess, E::PRECISION),
        }
    }

    /// The lights that may be above the horizon of any point of a cap, given by the direction of its middle and the
    /// largest distance of its points from that, in radii. A light at S is above the horizon of the point N of the unit
    /// sphere where N·S > 1, a parallel one where N·L > 0. Each light is tested but those of a block that is below as a whole.
    pub fn above_horizon<'l>(
        &'l self,
        middle: Vector,
        reach: f64,
        chosen: &'l mut Vec<PlacedLight<E>>,
    ) -> &'l [PlacedLight<E>] {
        if self.blocks.is_empty() {
            return &self.lights;
        }
        chosen.clear();
        // Single precision rounds N·S to about 1e-7 of ‖S‖: with that to spare, what is skipped is dark in any case.
        let spare = |distance: f64| 1e-6 * (1.0 + distance);
        for (block, lights) in self.blocks.iter().zip(self.lights.chunks(BLOCK)) {
            if let Some(Ball { center, radius }) = block {
                let farthest = center.length() + radius;
                let highest = middle.dot(*center) + radius + reach * farthest;
                if highest + spare(farthest) < 1.0 {
                    continue;
                }
            }
            for light in lights {
                let position = light.position.map(E::to_f64);
                let distance = position.length();
                let horizon = if light.rays == Rays::Parallel { 0.0 } else { 1.0 };
                if middle.dot(position) + reach * distance + spare(distance) >= horizon {
                    chosen.push(*light);
                }
            }
        }
        chosen
    }
}

impl Ball {
    #[expect(clippy::cast_precision_loss, reason = "a block is small")]
    fn around(lights: &[PlacedLight]) -> Option<Self> {
        if lights.iter().any(|light| light.rays == Rays::Parallel) {
            return None;
        }
        let sum = lights.iter().fold(Vector::default(), |sum, light| sum + light.position);
        let center = sum * (1.0 / lights.len() as f64);
        let distance = |light: &PlacedLight| (light.position - center).length();
        // A little larger, for what rounding the lights to single precision moves them.
        let radius = lights.iter().map(distance).fold(0.0, f64::max);
        Some(Self { center, radius: radius + 1e-6 * (radius + center.length()) })
    }
}
