//! The lines of `isophote section`, with their names.

use anyhow::Result;
use isophote::analysis::section::{Axis, SectionLine};
use isophote::camera::{Extent, ScreenPosition};
use isophote::map::Pixel;
use isophote::message;
use isophote::prepare::PreparedScene;
use isophote::text::{Message, significant};

use super::there_are;
use crate::args::SectionArguments;
use crate::failure::Usage;

/// A line, and how it is shown.
pub(super) struct Line {
    pub(super) along: SectionLine,
    pub(super) axis: Axis,
    /// Where it runs, in words.
    pub(super) name: Message,
    /// What its reader should know.
    pub(super) note: Option<Message>,
}

/// All lines that the arguments ask for.
pub(super) fn lines(arguments: &SectionArguments, scene: &PreparedScene) -> Result<Vec<Line>> {
    let asked = &arguments.line;
    let maker = Maker { scene, samples: arguments.samples.unwrap_or(SectionLine::SAMPLES) };
    let are_pixels = [asked.through.len(), asked.horizontal.len(), asked.vertical.len(), asked.line.len()]
        .iter()
        .all(|count| *count == 0);
    if arguments.samples.is_some() && are_pixels {
        let message = message!("--samples does not go with --row and --column, which have a sample for each pixel");
        return Err(Usage(message).into());
    }
    let mut lines = Vec::new();
    for name in &asked.through {
        lines.extend(maker.through(name)?);
    }
    let internal = |coordinate: f64| scene.scene().screen_unit().to_internal(coordinate);
    lines.extend(asked.horizontal.iter().map(|y| maker.horizontal(internal(*y), None)));
    lines.extend(asked.vertical.iter().map(|x| maker.vertical(internal(*x), None)));
    lines.extend(asked.line.iter().map(|ends| maker.between(ends.map(internal))));
    lines.extend(asked.row.iter().map(|row| maker.row(*row)));
    lines.extend(asked.column.iter().map(|column| maker.column(*column)));
    Ok(lines)
}

struct Maker<'s> {
    scene: &'s PreparedScene,
    samples: u32,
}

impl Maker<'_> {
    fn extent(&self) -> Extent {
        let camera = self.scene.scene().camera();
        camera.projection.extent(camera.resolution)
    }

    /// A screen coordinate with its unit.
    fn text(&self, coordinate: f64) -> String {
        let unit = self.scene.scene().screen_unit();
        format!("{} {}", significant(unit.from_internal(coordinate), 6), unit.name())
    }

    /// The horizontal and the vertical line through the centre of a shape.
    fn through(&self, name: &str) -> Result<[Line; 2]> {
        let shapes = self.scene.scene().shapes();
        let Some(shape) = shapes.iter().find(|shape| shape.name == name) else {
            let names: Vec<&str> = shapes.iter().map(|shape| shape.name.as_str()).take(20).collect();
            let there_are = there_are(&names);
            return Err(
                Usage(message!("--through {name}: there is no such shape; {there_are}", name, there_are)).into()
            );
        };
        let Extent { x: [left, right], y: [bottom, top] } = self.extent();
        let place = self.scene.frame().project(shape.geometry.center());
        match place {
            Some([x, y]) if (left..=right).contains(&x) && (bottom..=top).contains(&y) => {
                Ok([self.horizontal(y, Some(name)), self.vertical(x, Some(name))])
            }
            Some([x, y]) => {
                let place = format!("x = {}, y = {}", self.text(x), self.text(y));
                let message =
                    message!("--through {name}: its centre appears outside the image, at {place}", name, place);
                Err(Usage(message).into())
            }
            None => {
                let message = message!("--through {name}: the eye does not see its centre, which is behind it", name);
                Err(Usage(message).into())
            }
        }
    }

    fn horizontal(&self, y: f64, through: Option<&str>) -> Line {
        let along = SectionLine::horizontal(self.scene.scene().camera(), y, self.samples);
        Line { along, axis: Axis::X, name: through_text(format!("y = {}", self.text(y)), through), note: None }
    }

    fn vertical(&self, x: f64, through: Option<&str>) -> Line {
        let along = SectionLine::vertical(self.scene.scene().camera(), x, self.samples);
        Line { along, axis: Axis::Y, name: through_text(format!("x = {}", self.text(x)), through), note: None }
    }

    #[expect(clippy::float_cmp, reason = "only a line that is exactly level has one y")]
    fn between(&self, [x0, y0, x1, y1]: [f64; 4]) -> Line {
        let along = SectionLine::Between { from: [x0, y0], to: [x1, y1], samples: self.samples };
        let axis = match (x0 == x1, y0 == y1) {
            (false, true) => Axis::X,
            (true, false) => Axis::Y,
            _ => Axis::Distance,
        };
        let unit = self.scene.scene().screen_unit();
        let [x0, y0, x1, y1] = [x0, y0, x1, y1].map(|coordinate| significant(unit.from_internal(coordinate), 6));
        let (from, to) = (format!("({x0}, {y0})"), format!("({x1}, {y1})"));
        let name = message!("the line from {from} to {to} {unit}", from, to, unit = unit.name());
        Line { along, axis, name, note: None }
    }

    fn row(&self, row: u32) -> Line {
        let [_, y] = self.center_of(Pixel { column: 0, row });
        let [bottom, top] = self.extent().y;
        let note = half_a_pixel_off(y, [bottom, top], self.scene.scene().camera().resolution.height).map(|middle| {
            let side = if y < middle { message!("below") } else { message!("above") };
            message!(
                "row {row} runs at y = {y}, half a pixel {side} the middle of the image; --horizontal {middle} runs through it",
                row,
                y = self.text(y),
                side,
                middle = significant(self.scene.scene().screen_unit().from_internal(middle), 6)
            )
        });
        let name = message!("row {row}, y = {y}", row, y = self.text(y));
        Line { along: SectionLine::Row(row), axis: Axis::X, name, note }
    }

    fn column(&self, column: u32) -> Line {
        let [x, _] = self.center_of(Pixel { column, row: 0 });
        let note = half_a_pixel_off(x, self.extent().x, self.scene.scene().camera().resolution.width).map(|middle| {
            let side = if x < middle { message!("left") } else { message!("right") };
            message!(
                "column {column} runs at x = {x}, half a pixel to the {side} of the middle of the image; --vertical {middle} runs through it",
                column,
                x = self.text(x),
                side,
                middle = significant(self.scene.scene().screen_unit().from_internal(middle), 6)
            )
        });
        let name = message!("column {column}, x = {x}", column, x = self.text(x));
        Line { along: SectionLine::Column(column), axis: Axis::Y, name, note }
    }

    fn center_of(&self, pixel: Pixel) -> [f64; 2] {
        self.scene.frame().point_on_screen(ScreenPosition::PixelCenter(pixel))
    }
}

/// A line, and the shape through whose centre it runs.
fn through_text(line: String, shape: Option<&str>) -> Message {
    match shape {
        Some(shape) => message!("{line}, through \"{shape}\"", line, shape),
        None => Message::verbatim(line),
    }
}

/// The middle between the edges of the image, if a line of pixels is half a pixel beside it.
fn half_a_pixel_off(at: f64, [least, greatest]: [f64; 2], pixels: u32) -> Option<f64> {
    let middle = f64::midpoint(least, greatest);
    let half = 0.5 * (greatest - least) / f64::from(pixels);
    ((at - middle).abs() < 1.5 * half && pixels.is_multiple_of(2)).then_some(middle)
}
