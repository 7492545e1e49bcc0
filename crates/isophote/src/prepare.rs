//! A scene laid out for tracing and shading. It chooses no renderer.

use std::ops::Range;
use std::sync::OnceLock;

use crate::camera::{CameraFrame, ScreenPosition};
use crate::double_double::DoubleDouble;
use crate::map::Pixel;
use crate::real::Scalar;
use crate::reflectance::{BrightnessFormula, Reflectance};
use crate::scene::Scene;
use crate::shade::{LightTerm, Shading, light_term, shade};
use crate::shape::{Geometry, Intersection, Located, Outline, Ray, SurfacePoint};
use crate::tolerance;
use crate::vector::Vector;

/// A scene with everything computed that does not depend on the pixel.
#[derive(Clone, Debug)]
pub struct PreparedScene {
    scene: Scene,
    frame: CameraFrame<f64>,
    precise_frame: CameraFrame<DoubleDouble>,
    shapes: Vec<PreparedShape>,
    /// Written when the first map asks for it.
    source_text: OnceLock<String>,
}

#[derive(Clone, Debug)]
struct PreparedShape {
    geometry: Geometry,
    formula: BrightnessFormula,
    eye_inside: bool,
    /// For each light, v_j of a point that is seen from inside; empty where the eye is outside.
    light_inside: Vec<bool>,
    /// Rays whose clearance is between these are traced with 32 digits: see [`TracingError`].
    doubtful_clearance: Range<f64>,
    /// Where it appears on the screen; found when a renderer first asks, as probes never do.
    outline: OnceLock<Outline>,
    /// As `doubtful_clearance`, for clearances by the outline.
    doubtful_in_outline: Range<f64>,
}

/// What a ray from the eye meets first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit<T = f64> {
    /// Index of the shape.
    pub shape: usize,
    /// t, the distance from the eye in metres (2.2).
    pub distance: T,
    /// The point.
    pub point: SurfacePoint<T>,
}

