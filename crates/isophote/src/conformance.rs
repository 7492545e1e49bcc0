//! The conformance suite that every renderer passes.

use crate::color::Rgb;
use crate::double_double::DoubleDouble;
use crate::light::{Emission, Light, LightKind, PointLight};
use crate::map::{Map, Pixel, Quantity, Region, Scalars, Values};
use crate::prepare::PreparedScene;
use crate::real::Real;
use crate::render::{RenderError, RenderSettings, Renderer};
use crate::scalar::Scalar;
use crate::shade::LightTerm;
use crate::tolerance::{AT_JUMP, DOUBLE, Tolerance};
use crate::vector::Vector;

/// The deviation of a renderer from exact arithmetic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// The largest error, as a fraction of the map's peak.
    pub of_peak: f64,
    /// The largest relative error where the cosines are large enough.
    pub relative: f64,
    /// The largest relative error, whatever the cosines, of values above a thousandth of the peak.
    pub at_edges: f64,
    /// The number of compared pixels.
    pub visible: usize,
}

/// Why a renderer does not conform.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NonConformance {
    /// It did not render at all.
    #[error("{0}")]
    Render(#[from] RenderError),
    /// It sees a surface where there is none, none where there is one, or the wrong one.
    #[error("column {}, row {}: sees shape {found}, should see {expected} (−1: none)", pixel.column, pixel.row)]
    Visibility {
        /// The pixel.
        pixel: Pixel,
        /// The shape that it sees.
        found: i32,
        /// The shape that it should see.
        expected: i32,
    },
    /// A pixel without a surface that is not zero.
    #[error("column {}, row {}: {channel} is {value} where no surface is", pixel.column, pixel.row)]
    NotZero {
        /// The pixel.
        pixel: Pixel,
        /// The channel.
        channel: String,
        /// The value.
        value: f64,
    },
    /// A value whose error is too large.
    #[error(
        "column {}, row {}: {channel} is {found:e} instead of {expected:e}: off by {error:e} {of}, allowed {allowed:e}",
        pixel.column, pixel.row
    )]
    Value {
        /// The pixel.
        pixel: Pixel,
        /// The channel.
        channel: String,
        /// The rendered value.
        found: f64,
        /// The correct value.
        expected: f64,
        /// The error.
        error: f64,
        /// `of the peak`, `relative` or `absolutely`.
        of: &'static str,
        /// The allowed error.
        allowed: f64,
    },
}

/// The channels whose error is measured.
const COMPARED: [Quantity; 5] =
    [Quantity::Brightness, Quantity::Irradiance, Quantity::Diffuse, Quantity::Specular, Quantity::Ambient];
const BRIGHTNESS: usize = 0;
const IRRADIANCE: usize = 1;
const SPECULAR: usize = 3;

/// Compares a renderer with the same formulas in 32 digits, pixel by pixel: the visible shapes, and zeros where there is no
/// surface; brightness, irradiance and its parts, including those of single lights; depth, position and normal. In a scene
/// with colours, each component.
///
/// # Errors
/// The first pixel that is out of tolerance.
pub fn conforms(
    renderer: &dyn Renderer,
    scene: &PreparedScene,
    tolerance: &Tolerance,
) -> Result<Deviation, NonConformance> {
    let Some(components) = scene.components() else { return conforms_in_single_numbers(renderer, scene, tolerance) };
    let component = |scene| conforms_in_single_numbers(renderer, scene, tolerance);
    let Rgb { red, green, blue } = components.scenes();
    Ok(component(red)?.or_worse(&component(green)?).or_worse(&component(blue)?))
}

