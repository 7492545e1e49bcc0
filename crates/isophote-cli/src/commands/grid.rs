//! `isophote grid`: illuminances at the points of a grid.

use std::fmt::Write;

use anyhow::Result;
use isophote::analysis::statistics::{Extreme, Statistics, statistics};
use isophote::map::{Map, Quantity};
use isophote::message;
use isophote::prepare::PreparedScene;
use isophote::scene::source::GridSource;
use isophote::scene::{Grid, Scene};
use isophote::text::{Language, escaped_line, significant};
use isophote::units::Keyword;
use isophote_export::figure::FigureOptions;
use serde::Serialize;

use super::cells::{CellFiles, place_text};
use super::there_are;
use crate::args::{GridArguments, PlacedGridArguments};
use crate::channels::{named, unit};
use crate::failure::Usage;
use crate::table::{Align, table};
use crate::{load, numbers};

/// Computes grids, writes one if requested, and prints their statistics.
pub fn run(arguments: &GridArguments) -> Result<String> {
    let language = arguments.language.lang;
    let mut scene = load::scene(&arguments.scene, arguments.quiet, language)?;
    if let Some(grid) = placed(&arguments.placed)? {
        scene = scene.with_grid(grid).map_err(|error| load::wrong(message!("the grid"), &error))?;
    }
    let scene = PreparedScene::new(&scene);
    let files = CellFiles::new(&arguments.output, &arguments.figure, &arguments.style)?;
    let mut wanted = named(&arguments.channel, scene.scene())?;
    let main = wanted.first().cloned().unwrap_or(Quantity::Irradiance);
    files.refuse_impossible_pictures(&main)?;
    if wanted.is_empty() {
        wanted.extend([Quantity::Irradiance, Quantity::Position]);
    }
    let grids = chosen(arguments, scene.scene())?;
    if !files.is_empty() && grids.len() > 1 {
        let names: Vec<&str> = grids.iter().map(|grid| grid.name.as_str()).collect();
        let message =
            message!("a file holds one grid: choose one with --name; {there_are}", there_are = there_are(&names));
        return Err(Usage(message).into());
    }
    let computed = |grid| {
        let map = scene.grid(grid, &wanted).map_err(|error| Usage(error.message()))?;
        Ok(Computed { grid, statistics: statistics(&map, &main), map })
    };
    let computed: Vec<Computed> = grids.into_iter().map(computed).collect::<Result<_>>()?;
    if let [only] = computed.as_slice() {
        files.write(&only.map, only.figure_options(&main, scene.scene(), language), scene.scene(), arguments.quiet)?;
    }
    let summary = Summary { scene: scene.scene(), main, computed };
    if arguments.json { numbers::json(&summary.to_json()) } else { Ok(summary.to_text(language)) }
}

/// The grid given on the command line, in the form of a scene file.
fn placed(arguments: &PlacedGridArguments) -> Result<Option<GridSource>, Usage> {
    let PlacedGridArguments { corner, center, u, v, points, side } = arguments;
    let is_given = corner.is_some() || center.is_some() || u.is_some() || v.is_some() || points.is_some();
    if !is_given {
        return match side {
            Some(_) => {
                Err(Usage(message!("--side goes with a grid of the command line: --center, --u, --v, --points")))
            }
            None => Ok(None),
        };
    }
    let points = points.map(|points| [points.width.into(), points.height.into()]);
    Ok(Some(GridSource { name: None, corner: *corner, center: *center, u: *u, v: *v, points, side: *side }))
}

fn chosen<'s>(arguments: &GridArguments, scene: &'s Scene) -> Result<Vec<&'s Grid>> {
    let grids = scene.grids();
    if grids.is_empty() {
        let message = message!(
            "the scene has no grid: write a table [[grid]], or say where with --center, --u, --v and --points"
        );
        return Err(Usage(message).into());
    }
    let Some(name) = &arguments.name else { return Ok(grids.iter().collect()) };
    let names: Vec<&str> = grids.iter().take(20).map(|grid| grid.name.as_str()).collect();
    let found = grids.iter().find(|grid| grid.name == *name);
    let unknown = || Usage(message!("there is no grid \"{name}\"; {there_are}", name, there_are = there_are(&names)));
    Ok(vec![found.ok_or_else(unknown)?])
}

struct Computed<'s> {
    grid: &'s Grid,
    map: Map,
    /// None if the channel is not a scalar.
    statistics: Option<Statistics>,
}

impl Computed<'_> {
    fn figure_options(&self, main: &Quantity, scene: &Scene, language: Language) -> FigureOptions {
        let label = match (main, scene.unit_system()) {
            (Quantity::Irradiance, isophote::units::UnitSystem::Photometric) => {
                message!("illuminance").in_language(language)
            }
            (_, units) => main.label_in(units, language),
        };
        let title = [scene.title(), &self.grid.name].join(": ");
        let title = if scene.title().is_empty() { self.grid.name.clone() } else { title };
        FigureOptions { title, ..FigureOptions::in_language(main.clone(), &label, language) }
    }

    fn place(&self, extreme: &Extreme, scene: &Scene) -> [f64; 2] {
        self.grid.coordinates(extreme.pixel).map(|metres| scene.length().from_metres(metres))
    }
}

struct Summary<'s> {
    scene: &'s Scene,
    main: Quantity,
    computed: Vec<Computed<'s>>,
}

