//! A figure as PNG, drawn only with the embedded font.

use std::sync::{Arc, OnceLock};

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{ImageHrefResolver, Options, fontdb};

use crate::figure::error::FigureError;
use crate::figure::layers;
use crate::figure::text::FONT;
use crate::png::METADATA_KEYWORD;

const LARGEST_SIDE: f64 = 16384.0;

/// Draws a figure of this module as a PNG file with `scale` pixels per px.
///
/// All text is set in the embedded font, whatever fonts the system has, and no files are read. Images are drawn if they
/// are PNG and not inside a group, which is how figures hold them. The file carries the metadata, a
/// [`FileMetadata`](crate::FileMetadata) as JSON, if there are any.
///
/// # Errors
/// [`FigureError`]: the text is not SVG, or the picture would have no pixels or too many.
pub fn svg_to_png(svg: &str, scale: f64, metadata: Option<&str>) -> Result<Vec<u8>, FigureError> {
    let layers = layers::of(svg, &options()).map_err(|error| FigureError::Svg(error.to_string()))?;
    let size = layers.size();
    let [width, height] = [size.width(), size.height()].map(|side| (f64::from(side) * scale).round());
    let is_possible = |side: f64| (1.0..=LARGEST_SIDE).contains(&side);
    if !(is_possible(width) && is_possible(height)) {
        return Err(FigureError::PictureSize { scale, width, height });
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked above")]
    let pixmap = Pixmap::new(width as u32, height as u32);
    let mut pixmap = pixmap.ok_or(FigureError::PictureSize { scale, width, height })?;
    #[expect(clippy::cast_possible_truncation, reason = "the renderer works in single precision")]
    let transform = Transform::from_scale(scale as f32, scale as f32);
    layers.draw(transform, &mut pixmap.as_mut());
    encode(pixmap, metadata).map_err(|error| FigureError::Png(error.to_string()))
}

fn encode(pixmap: Pixmap, metadata: Option<&str>) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, pixmap.width(), pixmap.height());
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    if let Some(metadata) = metadata {
        encoder.add_itxt_chunk(METADATA_KEYWORD.into(), metadata.into())?;
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&pixmap.take_demultiplied())?;
    writer.finish()?;
    Ok(bytes)
}

fn options() -> Options<'static> {
    const FAMILY: &str = "DejaVu Sans";
    static FONTS: OnceLock<Arc<fontdb::Database>> = OnceLock::new();
    let fonts = FONTS.get_or_init(|| {
        let mut fonts = fontdb::Database::new();
        fonts.load_font_data(FONT.to_vec());
        fonts.set_sans_serif_family(FAMILY);
        fonts.set_serif_family(FAMILY);
        Arc::new(fonts)
    });
    Options {
        font_family: FAMILY.into(),
        fontdb: Arc::clone(fonts),
        // The default would open files referenced in the SVG.
        image_href_resolver: ImageHrefResolver {
            resolve_data: ImageHrefResolver::default_data_resolver(),
            resolve_string: Box::new(|_, _| None),
        },
        ..Options::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::read_back::decode;

    /// The number of dark pixels for each of a row of letters.
    fn dark_pixels(family: &str) -> Vec<usize> {
        let letters = ["А", "Я", "²", "⁻", "θ", "≤", "A"];
        letters.map(|letter| {
            let svg = format!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"20\" height=\"20\" font-family=\"{family}\">\
                 <rect width=\"20\" height=\"20\" fill=\"#fff\"/><text x=\"3\" y=\"16\" font-size=\"16\">{letter}</text></svg>"
            );
            let (size, rgba) = decode(&svg_to_png(&svg, 2.0, None).unwrap());
            assert_eq!(size, [40, 40]);
            rgba.chunks_exact(4).filter(|pixel| pixel[0] < 128).count()
        }).to_vec()
    }

    #[test]
    fn letters_of_every_script_are_drawn_in_the_embedded_font_whatever_font_is_named() {
        let counts = dark_pixels("DejaVu Sans");
        assert!(counts.iter().all(|&count| count > 15), "{counts:?}");
        assert_eq!(counts[0], counts[6], "the Cyrillic and the Latin A have one shape");
        assert_eq!(dark_pixels("Times New Roman"), counts);
    }

    #[test]
    fn what_is_no_picture_is_refused() {
        let svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"20\" height=\"10\"/>";
        assert_eq!(decode(&svg_to_png(svg, 1.5, None).unwrap()).0, [30, 15]);
        for scale in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e4] {
            assert!(matches!(svg_to_png(svg, scale, None), Err(FigureError::PictureSize { .. })), "{scale}");
        }
        assert!(matches!(svg_to_png("<svg", 1.0, None), Err(FigureError::Svg(_))));
    }
}
