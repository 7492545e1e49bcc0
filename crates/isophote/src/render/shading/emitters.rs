//! The emitters of a scene as seen by the points of one sphere.

use crate::lanes::Element;
use crate::light::{Emitter, Emitters, Pattern, PlacedEmitter};
use crate::prepare::PreparedScene;
use crate::reflectance::BrightnessFormula;
use crate::shape::Sphere;
use crate::vector::Vector;

/// Emitters whose terms are added plainly before the compensated sum, and that are skipped together if all of them are below
/// the horizon.
pub const BLOCK: usize = 64;

/// In single precision, a lobe with a larger n would lose more digits than [`SINGLE`](crate::tolerance::SINGLE) allows; one
/// with a smaller n is still bright where cos²θ_h, as 1 − sin²θ_h, has lost its digits.
pub const SHININESS_IN_SINGLE: std::ops::RangeInclusive<f64> = 1.0..=24.0;

/// The largest distance, in radii, whose powers single precision can hold, and the intensities over R² that it can hold.
const FARTHEST_IN_SINGLE: f64 = 1e5;
const INTENSITIES_IN_SINGLE: std::ops::Range<f64> = 1e-18..1e18;

/// Closer to the surface than this, in radii, the difference of two rounded positions has too few digits left for 1/r².
const NEAREST_IN_SINGLE: f64 = 0.1;

/// A steeper cone edge, per radian, would amplify the rounding errors of directions beyond what
/// [`SINGLE`](crate::tolerance::SINGLE) allows.
const STEEPEST_IN_SINGLE: f64 = 6.0;

/// The data about a scene's lights that all shapes share.
pub struct Lighting {
    /// The [order](by_place) in which emitters are summed.
    order: Vec<usize>,
    /// The index of each light among those whose own irradiance is requested.
    asked_for: Vec<Option<usize>>,
}

/// The emitters as seen from the centre of a sphere, with lengths in units of its radius: irradiances then come out right if
/// intensities are divided by the radius squared. Emitters of zero intensity are left out.
#[derive(Default)]
pub struct ShapeEmitters {
    placed: Vec<PlacedEmitter>,
    /// The index of each one among the scene's emitters.
    indices: Vec<usize>,
    /// ‖S‖ of each, if there are blocks.
    distances: Vec<f64>,
    /// Bounds of every [`BLOCK`] of them, in order; `None` where one of them is parallel; empty if there are so few that
    /// each is simply summed.
    blocks: Vec<Option<Ball>>,
}

/// Emitters that may light some points, in the precision of the sums; the memory is reused.
#[derive(Default)]
pub struct Chosen<E> {
    emitters: Vec<PlacedEmitter<E>>,
    block_ends: Vec<usize>,
    /// For emitters of lights whose own irradiance is requested: the index among those lights, and that of the emitter.
    asked_for: Vec<(usize, usize)>,
    /// How many of the emitters do not shine alike in all directions.
    with_pattern: usize,
}

/// The selected emitters in the form that the kernel reads.
#[derive(Clone, Copy)]
pub struct Selection<'c, E> {
    /// In the order in which they are summed.
    pub emitters: &'c [PlacedEmitter<E>],
    /// Ends of the blocks whose sums are added with compensation; `None` if there is only one block.
    pub block_ends: Option<&'c [usize]>,
    /// See [`Chosen`].
    pub asked_for: &'c [(usize, usize)],
    /// Whether all of them shine alike in all directions.
    pub are_isotropic: bool,
}

/// A ball that holds the emitters of a block.
#[derive(Clone, Copy)]
struct Ball {
    center: Vector,
    radius: f64,
}

impl Lighting {
    /// The lights of a scene; `asked_for` lists those whose own irradiance is requested.
    pub fn new(scene: &PreparedScene, asked_for: &[usize]) -> Self {
        let mut places = vec![None; scene.scene().lights().len()];
        for (place, light) in asked_for.iter().enumerate() {
            places[*light] = Some(place);
        }
        Self { order: by_place(scene.emitters()), asked_for: places }
    }

    /// The emitters of nonzero intensity in the order in which they are summed, as indices among the scene's.
    pub fn shining(&self, scene: &PreparedScene) -> impl Iterator<Item = usize> {
        let all = scene.emitters().all();
        self.order.iter().copied().filter(|index| all[*index].intensity > 0.0)
    }

