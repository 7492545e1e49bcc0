//! Brightness at many given points on spheres, several points at a time.

use super::shading::block::{POINTS, ShadedBlock, SurfaceBlock};
use super::shading::emitters::{Chosen, Lighting, ShapeEmitters};
use super::shading::kernel::{PerPoint, ShadeBlock};
use super::shading::lobe::Power;
use super::vectors::splat;
use crate::camera::Projection;
use crate::lanes::{Instructions, Lane, LaneJob, Precision};
use crate::light::Ambient;
use crate::prepare::PreparedScene;
use crate::reflectance::BrightnessFormula;
use crate::shape::{Geometry, Primitive, Sphere, SurfacePoint};
use crate::units::LengthUnit;
use crate::vector::Vector;

/// Computes the brightness at given points of a scene with a few spheres.
///
/// Values agree with those of [`PreparedScene::probe`] to 1e-12 relative, where cosθ_i and cosθ_o exceed 1e-3.
pub struct PointKernel<'s> {
    spheres: Vec<PointSphere<'s>>,
    length: LengthUnit,
    instructions: Instructions,
}

/// The output for a slice of points: each array is as long as the slice.
#[derive(Debug)]
pub struct PointValues<'v> {
    /// B, in the convention's unit; NaN where there is no surface.
    pub brightness: &'v mut [f64],
    /// E, in W/m² or lx; NaN where there is no surface.
    pub irradiance: &'v mut [f64],
    /// Index of the shape; −1 where there is no surface.
    pub shape: &'v mut [i32],
}

/// A sphere, and the lights as seen from its centre, in units of its radius.
struct PointSphere<'s> {
    sphere: Sphere,
    index: f64,
    eye: Vector,
    /// 1, or −1 if the eye is inside and sees the inner side.
    side: f64,
    tolerance: f64,
    formula: &'s BrightnessFormula,
    power: Power,
    emitters: Chosen<f64>,
    ambient: f64,
}

/// Each point is tested against each sphere, so there must be few.
const FEW: usize = 16;

/// A sharper highlight would amplify rounding errors beyond the promised accuracy.
const SHARPEST: f64 = 512.0;

impl<'s> PointKernel<'s> {
    /// For a scene of a few spheres that do not shadow each other, without colours and with blunt highlights, seen from a
    /// point; `None` for other scenes, whose points are probed one by one.
    #[must_use]
    pub fn new(scene: &'s PreparedScene) -> Option<Self> {
        let description = scene.scene();
        let shapes = description.shapes();
        let is_parallel = matches!(description.camera().projection, Projection::Orthographic(_));
        let is_shadowed = scene.casts_shadows_between_shapes();
        if shapes.is_empty() || shapes.len() > FEW || is_parallel || is_shadowed || description.color().is_some() {
            return None;
        }
        let lighting = Lighting::new(scene, &[]);
        let sphere = |(index, shape): (usize, &crate::scene::Shape)| {
            let Geometry::Sphere(sphere) = shape.geometry else { return None };
            let primitive = Primitive { shape: index, part: 0 };
            let formula = scene.formula(primitive);
            let is_sharp = formula.sharpness().is_some_and(|n| n > SHARPEST);
            let (mut placed, mut emitters) = (ShapeEmitters::default(), Chosen::default());
            lighting.place(scene, &sphere, &mut placed);
            emitters.choose_all(scene, &lighting, &placed);
            let power = Power::of(formula, Precision::Double);
            let ambient = description.ambient().map_or(0.0, Ambient::unobstructed_irradiance);
            let eye = (description.camera().eye - sphere.center) * (1.0 / sphere.radius);
            let side = if shape.geometry.part_encloses(0, description.camera().eye) { -1.0 } else { 1.0 };
            let tolerance = shape.geometry.surface_tolerance(sphere.center);
            let index = f64::from(u8::try_from(index).ok()?);
            (!is_sharp).then_some(PointSphere {
                sphere,
                index,
                eye,
                side,
                tolerance,
                formula,
                power,
                emitters,
                ambient,
            })
        };
        let spheres: Option<Vec<_>> = shapes.iter().enumerate().map(sphere).collect();
        Some(Self { spheres: spheres?, length: description.length(), instructions: Instructions::best() })
    }