impl Summary<'_> {
    fn to_text(&self, language: Language) -> String {
        let unit = unit(&self.main, self.scene);
        let headings = [message!("minimum"), message!("mean"), message!("maximum")]
            .map(|name| format!("{}, {unit}", name.in_language(language)));
        let [grid, points, to_mean, to_max] =
            [message!("grid"), message!("points"), message!("min/mean"), message!("min/max")]
                .map(|heading| heading.in_language(language));
        let [min, mean, max] = headings.each_ref().map(|heading| (heading.as_str(), Align::Right));
        let columns = [
            (grid.as_str(), Align::Left),
            (points.as_str(), Align::Right),
            min,
            mean,
            max,
            (to_mean.as_str(), Align::Right),
            (to_max.as_str(), Align::Right),
        ];
        let row = |computed: &Computed| {
            let Grid { name, points, .. } = computed.grid;
            let mut row = vec![name.clone(), format!("{} × {}", points.width, points.height)];
            match &computed.statistics {
                Some(found) => {
                    let Ratios { uniformity, diversity } = Ratios::of(found);
                    row.extend([found.min.value, found.mean, found.max.value].map(|value| significant(value, 9)));
                    row.extend([uniformity, diversity].map(ratio_text));
                }
                None => row.extend(std::iter::repeat_n("–".to_owned(), 5)),
            }
            row
        };
        let rows: Vec<Vec<String>> = self.computed.iter().map(row).collect();
        let title = escaped_line(self.scene.title());
        let mut text = if title.is_empty() { String::new() } else { format!("{title}\n\n") };
        text.push_str(&table(&columns, &rows));
        for computed in &self.computed {
            let Some(found) = &computed.statistics else { continue };
            let axes = computed.map.window.coordinates.axes(self.scene.length());
            let place = |extreme| place_text(axes, computed.place(extreme, self.scene), language);
            let (min, max) = (place(&found.min), place(&found.max));
            let name = &computed.grid.name;
            let line = message!("  {name}: minimum at {min}; maximum at {max}", name, min, max);
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{}", line.in_language(language));
        }
        text
    }

    fn to_json(&self) -> GridsJson {
        let length = self.scene.length();
        let in_unit = |vector: isophote::vector::Vector| vector.to_array().map(|metres| length.from_metres(metres));
        let grid = |computed: &Computed| {
            let Computed { grid, map, statistics } = computed;
            let extreme = |extreme: &Extreme| ExtremeJson {
                value: extreme.value,
                cell: [extreme.pixel.column, extreme.pixel.row],
                coordinates: computed.place(extreme, self.scene),
                point: in_unit(grid.point(extreme.pixel)),
            };
            let ratios = statistics.as_ref().map(Ratios::of);
            let values = map.scalar(&self.main).map(|values| values.iter().collect::<Vec<_>>());
            GridJson {
                name: grid.name.clone(),
                points: [grid.points.width, grid.points.height],
                corner: in_unit(grid.corner),
                u: in_unit(grid.u),
                v: in_unit(grid.v),
                normal: grid.normal().to_array(),
                min: statistics.as_ref().map(|found| extreme(&found.min)),
                mean: statistics.as_ref().map(|found| found.mean),
                max: statistics.as_ref().map(|found| extreme(&found.max)),
                uniformity: ratios.as_ref().and_then(|ratios| ratios.uniformity),
                min_to_max: ratios.as_ref().and_then(|ratios| ratios.diversity),
                values: values.map(|values| values.chunks(grid.points.width as usize).map(<[f64]>::to_vec).collect()),
            }
        };
        GridsJson {
            title: self.scene.title().into(),
            length: length.name(),
            channel: self.main.name(),
            unit: unit(&self.main, self.scene),
            grids: self.computed.iter().map(grid).collect(),
        }
    }
}

/// How even the illumination is; none if everything is dark.
struct Ratios {
    /// Minimum over mean.
    uniformity: Option<f64>,
    /// Minimum over maximum.
    diversity: Option<f64>,
}

impl Ratios {
    fn of(found: &Statistics) -> Self {
        let over = |whole: f64| (whole > 0.0).then(|| found.min.value / whole);
        Self { uniformity: over(found.mean), diversity: over(found.max.value) }
    }
}

fn ratio_text(ratio: Option<f64>) -> String {
    ratio.map_or("–".into(), |ratio| significant(ratio, 4))
}

/// The statistics for programs; lengths and points in the scene's unit.
#[derive(Serialize)]
struct GridsJson {
    title: String,
    length: &'static str,
    channel: String,
    unit: String,
    grids: Vec<GridJson>,
}

#[derive(Serialize)]
struct GridJson {
    name: String,
    points: [u32; 2],
    corner: [f64; 3],
    u: [f64; 3],
    v: [f64; 3],
    normal: [f64; 3],
    min: Option<ExtremeJson>,
    mean: Option<f64>,
    max: Option<ExtremeJson>,
    /// Minimum over mean; none if everything is dark.
    uniformity: Option<f64>,
    min_to_max: Option<f64>,
    /// Row by row, starting with the row farthest along v.
    values: Option<Vec<Vec<f64>>>,
}

#[derive(Serialize)]
struct ExtremeJson {
    value: f64,
    cell: [u32; 2],
    coordinates: [f64; 2],
    point: [f64; 3],
}
