use std::fs;
use std::io::Cursor;
use std::path::Path;

use isophote::map::Quantity;
use isophote::units::Keyword;

use super::{encode, encoded, sample};
use crate::png::{PictureColor, PictureOptions};
use crate::{
    ExportError, FileMetadata, Format, PictureMetadata, ReadError, read_metadata, read_metadata_from, write_atomically,
};

fn read_bytes(bytes: &[u8]) -> Result<FileMetadata, ReadError> {
    read_metadata_from(Cursor::new(bytes), Path::new("no suffix"))
}

#[test]
fn every_format_carries_the_scene_and_all_that_describes_its_numbers() {
    let map = sample();
    let whole = FileMetadata::of(&map);
    assert_eq!(whole.scene, map.provenance.scene);
    for format in Format::ALL {
        let mut metadata = read_bytes(&encoded(&map, *format).unwrap()).unwrap();
        let several = !matches!(format, Format::Png | Format::Npy);
        assert_eq!(metadata.channels.len(), if several { 7 } else { 1 }, "{}", format.name());
        for channel in &mut metadata.channels {
            assert_eq!(channel.stored_as.is_empty(), !several, "{}", format.name());
            channel.stored_as.clear();
        }
        let channels = if several { whole.channels.clone() } else { whole.channels[..1].to_vec() };
        let picture = metadata.picture.take();
        assert_eq!(picture.is_some(), *format == Format::Png);
        assert_eq!(metadata, FileMetadata { channels, ..whole.clone() }, "{}", format.name());
    }
}

#[test]
fn windows_survive_to_the_last_bit() {
    let mut map = sample();
    // Out of ten million decimals of these forms, parsers that are only nearly correct misread some.
    map.window.x = [-0.1 - 0.2, 1.0 / 3.0];
    map.window.y = [-1.797_693_134_862_315_7e308, 5e-324];
    for format in Format::ALL {
        assert_eq!(read_bytes(&encoded(&map, *format).unwrap()).unwrap().window, map.window, "{}", format.name());
    }
}

#[test]
fn a_picture_says_how_numbers_became_colours() {
    let mut bytes = Vec::new();
    let color = Some(PictureColor { name: "viridis", color: &|_| [1, 2, 3] });
    let options =
        PictureOptions { range: Some([0.5, 1.5]), gamma: 2.2, color, ..PictureOptions::new(Quantity::Brightness) };
    crate::png::write(&sample(), &options, &mut bytes).unwrap();
    let expected = PictureMetadata {
        range: [0.5, 1.5],
        normalization: "max".into(),
        gamma: 2.2,
        depth: 8,
        colormap: Some("viridis".into()),
        encoding: None,
    };
    assert_eq!(read_bytes(&bytes).unwrap().picture, Some(expected));
}

#[test]
fn another_programs_file_is_told_from_a_damaged_one() {
    let mut foreign = Vec::new();
    let mut writer = png::Encoder::new(&mut foreign, 3, 2).write_header().unwrap();
    writer.write_image_data(&[0; 6]).unwrap();
    writer.finish().unwrap();
    let message = read_bytes(&foreign).unwrap_err().to_string();
    assert!(message.ends_with("no suffix’ (png) carries no Isophote metadata"), "{message}");

    let sphere = encoded(&sample(), Format::Npy).unwrap();
    assert!(matches!(read_bytes(&sphere[..200]), Err(ReadError::NoMetadata { format: Format::Npy, .. })));
    assert!(matches!(read_bytes(b"# isophote\nx\n1\n"), Err(ReadError::NoMetadata { format: Format::Csv, .. })));
    assert!(matches!(read_bytes(b"# a,b\n1,2\n"), Err(ReadError::Foreign { .. })), "as are TOML and shell scripts");
    assert!(matches!(read_bytes(b"a,b\n1,2\n"), Err(ReadError::Foreign { .. })));
    assert!(matches!(read_bytes(b""), Err(ReadError::Foreign { .. })));
    assert!(matches!(read_bytes(b"\x89PNG\r\n\x1a\n"), Err(ReadError::Damaged { format: Format::Png, .. })));
}

#[test]
fn a_later_version_is_named_even_when_its_fields_are_others() {
    let message = read_bytes(b"# isophote: {\"isophote\":2,\"new\":true}\n").unwrap_err().to_string();
    assert!(message.ends_with("has metadata of version 2; this program reads up to 1"), "{message}");
    let message = read_bytes(b"# isophote: {\"isophote\":1,\"new\":true}\n").unwrap_err().to_string();
    assert!(message.contains("(csv) is damaged: missing field `program`"), "{message}");
}

#[test]
fn a_file_written_under_a_name_is_read_under_it() -> Result<(), ExportError> {
    let folder = tempfile::tempdir().unwrap();
    for format in Format::ALL {
        let path = folder.path().join("карта").with_extension(format.name());
        write_atomically(&path, |file| encode(&sample(), *format, file))?;
        assert_eq!(fs::read(&path).unwrap(), encoded(&sample(), *format)?, "{}", format.name());
        assert_eq!(read_metadata(&path).unwrap().title, sample().provenance.title);
    }
    let error = read_metadata(&folder.path().join("none.png")).unwrap_err();
    assert!(matches!(error, ReadError::File { .. }));
    Ok(())
}
