//! A scene prepared for tracing and shading. This module does not choose a renderer.

mod components;
mod formulas;
mod free_point;
mod hit;
mod obstruction;
mod places;
mod shading;
mod tracing;
mod views;
mod visibility;

use std::ops::Range;
use std::sync::{Arc, OnceLock};

pub use components::Components;
use formulas::{PreparedFormula, formulas};
pub(crate) use free_point::LightAtPoint;
pub use hit::Hit;
pub use obstruction::AmbientIrradiance;
pub(crate) use obstruction::{AmbientShare, Hemisphere, HemisphereDirection};
pub(crate) use tracing::ERROR_OF_DISTANCE;
pub use visibility::Blocking;
pub(crate) use visibility::Blocks;

use crate::accelerate::Accelerator;
use crate::camera::CameraFrame;
use crate::double_double::DoubleDouble;
use crate::light::Emitters;
use crate::outline::Outline;
use crate::scene::Scene;
use crate::shape::{Geometry, Primitive, Sphere};
use crate::threads::Threads;

/// A scene with everything precomputed that does not depend on the pixel.
#[derive(Clone, Debug)]
pub struct PreparedScene {
    scene: Arc<Scene>,
    frame: CameraFrame<f64>,
    precise_frame: CameraFrame<DoubleDouble>,
    shapes: Vec<PreparedShape>,
    /// The emitters that the sums over the lights visit.
    emitters: Emitters,
    /// The convention applied to each material, and finally to a missing material.
    formulas: Vec<PreparedFormula>,
    /// The number of the first primitive of each shape, followed by the number of primitives.
    first_primitives: Vec<u32>,
    /// Up to this many primitives, rays try each of them.
    linear_search_max: u32,
    /// Over all primitives; where there are few enough to try each, it is built only when a renderer asks for it.
    accelerator: Arc<OnceLock<Accelerator>>,
    /// The directions in which surface points look for shapes that obstruct the ambient light, if any can.
    hemisphere: Option<Arc<Hemisphere>>,
    /// Written when the first map asks for it, once for everything made from the scene.
    source_text: Arc<OnceLock<String>>,
    /// The threads that build its tree and do its other parallel work.
    threads: Threads,
    /// For a scene with colours.
    components: Option<Components>,
}

#[derive(Clone, Debug)]
struct PreparedShape {
    geometry: Geometry,
    /// Index of the formula for parts without a material of their own.
    formula: usize,
    /// Its outline on the screen; computed when a renderer first asks, since probes never do.
    outline: OnceLock<Outline>,
}

