//! `isophote show`: the metadata of an output file.

use std::fmt::Write;

use anyhow::Result;
use isophote::map::{Pixel, Region, Resolution, SourceFile};
use isophote::message;
use isophote::text::{Language, Message, escaped_line, significant};
use isophote_export::FileMetadata;

use crate::args::ShowArguments;
use crate::load;

/// Prints the metadata of a file.
pub fn run(arguments: &ShowArguments) -> Result<String> {
    let metadata = load::metadata(&arguments.file)?;
    if arguments.scene {
        return Ok(metadata.scene);
    }
    if arguments.json {
        return Ok(metadata.to_json() + "\n");
    }
    Ok(to_text(&metadata, arguments.language.lang))
}

fn to_text(metadata: &FileMetadata, language: Language) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let mut row = |name: Message, value: Message| {
        let (name, value) = (name.in_language(language), value.in_language(language));
        let _ = writeln!(text, "  {name:<12}{}", escaped_line(&value));
    };
    let FileMetadata { full, region, window, .. } = metadata;
    row(message!("title"), Message::verbatim(&metadata.title));
    row(message!("made by"), Message::verbatim(format!("{}, {}", metadata.program, metadata.renderer)));
    row(message!("convention"), Message::verbatim(&metadata.convention));
    if let Some(space) = &metadata.color_space {
        row(message!("color space"), message!("{space}; one number is a luminance in it", space));
    }
    row(message!("image"), message!("{width} × {height} pixels", width = full.width, height = full.height));
    if region.size != *full {
        let Region { corner: Pixel { column, row: first }, size: Resolution { width, height } } = *region;
        let value = message!("{width} × {height} from column {column}, row {row}", width, height, column, row = first);
        row(message!("region"), value);
    }
    let [left, right] = window.x.map(|x| significant(x, 9));
    let [bottom, top] = window.y.map(|y| significant(y, 9));
    let [x, y] = window
        .coordinates
        .axes(window.length)
        .map(|axis| if axis.unit == "1" { message!("no unit") } else { Message::verbatim(axis.unit) });
    let [across, up] = window.coordinates.axes(window.length).map(|axis| axis.label(language));
    let unit_of_x = if x == y { Message::empty() } else { message!(" {x}", x) };
    let value = message!(
        "{across} {left} to {right}{unit_of_x}, {up} {bottom} to {top} {y}",
        across,
        left,
        right,
        unit_of_x,
        up,
        bottom,
        top,
        y
    );
    row(message!("window"), value);
    for channel in &metadata.channels {
        let unit = if channel.unit.is_empty() { message!("no unit") } else { Message::verbatim(&channel.unit) };
        let value = message!("{channel}, {unit}", channel = channel.name, unit);
        let value = match channel.stored_as.join(", ") {
            names if names.is_empty() || names == channel.name => value,
            names => message!("{value}, stored as {names}", value, names),
        };
        row(message!("channel"), value);
    }
    for SourceFile { name, bytes, sha256, content, .. } in &metadata.files {
        let value = match content {
            Some(_) => message!("{name}, {bytes} bytes, carried, SHA-256 {hash}", name, bytes, hash = sha256),
            None => message!("{name}, {bytes} bytes, SHA-256 {hash}", name, bytes, hash = sha256),
        };
        row(message!("file"), value);
    }
    if let Some(picture) = &metadata.picture {
        let [black, white] = picture.range.map(|value| significant(value, 12));
        let level = match &picture.encoding {
            Some(encoding) => Message::verbatim(encoding),
            None if picture.normalization == "log" => message!("logarithmic, gamma {gamma}", gamma = picture.gamma),
            None => message!("gamma {gamma}", gamma = picture.gamma),
        };
        let value = message!(
            "{black} to {white} from black to white, {depth} bits, {level}",
            black,
            white,
            depth = picture.depth,
            level
        );
        row(message!("picture"), value);
        if let Some(colormap) = &picture.colormap {
            row(message!("colours"), Message::verbatim(colormap));
        }
    }
    let _ = write!(text, "\n{}\n{}", message!("scene").in_language(language), indented(&metadata.scene));
    text
}

fn indented(scene: &str) -> String {
    scene.lines().map(|line| if line.is_empty() { "\n".into() } else { format!("  {line}\n") }).collect()
}
