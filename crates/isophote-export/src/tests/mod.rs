//! Every format, written from one small map and read back by an independent reader.

mod color;
mod damage;
mod exr;
mod metadata;
mod numpy;
mod png;
mod table;
mod zip64;

use std::io::{self, Cursor, Seek, SeekFrom, Write};
use std::num::NonZeroUsize;

use isophote::map::{
    Channel, Coordinates, Map, MapBuilder, Pixel, Provenance, Quantity, Region, Resolution, Values, Window,
};
use isophote::units::{Keyword, LengthUnit};

use crate::png::PictureOptions;
use crate::{ExportError, Format, csv, npy, npz};

/// A part of a larger image, starting at column 1, row 2.
fn begun(full: Resolution, size: Resolution) -> MapBuilder {
    let window =
        Window { x: [-1.5, 1.5], y: [-2.0, 0.0], length: LengthUnit::Millimetre, coordinates: Coordinates::Screen };
    let provenance = Provenance {
        program: "isophote 0.1.0".into(),
        title: "Сфера, \"пример\" # 1\nвторая строка".into(),
        scene: "version = 1\n[sphere]\nradius = 1.0 # мм\n".into(),
        files: Vec::new(),
        convention: "lab (3.3)".into(),
        renderer: "cpu, double".into(),
        color_space: None,
    };
    Map::builder(full, window, provenance).region(Region { corner: Pixel { column: 1, row: 2 }, size })
}

/// Two rows of three pixels from a larger image, two of them missed; with numbers and names that formats trip over.
fn sample() -> Map {
    let scalar = |values: [f64; 6]| Values::Scalar(values.into());
    let vector = |values: [[f64; 3]; 6]| Values::Vector(values.into());
    let third = 1.0 / 3.0;
    let (miss, up) = ([0.0; 3], [0.0, 0.0, 1.0]);
    let map = begun(Resolution { width: 5, height: 4 }, Resolution { width: 3, height: 2 })
        .channel(Quantity::Brightness, "W/m²", scalar([0.5, 0.0, 2.0, 0.1, 1.0, 0.0]))
        .channel(Quantity::Irradiance, "W/m²", scalar([-1.5, 0.0, 1e30, 1e-300, third, 0.0]))
        .channel(Quantity::Shape, "", Values::Index(vec![0, -1, 7, 0, 1, -1]))
        .channel(Quantity::Position, "mm", vector([[-1.0, third, 1e-7], miss, [1e5, -0.0, 2.5], up, up, miss]))
        .channel(Quantity::Normal, "1", vector([[third, -third, third], miss, up, up, up, miss]))
        .channel(Quantity::Light("лампа".into()), "W/m²", scalar([0.25, 0.0, 123_456_789.125, 0.0, 1e16, 0.0]))
        .channel(Quantity::Light("a, \"b\" #/../c.".into()), "W/m²", scalar([0.25, 0.0, 3.0, 4.0, 5e-324, 0.0]));
    map.build().unwrap()
}

/// A brightness map with rows of `width` pixels, visible where `is_seen` is true.
fn grid(width: usize, brightness: &[f64], is_seen: impl Fn(f64) -> bool) -> Map {
    let [width, height] = [width, brightness.len() / width].map(|side| u32::try_from(side).unwrap());
    let shapes = brightness.iter().map(|value| if is_seen(*value) { 0 } else { -1 }).collect();
    let map = begun(Resolution { width: width + 1, height: height + 2 }, Resolution { width, height })
        .channel(Quantity::Brightness, "W/m²", Values::Scalar(brightness.into()))
        .channel(Quantity::Shape, "", Values::Index(shapes));
    map.build().unwrap()
}

/// A single row, all of it visible.
fn row(brightness: &[f64]) -> Map {
    grid(brightness.len(), brightness, |_| true)
}

/// Rows of `width` pixels, visible where the value is not 0.
fn rows(width: usize, brightness: &[f64]) -> Map {
    grid(width, brightness, |value| value != 0.0)
}

/// The same pixels with other channels.
fn with_channels(map: &Map, channels: impl IntoIterator<Item = Channel>) -> Map {
    let mut builder = begun(map.full, map.region.size);
    for Channel { quantity, unit, values } in channels {
        builder = builder.channel(quantity, &unit, values);
    }
    builder.build().unwrap()
}

/// The same map with its scalar channels in single precision.
#[expect(clippy::cast_possible_truncation, reason = "that is what it is for")]
fn in_single_precision(map: &Map) -> Map {
    let single = |channel: &Channel| match &channel.values {
        Values::Scalar(values) => {
            Channel { values: Values::Single(values.iter().map(|value| *value as f32).collect()), ..channel.clone() }
        }
        _ => channel.clone(),
    };
    with_channels(map, map.channels().iter().map(single))
}

/// More than one, so that blocks may finish in any order.
const THREADS: NonZeroUsize = NonZeroUsize::new(3).unwrap();

fn encode(map: &Map, format: Format, out: &mut (impl Write + Seek)) -> Result<(), ExportError> {
    match format {
        Format::Png => crate::png::write(map, &PictureOptions::new(Quantity::Brightness), out).map(|_| ()),
        Format::Exr => crate::exr::write(map, THREADS, out),
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
    let tall = grid(8, &(0..8 * 1000).map(|index| f64::from(index).sqrt()).collect::<Vec<_>>(), |_| true);
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
    let error = npy::write(&row(&[1.0]), &Quantity::Depth, &mut Vec::new()).unwrap_err();
    assert_eq!(error.to_string(), "no channel ‘depth’ in this map: it has brightness, shape");
}

/// A disk with limited space, on which a writer may seek.
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
        // The archive writer seeks back to fill in sizes, so every byte there is a different situation.
        let step = if *format == Format::Npz { 1 } else { 29 };
        for room in (0..encoded(&map, *format).unwrap().len()).step_by(step) {
            let error = encode(&map, *format, &mut Disk { file: Cursor::default(), room }).unwrap_err();
            assert_eq!(error.to_string(), "cannot write: disk full", "{} with room for {room}", format.name());
        }
    }
}
