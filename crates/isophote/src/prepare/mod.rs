//! A scene laid out for tracing and shading. It chooses no renderer.

mod components;
mod free_point;
mod obstruction;
mod visibility;

use std::cell::OnceCell;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

pub use components::Components;
pub use obstruction::AmbientIrradiance;
use obstruction::Hemisphere;
pub use visibility::Blocking;

use crate::accelerate::Accelerator;
use crate::camera::{CameraFrame, ScreenPosition, Sight};
use crate::double_double::DoubleDouble;
use crate::light::Light;
use crate::map::{Pixel, Resolution};
use crate::outline::Outline;
use crate::ray::Ray;
use crate::reflectance::{BrightnessFormula, Reflectance};
use crate::scalar::Scalar;
use crate::scene::Scene;
use crate::shade::{LightTerm, Shading, shade};
use crate::shape::{Accuracy, Geometry, Located, Primitive, Sphere, SurfacePoint, TracingError};
use crate::vector::Vector;

/// A scene with everything computed that does not depend on the pixel.
#[derive(Clone, Debug)]
pub struct PreparedScene {
    scene: Arc<Scene>,
    frame: CameraFrame<f64>,
    precise_frame: CameraFrame<DoubleDouble>,
    shapes: Vec<PreparedShape>,
    /// The convention applied to each material, and last to what has none.
    formulas: Vec<PreparedFormula>,
    /// The number of the first primitive of each shape, and last how many there are.
    first_primitives: Vec<u32>,
    /// With so many primitives, or fewer, rays try each of them.
    linear_search_max: u32,
    /// Over all primitives; with so few that each is tried, built only when a renderer asks for it.
    accelerator: Arc<OnceLock<Accelerator>>,
    /// Where surface points look for what obstructs the ambient light, if anything does.
    hemisphere: Option<Arc<Hemisphere>>,
    /// Written when the first map asks for it, once for all that is made of the scene.
    source_text: Arc<OnceLock<String>>,
    /// Of a scene with colours.
    components: Option<Components>,
}

#[derive(Clone, Debug)]
struct PreparedShape {
    geometry: Geometry,
    /// Index of the formula of parts that have no material of their own.
    formula: usize,
    /// Where it appears on the screen; found when a renderer first asks, as probes never do.
    outline: OnceLock<Outline>,
}

#[derive(Clone, Debug)]
struct PreparedFormula {
    formula: BrightnessFormula,
    /// Of a ray whose hit is shaded so.
    accuracy: Accuracy,
    /// For which clearances in its outline a shape has to be traced with 32 digits.
    doubtful_in_outline: Range<f64>,
}

/// What a ray from the eye meets first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit<T = f64> {
    /// What was hit.
    pub primitive: Primitive,
    /// t, the distance from the eye in metres (2.2).
    pub distance: T,
    /// The point.
    pub point: SurfacePoint<T>,
    /// Whether a closed shape is seen from inside.
    pub from_inside: bool,
    /// See [`ShapeHit::shadow_ray_offset`](crate::shape::ShapeHit::shadow_ray_offset).
    pub shadow_ray_offset: Vector<T>,
}

