//! A scene laid out for tracing and shading. It chooses no renderer.

use std::ops::Range;

use crate::camera::{CameraFrame, ScreenPosition};
use crate::double_double::DoubleDouble;
use crate::map::Pixel;
use crate::real::Real;
use crate::reflectance::{BrightnessFormula, Reflectance};
use crate::scene::Scene;
use crate::shade::{LightTerm, Shading, shade};
use crate::shape::{Geometry, Located, SurfacePoint};
use crate::vector::Vector;

/// A scene with everything computed that does not depend on the pixel.
#[derive(Clone, Debug)]
pub struct PreparedScene {
    scene: Scene,
    frame: CameraFrame<f64>,
    precise_frame: CameraFrame<DoubleDouble>,
    shapes: Vec<PreparedShape>,
}

#[derive(Clone, Debug)]
struct PreparedShape {
    geometry: Geometry,
    formula: BrightnessFormula,
    eye_inside: bool,
    /// For each light, v_j of a point that is seen from inside; empty where the eye is outside.
    light_inside: Vec<bool>,
    /// Rays whose clearance is between these are traced with 32 digits: see [`doubtful_clearance`].
    doubtful_clearance: Range<f64>,
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
        let prepare = |shape: &crate::scene::Shape| {
            let geometry = shape.geometry;
            let is_inside = |point| geometry.signed_distance(point) < 0.0;
            let eye_inside = is_inside(frame.eye);
            let inside = |light: &crate::light::Light| is_inside(light.position);
            let no_material = Reflectance { diffuse: 0.0, specular: 0.0, shininess: 1.0 };
            let material = shape.material.map_or(no_material, |index| scene.materials[index].reflectance);
            let formula = BrightnessFormula::new(scene.convention, &material);
            PreparedShape {
                geometry,
                formula,
                eye_inside,
                light_inside: if eye_inside { scene.lights.iter().map(inside).collect() } else { Vec::new() },
                doubtful_clearance: doubtful_clearance(&geometry, &formula, frame.eye),
            }
        };
        let shapes = scene.shapes.iter().map(prepare).collect();
        Self { scene: scene.clone(), precise_frame: CameraFrame::new(&scene.camera), frame, shapes }
    }

    /// The scene it was made from.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
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
        let (hit, is_doubtful) = self.nearest(&self.frame, position);
        if is_doubtful { self.trace_precisely(position).map(Hit::rounded) } else { hit }
    }

    /// What the ray through a place on the screen meets first, with 32 digits.
    #[must_use]
    pub fn trace_precisely(&self, position: ScreenPosition) -> Option<Hit<DoubleDouble>> {
        self.nearest(&self.precise_frame, position).0
    }

    /// What is seen at a pixel of the full image.
    #[must_use]
    pub fn trace_pixel(&self, pixel: Pixel) -> Option<Hit> {
        self.trace(ScreenPosition::PixelCenter(pixel))
    }

    fn nearest<T: Real<Mask = bool>>(
        &self,
        frame: &CameraFrame<T>,
        position: ScreenPosition,
    ) -> (Option<Hit<T>>, bool) {
        let ray = frame.ray(position);
        let mut nearest: Option<Hit<T>> = None;
        let mut is_doubtful = false;
        for (index, shape) in self.shapes.iter().enumerate() {
            let approach = shape.geometry.approach(&ray, shape.eye_inside);
            let doubtful = &shape.doubtful_clearance;
            is_doubtful |= T::from_f64(doubtful.start).is_less(approach.clearance)
                && approach.clearance.is_less(T::from_f64(doubtful.end));
            if !T::zero().is_less(approach.clearance) {
                continue;
            }
            let found = shape.geometry.intersection(&ray, shape.eye_inside, &approach);
            if nearest.is_none_or(|nearest| found.distance.is_less(nearest.distance)) {
                nearest = Some(Hit { shape: index, distance: found.distance, point: found.point });
            }
        }
        (nearest, is_doubtful)
    }

    /// The brightness of a surface point by the scene's convention, summed over the lights; `each` sees every
    /// light's own term.
    pub fn shade<T: Real>(
        &self,
        shape: usize,
        point: &SurfacePoint<T>,
        each: impl FnMut(usize, &LightTerm<T>),
    ) -> Shading<T> {
        let visibility = |light| T::from_f64(self.visibility(shape, light));
        shade(point, &self.scene.lights, &self.shapes[shape].formula, visibility, each)
    }

    /// v_j of (3.1): 1, or 0 where the shape's own wall stands between a point that is seen from inside and a light
    /// outside. Shadows of other shapes are not cast yet; this is their place.
    #[must_use]
    pub fn visibility(&self, shape: usize, light: usize) -> f64 {
        let shape = &self.shapes[shape];
        if shape.eye_inside && !shape.light_inside[light] { 0.0 } else { 1.0 }
    }

    /// The convention applied to a shape's material.
    #[must_use]
    pub fn formula(&self, shape: usize) -> &BrightnessFormula {
        &self.shapes[shape].formula
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

/// For which clearances cos²θ_o a ray is traced again with 32 digits: around zero, where hit and miss are told apart,
/// and up to where a double is good enough.
///
/// With ρ = ‖C − O‖/R, the clearance of a double is wrong by some 16 ε (1 + ρ), and cosθ_o, its root, by that over
/// 2 cosθ_o: to keep cosθ_o within 5e-13, cosθ_o itself must stay above 16 ε (1 + ρ) / 1e-12.
///
/// The normal is wrong by some ε (1 + ρ) everywhere. A terminator magnifies that by 1/cosθ_i, 100 where the promise of
/// [`conformance`](crate::conformance::DOUBLE) begins; a highlight by n tanθ_h, which is √(2 n ln 10⁶) = 5.3 √n where it
/// has fallen to a millionth, and some four roundings go into it. Where that comes near the bound, every ray that hits
/// is traced with 32 digits.
fn doubtful_clearance(geometry: &Geometry, formula: &BrightnessFormula, eye: Vector) -> Range<f64> {
    let Geometry::Sphere(sphere) = geometry;
    let error = f64::EPSILON * (1.0 + (sphere.center - eye).length() / sphere.radius);
    let highlight = if formula.specular > 0.0 { 4.0 * 5.3 * formula.shininess.sqrt() } else { 0.0 };
    let magnification = highlight.max(1.0 / crate::conformance::DOUBLE.peak_cosine);
    let least_cosine = 16.0 * error / 1e-12;
    let good_enough = if magnification * error > 2.5e-13 { f64::INFINITY } else { least_cosine * least_cosine };
    -32.0 * error..good_enough
}

impl Hit<DoubleDouble> {
    fn rounded(self) -> Hit {
        let vector =
            |vector: Vector<DoubleDouble>| Vector::new(vector.x.rounded(), vector.y.rounded(), vector.z.rounded());
        let point = self.point;
        Hit {
            shape: self.shape,
            distance: self.distance.rounded(),
            point: SurfacePoint {
                anchor: vector(point.anchor),
                offset: vector(point.offset),
                normal: vector(point.normal),
                view: vector(point.view),
                cos_theta_o: point.cos_theta_o.rounded(),
            },
        }
    }
}
