//! Comma-separated values: a line of column names (`x`, `y`, `z`, `radius` and optionally `material`, in any order), then a
//! line for each sphere. Empty lines and lines that begin with `#` are ignored; names may be in double quotes.

use super::{SphereList, SpheresBuilder};
use crate::import::{
    Fault, FilePosition, FileProblem,
    text::{lines, number, shown},
};
use crate::message;
use crate::text::Message;

/// The spheres of a CSV file.
pub(in crate::import) fn read(bytes: &[u8]) -> Result<SphereList, Fault> {
    let mut rows = lines(bytes).filter(|(_, line)| !matches!(line.trim_ascii(), [] | [b'#', ..]));
    let Some((number, header)) = rows.next() else { return Err(FileProblem::NoSpheres.at(FilePosition::Whole)) };
    let columns = columns(header).map_err(|problem| problem.at(FilePosition::Line(number)))?;
    let has_material = columns.contains(&Column::Material);
    let mut builder = SpheresBuilder::default();
    for (number, line) in rows {
        let at = |problem: FileProblem| problem.at(FilePosition::Line(number));
        let row = row(line, &columns).map_err(at)?;
        builder.sphere(row.numbers).map_err(at)?;
        if has_material {
            let name = row.material.map(unquoted).transpose().map_err(at)?.flatten();
            let slot = builder.materials.slot(name.as_deref()).map_err(at)?;
            builder.materials.push(slot);
        }
    }
    builder.finish()
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Column {
    /// Index into x, y, z, radius.
    Number(usize),
    Material,
}

const NUMBERS: [&str; 4] = ["x", "y", "z", "radius"];

fn columns(header: &[u8]) -> Result<Vec<Column>, FileProblem> {
    let mut columns = Vec::new();
    for field in fields(header) {
        let name = unquoted(field)?.unwrap_or_default();
        let number = NUMBERS.iter().position(|known| *known == name).map(Column::Number);
        let unexpected = |what: Message| FileProblem::Unexpected {
            what,
            found: shown(name.as_bytes()),
            allowed: message!("x, y, z, radius and, if wanted, material, separated by commas"),
        };
        let column = number
            .or((name == "material").then_some(Column::Material))
            .ok_or_else(|| unexpected(message!("a column")))?;
        if columns.contains(&column) {
            return Err(unexpected(message!("a column that is there twice")));
        }
        columns.push(column);
    }
    for (index, name) in NUMBERS.iter().enumerate() {
        if !columns.contains(&Column::Number(index)) {
            return Err(FileProblem::Missing {
                what: message!("column {name}", name),
                needed: message!("needed are x, y, z and radius"),
            });
        }
    }
    Ok(columns)
}

struct Row<'a> {
    numbers: [f64; 4],
    material: Option<&'a [u8]>,
}

fn row<'a>(line: &'a [u8], columns: &[Column]) -> Result<Row<'a>, FileProblem> {
    let mut row = Row { numbers: [0.0; 4], material: None };
    let mut fields = fields(line);
    let mut found = 0;
    for (column, field) in columns.iter().zip(&mut fields) {
        match column {
            Column::Number(index) => row.numbers[*index] = number(field.trim_ascii(), NUMBERS[*index])?,
            Column::Material => row.material = Some(field),
        }
        found += 1;
    }
    found += fields.count();
    if found == columns.len() {
        return Ok(row);
    }
    let allowed = message!("the first line has {count}", count = columns.len());
    Err(FileProblem::Parts { what: message!("the row, by its fields,"), found: found as u64, allowed })
}

/// The fields of a line, separated by commas; commas in double quotes do not separate.
fn fields(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    let mut is_quoted = false;
    line.split(move |byte| {
        is_quoted ^= *byte == b'"';
        *byte == b',' && !is_quoted
    })
}

/// A name without surrounding spaces and quotes; `None` if it is empty.
fn unquoted(field: &[u8]) -> Result<Option<String>, FileProblem> {
    let wrong = |allowed: Message| FileProblem::Unexpected { what: message!("a name"), found: shown(field), allowed };
    let text = std::str::from_utf8(field).map_err(|_| wrong(message!("text in UTF-8")))?.trim();
    if !text.contains('"') {
        return Ok(Some(text.to_owned()).filter(|name| !name.is_empty()));
    }
    let inner = text.strip_prefix('"').and_then(|text| text.strip_suffix('"'));
    let inner = inner.filter(|inner| !inner.replace("\"\"", "").contains('"'));
    let inner = inner.ok_or_else(|| wrong(message!("quotes around the whole name, doubled within")))?;
    Ok(Some(inner.replace("\"\"", "\"")).filter(|name| !name.is_empty()))
}
