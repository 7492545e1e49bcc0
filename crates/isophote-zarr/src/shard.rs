//! Shards as bytes: the codec [`sharding_indexed`] of Zarr v3, with the codecs that our arrays use inside it.
//!
//! A shard is a square of chunks. Its file holds the chunks row by row, and then an index with the offset and the
//! length of each. Each chunk is compressed by zstd, and its CRC-32C follows, as that of the index follows the index. A
//! chunk of nothing but fill values is not stored; its entry in the index has all bits set. All numbers are
//! little-endian.
//!
//! `tests/store/python.rs` has zarr-python read such files.
//!
//! [`sharding_indexed`]: https://zarr-specs.readthedocs.io/en/latest/v3/codecs/sharding-indexed/index.html

use std::io::Cursor;

use serde_json::{Value, json};
use zstd_safe::{CCtx, CParameter, DCtx};

/// The fastest level of zstd: on smooth maps higher levels save little and take long.
const LEVEL: i32 = 1;
/// Bytes of a CRC-32C.
const CHECKSUM: usize = 4;
/// A chunk's entry in the index: its offset in the file and its length, 8 bytes each.
type Entry = [u8; 16];
/// The entry of a chunk that is not stored.
const EMPTY: Entry = [0xff; 16];

/// How a shard is divided into chunks.
#[derive(Clone, Copy, Debug)]
pub struct Layout {
    /// Chunks along each side of the shard.
    pub side: usize,
    /// Bytes of a chunk that is not compressed.
    pub chunk: usize,
    /// The byte of which fill values consist.
    pub fill: u8,
}

impl Layout {
    fn chunks(self) -> usize {
        self.side.saturating_mul(self.side)
    }

    /// Bytes of the index with its checksum.
    fn index(self) -> usize {
        self.chunks().saturating_mul(size_of::<Entry>()).saturating_add(CHECKSUM)
    }
}

/// The codecs of a chunk, as `zarr.json` describes them.
pub fn chunk_codecs() -> Value {
    let zstd = json!({ "name": "zstd", "configuration": { "level": LEVEL, "checksum": false } });
    json!([bytes_codec(), zstd, { "name": "crc32c" }])
}

/// The codecs of a shard with chunks of this shape, as `zarr.json` describes them.
pub fn shard_codecs(chunk_shape: &[u32]) -> Value {
    json!([{
        "name": "sharding_indexed",
        "configuration": {
            "chunk_shape": chunk_shape,
            "codecs": chunk_codecs(),
            "index_codecs": [bytes_codec(), { "name": "crc32c" }],
            "index_location": "end",
        },
    }])
}

fn bytes_codec() -> Value {
    json!({ "name": "bytes", "configuration": { "endian": "little" } })
}

/// The file of a shard; none if all its chunks are fill values. `write` sets every byte of the chunk in a row and a
/// column.
pub fn encode_shard(layout: Layout, mut write: impl FnMut([usize; 2], &mut [u8])) -> Result<Option<Vec<u8>>, String> {
    let mut encoder = encoder()?;
    let empty = vec![layout.fill; layout.chunk];
    let mut chunk = empty.clone();
    // Room for the worst case, so that nothing is ever moved; memory that is not written to costs nothing.
    let mut file = Vec::with_capacity(layout.chunks() * encoded_size(layout.chunk) + layout.index());
    let mut index = Vec::with_capacity(layout.index());
    for row in 0..layout.side {
        for column in 0..layout.side {
            write([row, column], &mut chunk);
            if chunk == empty {
                index.extend(EMPTY);
                continue;
            }
            let offset = file.len();
            append_chunk(&mut encoder, &chunk, &mut file)?;
            for number in [offset, file.len() - offset] {
                index.extend((number as u64).to_le_bytes());
            }
        }
    }
    if file.is_empty() {
        return Ok(None);
    }
    append_checksum(&mut index, 0);
    file.append(&mut index);
    Ok(Some(file))
}

