//! A picture of one channel, normalised: the only place where numbers become grey levels or colours.

mod color;

use std::io::{BufRead, Seek, Write};

use super::{ExportError, FileMetadata, Format, PictureMetadata, channel, csv::Number, one_line, read::LONGEST_JSON};
use crate::analysis::statistics::largest;
use crate::map::{Channel, Map, Quantity, Scalars, Values};

/// Keyword of the text chunk that holds a picture's metadata.
pub(super) const METADATA_KEYWORD: &str = "isophote";

/// Writes the picture, row 0 on top; missed pixels are black, with a colour map too.
///
/// A value v becomes ((v − black)/(white − black))^(1/gamma), times 255 or 65535, rounded to nearest.
/// Colours are scaled by one range, which is from 0 to the largest component by default, and shown in sRGB with its own
/// transfer function, whatever space they are of.
/// Text chunks `Title`, `Software`, `Description` and `isophote` (the metadata's JSON) come before the pixels.
///
/// # Errors
/// No such channel, or not a scalar one; a range, gamma or depth that makes no picture; an error of `out`.
pub fn write(map: &Map, options: &PictureOptions, out: &mut impl Write) -> Result<PictureReport, ExportError> {
    let channel = channel(map, &options.quantity)?;
    if let (Quantity::Color, Values::Vector(colors)) = (&channel.quantity, &channel.values) {
        return color::write(map, channel, colors, options, out);
    }
    let values = options.validate(channel)?;
    let range = options.range_for(map, channel, values)?;

    let mut encoder = png::Encoder::new(out, map.region.size.width, map.region.size.height);
    encoder.set_color(if options.color.is_some() { png::ColorType::Rgb } else { png::ColorType::Grayscale });
    encoder.set_depth(match options.depth {
        Depth::Eight => png::BitDepth::Eight,
        Depth::Sixteen => png::BitDepth::Sixteen,
    });
    set_compression(&mut encoder, options.depth);
    for (keyword, text) in texts(map, channel, options, range) {
        encoder.add_itxt_chunk(keyword.into(), text).map_err(from_png)?;
    }
    // No gAMA chunk: browsers would brighten a proportional picture by it, most other programs ignore it, and the
    // same file would look different in each. Without it all show the numbers in the file, those that the
    // description explains.
    let mut writer = encoder.write_header().map_err(from_png)?;
    let mut pixels = writer.stream_writer_with_size(CHUNK).map_err(from_png)?;
    let report = quantize(map, values, options, range, &mut pixels)?;
    pixels.finish().map_err(from_png)?;
    writer.finish().map_err(from_png)?;
    Ok(report)
}

/// What a picture shows and how.
#[derive(Clone)]
pub struct PictureOptions<'a> {
    /// The channel: a scalar one, or colours.
    pub quantity: Quantity,
    /// The values of black and white in the channel's unit; by default 0 and the greatest visible value.
    pub range: Option<[f64; 2]>,
    /// 1 is proportional, 2.2 lifts the dark parts; finite and above 0.
    pub gamma: f64,
    /// Bits of a sample.
    pub depth: Depth,
    /// Colours in place of grey levels, 8 bits only.
    pub color: Option<PictureColor<'a>>,
}

impl PictureOptions<'_> {
    /// Eight bits of grey, proportional to the channel, its greatest value white.
    #[must_use]
    pub fn new(quantity: Quantity) -> Self {
        Self { quantity, range: None, gamma: 1.0, depth: Depth::Eight, color: None }
    }

    fn validate<'v>(&self, channel: &'v Channel) -> Result<Scalars<'v>, ExportError> {
        if !(self.gamma > 0.0 && self.gamma.is_finite()) {
            return Err(ExportError::Gamma { gamma: self.gamma });
        }
        if let (Some(color), Depth::Sixteen) = (&self.color, self.depth) {
            return Err(ExportError::ColorDepth { color: color.name.into() });
        }
        let holds = match &channel.values {
            Values::Scalar(values) => return Ok(Scalars::Double(values)),
            Values::Single(values) => return Ok(Scalars::Single(values)),
            Values::Vector(_) => "three numbers",
            Values::Index(_) => "an index",
        };
        Err(ExportError::NotPicture { name: channel.quantity.name(), holds })
    }

    fn range_for(&self, map: &Map, channel: &Channel, values: Scalars<'_>) -> Result<[f64; 2], ExportError> {
        let [black, white] =
            self.range.unwrap_or_else(|| [0.0, largest(map.mask(), values).map_or(0.0, |white| white.max(0.0))]);
        let sound = (white - black).is_finite() && (black < white || self.range.is_none());
        if sound {
            Ok([black, white])
        } else {
            Err(ExportError::Range { name: channel.quantity.name(), range: [black, white] })
        }
    }
}

