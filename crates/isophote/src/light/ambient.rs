//! Light from all around.

use std::f64::consts::PI;

/// A uniform environment: the same radiance from every direction (3.9).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ambient {
    /// L_a, in W/(m²·sr) or cd/m².
    pub radiance: f64,
    /// The number of directions in which each point looks for shapes in the way; `None` if obstruction is ignored.
    pub obstruction: Option<u32>,
}

impl Ambient {
    /// The default number of directions per point.
    pub const SAMPLES: u32 = 64;

    /// E_a = π L_a: the irradiance of a surface that sees the whole hemisphere of the environment.
    #[must_use]
    pub fn unobstructed_irradiance(&self) -> f64 {
        PI * self.radiance
    }
}
