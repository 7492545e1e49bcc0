//! Light from all around.

use std::f64::consts::PI;

/// A uniform environment: the same radiance from every direction (3.9).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ambient {
    /// L_a, in W/(m²·sr) or cd/m².
    pub radiance: f64,
    /// In how many directions each point looks for shapes that are in the way; nothing where they do not count.
    pub obstruction: Option<u32>,
}

impl Ambient {
    /// In how many directions each point looks by default.
    pub const SAMPLES: u32 = 64;

    /// E_a = π L_a: the irradiance of a surface that has the whole hemisphere of the environment before it.
    #[must_use]
    pub fn unobstructed_irradiance(&self) -> f64 {
        PI * self.radiance
    }
}