/// A named colour map.
#[derive(Clone, Copy)]
pub struct PictureColor<'a> {
    /// Its name, for the file's description.
    pub name: &'a str,
    /// The sRGB colour of a number from 0 to 1.
    pub color: &'a dyn Fn(f64) -> [u8; 3],
}

/// Bits of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    /// 0 to 255.
    Eight,
    /// 0 to 65535.
    Sixteen,
}

impl Depth {
    /// 8 or 16.
    #[must_use]
    pub fn bits(self) -> u8 {
        match self {
            Self::Eight => 8,
            Self::Sixteen => 16,
        }
    }
}

/// What became of the values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PictureReport {
    /// The values of black and white in the channel's unit; both are 0 where no visible value is positive.
    pub range: [f64; 2],
    /// Visible pixels below black, shown as black.
    pub clamped_below: usize,
    /// Visible pixels above white, shown as white.
    pub clamped_above: usize,
}

/// Bytes of compressed pixels that are written at once.
const CHUNK: usize = 1 << 16;

/// Writes row after row: a buffer for the whole picture would take longer to get from the system than to fill.
fn quantize(
    map: &Map,
    values: Scalars<'_>,
    options: &PictureOptions,
    range: [f64; 2],
    out: &mut impl Write,
) -> Result<PictureReport, ExportError> {
    let mut report = PictureReport { range, clamped_below: 0, clamped_above: 0 };
    let (width, bytes) = (map.region.size.width as usize, bytes_per_pixel(options));
    let mut row = vec![0; width * bytes];
    let mut runs = map.mask().runs();
    for start in (0..values.len()).step_by(width) {
        row.fill(0);
        let (in_row, below) = runs.split_at(runs.partition_point(|run| run.start < start + width));
        runs = below;
        for run in in_row {
            let pixels = &mut row[(run.start - start) * bytes..(run.end - start) * bytes];
            let seen = run.start..run.end;
            match values {
                Scalars::Double(values) => paint(values[seen].iter().copied(), pixels, options, &mut report),
                Scalars::Single(values) => {
                    paint(values[seen].iter().copied().map(f64::from), pixels, options, &mut report);
                }
            }
        }
        out.write_all(&row)?;
    }
    Ok(report)
}

fn paint(values: impl Iterator<Item = f64>, pixels: &mut [u8], options: &PictureOptions, report: &mut PictureReport) {
    let [black, white] = report.range;
    let exponent = options.gamma.recip();
    let levels = values.map(|value| {
        report.clamped_below += usize::from(value < black);
        report.clamped_above += usize::from(value > white);
        // 0/0 would be no number in a map without light.
        let linear = if black < white { ((value - black) / (white - black)).clamp(0.0, 1.0) } else { 0.0 };
        #[expect(clippy::float_cmp, reason = "1 is the exact default, and then powers are not worth their time")]
        if exponent == 1.0 { linear } else { libm::pow(linear, exponent) }
    });
    match (&options.color, options.depth) {
        (Some(color), _) => fill(pixels, levels.map(color.color)),
        (None, Depth::Eight) => fill(pixels, levels.map(|level| [rounded(level * 255.0).to_be_bytes()[1]])),
        (None, Depth::Sixteen) => fill(pixels, levels.map(|level| rounded(level * 65535.0).to_be_bytes())),
    }
}

fn fill<const BYTES: usize>(pixels: &mut [u8], colors: impl Iterator<Item = [u8; BYTES]>) {
    let (pixels, _) = pixels.as_chunks_mut();
    for (pixel, color) in pixels.iter_mut().zip(colors) {
        *pixel = color;
    }
}