/// The file of an array that is a single chunk.
pub fn encode_chunk(chunk: &[u8]) -> Result<Vec<u8>, String> {
    let mut file = Vec::new();
    append_chunk(&mut encoder()?, chunk, &mut file)?;
    Ok(file)
}

/// Decodes the file of a shard, and hands over each chunk with its row and column, or none for one that is not stored.
///
/// # Errors
/// What is wrong with the file, in words that go with `cannot be decoded`.
pub fn decode_shard(
    layout: Layout,
    file: &[u8],
    mut read: impl FnMut([usize; 2], Option<&[u8]>),
) -> Result<(), String> {
    let short = || format!("its {} bytes are too few for an index of {}", file.len(), layout.index());
    let end = file.len().checked_sub(layout.index()).ok_or_else(short)?;
    let (chunks, index) = file.split_at(end);
    let index = verified(index).map_err(|reason| format!("its index {reason}"))?;
    let mut decoder = DCtx::create();
    let mut buffer = Vec::new();
    for (number, entry) in index.as_chunks().0.iter().enumerate() {
        let place @ [row, column] = [number / layout.side, number % layout.side];
        if *entry == EMPTY {
            read(place, None);
            continue;
        }
        let decoded = stored(chunks, entry).and_then(|chunk| {
            let compressed = verified(chunk)?;
            decompress(&mut decoder, compressed, layout.chunk, &mut buffer)
        });
        decoded.map_err(|reason| format!("its chunk in row {row}, column {column} {reason}"))?;
        read(place, Some(&buffer));
    }
    Ok(())
}

fn encoder() -> Result<CCtx<'static>, String> {
    let mut encoder = CCtx::create();
    encoder.set_parameter(CParameter::CompressionLevel(LEVEL)).map_err(zstd_safe::get_error_name)?;
    Ok(encoder)
}

/// The most bytes that a chunk of this size may take in a file.
fn encoded_size(chunk: usize) -> usize {
    zstd_safe::compress_bound(chunk) + CHECKSUM
}

fn append_chunk(encoder: &mut CCtx<'_>, chunk: &[u8], file: &mut Vec<u8>) -> Result<(), String> {
    let offset = file.len();
    file.reserve(encoded_size(chunk.len()));
    let mut end = Cursor::new(&mut *file);
    end.set_position(offset as u64);
    encoder.compress2(&mut end, chunk).map_err(zstd_safe::get_error_name)?;
    append_checksum(file, offset);
    Ok(())
}

/// Appends the checksum of everything from an offset on.
fn append_checksum(bytes: &mut Vec<u8>, offset: usize) {
    let checksum = crc32c::crc32c(&bytes[offset..]);
    bytes.extend(checksum.to_le_bytes());
}

/// The bytes before a checksum, if it is theirs.
fn verified(bytes: &[u8]) -> Result<&[u8], String> {
    let (bytes, checksum) = bytes.split_last_chunk().ok_or("is too short to have a checksum")?;
    let [found, expected] = [crc32c::crc32c(bytes), u32::from_le_bytes(*checksum)];
    if found == expected { Ok(bytes) } else { Err(format!("has the checksum {found:08x} in place of {expected:08x}")) }
}

/// The chunk that an entry of the index points to.
fn stored<'f>(chunks: &'f [u8], entry: &Entry) -> Result<&'f [u8], String> {
    let (numbers, _) = entry.as_chunks();
    let [offset, length] = [0, 1].map(|number| u64::from_le_bytes(numbers[number]));
    let range = || {
        let start = usize::try_from(offset).ok()?;
        chunks.get(start..start.checked_add(usize::try_from(length).ok()?)?)
    };
    let outside = || format!("has {length} bytes from {offset} on, but the chunks end at {}", chunks.len());
    range().ok_or_else(outside)
}

