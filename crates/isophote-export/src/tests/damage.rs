//! Truncated, altered and lying files in every format: they give an error or the right answer, never a panic or
//! gigabytes of memory.

use std::{io::Cursor, sync::OnceLock};

use isophote::units::Keyword;
use proptest::prelude::*;

use super::{encoded, sample};
use crate::{FileMetadata, Format, read::json_of};

fn read(format: Format, bytes: &[u8]) -> Result<Option<Vec<u8>>, String> {
    json_of(format, &mut Cursor::new(bytes))
}

fn files() -> &'static [(Format, Vec<u8>)] {
    static FILES: OnceLock<Vec<(Format, Vec<u8>)>> = OnceLock::new();
    FILES.get_or_init(|| Format::ALL.iter().map(|format| (*format, encoded(&sample(), *format).unwrap())).collect())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn changed_bits_and_missing_ends_never_panic(
        which in 0..Format::ALL.len(),
        flips in prop::collection::vec((any::<prop::sample::Index>(), 0..8_u8), 0..6),
        // Most lengths are near the ends of a file; changes far inside would miss them.
        near in prop::collection::vec((0..64_usize, any::<bool>(), any::<u8>()), 0..4),
        cut in prop::option::of(any::<prop::sample::Index>()),
    ) {
        let (format, bytes) = &files()[which];
        let mut bytes = bytes.clone();
        for (index, bit) in flips {
            let place = index.index(bytes.len());
            bytes[place] ^= 1 << bit;
        }
        for (distance, at_end, value) in near {
            let place = if at_end { bytes.len() - 1 - distance } else { distance };
            bytes[place] = value;
        }
        if let Some(cut) = cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        if let Ok(Some(json)) = read(*format, &bytes) {
            let _ = serde_json::from_slice::<FileMetadata>(&json);
        }
    }

    #[test]
    fn noise_never_panics(which in 0..Format::ALL.len(), bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let _ = read(Format::ALL[which], &bytes);
    }
}

#[test]
fn every_cut_of_every_format_is_noticed_or_harmless() {
    for (format, bytes) in files() {
        let whole = read(*format, bytes).unwrap().unwrap();
        for length in 0..bytes.len() {
            if let Ok(Some(json)) = read(*format, &bytes[..length]) {
                let shorter_line = *format == Format::Csv && whole.starts_with(&json);
                assert!(json == whole || shorter_line, "{} cut at {length}", format.name());
            }
        }
    }
}

#[test]
fn lengths_that_lie_are_refused_without_being_allocated() {
    let claims = |format, bytes: &[u8]| read(format, bytes).unwrap_err();
    let npy = [&b"\x93NUMPY\x01\x00"[..], &[0; 40], &u64::MAX.to_le_bytes(), b"ISOPHOTE"].concat();
    assert_eq!(claims(Format::Npy, &npy), "its metadata claims to be longer than the file");
    let exr = [&b"\x76\x2f\x31\x01\x02\0\0\0isophote\0string\0"[..], &i32::MAX.to_le_bytes(), b"{}"].concat();
    assert_eq!(claims(Format::Exr, &exr), "its metadata claims 2147483647 bytes");
    let exr = [&b"\x76\x2f\x31\x01\x02\0\0\0isophote\0string\0"[..], &1000_i32.to_le_bytes(), b"{}"].concat();
    assert_eq!(claims(Format::Exr, &exr), "it ends within its metadata");
    let png = [&b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\x7f\xff\xff\xff\x7f\xff\xff\xff\x10\x06\0\0\0"[..], &[0; 4]].concat();
    claims(Format::Png, &png);
}

#[test]
fn an_archive_that_claims_countless_members_is_refused() {
    let end = [&b"PK\x06\x06"[..], &44_u64.to_le_bytes(), &[45, 0, 45, 0], &[0; 8]].concat();
    let counts = [1_u64 << 40, 1 << 40, 1 << 50, 1 << 41].map(u64::to_le_bytes).concat();
    let locator = [&b"PK\x06\x07\0\0\0\0"[..], &4_u64.to_le_bytes(), &1_u32.to_le_bytes()].concat();
    let last = [&b"PK\x05\x06\0\0\0\0"[..], &[0xff; 12], &[0, 0]].concat();
    let archive = [b"PK\x03\x04".to_vec(), end, counts, locator, last].concat();
    let refusal = read(Format::Npz, &archive).unwrap_err();
    assert!(refusal.contains("inconsistent number of files"), "{refusal}");
}
