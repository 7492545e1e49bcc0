//! From the words of the command line to values.

use std::num::NonZeroUsize;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use isophote::units::Keyword;
use isophote_zarr::Part;

use crate::numbers;

/// One of a closed set of words.
pub(super) fn keyword<C: Keyword + Send + Sync>() -> impl TypedValueParser<Value = C> {
    let names = C::ALL.iter().map(|choice| choice.name());
    PossibleValuesParser::new(names).try_map(|name| C::from_name(&name).ok_or("no such word"))
}

pub(super) fn point(text: &str) -> Result<[f64; 3], String> {
    numbers::finite(text, "X,Y,Z, such as 0,0,4")
}

pub(super) fn direction(text: &str) -> Result<[f64; 3], String> {
    let direction: [f64; 3] = numbers::finite(text, "X,Y,Z, such as 0,1,0")?;
    let largest = direction.iter().fold(0.0_f64, |largest, component| largest.max(component.abs()));
    if (1e-100..=1e100).contains(&largest) { Ok(direction) } else { Err("allowed: any direction with a length".into()) }
}

pub(super) fn angles(text: &str) -> Result<[f64; 2], String> {
    numbers::finite(text, "THETA,PHI in degrees, such as 45,90")
}

pub(super) fn number(text: &str) -> Result<f64, String> {
    let [number] = numbers::finite(text, "a number, such as 0.5")?;
    Ok(number)
}

pub(super) fn line(text: &str) -> Result<[f64; 4], String> {
    numbers::finite(text, "X0,Y0,X1,Y1, such as -1,0,1,0")
}

pub(super) fn range(text: &str) -> Result<[f64; 2], String> {
    let range: [f64; 2] = numbers::finite(text, "MIN,MAX, such as 0,0.5")?;
    if range[0] < range[1] { Ok(range) } else { Err("MIN must be smaller than MAX".into()) }
}

/// Tens of thousands of threads would bring the machine to a standstill before the system refuses the next one.
pub(super) fn threads(text: &str) -> Result<NonZeroUsize, String> {
    let threads = text.parse().ok().filter(|threads: &NonZeroUsize| threads.get() <= 1024);
    threads.ok_or_else(|| "allowed: 1 to 1024".into())
}

pub(super) fn part(text: &str) -> Result<Part, String> {
    let part =
        text.split_once('/').and_then(|(number, of)| Part::new(number.trim().parse().ok()?, of.trim().parse().ok()?));
    part.ok_or_else(|| "expected I/N with I from 1 to N, such as 3/16".into())
}

pub(super) fn gamma(text: &str) -> Result<f64, String> {
    let gamma: f64 = text.parse().map_err(|_| "expected a number".to_owned())?;
    if (0.1..=10.0).contains(&gamma) { Ok(gamma) } else { Err("allowed: 0.1 to 10".into()) }
}
