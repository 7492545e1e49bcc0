//! How many rays a pixel's value is made of.

use super::Filter;

/// How many rays a pixel's value is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampling {
    /// Rays for each pixel; with a tolerance, the most that a pixel gets.
    pub samples: u32,
    /// The error of a pixel's brightness that is allowed, as a part of the largest brightness of the image: pixels
    /// get as many samples as that takes.
    pub tolerance: Option<f64>,
    /// What a pixel is a mean over.
    pub filter: Filter,
}

impl Default for Sampling {
    /// One ray through the centre.
    fn default() -> Self {
        Self { samples: 1, tolerance: None, filter: Filter::Box }
    }
}

impl Sampling {
    /// The most samples that a pixel gets when only a tolerance is given.
    pub const MOST: u32 = 256;

    /// Whether a pixel is more than the value at its centre.
    #[must_use]
    pub fn is_multisampled(self) -> bool {
        self != Self::default()
    }

    /// As outputs say it.
    #[must_use]
    pub fn describe(self) -> String {
        let filter = crate::units::Keyword::name(self.filter);
        match self.tolerance {
            Some(tolerance) => format!("up to {} samples, tolerance {tolerance}, {filter} filter", self.samples),
            None => format!("{} samples, {filter} filter", self.samples),
        }
    }
}
