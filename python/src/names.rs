//! Names that stand for members of closed sets, and for channels.

use isophote::map::Quantity;
use isophote::units::Keyword;
use pyo3::prelude::*;

use crate::error;

/// Looks up a member of a closed set by name.
pub fn keyword<C: Keyword>(py: Python<'_>, what: &str, name: &str) -> PyResult<C> {
    let allowed = || C::ALL.iter().map(|choice| choice.name()).collect::<Vec<_>>().join(", ");
    C::from_name(name).ok_or_else(|| error::value(py, format!("there is no {what} \"{name}\"; allowed: {}", allowed())))
}

/// Channels by name. Whether the scene has the lights they refer to is checked later, when they are computed.
pub fn quantities(py: Python<'_>, names: &[String]) -> PyResult<Vec<Quantity>> {
    let quantity = |name: &String| {
        let known = Quantity::COMMON
            .iter()
            .chain(&Quantity::OF_SAMPLING)
            .chain(&Quantity::OF_CAMERA)
            .chain([&Quantity::Material, &Quantity::Color]);
        let allowed = || known.map(Quantity::name).collect::<Vec<_>>().join(", ");
        Quantity::from_name(name).ok_or_else(|| {
            error::value(
                py,
                format!("there is no channel \"{name}\"; allowed: {}, light.NAME, brightness.NAME", allowed()),
            )
        })
    };
    names.iter().map(quantity).collect()
}
