//! Every format written from one small map and read back by a reader that is not ours.

mod color;
mod damage;
mod exr;
mod metadata;
mod numpy;
mod png;
mod table;
mod zip64;

use std::io::{self, Cursor, Seek, SeekFrom, Write};

use super::{ExportError, Format, csv, npy, npz, png::PictureOptions};
use crate::{
    map::{Channel, Coordinates, Map, Mask, Pixel, Provenance, Quantity, Region, Resolution, Values, Window},
    units::{Keyword, LengthUnit},
};

/// Two rows of three pixels out of a larger image, two of them missed; with the numbers and names that formats trip
/// over.
fn sample() -> Map {
    let scalar = |quantity, unit: &str, values: [f64; 6]| Channel {
        quantity,
        unit: unit.into(),
        values: Values::Scalar(values.into()),
    };
    let vector = |quantity, unit: &str, values: [[f64; 3]; 6]| Channel {
        quantity,
        unit: unit.into(),
        values: Values::Vector(values.into()),
    };
    let third = 1.0 / 3.0;
    let (miss, up) = ([0.0; 3], [0.0, 0.0, 1.0]);
    Map {
        full: Resolution { width: 5, height: 4 },
        region: Region { corner: Pixel { column: 1, row: 2 }, size: Resolution { width: 3, height: 2 } },
        window: Window {
            x: [-1.5, 1.5],
            y: [-2.0, 0.0],
            length: LengthUnit::Millimetre,
            coordinates: Coordinates::Screen,
        },
        provenance: Provenance {
            program: "isophote 0.1.0".into(),
            title: "Сфера, \"пример\" # 1\nвторая строка".into(),
            scene: "version = 1\n[sphere]\nradius = 1.0 # мм\n".into(),
            convention: "lab (3.3)".into(),
            renderer: "cpu, double".into(),
            color_space: None,
        },
        channels: vec![
            scalar(Quantity::Brightness, "W/m²", [0.5, 0.0, 2.0, 0.1, 1.0, 0.0]),
            scalar(Quantity::Irradiance, "W/m²", [-1.5, 0.0, 1e30, 1e-300, third, 0.0]),
            Channel { quantity: Quantity::Shape, unit: String::new(), values: Values::Index(vec![0, -1, 7, 0, 1, -1]) },
            vector(Quantity::Position, "mm", [[-1.0, third, 1e-7], miss, [1e5, -0.0, 2.5], up, up, miss]),
            vector(Quantity::Normal, "1", [[third, -third, third], miss, up, up, up, miss]),
            scalar(Quantity::Light("лампа".into()), "W/m²", [0.25, 0.0, 123_456_789.125, 0.0, 1e16, 0.0]),
            scalar(Quantity::Light("a, \"b\" #/../c.".into()), "W/m²", [0.25, 0.0, 3.0, 4.0, 5e-324, 0.0]),
        ],
        mask: Mask::of_shapes(Resolution { width: 3, height: 2 }, &[0, -1, 7, 0, 1, -1]),
    }
}

fn only(map: &mut Map, brightness: &[f64]) {
    let shapes = vec![0; brightness.len()];
    map.region.size = Resolution { width: u32::try_from(brightness.len()).unwrap(), height: 1 };
    map.mask = Mask::of_shapes(map.region.size, &shapes);
    map.channels = vec![
        Channel { quantity: Quantity::Brightness, unit: "W/m²".into(), values: Values::Scalar(brightness.into()) },
        Channel { quantity: Quantity::Shape, unit: String::new(), values: Values::Index(shapes) },
    ];
}

/// So many pixels of one row or many, seen where the value is not 0.
fn rows(width: u32, brightness: &[f64]) -> Map {
    let mut map = sample();
    only(&mut map, brightness);
    let shapes: Vec<i32> = brightness.iter().map(|value| if *value == 0.0 { -1 } else { 0 }).collect();
    map.region.size = Resolution { width, height: u32::try_from(brightness.len()).unwrap() / width };
    map.mask = Mask::of_shapes(map.region.size, &shapes);
    map.channels[1].values = Values::Index(shapes);
    map
}

