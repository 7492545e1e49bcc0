//! Figures as PNG, drawn only with the embedded font.

use tiny_skia::{
    Color as PixelColor, FillRule, FilterQuality, IntSize, LineJoin, Paint, Path, PathBuilder, Pattern, Pixmap,
    PixmapMut, Rect, Shader, SpreadMode, Stroke as Pen, StrokeDash, Transform,
};

use crate::figure::drawing::{
    Anchor, Color, Element, Figure, Fill, Image, PAPER, Place, Rectangle, Shape, Stroke, Style, Text, single,
};
use crate::figure::error::FigureError;
use crate::figure::text;
use crate::png::METADATA_KEYWORD;

const LARGEST_SIDE: f64 = 16384.0;

impl Figure {
    /// The figure as a PNG file with `scale` pixels per px.
    ///
    /// All text is set in the embedded font, whatever fonts the system has. The file carries the metadata, a
    /// [`FileMetadata`](crate::FileMetadata) as JSON, if there are any.
    ///
    /// # Errors
    /// [`FigureError`]: the picture would have no pixels or too many.
    pub fn to_png(&self, scale: f64, metadata: Option<&str>) -> Result<Vec<u8>, FigureError> {
        let [width, height] = self.size.map(|side| (side * scale).round());
        let is_possible = |side: f64| (1.0..=LARGEST_SIDE).contains(&side);
        if !(is_possible(width) && is_possible(height)) {
            return Err(FigureError::PictureSize { scale, width, height });
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked above")]
        let size = [width as u32, height as u32];
        let pixmap = Pixmap::new(size[0], size[1]);
        let mut pixmap = pixmap.ok_or(FigureError::PictureSize { scale, width, height })?;
        pixmap.fill(opaque(PAPER));
        let mut canvas = Canvas { page: pixmap.as_mut(), scale: single(scale) };
        for element in &self.elements {
            canvas.draw(element);
        }
        encode(size, &pixmap.take_demultiplied(), metadata)
    }
}

/// A PNG file of opaque or transparent pixels.
pub(super) fn encode([width, height]: [u32; 2], rgba: &[u8], metadata: Option<&str>) -> Result<Vec<u8>, FigureError> {
    let encode = || -> Result<Vec<u8>, png::EncodingError> {
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, width, height);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        if let Some(metadata) = metadata {
            encoder.add_itxt_chunk(METADATA_KEYWORD.into(), metadata.into())?;
        }
        let mut writer = encoder.write_header()?;
        writer.write_image_data(rgba)?;
        writer.finish()?;
        Ok(file)
    };
    encode().map_err(|error| FigureError::Png(error.to_string()))
}

/// A page of pixels.
struct Canvas<'page> {
    page: PixmapMut<'page>,
    /// Pixels per px.
    scale: f32,
}

impl Canvas<'_> {
    fn draw(&mut self, element: &Element) {
        match element {
            Element::Shape(shape, style) => {
                if let Some(path) = outline(shape) {
                    self.draw_shape(&path, style);
                }
            }
            Element::Text(text) => self.draw_text(text),
            Element::Image(image) => self.draw_image(image),
        }
    }

    fn transform(&self) -> Transform {
        Transform::from_scale(self.scale, self.scale)
    }

    fn draw_shape(&mut self, path: &Path, style: &Style) {
        let transform = self.transform();
        match style.fill {
            None => {}
            Some(Fill::Color(color)) => {
                self.page.fill_path(path, &paint(color, 1.0), FillRule::Winding, transform, None);
            }
            Some(Fill::Hatching) => {
                if let Some(tile) = hatching_tile(self.scale) {
                    #[expect(clippy::cast_precision_loss, reason = "a few pixels")]
                    let turn = Transform::from_rotate(45.0)
                        .pre_scale(HATCHING / tile.width() as f32, HATCHING / tile.height() as f32);
                    let shader = Pattern::new(tile.as_ref(), SpreadMode::Repeat, FilterQuality::Bicubic, 1.0, turn);
                    let paint = Paint { shader, ..Paint::default() };
                    self.page.fill_path(path, &paint, FillRule::Winding, transform, None);
                }
            }
        }
        if let Some(stroke) = style.stroke {
            self.page.stroke_path(path, &paint(stroke.color, stroke.opacity), &pen(&stroke), transform, None);
        }
    }

    fn draw_text(&mut self, text: &Text) {
        let width = text::width(&text.content, text.size);
        let start = match text.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => -0.5 * width,
            Anchor::End => -width,
        };
        let Some(path) = text::outline(&text.content, text.size, Place { x: start, y: text.drop() }) else { return };
        let at = Transform::from_translate(single(text.at.x), single(text.at.y));
        let transform = self.transform().pre_concat(at).pre_concat(Transform::from_rotate(single(text.degrees)));
        if let Some(halo) = text.halo {
            let pen = pen(&Stroke::new(halo, Text::HALO).round());
            self.page.stroke_path(&path, &paint(halo, 1.0), &pen, transform, None);
        }
        self.page.fill_path(&path, &paint(text.color, 1.0), FillRule::Winding, transform, None);
    }

    fn draw_image(&mut self, image: &Image) {
        let [width, height] = image.size;
        let pixels = IntSize::from_wh(width, height).and_then(|size| Pixmap::from_vec(image.rgba.clone(), size));
        let (Some(pixels), Some(place)) = (pixels, rect(&image.place)) else { return };
        let quality = if image.pixelated { FilterQuality::Nearest } else { FilterQuality::Bicubic };
        #[expect(clippy::cast_precision_loss, reason = "an image has fewer than 2²⁴ pixels on a side")]
        let stretch = Transform::from_translate(place.left(), place.top())
            .pre_scale(place.width() / width as f32, place.height() / height as f32);
        let shader = Pattern::new(pixels.as_ref(), SpreadMode::Pad, quality, 1.0, stretch);
        let paint = Paint { shader, ..Paint::default() };
        self.page.fill_rect(place, &paint, self.transform(), None);
    }
}

