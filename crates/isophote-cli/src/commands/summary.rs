//! The statistics of a map, for people and for programs.

use isophote::analysis::probe::{ProbePosition, ProbeReading};
use isophote::analysis::statistics::{Counts, Extreme, Statistics, counts, statistics};
use isophote::map::{Map, Pixel, Quantity, Region, Resolution};
use isophote::message;
use isophote::prepare::PreparedScene;
use isophote::text::{Language, Message, escaped_line, significant};
use isophote::units::Keyword;
use isophote_zarr::MapStatistics;
use serde::Serialize;

use super::areas::{AreaJson, Areas};
use super::reading_json::ProbeJson;
use super::reading_table;
use crate::channels::unit;

/// The statistics of a map.
pub struct Summary {
    /// The channel that is summarised.
    main: Quantity,
    /// The part of the image, if it is not the whole.
    region: Option<Region>,
    counts: Counts,
    statistics: Option<Statistics>,
    refined: Option<Refined>,
    /// Pixels that would need more rays for the tolerance than they may have, if there is one.
    over_tolerance: Option<usize>,
    probes: Vec<Reading>,
    areas: Areas,
}

/// How much of a map was supersampled.
#[derive(Clone, Copy)]
struct Refined {
    /// Visible pixels with more than one ray.
    pixels: usize,
    /// Total number of rays.
    rays: f64,
}

impl Refined {
    fn of(map: &Map) -> Option<Self> {
        let samples = map.scalar(&Quantity::Samples)?;
        let refined = samples.iter().filter(|samples| *samples > 1.0).count();
        Some(Self { pixels: refined, rays: samples.iter().sum() })
    }
}

impl Summary {
    pub fn new(map: &Map, main: &Quantity, scene: &PreparedScene) -> Self {
        Self {
            main: main.clone(),
            region: (map.region.size != map.full).then_some(map.region),
            counts: counts(map),
            statistics: statistics(map, main),
            refined: Refined::of(map),
            over_tolerance: map.over_tolerance,
            probes: readings(scene),
            areas: Areas::of(scene),
        }
    }

    /// The statistics of a map that was never in memory as a whole, for its first channel.
    pub fn of_store(map: &MapStatistics, scene: &PreparedScene) -> Self {
        let count = |pixels: u64| usize::try_from(pixels).unwrap_or(usize::MAX);
        let main = map.channels.first();
        Self {
            main: main.map_or(Quantity::Brightness, |main| main.quantity.clone()),
            region: None,
            counts: Counts { pixels: count(map.pixels), visible: count(map.visible), lit: Some(count(map.lit)) },
            statistics: main.and_then(|main| main.statistics),
            refined: None,
            over_tolerance: None,
            probes: readings(scene),
            areas: Areas::of(scene),
        }
    }

    pub fn to_text(&self, scene: &PreparedScene, language: Language) -> String {
        let description = scene.scene();
        let resolution = description.camera().resolution;
        let Counts { pixels, visible, lit } = self.counts;
        let unit = unit(&self.main, description);
        let mut lines = Vec::new();
        if !description.title().is_empty() {
            lines.extend([escaped_line(description.title()).into_owned(), String::new()]);
        }
        let mut row = |name: Message, value: Message| {
            lines.push(format!("  {:<12}{}", name.in_language(language), value.in_language(language)));
        };
        let Resolution { width, height } = resolution;
        row(
            message!("image"),
            message!("{width} × {height} pixels{region}", width, height, region = self.region_text()),
        );
        #[allow(clippy::cast_precision_loss, reason = "fewer than 2^53 pixels")]
        let share = 100.0 * visible as f64 / pixels as f64;
        row(
            message!("visible"),
            message!("{visible} of {pixels} pixels ({share} %)", visible, pixels, share = significant(share, 4)),
        );
        row(message!("lit"), message!("{count} pixels", count = lit.unwrap_or(0)));
        let convention = description.convention();
        let separator = if unit.is_empty() { "" } else { ", " };
        let channel = self.main.label_in(description.unit_system(), language);
        row(message!("channel"), Message::verbatim(format!("{channel}{separator}{unit}")));
        row(message!("convention"), Message::verbatim(format!("{}: {}", convention.label(), convention.formula())));
        if let Some(color) = description.color_label() {
            row(message!("color space"), Message::verbatim(color));
        }
        match &self.statistics {
            Some(statistics) => {
                row(message!("maximum"), extreme_text(&statistics.max, &unit, scene));
                row(message!("minimum"), extreme_text(&statistics.min, &unit, scene));
                let mean = significant(statistics.mean, 12);
                row(message!("mean"), message!("{mean} {unit} over the visible pixels", mean, unit));
            }
            None if visible == 0 => row(Message::empty(), message!("no surface is seen")),
            None => row(Message::empty(), message!("no extremes: this channel is not one quantity a pixel")),
        }
        if let Some(Refined { pixels: refined, rays }) = self.refined {
            #[allow(clippy::cast_precision_loss, reason = "fewer than 2^53 pixels")]
            let [share, mean] = [100.0 * refined as f64 / pixels as f64, rays / visible.max(1) as f64];
            let [share, mean] = [share, mean].map(|number| significant(number, 4));
            let value = message!(
                "{refined} pixels ({share} %) by more rays than one; {mean} a visible pixel",
                refined,
                share,
                mean
            );
            row(message!("refined"), value);
        }
        if let Some(pixels) = self.over_tolerance.filter(|pixels| *pixels > 0) {
            let samples = description.sampling().samples;
            let value = message!("not assured in {pixels} pixels by {samples} rays each", pixels, samples);
            row(message!("tolerance"), value);
        }
        let mut text = lines.join("\n") + "\n";
        if !self.probes.is_empty() {
            let rows: Vec<_> =
                self.probes.iter().map(|(name, reading, published)| (name.as_str(), reading, *published)).collect();
            text.push('\n');
            text.push_str(&reading_table::text(&rows, scene, language));
        }
        if !self.areas.is_empty() {
            text.push('\n');
            text.push_str(&self.areas.to_text(description, language));
        }
        text
    }

