//! `isophote render`: a map, its numbers and its files.

use std::path::PathBuf;

use anyhow::Result;
use isophote::analysis::probe::{Place, ProbeReading};
use isophote::analysis::statistics::{Counts, Extreme, Statistics, counts, statistics};
use isophote::export::csv::Rows;
use isophote::export::figure::{self, FigureOptions, Mark};
use isophote::export::png::Depth;
use isophote::map::{Map, Quantity, Region};
use isophote::prepare::PreparedScene;
use isophote::render::{RenderSettings, Renderer, Threaded};
use isophote::scene::Scene;
use isophote::text::significant;
use isophote::units::Choice;
use serde::Serialize;

use super::output::{FigureFormat, MapFile, MapStyle, figure_format, refuse_twice, write_figure};
use super::probe::{self, ProbeJson};
use crate::args::RenderArguments;
use crate::failure::{self, Usage};
use crate::progress::Progress;
use crate::{load, numbers};

/// Renders a scene.
pub fn run(arguments: &RenderArguments) -> Result<String> {
    let scene = PreparedScene::new(&load::scene(&arguments.scene, arguments.size, arguments.quiet)?);
    let job = Job::new(arguments, scene.scene())?;
    let mut map = job.render(&scene)?;
    let summary = Summary::new(&map, &scene, &job);
    map.retain(|quantity| job.wanted.contains(quantity));
    let notes = job.write(&map, &scene)?;
    if !arguments.quiet {
        notes.iter().for_each(|note| failure::note(note));
    }
    if arguments.json { numbers::json(&summary.to_json(&scene, &job)) } else { Ok(summary.to_text(&scene, &job)) }
}

impl RenderArguments {
    /// What the bare command does: the lab's scene and its picture.
    pub fn lab() -> Self {
        Self { depth: "8".into(), gamma: 1.0, isophotes: 6, ..Self::default() }
    }
}

/// Valid arguments.
struct Job<'a> {
    arguments: &'a RenderArguments,
    /// The channel that is summarised and pictured.
    main: Quantity,
    /// The channels that files get.
    wanted: Vec<Quantity>,
    files: Vec<MapFile>,
    figures: Vec<(PathBuf, FigureFormat)>,
    style: MapStyle,
}

impl<'a> Job<'a> {
    fn new(arguments: &'a RenderArguments, scene: &Scene) -> Result<Self> {
        let mut wanted = channels(&arguments.channel, scene)?;
        let main = wanted.first().cloned().unwrap_or(Quantity::Brightness);
        let outputs = if arguments.scene.scene.is_none() && arguments.output.is_empty() && arguments.figure.is_empty() {
            vec![PathBuf::from("lab.png")]
        } else {
            arguments.output.clone()
        };
        refuse_twice(outputs.iter().chain(&arguments.figure))?;
        let files: Vec<MapFile> = outputs.iter().map(|path| MapFile::new(path)).collect::<Result<_>>()?;
        let figures = arguments.figure.iter().map(|path| Ok((path.clone(), figure_format(path)?)));
        let figures = figures.collect::<Result<Vec<_>>>()?;
        if wanted.is_empty() {
            wanted.push(main.clone());
            if files.iter().any(MapFile::holds_many_channels) {
                wanted.extend(Quantity::COMMON);
            }
        }
        if arguments.lights {
            wanted.extend(scene.lights().iter().map(|light| Quantity::Light(light.name.clone())));
        }
        let depth = if arguments.depth == "16" { Depth::Sixteen } else { Depth::Eight };
        let style = MapStyle {
            quantity: main.clone(),
            range: arguments.range,
            gamma: arguments.gamma,
            depth,
            colormap: arguments.colormap,
            rows: if arguments.visible_only { Rows::Visible } else { Rows::All },
        };
        let job = Self { arguments, main, wanted, files, figures, style };
        job.refuse_impossible_pictures()?;
        Ok(job)
    }

    /// Known before anything is computed.
    fn refuse_impossible_pictures(&self) -> Result<(), Usage> {
        let has_picture = self.files.iter().any(MapFile::is_picture);
        let is_scalar = !matches!(self.main, Quantity::Position | Quantity::Normal | Quantity::Shape);
        if !is_scalar && (has_picture || !self.figures.is_empty()) {
            let message = "cannot be a picture: it is not one quantity a pixel; put another --channel first";
            return Err(Usage(format!("the channel `{}` {message}", self.main.name())));
        }
        if has_picture && self.style.depth == Depth::Sixteen && self.style.colormap.is_some() {
            let message = "--depth 16 does not go with --colormap: colours have 8 bits, only grey pictures have 16";
            return Err(Usage(message.into()));
        }
        Ok(())
    }