fn outline(shape: &Shape) -> Option<Path> {
    match shape {
        Shape::Rectangle(rectangle) => rect(rectangle).map(PathBuilder::from_rect),
        Shape::Circle { center, radius } => {
            PathBuilder::from_circle(single(center.x), single(center.y), single(*radius))
        }
        Shape::Path { places, closed } => {
            let mut builder = PathBuilder::new();
            for (index, place) in places.iter().enumerate() {
                let (x, y) = (single(place.x), single(place.y));
                if index == 0 { builder.move_to(x, y) } else { builder.line_to(x, y) }
            }
            if *closed {
                builder.close();
            }
            builder.finish()
        }
    }
}

/// Side of the hatching's square tile in px.
const HATCHING: f32 = 6.0;

/// A tile of the hatching before it is turned: a stripe as wide as a sixth of it at the left.
fn hatching_tile(scale: f32) -> Option<Pixmap> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few pixels")]
    let stripe = scale.ceil().clamp(1.0, 64.0) as u32;
    let mut tile = Pixmap::new(6 * stripe, 6 * stripe)?;
    tile.fill(opaque([0xf1, 0xf2, 0xf5]));
    #[expect(clippy::cast_precision_loss, reason = "a few pixels")]
    let [width, height] = [stripe, 6 * stripe].map(|side| side as f32);
    let stripe = Rect::from_xywh(0.0, 0.0, width, height)?;
    tile.fill_rect(stripe, &paint([0xd3, 0xd6, 0xdd], 1.0), Transform::identity(), None);
    Some(tile)
}

fn rect(&Rectangle { left, top, width, height }: &Rectangle) -> Option<Rect> {
    Rect::from_xywh(single(left), single(top), single(width), single(height))
}

fn opaque([red, green, blue]: Color) -> PixelColor {
    PixelColor::from_rgba8(red, green, blue, 255)
}

fn paint(color: Color, opacity: f64) -> Paint<'static> {
    let mut color = opaque(color);
    color.apply_opacity(single(opacity));
    Paint { shader: Shader::SolidColor(color), ..Paint::default() }
}

