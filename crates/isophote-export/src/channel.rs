//! The channel that a file is made of.

use isophote::map::{Channel, Map, Quantity};

use crate::error::ExportError;

/// The channel asked for, or those that there are.
pub(crate) fn find<'m>(map: &'m Map, quantity: &Quantity) -> Result<&'m Channel, ExportError> {
    map.channel(quantity).ok_or_else(|| ExportError::NoChannel {
        name: quantity.name(),
        available: map.channels().iter().map(|channel| channel.quantity.name()).collect::<Vec<_>>().join(", "),
    })
}