impl PreparedScene {
    /// Lays a scene out.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        Self::with_accelerator(scene, Arc::default())
    }

    /// Lays out a scene after an earlier one, whose tree is its own too if their shapes are the same.
    #[must_use]
    pub fn reusing(earlier: &Self, scene: &Scene) -> Self {
        let (before, now) = (&earlier.scene.shapes, &scene.shapes);
        let is_same =
            |(before, now): (&crate::scene::Shape, &crate::scene::Shape)| before.geometry.is_same(&now.geometry);
        let are_same = before.len() == now.len() && before.iter().zip(now).all(is_same);
        Self::with_accelerator(scene, if are_same { Arc::clone(&earlier.accelerator) } else { Arc::default() })
    }

    /// Whether laying a scene out builds a tree, which may take a while.
    #[must_use]
    pub fn builds_tree(scene: &Scene) -> bool {
        scene.shapes.iter().map(|shape| shape.geometry.parts()).sum::<u32>() > HANDFUL
    }

    fn with_accelerator(scene: &Scene, accelerator: Arc<OnceLock<Accelerator>>) -> Self {
        let shapes = scene.shapes.iter().map(|shape| PreparedShape {
            geometry: shape.geometry.clone(),
            formula: shape.material.unwrap_or(scene.materials.len()),
            outline: OnceLock::new(),
        });
        let shapes: Vec<PreparedShape> = shapes.collect();
        let mut first_primitives = vec![0];
        first_primitives.extend(shapes.iter().scan(0, |count, shape| {
            *count += shape.geometry.parts();
            Some(*count)
        }));
        let obstruction = scene.ambient.and_then(|ambient| ambient.obstruction);
        let mut prepared = Self {
            first_primitives,
            linear_search_max: HANDFUL,
            accelerator,
            frame: CameraFrame::new(&scene.camera),
            precise_frame: CameraFrame::new(&scene.camera),
            shapes,
            formulas: formulas(scene),
            hemisphere: obstruction.map(|directions| Arc::new(Hemisphere::new(directions))),
            source_text: Arc::default(),
            components: None,
            scene: Arc::new(scene.clone()),
        };
        if Self::builds_tree(scene) {
            prepared.accelerator();
        }
        prepared.components = prepared.split_into_components();
        prepared
    }

    /// The same scene without a tree: every ray tries every primitive. This is what the tree is held to.
    #[must_use]
    pub fn by_brute_force(self) -> Self {
        let components = self.components.as_ref().map(|components| components.map(|one| one.clone().by_brute_force()));
        Self { linear_search_max: u32::MAX, components, ..self }
    }

    /// The same scene seen with another number of pixels.
    pub(crate) fn at_resolution(&self, resolution: Resolution) -> Self {
        self.with_view(&|other| {
            Arc::make_mut(&mut other.scene).camera.resolution = resolution;
            other.frame = CameraFrame::new(&other.scene.camera);
            other.precise_frame = CameraFrame::new(&other.scene.camera);
        })
    }

    /// The same with rays through another place of the pixels than their centres: parts of their width and height.
    pub(crate) fn seen_through(&self, place: [f64; 2]) -> Self {
        self.with_view(&|other| {
            other.frame.place = place;
            other.precise_frame.place = place;
        })
    }

    /// The same after a change of how it is seen, of its components too.
    fn with_view(&self, change: &dyn Fn(&mut Self)) -> Self {
        let mut other = self.clone();
        change(&mut other);
        for shape in &mut other.shapes {
            shape.outline = OnceLock::new();
        }
        other.components = self.components.as_ref().map(|components| components.map(|one| one.with_view(change)));
        other
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

    /// The same with 32 digits.
    pub(crate) fn precise_frame(&self) -> &CameraFrame<DoubleDouble> {
        &self.precise_frame
    }

    /// What the ray through a place on the screen meets first (2.1), (2.2).
    ///
    /// cosθ_o of a double has an error that grows without bound towards the silhouette; rays that come near it are
    /// traced again with 32 digits, so that the bound on the error holds at every visible pixel.
    #[must_use]
    pub fn trace(&self, position: ScreenPosition) -> Option<Hit> {
        let Traced { hit, is_doubtful } = self.nearest(&self.frame.ray(position)?);
        if is_doubtful { self.trace_precisely(position).map(Hit::rounded) } else { hit }
    }

    /// What the ray through a place on the screen meets first, with 32 digits.
    #[must_use]
    pub fn trace_precisely(&self, position: ScreenPosition) -> Option<Hit<DoubleDouble>> {
        self.nearest(&self.precise_frame.ray(position)?).hit
    }

    /// The same, when it can only be one of these.
    pub(crate) fn trace_precisely_among(
        &self,
        position: ScreenPosition,
        primitives: impl Iterator<Item = Primitive>,
    ) -> Option<Hit<DoubleDouble>> {
        self.nearest_among(&self.precise_frame.ray(position)?, primitives).hit
    }

    /// Where a shape appears on the screen.
    #[must_use]
    pub fn outline(&self, shape: usize) -> &Outline {
        let shape = &self.shapes[shape];
        shape.outline.get_or_init(|| Outline::of(&shape.geometry, &self.precise_frame))
    }

    /// For which clearances in its outline a primitive has to be traced with 32 digits.
    pub(crate) fn doubtful_in_outline(&self, primitive: Primitive) -> &Range<f64> {
        &self.prepared_formula(primitive).doubtful_in_outline
    }

    /// What is seen at a pixel of the full image.
    #[must_use]
    pub fn trace_pixel(&self, pixel: Pixel) -> Option<Hit> {
        self.trace(ScreenPosition::PixelCenter(pixel))
    }

    /// What the eye meets first in the direction of a point, on the screen or not.
    #[must_use]
    pub fn first_towards(&self, point: Vector) -> Option<Primitive> {
        let Sight { start, view, .. } = self.frame.sight(point, Vector::default());
        let ray = Ray { anchor: start, offset: Vector::default(), direction: -view };
        self.nearest(&ray).hit.map(|hit| hit.primitive)
    }

    /// Whether a shape may stand in another one's light.
    pub(crate) fn casts_shadows_between_shapes(&self) -> bool {
        let is_ambient_obstructed = self.scene.ambient.is_some_and(|ambient| ambient.obstruction.is_some());
        (self.scene.shadows || is_ambient_obstructed) && self.has_shapes_beside_one()
    }

    fn has_shapes_beside_one(&self) -> bool {
        self.primitive_count() > 1
    }

    /// How many primitives there are.
    pub(crate) fn primitive_count(&self) -> u32 {
        self.first_primitives.last().copied().unwrap_or(0)
    }

    /// The primitive of a number: they are counted through all shapes.
    pub(crate) fn primitive(&self, number: u32) -> Primitive {
        let shape = self.first_primitives.partition_point(|first| *first <= number) - 1;
        Primitive { shape, part: number - self.first_primitives[shape] }
    }

    /// The sphere that a primitive is, if it is one.
    pub(crate) fn sphere(&self, primitive: Primitive) -> Option<&Sphere> {
        match &self.shapes[primitive.shape].geometry {
            Geometry::Sphere(sphere) => Some(sphere),
            Geometry::Spheres(cloud) => Some(&cloud.spheres[primitive.part as usize]),
            _ => None,
        }
    }

    /// The tree over all primitives, by their numbers.
    pub(crate) fn accelerator(&self) -> &Accelerator {
        self.accelerator.get_or_init(|| {
            Accelerator::new(self.primitive_count(), |number| {
                let Primitive { shape, part } = self.primitive(number);
                self.shapes[shape].geometry.bounds(part)
            })
        })
    }

    /// Goes through the primitives that a ray may meet, the nearer ones first more or less; `test` says up to which
    /// distance to go on. With a handful of primitives that is all of them.
    fn along_ray<T: Scalar>(&self, ray: &Ray<T>, limit: f64, mut test: impl FnMut(Primitive) -> f64) {
        if self.primitive_count() <= self.linear_search_max {
            self.primitives().for_each(|primitive| {
                test(primitive);
            });
            return;
        }
        let vector = |vector: Vector<T>| vector.map(T::rounded);
        let start = vector(ray.anchor) + vector(ray.offset);
        self.accelerator().along_ray(start, vector(ray.direction), limit, |number| test(self.primitive(number)));
    }

    /// All that can be hit.
    fn primitives(&self) -> impl Iterator<Item = Primitive> {
        let parts = |(shape, prepared): (usize, &PreparedShape)| {
            (0..prepared.geometry.parts()).map(move |part| Primitive { shape, part })
        };
        self.shapes.iter().enumerate().flat_map(parts)
    }

    fn nearest<T: Scalar>(&self, ray: &Ray<T>) -> Traced<T> {
        let mut search = Search::new(self, ray);
        self.along_ray(ray, f64::INFINITY, |primitive| search.test(primitive));
        search.finish()
    }

    /// The same among some primitives, tried one by one.
    fn nearest_among<T: Scalar>(&self, ray: &Ray<T>, primitives: impl Iterator<Item = Primitive>) -> Traced<T> {
        let mut search = Search::new(self, ray);
        for primitive in primitives {
            search.test(primitive);
        }
        search.finish()
    }

    /// The brightness of a hit by the scene's convention, summed over the lights; `each` sees every light's own term.
    /// `seen_at` is the place on the screen where the hit was found: at the edge of a shadow it is found again with 32
    /// digits. A hit of a given point has none, and is taken as exact.
    pub fn shade(&self, hit: &Hit, seen_at: Option<ScreenPosition>, each: impl FnMut(usize, &LightTerm)) -> Shading {
        self.expect_single_numbers();
        let precise = OnceCell::new();
        let find_again = || seen_at.and_then(|position| self.trace_precisely(position));
        let visibility = |light| {
            let Blocking { blocker, is_doubtful } = self.blocking(hit, light);
            let blocker = if is_doubtful {
                let precise = precise.get_or_init(|| find_again().unwrap_or_else(|| hit.exactly()));
                self.blocking(precise, light).blocker
            } else {
                blocker
            };
            if blocker.is_some() { 0.0 } else { 1.0 }
        };
        let ambient = self.ambient_irradiance(hit).irradiance;
        shade(&hit.point, &self.scene.lights, self.formula(hit.primitive), ambient, visibility, each)
    }

    /// The same for a hit of 32 digits.
    pub fn shade_precisely(
        &self,
        hit: &Hit<DoubleDouble>,
        each: impl FnMut(usize, &LightTerm<DoubleDouble>),
    ) -> Shading<DoubleDouble> {
        let visibility = |light| {
            let is_blocked = self.blocking(hit, light).blocker.is_some();
            DoubleDouble::from_f64(if is_blocked { 0.0 } else { 1.0 })
        };
        // The directions are sampled, which a double is good enough for.
        let ambient = DoubleDouble::from_f64(self.ambient_irradiance(&hit.rounded()).irradiance);
        shade(&hit.point, &self.scene.lights, self.formula(hit.primitive), ambient, visibility, each)
    }

    fn prepared_formula(&self, primitive: Primitive) -> &PreparedFormula {
        let shape = &self.shapes[primitive.shape];
        &self.formulas[shape.geometry.material_of(primitive.part).unwrap_or(shape.formula)]
    }

    /// The convention applied to the material of a primitive.
    #[must_use]
    pub fn formula(&self, primitive: Primitive) -> &BrightnessFormula {
        self.expect_single_numbers();
        &self.prepared_formula(primitive).formula
    }

    /// A point of a surface as the eye sees it, also where the eye cannot: cosθ_o is then negative. Of a closed shape
    /// the eye sees the outside, unless it is inside; of another one the side that is turned to it.
    #[must_use]
    pub fn surface_point(&self, located: &Located) -> Hit {
        let nearest = &located.nearest;
        let geometry = &self.shapes[located.shape].geometry;
        let Sight { start, view, distance } = self.frame.sight(nearest.anchor, nearest.offset);
        let from_inside = geometry.part_encloses(nearest.part, start);
        let from_behind = !geometry.is_closed() && nearest.face_normal.dot(view) < 0.0;
        let normal = if from_inside || from_behind { -nearest.outward_normal } else { nearest.outward_normal };
        let shadow_ray_offset = if from_behind { nearest.shadow_ray_offset_behind } else { nearest.shadow_ray_offset };
        let point = SurfacePoint {
            anchor: nearest.anchor,
            offset: nearest.offset,
            normal,
            view,
            cos_theta_o: normal.dot(view),
        };
        let primitive = Primitive { shape: located.shape, part: nearest.part };
        Hit { primitive, distance, point, from_inside, shadow_ray_offset }
    }
}