    /// Computes the values at points given in the scene's unit; returns how many of them are on no surface, to
    /// [`Geometry::surface_tolerance`]. With `snaps`, there are none: each is moved to the nearest surface.
    ///
    /// # Panics
    /// If the arrays are not as long as the points.
    #[must_use]
    pub fn fill(&self, points: &[[f64; 3]], snaps: bool, values: &mut PointValues<'_>) -> usize {
        let PointValues { brightness, irradiance, shape } = values;
        let lengths = [brightness.len(), irradiance.len(), shape.len()];
        assert_eq!(lengths, [points.len(); 3], "as many values as points");
        self.instructions.run(Fill { kernel: self, points, snaps, values })
    }
}

struct Fill<'f, 'v> {
    kernel: &'f PointKernel<'f>,
    points: &'f [[f64; 3]],
    snaps: bool,
    values: &'f mut PointValues<'v>,
}

/// Room for a block of points, plus the rest of the last vector.
const SIZE: usize = POINTS + 32;

impl LaneJob for Fill<'_, '_> {
    type Output = usize;

    #[inline(always)]
    fn run<S, D>(self, token: S::Token) -> usize
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>,
    {
        let Self { kernel, points, snaps, values } = self;
        let mut work = Work {
            coordinates: [[0.0; SIZE]; 3],
            shape: [0.0; SIZE],
            distance: [0.0; SIZE],
            indices: Vec::with_capacity(POINTS),
            points: SurfaceBlock::new(),
            shaded: ShadedBlock::new(0),
        };
        let mut misses = 0;
        for (number, points) in points.chunks(POINTS).enumerate() {
            let start = number * POINTS;
            work.find::<D>(token, kernel, points, snaps);
            for (lane, shape) in work.shape[..points.len()].iter().enumerate() {
                #[expect(clippy::cast_possible_truncation, reason = "a small whole number")]
                let index = *shape as i32;
                values.shape[start + lane] = index;
                if index < 0 {
                    misses += 1;
                    values.brightness[start + lane] = f64::NAN;
                    values.irradiance[start + lane] = f64::NAN;
                }
            }
            for sphere in &kernel.spheres {
                work.gather(sphere, points.len());
                work.shade::<D>(token, kernel.instructions, sphere);
                for (point, index) in work.indices.iter().enumerate() {
                    values.brightness[start + index] = work.shaded.brightness[point];
                    values.irradiance[start + index] = work.shaded.irradiance[point];
                }
            }
        }
        misses
    }
}

/// Scratch memory for a block of points.
struct Work {
    /// Coordinates of the points, in metres; then gathered for those on one sphere.
    coordinates: [[f64; SIZE]; 3],
    /// The index of each point's sphere, −1 where there is no surface.
    shape: [f64; SIZE],
    /// The distance of each point from the centre of its sphere.
    distance: [f64; SIZE],
    /// The points that are on the current sphere.
    indices: Vec<usize>,
    points: Box<SurfaceBlock<f64>>,
    shaded: Box<ShadedBlock<f64>>,
}

impl Work {
    /// Finds the surface of each point.
    #[inline(always)]
    fn find<V: Lane<Element = f64>>(
        &mut self,
        token: V::Token,
        kernel: &PointKernel<'_>,
        points: &[[f64; 3]],
        snaps: bool,
    ) {
        for lane in 0..points.len().next_multiple_of(V::COUNT) {
            // The unused lanes of the last vector repeat its last point.
            let point = points[lane.min(points.len() - 1)];
            for (coordinates, coordinate) in self.coordinates.iter_mut().zip(point) {
                coordinates[lane] = kernel.length.to_metres(coordinate);
            }
        }
        for at in (0..points.len()).step_by(V::COUNT) {
            let [x, y, z] = &self.coordinates;
            let point = Vector::new(V::load(token, &x[at..]), V::load(token, &y[at..]), V::load(token, &z[at..]));
            let (shape, distance) = kernel.nearest(token, point, snaps);
            shape.store(&mut self.shape[at..]);
            distance.store(&mut self.distance[at..]);
        }
    }