    /// Computes the emitters as seen from a sphere.
    pub fn place(&self, scene: &PreparedScene, sphere: &Sphere, emitters: &mut ShapeEmitters) {
        let ShapeEmitters { placed, indices, distances, blocks } = emitters;
        let all = scene.emitters().all();
        placed.clear();
        indices.clear();
        distances.clear();
        blocks.clear();
        indices.extend(self.shining(scene));
        placed.extend(indices.iter().map(|index| all[*index].seen_from::<f64>(sphere.center).in_unit(sphere.radius)));
        if placed.len() > BLOCK {
            distances.extend(placed.iter().map(|emitter| emitter.position.length()));
            blocks.extend(placed.chunks(BLOCK).map(Ball::around));
        }
    }
}

/// The emitters of a scene in the order in which they are summed. That is the order of the scene, unless they form blocks:
/// then they follow a space-filling curve (Morton order), so that blocks are small in space, with the parallel ones, which
/// have no position, at the end.
fn by_place(emitters: &Emitters) -> Vec<usize> {
    let emitters = emitters.all();
    let mut order: Vec<usize> = (0..emitters.len()).collect();
    if emitters.len() <= BLOCK {
        return order;
    }
    let coordinates = || emitters.iter().filter_map(Emitter::place).flat_map(Vector::to_array);
    let low = coordinates().fold(f64::INFINITY, f64::min);
    let size = (coordinates().fold(f64::NEG_INFINITY, f64::max) - low).max(f64::MIN_POSITIVE);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and 2^20")]
    let cell = |x: f64| ((x - low) / size * 1_048_575.0) as u64;
    order.sort_by_cached_key(|&index| {
        let Some(position) = emitters[index].place() else { return u64::MAX };
        let cells = position.to_array().map(cell);
        (0..20).rev().fold(0_u64, |key, bit| cells.iter().fold(key, |key, cell| (key << 1) | ((cell >> bit) & 1)))
    });
    order
}

impl ShapeEmitters {
    /// Each emitter, with its index among the scene's.
    pub fn iter(&self) -> impl Iterator<Item = (usize, &PlacedEmitter)> {
        self.indices.iter().copied().zip(&self.placed)
    }

    /// The number of emitters.
    pub fn len(&self) -> usize {
        self.placed.len()
    }

    /// Whether single precision can hold them, the ambient light, and the highlight of a formula. At a terminator where B
    /// jumps, it would put pixels on the wrong side.
    pub fn fit_single(&self, ambient: f64, formula: &BrightnessFormula) -> bool {
        let fits = |emitter: &PlacedEmitter| {
            let distance = emitter.position.length();
            let is_near = distance < FARTHEST_IN_SINGLE && distance - 1.0 >= NEAREST_IN_SINGLE;
            let has_digits = match emitter.pattern {
                Pattern::Parallel => true,
                Pattern::Cone(cone) => is_near && cone.steepest() <= STEEPEST_IN_SINGLE,
                Pattern::Isotropic | Pattern::Lambertian { .. } => is_near,
            };
            has_digits && INTENSITIES_IN_SINGLE.contains(&emitter.intensity)
        };
        let ambient_fits = ambient == 0.0 || INTENSITIES_IN_SINGLE.contains(&ambient);
        let highlight_fits = formula.sharpness().is_none_or(|n| SHININESS_IN_SINGLE.contains(&n));
        ambient_fits && highlight_fits && !formula.jumps_at_terminator() && self.placed.iter().all(fits)
    }
}

impl<E: Element> Chosen<E> {
    /// Empties the selection.
    fn clear(&mut self) {
        self.emitters.clear();
        self.block_ends.clear();
        self.asked_for.clear();
        self.with_pattern = 0;
    }

    /// Selects all emitters of a shape.
    pub fn choose_all(&mut self, scene: &PreparedScene, lighting: &Lighting, shape: &ShapeEmitters) {
        self.clear();
        for (index, placed) in shape.iter() {
            self.push(scene, lighting, index, placed);
        }
        self.end_blocks_by_count();
    }

