//! `isophote section`: values along lines.

use std::fmt::Write as _;
use std::path::Path;

use anyhow::Result;
use isophote::analysis::section::{self, Axis, Sample};
use isophote::map::Quantity;
use isophote::message;
use isophote::prepare::PreparedScene;
use isophote::scene::Scene;
use isophote::text::{Language, Message, significant};
use isophote::units::Keyword;
use isophote_export::atomic;
use isophote_export::figure::{Figure, SectionOptions, SectionPoint, Series, section_figure};
use serde::Serialize;

use super::output::{FigureFormat, figure_format, refuse_twice, write_bytes, write_figure};
use super::section_lines::{self, Line};
use crate::args::SectionArguments;
use crate::channels::{named, unit};
use crate::failure::{self, Usage};
use crate::table::{Align, table};
use crate::{load, numbers};

/// Computes sections and prints or writes them.
pub fn run(arguments: &SectionArguments) -> Result<String> {
    let language = arguments.language.lang;
    let scene = PreparedScene::new(&load::scene(&arguments.scene, arguments.quiet, language)?);
    let lines = section_lines::lines(arguments, &scene)?;
    let quantities = quantities(arguments, scene.scene())?;
    refuse_twice(&arguments.output)?;
    let outputs: Vec<(&Path, Output)> = arguments.output.iter().map(|path| Output::new(path)).collect::<Result<_>>()?;
    let mut notes: Vec<Message> = lines.iter().filter_map(|line| line.note.clone()).collect();
    let section = |line: Line| -> Result<Section<'_>> {
        let samples = scene.section(line.along).map_err(|error| Usage(error.message()))?;
        Ok(Section { scene: scene.scene(), line, quantities: &quantities, samples })
    };
    let all = lines.into_iter().map(section).collect::<Result<_>>()?;
    let sections = Sections { scene: scene.scene(), language, all };
    let printed = || if arguments.json { sections.to_json() } else { Ok(sections.to_table()) };
    if outputs.is_empty() {
        told(&notes, arguments);
        return printed();
    }
    // Find out what cannot be drawn before anything is written.
    let has_figure = outputs.iter().any(|(_, output)| matches!(output, Output::Figure(_)));
    let figure = has_figure.then(|| sections.figure()).transpose()?;
    crate::progress::end_in_order();
    for (path, output) in outputs {
        match output {
            Output::Csv => write_bytes(sections.to_csv().as_bytes(), path, &mut notes)?,
            Output::Figure(format) => {
                figure.iter().try_for_each(|figure| write_figure(figure, None, path, format, &mut notes))?;
            }
        }
    }
    told(&notes, arguments);
    if arguments.json { sections.to_json() } else { Ok(String::new()) }
}

fn told(notes: &[Message], arguments: &SectionArguments) {
    for note in notes.iter().filter(|_| !arguments.quiet) {
        failure::note(&note.in_language(arguments.language.lang));
    }
}

enum Output {
    Csv,
    Figure(FigureFormat),
}

impl Output {
    fn new(path: &Path) -> Result<(&Path, Self)> {
        let is_csv = path.extension().is_some_and(|suffix| suffix.eq_ignore_ascii_case("csv"));
        if is_csv {
            atomic::check_target(path)?;
            return Ok((path, Self::Csv));
        }
        match figure_format(path) {
            Ok(format) => Ok((path, Self::Figure(format))),
            Err(error) if error.is::<Usage>() => {
                let (path, allowed) = (path.display(), ".csv, .png, .svg");
                let message = message!("cannot tell the format of {path}; allowed: {allowed}", path, allowed);
                Err(Usage(message).into())
            }
            Err(error) => Err(error),
        }
    }
}

fn quantities(arguments: &SectionArguments, scene: &Scene) -> Result<Vec<Quantity>> {
    let quantities = named(&arguments.channel, scene)?;
    quantities.iter().try_for_each(section::refuse).map_err(Usage)?;
    Ok(if quantities.is_empty() { vec![Quantity::Brightness] } else { quantities })
}

/// The samples of a line.
struct Section<'s> {
    scene: &'s Scene,
    line: Line,
    quantities: &'s [Quantity],
    samples: Vec<Sample>,
}

/// All lines, and how they are shown together.
struct Sections<'s> {
    scene: &'s Scene,
    language: Language,
    /// At least one; all of the same quantities.
    all: Vec<Section<'s>>,
}

