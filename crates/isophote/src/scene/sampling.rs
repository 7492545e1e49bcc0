//! How many rays are averaged for a pixel's value.

use super::Filter;
use crate::message;
use crate::text::Message;
use crate::units::Keyword;

/// How many rays are averaged for a pixel's value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampling {
    /// Rays per pixel; with a tolerance, the maximum per pixel.
    pub samples: u32,
    /// The allowed error of a pixel's brightness, as a fraction of the largest brightness of the image: pixels get as many
    /// samples as that requires.
    pub tolerance: Option<f64>,
    /// The filter that pixels are averaged with.
    pub filter: Filter,
}

impl Default for Sampling {
    /// One ray through the centre.
    fn default() -> Self {
        Self { samples: 1, tolerance: None, filter: Filter::Box }
    }
}

impl Sampling {
    /// The maximum number of samples per pixel if only a tolerance is given.
    pub const MOST: u32 = super::limits::SAMPLES;

    /// Whether a pixel is more than the value at its centre.
    #[must_use]
    pub fn is_multisampled(self) -> bool {
        self != Self::default()
    }

    /// The description in outputs.
    #[must_use]
    pub fn describe(self) -> Message {
        let (samples, filter) = (self.samples, self.filter.name());
        match self.tolerance {
            Some(tolerance) => {
                message!("up to {samples} samples, tolerance {tolerance}, {filter} filter", samples, tolerance, filter)
            }
            None => message!("{samples} samples, {filter} filter", samples, filter),
        }
    }
}
