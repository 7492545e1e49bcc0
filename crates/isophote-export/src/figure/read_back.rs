//! Reads figures back for tests: texts with the space they occupy, images with their pixels.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use roxmltree::{Document, Node};

use crate::figure::drawing::{Place, Rectangle};
use crate::figure::label_box::LabelBox;
use crate::figure::text;

pub(super) struct WrittenText {
    pub(super) content: String,
    pub(super) room: LabelBox,
}

pub(super) struct Image {
    pub(super) place: Rectangle,
    pub(super) size: [u32; 2],
    pub(super) rgba: Vec<u8>,
}

impl Image {
    pub(super) fn pixel(&self, column: u32, row: u32) -> [u8; 4] {
        let start = 4 * (row * self.size[0] + column) as usize;
        self.rgba[start..start + 4].try_into().unwrap()
    }
}

pub(super) fn page(svg: &str) -> Rectangle {
    let document = Document::parse(svg).unwrap();
    let root = document.root_element();
    Rectangle { left: 0.0, top: 0.0, width: length(root, "width"), height: length(root, "height") }
}

pub(super) fn texts(svg: &str) -> Vec<WrittenText> {
    let document = Document::parse(svg).unwrap();
    let nodes = document.descendants().filter(|node| node.has_tag_name("text"));
    nodes.map(|node| WrittenText { content: node.text().unwrap().into(), room: room(node) }).collect()
}

pub(super) fn images(svg: &str) -> Vec<Image> {
    let document = Document::parse(svg).unwrap();
    let nodes = document.descendants().filter(|node| node.has_tag_name("image"));
    nodes.map(image).collect()
}

/// Width, height and RGBA of a PNG file.
pub(super) fn decode(file: &[u8]) -> ([u32; 2], Vec<u8>) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
    let mut rgba = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut rgba).unwrap();
    assert_eq!(info.color_type, png::ColorType::Rgba);
    ([info.width, info.height], rgba)
}

fn image(node: Node) -> Image {
    let address = node.attribute(("http://www.w3.org/1999/xlink", "href")).unwrap();
    let file = STANDARD.decode(address.strip_prefix("data:image/png;base64,").unwrap()).unwrap();
    let [left, top, width, height] = ["x", "y", "width", "height"].map(|name| length(node, name));
    let (size, rgba) = decode(&file);
    Image { place: Rectangle { left, top, width, height }, size, rgba }
}

fn room(node: Node) -> LabelBox {
    let size = length(node, "font-size");
    let width = text::width(node.text().unwrap(), size);
    let shift = match node.attribute("text-anchor") {
        None => 0.5 * width,
        Some("middle") => 0.0,
        Some(_) => -0.5 * width,
    };
    let numbers: Vec<f64> = node.attribute("transform").map_or(Vec::new(), |turn| {
        turn.split(|sign: char| " ()".contains(sign)).filter_map(|word| word.parse().ok()).collect()
    });
    let (origin, turn) = match numbers[..] {
        [x, y, degrees] => (Place { x, y }, f64::to_radians(degrees)),
        _ => (Place { x: length(node, "x"), y: length(node, "y") - 0.364 * size }, 0.0),
    };
    let center = Place { x: origin.x + shift * turn.cos(), y: origin.y + shift * turn.sin() };
    LabelBox { center, half: [0.5 * width, 0.364 * size], turn }
}

fn length(node: Node, name: &str) -> f64 {
    node.attribute(name).unwrap().parse().unwrap()
}