/// To nearest, a half upwards, as `f64::round` does for what is not negative; that is a call on machines without
/// SSE4.1, and then costs more than the division. Both steps are exact.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a level is between 0 and 65535")]
pub(super) fn rounded(level: f64) -> u16 {
    let whole = level as u16;
    whole + u16::from(level - f64::from(whole) >= 0.5)
}

fn bytes_per_pixel(options: &PictureOptions) -> usize {
    if options.color.is_some() { 3 } else { usize::from(options.depth.bits() / 8) }
}

fn texts(map: &Map, channel: &Channel, options: &PictureOptions, range: [f64; 2]) -> [(&'static str, String); 4] {
    let mut metadata = FileMetadata::of_channel(map, channel);
    metadata.picture = Some(PictureMetadata {
        range,
        gamma: options.gamma,
        depth: options.depth.bits(),
        colormap: options.color.map(|color| color.name.into()),
        encoding: None,
    });
    [
        ("Title", one_line(&map.provenance.title)),
        ("Software", one_line(&map.provenance.program)),
        ("Description", one_line(&description(map, channel, options, range))),
        (METADATA_KEYWORD, metadata.to_json()),
    ]
}

/// Level 3 of zlib-rs, rows predicted from the left neighbour for 8 bits and from the upper one for 16. Compressing the
/// lab's picture of 800×600 (3840×2160) takes 0.35 ms and 9.4 kB (5 ms, 70 kB) for 8 bits, 1.0 ms and 48 kB (20 ms,
/// 407 kB) for 16. Level 2 takes 0.26 ms and 10.8 kB (4.5 ms, 94 kB), level 4 0.45 ms and 8.6 kB; the encoder's `Fast`
/// 0.08 ms, but 19 kB (1.7 ms, 197 kB).
fn set_compression(encoder: &mut png::Encoder<impl Write>, depth: Depth) {
    encoder.set_deflate_compression(png::DeflateCompression::Level(3));
    encoder.set_filter(match depth {
        Depth::Eight => png::Filter::Sub,
        Depth::Sixteen => png::Filter::Up,
    });
}

fn description(map: &Map, channel: &Channel, options: &PictureOptions, range: [f64; 2]) -> String {
    let space = map.provenance.color_space.as_ref().map_or(String::new(), |space| format!(", luminance in {space}"));
    let (quantity, convention) = (channel.quantity.name(), format!("{}{space}", map.provenance.convention));
    let [black, white] = range.map(|value| with_unit(value, &channel.unit));
    #[expect(clippy::float_cmp, reason = "1 is the exact default")]
    let level = if options.gamma == 1.0 {
        "level proportional to the value (linear, not gamma-encoded)".into()
    } else {
        format!("level = (share of the way between them)^(1/{})", options.gamma)
    };
    match options.color {
        None => format!("{quantity}, {convention}; black is {black}, white is {white}; {level}"),
        Some(color) => {
            format!(
                "{quantity}, {convention}; colours {} from {black} to {white}, missed pixels black; {level}",
                color.name
            )
        }
    }
}

fn with_unit(value: f64, unit: &str) -> String {
    if unit == "1" { Number(value).to_string() } else { format!("{} {unit}", Number(value)) }
}

fn from_png(error: png::EncodingError) -> ExportError {
    match error {
        png::EncodingError::IoError(reason) => ExportError::Write(reason),
        other => ExportError::Unsuitable { format: Format::Png, reason: other.to_string() },
    }
}

pub(super) fn read_json(file: &mut (impl BufRead + Seek)) -> Result<Option<Vec<u8>>, String> {
    let limit = usize::try_from(LONGEST_JSON).unwrap_or(usize::MAX);
    let decoder = png::Decoder::new_with_limits(file, png::Limits { bytes: limit });
    let mut reader = decoder.read_info().map_err(|error| error.to_string())?;
    let found = |reader: &png::Reader<_>| {
        let chunks = &reader.info().utf8_text;
        chunks.iter().find(|chunk| chunk.keyword == METADATA_KEYWORD).map(png::text_metadata::ITXtChunk::get_text)
    };
    // Other programs that save the picture again may put the texts after the pixels.
    let mut text = found(&reader);
    if text.is_none() {
        reader.finish().map_err(|error| error.to_string())?;
        text = found(&reader);
    }
    text.transpose().map(|text| text.map(String::into_bytes)).map_err(|error| error.to_string())
}