/// The convention applied to each material of a scene, and last to what has none.
fn formulas(scene: &Scene) -> Vec<PreparedFormula> {
    let without_material = Reflectance { diffuse: 0.0, specular: 0.0, shininess: 1.0 };
    let materials = scene.materials.iter().map(|material| &material.reflectance);
    let steepest_edge = scene.lights.iter().map(Light::steepest_edge).fold(0.0, f64::max);
    let formulas = materials.chain([&without_material]).map(|material| {
        let formula = BrightnessFormula::new(scene.convention, material);
        let shininess = (formula.specular > 0.0).then_some(formula.shininess);
        let accuracy = Accuracy::for_shading(shininess, steepest_edge);
        let doubtful_in_outline = accuracy.doubtful_clearance(&TracingError::IN_OUTLINE);
        PreparedFormula { formula, accuracy, doubtful_in_outline }
    });
    formulas.collect()
}

/// A search for the nearest primitive; in which order they are tested does not matter.
struct Search<'s, T> {
    scene: &'s PreparedScene,
    ray: &'s Ray<T>,
    nearest: Option<Hit<T>>,
    doubtful_from: Option<T>,
}

impl<'s, T: Scalar> Search<'s, T> {
    fn new(scene: &'s PreparedScene, ray: &'s Ray<T>) -> Self {
        Self { scene, ray, nearest: None, doubtful_from: None }
    }

