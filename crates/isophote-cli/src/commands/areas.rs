//! The areas of interest of a scene, for people and for programs.

use std::fmt::Write as _;

use isophote::analysis::area::{AreaExtreme, AreaReading};
use isophote::analysis::probe::SeenFromEye;
use isophote::message;
use isophote::prepare::PreparedScene;
use isophote::scene::{Area, AreaPlace, Scene};
use isophote::text::{Language, Message, significant};
use isophote::units::Keyword;
use serde::Serialize;

use crate::table::{Align, table};

/// The readings of a scene's areas; none for an area that shows no surface.
pub struct Areas(Vec<Option<AreaReading>>);

impl Areas {
    pub fn of(scene: &PreparedScene) -> Self {
        Self(scene.scene().areas().iter().map(|area| scene.area(area)).collect())
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    fn with_areas<'s>(&'s self, scene: &'s Scene) -> impl Iterator<Item = (&'s Area, Option<&'s AreaReading>)> {
        scene.areas().iter().zip(self.0.iter().map(Option::as_ref))
    }

    pub fn to_text(&self, scene: &Scene, language: Language) -> String {
        let (convention, length) = (scene.convention(), scene.length().name());
        let unit = convention.unit(scene.unit_system());
        let number = convention.formula_number();
        let headings = [
            message!("maximum of B ({number}), {unit}", number, unit),
            message!("mean of B ({number}), {unit}", number, unit),
            message!("minimum of B ({number}), {unit}", number, unit),
        ];
        let headings = headings.map(|heading| heading.in_language(language));
        let place = message!("at, {length}", length).in_language(language);
        let area = message!("area").in_language(language);
        let columns = [
            (area.as_str(), Align::Left),
            (headings[0].as_str(), Align::Right),
            (place.as_str(), Align::Left),
            (headings[1].as_str(), Align::Right),
            (headings[2].as_str(), Align::Right),
            (place.as_str(), Align::Left),
        ];
        let nothing = message!("no surface is seen").in_language(language);
        let row = |(area, reading): (&Area, Option<&AreaReading>)| match reading {
            Some(AreaReading { max, min, mean, .. }) => vec![
                area.name.clone(),
                significant(max.value, 12),
                point_text(max, scene),
                significant(*mean, 12),
                significant(min.value, 12),
                point_text(min, scene),
            ],
            None => {
                vec![area.name.clone(), "–".into(), nothing.clone(), "–".into(), "–".into(), "–".into()]
            }
        };
        let mut text = table(&columns, &self.with_areas(scene).map(row).collect::<Vec<_>>());
        for (area, reading) in self.with_areas(scene) {
            for note in reading.into_iter().flat_map(|reading| notes(area, reading)) {
                // Writing to a string cannot fail.
                let _ = writeln!(text, "  {}: {}", area.name, note.in_language(language));
            }
        }
        text
    }

    pub fn to_json(&self, scene: &Scene) -> Vec<AreaJson> {
        let unit = scene.convention().unit(scene.unit_system());
        let of_area = |(area, reading): (&Area, Option<&AreaReading>)| AreaJson {
            name: area.name.clone(),
            on: match area.place {
                AreaPlace::Surface { shape, .. } => Some(scene.shapes()[shape].name.clone()),
                AreaPlace::Screen(_) => None,
            },
            unit,
            max: reading.map(|reading| extreme_json(&reading.max, scene)),
            min: reading.map(|reading| extreme_json(&reading.min, scene)),
            mean: reading.map(|reading| reading.mean),
            mean_error: reading.map(|reading| reading.mean_error),
            visible: reading.map_or(0.0, |reading| reading.visible),
        };
        self.with_areas(scene).map(of_area).collect()
    }
}

fn point(extreme: &AreaExtreme, scene: &Scene) -> [f64; 3] {
    extreme.point.to_array().map(|metres| scene.length().from_metres(metres))
}

fn point_text(extreme: &AreaExtreme, scene: &Scene) -> String {
    let [x, y, z] = point(extreme, scene).map(|coordinate| significant(coordinate, 6));
    format!("({x}, {y}, {z})")
}

/// What a reader of the values should know.
fn notes(area: &Area, reading: &AreaReading) -> Vec<Message> {
    let mut notes = Vec::new();
    let share = significant(100.0 * reading.visible, 4);
    if reading.visible < 1.0 {
        notes.push(match area.place {
            AreaPlace::Surface { .. } => message!("the eye sees {share} % of it", share),
            AreaPlace::Screen(_) => message!("{share} % of it shows a surface, and counts", share),
        });
    }
    if reading.max.seen != SeenFromEye::Seen {
        notes.push(message!("the eye does not see the point of the maximum"));
    }
    if reading.min.seen != SeenFromEye::Seen {
        notes.push(message!("the eye does not see the point of the minimum"));
    }
    if reading.mean_error > 1e-6 * reading.mean.abs() {
        notes.push(message!("the mean is uncertain by about {error}", error = significant(reading.mean_error, 2)));
    }
    notes
}

fn extreme_json(extreme: &AreaExtreme, scene: &Scene) -> ExtremeJson {
    ExtremeJson {
        value: extreme.value,
        point: point(extreme, scene),
        screen: extreme.screen.map(|place| place.map(|coordinate| scene.screen_unit().from_internal(coordinate))),
        seen: extreme.seen == SeenFromEye::Seen,
    }
}

/// The values of an area; points in the scene's unit.
#[derive(Serialize)]
pub struct AreaJson {
    name: String,
    /// The shape that it is on; none for one on the screen.
    on: Option<String>,
    unit: &'static str,
    max: Option<ExtremeJson>,
    min: Option<ExtremeJson>,
    mean: Option<f64>,
    /// An estimate of the error of the mean.
    mean_error: Option<f64>,
    /// The fraction of an area on a surface that the eye sees, or of one on the screen that shows a surface.
    visible: f64,
}

#[derive(Serialize)]
struct ExtremeJson {
    value: f64,
    point: [f64; 3],
    #[serde(skip_serializing_if = "Option::is_none")]
    screen: Option<[f64; 2]>,
    seen: bool,
}