impl Section<'_> {
    fn value(&self, sample: &Sample, quantity: &Quantity) -> Option<f64> {
        sample.value(quantity, self.scene.length())
    }

    fn screen(&self, sample: &Sample) -> [f64; 2] {
        sample.screen.map(|coordinate| self.scene.screen_unit().from_internal(coordinate))
    }

    /// The coordinate along the line.
    fn along(&self, sample: &Sample) -> f64 {
        let place = self.screen(sample);
        self.line.axis.position(place, self.samples.first().map_or(place, |first| self.screen(first)))
    }

    fn to_table(&self, language: Language) -> String {
        let unit = self.scene.screen_unit().name();
        let headings = self.quantities.iter().map(|quantity| heading(quantity, self.scene, language));
        let headings: Vec<String> = headings.collect();
        let (x, y) = (format!("x, {unit}"), format!("y, {unit}"));
        let mut columns = vec![(x.as_str(), Align::Right), (y.as_str(), Align::Right)];
        columns.extend(headings.iter().map(|heading| (heading.as_str(), Align::Right)));
        let row = |sample: &Sample| {
            let mut row: Vec<String> = self.screen(sample).map(|coordinate| significant(coordinate, 9)).into();
            row.extend(
                self.quantities
                    .iter()
                    .map(|quantity| self.value(sample, quantity).map_or("–".into(), |value| significant(value, 12))),
            );
            row
        };
        table(&columns, &self.samples.iter().map(row).collect::<Vec<_>>())
    }

    /// The rows of a CSV file, each after the given beginning.
    fn write_rows(&self, beginning: &str, text: &mut String) {
        for sample in &self.samples {
            let [x, y] = self.screen(sample);
            // Writing to a string cannot fail.
            let _ = write!(text, "{beginning}{x},{y}");
            for quantity in self.quantities {
                match self.value(sample, quantity) {
                    Some(value) => drop(write!(text, ",{}", significant(value, 17))),
                    None => text.push(','),
                }
            }
            text.push('\n');
        }
    }

    fn series(&self, quantity: &Quantity, name: String) -> Series {
        let point = |sample: &Sample| SectionPoint { x: self.along(sample), value: self.value(sample, quantity) };
        Series { name, points: self.samples.iter().map(point).collect() }
    }

    fn to_json(&self) -> SectionJson {
        let channels = self.quantities.iter().map(|quantity| ChannelJson {
            name: quantity.name(),
            unit: unit(quantity, self.scene),
            values: self.samples.iter().map(|sample| self.value(sample, quantity)).collect(),
        });
        SectionJson {
            line: self.line.name.to_string(),
            length: self.scene.length().name(),
            screen_unit: self.scene.screen_unit().name(),
            convention: self.scene.convention().name(),
            screen: self.samples.iter().map(|sample| self.screen(sample)).collect(),
            channels: channels.collect(),
        }
    }
}

