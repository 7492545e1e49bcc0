//! The one suite that every renderer passes, and the one table of tolerances that tests read.

use crate::double_double::DoubleDouble;
use crate::map::{Pixel, Quantity, Region};
use crate::prepare::PreparedScene;
use crate::real::Real;
use crate::render::{RenderError, RenderSettings, Renderer};

/// How far a value may be from that of exact arithmetic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// At every visible pixel, limb included, as a part of the map's peak.
    pub of_peak: f64,
    /// Where even the brightest pixel has a cosine below this, the picture shows nothing but the neighbourhood of the
    /// terminator or of the limb: all of it is then as uncertain as that cosine, and `of_peak` grows as 1/cosine.
    pub peak_cosine: f64,
    /// Relative, wherever both cosθ_i of every lit light and cosθ_o exceed [`above_cosine`](Self::above_cosine).
    pub relative: f64,
    /// Towards the limb and the terminator the problem itself loses digits, as 1/cosine.
    pub above_cosine: f64,
}

/// Maps in double precision. Holds while every light is at least a thousandth of a shape's size away from its
/// surface: next to a light, E ∝ 1/r² loses the digits that r has lost, whatever the arithmetic.
pub const DOUBLE: Tolerance = Tolerance { of_peak: 1e-12, peak_cosine: 1e-2, relative: 1e-12, above_cosine: 0.1 };

/// Values at a given point: nothing is lost in finding the point, so the cosines may be smaller.
pub const PROBE: Tolerance = Tolerance { above_cosine: 1e-3, ..DOUBLE };

/// What was found when a renderer was held against exact arithmetic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// The largest error, as a part of the map's peak.
    pub of_peak: f64,
    /// The largest relative error where the cosines are large enough.
    pub relative: f64,
    /// Pixels that were compared.
    pub visible: usize,
}

/// Why a renderer does not conform.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NonConformance {
    /// It did not render at all.
    #[error("{0}")]
    Render(#[from] RenderError),
    /// It sees a surface where there is none, none where there is one, or another one.
    #[error("column {}, row {}: sees shape {found}, should see {expected} (−1: none)", pixel.column, pixel.row)]
    Visibility {
        /// Where.
        pixel: Pixel,
        /// What it sees.
        found: i32,
        /// What is to be seen.
        expected: i32,
    },
    /// A pixel without a surface is not zero.
    #[error("column {}, row {}: {channel} is {value} where no surface is", pixel.column, pixel.row)]
    NotZero {
        /// Where.
        pixel: Pixel,
        /// Of what.
        channel: String,
        /// The value.
        value: f64,
    },
    /// A value is too far off.
    #[error(
        "column {}, row {}: {channel} is {found:e} instead of {expected:e}: off by {error:e} {of}, allowed {allowed:e}",
        pixel.column, pixel.row
    )]
    Value {
        /// Where.
        pixel: Pixel,
        /// Of what.
        channel: String,
        /// What it says.
        found: f64,
        /// What is right.
        expected: f64,
        /// How far off it is.
        error: f64,
        /// `of the peak` or `relative`.
        of: &'static str,
        /// How far off it may be.
        allowed: f64,
    },
}

/// The channels that are compared.
const COMPARED: [Quantity; 4] = [Quantity::Brightness, Quantity::Irradiance, Quantity::Diffuse, Quantity::Specular];

/// Holds a renderer against the same formulas in 32 digits, pixel by pixel: brightness, irradiance and its parts, what
/// is seen, and that nothing is where no surface is.
///
/// # Errors
/// The first pixel that is out of tolerance.
pub fn conforms(
    renderer: &dyn Renderer,
    scene: &PreparedScene,
    tolerance: &Tolerance,
) -> Result<Deviation, NonConformance> {
    let settings = RenderSettings { quantities: COMPARED.to_vec(), ..RenderSettings::default() };
    let map = renderer.render(scene, &settings)?;
    let exact = Exact::new(scene, map.region);
    let mut deviation = Deviation { of_peak: 0.0, relative: 0.0, visible: 0 };
    for (index, expected) in exact.pixels.iter().enumerate() {
        let pixel = map.pixel(index);
        let found = map.shapes()[index];
        let expected_shape = expected.as_ref().map_or(-1, |expected| expected.shape);
        if found != expected_shape {
            return Err(NonConformance::Visibility { pixel, found, expected: expected_shape });
        }
        for (channel, quantity) in COMPARED.iter().enumerate() {
            let found = map.scalar(quantity).map_or(f64::NAN, |values| values[index]);
            match expected {
                None if found == 0.0 => {}
                None => return Err(NonConformance::NotZero { pixel, channel: quantity.name(), value: found }),
                Some(expected) => {
                    let compared = Compared { pixel, quantity, found, peak: exact.peaks[channel] };
                    compared.compare(expected.values[channel], expected.least_cosine, tolerance, &mut deviation)?;
                }
            }
        }
        deviation.visible += usize::from(expected.is_some());
    }
    Ok(deviation)
}

