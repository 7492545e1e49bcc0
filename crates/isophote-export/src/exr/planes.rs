//! The channels of an EXR file; each holds one 32-bit number per pixel.

use std::ops::Range;

use isophote::map::{Mask, Values};

/// One channel of the file.
pub(super) struct Plane<'m> {
    pub(super) name: &'m str,
    samples: Samples<'m>,
}

/// Where a channel's samples come from.
#[derive(Clone, Copy)]
enum Samples<'m> {
    Double(&'m [f64]),
    Single(&'m [f32]),
    Component(&'m [[f64; 3]], usize),
    Index(&'m [i32]),
}

impl<'m> Plane<'m> {
    /// The channel, or one component of it if it holds vectors.
    pub(super) fn new(name: &'m str, values: &'m Values, component: usize) -> Self {
        let samples = match values {
            Values::Scalar(values) => Samples::Double(values),
            Values::Single(values) => Samples::Single(values),
            Values::Vector(values) => Samples::Component(values, component),
            Values::Index(indices) => Samples::Index(indices),
        };
        Self { name, samples }
    }

    /// The first value without a finite 32-bit counterpart, or index without an exact one, and the index of its pixel.
    pub(super) fn overflow(&self, mask: &Mask) -> Option<(usize, f64)> {
        let too_large = |value: &f64| !single(*value).is_finite();
        mask.runs().iter().find_map(|run| {
            let pixels = run.start..run.end;
            let (offset, value) = match self.samples {
                Samples::Double(values) => find(values[pixels].iter().copied(), too_large),
                Samples::Single(_) => None,
                Samples::Component(values, axis) => find(values[pixels].iter().map(|vector| vector[axis]), too_large),
                Samples::Index(indices) => {
                    let mut indices = indices[pixels].iter().enumerate();
                    indices.find(|(_, index)| !is_exact(**index)).map(|(offset, index)| (offset, f64::from(*index)))
                }
            }?;
            Some((run.start + offset, value))
        })
    }

    /// The bytes stored where no surface is seen.
    pub(super) fn background(&self) -> [u8; 4] {
        match self.samples {
            Samples::Index(_) => (-1.0_f32).to_le_bytes(),
            Samples::Double(_) | Samples::Single(_) | Samples::Component(..) => [0; 4],
        }
    }

    /// Writes the samples of these pixels to `line`.
    pub(super) fn store(&self, pixels: Range<usize>, line: &mut [[u8; 4]]) {
        match self.samples {
            Samples::Double(values) => fill(line, values[pixels].iter().map(|value| single(*value))),
            Samples::Single(values) => fill(line, values[pixels].iter().copied()),
            Samples::Component(values, axis) => fill(line, values[pixels].iter().map(|vector| single(vector[axis]))),
            Samples::Index(indices) => fill(line, indices[pixels].iter().map(|index| single(f64::from(*index)))),
        }
    }
}

fn find(values: impl Iterator<Item = f64>, is_wanted: impl Fn(&f64) -> bool) -> Option<(usize, f64)> {
    values.enumerate().find(|(_, value)| is_wanted(value))
}

#[expect(clippy::cast_possible_truncation, reason = "32 bits are what the format has; overflow is refused")]
fn single(value: f64) -> f32 {
    value as f32
}

#[expect(clippy::cast_possible_truncation, reason = "the loss is what is tested")]
fn is_exact(index: i32) -> bool {
    single(f64::from(index)) as i32 == index
}

fn fill(line: &mut [[u8; 4]], samples: impl Iterator<Item = f32>) {
    for (bytes, sample) in line.iter_mut().zip(samples) {
        *bytes = sample.to_le_bytes();
    }
}
