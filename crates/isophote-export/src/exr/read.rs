//! Finds the metadata in an EXR file.

use std::io::{BufRead, Read, Seek, SeekFrom};

use crate::limits::{LONGEST_JSON, read_exactly};

/// Walks through the attributes of the first header (name, type, length, value; an empty name ends them) without
/// reading their values, which a general reader would have to hold in memory.
pub(crate) fn read_json(file: &mut (impl BufRead + Seek)) -> Result<Option<Vec<u8>>, String> {
    let broken = |error: std::io::Error| error.to_string();
    file.seek(SeekFrom::Start(8)).map_err(broken)?;
    loop {
        let name = read_name(file)?;
        if name.is_empty() {
            return Ok(None);
        }
        let kind = read_name(file)?;
        let mut length = [0; 4];
        file.read_exact(&mut length).map_err(broken)?;
        let length = u32::from_le_bytes(length);
        if name == b"isophote" && kind == b"string" {
            return read_exactly(file, length.into(), LONGEST_JSON).map(Some);
        }
        file.seek_relative(length.into()).map_err(broken)?;
    }
}

fn read_name(file: &mut impl BufRead) -> Result<Vec<u8>, String> {
    let mut name = Vec::new();
    file.take(256).read_until(0, &mut name).map_err(|error| error.to_string())?;
    match name.pop() {
        Some(0) => Ok(name),
        _ => Err("a name in its header does not end".into()),
    }
}
