//! `isophote section`: values along a line.

use std::fmt::Write as _;
use std::path::Path;

use anyhow::Result;
use isophote::analysis::section::{Sample, SectionLine};
use isophote::map::Quantity;
use isophote::prepare::PreparedScene;
use isophote::scene::Scene;
use isophote::text::significant;
use isophote::units::Keyword;
use isophote_export::atomic;
use isophote_export::figure::{Figure, SectionOptions, SectionPoint, Series, section_figure};
use serde::Serialize;

use super::output::{FigureFormat, figure_format, refuse_twice, write_bytes, write_figure};
use crate::args::SectionArguments;
use crate::channels::{named, unit};
use crate::failure::{self, Usage};
use crate::table::{Align, table};
use crate::{load, numbers};

/// Default number of points on a line.
const DEFAULT_SAMPLES: u32 = 513;

/// Computes a section and prints or writes it.
pub fn run(arguments: &SectionArguments) -> Result<String> {
    let scene = PreparedScene::new(&load::scene(&arguments.scene, arguments.quiet)?);
    let line = line(arguments, scene.scene());
    if arguments.samples.is_some() && arguments.line.line.is_none() {
        return Err(Usage("--samples goes with --line: a row or a column has a sample for each pixel".into()).into());
    }
    let quantities = quantities(arguments, scene.scene())?;
    refuse_twice(&arguments.output)?;
    let outputs: Vec<(&Path, Output)> = arguments.output.iter().map(|path| Output::new(path)).collect::<Result<_>>()?;
    let samples = scene.section(line).map_err(|error| Usage(error.to_string()))?;
    let section = Section { scene: scene.scene(), line, quantities, samples };
    if outputs.is_empty() {
        return if arguments.json { numbers::json(&section.to_json()) } else { Ok(section.to_table()) };
    }
    // Find out what cannot be drawn before anything is written.
    let has_figure = outputs.iter().any(|(_, output)| matches!(output, Output::Figure(_)));
    let figure = has_figure.then(|| section.figure()).transpose()?;
    crate::progress::end_in_order();
    let mut notes = Vec::new();
    for (path, output) in outputs {
        match output {
            Output::Csv => write_bytes(section.to_csv().as_bytes(), path, &mut notes)?,
            Output::Figure(format) => write_figure(figure.as_ref(), None, path, format, &mut notes)?,
        }
    }
    if !arguments.quiet {
        for note in &notes {
            failure::note(note);
        }
    }
    if arguments.json { numbers::json(&section.to_json()) } else { Ok(String::new()) }
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
                let message = format!("cannot tell the format of {}; allowed: .csv, .png, .svg", path.display());
                Err(Usage(message).into())
            }
            Err(error) => Err(error),
        }
    }
}

fn line(arguments: &SectionArguments, scene: &Scene) -> SectionLine {
    let chosen = &arguments.line;
    match (chosen.row, chosen.column, chosen.line) {
        (Some(row), ..) => SectionLine::Row(row),
        (_, Some(column), _) => SectionLine::Column(column),
        (_, _, line) => {
            let [x0, y0, x1, y1] = line.unwrap_or_default().map(|place| scene.screen_unit().to_internal(place));
            SectionLine::Between { from: [x0, y0], to: [x1, y1], samples: arguments.samples.unwrap_or(DEFAULT_SAMPLES) }
        }
    }
}

fn quantities(arguments: &SectionArguments, scene: &Scene) -> Result<Vec<Quantity>> {
    let quantities = named(&arguments.channel, scene)?;
    let unsuitable = |quantity: &&Quantity| {
        !quantity.is_scalar()
            || matches!(quantity, Quantity::Light(_))
            || Quantity::OF_SAMPLING.contains(quantity)
            || quantity.is_derived()
    };
    if let Some(quantity) = quantities.iter().find(unsuitable) {
        let allowed = "brightness, irradiance, ambient, diffuse, specular, depth";
        return Err(Usage(format!("a section cannot show `{}`; allowed: {allowed}", quantity.name())).into());
    }
    Ok(if quantities.is_empty() { vec![Quantity::Brightness] } else { quantities })
}

/// Samples, and how they are shown.
struct Section<'s> {
    scene: &'s Scene,
    line: SectionLine,
    quantities: Vec<Quantity>,
    samples: Vec<Sample>,
}

