//! What is on a page: shapes, texts and images, from the bottom up. Positions are in px, x to the right and y down.

pub(super) type Color = [u8; 3];

pub(super) const INK: Color = [0x1a; 3];
pub(super) const PALE_INK: Color = [0x7a; 3];
pub(super) const PAPER: Color = [0xff; 3];
pub(super) const BLACK: Color = [0; 3];

/// A finished figure: [`to_svg`](Self::to_svg) and [`to_png`](Self::to_png) write it.
#[derive(Clone, Debug)]
pub struct Figure {
    /// Width and height of the page, in whole px.
    pub(super) size: [f64; 2],
    pub(super) elements: Vec<Element>,
}

/// A page under construction.
#[derive(Default)]
pub(super) struct Drawing {
    elements: Vec<Element>,
}

/// Something on the page.
#[derive(Clone, Debug)]
pub(super) enum Element {
    Shape(Shape, Style),
    Text(Text),
    Image(Image),
}

#[derive(Clone, Debug)]
pub(super) enum Shape {
    Rectangle(Rectangle),
    Path { places: Vec<Place>, closed: bool },
    Circle { center: Place, radius: f64 },
}

/// A point on the page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub(super) x: f64,
    pub(super) y: f64,
}

/// A rectangle on the page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rectangle {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) width: f64,
    pub(super) height: f64,
}

/// How a shape is filled and outlined.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Style {
    pub(super) fill: Option<Fill>,
    pub(super) stroke: Option<Stroke>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Fill {
    Color(Color),
    /// Pale, cool and striped: unlike any colour of any colour map.
    Hatching,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stroke {
    pub(super) color: Color,
    pub(super) width: f64,
    pub(super) opacity: f64,
    /// Whether corners are round; else they are mitred.
    pub(super) round: bool,
    /// Lengths of dashes and of the gaps between them; none for a solid line.
    pub(super) dashes: &'static [f64],
}

/// One line of text; `at` is at half the height of its capitals.
#[derive(Clone, Debug)]
pub(super) struct Text {
    pub(super) content: String,
    pub(super) at: Place,
    pub(super) size: f64,
    pub(super) anchor: Anchor,
    /// Clockwise.
    pub(super) degrees: f64,
    pub(super) color: Color,
    /// Colour of an outline that keeps the text readable on top of lines.
    pub(super) halo: Option<Color>,
}

/// Which end of a text is at its position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// Pixels, stretched over their place.
#[derive(Clone, Debug)]
pub(super) struct Image {
    pub(super) place: Rectangle,
    /// Width and height in pixels.
    pub(super) size: [u32; 2],
    /// Opaque, or transparent black.
    pub(super) rgba: Vec<u8>,
    /// Whether every pixel is shown as a rectangle; else they are blended.
    pub(super) pixelated: bool,
}

impl Place {
    pub(super) fn distance(self, other: Self) -> f64 {
        (self.x - other.x).hypot(self.y - other.y)
    }
}

impl Style {
    pub(super) const fn filled(color: Color) -> Self {
        Self { fill: Some(Fill::Color(color)), stroke: None }
    }

    pub(super) const fn hatched() -> Self {
        Self { fill: Some(Fill::Hatching), stroke: None }
    }

    pub(super) const fn line(stroke: Stroke) -> Self {
        Self { fill: None, stroke: Some(stroke) }
    }

    pub(super) const fn with_outline(self, stroke: Stroke) -> Self {
        Self { stroke: Some(stroke), ..self }
    }
}

impl Stroke {
    /// An opaque solid line with mitred corners.
    pub(super) const fn new(color: Color, width: f64) -> Self {
        Self { color, width, opacity: 1.0, round: false, dashes: &[] }
    }

    pub(super) const fn round(self) -> Self {
        Self { round: true, ..self }
    }
}

impl Text {
    /// Width of the outline of a text in px, half of which is outside the letters.
    pub(super) const HALO: f64 = 2.6;

    /// Horizontal black text, without a halo.
    pub(super) fn new(content: &str, at: Place, size: f64, anchor: Anchor) -> Self {
        Self { content: content.into(), at, size, anchor, degrees: 0.0, color: INK, halo: None }
    }

    /// From `at` down to the base line: half the height of a capital.
    pub(super) fn drop(&self) -> f64 {
        0.364 * self.size
    }
}

impl Drawing {
    pub(super) fn rectangle(&mut self, rectangle: Rectangle, style: Style) {
        self.elements.push(Element::Shape(Shape::Rectangle(rectangle), style));
    }

    /// A path through the points.
    pub(super) fn path(&mut self, places: &[Place], closed: bool, style: Style) {
        self.elements.push(Element::Shape(Shape::Path { places: places.into(), closed }, style));
    }

    pub(super) fn circle(&mut self, center: Place, radius: f64, style: Style) {
        self.elements.push(Element::Shape(Shape::Circle { center, radius }, style));
    }

    pub(super) fn text(&mut self, text: Text) {
        self.elements.push(Element::Text(text));
    }

    pub(super) fn image(&mut self, image: Image) {
        self.elements.push(Element::Image(image));
    }

    /// The figure, on a page of this size in px.
    pub(super) fn finish(self, width: f64, height: f64) -> Figure {
        Figure { size: [width.ceil(), height.ceil()], elements: self.elements }
    }
}

/// Pictures are drawn in single precision.
#[expect(clippy::cast_possible_truncation, reason = "a place on a page")]
pub(super) fn single(value: f64) -> f32 {
    value as f32
}