/// Decompresses a chunk into the buffer, which never gets larger than the chunk should be.
fn decompress(decoder: &mut DCtx<'_>, compressed: &[u8], size: usize, buffer: &mut Vec<u8>) -> Result<(), String> {
    buffer.clear();
    buffer.try_reserve_exact(size).map_err(|error| format!("has no room in memory: {error}"))?;
    let explained = |code| format!("cannot be decompressed to {size} bytes: {}", zstd_safe::get_error_name(code));
    let length = decoder.decompress(buffer, compressed).map_err(explained)?;
    if length == size { Ok(()) } else { Err(format!("holds {length} bytes in place of {size}")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Small numbers that look random.
    fn noise(seed: u32) -> impl Iterator<Item = u8> {
        let next = |state: &u32| Some(state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
        std::iter::successors(Some(seed), next).map(|state| state.to_le_bytes()[3]).skip(1)
    }

    /// Chunks of all sorts: fill values, one value, a ramp, noise, and fill values but for the last byte.
    fn chunk(layout: Layout, number: usize) -> Vec<u8> {
        let size = layout.chunk;
        let noise = noise(number.try_into().unwrap()).take(size);
        match number % 5 {
            0 => vec![layout.fill; size],
            1 => vec![0x3f; size],
            2 => (0..size).map(|place| (place / 8).to_le_bytes()[0]).collect(),
            3 => noise.collect(),
            _ => std::iter::repeat_n(layout.fill, size - 1).chain([0x55]).collect(),
        }
    }

    #[test]
    fn every_chunk_returns_and_its_bytes_depend_on_no_other() {
        for (side, size) in [(1, 8), (3, 24), (4, 96), (4, 4096), (2, 300_000)] {
            for (fill, first) in [(0, 0), (0xff, 1), (0, 3)] {
                let layout = Layout { side, chunk: size, fill };
                let known = |[row, column]: [usize; 2]| chunk(layout, first + row * side + column);
                let file = encode_shard(layout, |place, chunk| chunk.copy_from_slice(&known(place))).unwrap();
                let Some(file) = file else {
                    assert_eq!((side, first), (1, 0), "only this one is all fill values");
                    continue;
                };
                let mut places = Vec::new();
                let mut chunks = Vec::new();
                let read = |place, chunk: Option<&[u8]>| {
                    let known = known(place);
                    assert_eq!(chunk.is_none(), known.iter().all(|byte| *byte == fill), "{place:?}");
                    if let Some(chunk) = chunk {
                        assert!(chunk == known, "{place:?} of {layout:?}");
                        chunks.extend(encode_chunk(chunk).unwrap());
                    }
                    places.push(place);
                };
                decode_shard(layout, &file, read).unwrap();
                let all = (0..side).flat_map(|row| (0..side).map(move |column| [row, column]));
                assert!(places.into_iter().eq(all));
                assert!(file[..file.len() - layout.index()] == chunks);
            }
        }
    }

    const LAYOUT: Layout = Layout { side: 2, chunk: 40, fill: 0 };

    /// A shard of four chunks, the second of which is not stored.
    fn shard() -> Vec<u8> {
        let write = |[row, column]: [usize; 2], bytes: &mut [u8]| {
            bytes.copy_from_slice(&chunk(LAYOUT, [1, 0, 2, 3][2 * row + column]));
        };
        encode_shard(LAYOUT, write).unwrap().unwrap()
    }

    /// What is found wrong with a file.
    fn damage(file: &[u8]) -> String {
        decode_shard(LAYOUT, file, |_, _| {}).unwrap_err()
    }

    /// The shard with one entry of its index replaced, and the right checksum of the index.
    fn with_entry(number: usize, [offset, length]: [u64; 2]) -> Vec<u8> {
        let mut file = shard();
        let index = file.len() - LAYOUT.index();
        file.truncate(file.len() - CHECKSUM);
        file[index + 16 * number..][..8].copy_from_slice(&offset.to_le_bytes());
        file[index + 16 * number + 8..][..8].copy_from_slice(&length.to_le_bytes());
        append_checksum(&mut file, index);
        file
    }

    /// A shard whose third chunk is this, with the right checksums; the others are not stored.
    fn with_chunk(mut file: Vec<u8>) -> Vec<u8> {
        append_checksum(&mut file, 0);
        let end = file.len();
        file.extend([0xff; 32]);
        file.extend([0, end as u64].map(u64::to_le_bytes).as_flattened());
        file.extend([0xff; 16]);
        append_checksum(&mut file, end);
        file
    }

    fn compressed(bytes: &[u8]) -> Vec<u8> {
        let mut chunk = encode_chunk(bytes).unwrap();
        chunk.truncate(chunk.len() - CHECKSUM);
        chunk
    }

    #[test]
    fn every_flipped_bit_and_every_missing_byte_is_found() {
        let file = shard();
        for bit in 0..8 * file.len() {
            let mut flipped = file.clone();
            flipped[bit / 8] ^= 1 << (bit % 8);
            let damage = damage(&flipped);
            assert!(damage.contains(" has the checksum "), "{damage}");
        }
        for length in 0..file.len() {
            let damage = [damage(&file[..length]), damage(&file[file.len() - length..])];
            assert!(length >= LAYOUT.index() || damage[0] == damage[1], "{damage:?}");
        }
        assert_eq!(damage(&[]), "its 0 bytes are too few for an index of 68");
        assert_eq!(damage(&file[..67]), "its 67 bytes are too few for an index of 68");
        assert!(damage(&file[1..]).starts_with("its chunk in row 0, column 0 has the checksum "));
        assert!(damage(&file[..file.len() - 1]).starts_with("its index has the checksum "));
    }

    #[test]
    fn a_chunk_outside_the_file_is_found() {
        let end = (shard().len() - LAYOUT.index()) as u64;
        for [offset, length] in [[end, 1], [0, end + 1], [u64::MAX, 5], [5, u64::MAX], [u64::MAX - 3, 8], [1 << 63; 2]]
        {
            let expected = format!(
                "its chunk in row 1, column 0 has {length} bytes from {offset} on, but the chunks end at {end}"
            );
            assert_eq!(damage(&with_entry(2, [offset, length])), expected);
        }
        for length in 0..4 {
            let expected = "its chunk in row 1, column 1 is too short to have a checksum";
            assert_eq!(damage(&with_entry(3, [7, length])), expected);
        }
        assert!(damage(&with_entry(1, [0, 4])).starts_with("its chunk in row 0, column 1 has the checksum "));
        assert_eq!(decode_shard(LAYOUT, &with_entry(2, [u64::MAX; 2]), |_, _| {}), Ok(()));
    }

    #[test]
    fn a_chunk_that_is_compressed_wrongly_is_found() {
        assert_eq!(decode_shard(LAYOUT, &with_chunk(compressed(&[1; 40])), |_, _| {}), Ok(()));
        let twice = [compressed(&[1; 40]), compressed(&[1; 40])].concat();
        let cut = compressed(&noise(1).take(40).collect::<Vec<_>>())[..30].to_vec();
        for (chunk, expected) in [
            (compressed(&[1; 39]), "holds 39 bytes in place of 40"),
            (vec![], "holds 0 bytes in place of 40"),
            (compressed(&[1; 41]), "cannot be decompressed to 40 bytes: Destination buffer is too small"),
            // A few bytes that would take a lot of memory.
            (compressed(&vec![0; 4 << 20]), "cannot be decompressed to 40 bytes: Destination buffer is too small"),
            (twice, "cannot be decompressed to 40 bytes: Destination buffer is too small"),
            (cut, "cannot be decompressed to 40 bytes: Src size is incorrect"),
            (b"not made by zstd".to_vec(), "cannot be decompressed to 40 bytes: Unknown frame descriptor"),
        ] {
            assert_eq!(damage(&with_chunk(chunk)), format!("its chunk in row 1, column 0 {expected}"));
        }
    }

    #[test]
    fn a_shard_of_impossible_size_is_an_error_and_no_panic() {
        let file = with_chunk(compressed(&[1; 40]));
        let damage = |layout| decode_shard(layout, &file, |_, _| {}).unwrap_err();
        assert!(damage(Layout { chunk: usize::MAX, ..LAYOUT }).contains(" has no room in memory: "));
        assert!(damage(Layout { side: usize::MAX, ..LAYOUT }).contains(" bytes are too few for an index of "));
    }
}
