//! The picture of a scalar channel, in grey levels or in the colours of a colour map.

use std::io::Write;

use isophote::analysis::statistics::{largest, smallest};
use isophote::map::{Channel, Map, Scalars, Values};
use isophote::message;
use isophote::units::Keyword;

use crate::error::ExportError;
use crate::metadata::{FileMetadata, PictureMetadata};
use crate::png::encode::{CHUNK, METADATA_KEYWORD, from_png, rounded, set_compression, set_depth, with_unit};
use crate::png::options::{Depth, Normalization, PictureOptions, PictureReport};
use crate::text::one_line;

/// Writes the picture; missed pixels are black, even with a colour map.
pub(super) fn write(
    map: &Map,
    channel: &Channel,
    options: &PictureOptions,
    out: impl Write,
) -> Result<PictureReport, ExportError> {
    let values = scalars(channel, options)?;
    let range = range_for(map, channel, values, options)?;

    let mut encoder = png::Encoder::new(out, map.region.size.width, map.region.size.height);
    encoder.set_color(if options.color.is_some() { png::ColorType::Rgb } else { png::ColorType::Grayscale });
    set_depth(&mut encoder, options.depth);
    set_compression(&mut encoder, options.depth);
    for (keyword, text) in texts(map, channel, options, range) {
        encoder.add_itxt_chunk(keyword.into(), text).map_err(from_png)?;
    }
    // No gAMA chunk: browsers would use it to brighten a proportional picture, most other programs ignore it, and the
    // same file would look different in each. Without it all of them show the numbers in the file, as the description
    // explains them.
    let mut writer = encoder.write_header().map_err(from_png)?;
    let mut pixels = writer.stream_writer_with_size(CHUNK).map_err(from_png)?;
    let report = quantize(map, values, options, range, &mut pixels)?;
    pixels.finish().map_err(from_png)?;
    writer.finish().map_err(from_png)?;
    Ok(report)
}

/// The numbers of the channel, if the options can make a picture of them.
fn scalars<'v>(channel: &'v Channel, options: &PictureOptions) -> Result<Scalars<'v>, ExportError> {
    if !(options.gamma > 0.0 && options.gamma.is_finite()) {
        return Err(ExportError::Gamma { gamma: options.gamma });
    }
    if let (Some(color), Depth::Sixteen) = (&options.color, options.depth) {
        return Err(ExportError::ColorDepth { color: color.name.into() });
    }
    let holds = match &channel.values {
        Values::Scalar(values) => return Ok(Scalars::Double(values)),
        Values::Single(values) => return Ok(Scalars::Single(values)),
        Values::Vector(_) => message!("three numbers"),
        Values::Index(_) => message!("an index"),
    };
    Err(ExportError::NotPicture { name: channel.quantity.name(), holds })
}

/// The values of black and white.
fn range_for(
    map: &Map,
    channel: &Channel,
    values: Scalars<'_>,
    options: &PictureOptions,
) -> Result<[f64; 2], ExportError> {
    let [black, white] = options.range.unwrap_or_else(|| {
        let white = largest(map.mask(), values).unwrap_or(0.0);
        match options.normalization {
            Normalization::Max => [0.0, white.max(0.0)],
            Normalization::MinMax => [smallest(map.mask(), values).unwrap_or(0.0), white],
            Normalization::Log => [white.max(0.0) / Normalization::DECADES, white.max(0.0)],
        }
    });
    let (name, range) = (channel.quantity.name(), [black, white]);
    let sound = (white - black).is_finite() && (black < white || options.range.is_none());
    if !sound {
        return Err(ExportError::Range { name, range });
    }
    if options.normalization == Normalization::Log && options.range.is_some() && black <= 0.0 {
        return Err(ExportError::LogRange { name, range });
    }
    Ok(range)
}

/// Writes row by row: allocating a buffer for the whole picture would take longer than filling it.
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
        let linear = options.normalization.level(value, [black, white]);
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

fn bytes_per_pixel(options: &PictureOptions) -> usize {
    if options.color.is_some() { 3 } else { usize::from(options.depth.bits() / 8) }
}

fn texts(map: &Map, channel: &Channel, options: &PictureOptions, range: [f64; 2]) -> [(&'static str, String); 4] {
    let mut metadata = FileMetadata::of_channel(map, channel);
    metadata.picture = Some(PictureMetadata {
        range,
        normalization: options.normalization.name().into(),
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

fn description(map: &Map, channel: &Channel, options: &PictureOptions, range: [f64; 2]) -> String {
    let space = map.provenance.color_space.as_ref().map_or(String::new(), |space| format!(", luminance in {space}"));
    let (quantity, convention) = (channel.quantity.name(), format!("{}{space}", map.provenance.convention));
    let [black, white] = range.map(|value| with_unit(value, &channel.unit));
    #[expect(clippy::float_cmp, reason = "1 is the exact default")]
    let level = match (options.normalization, options.gamma == 1.0) {
        (Normalization::Max | Normalization::MinMax, true) => {
            "level proportional to the value (linear, not gamma-encoded)".into()
        }
        (Normalization::Max | Normalization::MinMax, false) => {
            format!("level = (share of the way between them)^(1/{})", options.gamma)
        }
        (Normalization::Log, true) => "level = ln(value/black)/ln(white/black)".into(),
        (Normalization::Log, false) => format!("level = (ln(value/black)/ln(white/black))^(1/{})", options.gamma),
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
