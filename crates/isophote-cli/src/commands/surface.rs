//! `isophote surface`: the map of a channel over a shape's own surface.

use std::fmt::Write as _;

use anyhow::Result;
use isophote::analysis::probe::ProbePosition;
use isophote::analysis::surface::{CellExtreme, Surface, SurfaceRequest, SurfaceTotals, depends_on_eye};
use isophote::map::{Coordinates, Map, Quantity};
use isophote::message;
use isophote::prepare::PreparedScene;
use isophote::scene::Scene;
use isophote::shape::Primitive;
use isophote::text::{Language, Message, escaped_line, significant};
use isophote::units::Keyword;
use isophote::vector::Vector;
use isophote_export::figure::FigureOptions;
use serde::Serialize;

use super::cells::{CellFiles, place_text};
use super::there_are;
use crate::args::SurfaceArguments;
use crate::channels::{named, unit};
use crate::failure::Usage;
use crate::{load, numbers};

/// Computes the map of a surface, writes it and prints its statistics.
pub fn run(arguments: &SurfaceArguments) -> Result<String> {
    let language = arguments.language.lang;
    let scene = PreparedScene::new(&load::scene(&arguments.scene, arguments.quiet, language)?);
    let files = CellFiles::new(&arguments.output, &arguments.figure, &arguments.style)?;
    let mut wanted = named(&arguments.channel, scene.scene())?;
    let main = wanted.first().cloned().unwrap_or(Quantity::Irradiance);
    if wanted.is_empty() {
        wanted.extend([Quantity::Irradiance, Quantity::Position, Quantity::Normal]);
    }
    files.refuse_impossible_pictures(&main)?;
    wanted.push(Quantity::Shape);
    let request = request(arguments, scene.scene())?;
    let surface = scene.surface(&request).map_err(|error| Usage(error.message()))?;
    let map = surface.map(&wanted).map_err(|error| Usage(error.message()))?;
    let options = FigureOptions {
        proportions: Some(surface.proportions()),
        no_surface: message!("turned away").in_language(language),
        ..FigureOptions::in_language(main.clone(), &main.label_in(scene.scene().unit_system(), language), language)
    };
    files.write(&map, options, scene.scene(), arguments.quiet)?;
    let summary = Summary {
        prepared: &scene,
        scene: scene.scene(),
        totals: surface.totals(&map, &main),
        surface,
        request,
        main,
        map,
    };
    if arguments.json { numbers::json(&summary.to_json()) } else { Ok(summary.to_text(language)) }
}

fn request(arguments: &SurfaceArguments, scene: &Scene) -> Result<SurfaceRequest> {
    let shape = shape(arguments.shape.as_deref(), scene)?;
    let parts = scene.shapes()[shape].geometry.parts();
    if parts > 1 && arguments.part.is_none() {
        let name = &scene.shapes()[shape].name;
        let message = message!("\"{name}\" has {parts} parts; say which with --part, from 0", name, parts);
        return Err(Usage(message).into());
    }
    let primitive = Primitive { shape, part: arguments.part.unwrap_or(0) };
    let axis = match (&arguments.axis, &arguments.towards) {
        (Some(axis), _) => Some(Vector::from(*axis)),
        (None, Some(light)) => Some(towards(light, primitive, scene)?),
        (None, None) => None,
    };
    let (projection, side) = (arguments.projection, arguments.side);
    Ok(SurfaceRequest { primitive, projection, axis, side, size: arguments.size })
}

fn shape(name: Option<&str>, scene: &Scene) -> Result<usize> {
    let names: Vec<&str> = scene.shapes().iter().map(|shape| shape.name.as_str()).collect();
    let index = match (name, names.as_slice()) {
        (None, [_]) => Some(0),
        (None, _) => None,
        (Some(name), _) => names.iter().position(|known| *known == name),
    };
    index.ok_or_else(|| {
        let shown: Vec<&str> = names.iter().copied().take(20).collect();
        let there_are = there_are(&shown);
        Usage(message!("say which surface with --shape and the name of a shape; {there_are}", there_are)).into()
    })
}

