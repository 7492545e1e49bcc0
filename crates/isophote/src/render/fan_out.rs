//! Copies shaded points to the channels of a band.

use super::RenderError;
use super::band::{Band, BandChannel, ScalarChannel};
use super::shading::block::{ShadedBlock, SurfaceBlock};
use crate::lanes::Element;

/// Where the points of a block go, as indices in the band.
#[derive(Clone, Copy)]
pub enum Pixels<'p> {
    /// To consecutive pixels of a row.
    InRow {
        /// The first pixel.
        start: usize,
        /// The number of pixels.
        count: usize,
    },
    /// To any pixels.
    At(&'p [usize]),
}

/// The kernel's output for a block, in either precision.
#[derive(Clone, Copy)]
pub enum Shaded<'s> {
    /// In single precision.
    Single(&'s ShadedBlock<f32>),
    /// In double precision.
    Double(&'s ShadedBlock<f64>),
}

impl<'s> From<&'s ShadedBlock<f32>> for Shaded<'s> {
    fn from(shaded: &'s ShadedBlock<f32>) -> Self {
        Self::Single(shaded)
    }
}

impl<'s> From<&'s ShadedBlock<f64>> for Shaded<'s> {
    fn from(shaded: &'s ShadedBlock<f64>) -> Self {
        Self::Double(shaded)
    }
}

impl<E> ShadedBlock<E> {
    /// The values of the points for a channel.
    pub fn values(&self, channel: ScalarChannel) -> &[E] {
        match channel {
            ScalarChannel::Brightness => &self.brightness,
            ScalarChannel::Irradiance => &self.irradiance,
            ScalarChannel::Ambient => &self.ambient,
            ScalarChannel::AmbientError => &self.ambient_error,
            ScalarChannel::Diffuse => &self.diffuse,
            ScalarChannel::Specular => &self.specular,
            ScalarChannel::Light(place) => &self.by_light[place],
            ScalarChannel::Depth => unreachable!("a distance is no light"),
        }
    }
}

impl Band<'_> {
    /// Writes the points' values in a layer.
    ///
    /// # Errors
    /// A value that a channel of single precision cannot hold.
    pub fn put(&mut self, layer: usize, pixels: Pixels<'_>, shaded: Shaded<'_>) -> Result<(), RenderError> {
        let mut overflow = None;
        for channel in &mut self.layers[layer] {
            let found = match channel {
                BandChannel::Double(ScalarChannel::Depth, _) | BandChannel::Position(_) | BandChannel::Normal(_) => {
                    None
                }
                BandChannel::Double(scalar, out) => put_shaded(shaded, *scalar, pixels, out),
                BandChannel::Single(scalar, out) => put_shaded(shaded, *scalar, pixels, out),
            };
            overflow = overflow.or(found);
        }
        match overflow {
            Some((index, value)) => Err(RenderError::Overflow { pixel: self.pixel(index), value }),
            None => Ok(()),
        }
    }

    /// Writes the geometry of the points.
    pub fn put_geometry(&mut self, pixels: Pixels<'_>, block: &SurfaceBlock<f64>) {
        let length = self.length;
        for channel in self.layers.iter_mut().flatten() {
            match channel {
                BandChannel::Double(ScalarChannel::Depth, out) => {
                    pixels.each(|point, index| out[index] = length.from_metres(block.distance[point] * block.unit));
                }
                BandChannel::Normal(out) => pixels.each(|point, index| out[index] = block.normal_of(point)),
                BandChannel::Position(out) => pixels.each(|point, index| {
                    let position = block.position_of(point).to_array();
                    out[index] = position.map(|coordinate| length.from_metres(coordinate));
                }),
                BandChannel::Double(..) | BandChannel::Single(..) => {}
            }
        }
    }
}

impl Pixels<'_> {
    /// Visits the points: their positions in the block, and their indices in the band.
    #[inline(always)]
    fn each(self, mut visit: impl FnMut(usize, usize)) {
        match self {
            Self::InRow { start, count } => (0..count).for_each(|point| visit(point, start + point)),
            Self::At(indices) => indices.iter().enumerate().for_each(|(point, index)| visit(point, *index)),
        }
    }
}

fn put_shaded<O: Element>(
    shaded: Shaded<'_>,
    channel: ScalarChannel,
    pixels: Pixels<'_>,
    out: &mut [O],
) -> Option<(usize, f64)> {
    match shaded {
        Shaded::Single(shaded) => put(shaded.values(channel), pixels, out),
        Shaded::Double(shaded) => put(shaded.values(channel), pixels, out),
    }
}

/// Writes numbers, and returns the first one that the channel cannot hold.
fn put<E: Element, O: Element>(values: &[E], pixels: Pixels<'_>, out: &mut [O]) -> Option<(usize, f64)> {
    if let (Some(out), Pixels::InRow { start, count }) = (O::cast::<E>(out), pixels) {
        out[start..start + count].copy_from_slice(&values[..count]);
        return None;
    }
    let mut overflow = None;
    pixels.each(|point, index| {
        let value = values[point].to_f64();
        out[index] = O::from_f64(value);
        if overflow.is_none() && !out[index].to_f64().is_finite() {
            overflow = Some((index, value));
        }
    });
    overflow
}