impl Section<'_> {
    fn value(&self, sample: &Sample, quantity: &Quantity) -> Option<f64> {
        let (hit, shading) = sample.seen.as_ref()?;
        Some(match quantity {
            Quantity::Irradiance => shading.irradiance,
            Quantity::Ambient => shading.ambient,
            Quantity::Diffuse => shading.diffuse,
            Quantity::Specular => shading.specular,
            Quantity::Depth => self.scene.length().from_metres(hit.distance),
            _ => shading.brightness(),
        })
    }

    fn screen(&self, sample: &Sample) -> [f64; 2] {
        sample.screen.map(|coordinate| self.scene.screen_unit().from_internal(coordinate))
    }

    /// The coordinate along the line: x in a row, y in a column, otherwise the distance from the first point.
    fn along(&self, sample: &Sample) -> f64 {
        let [x, y] = self.screen(sample);
        match self.line {
            SectionLine::Row(_) => x,
            SectionLine::Column(_) => y,
            SectionLine::Between { .. } => {
                let [x0, y0] = self.samples.first().map_or([x, y], |first| self.screen(first));
                (x - x0).hypot(y - y0)
            }
        }
    }

    fn heading(&self, quantity: &Quantity) -> String {
        format!("{}, {}", quantity.name(), unit(quantity, self.scene))
    }

    fn to_table(&self) -> String {
        let unit = self.scene.screen_unit().name();
        let headings: Vec<String> = self.quantities.iter().map(|quantity| self.heading(quantity)).collect();
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

    fn to_csv(&self) -> String {
        let mut text = String::new();
        // Writing to a string cannot fail.
        let _ = writeln!(text, "# {}", self.footer());
        let _ = writeln!(text, "# {}", self.scene.title().replace(char::is_control, " "));
        let _ = writeln!(text, "# units: x, y in {}", self.scene.screen_unit().name());
        for quantity in &self.quantities {
            let _ = writeln!(text, "# units: {} in {}", quantity.name(), unit(quantity, self.scene));
        }
        let names: Vec<String> = self.quantities.iter().map(Quantity::name).collect();
        let _ = writeln!(text, "x,y,{}", names.join(","));
        for sample in &self.samples {
            let [x, y] = self.screen(sample);
            let _ = write!(text, "{x},{y}");
            for quantity in &self.quantities {
                match self.value(sample, quantity) {
                    Some(value) => drop(write!(text, ",{}", significant(value, 17))),
                    None => text.push(','),
                }
            }
            text.push('\n');
        }
        text
    }

    fn figure(&self) -> Result<Figure> {
        let series = |quantity: &Quantity| Series {
            name: quantity.name(),
            points: self
                .samples
                .iter()
                .map(|sample| SectionPoint { x: self.along(sample), value: self.value(sample, quantity) })
                .collect(),
        };
        let series: Vec<Series> = self.quantities.iter().map(series).collect();
        let y_unit = unit(&self.quantities[0], self.scene);
        if self.quantities.iter().any(|quantity| unit(quantity, self.scene) != y_unit) {
            let channels: Vec<String> = self.quantities.iter().map(|quantity| self.heading(quantity)).collect();
            return Err(Usage(format!("one plot cannot show different units: {}", channels.join("; "))).into());
        }
        let (x_label, title) = match self.line {
            SectionLine::Row(row) => ("x", format!("row {row}")),
            SectionLine::Column(column) => ("y", format!("column {column}")),
            SectionLine::Between { .. } => ("distance along the line", "a line".into()),
        };
        let [only] = self.quantities.as_slice() else {
            return self.draw(&series, x_label, &title, "values", &y_unit);
        };
        self.draw(&series, x_label, &title, &only.name(), &y_unit)
    }

    fn draw(&self, series: &[Series], x_label: &str, line: &str, y_label: &str, y_unit: &str) -> Result<Figure> {
        let title = self.scene.title();
        let options = SectionOptions {
            title: if title.is_empty() {
                format!("Section along {line}")
            } else {
                format!("{title}: section along {line}")
            },
            x_label: x_label.into(),
            x_unit: self.scene.screen_unit().name().into(),
            y_label: y_label.into(),
            y_unit: y_unit.into(),
            footer: self.footer(),
        };
        Ok(section_figure(series, &options)?)
    }

    fn footer(&self) -> String {
        format!(concat!("isophote ", env!("CARGO_PKG_VERSION"), ", convention {}"), self.scene.convention().label())
    }

    fn to_json(&self) -> SectionJson {
        let channels = self.quantities.iter().map(|quantity| ChannelJson {
            name: quantity.name(),
            unit: unit(quantity, self.scene),
            values: self.samples.iter().map(|sample| self.value(sample, quantity)).collect(),
        });
        SectionJson {
            length: self.scene.length().name(),
            screen_unit: self.scene.screen_unit().name(),
            convention: self.scene.convention().name(),
            screen: self.samples.iter().map(|sample| self.screen(sample)).collect(),
            channels: channels.collect(),
        }
    }
}

#[derive(Serialize)]
struct SectionJson {
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
