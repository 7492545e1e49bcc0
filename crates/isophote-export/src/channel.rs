//! The channel to export.

use isophote::map::{Channel, Map, Quantity};

use crate::error::ExportError;

/// The requested channel, or an error that lists the channels in the map.
pub(crate) fn find<'m>(map: &'m Map, quantity: &Quantity) -> Result<&'m Channel, ExportError> {
    map.channel(quantity).ok_or_else(|| ExportError::NoChannel {
        name: quantity.name(),
        available: map.channels().iter().map(|channel| channel.quantity.name()).collect::<Vec<_>>().join(", "),
    })
}
