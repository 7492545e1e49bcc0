//! Numbers as arguments and as JSON.

use std::io;
use std::str::FromStr;

use isophote::map::{Pixel, Region, Resolution};
use isophote::text::significant;

/// `1,2,3`: N comma-separated numbers.
pub fn list<T: FromStr, const N: usize>(text: &str, form: &str) -> Result<[T; N], String> {
    let numbers: Option<Vec<T>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
    numbers.and_then(|numbers| numbers.try_into().ok()).ok_or_else(|| format!("expected {form}"))
}

/// Finite, comma-separated numbers.
pub fn finite<const N: usize>(text: &str, form: &str) -> Result<[f64; N], String> {
    let numbers: [f64; N] = list(text, form)?;
    match numbers.iter().find(|number| !number.is_finite()) {
        Some(number) => Err(format!("{number} is not a finite number")),
        None => Ok(numbers),
    }
}

/// `800x600`.
pub fn size(text: &str) -> Result<Resolution, String> {
    let sides = text.split_once(['x', 'X', '×']);
    let size = sides.and_then(|(width, height)| {
        Some(Resolution { width: width.trim().parse().ok()?, height: height.trim().parse().ok()? })
    });
    size.ok_or_else(|| "expected WIDTHxHEIGHT, such as 1920x1080".into())
}

/// `100,50,640,480`.
pub fn region(text: &str) -> Result<Region, String> {
    let [column, row, width, height] = list(text, "COLUMN,ROW,WIDTH,HEIGHT in pixels, such as 100,50,640,480")?;
    Ok(Region { corner: Pixel { column, row }, size: Resolution { width, height } })
}

/// `400,300`.
pub fn pixel(text: &str) -> Result<Pixel, String> {
    let [column, row] = list(text, "COLUMN,ROW in whole pixels from 0, such as 400,300")?;
    Ok(Pixel { column, row })
}

/// `512M`: bytes; suffixes are powers of 1024.
pub fn memory(text: &str) -> Result<u64, String> {
    let text = text.trim();
    let units = [('K', 10), ('M', 20), ('G', 30), ('T', 40)];
    let size = units.into_iter().find_map(|(unit, power)| {
        let number = text.strip_suffix([unit, unit.to_ascii_lowercase()])?;
        number.parse::<u64>().ok()?.checked_mul(1 << power)
    });
    size.ok_or_else(|| "expected a whole number and K, M, G or T, such as 512M".into())
}

/// JSON text whose numbers have 17 significant digits, enough to distinguish any two doubles.
pub fn json(value: &impl serde::Serialize) -> anyhow::Result<String> {
    let mut bytes = Vec::new();
    let formatter = FullDigits { pretty: serde_json::ser::PrettyFormatter::new() };
    value.serialize(&mut serde_json::Serializer::with_formatter(&mut bytes, formatter))?;
    let mut text = String::from_utf8(bytes)?;
    text.push('\n');
    Ok(text)
}

struct FullDigits<'i> {
    pretty: serde_json::ser::PrettyFormatter<'i>,
}

impl serde_json::ser::Formatter for FullDigits<'_> {
    fn write_f64<W: ?Sized + io::Write>(&mut self, writer: &mut W, value: f64) -> io::Result<()> {
        writer.write_all(significant(value, 17).as_bytes())
    }

    fn begin_array<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.pretty.begin_array(writer)
    }

    fn end_array<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.pretty.end_array(writer)
    }

    fn begin_array_value<W: ?Sized + io::Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        self.pretty.begin_array_value(writer, first)
    }

    fn end_array_value<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.pretty.end_array_value(writer)
    }

    fn begin_object<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.pretty.begin_object(writer)
    }

    fn end_object<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.pretty.end_object(writer)
    }

    fn begin_object_key<W: ?Sized + io::Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        self.pretty.begin_object_key(writer, first)
    }

    fn begin_object_value<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.pretty.begin_object_value(writer)
    }

    fn end_object_value<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.pretty.end_object_value(writer)
    }
}