impl PreparedScene {
    /// Lays a scene out.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        let frame = CameraFrame::new(&scene.camera);
        let steepest_edge = scene.lights.iter().map(crate::light::Light::steepest_edge).fold(0.0, f64::max);
        let prepare = |shape: &crate::scene::Shape| {
            let geometry = shape.geometry;
            let is_inside = |point| geometry.signed_distance(point) < 0.0;
            let eye_inside = is_inside(frame.eye);
            let inside = |light: &crate::light::Light| light.position().is_some_and(is_inside);
            let no_material = Reflectance { diffuse: 0.0, specular: 0.0, shininess: 1.0 };
            let material = shape.material.map_or(no_material, |index| scene.materials[index].reflectance);
            let formula = BrightnessFormula::new(scene.convention, &material);
            PreparedShape {
                geometry,
                formula,
                eye_inside,
                light_inside: if eye_inside { scene.lights.iter().map(inside).collect() } else { Vec::new() },
                doubtful_clearance: ray_error(&geometry, frame.eye).doubtful_clearance(&formula, steepest_edge),
                outline: OnceLock::new(),
                doubtful_in_outline: ERROR_IN_OUTLINE.doubtful_clearance(&formula, steepest_edge),
            }
        };
        let shapes = scene.shapes.iter().map(prepare).collect();
        Self {
            scene: scene.clone(),
            precise_frame: CameraFrame::new(&scene.camera),
            frame,
            shapes,
            source_text: OnceLock::new(),
        }
    }

    /// The scene it was made from.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The scene it was made from, as a TOML scene file.
    #[must_use]
    pub fn source_text(&self) -> &str {
        self.source_text.get_or_init(|| self.scene.source.to_toml())
    }

    /// The camera's axes.
    #[must_use]
    pub fn frame(&self) -> &CameraFrame {
        &self.frame
    }

    /// What the ray through a place on the screen meets first (2.1), (2.2).
    ///
    /// cosθ_o of a double has an error that grows without bound towards the silhouette; rays that come near it are
    /// traced again with 32 digits, so that the bound on the error holds at every visible pixel.
    #[must_use]
    pub fn trace(&self, position: ScreenPosition) -> Option<Hit> {
        let Traced { hit, is_doubtful } = self.nearest(&self.frame.ray(position), 0..self.shapes.len());
        if is_doubtful { self.trace_precisely(position).map(Hit::rounded) } else { hit }
    }

    /// What the ray through a place on the screen meets first, with 32 digits.
    #[must_use]
    pub fn trace_precisely(&self, position: ScreenPosition) -> Option<Hit<DoubleDouble>> {
        self.trace_precisely_among(position, 0..self.shapes.len())
    }

    /// The same, when it can only be one of these shapes.
    pub(crate) fn trace_precisely_among(
        &self,
        position: ScreenPosition,
        shapes: impl Iterator<Item = usize>,
    ) -> Option<Hit<DoubleDouble>> {
        self.nearest(&self.precise_frame.ray(position), shapes).hit
    }

    /// Where a shape appears on the screen.
    #[must_use]
    pub fn outline(&self, shape: usize) -> &Outline {
        let shape = &self.shapes[shape];
        shape.outline.get_or_init(|| {
            if shape.eye_inside { Outline::Unknown } else { shape.geometry.outline(&self.precise_frame) }
        })
    }

    /// For which clearances in its outline a shape has to be traced with 32 digits.
    pub(crate) fn doubtful_in_outline(&self, shape: usize) -> &Range<f64> {
        &self.shapes[shape].doubtful_in_outline
    }

    /// What is seen at a pixel of the full image.
    #[must_use]
    pub fn trace_pixel(&self, pixel: Pixel) -> Option<Hit> {
        self.trace(ScreenPosition::PixelCenter(pixel))
    }

    /// Index of the shape that the eye meets first in the direction of a point, on the screen or not.
    #[must_use]
    pub fn first_shape_towards(&self, point: Vector) -> Option<usize> {
        let ray = Ray { origin: self.frame.eye, direction: (point - self.frame.eye).normalized() };
        self.nearest(&ray, 0..self.shapes.len()).hit.map(|hit| hit.shape)
    }

    fn nearest<T: Scalar>(&self, ray: &Ray<T>, shapes: impl Iterator<Item = usize>) -> Traced<T> {
        let mut nearest: Option<Hit<T>> = None;
        let mut is_doubtful = false;
        for index in shapes {
            let shape = &self.shapes[index];
            let approach = shape.geometry.approach(ray, shape.eye_inside);
            let doubtful = &shape.doubtful_clearance;
            is_doubtful |= T::from_f64(doubtful.start).is_less(approach.clearance)
                && approach.clearance.is_less(T::from_f64(doubtful.end));
            if !T::zero().is_less(approach.clearance) {
                continue;
            }
            let Intersection { distance, point } = shape.geometry.intersection(ray, shape.eye_inside, &approach);
            let ahead_by = nearest.map(|nearest| nearest.distance - distance);
            // Where surfaces cross, the order of their distances is as uncertain as the distances.
            let uncertain = T::from_f64(ERROR_OF_DISTANCE) * distance;
            is_doubtful |= ahead_by.is_some_and(|by| by.is_less(uncertain) && (-uncertain).is_less(by));
            if ahead_by.is_none_or(|by| T::zero().is_less(by)) {
                nearest = Some(Hit { shape: index, distance, point });
            }
        }
        Traced { hit: nearest, is_doubtful }
    }

    /// The brightness of a surface point by the scene's convention, summed over the lights; `each` sees every
    /// light's own term.
    pub fn shade<T: Scalar>(
        &self,
        shape: usize,
        point: &SurfacePoint<T>,
        each: impl FnMut(usize, &LightTerm<T>),
    ) -> Shading<T> {
        let visibility = |light| T::from_f64(self.visibility(shape, light));
        let ambient = T::from_f64(self.ambient_irradiance());
        shade(point, &self.scene.lights, &self.shapes[shape].formula, ambient, visibility, each)
    }

    /// One light's term of the sum at a surface point.
    #[must_use]
    pub fn light_term(&self, shape: usize, point: &SurfacePoint, light: usize) -> LightTerm {
        let placed = self.scene.lights[light].seen_from(point.anchor);
        light_term(point, &placed, self.visibility(shape, light), &self.shapes[shape].formula.lobe())
    }

    /// The convention applied to a shape's material.
    #[must_use]
    pub fn formula(&self, shape: usize) -> &BrightnessFormula {
        &self.shapes[shape].formula
    }

    /// v_j of (3.1): 1, or 0 where the shape's own wall stands between a point that is seen from inside and a light
    /// outside. Shadows of other shapes are not cast yet; this is their place.
    #[must_use]
    pub fn visibility(&self, shape: usize, light: usize) -> f64 {
        let shape = &self.shapes[shape];
        if shape.eye_inside && !shape.light_inside[light] { 0.0 } else { 1.0 }
    }

    /// E_a (3.9): the irradiance of any surface point by the ambient light. What the scene takes of it is not subtracted
    /// yet; this is its place.
    #[must_use]
    pub fn ambient_irradiance(&self) -> f64 {
        self.scene.ambient.map_or(0.0, |ambient| ambient.unobstructed_irradiance())
    }

    /// A point of a surface as the eye sees it, also where the eye cannot: cosθ_o is then negative.
    #[must_use]
    pub fn surface_point(&self, located: &Located) -> SurfacePoint {
        let nearest = &located.nearest;
        let inside = self.shapes[located.shape].eye_inside;
        let normal = if inside { -nearest.outward_normal } else { nearest.outward_normal };
        let view = ((self.frame.eye - nearest.anchor) - nearest.offset).normalized();
        SurfacePoint { anchor: nearest.anchor, offset: nearest.offset, normal, view, cos_theta_o: normal.dot(view) }
    }
}