    /// Selects the emitters that may be above the horizon of any point of a cap, given by the direction of its middle and
    /// the largest distance of its points from there, in radii. An emitter at S is above the horizon of the point N of the
    /// unit sphere if N·S > 1, a parallel one if N·L > 0. Each is tested individually, except in a block that is below as a
    /// whole.
    pub fn choose_above_horizon(
        &mut self,
        scene: &PreparedScene,
        lighting: &Lighting,
        shape: &ShapeEmitters,
        (middle, reach): (Vector, f64),
    ) {
        self.clear();
        // Single precision rounds N·S to about 1e-7 of ‖S‖: with this margin, whatever is skipped is dark in any case.
        let spare = |distance: f64| 1e-6 * (1.0 + distance);
        for (number, block) in shape.blocks.iter().enumerate() {
            if let Some(Ball { center, radius }) = block {
                let farthest = center.length() + radius;
                let highest = middle.dot(*center) + radius + reach * farthest;
                if highest + spare(farthest) < 1.0 {
                    continue;
                }
            }
            let end = ((number + 1) * BLOCK).min(shape.len());
            for place in number * BLOCK..end {
                let placed = &shape.placed[place];
                let distance = shape.distances[place];
                let horizon = if placed.pattern.is_parallel() { 0.0 } else { 1.0 };
                if middle.dot(placed.position) + reach * distance + spare(distance) >= horizon {
                    self.push(scene, lighting, shape.indices[place], placed);
                }
            }
        }
        self.end_blocks_by_count();
    }

    /// Selects some of a shape's emitters, given by their positions in the order of the sum and their indices among the scene's,
    /// with the values that they have in a layer. Blocks are those of all emitters, whichever are selected.
    pub fn choose(
        &mut self,
        layer: &PreparedScene,
        lighting: &Lighting,
        chosen: &[(usize, usize)],
        place: impl Fn(&Emitter) -> PlacedEmitter,
    ) {
        self.clear();
        let mut block = 0;
        for (position, index) in chosen {
            if position / BLOCK != block {
                block = position / BLOCK;
                self.end_block();
            }
            self.push(layer, lighting, *index, &place(&layer.emitters().all()[*index]));
        }
        self.end_block();
    }

    /// Adds an emitter, given by its index among the scene's and by how it is seen.
    #[inline(always)]
    fn push(&mut self, scene: &PreparedScene, lighting: &Lighting, index: usize, placed: &PlacedEmitter) {
        if let Some(place) = lighting.asked_for[scene.emitters().all()[index].light] {
            self.asked_for.push((place, self.emitters.len()));
        }
        self.with_pattern += usize::from(placed.pattern != Pattern::Isotropic);
        self.emitters.push(placed.map(E::from_f64));
    }

    /// Ends a block after the last emitter, unless the block is empty.
    #[inline(always)]
    fn end_block(&mut self) {
        let end = self.emitters.len();
        if self.block_ends.last().copied().unwrap_or(0) < end {
            self.block_ends.push(end);
        }
    }

    /// Makes blocks of a fixed number of emitters.
    fn end_blocks_by_count(&mut self) {
        let count = self.emitters.len();
        self.block_ends.extend((1..=count.div_ceil(BLOCK)).map(|number| (number * BLOCK).min(count)));
    }

    /// The selection in the form that the kernel reads.
    #[inline(always)]
    pub fn selection(&self) -> Selection<'_, E> {
        let Self { emitters, block_ends, asked_for, with_pattern } = self;
        let block_ends = (block_ends.len() > 1).then_some(block_ends.as_slice());
        Selection { emitters, block_ends, asked_for, are_isotropic: *with_pattern == 0 }
    }
}

impl Ball {
    #[expect(clippy::cast_precision_loss, reason = "a block is small")]
    fn around(emitters: &[PlacedEmitter]) -> Option<Self> {
        if emitters.iter().any(|emitter| emitter.pattern.is_parallel()) {
            return None;
        }
        let sum = emitters.iter().fold(Vector::default(), |sum, emitter| sum + emitter.position);
        let center = sum * (1.0 / emitters.len() as f64);
        let distance = |emitter: &PlacedEmitter| (emitter.position - center).length();
        // Slightly enlarged, because rounding to single precision moves the emitters.
        let radius = emitters.iter().map(distance).fold(0.0, f64::max);
        Some(Self { center, radius: radius + 1e-6 * (radius + center.length()) })
    }
}