fn conforms_in_single_numbers(
    renderer: &dyn Renderer,
    scene: &PreparedScene,
    tolerance: &Tolerance,
) -> Result<Deviation, NonConformance> {
    let lights = scene.scene().lights().iter().map(|light| Quantity::Light(light.name.clone()));
    let geometry = [Quantity::Depth, Quantity::Position, Quantity::Normal];
    let quantities = COMPARED.into_iter().chain(geometry).chain(lights).collect();
    let settings = RenderSettings { quantities, ..RenderSettings::default() };
    let map = renderer.render(scene, &settings)?;
    let exact = Exact::new(scene, map.region, tolerance);
    let mut deviation = Deviation { of_peak: 0.0, relative: 0.0, at_edges: 0.0, visible: 0 };
    let shapes = map.mask().shapes();
    for (index, expected) in exact.pixels.iter().enumerate() {
        let pixel = map.pixel(index);
        let found = shapes[index];
        let expected_shape = expected.as_ref().map_or(-1, |expected| expected.shape);
        if found != expected_shape {
            return Err(NonConformance::Visibility { pixel, found, expected: expected_shape });
        }
        for (channel, quantity) in COMPARED.iter().enumerate() {
            let found = map.scalar(quantity).map_or(f64::NAN, |values| values.at(index));
            match expected {
                None if found == 0.0 => {}
                None => return Err(NonConformance::NotZero { pixel, channel: quantity.name(), value: found }),
                Some(expected) if expected.is_at_jump && matches!(channel, BRIGHTNESS | SPECULAR) => {}
                Some(expected) => {
                    let peak = exact.peaks[channel];
                    let compared = Compared { pixel, quantity, found, peak, flank: expected.flank(channel) };
                    compared.compare(expected.values[channel], expected.least_cosine, tolerance, &mut deviation)?;
                }
            }
        }
        if let Some(expected) = expected {
            compare_geometry(&map, index, expected, &DOUBLE)?;
            compare_lights(&map, index, expected, &exact.peaks[IRRADIANCE], tolerance)?;
            deviation.visible += 1;
        }
    }
    Ok(deviation)
}

impl Deviation {
    fn or_worse(self, other: &Self) -> Self {
        Self {
            of_peak: self.of_peak.max(other.of_peak),
            relative: self.relative.max(other.relative),
            at_edges: self.at_edges.max(other.at_edges),
            visible: self.visible,
        }
    }
}

/// The results of exact arithmetic, to 32 digits.
struct Exact {
    pixels: Vec<Option<ExactPixel>>,
    /// The brightest pixel of each compared channel.
    peaks: [Peak; 5],
}

#[derive(Clone, Copy)]
struct Peak {
    value: f64,
    /// How much larger than usual the tolerance is because the map shows no more of some light than its terminator or the
    /// flank of its highlight, or no more of the shapes than their limb.
    growth: f64,
}

/// What one light, or the ambient light, contributes to the compared channels.
#[derive(Clone, Copy)]
struct Share {
    values: [f64; 5],
    /// cosθ_o times the smaller of cosθ_i and its [own](cosine_of_emission) cosine: near the limb the normal is uncertain as
    /// 1/cosθ_o, which the terminator magnifies by 1/cosθ_i.
    cosines: f64,
    /// n tanθ_h of its highlight.
    flank: f64,
}

impl Share {
    /// How much larger the tolerance of this share is than that of a place that loses no digits.
    fn growth(&self, channel: usize, tolerance: &Tolerance) -> f64 {
        let of_highlight = if matches!(channel, BRIGHTNESS | SPECULAR) && self.values[channel] > 0.0 {
            self.values[SPECULAR] / self.values[channel]
        } else {
            0.0
        };
        tolerance.growth(self.cosines) * (1.0 + of_highlight * self.flank / tolerance.flank)
    }
}

struct ExactPixel {
    shape: i32,
    values: [f64; 5],
    /// The share of each light, and at last that of the ambient light.
    shares: Vec<Share>,
    /// The smallest of cosθ_o, the lit lights' cosθ_i and [their own](cosine_of_emission) cosines.
    least_cosine: f64,
    /// The distance, in metres.
    distance: f64,
    /// The position, in metres.
    position: Vector,
    normal: Vector,
    /// R, in metres.
    size: f64,
    /// Whether it is so close to a terminator where B jumps that it may be on
    /// either side.
    is_at_jump: bool,
}

impl ExactPixel {
    /// n tanθ_h of the highlights, weighted by their share in the value of a channel.
    fn flank(&self, channel: usize) -> f64 {
        let value = self.values[channel];
        if !matches!(channel, BRIGHTNESS | SPECULAR) || value == 0.0 {
            return 0.0;
        }
        self.shares.iter().map(|share| share.flank * share.values[SPECULAR]).sum::<f64>() / value
    }
}

impl Exact {
    fn new(scene: &PreparedScene, region: Region, tolerance: &Tolerance) -> Self {
        let mut pixels = Vec::with_capacity(region.size.pixels());
        for row in region.corner.row..region.corner.row + region.size.height {
            for column in region.corner.column..region.corner.column + region.size.width {
                pixels.push(exact_pixel(scene, Pixel { column, row }));
            }
        }
        let peaks = std::array::from_fn(|channel| Peak::of(&pixels, channel, tolerance));
        Self { pixels, peaks }
    }
}