    /// Gathers the points of a sphere.
    fn gather(&mut self, sphere: &PointSphere<'_>, count: usize) {
        let is_here = |index: &usize| (self.shape[*index] - sphere.index).abs() < 0.5;
        self.indices.clear();
        self.indices.extend((0..count).filter(is_here));
        (self.points.count, self.points.anchor, self.points.unit) =
            (self.indices.len(), sphere.sphere.center, sphere.sphere.radius);
    }

    /// Shades the gathered points.
    #[inline(always)]
    fn shade<V: Lane<Element = f64>>(&mut self, token: V::Token, instructions: Instructions, sphere: &PointSphere<'_>) {
        let Self { coordinates, distance, indices, points, shaded, .. } = self;
        let Some(last) = indices.last() else { return };
        let [x, y, z] = &*coordinates;
        let pick = |numbers: &[f64; SIZE]| {
            let mut picked = [0.0; SIZE];
            let indices = indices.iter().chain(std::iter::repeat(last));
            picked.iter_mut().zip(indices).for_each(|(picked, index)| *picked = numbers[*index]);
            picked
        };
        let picked = [x, y, z, distance].map(pick);
        for at in (0..indices.len()).step_by(V::COUNT) {
            let [x, y, z, distance] = picked.each_ref().map(
                #[inline(always)]
                |numbers| V::load(token, &numbers[at..]),
            );
            points.store_point(at, &sphere.point(token, Vector::new(x, y, z), distance));
        }
        points.ambient[..indices.len().next_multiple_of(V::COUNT)].fill(sphere.ambient);
        instructions.run(ShadeBlock {
            points,
            formula: sphere.formula,
            power: &sphere.power,
            selection: sphere.emitters.selection(),
            visibility: PerPoint::ALL,
            shaded,
        });
    }
}

impl PointKernel<'_> {
    /// The index of the sphere whose surface is nearest, −1 if it is not near enough, and the distance from its centre.
    #[inline(always)]
    fn nearest<V: Lane<Element = f64>>(&self, token: V::Token, point: Vector<V>, snaps: bool) -> (V, V) {
        let mut nearest = V::splat(token, f64::INFINITY);
        let mut shape = V::splat(token, -1.0);
        let mut distance = V::splat(token, 1.0);
        for sphere in &self.spheres {
            let from_center = point - splat(token, sphere.sphere.center);
            let length = from_center.dot(from_center).sqrt();
            let above = length - V::splat(token, sphere.sphere.radius);
            let gap = above.max(-above);
            let is_nearer = gap.is_less(nearest);
            let tolerance = V::splat(token, if snaps { f64::INFINITY } else { sphere.tolerance });
            let index = V::splat(token, sphere.index);
            let there = V::select(tolerance.is_less(gap), V::splat(token, -1.0), index);
            nearest = V::select(is_nearer, gap, nearest);
            shape = V::select(is_nearer, there, shape);
            distance = V::select(is_nearer, length, distance);
        }
        (shape, distance)
    }
}

/// The unit vector along a vector of known length; for a zero vector, the direction that [`Sphere::nearest`] chooses.
#[inline(always)]
fn direction<V: Lane<Element = f64>>(token: V::Token, vector: Vector<V>, length: V) -> Vector<V> {
    let zero = V::splat(token, 0.0);
    let has_length = zero.is_less(length);
    let inverse = V::splat(token, 1.0) / V::select(has_length, length, V::splat(token, 1.0));
    let Vector { x, y, z } = vector * inverse;
    Vector::new(
        V::select(has_length, x, zero),
        V::select(has_length, y, zero),
        V::select(has_length, z, V::splat(token, -1.0)),
    )
}

impl PointSphere<'_> {
    /// The point of the sphere in the direction of a place, given with its distance from the centre.
    #[inline(always)]
    fn point<V: Lane<Element = f64>>(&self, token: V::Token, place: Vector<V>, distance: V) -> SurfacePoint<V> {
        let outward = direction(token, place - splat(token, self.sphere.center), distance);
        let normal = outward * V::splat(token, self.side);
        let to_eye = splat(token, self.eye) - outward;
        let view = to_eye * (V::splat(token, 1.0) / to_eye.dot(to_eye).sqrt());
        SurfacePoint { anchor: self.sphere.center, offset: outward, normal, view, cos_theta_o: normal.dot(view) }
    }
}