impl Sections<'_> {
    fn quantities(&self) -> &[Quantity] {
        self.all.first().map_or(&[], |section| section.quantities)
    }

    /// The only line, if there is but one.
    fn only(&self) -> Option<&Section<'_>> {
        if let [only] = self.all.as_slice() { Some(only) } else { None }
    }

    fn to_table(&self) -> String {
        if let Some(only) = self.only() {
            return only.to_table(self.language);
        }
        let of_section = |section: &Section<'_>| {
            let name = section.line.name.in_language(self.language);
            format!("{name}\n{}", section.to_table(self.language))
        };
        let tables = self.all.iter().map(of_section);
        tables.collect::<Vec<_>>().join("\n")
    }

    fn to_json(&self) -> Result<String> {
        match self.only() {
            Some(only) => numbers::json(&only.to_json()),
            None => numbers::json(&SectionsJson { sections: self.all.iter().map(Section::to_json).collect() }),
        }
    }

    fn to_csv(&self) -> String {
        let mut text = String::new();
        // Writing to a string cannot fail.
        let _ = writeln!(text, "# {}", self.footer());
        let _ = writeln!(text, "# {}", self.scene.title().replace(char::is_control, " "));
        if let Some(only) = self.only() {
            let _ = writeln!(text, "# section along {}", only.line.name.to_string().replace(char::is_control, " "));
        }
        let _ = writeln!(text, "# units: x, y in {}", self.scene.screen_unit().name());
        for quantity in self.quantities() {
            let _ = writeln!(text, "# units: {} in {}", quantity.name(), unit(quantity, self.scene));
        }
        let names: Vec<String> = self.quantities().iter().map(Quantity::name).collect();
        let column = if self.only().is_some() { "" } else { "section," };
        let _ = writeln!(text, "{column}x,y,{}", names.join(","));
        for section in &self.all {
            let name = section.line.name.to_string();
            let quoted = format!("\"{}\",", name.replace('"', "\"\"").replace(char::is_control, " "));
            section.write_rows(if self.only().is_some() { "" } else { &quoted }, &mut text);
        }
        text
    }

    /// Every line and quantity in one plot.
    fn figure(&self) -> Result<Figure> {
        let quantities = self.quantities();
        let y_unit = unit(&quantities[0], self.scene);
        if quantities.iter().any(|quantity| unit(quantity, self.scene) != y_unit) {
            let channels = quantities.iter().map(|quantity| heading(quantity, self.scene, self.language));
            let channels = channels.collect::<Vec<_>>().join("; ");
            return Err(Usage(message!("one plot cannot show different units: {channels}", channels)).into());
        }
        let name = |section: &Section<'_>, quantity: &Quantity| match (self.only(), quantities) {
            (Some(_), _) => label(quantity, self.scene, self.language),
            (None, [_]) => section.line.name.in_language(self.language),
            (None, _) => {
                let line = section.line.name.in_language(self.language);
                format!("{}, {line}", label(quantity, self.scene, self.language))
            }
        };
        let of_section = |section: &Section<'_>| -> Vec<Series> {
            quantities.iter().map(|quantity| section.series(quantity, name(section, quantity))).collect()
        };
        let series: Vec<Series> = self.all.iter().flat_map(of_section).collect();
        let lines = self.only().map_or_else(|| message!("several lines"), |only| only.line.name.clone());
        let title = self.scene.title();
        let options = SectionOptions {
            title: if title.is_empty() {
                message!("Section along {lines}", lines).in_language(self.language)
            } else {
                format!("{title}: {}", message!("section along {lines}", lines).in_language(self.language))
            },
            x_label: self.x_label().in_language(self.language),
            x_unit: self.scene.screen_unit().name().into(),
            y_label: match quantities {
                [only] => label(only, self.scene, self.language),
                _ => message!("values").in_language(self.language),
            },
            y_unit,
            footer: message!(
                "{program}, convention {convention}",
                program = PROGRAM,
                convention = self.scene.convention().label()
            )
            .in_language(self.language),
        };
        Ok(section_figure(&series, &options)?)
    }

    /// What the horizontal axis of a plot shows.
    fn x_label(&self) -> Message {
        let has = |axis: Axis| self.all.iter().any(|section| section.line.axis == axis);
        match (has(Axis::X), has(Axis::Y), has(Axis::Distance)) {
            (true, false, false) => Message::verbatim("x"),
            (false, true, false) => Message::verbatim("y"),
            (true, true, false) => message!("x or y"),
            (false, false, _) => message!("distance along the line"),
            (_, _, true) => message!("x, y or distance along the line"),
        }
    }

    fn footer(&self) -> String {
        format!("{PROGRAM}, convention {}", self.scene.convention().label())
    }
}

const PROGRAM: &str = concat!("isophote ", env!("CARGO_PKG_VERSION"));

fn label(quantity: &Quantity, scene: &Scene, language: Language) -> String {
    quantity.label_in(scene.unit_system(), language)
}

fn heading(quantity: &Quantity, scene: &Scene, language: Language) -> String {
    format!("{}, {}", label(quantity, scene, language), unit(quantity, scene))
}

#[derive(Serialize)]
struct SectionsJson {
    sections: Vec<SectionJson>,
}

#[derive(Serialize)]
struct SectionJson {
    line: String,
    length: &'static str,
    screen_unit: &'static str,
    convention: &'static str,
    screen: Vec<[f64; 2]>,
    channels: Vec<ChannelJson>,
}

#[derive(Serialize)]
struct ChannelJson {
    name: String,
    unit: String,
    values: Vec<Option<f64>>,
}
