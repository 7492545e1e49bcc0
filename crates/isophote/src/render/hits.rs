//! Points that rays have met, as blocks: shaded one by one, in double precision, by every layer of the scene.

use super::RenderError;
use super::band::Band;
use super::fan_out::{Pixels, Shaded};
use super::shading::block::{POINTS, ShadedBlock, SurfaceBlock};
use crate::camera::ScreenPosition;
use crate::prepare::{AmbientIrradiance, AmbientShare, Hit, PreparedScene};
use crate::reflectance::BrightnessFormula;
use crate::shade::{ByLight, LightTerm, shade};
use crate::shape::{Primitive, SurfacePoint};
use crate::vector::Vector;

/// Hits that wait to be written.
pub struct HitBlock<'s> {
    scene: &'s PreparedScene,
    layers: Vec<&'s PreparedScene>,
    by_light: ByLight,
    /// Their indices in the band, or whatever else tells them apart.
    indices: Vec<usize>,
    points: Box<SurfaceBlock<f64>>,
    shaded: Vec<Box<ShadedBlock<f64>>>,
    /// v of each emitter, where several layers share it.
    visibility: Vec<f64>,
}

impl<'s> HitBlock<'s> {
    /// No hits yet; with what is asked of single lights.
    pub fn new(scene: &'s PreparedScene, asked_for: &[usize]) -> Self {
        let layers = scene.layers();
        Self {
            scene,
            by_light: ByLight::of(asked_for.iter().copied()),
            indices: Vec::with_capacity(POINTS),
            points: SurfaceBlock::new(),
            shaded: layers.iter().map(|_| ShadedBlock::new(asked_for.len())).collect(),
            visibility: Vec::new(),
            layers,
        }
    }

    /// Whether no more fit.
    pub fn is_full(&self) -> bool {
        self.indices.len() == POINTS
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.indices.len()
    }

    /// Begins anew.
    pub fn clear(&mut self) {
        self.indices.clear();
    }

    /// What is seen at a place on the screen.
    pub fn trace(&self, position: ScreenPosition) -> Option<Hit> {
        self.scene.trace(position)
    }

    /// What a layer shows of them.
    pub fn shaded(&self, layer: usize) -> &ShadedBlock<f64> {
        &self.shaded[layer]
    }

    /// Shades a hit; of what is seen by a ray, the place on the screen through which that goes.
    pub fn push(&mut self, index: usize, hit: &Hit, seen_at: Option<ScreenPosition>) {
        let scene = self.scene;
        let visibility = scene.visibility(hit, seen_at);
        self.push_lit(index, hit, scene.ambient_share(hit), visibility, |layer| layer.formula(hit.primitive));
    }

    /// Shades a point that is no shape's: what of it is light alone.
    pub fn push_free(&mut self, index: usize, point: &SurfacePoint) {
        let scene = self.scene;
        let light = scene.light_at(point);
        let visibility = |emitter| scene.visibility_at(&light, point, emitter);
        let primitive = Primitive { shape: 0, part: 0 };
        let hit =
            Hit { primitive, distance: 0.0, point: *point, from_inside: false, shadow_ray_offset: Vector::zero() };
        self.push_lit(index, &hit, light.ambient, visibility, PreparedScene::formula_without_material);
    }

    /// Shades a point in every layer; what light reaches it is found once.
    fn push_lit(
        &mut self,
        index: usize,
        hit: &Hit,
        ambient: AmbientShare,
        visibility: impl Fn(usize) -> f64,
        formula: impl Fn(&PreparedScene) -> &BrightnessFormula,
    ) {
        let at = self.begin(index, hit);
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

    /// Writes where a hit is, and tells its place in the block.
    fn begin(&mut self, index: usize, hit: &Hit) -> usize {
        let at = self.indices.len();
        self.indices.push(index);
        let (position, normal) = (hit.point.position().to_array(), hit.point.normal.to_array());
        for axis in 0..3 {
            self.points.offset[axis][at] = position[axis];
            self.points.normal[axis][at] = normal[axis];
        }
        self.points.distance[at] = hit.distance;
        at
    }

    /// Writes them into a band, where indices are the band's, and begins anew.
    ///
    /// # Errors
    /// A number that a channel of single precision cannot hold.
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
