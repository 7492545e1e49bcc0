//! Figures as SVG: elements in drawing order, all text escaped.

use std::fmt::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use crate::figure::drawing::{
    Anchor, Color, Element, Figure, Fill, Image, PAPER, Place, Rectangle, Shape, Stroke, Style, Text,
};
use crate::figure::error::FigureError;
use crate::figure::picture_file::encode;

/// Fallbacks for programs that lack the first font; Verdana has nearly the same widths.
const FONTS: &str = "DejaVu Sans, Verdana, Bitstream Vera Sans, sans-serif";

/// Must look like the tile of `picture_file.rs`.
const HATCHING: &str = "<defs><pattern id=\"no-surface\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\" \
    patternTransform=\"rotate(45)\"><rect width=\"6\" height=\"6\" fill=\"#f1f2f5\"/><rect width=\"1\" height=\"6\" \
    fill=\"#d3d6dd\"/></pattern></defs>\n";

impl Figure {
    /// The figure as an SVG file. Its text stays text, to be set in the reader's fonts; images are embedded.
    ///
    /// # Errors
    /// [`FigureError::Png`]: an image could not be encoded.
    pub fn to_svg(&self) -> Result<String, FigureError> {
        let [width, height] = self.size.map(number);
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" \
             width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" font-family=\"{FONTS}\">\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"{}\"/>\n",
            hex(PAPER)
        );
        let mut is_hatching_defined = false;
        for element in &self.elements {
            if let Element::Shape(_, Style { fill: Some(Fill::Hatching), .. }) = element
                && !std::mem::replace(&mut is_hatching_defined, true)
            {
                svg.push_str(HATCHING);
            }
            svg.push_str(&match element {
                Element::Shape(shape, style) => written_shape(shape, style),
                Element::Text(text) => written_text(text),
                Element::Image(image) => written_image(image)?,
            });
            svg.push('\n');
        }
        svg.push_str("</svg>\n");
        Ok(svg)
    }
}

fn written_shape(shape: &Shape, style: &Style) -> String {
    let style = written_style(style);
    match shape {
        Shape::Rectangle(rectangle) => format!("<rect {} {style}/>", written_place(rectangle)),
        Shape::Circle { center, radius } => {
            format!(
                "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" {style}/>",
                number(center.x),
                number(center.y),
                number(*radius)
            )
        }
        Shape::Path { places, closed } => {
            let mut data = String::new();
            for (index, Place { x, y }) in places.iter().enumerate() {
                let command = if index == 0 { "M" } else { "L" };
                let _ = write!(data, "{command}{} {}", number(*x), number(*y));
            }
            format!("<path d=\"{data}{}\" {style}/>", if *closed { "Z" } else { "" })
        }
    }
}

fn written_place(&Rectangle { left, top, width, height }: &Rectangle) -> String {
    let [left, top, width, height] = [left, top, width, height].map(number);
    format!("x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\"")
}

fn written_style(style: &Style) -> String {
    let fill = match style.fill {
        None => "none".into(),
        Some(Fill::Color(color)) => hex(color),
        Some(Fill::Hatching) => "url(#no-surface)".into(),
    };
    let mut written = format!("fill=\"{fill}\"");
    if let Some(Stroke { color, width, opacity, round, dashes }) = style.stroke {
        let _ = write!(written, " stroke=\"{}\" stroke-width=\"{}\"", hex(color), number(width));
        if opacity < 1.0 {
            let _ = write!(written, " stroke-opacity=\"{}\"", number(opacity));
        }
        if round {
            written.push_str(" stroke-linejoin=\"round\"");
        }
        if !dashes.is_empty() {
            let dashes: Vec<String> = dashes.iter().copied().map(number).collect();
            let _ = write!(written, " stroke-dasharray=\"{}\"", dashes.join(" "));
        }
    }
    written
}

fn written_text(text: &Text) -> String {
    let Text { content, at, size, anchor, degrees, color, halo } = text;
    let anchor = match anchor {
        Anchor::Start => "",
        Anchor::Middle => " text-anchor=\"middle\"",
        Anchor::End => " text-anchor=\"end\"",
    };
    let halo = halo.map_or(String::new(), |color| {
        let (color, width) = (hex(color), number(Text::HALO));
        format!(" stroke=\"{color}\" stroke-width=\"{width}\" stroke-linejoin=\"round\" paint-order=\"stroke\"")
    });
    // Shifted by hand: programs interpret dominant-baseline differently.
    let place = if *degrees == 0.0 {
        format!("x=\"{}\" y=\"{}\"", number(at.x), number(at.y + text.drop()))
    } else {
        let turn = format!("translate({} {}) rotate({})", number(at.x), number(at.y), number(*degrees));
        format!("y=\"{}\" transform=\"{turn}\"", number(text.drop()))
    };
    let (size, color, content) = (number(*size), hex(*color), escape(content));
    format!("<text {place} font-size=\"{size}\" fill=\"{color}\"{anchor}{halo}>{content}</text>")
}

fn written_image(image: &Image) -> Result<String, FigureError> {
    // As a style: the SVG 1.1 attribute does not allow this value, so readers would ignore it there.
    let rendering = if image.pixelated { " style=\"image-rendering:pixelated\"" } else { "" };
    Ok(format!(
        "<image {} preserveAspectRatio=\"none\"{rendering} xlink:href=\"data:image/png;base64,{}\"/>",
        written_place(&image.place),
        STANDARD.encode(encode(image.size, &image.rgba, None)?)
    ))
}

/// A colour in SVG notation.
pub(super) fn hex([red, green, blue]: Color) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// At most two decimals: a hundredth of a pixel is invisible, and files stay small.
fn number(value: f64) -> String {
    let fixed = format!("{value:.2}");
    let short = fixed.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" { "0".into() } else { short.into() }
}

/// Text as XML character data. Characters that XML 1.0 cannot hold at all become U+FFFD.
fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\u{0}'..='\u{8}' | '\u{b}' | '\u{c}' | '\u{e}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => {
                escaped.push('\u{fffd}');
            }
            other => escaped.push(other),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::drawing::Drawing;

    #[test]
    fn numbers_are_short() {
        let written = [1.0, -0.001, 0.126, -12.5, 100.0].map(number);
        assert_eq!(written, ["1", "0", "0.13", "-12.5", "100"]);
    }

    #[test]
    fn a_title_cannot_break_the_file() {
        let mut drawing = Drawing::default();
        let title = "k_d < 0.5 & \"Сфера\" </text><script>\u{1}";
        drawing.text(Text::new(title, Place { x: 1.0, y: 2.0 }, 10.0, Anchor::Start));
        let file = drawing.finish(20.0, 10.0).to_svg().unwrap();
        assert!(file.contains("k_d &lt; 0.5 &amp; &quot;Сфера&quot; &lt;/text&gt;&lt;script&gt;\u{fffd}</text>"));
        assert!(roxmltree::Document::parse(&file).is_ok());
    }
}