/// What a search for the nearest shape found, and whether the number type was good enough for it.
struct Traced<T> {
    hit: Option<Hit<T>>,
    is_doubtful: bool,
}

/// Distances that differ by less, relatively, are told apart with 32 digits.
pub(crate) const ERROR_OF_DISTANCE: f64 = 1e-12;

/// How much of the clearance cos²θ_o, and of the normal, is lost to rounding.
struct TracingError {
    clearance: f64,
    normal: f64,
}

/// The error of a ray that is traced in double precision: in units of ε (1 + ρ), where ρ is the distance of the eye in
/// sizes of the shape. The rays' own rounding is most of it; the figures are above what `tests/conformance.rs` finds in
/// a hundred thousand random scenes.
fn ray_error(geometry: &Geometry, eye: Vector) -> TracingError {
    let error = f64::EPSILON * (1.0 + geometry.remoteness(eye));
    TracingError { clearance: 16.0 * error, normal: 1.25 * error }
}

/// The error of a pixel in an [`Outline`], which distance does not magnify.
const ERROR_IN_OUTLINE: TracingError = TracingError { clearance: 32.0 * f64::EPSILON, normal: 2.0 * f64::EPSILON };

impl TracingError {
    /// For which clearances a ray is traced again with 32 digits: around zero, where hit and miss are told apart, and
    /// up to where the error is within half of what [`tolerance::DOUBLE`] allows; shading has the rest.
    ///
    /// cosθ_o is the root of the clearance, so its error is that of the clearance over 2 cosθ_o.
    ///
    /// The error of the normal is magnified by a terminator, by 1/cosθ_i, by the edge of a spot, and by a highlight: n tanθ_h, largest where
    /// the highlight has fallen to a millionth of its peak, tan²θ_h = 10^(12/n) − 1, or where θ_h is as large as the
    /// cosines of the promise let it be. Some four roundings go into θ_h. Where even that is too much, every hit is
    /// traced again.
    fn doubtful_clearance(&self, formula: &BrightnessFormula, steepest_edge: f64) -> Range<f64> {
        let allowed = 0.5 * tolerance::DOUBLE.of_peak;
        let terminator = 1.0 / tolerance::DOUBLE.peak_cosine;
        let highlight = if formula.specular > 0.0 {
            let n = formula.shininess;
            let faintest = (libm::pow(10.0, 12.0 / n) - 1.0).sqrt();
            4.0 * n * faintest.min(1.0 / tolerance::DOUBLE.above_cosine)
        } else {
            0.0
        };
        let least_cosine = 0.5 * self.clearance / allowed;
        let is_too_much = self.normal * terminator.max(highlight).max(steepest_edge) > allowed;
        let good_enough = if is_too_much { f64::INFINITY } else { least_cosine * least_cosine };
        -2.0 * self.clearance..good_enough
    }
}

impl Hit<DoubleDouble> {
    pub(crate) fn rounded(self) -> Hit {
        let vector = |vector: Vector<DoubleDouble>| vector.map(DoubleDouble::rounded);
        let point = self.point;
        Hit {
            shape: self.shape,
            distance: self.distance.rounded(),
            point: SurfacePoint {
                anchor: point.anchor,
                offset: vector(point.offset),
                normal: vector(point.normal),
                view: vector(point.view),
                cos_theta_o: point.cos_theta_o.rounded(),
            },
        }
    }
}
