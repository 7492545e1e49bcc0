//! All channels as a table: for spreadsheets, pandas and people.

use std::io::{BufRead, Read, Seek, Write};

use isophote::map::{Channel, CoordinateAxis, Coordinates, Map, Quantity, Values};

use crate::error::ExportError;
use crate::limits::LONGEST_JSON;
use crate::metadata::FileMetadata;
use crate::names;
use crate::text::{Number, one_line};

/// Which pixels become rows of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rows {
    /// Every pixel.
    All,
    /// Only pixels where a surface is seen.
    Visible,
}

/// Writes comment lines that begin with `#` (program, title, units, the metadata as JSON), a header line
/// (`column,row,x,y,shape,…`, vectors as `normal.x,normal.y,normal.z`) and one line per pixel, row by row from the top.
/// Returns the number of pixels written.
///
/// `column` and `row` are positions in the full image; `x` and `y` are the pixel's centre on the screen. Every number
/// reads back exactly. In a light's name commas, quotes, `#` and control characters become `_`.
///
/// # Errors
/// An error of `out`.
pub fn write(map: &Map, rows: Rows, mut out: impl Write) -> Result<u64, ExportError> {
    let columns = column_names(map);
    write_comments(map, &columns, &mut out)?;
    let names: Vec<_> = columns.iter().flatten().map(String::as_str).collect();
    let [x, y] = map.window.coordinates.axes(map.window.length);
    let shape = if has_shapes(map) { ",shape" } else { "" };
    writeln!(
        out,
        "column,row,{},{}{shape}{}{}",
        x.name,
        y.name,
        if names.is_empty() { "" } else { "," },
        names.join(",")
    )?;
    let mut written = 0;
    for (index, shape) in map.mask().shapes().into_iter().enumerate() {
        if rows == Rows::All || shape >= 0 {
            write_row(map, index, shape, &mut out)?;
            written += 1;
        }
    }
    Ok(written)
}

/// The column names of each channel; none for the shape, whose column is at the front.
fn column_names(map: &Map) -> Vec<Vec<String>> {
    let names = names::unique(map.channels(), |character| !character.is_control() && !",\"#".contains(character));
    let columns = |(channel, name): (&Channel, String)| match (&channel.quantity, &channel.values) {
        (Quantity::Shape, _) => vec![],
        (_, Values::Vector(_)) => axes(&channel.quantity).map(|axis| format!("{name}.{axis}")).to_vec(),
        (_, Values::Scalar(_) | Values::Single(_) | Values::Index(_)) => vec![name],
    };
    map.channels().iter().zip(names).map(columns).collect()
}

/// The names of a vector's three components.
fn axes(quantity: &Quantity) -> [&'static str; 3] {
    if *quantity == Quantity::Color { ["r", "g", "b"] } else { ["x", "y", "z"] }
}

fn write_comments(map: &Map, columns: &[Vec<String>], out: &mut impl Write) -> Result<(), ExportError> {
    let provenance = &map.provenance;
    let mut lines = vec![
        format!("title: {}", one_line(&provenance.title)),
        format!("convention: {}", one_line(&provenance.convention)),
        format!(
            "column, row: pixel of the full image, {} × {}, from 0 at the top left",
            map.full.width, map.full.height
        ),
        places(map),
    ];
    if let Some(space) = &provenance.color_space {
        lines.push(format!("color space: {space}; channels of one number are luminances in it"));
    }
    if has_shapes(map) {
        lines.push("shape: index of the shape that is seen, -1 where none is".into());
    }
    for (channel, names) in map.channels().iter().zip(columns).filter(|(_, names)| !names.is_empty()) {
        let unit = if channel.unit == "1" { "no unit" } else { &channel.unit };
        lines.push(format!("{}: {unit}", names.join(", ")));
    }
    let stored_as = columns.iter().map(|names| if names.is_empty() { vec!["shape".into()] } else { names.clone() });
    lines.push(format!("{KEY}{}", FileMetadata::of_stored(map, stored_as.collect()).to_json()));
    // genfromtxt takes its names from the very first line, comment or not, unless told how many lines to skip.
    let hint = format!("numpy.genfromtxt(…, delimiter=\",\", names=True, skip_header={})", lines.len() + 1);
    writeln!(out, "# {}; pandas.read_csv(…, comment=\"#\") or {hint}", one_line(&provenance.program))?;
    for line in lines {
        writeln!(out, "# {line}")?;
    }
    Ok(())
}

/// Describes the two coordinates of a row.
fn places(map: &Map) -> String {
    let [x, y] = map.window.coordinates.axes(map.window.length);
    if map.window.coordinates.is_screen() {
        return format!("x, y: centre of the pixel on the screen, {}", x.unit);
    }
    let of_one = |axis: CoordinateAxis| if axis.unit == "1" { "no unit" } else { axis.unit };
    format!("{}, {}: centre of the cell on the surface, {}, {}", x.name, y.name, of_one(x), of_one(y))
}

/// A grid has no shapes, whatever lies beneath it.
fn has_shapes(map: &Map) -> bool {
    map.window.coordinates != Coordinates::Grid
}

const KEY: &str = "isophote: ";

fn write_row(map: &Map, index: usize, shape: i32, out: &mut impl Write) -> Result<(), ExportError> {
    let pixel = map.pixel(index);
    let [x, y] = map.center(pixel);
    write!(out, "{},{},{},{}", pixel.column, pixel.row, Number(x), Number(y))?;
    if has_shapes(map) {
        write!(out, ",{shape}")?;
    }
    for channel in map.channels().iter().filter(|channel| channel.quantity != Quantity::Shape) {
        match &channel.values {
            Values::Scalar(values) => write!(out, ",{}", Number(values[index]))?,
            Values::Single(values) => write!(out, ",{}", Number(f64::from(values[index])))?,
            Values::Vector(values) => {
                let [x, y, z] = values[index].map(Number);
                write!(out, ",{x},{y},{z}")?;
            }
            Values::Index(indices) => write!(out, ",{}", indices[index])?,
        }
    }
    writeln!(out)?;
    Ok(())
}

/// Searches only the comments at the beginning.
pub(crate) fn read_json(file: &mut (impl BufRead + Seek)) -> Result<Option<Vec<u8>>, String> {
    let mut comments = file.take(LONGEST_JSON);
    let mut line = Vec::new();
    loop {
        line.clear();
        comments.read_until(b'\n', &mut line).map_err(|error| error.to_string())?;
        let Some(comment) = line.strip_prefix(b"# ") else { return Ok(None) };
        if let Some(json) = comment.strip_prefix(KEY.as_bytes()) {
            return Ok(Some(json.to_vec()));
        }
    }
}