impl Peak {
    fn of(pixels: &[Option<ExactPixel>], channel: usize, tolerance: &Tolerance) -> Self {
        let seen = || pixels.iter().flatten();
        let value = seen().map(|pixel| pixel.values[channel]).fold(0.0, f64::max);
        let sources = seen().next().map_or(0, |pixel| pixel.shares.len());
        let grown = (0..sources).map(|source| {
            let shares = seen().map(|pixel| pixel.shares[source]);
            let brightest = shares.max_by(|one, other| one.values[channel].total_cmp(&other.values[channel]));
            brightest.map_or(0.0, |share| share.growth(channel, tolerance) * share.values[channel])
        });
        let grown = grown.fold(value, f64::max);
        Self { value, growth: if value > 0.0 { grown / value } else { 1.0 } }
    }

    /// The error allowed at any pixel, as a fraction of the peak.
    fn allowed(&self, tolerance: &Tolerance) -> f64 {
        tolerance.of_peak * self.growth
    }
}

fn exact_pixel(scene: &PreparedScene, pixel: Pixel) -> Option<ExactPixel> {
    let hit = scene.trace_precisely(crate::camera::ScreenPosition::PixelCenter(pixel))?;
    let cos_theta_o = hit.point.cos_theta_o.rounded();
    let mut least_cosine = cos_theta_o;
    let formula = scene.formula(hit.primitive);
    let shininess = formula.sharpness().unwrap_or(0.0);
    let mut is_at_jump = false;
    let mut shares = Vec::with_capacity(scene.scene().lights().len() + 1);
    let shading = scene.shade_precisely(&hit, |light, term| {
        let (diffuse, specular) = (term.diffuse(formula, &hit.point), term.specular(formula, &hit.point));
        let cosine = term.cos_theta_h.rounded();
        let has_highlight = DoubleDouble::zero().is_less(specular);
        let flank = if has_highlight { shininess * (1.0 / (cosine * cosine) - 1.0).max(0.0).sqrt() } else { 0.0 };
        let slant = hit.point.normal.dot(term.direction).rounded();
        is_at_jump |= formula.jumps_at_terminator() && slant.abs() < AT_JUMP;
        let of_emission = cosine_of_emission(&scene.scene().lights()[light], term);
        let share = Share {
            values: [diffuse + specular, term.irradiance, diffuse, specular, DoubleDouble::zero()]
                .map(DoubleDouble::rounded),
            cosines: cos_theta_o * term.cos_theta_i.rounded().min(of_emission),
            flank,
        };
        if DoubleDouble::zero().is_less(term.irradiance) {
            least_cosine = least_cosine.min(term.cos_theta_i.rounded()).min(of_emission);
        }
        shares.push(share);
    });
    let ambient = shading.ambient * formula.diffuse_factor(hit.point.cos_theta_o);
    shares.push(Share {
        values: [ambient, shading.ambient, ambient, DoubleDouble::zero(), shading.ambient].map(DoubleDouble::rounded),
        cosines: cos_theta_o,
        flank: 0.0,
    });
    let values = [shading.brightness(), shading.irradiance, shading.diffuse, shading.specular, shading.ambient];
    let values = values.map(DoubleDouble::rounded);
    Some(ExactPixel {
        shape: i32::try_from(hit.primitive.shape).unwrap_or(i32::MAX),
        values,
        shares,
        least_cosine,
        distance: hit.distance.rounded(),
        position: rounded(hit.point.position()),
        normal: rounded(hit.point.normal),
        size: scene.scene().shapes()[hit.primitive.shape].geometry.size_near(rounded(hit.point.position())),
        is_at_jump,
    })
}

/// cosγ of a Lambertian light: the relative error of its intensity is that of a direction over cosγ. For any other light,
/// the equivalent number; 1 if the intensity does not depend on the direction.
#[must_use]
pub fn cosine_of_emission(light: &Light, term: &LightTerm<DoubleDouble>) -> f64 {
    match &light.kind {
        LightKind::Parallel(_) | LightKind::Point(PointLight { emission: Emission::Isotropic, .. }) => 1.0,
        LightKind::Point(PointLight { emission: Emission::Lambertian { .. }, intensity, .. }) => {
            (term.intensity / DoubleDouble::from_f64(*intensity)).rounded()
        }
        LightKind::Point(PointLight { emission: Emission::Spot(spot), .. }) => {
            1.0 / spot.relative_growth(rounded(term.direction)).max(1.0)
        }
    }
}

