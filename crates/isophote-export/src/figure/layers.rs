//! The layers of a figure from the bottom up: each is one image, or everything that is drawn between two images.
//!
//! resvg could draw images too, but bundles its PNG reader with those for GIF, JPEG and WebP.

use resvg::tiny_skia::{FilterQuality, Paint, Pattern, Pixmap, PixmapMut, Rect, SpreadMode, Transform};
use resvg::usvg::roxmltree::{Document, Node as Element};
use resvg::usvg::{self, Group, Image, ImageKind, ImageRendering, Node, Options, Size, Tree};

/// The layers of a figure.
pub(super) struct Layers {
    lowest: Tree,
    above: Vec<Tree>,
}

/// The layers of an SVG.
pub(super) fn of(svg: &str, options: &Options) -> Result<Layers, usvg::Error> {
    let document = Document::parse(svg).map_err(usvg::Error::ParsingFailed)?;
    let elements: Vec<Element> = document.root_element().children().filter(Element::is_element).collect();
    let (definitions, drawn): (Vec<Element>, Vec<Element>) =
        elements.iter().partition(|element| element.has_tag_name("defs"));
    let is_image = |element: &Element| element.tag_name().name() == "image";
    let mut texts = drawn
        .chunk_by(|below, above| !is_image(below) && !is_image(above))
        .map(|layer| with_elements(svg, &elements, definitions.iter().chain(layer)));
    let lowest = texts.next().unwrap_or_else(|| svg.to_owned());
    let lowest = Tree::from_str(&lowest, options)?;
    let above = texts.map(|text| Tree::from_str(&text, options)).collect::<Result<_, _>>()?;
    Ok(Layers { lowest, above })
}

/// The same file with only the chosen elements.
fn with_elements<'d>(svg: &str, all: &[Element], chosen: impl Iterator<Item = &'d Element<'d, 'd>>) -> String {
    let start = all.first().map_or(svg.len(), |first| first.range().start);
    let end = all.last().map_or(svg.len(), |last| last.range().end);
    let mut text = svg[..start].to_owned();
    text.extend(chosen.map(|element| &svg[element.range()]));
    text.push_str(&svg[end..]);
    text
}

impl Layers {
    /// The size of the page in px.
    pub(super) fn size(&self) -> Size {
        self.lowest.size()
    }

    /// Draws the layers on top of each other.
    pub(super) fn draw(&self, transform: Transform, page: &mut PixmapMut) {
        for layer in std::iter::once(&self.lowest).chain(&self.above) {
            match image_in(layer.root()) {
                Some(image) => draw_image(image, transform, page),
                None => resvg::render(layer, transform, page),
            }
        }
    }
}

fn image_in(group: &Group) -> Option<&Image> {
    group.children().iter().find_map(|node| match node {
        Node::Image(image) => Some(&**image),
        Node::Group(inner) => image_in(inner),
        Node::Path(_) | Node::Text(_) => None,
    })
}

/// Works as in resvg; images other than PNG are skipped.
fn draw_image(image: &Image, transform: Transform, page: &mut PixmapMut) {
    let ImageKind::PNG(data) = image.kind() else { return };
    let Ok(pixels) = Pixmap::decode_png(data) else { return };
    let Some(place) = Rect::from_xywh(0.0, 0.0, image.size().width(), image.size().height()) else { return };
    let quality = match image.rendering_mode() {
        ImageRendering::OptimizeQuality | ImageRendering::HighQuality => FilterQuality::Bicubic,
        ImageRendering::Smooth => FilterQuality::Bilinear,
        ImageRendering::OptimizeSpeed | ImageRendering::CrispEdges | ImageRendering::Pixelated => {
            FilterQuality::Nearest
        }
    };
    let shader = Pattern::new(pixels.as_ref(), SpreadMode::Pad, quality, 1.0, Transform::default());
    let paint = Paint { shader, ..Paint::default() };
    page.fill_rect(place, &paint, transform.pre_concat(image.abs_transform()), None);
}

#[cfg(test)]
mod tests {
    use super::*;

    const RED_DOT: &str =
        "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4z8AAAAMBAQDJ/pLvAAAAAElFTkSuQmCC";

    /// A page of 10 × 10 px with the given elements.
    fn drawn(elements: &str) -> Pixmap {
        let svg = format!("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"10\" height=\"10\">{elements}</svg>");
        let mut page = Pixmap::new(10, 10).unwrap();
        of(&svg, &Options::default()).unwrap().draw(Transform::default(), &mut page.as_mut());
        page
    }

    fn color(page: &Pixmap, column: u32, row: u32) -> [u8; 3] {
        let color = page.pixel(column, row).unwrap().demultiply();
        [color.red(), color.green(), color.blue()]
    }

    #[test]
    fn an_image_lies_between_what_is_written_before_and_after_it() {
        let image = format!(
            "<image x=\"2\" y=\"2\" width=\"6\" height=\"6\" preserveAspectRatio=\"none\" style=\"image-rendering:pixelated\" \
             href=\"data:image/png;base64,{RED_DOT}\"/>"
        );
        let page = drawn(&format!(
            "<rect width=\"10\" height=\"10\" fill=\"#ffffff\"/>{image}<rect x=\"4\" y=\"4\" width=\"2\" height=\"2\" \
             fill=\"url(#later)\"/><defs><linearGradient id=\"later\"><stop stop-color=\"#0000ff\"/></linearGradient></defs>"
        ));
        assert_eq!(color(&page, 0, 0), [255; 3]);
        assert_eq!(color(&page, 2, 2), [255, 0, 0]);
        assert_eq!(color(&page, 7, 7), [255, 0, 0]);
        assert_eq!(color(&page, 8, 8), [255; 3]);
        assert_eq!(color(&page, 4, 5), [0, 0, 255]);
    }

    #[test]
    fn an_empty_page_has_one_layer() {
        assert_eq!(color(&drawn(""), 5, 5), [0; 3]);
    }
}