fn pen(stroke: &Stroke) -> Pen {
    let dashes = stroke.dashes.iter().copied().map(single).collect();
    Pen {
        width: single(stroke.width),
        line_join: if stroke.round { LineJoin::Round } else { LineJoin::Miter },
        dash: StrokeDash::new(dashes, 0.0),
        ..Pen::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::drawing::{BLACK, Drawing};
    use crate::figure::read_back::decode;

    const PAGE: Rectangle = Rectangle { left: 0.0, top: 0.0, width: 20.0, height: 20.0 };

    fn picture(drawing: Drawing, scale: f64) -> Vec<u8> {
        let (size, rgba) = decode(&drawing.finish(20.0, 20.0).to_png(scale, None).unwrap());
        assert_eq!(size.map(f64::from), [20.0 * scale; 2]);
        rgba
    }

    fn color(rgba: &[u8], column: usize, row: usize) -> [u8; 3] {
        rgba[4 * (20 * row + column)..][..3].try_into().unwrap()
    }

    /// The number of dark pixels of a letter.
    fn dark_pixels(letter: &str) -> usize {
        let mut drawing = Drawing::default();
        // Base line at y = 16.
        drawing.text(Text::new(letter, Place { x: 3.0, y: 16.0 - 0.364 * 16.0 }, 16.0, Anchor::Start));
        picture(drawing, 2.0).chunks_exact(4).filter(|pixel| pixel[0] < 128).count()
    }

    #[test]
    fn letters_of_every_script_are_drawn_in_the_embedded_font() {
        let counts = ["А", "Я", "²", "⁻", "θ", "≤", "A"].map(dark_pixels);
        assert!(counts.iter().all(|&count| count > 15), "{counts:?}");
        assert_eq!(counts[0], counts[6], "the Cyrillic and the Latin A have one shape");
        assert_eq!(dark_pixels(" "), 0);
        assert!(dark_pixels("漢") > 15, "a box stands for a letter that the font lacks");
    }

    #[test]
    fn a_turned_text_reads_from_below_and_a_halo_surrounds_it() {
        let text = Text::new("III", Place { x: 10.0, y: 10.0 }, 12.0, Anchor::Middle);
        let mut drawing = Drawing::default();
        drawing.rectangle(PAGE, Style::filled([0, 0, 255]));
        drawing.text(Text { degrees: -90.0, halo: Some([255, 0, 0]), ..text });
        let rgba = picture(drawing, 1.0);
        let columns_and_rows: Vec<[usize; 2]> = (0..20)
            .flat_map(|row| (0..20).map(move |column| [column, row]))
            .filter(|&[column, row]| color(&rgba, column, row)[0] > 128)
            .collect();
        let extent = |side: usize| {
            let sides = columns_and_rows.iter().map(|place| place[side]);
            sides.clone().max().unwrap() - sides.min().unwrap()
        };
        assert!(extent(0) < extent(1) + 3 && extent(1) >= 9, "{columns_and_rows:?}");
        assert_eq!(color(&rgba, 0, 0), [0, 0, 255]);
    }

    #[test]
    fn an_image_lies_between_what_is_drawn_before_and_after_it() {
        let mut drawing = Drawing::default();
        drawing.rectangle(PAGE, Style::filled(BLACK));
        let place = Rectangle { left: 2.0, top: 2.0, width: 16.0, height: 8.0 };
        let rgba = vec![255, 0, 0, 255, 0, 0, 0, 0];
        drawing.image(Image { place, size: [2, 1], rgba, pixelated: true });
        drawing.circle(Place { x: 4.0, y: 4.0 }, 1.5, Style::filled([0, 255, 0]));
        let rgba = picture(drawing, 1.0);
        assert_eq!(color(&rgba, 9, 9), [255, 0, 0], "the left pixel");
        assert_eq!(color(&rgba, 10, 9), [0; 3], "the right one is transparent");
        assert_eq!(color(&rgba, 9, 10), [0; 3], "below the image");
        assert_eq!(color(&rgba, 3, 3), [0, 255, 0]);
    }

    #[test]
    fn hatching_has_a_stripe_on_a_sixth_of_its_area_at_any_scale() {
        for scale in [1.0, 1.5, 3.0] {
            let mut drawing = Drawing::default();
            drawing.rectangle(PAGE, Style::hatched());
            let rgba = picture(drawing, scale);
            let mean = rgba.chunks_exact(4).map(|pixel| f64::from(pixel[0])).sum::<f64>() / (400.0 * scale * scale);
            let expected = (5.0 * f64::from(0xf1) + f64::from(0xd3)) / 6.0;
            assert!((mean - expected).abs() < 1.0, "{scale}: {mean} {expected}");
        }
    }

    #[test]
    fn a_picture_without_pixels_or_with_too_many_is_refused() {
        let figure = Drawing::default().finish(20.0, 10.0);
        assert_eq!(decode(&figure.to_png(1.5, None).unwrap()).0, [30, 15]);
        for scale in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e4] {
            assert!(matches!(figure.to_png(scale, None), Err(FigureError::PictureSize { .. })), "{scale}");
        }
    }
}