/// The same map with its scalar channels in single precision.
#[expect(clippy::cast_possible_truncation, reason = "that is what it is for")]
fn in_single_precision(map: &Map) -> Map {
    let mut map = map.clone();
    for channel in &mut map.channels {
        if let Values::Scalar(values) = &channel.values {
            channel.values = Values::Single(values.iter().map(|value| *value as f32).collect());
        }
    }
    map
}

fn encode(map: &Map, format: Format, out: &mut (impl Write + Seek)) -> Result<(), ExportError> {
    match format {
        Format::Png => super::png::write(map, &PictureOptions::new(Quantity::Brightness), out).map(|_| ()),
        Format::Exr => super::exr::write(map, out),
        Format::Npy => npy::write(map, &Quantity::Brightness, out),
        Format::Npz => npz::write(map, out),
        Format::Csv => csv::write(map, csv::Rows::All, out).map(|_| ()),
    }
}

fn encoded(map: &Map, format: Format) -> Result<Vec<u8>, ExportError> {
    let mut out = Cursor::new(Vec::new());
    encode(map, format, &mut out)?;
    Ok(out.into_inner())
}

#[test]
fn the_same_map_gives_the_same_bytes() {
    // Enough rows for many compressed blocks, which several threads finish in any order.
    let mut tall = sample();
    only(&mut tall, &(0..8 * 1000).map(|index| f64::from(index).sqrt()).collect::<Vec<_>>());
    tall.region.size = Resolution { width: 8, height: 1000 };
    tall.mask = Mask::of_shapes(tall.region.size, &vec![0; 8 * 1000]);
    for (map, format) in Format::ALL.iter().flat_map(|format| [(sample(), *format), (tall.clone(), *format)]) {
        let first = encoded(&map, format).unwrap();
        let second = std::thread::spawn(move || encoded(&map, format).unwrap()).join().unwrap();
        assert!(first == second, "{}", format.name());
    }
}

#[test]
fn a_suffix_in_either_case_tells_the_format() {
    let of = |name: &str| Format::from_path(std::path::Path::new(name));
    assert_eq!(of("a/b.c/Map.PNG"), Some(Format::Png));
    assert_eq!(of("карта.eXr"), Some(Format::Exr));
    assert_eq!(of("x.npy.npz"), Some(Format::Npz));
    assert_eq!([of("png"), of(".csv"), of("map.jpeg"), of("map.")], [None; 4]);
}

#[test]
fn a_channel_that_is_not_there_is_named_with_those_that_are() {
    let mut map = sample();
    only(&mut map, &[1.0]);
    let error = npy::write(&map, &Quantity::Depth, &mut Vec::new()).unwrap_err();
    assert_eq!(error.to_string(), "no channel ‘depth’ in this map: it has brightness, shape");
}

/// A disk with room for so many bytes, over which a writer may go back and forth.
struct Disk {
    file: Cursor<Vec<u8>>,
    room: usize,
}

impl Write for Disk {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.room = self.room.checked_sub(bytes.len()).ok_or(io::Error::other("disk full"))?;
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Seek for Disk {
    fn seek(&mut self, target: SeekFrom) -> io::Result<u64> {
        self.file.seek(target)
    }
}

#[test]
fn a_disk_that_fills_up_at_any_moment_is_an_error() {
    let map = sample();
    for format in Format::ALL {
        // The archive's writer goes back to fill in sizes: there every byte is another situation.
        let step = if *format == Format::Npz { 1 } else { 29 };
        for room in (0..encoded(&map, *format).unwrap().len()).step_by(step) {
            let error = encode(&map, *format, &mut Disk { file: Cursor::default(), room }).unwrap_err();
            assert_eq!(error.to_string(), "cannot write: disk full", "{} with room for {room}", format.name());
        }
    }
}
