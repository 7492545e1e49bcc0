//! A map as a figure.

use isophote::map::{CoordinateAxis, Map};

use crate::figure::drawing::{Anchor, Drawing, Figure, INK, Place, Rectangle, Stroke, Style, Text};
use crate::figure::error::FigureError;
use crate::figure::frame::{Axis, Frame, TICK_SIZE};
use crate::figure::marks::{self, PlacedMark};
use crate::figure::options::FigureOptions;
use crate::figure::page::{MARGIN, Page};
use crate::figure::picture::Picture;
use crate::figure::text;
use crate::figure::ticks::{self, Ticks};

/// Length of the picture's longer side in px.
const PICTURE: f64 = 480.0;
const BAR_GAP: f64 = 18.0;
/// Minimum page width in px: narrower pages have no room for a title.
const NARROWEST: f64 = 320.0;
const LEGEND_SIZE: f64 = 9.5;

/// A map as a figure with axes in the window's units, equal scales in both directions (unless the options set
/// other proportions), a colour bar, isophotes labelled with their levels, and marks.
///
/// Pixels without a surface are hatched, so that "no surface" is not mistaken for "dark".
///
/// # Errors
/// [`FigureError`]: the channel is missing, or is neither scalar nor colours; a value is not finite; the range is
/// invalid; no surface is seen; or a mark lies outside the window.
pub fn map_figure(map: &Map, options: &FigureOptions) -> Result<Figure, FigureError> {
    let content = Content::new(map, options)?;
    let layout = Layout::new(&content);
    let marks = marks::place(&layout.frame, &options.marks)?;
    let mut drawing = Drawing::default();
    content.draw_picture(&mut drawing, &layout.frame, &marks);
    layout.frame.draw_axes(&mut drawing, &content.x, &content.y);
    content.draw_color_bar(&mut drawing, &layout);
    layout.page.draw(&mut drawing, layout.frame.rectangle.left + 0.5 * layout.frame.rectangle.width, layout.bottom);
    Ok(drawing.finish(layout.width, layout.page.height(layout.bottom)))
}

/// Everything to be drawn, before layout.
struct Content<'figure> {
    map: &'figure Map,
    options: &'figure FigureOptions,
    picture: Picture<'figure>,
    has_gaps: bool,
    /// Width and height of the picture in px.
    size: [f64; 2],
    x: Axis,
    y: Axis,
}

impl<'figure> Content<'figure> {
    fn new(map: &'figure Map, options: &'figure FigureOptions) -> Result<Self, FigureError> {
        let window = &map.window;
        let sides = [window.x[1] - window.x[0], window.y[1] - window.y[0]];
        let [width, height] = options.proportions.unwrap_or(sides);
        let size = [width, height].map(|side| side * PICTURE / width.max(height));
        let axis = |axis: CoordinateAxis, ticks: Ticks| {
            let is_length = axis.unit != "1" && axis.unit != "°";
            let unit = options.length_unit.as_deref().filter(|_| is_length).unwrap_or(axis.unit);
            Axis { title: ticks::title(&axis.label(options.language), unit, ticks.exponent), ticks }
        };
        let [x, y] = window.coordinates.axes(window.length);
        Ok(Self {
            map,
            options,
            picture: Picture::new(map, options, size[1])?,
            has_gaps: map.mask().visible() < map.region.size.pixels(),
            size,
            x: if goes_round(x, window.x) {
                axis(x, Ticks::of_degrees(window.x, size[0]))
            } else {
                axis(x, Ticks::side_by_side(window.x, size[0], TICK_SIZE))
            },
            y: if goes_round(y, window.y) {
                axis(y, Ticks::of_degrees(window.y, size[1]))
            } else {
                axis(y, Ticks::stacked(window.y, size[1]))
            },
        })
    }

    fn draw_picture(&self, drawing: &mut Drawing, frame: &Frame, marks: &[PlacedMark]) {
        if self.has_gaps {
            drawing.rectangle(frame.rectangle, Style::hatched());
        }
        let taken = marks.iter().flat_map(PlacedMark::rooms).collect();
        let is_surface = |place: Place| is_surface(self.map, &frame.rectangle, place);
        self.picture.draw(drawing, self.map, frame, taken, &is_surface);
        for mark in marks {
            mark.draw(drawing);
        }
    }

    fn draw_color_bar(&self, drawing: &mut Drawing, layout: &Layout) {
        let Rectangle { top, height, .. } = layout.frame.rectangle;
        let left = layout.frame.right() + BAR_GAP;
        self.picture.draw_bar(drawing, left, top, height);
        if self.has_gaps {
            let middle = layout.frame.bottom() + 20.0;
            let swatch = Rectangle { left, top: middle - 5.0, width: 16.0, height: 10.0 };
            drawing.rectangle(swatch, Style::hatched().with_outline(Stroke::new(INK, 0.6)));
            let at = Place { x: left + 21.0, y: middle };
            drawing.text(Text::new(&self.options.no_surface, at, LEGEND_SIZE, Anchor::Start));
        }
    }

    /// Space in px to the right of the picture.
    fn right_width(&self) -> f64 {
        let legend = if self.has_gaps { 21.0 + text::width(&self.options.no_surface, LEGEND_SIZE) } else { 0.0 };
        BAR_GAP + self.picture.bar_width().max(legend)
    }
}

/// The positions of everything on the page, in px.
struct Layout {
    page: Page,
    frame: Frame,
    width: f64,
    /// Lower end of the axes.
    bottom: f64,
}

impl Layout {
    fn new(content: &Content) -> Self {
        let [picture_width, picture_height] = content.size;
        let natural = 2.0 * MARGIN + content.y.width() + picture_width + content.right_width();
        let width = natural.max(NARROWEST);
        let provenance = &content.map.provenance;
        let caption = content.picture.caption(content.options.language).unwrap_or_default();
        let made_by = [caption.as_str(), provenance.program.as_str(), provenance.renderer.as_str()];
        let footer = made_by.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" · ");
        let page = Page::new(width, &content.options.title, &footer);
        // The colour bar's title runs along the side of the picture, and may be longer than that side.
        let overhang = 0.5 * (content.picture.bar_title_length() - picture_height).max(0.0);
        let rectangle = Rectangle {
            left: MARGIN + content.y.width() + 0.5 * (width - natural),
            top: page.top() + overhang.max(0.5 * TICK_SIZE),
            width: picture_width,
            height: picture_height,
        };
        let bottom = rectangle.top + picture_height + Axis::height().max(overhang);
        Self { page, frame: Frame { rectangle, x: content.map.window.x, y: content.map.window.y }, width, bottom }
    }
}

/// Whether a range of angles is large enough for ticks at divisors of a right angle.
fn goes_round(axis: CoordinateAxis, [first, last]: [f64; 2]) -> bool {
    axis.unit == "°" && last - first >= 90.0
}

/// Whether the pixel at a point of the page shows a surface.
fn is_surface(map: &Map, picture: &Rectangle, place: Place) -> bool {
    let size = map.region.size;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the image")]
    let index = |offset: f64, side: f64, count: u32| {
        (offset / side * f64::from(count)).floor().clamp(0.0, f64::from(count - 1)) as usize
    };
    let column = index(place.x - picture.left, picture.width, size.width);
    let row = index(place.y - picture.top, picture.height, size.height);
    map.mask().shape_at(row * size.width as usize + column).is_some()
}

#[cfg(test)]
mod tests;
