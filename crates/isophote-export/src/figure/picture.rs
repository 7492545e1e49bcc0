//! What a map figure shows inside its axes: numbers with a colour map and isophotes, or colours as they are.

use isophote::analysis::isophotes::{Isophote, isophotes, nice_levels};
use isophote::map::{Map, Quantity, Scalars, Values};
use isophote::message;
use isophote::text::{Language, significant};

use crate::color_scale::ColorScale;
use crate::figure::color_bar::ColorBar;
use crate::figure::drawing::{Drawing, Place};
use crate::figure::error::FigureError;
use crate::figure::frame::{Frame, TITLE_SIZE};
use crate::figure::label_box::LabelBox;
use crate::figure::options::FigureOptions;
use crate::figure::raster::{self, Scale};
use crate::figure::ticks::{self, Ticks};
use crate::figure::{level_lines, text};

/// The picture of a channel.
pub(super) enum Picture<'figure> {
    /// One number per pixel.
    Numbers { values: Scalars<'figure>, isophotes: Vec<Isophote>, bar: ColorBar },
    /// Three numbers per pixel, which need no colour bar: they are shown in their own colours.
    Colors { colors: &'figure [[f64; 3]], scale: ColorScale, unit: &'figure str, space: &'figure str },
}

impl<'figure> Picture<'figure> {
    /// The picture of the channel in the options, with a height in px.
    pub(super) fn new(map: &'figure Map, options: &FigureOptions, height: f64) -> Result<Self, FigureError> {
        let channel = map.channel(&options.quantity);
        if let (Quantity::Color, Some(Values::Vector(colors))) =
            (&options.quantity, channel.map(|channel| &channel.values))
        {
            let unit = channel.map_or("", |channel| channel.unit.as_str());
            return Self::of_colors(map, colors, unit, options.range);
        }
        // Called first without levels: it checks the channel, and has the best error message if something is wrong.
        isophotes(map, &options.quantity, &[])?;
        let values = map.scalar(&options.quantity).unwrap_or(Scalars::Double(&[]));
        let seen = seen_range(map, &options.quantity, values)?;
        let range = range(options.range, seen)?;
        let levels = nice_levels(range[0], range[1], options.isophotes);
        let isophotes = isophotes(map, &options.quantity, &levels)?;
        Ok(Self::Numbers { values, isophotes, bar: color_bar(map, options, range, seen, levels, height) })
    }

    fn of_colors(
        map: &'figure Map,
        colors: &'figure [[f64; 3]],
        unit: &'figure str,
        asked: Option<[f64; 2]>,
    ) -> Result<Self, FigureError> {
        let infinite = |index: &usize| !colors[*index].iter().all(|component| component.is_finite());
        if let Some(index) = map.mask().indices().find(infinite) {
            let value = colors[index].into_iter().fold(0.0, f64::max);
            return Err(FigureError::NotFinite { name: format!("color[{index}]"), value });
        }
        let scale = ColorScale::new(map, colors, asked);
        match asked {
            Some([low, high]) if !((high - low).is_normal() && low < high) => Err(FigureError::Range { low, high }),
            _ => {
                let space = map.provenance.color_space.as_deref().unwrap_or_default();
                Ok(Self::Colors { colors, scale, unit, space })
            }
        }
    }

    pub(super) fn draw(
        &self,
        drawing: &mut Drawing,
        map: &Map,
        frame: &Frame,
        taken: Vec<LabelBox>,
        is_surface: &dyn Fn(Place) -> bool,
    ) {
        match self {
            Self::Numbers { values, isophotes, bar } => {
                raster::draw_map(drawing, map, |index| bar.scale.color(values.at(index)), frame.rectangle);
                level_lines::draw(drawing, frame, isophotes, bar.scale, bar.ticks.exponent, taken, is_surface);
            }
            Self::Colors { colors, scale, .. } => {
                #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 255")]
                let byte = |level: f64| (255.0 * level).round() as u8;
                raster::draw_map(drawing, map, |index| scale.shown(colors[index]).encoded.map(byte), frame.rectangle);
            }
        }
    }

    pub(super) fn draw_bar(&self, drawing: &mut Drawing, left: f64, top: f64, height: f64) {
        if let Self::Numbers { bar, .. } = self {
            bar.draw(drawing, left, top, height);
        }
    }

    /// Width in px that the colour bar takes.
    pub(super) fn bar_width(&self) -> f64 {
        match self {
            Self::Numbers { bar, .. } => bar.width(),
            Self::Colors { .. } => 0.0,
        }
    }

    /// Length in px that the colour bar's title takes along the side of the picture.
    pub(super) fn bar_title_length(&self) -> f64 {
        match self {
            Self::Numbers { bar, .. } => text::widest(&bar.title, TITLE_SIZE),
            Self::Colors { .. } => 0.0,
        }
    }

    /// What a colour bar would otherwise say.
    pub(super) fn caption(&self, language: Language) -> Option<String> {
        match self {
            Self::Numbers { .. } => None,
            Self::Colors { scale, unit, space, .. } => {
                let [black, white] = scale.range.map(|value| significant(value, 4));
                let caption = message!(
                    "{space}, black {black} and white {white} {unit} of each component, shown in sRGB",
                    space,
                    black,
                    white,
                    unit
                );
                Some(caption.in_language(language))
            }
        }
    }
}

/// The minimum and maximum seen; `None` if no surface is seen.
fn seen_range(map: &Map, quantity: &Quantity, values: Scalars<'_>) -> Result<Option<[f64; 2]>, FigureError> {
    let mut seen: Option<[f64; 2]> = None;
    for index in map.mask().indices() {
        let value = values.at(index);
        if !value.is_finite() {
            return Err(FigureError::NotFinite { name: format!("{}[{index}]", quantity.name()), value });
        }
        let [low, high] = seen.unwrap_or([value; 2]);
        seen = Some([low.min(value), high.max(value)]);
    }
    Ok(seen)
}

/// The requested range, or the range seen, widened if it is a single value.
fn range(asked: Option<[f64; 2]>, seen: Option<[f64; 2]>) -> Result<[f64; 2], FigureError> {
    match (asked, seen) {
        (Some([low, high]), _) if (high - low).is_normal() && low < high => Ok([low, high]),
        (Some([low, high]), _) => Err(FigureError::Range { low, high }),
        (None, None) => Err(FigureError::NothingSeen),
        (None, Some([low, high])) if (high - low) > 1e-12 * high.abs().max(low.abs()) => Ok([low, high]),
        (None, Some([0.0, _])) => Ok([0.0, 1.0]),
        (None, Some([value, _])) => Ok([value - 0.5 * value.abs(), value + 0.5 * value.abs()]),
    }
}

fn color_bar(
    map: &Map,
    options: &FigureOptions,
    range: [f64; 2],
    seen: Option<[f64; 2]>,
    levels: Vec<f64>,
    height: f64,
) -> ColorBar {
    let ticks = Ticks::stacked(range, height);
    let channel_unit = map.channel(&options.quantity).map_or("", |channel| channel.unit.as_str());
    let title = ticks::title(&options.label, options.unit.as_deref().unwrap_or(channel_unit), ticks.exponent);
    let beyond = seen.map_or([false; 2], |[low, high]| [low < range[0], high > range[1]]);
    let scale = Scale { colormap: options.colormap, range };
    ColorBar { scale, ticks, title: text::wrap(&title, TITLE_SIZE, height.max(160.0)), levels, beyond }
}