/// What exact arithmetic gives, to 32 digits.
struct Exact {
    pixels: Vec<Option<ExactPixel>>,
    /// The brightest pixel of each compared channel.
    peaks: [Peak; 4],
}

#[derive(Clone, Copy)]
struct Peak {
    value: f64,
    least_cosine: f64,
}

struct ExactPixel {
    shape: i32,
    values: [f64; 4],
    /// The smallest of cosθ_o and the lit lights' cosθ_i.
    least_cosine: f64,
}

impl Exact {
    fn new(scene: &PreparedScene, region: Region) -> Self {
        let mut peaks = [Peak { value: 0.0, least_cosine: 1.0 }; 4];
        let mut pixels = Vec::with_capacity(region.size.pixels());
        for row in region.corner.row..region.corner.row + region.size.height {
            for column in region.corner.column..region.corner.column + region.size.width {
                let pixel = exact_pixel(scene, Pixel { column, row });
                if let Some(pixel) = &pixel {
                    for (peak, value) in peaks.iter_mut().zip(pixel.values) {
                        if value > peak.value {
                            *peak = Peak { value, least_cosine: pixel.least_cosine };
                        }
                    }
                }
                pixels.push(pixel);
            }
        }
        Self { pixels, peaks }
    }
}

fn exact_pixel(scene: &PreparedScene, pixel: Pixel) -> Option<ExactPixel> {
    let hit = scene.trace_precisely(crate::camera::ScreenPosition::PixelCenter(pixel))?;
    let mut least_cosine = hit.point.cos_theta_o;
    let shading = scene.shade(hit.shape, &hit.point, |_, term| {
        let is_lit = DoubleDouble::zero().is_less(term.irradiance);
        if is_lit && term.cos_theta_i.is_less(least_cosine) {
            least_cosine = term.cos_theta_i;
        }
    });
    let values = [shading.brightness(), shading.irradiance, shading.diffuse, shading.specular];
    Some(ExactPixel {
        shape: i32::try_from(hit.shape).unwrap_or(i32::MAX),
        values: values.map(DoubleDouble::rounded),
        least_cosine: least_cosine.rounded(),
    })
}

struct Compared<'q> {
    pixel: Pixel,
    quantity: &'q Quantity,
    found: f64,
    peak: Peak,
}

impl Compared<'_> {
    fn compare(
        &self,
        expected: f64,
        least_cosine: f64,
        tolerance: &Tolerance,
        deviation: &mut Deviation,
    ) -> Result<(), NonConformance> {
        let difference = (self.found - expected).abs();
        let peak = self.peak.value;
        let of_peak = if peak > 0.0 { difference / peak } else { difference };
        deviation.of_peak = deviation.of_peak.max(of_peak);
        let allowed = tolerance.of_peak * (tolerance.peak_cosine / self.peak.least_cosine).max(1.0);
        // Written so that NaN fails.
        if !(of_peak <= allowed) {
            return Err(self.off(expected, of_peak, "of the peak", allowed));
        }
        // A highlight goes on falling for ever, and its relative error grows as it falls; nobody sees it by then.
        if least_cosine > tolerance.above_cosine && expected > 1e-6 * peak {
            let relative = difference / expected;
            deviation.relative = deviation.relative.max(relative);
            if !(relative <= tolerance.relative) {
                return Err(self.off(expected, relative, "relative", tolerance.relative));
            }
        }
        Ok(())
    }

    fn off(&self, expected: f64, error: f64, of: &'static str, allowed: f64) -> NonConformance {
        let Self { pixel, quantity, found, .. } = *self;
        NonConformance::Value { pixel, channel: quantity.name(), found, expected, error, of, allowed }
    }
}
