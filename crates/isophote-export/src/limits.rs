//! How much is read of a file, whatever it claims.

use std::io::Read;

/// Longer descriptions are taken for damage: none that this program writes comes near, and a lying length must not
/// take all memory. In bytes.
pub(crate) const LONGEST_JSON: u64 = 64 << 20;

/// Exactly so many bytes; memory grows with what the file really has, not with what it claims.
pub(crate) fn read_exactly(file: &mut impl Read, length: u64, limit: u64) -> Result<Vec<u8>, String> {
    if length > limit {
        return Err(format!("its metadata claims {length} bytes"));
    }
    let mut bytes = Vec::new();
    file.take(length).read_to_end(&mut bytes).map_err(|error| error.to_string())?;
    if bytes.len() as u64 == length { Ok(bytes) } else { Err("it ends within its metadata".into()) }
}
