//! One progress report for several renders.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU64, Ordering};

use super::Observer;

/// Observes one of several renders of the same pixels.
pub struct Share<'o> {
    whole: &'o dyn Observer,
    renders: u64,
    pixels: AtomicU64,
}

impl<'o> Share<'o> {
    /// For this many renders.
    pub fn new(whole: &'o dyn Observer, renders: u64) -> Self {
        Self { whole, renders, pixels: AtomicU64::new(0) }
    }
}

impl Observer for Share<'_> {
    fn advance(&self, pixels: u64) -> ControlFlow<()> {
        let before = self.pixels.fetch_add(pixels, Ordering::Relaxed);
        self.whole.advance((before + pixels) / self.renders - before / self.renders)
    }
}
