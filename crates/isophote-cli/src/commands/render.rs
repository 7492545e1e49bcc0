//! `isophote render`: a map, its statistics and its files.

use std::path::PathBuf;

use anyhow::{Result, anyhow};
use isophote::analysis::probe::ProbePosition;
use isophote::map::{Map, Quantity, Region};
use isophote::message;
use isophote::prepare::PreparedScene;
use isophote::render::{RenderError, RenderSettings, Renderer, SimdRenderer};
use isophote::scene::Scene;
use isophote::text::Message;
use isophote::threads::Threads;
use isophote_export::FileMetadata;
use isophote_export::csv::Rows;
use isophote_export::figure::{FigureOptions, Mark, map_figure};
use isophote_export::png::{Depth, Normalization};

use super::output::{
    FigureFormat, MapFile, MapStyle, figure_format, formula_label, refuse_colormap, refuse_twice, write_figure,
};
use super::summary::Summary;
use crate::args::{DEFAULT_ISOPHOTES, RenderArguments};
use crate::channels::named;
use crate::failure::{self, Usage};
use crate::progress::Progress;
use crate::{load, numbers, threads};

/// Renders a scene into memory.
pub fn run(arguments: &RenderArguments) -> Result<String> {
    let threads = Threads::new(arguments.threads);
    let scene = PreparedScene::on_threads(&load::scene_to_render(arguments)?, &threads);
    let job = Job::new(arguments, scene.scene())?;
    let mut map = job.render(&scene)?;
    let summary = Summary::new(&map, &job.main, &scene);
    map.retain(|quantity| job.wanted.contains(quantity));
    let notes = job.write(&map, &scene)?;
    if !arguments.quiet {
        for note in &notes {
            failure::note(&note.in_language(arguments.language.lang));
        }
    }
    if arguments.json {
        numbers::json(&summary.to_json(&scene))
    } else {
        Ok(summary.to_text(&scene, arguments.language.lang))
    }
}

/// A render job with valid arguments.
struct Job<'a> {
    arguments: &'a RenderArguments,
    /// The channel that is summarised.
    main: Quantity,
    /// The channel that is pictured: the summarised one, or colours.
    pictured: Quantity,
    /// The channels written to files.
    wanted: Vec<Quantity>,
    files: Vec<MapFile>,
    figures: Vec<(PathBuf, FigureFormat)>,
    style: MapStyle,
}