/// The direction from the centre of a sphere to a light.
fn towards(name: &str, primitive: Primitive, scene: &Scene) -> Result<Vector> {
    let light = scene.lights().iter().find(|light| light.name == name).ok_or_else(|| {
        let names: Vec<&str> = scene.lights().iter().take(20).map(|light| light.name.as_str()).collect();
        let names = names.join(", ");
        Usage(message!("--towards: there is no light \"{name}\"; there are: {names}", name, names))
    })?;
    let bounds = scene.shapes()[primitive.shape].geometry.bounds(primitive.part).unwrap_or_default();
    let middle = (bounds.least + bounds.greatest) * 0.5;
    let direction = light.seen_from(middle);
    let is_somewhere = direction.length() > 0.0;
    let nowhere = || Usage(message!("--towards: the light \"{name}\" stands in the middle of the shape", name)).into();
    is_somewhere.then_some(direction).ok_or_else(nowhere)
}

struct Summary<'s> {
    prepared: &'s PreparedScene,
    scene: &'s Scene,
    surface: Surface<'s>,
    request: SurfaceRequest,
    main: Quantity,
    map: Map,
    totals: Option<SurfaceTotals>,
}

impl Summary<'_> {
    fn to_text(&self, language: Language) -> String {
        let mut text = String::new();
        if !self.scene.title().is_empty() {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{}\n", escaped_line(self.scene.title()));
        }
        let mut row = |name: Message, value: Message| {
            let (name, value) = (name.in_language(language), value.in_language(language));
            let _ = writeln!(text, "  {name:<12}{value}");
        };
        let area = significant(self.surface.area(), 12);
        let (name, kind, side) = (self.name(), self.kind_text(), self.request.side.name());
        let value = message!("{name} ({kind}), {side}, {area} m²", name, kind, side, area);
        let value = match self.surface.left_out() {
            Some(_) => message!("{value}, without its two ends", value),
            None => value,
        };
        row(message!("surface"), value);
        row(message!("cells"), self.cells_text(language));
        let unit = unit(&self.main, self.scene);
        let channel = self.main.label_in(self.scene.unit_system(), language);
        let separator = if unit.is_empty() { "" } else { ", " };
        row(message!("channel"), Message::verbatim(format!("{channel}{separator}{unit}")));
        if depends_on_eye(&self.main) {
            let convention = self.scene.convention();
            row(message!("convention"), Message::verbatim(format!("{}: {}", convention.label(), convention.formula())));
        }
        let Some(totals) = &self.totals else {
            let is_scalar = self.map.scalar(&self.main).is_some();
            let reason = if is_scalar {
                message!("no extremes: the eye sees nothing of this side")
            } else {
                message!("no extremes: this channel is no quantity")
            };
            row(Message::empty(), reason);
            return text;
        };
        if depends_on_eye(&self.main) {
            row(
                message!("turned to"),
                message!("the eye: {area} m², and over them", area = significant(totals.area, 12)),
            );
        } else {
            let power = self.scene.unit_system().power_unit();
            row(message!("flux"), Message::verbatim(format!("{} {power} = ∫ E dA", significant(totals.integral, 12))));
        }
        row(message!("mean"), Message::verbatim(format!("{} {unit}", significant(totals.mean(), 12))));
        row(message!("maximum"), self.extreme_text(&totals.max, &unit, language));
        row(message!("minimum"), self.extreme_text(&totals.min, &unit, language));
        text
    }

    fn name(&self) -> String {
        self.scene.name_of(self.request.primitive)
    }

    fn kind(&self) -> &'static str {
        match self.scene.shapes()[self.request.primitive.shape].geometry.kind() {
            "spheres" => "a sphere of several",
            kind => kind,
        }
    }

    fn kind_text(&self) -> Message {
        match self.scene.shapes()[self.request.primitive.shape].geometry.kind() {
            "spheres" => message!("a sphere of several"),
            "sphere" => message!("sphere"),
            "cylinder" => message!("cylinder"),
            "rectangle" => message!("rectangle"),
            "disk" => message!("disk"),
            kind => Message::verbatim(kind),
        }
    }

    fn cells_text(&self, language: Language) -> Message {
        let size = self.surface.size();
        let [x, y] = self.map.window.coordinates.axes(self.scene.length());
        let [x, y] = [x, y].map(|axis| axis.label(language));
        let cells = Message::verbatim(format!("{} × {}, {x} × {y}", size.width, size.height));
        let Some(axis) = self.surface.axis() else { return cells };
        let [x, y, z] = axis.to_array().map(|component| significant(component, 6));
        message!("{cells}; 90° latitude towards {axis}", cells, axis = format!("({x}, {y}, {z})"))
    }

    fn extreme_text(&self, extreme: &CellExtreme, unit: &str, language: Language) -> Message {
        let axes = self.map.window.coordinates.axes(self.scene.length());
        let place = place_text(axes, self.surface.coordinates(extreme.cell), language);
        let [x, y, z] = self.point(extreme).map(|coordinate| significant(coordinate, 6));
        let length = self.scene.length().name();
        let value = message!(
            "{value} {unit} at {place}, point {point} {length}",
            value = significant(extreme.value, 12),
            unit,
            place,
            point = format!("({x}, {y}, {z})"),
            length
        );
        match self.why_unseen(extreme) {
            Some(why) => message!("{value}, which the eye does not see: {why}", value, why),
            None => value,
        }
    }

    /// Why the eye does not see an extreme of a channel that depends on it.
    fn why_unseen(&self, extreme: &CellExtreme) -> Option<Message> {
        if !depends_on_eye(&self.main) {
            return None;
        }
        let place = ProbePosition::NearestTo(self.surface.point(extreme.cell));
        self.prepared.probe(&place).ok()?.why_unseen(self.scene)
    }

    /// In the scene's unit.
    fn point(&self, extreme: &CellExtreme) -> [f64; 3] {
        self.surface.point(extreme.cell).to_array().map(|metres| self.scene.length().from_metres(metres))
    }

    fn to_json(&self) -> SurfaceJson {
        let size = self.surface.size();
        let coordinates = self.map.window.coordinates;
        let axes = coordinates.axes(self.scene.length());
        let extreme = |extreme: &CellExtreme| ExtremeJson {
            value: extreme.value,
            cell: [extreme.cell.column, extreme.cell.row],
            coordinates: self.surface.coordinates(extreme.cell),
            point: self.point(extreme),
            unseen_because: self.why_unseen(extreme).map(|why| why.to_string()),
        };
        let totals = self.totals.as_ref();
        let flux = totals.filter(|_| !depends_on_eye(&self.main)).map(|totals| totals.integral);
        SurfaceJson {
            title: self.scene.title().into(),
            shape: self.name(),
            kind: self.kind(),
            side: self.request.side.name(),
            size: [size.width, size.height],
            coordinates,
            axes: axes.map(|axis| AxisJson { name: axis.name, unit: axis.unit }),
            axis: self.surface.axis().map(Vector::to_array),
            length: self.scene.length().name(),
            convention: self.scene.convention().name(),
            channel: self.main.name(),
            unit: unit(&self.main, self.scene),
            area: totals.map_or(self.surface.area(), |totals| totals.area),
            area_unit: "m²",
            left_out: self.surface.left_out(),
            flux_unit: flux.map(|_| self.scene.unit_system().power_unit()),
            flux,
            mean: totals.map(SurfaceTotals::mean),
            max: totals.map(|totals| extreme(&totals.max)),
            min: totals.map(|totals| extreme(&totals.min)),
        }
    }
}

/// The statistics for programs; points in the scene's unit.
#[derive(Serialize)]
struct SurfaceJson {
    title: String,
    shape: String,
    kind: &'static str,
    side: &'static str,
    size: [u32; 2],
    coordinates: Coordinates,
    axes: [AxisJson; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    axis: Option<[f64; 3]>,
    length: &'static str,
    convention: &'static str,
    channel: String,
    unit: String,
    /// The area of the cells that have a value.
    area: f64,
    area_unit: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    left_out: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    flux: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    flux_unit: Option<&'static str>,
    mean: Option<f64>,
    max: Option<ExtremeJson>,
    min: Option<ExtremeJson>,
}

#[derive(Serialize)]
struct AxisJson {
    name: &'static str,
    unit: &'static str,
}

#[derive(Serialize)]
struct ExtremeJson {
    value: f64,
    cell: [u32; 2],
    coordinates: [f64; 2],
    point: [f64; 3],
    /// If the channel depends on the eye, and the eye does not see the point.
    #[serde(skip_serializing_if = "Option::is_none")]
    unseen_because: Option<String>,
}
