//! `isophote show`: the metadata of an output file.

use std::fmt::Write;

use anyhow::Result;
use isophote::map::SourceFile;
use isophote::text::{escaped_line, significant};
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
    Ok(to_text(&metadata))
}

fn to_text(metadata: &FileMetadata) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let mut row = |name: &str, value: String| {
        let _ = writeln!(text, "  {name:<12}{}", escaped_line(&value));
    };
    let FileMetadata { full, region, window, .. } = metadata;
    row("title", metadata.title.clone());
    row("made by", format!("{}, {}", metadata.program, metadata.renderer));
    row("convention", metadata.convention.clone());
    if let Some(space) = &metadata.color_space {
        row("color space", format!("{space}; one number is a luminance in it"));
    }
    row("image", format!("{} × {} pixels", full.width, full.height));
    if region.size != *full {
        let (corner, size) = (region.corner, region.size);
        row("region", format!("{} × {} from column {}, row {}", size.width, size.height, corner.column, corner.row));
    }
    let [left, right] = window.x.map(|x| significant(x, 9));
    let [bottom, top] = window.y.map(|y| significant(y, 9));
    let [x, y] =
        window.coordinates.axes(window.length).map(|axis| if axis.unit == "1" { "no unit" } else { axis.unit });
    let [across, up] = window.coordinates.axes(window.length).map(|axis| axis.title);
    let unit_of_x = if x == y { String::new() } else { format!(" {x}") };
    row("window", format!("{across} {left} to {right}{unit_of_x}, {up} {bottom} to {top} {y}"));
    for channel in &metadata.channels {
        let unit = if channel.unit.is_empty() { "no unit" } else { &channel.unit };
        let stored_as = match channel.stored_as.join(", ") {
            names if names.is_empty() || names == channel.name => String::new(),
            names => format!(", stored as {names}"),
        };
        row("channel", format!("{}, {unit}{stored_as}", channel.name));
    }
    for SourceFile { name, bytes, sha256, content, .. } in &metadata.files {
        let carried = if content.is_some() { ", carried" } else { "" };
        row("file", format!("{name}, {bytes} bytes{carried}, SHA-256 {sha256}"));
    }
    if let Some(picture) = &metadata.picture {
        let [black, white] = picture.range.map(|value| significant(value, 12));
        let log = if picture.normalization == "log" { "logarithmic, " } else { "" };
        let level = picture.encoding.clone().unwrap_or_else(|| format!("{log}gamma {}", picture.gamma));
        row("picture", format!("{black} to {white} from black to white, {} bits, {level}", picture.depth));
        if let Some(colormap) = &picture.colormap {
            row("colours", colormap.clone());
        }
    }
    let _ = write!(text, "\nscene\n{}", indented(&metadata.scene));
    text
}

fn indented(scene: &str) -> String {
    scene.lines().map(|line| if line.is_empty() { "\n".into() } else { format!("  {line}\n") }).collect()
}
