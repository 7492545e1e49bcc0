//! Brightness at many given points of spheres, several points at a time.

use super::kernel::{Sums, sum};
use super::lights::{ShapeLights, ShapeShading, by_place};
use super::power::{NoPower, Power};
use crate::camera::Projection;
use crate::lanes::{Instructions, Lane, LaneJob, Precision, SimdToken};
use crate::prepare::PreparedScene;
use crate::reflectance::{BrightnessFormula, Lobe};
use crate::shape::{Geometry, Primitive, Sphere, SurfacePoint};
use crate::units::LengthUnit;
use crate::vector::Vector;

/// Computes the brightness at given points of a scene of a few spheres.
///
/// Values agree with those of [`PreparedScene::probe`] to 1e-12 relative, where cosθ_i and cosθ_o exceed 1e-3.
pub struct PointKernel<'s> {
    spheres: Vec<PointSphere<'s>>,
    length: LengthUnit,
    instructions: Instructions,
}

/// What becomes of the points of a slice: its arrays are as long.
#[derive(Debug)]
pub struct PointValues<'v> {
    /// B, in the convention's unit; NaN on no surface.
    pub brightness: &'v mut [f64],
    /// E, in W/m² or lx; NaN on no surface.
    pub irradiance: &'v mut [f64],
    /// Index of the shape; −1 on no surface.
    pub shape: &'v mut [i32],
}

/// A sphere, and the lights as its centre sees them, in its radii.
struct PointSphere<'s> {
    sphere: Sphere,
    index: f64,
    eye: Vector,
    /// 1, or −1 where the eye is inside and sees that side.
    side: f64,
    tolerance: f64,
    formula: &'s BrightnessFormula,
    lights: ShapeLights<f64>,
}

/// Each point asks each sphere.
const FEW: usize = 16;

/// A sharper highlight multiplies rounding errors beyond what is promised.
const SHARPEST: f64 = 512.0;

impl<'s> PointKernel<'s> {
    /// Of a scene of a few spheres that stand in nobody's light, without colours and with blunt highlights, seen from a point;
    /// nothing for others, whose points are probed one by one.
    #[must_use]
    pub fn new(scene: &'s PreparedScene) -> Option<Self> {
        let description = scene.scene();
        let shapes = description.shapes();
        let is_parallel = matches!(description.camera().projection, Projection::Orthographic(_));
        let is_shadowed = scene.casts_shadows_between_shapes();
        if shapes.is_empty() || shapes.len() > FEW || is_parallel || is_shadowed || description.color().is_some() {
            return None;
        }
        let order = by_place(description.lights());
        let sphere = |(index, shape): (usize, &crate::scene::Shape)| {
            let Geometry::Sphere(sphere) = shape.geometry else { return None };
            let primitive = Primitive { shape: index, part: 0 };
            let formula = scene.formula(primitive);
            let is_sharp = formula.sharpness().is_some_and(|n| n > SHARPEST);
            let lights = ShapeShading::new(scene, primitive, &sphere, &order, &[], Precision::Double);
            let ShapeShading::Double(lights) = lights else { return None };
            let eye = (description.camera().eye - sphere.center) * (1.0 / sphere.radius);
            let side = if shape.geometry.part_encloses(0, description.camera().eye) { -1.0 } else { 1.0 };
            let tolerance = shape.geometry.surface_tolerance(sphere.center);
            let index = f64::from(u8::try_from(index).ok()?);
            (!is_sharp).then_some(PointSphere { sphere, index, eye, side, tolerance, formula, lights })
        };
        let spheres: Option<Vec<_>> = shapes.iter().enumerate().map(sphere).collect();
        Some(Self { spheres: spheres?, length: description.length(), instructions: Instructions::best() })
    }

    /// Computes the values at points in the scene's unit; comes to the number of those that are on no surface, to
    /// [`Geometry::surface_tolerance`]. With `snaps` there are none: each counts as the point of the nearest surface.
    ///
    /// # Panics
    /// With arrays that are not as long as the points.
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

/// As many numbers as a vector may have.
const MOST: usize = 32;

impl LaneJob for Fill<'_, '_> {
    type Output = usize;