    fn render(&self, scene: &PreparedScene) -> Result<Map> {
        let arguments = self.arguments;
        // The irradiance tells which pixels are lit.
        let quantities = self.wanted.iter().cloned().chain([Quantity::Irradiance]).collect();
        let region = arguments.region.unwrap_or(Region::all(scene.scene().camera().resolution));
        let progress = Progress::new(region.size.pixels() as u64, arguments.quiet);
        let settings = RenderSettings { region: Some(region), quantities, observer: Some(&progress) };
        let map = Threaded { threads: arguments.threads }.render(scene, &settings);
        progress.finish();
        map.map_err(|error| match error {
            isophote::render::RenderError::Region { .. } => Usage(error.to_string()).into(),
            error => error.into(),
        })
    }

    fn write(&self, map: &Map, scene: &PreparedScene) -> Result<Vec<String>> {
        let mut notes = Vec::new();
        for file in &self.files {
            file.write(map, &self.style, &mut notes)?;
        }
        if !self.figures.is_empty() {
            let svg = figure::map_figure_svg(map, &self.figure_options(map, scene))?;
            for (path, format) in &self.figures {
                write_figure(&svg, path, *format, &mut notes)?;
            }
        }
        Ok(notes)
    }

    fn figure_options(&self, map: &Map, scene: &PreparedScene) -> FigureOptions {
        let label = match self.main {
            Quantity::Brightness => format!("brightness, {}", map.provenance.convention),
            _ => self.main.name(),
        };
        FigureOptions {
            title: scene.scene().title().to_owned(),
            colormap: self.arguments.colormap.unwrap_or_default(),
            range: self.arguments.range,
            isophotes: self.arguments.isophotes.into(),
            marks: marks(map, scene),
            ..FigureOptions::new(self.main.clone(), &label)
        }
    }
}

/// The channels that the user named, with a clear word about those that do not exist.
pub fn channels(names: &[String], scene: &Scene) -> Result<Vec<Quantity>> {
    let lights: Vec<Quantity> = scene.lights().iter().map(|light| Quantity::Light(light.name.clone())).collect();
    let known = |quantity: &Quantity| !matches!(quantity, Quantity::Light(_)) || lights.contains(quantity);
    let channel = |name: &String| {
        Quantity::from_name(name).filter(known).ok_or_else(|| {
            let names: Vec<String> =
                Quantity::COMMON.iter().chain(lights.iter().take(20)).map(Quantity::name).collect();
            Usage(format!("there is no channel `{name}`; allowed: {}", names.join(", "))).into()
        })
    };
    names.iter().map(channel).collect()
}

/// The probes that the eye sees, where they appear in the map.
fn marks(map: &Map, scene: &PreparedScene) -> Vec<Mark> {
    let window = map.window;
    let mark = |probe: &isophote::scene::Probe| {
        let [x, y] = scene.frame().project(probe.at)?.map(|metres| window.length.from_metres(metres));
        let inside = (window.x[0]..=window.x[1]).contains(&x) && (window.y[0]..=window.y[1]).contains(&y);
        let seen = scene.probe(&Place::Point(probe.at)).ok()?.is_seen();
        (inside && seen).then(|| Mark { name: probe.name.clone(), x, y })
    };
    scene.scene().probes().iter().filter_map(mark).collect()
}

/// The numbers of a map.
struct Summary {
    counts: Counts,
    statistics: Option<Statistics>,
    probes: Vec<(String, ProbeReading, Option<f64>)>,
}

impl Summary {
    fn new(map: &Map, scene: &PreparedScene, job: &Job<'_>) -> Self {
        let reading = |probe: &isophote::scene::Probe| {
            let reading = scene.probe(&Place::Point(probe.at)).ok()?;
            Some((probe.name.clone(), reading, probe.published))
        };
        Self {
            counts: counts(map),
            statistics: statistics(map, &job.main),
            probes: scene.scene().probes().iter().filter_map(reading).collect(),
        }
    }

