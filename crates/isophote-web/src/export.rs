//! Files: the same bytes as those of the command.

use std::fmt::Write as _;

use isophote::map::{Map, Quantity};
use isophote::message;
use isophote::prepare::PreparedScene;
use isophote::scene::Scene;
use isophote::text::{Language, significant};
use isophote::units::Keyword;
use isophote_export::csv::{self, Rows};
use isophote_export::figure::{
    Figure, FigureOptions, Mark, SectionOptions, SectionPoint, Series, map_figure, section_figure,
};
use isophote_export::png::{self, PictureColor, PictureOptions};

use crate::frame::render;
use crate::info::on_screen;
use crate::problem::Refusal;
use crate::request::{ExportRequest, PictureStyle, ProbeRequest, SectionRequest, channel};
use crate::section::Section;

/// px of a PNG figure for each px of the page.
const FIGURE_SCALE: f64 = 2.0;

/// The bytes of a file.
pub fn export(prepared: &PreparedScene, request: &ExportRequest, language: Language) -> Result<Vec<u8>, Refusal> {
    match request {
        ExportRequest::Png { channel, style } => picture(prepared, channel, style),
        ExportRequest::FigureSvg { channel, style, marks } => {
            Ok(figure(prepared, channel, style, *marks, language)?.to_svg()?.into_bytes())
        }
        ExportRequest::FigurePng { channel, style, marks } => {
            Ok(figure(prepared, channel, style, *marks, language)?.to_png(FIGURE_SCALE, None)?)
        }
        ExportRequest::MapCsv { channels } => table(prepared, channels),
        ExportRequest::SectionCsv { sections, channels } => section_table(prepared, sections, channels),
        ExportRequest::SectionSvg { sections, channels } => {
            Ok(section_plot(prepared, sections, channels, language)?.to_svg()?.into_bytes())
        }
        ExportRequest::SectionPng { sections, channels } => {
            Ok(section_plot(prepared, sections, channels, language)?.to_png(FIGURE_SCALE, None)?)
        }
        ExportRequest::ProbesCsv { probes } => probe_table(prepared, probes),
    }
}

/// The channel of a picture: one number a pixel, or the colours of a scene that has them.
fn picture_channel(name: &str, scene: &Scene) -> Result<Quantity, Refusal> {
    if name == Quantity::Color.name() && scene.color().is_some() { Ok(Quantity::Color) } else { channel(name, scene) }
}

fn picture(prepared: &PreparedScene, name: &str, style: &PictureStyle) -> Result<Vec<u8>, Refusal> {
    let quantity = picture_channel(name, prepared.scene())?;
    let map = render(prepared, vec![quantity.clone()], None)?;
    let colormap = style.colormap()?;
    let color = |fraction: f64| colormap.color(fraction);
    let is_gray = colormap.name() == "gray";
    let options = PictureOptions {
        range: style.range,
        normalization: style.normalization()?,
        color: (!is_gray).then_some(PictureColor { name: colormap.name(), color: &color }),
        ..PictureOptions::new(quantity)
    };
    let mut bytes = Vec::new();
    png::write(&map, &options, &mut bytes)?;
    Ok(bytes)
}

fn figure(
    prepared: &PreparedScene,
    name: &str,
    style: &PictureStyle,
    marks: bool,
    language: Language,
) -> Result<Figure, Refusal> {
    let scene = prepared.scene();
    let quantity = picture_channel(name, scene)?;
    let map = render(prepared, vec![quantity.clone()], None)?;
    let name = quantity.label_in(scene.unit_system(), language);
    let label = match quantity {
        Quantity::Brightness => format!("{name}, {}", map.provenance.convention),
        _ => name,
    };
    let options = FigureOptions {
        title: scene.title().to_owned(),
        colormap: style.colormap()?,
        range: style.range,
        isophotes: style.isophotes,
        marks: if marks { probe_marks(&map, prepared) } else { Vec::new() },
        ..FigureOptions::in_language(quantity, &label, language)
    };
    Ok(map_figure(&map, &options)?)
}

/// The probes that are visible from the eye.
fn probe_marks(map: &Map, prepared: &PreparedScene) -> Vec<Mark> {
    use isophote::analysis::probe::ProbePosition;
    let mark = |probe: &isophote::scene::Probe| {
        let [x, y] = on_screen(prepared, probe.at)?;
        let inside =
            (map.window.x[0]..=map.window.x[1]).contains(&x) && (map.window.y[0]..=map.window.y[1]).contains(&y);
        let seen = prepared.probe(&ProbePosition::Point(probe.at)).ok()?.is_seen();
        (inside && seen).then(|| Mark { name: probe.name.clone(), x, y })
    };
    prepared.scene().probes().iter().filter_map(mark).collect()
}

fn table(prepared: &PreparedScene, names: &[String]) -> Result<Vec<u8>, Refusal> {
    let quantities = names.iter().map(|name| channel(name, prepared.scene())).collect::<Result<Vec<_>, _>>()?;
    let mut map = render(prepared, quantities, None)?;
    map.add_shapes();
    let mut bytes = Vec::new();
    csv::write(&map, Rows::All, &mut bytes)?;
    Ok(bytes)
}