    #[inline(always)]
    fn run<S, D>(self, token: S::Token) -> usize
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>,
    {
        const { assert!(D::COUNT <= MOST) }
        let Self { kernel, points, snaps, values } = self;
        let mut misses = 0;
        for (number, points) in points.chunks(D::COUNT).enumerate() {
            let found = kernel.values::<D>(token, points, snaps);
            let start = number * D::COUNT;
            let (mut brightness, mut irradiance, mut shape) = ([0.0; MOST], [0.0; MOST], [0.0; MOST]);
            found.brightness.store(&mut brightness);
            found.irradiance.store(&mut irradiance);
            found.shape.store(&mut shape);
            for lane in 0..points.len() {
                let is_miss = shape[lane] < 0.0;
                misses += usize::from(is_miss);
                values.brightness[start + lane] = if is_miss { f64::NAN } else { brightness[lane] };
                values.irradiance[start + lane] = if is_miss { f64::NAN } else { irradiance[lane] };
                #[expect(clippy::cast_possible_truncation, reason = "a small whole number")]
                let index = shape[lane] as i32;
                values.shape[start + lane] = index;
            }
        }
        misses
    }
}

/// What is found at a vector of points.
struct Found<V> {
    brightness: V,
    irradiance: V,
    /// −1 where there is no surface.
    shape: V,
}

impl PointKernel<'_> {
    #[inline(always)]
    fn values<V: Lane<Element = f64>>(&self, token: V::Token, points: &[[f64; 3]], snaps: bool) -> Found<V> {
        let mut coordinates = [[0.0; MOST]; 3];
        for lane in 0..V::COUNT {
            // What is left over of the last vector repeats its last point.
            let point = points[lane.min(points.len() - 1)];
            for axis in 0..3 {
                coordinates[axis][lane] = self.length.to_metres(point[axis]);
            }
        }
        let [x, y, z] = &coordinates;
        let point = Vector::new(V::load(token, x), V::load(token, y), V::load(token, z));
        let (shape, distance) = self.nearest(token, point, snaps);
        let zero = V::splat(token, 0.0);
        let (mut brightness, mut irradiance) = (zero, zero);
        for sphere in &self.spheres {
            let index = V::splat(token, sphere.index);
            let apart = (shape - index).max(index - shape);
            let is_here = apart.is_less(V::splat(token, 0.5));
            if V::bits(is_here) != 0 {
                let from_center = point - splat(token, sphere.sphere.center);
                let outward = direction(token, from_center, distance);
                let (of_brightness, of_irradiance) = sphere.shade(token, outward);
                brightness = V::select(is_here, of_brightness, brightness);
                irradiance = V::select(is_here, of_irradiance, irradiance);
            }
        }
        Found { brightness, irradiance, shape }
    }

    /// The index of the sphere whose surface is nearest, −1 where it is not near enough; and the distance from its centre.
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

#[inline(always)]
fn splat<V: Lane<Element = f64>>(token: V::Token, vector: Vector) -> Vector<V> {
    Vector::new(V::splat(token, vector.x), V::splat(token, vector.y), V::splat(token, vector.z))
}

/// The unit vector of a length; of none, that which [`Sphere::nearest`] takes.
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
    /// Brightness and irradiance of points in these directions.
    #[inline(always)]
    fn shade<V: Lane<Element = f64>>(&self, token: V::Token, outward: Vector<V>) -> (V, V) {
        match &self.lights.power {
            Power::None => self.shade_with(token, outward, &NoPower),
            Power::Even(lobe) => self.shade_with(token, outward, lobe),
            Power::Odd(lobe) => self.shade_with(token, outward, lobe),
            Power::Any(lobe) => self.shade_with(token, outward, lobe),
        }
    }

    #[inline(always)]
    fn shade_with<V: Lane<Element = f64>, L: Lobe<V>>(&self, token: V::Token, outward: Vector<V>, lobe: &L) -> (V, V) {
        token.in_own_function(
            #[inline(always)]
            || {
                let normal = outward * V::splat(token, self.side);
                let to_eye = splat(token, self.eye) - outward;
                let view = to_eye * (V::splat(token, 1.0) / to_eye.dot(to_eye).sqrt());
                let cos_theta_o = normal.dot(view);
                let point = SurfacePoint { anchor: self.sphere.center, offset: outward, normal, view, cos_theta_o };
                let (irradiance, lobes) = sum(token, &point, &self.lights.lights, lobe);
                let irradiance = irradiance + V::splat(token, self.lights.ambient);
                let sums = Sums { irradiance, lobes, cos_theta_o };
                (sums.diffuse(self.formula) + sums.specular(self.formula), irradiance)
            },
        )
    }
}
