//! Values at points, as a table for people.

use std::fmt::Write;

use isophote::analysis::probe::ProbeReading;
use isophote::color::Component;
use isophote::message;
use isophote::prepare::PreparedScene;
use isophote::text::{Language, Message, significant};
use isophote::units::Keyword;

use crate::table::{Align, table};

/// A table of readings, with the published values if there are any.
pub fn text(readings: &[(&str, &ProbeReading, Option<f64>)], scene: &PreparedScene, language: Language) -> String {
    let description = scene.scene();
    let length = description.length();
    let convention = description.convention();
    let unit = convention.unit(description.unit_system());
    let word = |message: Message| message.in_language(language);
    let point = word(message!("point, {length}", length = length.name()));
    let [probe, published, seen] = [message!("probe"), message!("published"), message!("seen")].map(word);
    let irradiance = format!("E (3.1), {}", description.unit_system().irradiance_unit());
    let brightness = format!("B ({}), {unit}", convention.formula_number());
    let mut columns = vec![
        (probe.as_str(), Align::Left),
        (point.as_str(), Align::Left),
        (irradiance.as_str(), Align::Right),
        (brightness.as_str(), Align::Right),
    ];
    let has_published = readings.iter().any(|(_, _, published)| published.is_some());
    if has_published {
        columns.push((published.as_str(), Align::Right));
    }
    // Their values are as exact as others, but no picture has them.
    let has_unseen = readings.iter().any(|(_, reading, _)| !reading.is_seen());
    if has_unseen {
        columns.push((seen.as_str(), Align::Left));
    }
    let row = |(name, reading, published): &(&str, &ProbeReading, Option<f64>)| {
        let [x, y, z] = reading.position(length).map(|coordinate| significant(coordinate, 6));
        let mut row = vec![
            (*name).to_owned(),
            format!("({x}, {y}, {z})"),
            significant(reading.shading.irradiance, 15),
            significant(reading.shading.brightness(), 15),
        ];
        if has_published {
            row.push(published.map_or("–".into(), |value| significant(value, 15)));
        }
        if has_unseen {
            row.push(word(if reading.is_seen() { message!("yes") } else { message!("NO") }));
        }
        row
    };
    let rows = readings.iter().flat_map(|reading| std::iter::once(row(reading)).chain(color_rows(reading.1, language)));
    // Rows of components end before the columns of published values and of what is seen.
    let filled = |row: Vec<String>| row.into_iter().chain(std::iter::repeat(String::new())).take(columns.len());
    let rows: Vec<Vec<String>> = rows.map(|row| filled(row).collect()).collect();
    let mut text = table(&columns, &rows);
    if let Some(color) = description.color_label() {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "  {color}");
    }
    for (name, reading, _) in readings {
        if let Some(note) = reading.why_unseen(description) {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "  {}", word(message!("{name} is not seen from the eye: {note}", name, note)));
        }
    }
    text
}

/// One row per component, below the luminance.
fn color_rows(reading: &ProbeReading, language: Language) -> Vec<Vec<String>> {
    let Some(readings) = reading.components.as_deref() else { return Vec::new() };
    let row = |component: &Component| {
        let shading = &readings.of(*component).shading;
        let [irradiance, brightness] = [shading.irradiance, shading.brightness()].map(|value| significant(value, 15));
        vec![format!("  {}", component.label().in_language(language)), String::new(), irradiance, brightness]
    };
    Component::ALL.iter().map(row).collect()
}