fn sections(
    prepared: &PreparedScene,
    requests: &[SectionRequest],
    names: &[String],
    language: Language,
) -> Result<(Vec<Section>, Vec<Quantity>), Refusal> {
    let channels = names.iter().map(|name| channel(name, prepared.scene())).collect::<Result<Vec<_>, _>>()?;
    Ok((Section::all(requests, &channels, prepared, language)?, channels))
}

fn section_table(prepared: &PreparedScene, requests: &[SectionRequest], names: &[String]) -> Result<Vec<u8>, Refusal> {
    let (sections, channels) = sections(prepared, requests, names, Language::English)?;
    let scene = prepared.scene();
    let mut text = format!("# {}\n# units: x, y in {}\n", footer(prepared), scene.screen_unit().name());
    for quantity in &channels {
        let unit = quantity.unit(scene.convention(), scene.unit_system(), scene.length());
        // Writing to a string cannot fail.
        let _ = writeln!(text, "# units: {} in {unit}", quantity.name());
    }
    let _ = writeln!(text, "section,x,y,{}", names.join(","));
    for section in &sections {
        for (index, [x, y]) in section.screen.iter().enumerate() {
            let _ = write!(text, "{},{x},{y}", quoted(&section.name));
            for quantity in &channels {
                match section.values[&quantity.name()][index] {
                    Some(value) => drop(write!(text, ",{}", significant(value, 17))),
                    None => text.push(','),
                }
            }
            text.push('\n');
        }
    }
    Ok(text.into_bytes())
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\"").replace(char::is_control, " "))
}

fn section_plot(
    prepared: &PreparedScene,
    requests: &[SectionRequest],
    names: &[String],
    language: Language,
) -> Result<Figure, Refusal> {
    let (sections, channels) = sections(prepared, requests, names, language)?;
    let scene = prepared.scene();
    let units: Vec<&str> = channels
        .iter()
        .map(|quantity| quantity.unit(scene.convention(), scene.unit_system(), scene.length()))
        .collect();
    if units.windows(2).any(|pair| pair[0] != pair[1]) {
        return Err(Refusal(message!("one plot cannot show different units: {units}", units = units.join(", "))));
    }
    let series = |section: &Section| -> Vec<Series> {
        let of_channel = |quantity: &Quantity| {
            let points = section.positions.iter().zip(&section.values[&quantity.name()]);
            let points = points.map(|(x, value)| SectionPoint { x: *x, value: *value }).collect();
            let name = match channels.len() {
                1 => section.name.clone(),
                _ => format!("{}, {}", quantity.label_in(scene.unit_system(), language), section.name),
            };
            Series { name, points }
        };
        channels.iter().map(of_channel).collect()
    };
    let all: Vec<Series> = sections.iter().flat_map(series).collect();
    let mut axes: Vec<&str> = sections.iter().map(|section| section.axis).collect();
    axes.dedup();
    let axes: Vec<String> = axes
        .into_iter()
        .map(|axis| match axis {
            "distance" => message!("distance").in_language(language),
            axis => axis.to_owned(),
        })
        .collect();
    let options = SectionOptions {
        title: scene.title().to_owned(),
        x_label: axes.join(", "),
        x_unit: scene.screen_unit().name().into(),
        y_label: if let [only] = channels.as_slice() {
            only.label_in(scene.unit_system(), language)
        } else {
            String::new()
        },
        y_unit: units.first().copied().unwrap_or_default().into(),
        footer: message!(
            "{program}, convention {convention}",
            program = PROGRAM,
            convention = scene.convention().label()
        )
        .in_language(language),
    };
    Ok(section_figure(&all, &options)?)
}

const PROGRAM: &str = concat!("isophote ", env!("CARGO_PKG_VERSION"));

/// What a table says of its origin, which is the same in every language.
fn footer(prepared: &PreparedScene) -> String {
    format!("{PROGRAM}, convention {}", prepared.scene().convention().label())
}

/// Values at points; where there is none, its columns are empty.
fn probe_table(prepared: &PreparedScene, requests: &[ProbeRequest]) -> Result<Vec<u8>, Refusal> {
    let scene = prepared.scene();
    let length = scene.length();
    let (unit, irradiance) = (scene.convention().unit(scene.unit_system()), scene.unit_system().irradiance_unit());
    let mut text = format!(
        "# {}\n# units: x, y, z in {}; brightness, diffuse, specular in {unit}; irradiance in {irradiance}\n",
        footer(prepared),
        length.name()
    );
    text.push_str("name,x,y,z,brightness,irradiance,diffuse,specular,cos_theta_o,seen\n");
    for request in requests {
        text.push_str(&quoted(&request.name));
        match prepared.probe(&request.position(scene)?) {
            Ok(reading) => {
                let [x, y, z] = reading.position(length);
                let shading = &reading.shading;
                let numbers = [
                    x,
                    y,
                    z,
                    shading.brightness(),
                    shading.irradiance,
                    shading.diffuse,
                    shading.specular,
                    reading.hit.point.cos_theta_o,
                ];
                for number in numbers {
                    // Writing to a string cannot fail.
                    let _ = write!(text, ",{number}");
                }
                let _ = writeln!(text, ",{}", reading.is_seen());
            }
            Err(_) => text.push_str(",,,,,,,,,\n"),
        }
    }
    Ok(text.into_bytes())
}