impl PreparedScene {
    /// Prepares a scene.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        Self::on_threads(scene, &Threads::default())
    }

    /// Prepares a scene; these threads build its tree, and compute its grids and surfaces.
    #[must_use]
    pub fn on_threads(scene: &Scene, threads: &Threads) -> Self {
        Self::with_accelerator(scene, Arc::default(), threads)
    }

    /// Prepares a scene after an earlier one, and shares the earlier scene's tree if their shapes are the same.
    #[must_use]
    pub fn reusing(earlier: &Self, scene: &Scene) -> Self {
        let (before, now) = (&earlier.scene.shapes, &scene.shapes);
        let is_same =
            |(before, now): (&crate::scene::Shape, &crate::scene::Shape)| before.geometry.is_same(&now.geometry);
        let are_same = before.len() == now.len() && before.iter().zip(now).all(is_same);
        let accelerator = if are_same { Arc::clone(&earlier.accelerator) } else { Arc::default() };
        Self::with_accelerator(scene, accelerator, &earlier.threads)
    }

    /// Whether preparing a scene builds a tree, which may take a while.
    #[must_use]
    pub fn builds_tree(scene: &Scene) -> bool {
        scene.shapes.iter().map(|shape| shape.geometry.parts()).sum::<u32>() > HANDFUL
    }

    fn with_accelerator(scene: &Scene, accelerator: Arc<OnceLock<Accelerator>>, threads: &Threads) -> Self {
        let shapes = scene.shapes.iter().map(|shape| PreparedShape {
            geometry: shape.geometry.clone(),
            formula: shape.material.unwrap_or(scene.materials.len()),
            outline: OnceLock::new(),
        });
        let shapes: Vec<PreparedShape> = shapes.collect();
        let mut first_primitives = Vec::with_capacity(shapes.len() + 1);
        first_primitives.push(0);
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
            emitters: Emitters::of(&scene.lights),
            formulas: formulas(scene),
            hemisphere: obstruction.map(|directions| Arc::new(Hemisphere::new(directions))),
            source_text: Arc::default(),
            threads: threads.clone(),
            components: None,
            scene: Arc::new(scene.clone()),
        };
        if Self::builds_tree(scene) {
            prepared.accelerator();
        }
        prepared.components = prepared.split_into_components();
        prepared
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

    /// The emitters that the sums over the lights visit.
    #[must_use]
    pub fn emitters(&self) -> &Emitters {
        &self.emitters
    }

    /// The threads that compute grids and surfaces.
    pub(crate) fn threads(&self) -> &Threads {
        &self.threads
    }

    /// The camera's axes.
    #[must_use]
    pub fn frame(&self) -> &CameraFrame {
        &self.frame
    }

    /// The camera's axes with 32 digits.
    pub(crate) fn precise_frame(&self) -> &CameraFrame<DoubleDouble> {
        &self.precise_frame
    }

    /// Where a shape appears on the screen.
    #[must_use]
    pub fn outline(&self, shape: usize) -> &Outline {
        let shape = &self.shapes[shape];
        shape.outline.get_or_init(|| Outline::of(&shape.geometry, &self.precise_frame))
    }

    /// The clearances within its outline at which a primitive has to be traced with 32 digits.
    pub(crate) fn doubtful_in_outline(&self, primitive: Primitive) -> &Range<f64> {
        &self.prepared_formula(primitive).doubtful_in_outline
    }

    /// Whether a shape may block another one's light.
    pub(crate) fn casts_shadows_between_shapes(&self) -> bool {
        let is_ambient_obstructed = self.scene.ambient.is_some_and(|ambient| ambient.obstruction.is_some());
        (self.scene.shadows || is_ambient_obstructed) && self.has_shapes_beside_one()
    }

    fn has_shapes_beside_one(&self) -> bool {
        self.primitive_count() > 1
    }

    /// The number of primitives.
    pub(crate) fn primitive_count(&self) -> u32 {
        self.first_primitives.last().copied().unwrap_or(0)
    }

    /// The primitive with this number, counted through all shapes.
    pub(crate) fn primitive(&self, number: u32) -> Primitive {
        let shape = self.first_primitives.partition_point(|first| *first <= number) - 1;
        Primitive { shape, part: number - self.first_primitives[shape] }
    }

    /// The number of a primitive.
    pub(crate) fn number_of(&self, primitive: Primitive) -> u32 {
        self.first_primitives[primitive.shape] + primitive.part
    }

    /// The form of a shape.
    pub(crate) fn geometry(&self, shape: usize) -> &Geometry {
        &self.shapes[shape].geometry
    }

    /// The primitive as a sphere, if it is one.
    pub(crate) fn sphere(&self, primitive: Primitive) -> Option<&Sphere> {
        match &self.shapes[primitive.shape].geometry {
            Geometry::Sphere(sphere) => Some(sphere),
            Geometry::Spheres(cloud) => Some(&cloud.spheres[primitive.part as usize]),
            _ => None,
        }
    }

    /// The tree over all primitives, which it knows by their numbers.
    pub(crate) fn accelerator(&self) -> &Accelerator {
        self.accelerator.get_or_init(|| {
            Accelerator::new(&self.threads, self.primitive_count(), |number| {
                let Primitive { shape, part } = self.primitive(number);
                self.shapes[shape].geometry.bounds(part)
            })
        })
    }
}

/// Up to this many primitives are tried one by one.
const HANDFUL: u32 = 8;