    fn region_text(&self) -> Message {
        self.region.map_or_else(Message::empty, |Region { corner: Pixel { column, row }, size }| {
            let Resolution { width, height } = size;
            message!("; of these {width} × {height} from column {column}, row {row}", width, height, column, row)
        })
    }

    pub fn to_json(&self, scene: &PreparedScene) -> SummaryJson {
        let description = scene.scene();
        let extreme = |extreme: &Extreme| ExtremeJson {
            value: extreme.value,
            pixel: [extreme.pixel.column, extreme.pixel.row],
            point: point_at(extreme, scene),
        };
        SummaryJson {
            title: description.title().into(),
            resolution: [description.camera().resolution.width, description.camera().resolution.height],
            region: self.region.map(|Region { corner, size }| [corner.column, corner.row, size.width, size.height]),
            length: description.length().name(),
            convention: description.convention().name(),
            formula: description.convention().formula_number(),
            color_space: description.color().map(|color| color.space.name()),
            channel: self.main.name(),
            unit: unit(&self.main, description),
            refined: self.refined.map(|refined| refined.pixels),
            over_tolerance: self.over_tolerance,
            pixels: self.counts.pixels,
            visible_pixels: self.counts.visible,
            lit_pixels: self.counts.lit,
            max: self.statistics.map(|statistics| extreme(&statistics.max)),
            min: self.statistics.map(|statistics| extreme(&statistics.min)),
            mean: self.statistics.map(|statistics| statistics.mean),
            probes: self
                .probes
                .iter()
                .map(|(name, reading, published)| ProbeJson::new(name, reading, *published, scene))
                .collect(),
            areas: self.areas.to_json(description),
        }
    }
}

type Reading = (String, ProbeReading, Option<f64>);

/// The scene's own probes.
fn readings(scene: &PreparedScene) -> Vec<Reading> {
    let reading = |probe: &isophote::scene::Probe| {
        let reading = scene.probe(&ProbePosition::Point(probe.at)).ok()?;
        Some((probe.name.clone(), reading, probe.published))
    };
    scene.scene().probes().iter().filter_map(reading).collect()
}

/// The summary for programs; lengths in the scene's unit.
#[derive(Serialize)]
pub struct SummaryJson {
    title: String,
    resolution: [u32; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    region: Option<[u32; 4]>,
    length: &'static str,
    convention: &'static str,
    formula: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    color_space: Option<&'static str>,
    channel: String,
    unit: String,
    /// Pixels with more than one ray, if the scene asks for more than one.
    #[serde(skip_serializing_if = "Option::is_none")]
    refined: Option<usize>,
    /// Pixels whose error bound exceeds the tolerance, if there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    over_tolerance: Option<usize>,
    pixels: usize,
    visible_pixels: usize,
    lit_pixels: Option<usize>,
    max: Option<ExtremeJson>,
    min: Option<ExtremeJson>,
    mean: Option<f64>,
    probes: Vec<ProbeJson>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    areas: Vec<AreaJson>,
}

#[derive(Serialize)]
struct ExtremeJson {
    value: f64,
    pixel: [u32; 2],
    point: Option<[f64; 3]>,
}

fn point_at(extreme: &Extreme, scene: &PreparedScene) -> Option<[f64; 3]> {
    let length = scene.scene().length();
    let hit = scene.trace_pixel(extreme.pixel)?;
    Some(hit.point.position().to_array().map(|metres| length.from_metres(metres)))
}

fn extreme_text(extreme: &Extreme, unit: &str, scene: &PreparedScene) -> Message {
    let Extreme { value, pixel: Pixel { column, row } } = extreme;
    let value = significant(*value, 12);
    let Some(point) = point_at(extreme, scene) else {
        return message!("{value} {unit} at column {column}, row {row}", value, unit, column, row);
    };
    let [x, y, z] = point.map(|coordinate| significant(coordinate, 6));
    message!(
        "{value} {unit} at column {column}, row {row}, point {point} {length}",
        value,
        unit,
        column,
        row,
        point = format!("({x}, {y}, {z})"),
        length = scene.scene().length().name()
    )
}
