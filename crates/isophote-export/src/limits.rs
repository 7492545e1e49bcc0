//! Limits on how much of a file is read, whatever it claims.

use std::io::Read;

/// Longer descriptions, in bytes, are treated as damage: none that this program writes comes close, since a scene has 64 MiB
/// at most, and a false length must not exhaust memory.
pub(crate) const LONGEST_JSON: u64 = 256 << 20;

/// Reads exactly `length` bytes; memory grows with what the file actually holds, not with what it claims.
pub(crate) fn read_exactly(file: &mut impl Read, length: u64, limit: u64) -> Result<Vec<u8>, String> {
    if length > limit {
        return Err(format!("its metadata claims {length} bytes"));
    }
    let mut bytes = Vec::new();
    file.take(length).read_to_end(&mut bytes).map_err(|error| error.to_string())?;
    if bytes.len() as u64 == length { Ok(bytes) } else { Err("it ends within its metadata".into()) }
}
