//! Blocks of points that rays have hit: shaded one by one, in double precision, in every layer of the scene.

use super::RenderError;
use super::band::Band;
use super::fan_out::{Pixels, Shaded};
use super::shading::block::{POINTS, ShadedBlock, SurfaceBlock};
use crate::camera::ScreenPosition;
use crate::prepare::{AmbientIrradiance, AmbientShare, Hit, PreparedScene};
use crate::reflectance::BrightnessFormula;
use crate::shade::{ByLight, LightTerm, shade};
use crate::shape::SurfacePoint;

/// Hits that wait to be written.
pub struct HitBlock<'s> {
    scene: &'s PreparedScene,
    layers: Vec<&'s PreparedScene>,
    by_light: ByLight,
    /// Their indices in the band, or whatever else identifies them.
    indices: Vec<usize>,
    points: Box<SurfaceBlock<f64>>,
    shaded: Vec<Box<ShadedBlock<f64>>>,
    /// v of each emitter, if several layers share it.
    visibility: Vec<f64>,
}

impl<'s> HitBlock<'s> {
    /// An empty block; `asked_for` lists the lights whose own irradiance is requested.
    pub fn new(scene: &'s PreparedScene, asked_for: &[usize]) -> Self {
        let layers = scene.layers();
        Self {
            scene,
            by_light: ByLight::of(asked_for.iter().copied()),
            indices: Vec::with_capacity(POINTS),
            points: SurfaceBlock::anchored(),
            shaded: layers.iter().map(|_| ShadedBlock::new(asked_for.len())).collect(),
            visibility: Vec::new(),
            layers,
        }
    }

    /// Whether the block is full.
    pub fn is_full(&self) -> bool {
        self.indices.len() == POINTS
    }

    /// The number of hits.
    pub fn len(&self) -> usize {
        self.indices.len()
    }

    /// Empties the block.
    pub fn clear(&mut self) {
        self.indices.clear();
    }

    /// What is visible at a screen position.
    pub fn trace(&self, position: ScreenPosition) -> Option<Hit> {
        self.scene.trace(position)
    }

    /// The shaded points in a layer.
    pub fn shaded(&self, layer: usize) -> &ShadedBlock<f64> {
        &self.shaded[layer]
    }

    /// Shades a hit; `seen_at` is the screen position of the ray that found it, if there is one.
    pub fn push(&mut self, index: usize, hit: &Hit, seen_at: Option<ScreenPosition>) {
        let scene = self.scene;
        let visibility = scene.visibility(hit, seen_at);
        self.push_lit(index, hit, scene.ambient_share(hit), visibility, |layer| layer.formula(hit.primitive));
    }

    /// Shades a point that lies on no shape: only the light it receives.
    pub fn push_free(&mut self, index: usize, point: &SurfacePoint) {
        let scene = self.scene;
        let light = scene.light_at(point);
        let visibility = |emitter| scene.visibility_at(&light, point, emitter);
        let hit = Hit::on_no_shape(*point);
        let ambient = scene.ambient_share_at(&light, point);
        self.push_lit(index, &hit, ambient, visibility, PreparedScene::formula_without_material);
    }

    /// Shades a point in every layer; the light that reaches it is computed once.
    fn push_lit(
        &mut self,
        index: usize,
        hit: &Hit,
        ambient: AmbientShare,
        visibility: impl Fn(usize) -> f64,
        formula: impl Fn(&PreparedScene) -> &BrightnessFormula,
    ) {
        let at = self.indices.len();
        self.indices.push(index);
        self.points.set(at, hit);
        let is_shared = self.layers.len() > 1;
        if is_shared {
            self.visibility.clear();
            self.visibility.extend((0..self.scene.emitters().all().len()).map(&visibility));
        }
        for (layer, shaded) in self.layers.iter().zip(&mut self.shaded) {
            let AmbientIrradiance { irradiance, standard_error } = ambient.of(layer.scene().ambient());
            let visibility = |emitter: usize| if is_shared { self.visibility[emitter] } else { visibility(emitter) };
            let mut by_light = self.by_light.clone();
            let each = |light: usize, term: &LightTerm| by_light.take(light, term);
            let shading = shade(&hit.point, layer.emitters().all(), formula(layer), irradiance, visibility, each);
            shaded.brightness[at] = shading.brightness();
            shaded.irradiance[at] = shading.irradiance;
            shaded.diffuse[at] = shading.diffuse;
            shaded.specular[at] = shading.specular;
            shaded.ambient[at] = shading.ambient;
            shaded.ambient_error[at] = standard_error;
            for (out, irradiance) in shaded.by_light.iter_mut().zip(by_light.irradiances()) {
                out[at] = irradiance;
            }
        }
    }

    /// Writes the hits into a band, whose pixels the indices refer to, and empties the block.
    ///
    /// # Errors
    /// A value that a channel of single precision cannot hold.
    pub fn put(&mut self, band: &mut Band<'_>) -> Result<(), RenderError> {
        let pixels = Pixels::At(&self.indices);
        for (layer, shaded) in self.shaded.iter().enumerate() {
            band.put(layer, pixels, Shaded::Double(shaded))?;
        }
        if band.has_geometry() {
            band.put_geometry(pixels, &self.points);
        }
        self.indices.clear();
        Ok(())
    }
}