    /// Tests a primitive; returns the distance beyond which nothing matters any more.
    fn test(&mut self, primitive: Primitive) -> f64 {
        let accuracy = self.scene.prepared_formula(primitive).accuracy;
        let intersection = self.scene.shapes[primitive.shape].geometry.intersect(primitive.part, self.ray, accuracy);
        self.doubtful_from = least(self.doubtful_from, intersection.doubtful_from);
        if let Some(hit) = intersection.hit {
            let ahead_by = self.nearest.map(|nearest| (nearest.distance - hit.distance, nearest.primitive));
            // Where surfaces cross, the order of their distances is as uncertain as the distances.
            let uncertain = T::from_f64(ERROR_OF_DISTANCE) * hit.distance;
            if ahead_by.is_some_and(|(by, _)| by.is_less(uncertain) && (-uncertain).is_less(by)) {
                self.doubtful_from = least(self.doubtful_from, Some(hit.distance - uncertain));
            }
            // Of surfaces in the same place the first in the scene is seen.
            let is_nearer = |(by, other): (T, Primitive)| {
                T::zero().is_less(by)
                    || !by.is_less(T::zero()) && (primitive.shape, primitive.part) < (other.shape, other.part)
            };
            if ahead_by.is_none_or(is_nearer) {
                let crate::shape::ShapeHit { distance, point, from_inside, shadow_ray_offset } = hit;
                self.nearest = Some(Hit { primitive, distance, point, from_inside, shadow_ray_offset });
            }
        }
        self.nearest.map_or(f64::INFINITY, |hit| hit.distance.rounded())
    }

