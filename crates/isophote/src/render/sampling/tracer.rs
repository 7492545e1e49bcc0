//! Rays through samples of pixels: traced and shaded in packets, or one by one where packets are not supported.

use crate::lanes::Instructions;
use crate::prepare::{Hit, PreparedScene};
use crate::render::RenderError;
use crate::render::hits::HitBlock;
use crate::render::packets::{self, Output, Packets, Place, RAYS, Tracer};
use crate::render::shading::block::{ShadedBlock, SurfaceBlock};
use crate::render::shading::emitters::Lighting;

/// The largest number of samples that are traced together.
pub const SAMPLES: usize = RAYS;

/// Traces and shades samples.
pub enum SampleTracer<'a> {
    /// In packets.
    InPackets { tracer: Box<Tracer<'a>>, shaded: ByRay },
    /// One by one.
    OneByOne { block: Box<HitBlock<'a>>, hits: Vec<Option<Hit>>, places: Vec<usize> },
}

/// The values of each ray of a packet, in each layer.
pub struct ByRay(Vec<Box<ShadedBlock<f64>>>);

impl<'a> SampleTracer<'a> {
    /// For the samples of a scene; `asked_for` lists the lights whose own irradiance is requested.
    pub fn new(
        scene: &'a PreparedScene,
        lighting: &'a Lighting,
        asked_for: &'a [usize],
        instructions: Option<Instructions>,
    ) -> Self {
        if packets::ARE_COMPILED
            && let Some(instructions) = instructions.filter(|of| packets::supports(scene, *of))
        {
            let tracer = Box::new(Tracer::new(Packets { scene, lighting, asked_for, instructions }));
            let shaded = scene.layers().iter().map(|_| ShadedBlock::new(asked_for.len())).collect();
            return Self::InPackets { tracer, shaded: ByRay(shaded) };
        }
        Self::OneByOne { block: Box::new(HitBlock::new(scene, asked_for)), hits: Vec::new(), places: Vec::new() }
    }

    /// Traces and shades samples, up to [`SAMPLES`] of them.
    pub fn trace(&mut self, samples: impl Iterator<Item = Place>) -> Result<(), RenderError> {
        match self {
            Self::InPackets { tracer, shaded } => {
                tracer.trace(samples);
                tracer.shade(shaded)
            }
            Self::OneByOne { block, hits, places } => {
                hits.clear();
                places.clear();
                block.clear();
                for sample in samples {
                    let position = sample.position();
                    let hit = block.trace(position);
                    places.push(block.len());
                    if let Some(hit) = &hit {
                        block.push(0, hit, Some(position));
                    }
                    hits.push(hit);
                }
                Ok(())
            }
        }
    }

    /// What a sample sees.
    pub fn hit(&self, sample: usize) -> Option<&Hit> {
        match self {
            Self::InPackets { tracer, .. } => tracer.hits()[sample].as_ref(),
            Self::OneByOne { hits, .. } => hits[sample].as_ref(),
        }
    }

    /// The values in a layer, and where among them those of a sample that sees something are.
    pub fn values(&self, layer: usize) -> (&ShadedBlock<f64>, impl Fn(usize) -> usize) {
        let (shaded, places) = match self {
            Self::InPackets { shaded, .. } => (&*shaded.0[layer], None),
            Self::OneByOne { block, places, .. } => (block.shaded(layer), Some(places)),
        };
        (shaded, move |sample| places.map_or(sample, |places| places[sample]))
    }
}

impl Output for ByRay {
    fn put(&mut self, layer: usize, rays: &[usize], shaded: &ShadedBlock<f64>) -> Result<(), RenderError> {
        self.0[layer].scatter(rays, shaded);
        Ok(())
    }

    fn put_geometry(&mut self, _: &[usize], _: &SurfaceBlock<f64>) {}
}
