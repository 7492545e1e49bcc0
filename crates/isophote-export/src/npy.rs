//! One channel as a `NumPy` array in the NPY format 1.0 (`numpy.lib.format`): magic, a header that is a Python
//! dictionary, then the numbers in little-endian order, rows from the top.
//!
//! The numbers are followed by what `numpy.load` ignores: the metadata as JSON, its length in bytes (8, little-endian)
//! and the word `ISOPHOTE`, so that a reader can find it from the end of the file.

use std::io::{BufRead, Seek, SeekFrom, Write};

use isophote::map::{Map, Quantity, Resolution, Values};

use crate::channel;
use crate::error::ExportError;
use crate::limits::{LONGEST_JSON, read_exactly};
use crate::metadata::FileMetadata;

/// Writes the channel: 64-bit numbers of shape (rows, columns); 32-bit if the map was computed in single precision;
/// vectors with a third axis of 3; indices as 32-bit integers. Missed pixels hold 0, or −1 in the index.
///
/// # Errors
/// The channel is missing; an error of `out`.
pub fn write(map: &Map, quantity: &Quantity, mut out: impl Write) -> Result<(), ExportError> {
    let channel = channel::find(map, quantity)?;
    write_array(&mut out, map.region.size, &channel.values)?;
    let json = FileMetadata::of_channel(map, channel).to_json();
    out.write_all(json.as_bytes())?;
    out.write_all(&(json.len() as u64).to_le_bytes())?;
    out.write_all(TRAILER)?;
    Ok(())
}

pub(crate) const MAGIC: &[u8] = b"\x93NUMPY";
const TRAILER: &[u8; 8] = b"ISOPHOTE";

pub(crate) fn write_array(out: &mut impl Write, size: Resolution, values: &Values) -> std::io::Result<()> {
    let Resolution { width, height } = size;
    match values {
        Values::Scalar(values) => {
            out.write_all(&header("<f8", &format!("({height}, {width})")))?;
            write_numbers(out, values, f64::to_le_bytes)
        }
        Values::Single(values) => {
            out.write_all(&header("<f4", &format!("({height}, {width})")))?;
            write_numbers(out, values, f32::to_le_bytes)
        }
        Values::Vector(values) => {
            out.write_all(&header("<f8", &format!("({height}, {width}, 3)")))?;
            write_numbers(out, values.as_flattened(), f64::to_le_bytes)
        }
        Values::Index(indices) => {
            out.write_all(&header("<i4", &format!("({height}, {width})")))?;
            write_numbers(out, indices, i32::to_le_bytes)
        }
    }
}

/// Magic, version 1.0, length and dictionary, padded so that the numbers begin at a multiple of 64 bytes, as memory
/// mapping requires.
pub(crate) fn header(kind: &str, shape: &str) -> Vec<u8> {
    let mut dictionary = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}");
    let before = MAGIC.len() + 4;
    let padding = (before + dictionary.len() + 1).next_multiple_of(64) - (before + dictionary.len() + 1);
    dictionary.extend(std::iter::repeat_n(' ', padding));
    dictionary.push('\n');
    let length = u16::try_from(dictionary.len()).expect("a kind and three numbers are short");
    [MAGIC, &[1, 0], &length.to_le_bytes(), dictionary.as_bytes()].concat()
}

/// Writes in blocks: one call per number would cost more than the copying.
pub(crate) fn write_numbers<T: Copy, const BYTES: usize>(
    out: &mut impl Write,
    numbers: &[T],
    to_bytes: impl Fn(T) -> [u8; BYTES],
) -> std::io::Result<()> {
    let mut block = Vec::new();
    for chunk in numbers.chunks(8192) {
        block.clear();
        block.extend(chunk.iter().flat_map(|number| to_bytes(*number)));
        out.write_all(&block)?;
    }
    Ok(())
}

pub(crate) fn read_json(file: &mut (impl BufRead + Seek)) -> Result<Option<Vec<u8>>, String> {
    let broken = |error: std::io::Error| error.to_string();
    let end = file.seek(SeekFrom::End(0)).map_err(broken)?;
    let Some(trailer) = end.checked_sub(16) else { return Err("it ends within its header".into()) };
    let (mut length, mut word) = ([0; 8], [0; 8]);
    file.seek(SeekFrom::Start(trailer)).map_err(broken)?;
    file.read_exact(&mut length).map_err(broken)?;
    file.read_exact(&mut word).map_err(broken)?;
    if word != *TRAILER {
        return Ok(None);
    }
    let length = u64::from_le_bytes(length);
    let start = trailer.checked_sub(length).ok_or("its metadata claims to be longer than the file")?;
    file.seek(SeekFrom::Start(start)).map_err(broken)?;
    read_exactly(file, length, LONGEST_JSON).map(Some)
}