impl<'a> Job<'a> {
    fn new(arguments: &'a RenderArguments, scene: &Scene) -> Result<Self> {
        let mut wanted = named(&arguments.channel, scene)?;
        let default = if scene.color().is_some() { Quantity::Color } else { Quantity::Brightness };
        let pictured = wanted.first().cloned().unwrap_or(default);
        let main = if pictured == Quantity::Color { Quantity::Brightness } else { pictured.clone() };
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
            wanted.extend([main.clone(), pictured.clone()]);
            if files.iter().any(MapFile::holds_many_channels) {
                // Without ambient light its channel is all zeros.
                let has_ambient = scene.ambient().is_some();
                wanted.extend(
                    Quantity::COMMON.into_iter().filter(|quantity| has_ambient || *quantity != Quantity::Ambient),
                );
            }
        } else if files.iter().any(MapFile::holds_many_channels) {
            // The shape index, which tells background from dark surfaces, goes into every file that has room for it.
            wanted.push(Quantity::Shape);
        }
        if arguments.lights {
            wanted.extend(scene.lights().iter().map(|light| Quantity::Light(light.name.clone())));
        }
        let depth = if arguments.bits == "16" { Depth::Sixteen } else { Depth::Eight };
        let style = MapStyle {
            quantity: pictured.clone(),
            range: arguments.range,
            normalization: arguments.normalize,
            gamma: arguments.gamma,
            depth,
            colormap: arguments.colormap,
            rows: if arguments.visible_only { Rows::Visible } else { Rows::All },
            threads: arguments.threads.unwrap_or_else(threads::all),
        };
        let job = Self { arguments, main, pictured, wanted, files, figures, style };
        job.refuse_impossible_pictures()?;
        Ok(job)
    }

    /// Runs before anything is computed.
    fn refuse_impossible_pictures(&self) -> Result<(), Usage> {
        let has_picture = self.files.iter().any(MapFile::is_picture);
        refuse_colormap(&self.pictured, self.style.colormap)?;
        if self.pictured == Quantity::Color && self.style.gamma != 1.0 {
            let message = message!(
                "--gamma does not go with the channel `color`, which is shown with sRGB's; put -c brightness first"
            );
            return Err(Usage(message));
        }
        if self.pictured == Quantity::Color && self.style.normalization != Normalization::Max {
            let message = message!(
                "--normalize does not go with the channel `color`, whose components share one scale from 0 to the largest; put -c brightness first"
            );
            return Err(Usage(message));
        }
        let logarithm_of = |black: f64| self.style.normalization == Normalization::Log && black <= 0.0;
        if let Some([black, _]) = self.style.range.filter(|[black, _]| logarithm_of(*black)) {
            let message = message!("--range starts at {black}; with --normalize log it has to start above 0", black);
            return Err(Usage(message));
        }
        let can_be_picture = self.pictured.can_be_picture();
        if !can_be_picture && (has_picture || !self.figures.is_empty()) {
            return Err(Usage(message!(
                "the channel `{channel}` cannot be a picture: it is not one quantity a pixel; put another --channel first",
                channel = self.pictured.name()
            )));
        }
        if has_picture && self.style.depth == Depth::Sixteen && self.style.colormap.is_some() {
            let message =
                message!("--bits 16 does not go with --colormap: colours have 8 bits, only grey pictures have 16");
            return Err(Usage(message));
        }
        Ok(())
    }

    fn render(&self, scene: &PreparedScene) -> Result<Map> {
        let arguments = self.arguments;
        // The irradiance shows which pixels are lit.
        let sampled = scene.scene().sampling().is_multisampled().then_some(Quantity::Samples);
        let quantities =
            self.wanted.iter().cloned().chain([Quantity::Irradiance, self.main.clone()]).chain(sampled).collect();
        let region = arguments.region.unwrap_or(Region::all(scene.scene().camera().resolution));
        let progress = Progress::new(region.size.count(), arguments.quiet, arguments.language.lang);
        let settings = RenderSettings { region: Some(region), quantities, observer: Some(&progress) };
        let map = SimdRenderer::new(arguments.precision, arguments.threads).render(scene, &settings);
        progress.finish();
        map.map_err(|error| match error {
            RenderError::Region { .. } => Usage(error.message()).into(),
            RenderError::Memory { .. } => anyhow!("{error}; -o NAME.zarr is computed part by part"),
            RenderError::TooLarge { .. } => {
                Usage(message!("{error}; -o NAME.zarr takes larger ones", error = error.message())).into()
            }
            error => error.into(),
        })
    }

    fn write(&self, map: &Map, scene: &PreparedScene) -> Result<Vec<Message>> {
        // If a figure cannot be drawn, find out before anything is written.
        let figure =
            (!self.figures.is_empty()).then(|| map_figure(map, &self.figure_options(map, scene))).transpose()?;
        let mut notes = self.options_without_effect();
        for file in &self.files {
            file.write(map, &self.style, &mut notes)?;
        }
        let metadata = map.channel(&self.pictured).map(|channel| FileMetadata::of_channel(map, channel));
        if let Some(figure) = &figure {
            for (path, format) in &self.figures {
                write_figure(figure, metadata.as_ref(), path, *format, &mut notes)?;
            }
        }
        Ok(notes)
    }

    fn options_without_effect(&self) -> Vec<Message> {
        let has_picture = self.files.iter().any(MapFile::is_picture);
        let arguments = self.arguments;
        let note = |is_given: bool, option: &str, file: Message| {
            is_given.then(|| message!("{option} has no effect: no {file} file is written", option, file))
        };
        let has_figure = !self.figures.is_empty();
        let has_either = has_picture || has_figure;
        let has_isophotes = has_figure && self.pictured != Quantity::Color;
        [
            note(!has_either && arguments.range.is_some(), "--range", message!(".png or figure")),
            note(!has_either && arguments.colormap.is_some(), "--colormap", message!(".png or figure")),
            note(
                !has_isophotes && arguments.isophotes != DEFAULT_ISOPHOTES,
                "--isophotes",
                message!("figure of numbers"),
            ),
            note(!has_picture && arguments.normalize != Normalization::Max, "--normalize", Message::verbatim(".png")),
            note(!has_picture && arguments.gamma != 1.0, "--gamma", Message::verbatim(".png")),
            note(!has_picture && self.style.depth == Depth::Sixteen, "--bits", Message::verbatim(".png")),
            note(
                arguments.visible_only && !self.files.iter().any(MapFile::is_table),
                "--visible-only",
                Message::verbatim(".csv"),
            ),
        ]
        .into_iter()
        .flatten()
        .collect()
    }

    fn figure_options(&self, map: &Map, scene: &PreparedScene) -> FigureOptions {
        let language = self.arguments.language.lang;
        let label = self.pictured.label_in(scene.scene().unit_system(), language);
        let label = match self.pictured {
            Quantity::Brightness => format!("{label}, {}", formula_label(map).in_language(language)),
            _ => label,
        };
        FigureOptions {
            title: scene.scene().title().to_owned(),
            colormap: self.arguments.colormap.unwrap_or_default(),
            range: self.arguments.range,
            isophotes: self.arguments.isophotes.into(),
            marks: marks(map, scene),
            ..FigureOptions::in_language(self.pictured.clone(), &label, language)
        }
    }
}

/// The probes that are visible from the eye, at their positions in the map.
fn marks(map: &Map, scene: &PreparedScene) -> Vec<Mark> {
    let window = map.window;
    let mark = |probe: &isophote::scene::Probe| {
        let [x, y] = scene.frame().project(probe.at)?.map(|coordinate| window.unit().from_internal(coordinate));
        let inside = (window.x[0]..=window.x[1]).contains(&x) && (window.y[0]..=window.y[1]).contains(&y);
        let seen = scene.probe(&ProbePosition::Point(probe.at)).ok()?.is_seen();
        (inside && seen).then(|| Mark { name: probe.name.clone(), x, y })
    };
    scene.scene().probes().iter().filter_map(mark).collect()
}