    fn to_text(&self, scene: &PreparedScene, job: &Job<'_>) -> String {
        let description = scene.scene();
        let resolution = description.camera().resolution;
        let Counts { pixels, visible, lit } = self.counts;
        let mut lines = Vec::new();
        if !description.title().is_empty() {
            lines.extend([description.title().to_owned(), String::new()]);
        }
        let mut row = |name: &str, value: String| lines.push(format!("  {name:<12}{value}"));
        row("image", format!("{} × {} pixels{}", resolution.width, resolution.height, region_text(job)));
        #[allow(clippy::cast_precision_loss, reason = "fewer than 2^53 pixels")]
        let share = 100.0 * visible as f64 / pixels as f64;
        row("visible", format!("{visible} of {pixels} pixels ({} %)", significant(share, 4)));
        row("lit", format!("{} pixels", lit.unwrap_or(0)));
        let convention = description.convention();
        row("channel", format!("{}, {}", job.main.name(), unit(&job.main, description)));
        row("convention", format!("{}: {}", convention.label(), convention.formula()));
        match &self.statistics {
            Some(statistics) => {
                row("maximum", extreme_text(&statistics.max, scene, job));
                row("minimum", extreme_text(&statistics.min, scene, job));
                row(
                    "mean",
                    format!(
                        "{} {} over the visible pixels",
                        significant(statistics.mean, 12),
                        unit(&job.main, description)
                    ),
                );
            }
            None if visible == 0 => row("", "no surface is seen".into()),
            None => row("", "this channel has no single number a pixel to sum up".into()),
        }
        let mut text = lines.join("\n") + "\n";
        if !self.probes.is_empty() {
            let rows: Vec<_> =
                self.probes.iter().map(|(name, reading, published)| (name.as_str(), reading, *published)).collect();
            text.push('\n');
            text.push_str(&probe::table_text(&rows, scene));
        }
        text
    }

    fn to_json(&self, scene: &PreparedScene, job: &Job<'_>) -> SummaryJson {
        let description = scene.scene();
        let extreme = |extreme: &Extreme| ExtremeJson {
            value: extreme.value,
            pixel: [extreme.pixel.column, extreme.pixel.row],
            point: point_at(extreme, scene),
        };
        SummaryJson {
            title: description.title().into(),
            resolution: [description.camera().resolution.width, description.camera().resolution.height],
            region: job
                .arguments
                .region
                .map(|region| [region.corner.column, region.corner.row, region.size.width, region.size.height]),
            length: description.length().name(),
            convention: description.convention().name(),
            formula: description.convention().formula_number(),
            channel: job.main.name(),
            unit: unit(&job.main, description),
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
        }
    }
}

#[derive(Serialize)]
struct SummaryJson {
    title: String,
    resolution: [u32; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    region: Option<[u32; 4]>,
    length: &'static str,
    convention: &'static str,
    formula: &'static str,
    channel: String,
    unit: String,
    pixels: usize,
    visible_pixels: usize,
    lit_pixels: Option<usize>,
    max: Option<ExtremeJson>,
    min: Option<ExtremeJson>,
    mean: Option<f64>,
    probes: Vec<ProbeJson>,
}

#[derive(Serialize)]
struct ExtremeJson {
    value: f64,
    pixel: [u32; 2],
    point: Option<[f64; 3]>,
}

/// The unit of a quantity in a scene.
pub fn unit(quantity: &Quantity, scene: &Scene) -> String {
    quantity.unit(scene.convention(), scene.quantities(), scene.length()).to_owned()
}

fn region_text(job: &Job<'_>) -> String {
    job.arguments.region.map_or(String::new(), |region| {
        let Region { corner, size } = region;
        format!("; of these {} × {} from column {}, row {}", size.width, size.height, corner.column, corner.row)
    })
}

fn point_at(extreme: &Extreme, scene: &PreparedScene) -> Option<[f64; 3]> {
    let length = scene.scene().length();
    let hit = scene.trace_pixel(extreme.pixel)?;
    Some(hit.point.position().to_array().map(|metres| length.from_metres(metres)))
}

fn extreme_text(extreme: &Extreme, scene: &PreparedScene, job: &Job<'_>) -> String {
    let unit = unit(&job.main, scene.scene());
    let Extreme { value, pixel } = extreme;
    let value = significant(*value, 12);
    let point = point_at(extreme, scene).map_or(String::new(), |point| {
        let [x, y, z] = point.map(|coordinate| significant(coordinate, 6));
        format!(", point ({x}, {y}, {z}) {}", scene.scene().length().name())
    });
    format!("{value} {unit} at column {}, row {}{point}", pixel.column, pixel.row)
}
