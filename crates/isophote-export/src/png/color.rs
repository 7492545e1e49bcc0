//! The picture of a colour channel, as a screen shows it.

use std::io::Write;

use isophote::map::{Channel, Map};
use isophote::units::Keyword;

use crate::color_scale::{ColorScale, Shown};
use crate::error::ExportError;
use crate::metadata::{FileMetadata, PictureMetadata};
use crate::png::encode::{CHUNK, METADATA_KEYWORD, from_png, rounded, set_compression, set_depth, with_unit};
use crate::png::options::{Depth, Normalization, PictureOptions, PictureReport};
use crate::text::one_line;

/// The encoding named in the metadata.
const ENCODING: &str = "sRGB";

/// Writes the picture: linear RGB, scaled by one range, in sRGB with its transfer function; missed pixels are black.
pub(super) fn write(
    map: &Map,
    channel: &Channel,
    colors: &[[f64; 3]],
    options: &PictureOptions<'_>,
    out: impl Write,
) -> Result<PictureReport, ExportError> {
    #[expect(clippy::float_cmp, reason = "1 is the exact default")]
    if options.gamma != 1.0 || options.color.is_some() || options.normalization != Normalization::Max {
        return Err(ExportError::ColorStyle { name: channel.quantity.name() });
    }
    let scale = ColorScale::new(map, colors, options.range);
    let [black, white] = scale.range;
    if !(white - black).is_finite() || (black >= white && options.range.is_some()) {
        return Err(ExportError::Range { name: channel.quantity.name(), range: scale.range });
    }
    let mut encoder = png::Encoder::new(out, map.region.size.width, map.region.size.height);
    encoder.set_color(png::ColorType::Rgb);
    set_depth(&mut encoder, options.depth);
    encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
    set_compression(&mut encoder, options.depth);
    for (keyword, text) in texts(map, channel, options.depth, scale.range) {
        encoder.add_itxt_chunk(keyword.into(), text).map_err(from_png)?;
    }
    let mut writer = encoder.write_header().map_err(from_png)?;
    let mut pixels = writer.stream_writer_with_size(CHUNK).map_err(from_png)?;
    let report = paint(map, colors, scale, options.depth, &mut pixels)?;
    pixels.finish().map_err(from_png)?;
    writer.finish().map_err(from_png)?;
    Ok(report)
}

/// Writes the pixels row by row.
fn paint(
    map: &Map,
    colors: &[[f64; 3]],
    scale: ColorScale,
    depth: Depth,
    out: &mut impl Write,
) -> Result<PictureReport, ExportError> {
    let mut report = PictureReport { range: scale.range, clamped_below: 0, clamped_above: 0 };
    let bytes = usize::from(depth.bits() / 8);
    let width = map.region.size.width as usize;
    let mut row = vec![0; 3 * bytes * width];
    let mut seen = map.mask().indices().peekable();
    for start in (0..colors.len()).step_by(width) {
        row.fill(0);
        while let Some(index) = seen.next_if(|index| *index < start + width) {
            let Shown { encoded, is_below, is_above } = scale.shown(colors[index]);
            report.clamped_below += usize::from(is_below);
            report.clamped_above += usize::from(is_above);
            let pixel = &mut row[(index - start) * 3 * bytes..][..3 * bytes];
            for (sample, level) in pixel.chunks_exact_mut(bytes).zip(encoded) {
                match depth {
                    Depth::Eight => sample.copy_from_slice(&rounded(level * 255.0).to_be_bytes()[1..]),
                    Depth::Sixteen => sample.copy_from_slice(&rounded(level * 65535.0).to_be_bytes()),
                }
            }
        }
        out.write_all(&row)?;
    }
    Ok(report)
}

fn texts(map: &Map, channel: &Channel, depth: Depth, range: [f64; 2]) -> [(&'static str, String); 4] {
    let mut metadata = FileMetadata::of_channel(map, channel);
    metadata.picture = Some(PictureMetadata {
        range,
        normalization: Normalization::Max.name().into(),
        gamma: 1.0,
        depth: depth.bits(),
        colormap: None,
        encoding: Some(ENCODING.into()),
    });
    let [black, white] = range.map(|value| with_unit(value, &channel.unit));
    let space = map.provenance.color_space.as_deref().unwrap_or("linear RGB");
    let description = format!(
        "{}, {}, {space}; black is {black}, white is {white} of each component; shown in sRGB, with its transfer function",
        channel.quantity.name(),
        map.provenance.convention
    );
    [
        ("Title", one_line(&map.provenance.title)),
        ("Software", one_line(&map.provenance.program)),
        ("Description", one_line(&description)),
        (METADATA_KEYWORD, metadata.to_json()),
    ]
}