    fn finish(self) -> Traced<T> {
        let is_beyond = |from: T| self.nearest.is_some_and(|hit| hit.distance.is_less(from));
        Traced { hit: self.nearest, is_doubtful: self.doubtful_from.is_some_and(|from| !is_beyond(from)) }
    }
}

/// What a search for the nearest shape found, and whether the number type was good enough for it.
struct Traced<T> {
    hit: Option<Hit<T>>,
    is_doubtful: bool,
}

/// So many primitives are tried one by one.
const HANDFUL: u32 = 8;

/// Distances that differ by less, relatively, are told apart with 32 digits.
pub(crate) const ERROR_OF_DISTANCE: f64 = 1e-12;

/// The smaller of two numbers that may be missing.
fn least<T: Scalar>(first: Option<T>, second: Option<T>) -> Option<T> {
    match (first, second) {
        (Some(first), Some(second)) => Some(T::select(second.is_less(first), second, first)),
        (first, second) => first.or(second),
    }
}

impl<T: Scalar> Hit<T> {
    /// The same hit in another number type.
    fn map<U: Scalar>(self, convert: impl Fn(T) -> U) -> Hit<U> {
        Hit {
            primitive: self.primitive,
            distance: convert(self.distance),
            point: self.point.map(&convert),
            from_inside: self.from_inside,
            shadow_ray_offset: self.shadow_ray_offset.map(&convert),
        }
    }
}

impl Hit {
    fn exactly(&self) -> Hit<DoubleDouble> {
        self.map(DoubleDouble::from_f64)
    }
}

impl Hit<DoubleDouble> {
    pub(crate) fn rounded(self) -> Hit {
        self.map(DoubleDouble::rounded)
    }
}