fn rounded(vector: Vector<DoubleDouble>) -> Vector {
    vector.map(DoubleDouble::rounded)
}

/// Lengths relative to themselves and to the shape's size, the normal relative to its length, which is 1.
fn compare_geometry(
    map: &Map,
    index: usize,
    expected: &ExactPixel,
    tolerance: &Tolerance,
) -> Result<(), NonConformance> {
    let pixel = map.pixel(index);
    let length = map.window.length;
    let allowed = |size: f64| tolerance.of_peak * length.from_metres(size + expected.size);
    let depth = map.scalar(&Quantity::Depth).map_or(f64::NAN, |values| values.at(index));
    let exact_depth = length.from_metres(expected.distance);
    within(pixel, &Quantity::Depth, depth, exact_depth, allowed(expected.distance))?;
    let position = expected.position.to_array().map(|coordinate| length.from_metres(coordinate));
    let of_position = allowed(expected.position.length());
    for (quantity, expected, allowed) in
        [(Quantity::Position, position, of_position), (Quantity::Normal, expected.normal.to_array(), tolerance.of_peak)]
    {
        let found = match map.channel(&quantity).map(|channel| &channel.values) {
            Some(Values::Vector(values)) => values[index],
            _ => [f64::NAN; 3],
        };
        for (found, expected) in found.into_iter().zip(expected) {
            within(pixel, &quantity, found, expected, allowed)?;
        }
    }
    Ok(())
}

/// Each light's share, as a fraction of the brightest irradiance of all lights.
fn compare_lights(
    map: &Map,
    index: usize,
    expected: &ExactPixel,
    peak: &Peak,
    tolerance: &Tolerance,
) -> Result<(), NonConformance> {
    let lights = map.channels().iter().filter(|channel| matches!(channel.quantity, Quantity::Light(_)));
    let mut lights = lights.map(|channel| (&channel.quantity, Scalars::of(&channel.values)));
    let (_ambient, of_lights) = expected.shares.split_last().expect("the ambient light is the last of them");
    for Share { values: exact, .. } in of_lights {
        let expected = &exact[IRRADIANCE];
        let Some((quantity, Some(values))) = lights.next() else {
            return within(map.pixel(index), &Quantity::Irradiance, f64::NAN, *expected, 0.0);
        };
        within(map.pixel(index), quantity, values.at(index), *expected, peak.allowed(tolerance) * peak.value)?;
    }
    Ok(())
}

fn within(pixel: Pixel, quantity: &Quantity, found: f64, expected: f64, allowed: f64) -> Result<(), NonConformance> {
    let error = (found - expected).abs();
    // Written so that NaN fails.
    if !(error <= allowed) {
        let channel = quantity.name();
        return Err(NonConformance::Value { pixel, channel, found, expected, error, of: "absolutely", allowed });
    }
    Ok(())
}

struct Compared<'q> {
    pixel: Pixel,
    quantity: &'q Quantity,
    found: f64,
    peak: Peak,
    flank: f64,
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
        if peak < tolerance.least_peak && self.found < 2.0 * tolerance.least_peak {
            return Ok(());
        }
        let of_peak = if peak > 0.0 { difference / peak } else { difference };
        deviation.of_peak = deviation.of_peak.max(of_peak);
        let allowed = self.peak.allowed(tolerance);
        // Written so that NaN fails.
        if !(of_peak <= allowed) {
            return Err(self.off(expected, of_peak, "of the peak", allowed));
        }
        let relative = difference / expected;
        if least_cosine > tolerance.above_cosine && expected > tolerance.above_value * peak {
            deviation.relative = deviation.relative.max(relative);
            let allowed = tolerance.relative * (1.0 + self.flank / tolerance.flank);
            if !(relative <= allowed) {
                return Err(self.off(expected, relative, "relative", allowed));
            }
        }
        if expected > 1e-3 * peak {
            deviation.at_edges = deviation.at_edges.max(relative);
            let allowed = tolerance.at_edge(least_cosine, self.peak.growth);
            if !(relative <= allowed) {
                return Err(self.off(expected, relative, "relative", allowed));
            }
        }
        Ok(())
    }

    fn off(&self, expected: f64, error: f64, of: &'static str, allowed: f64) -> NonConformance {
        let Self { pixel, quantity, found, .. } = *self;
        NonConformance::Value { pixel, channel: quantity.name(), found, expected, error, of, allowed }
    }
}
