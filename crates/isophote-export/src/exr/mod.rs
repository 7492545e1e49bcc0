//! All channels in 32-bit floating point, for programs that display and combine layers of light.
//!
//! | channel of the map | in the file |
//! |---|---|
//! | brightness | `Y`; in a scene with colours, the luminance of `R`, `G`, `B` |
//! | color | `R`, `G`, `B` |
//! | irradiance, diffuse, specular | `irradiance.Y`, `diffuse.Y`, `specular.Y` |
//! | depth (along the ray) | `Z` |
//! | position, normal | `P.X` `P.Y` `P.Z`, `N.X` `N.Y` `N.Z` |
//! | shape | `shape.index`, −1 where no surface is seen |
//! | irradiance from one light | `light.<name>.Y`; characters other than letters, digits, `-` and `_` become `_` |
//!
//! The standard attribute `chromaticities` identifies the colour space of a scene with colours. The data window is the
//! map's region, the display window the full image.

mod attributes;
mod blocks;
mod channel_names;
mod planes;
mod read;
mod scratch;

use std::io::{Seek, Write};
use std::num::NonZeroUsize;

use exr::meta::BlockDescription;
use exr::meta::attribute::{ChannelDescription, SampleType};
use exr::meta::header::Header;
use exr::prelude::{Compression, LineOrder};
use isophote::map::{Map, Region};
use isophote::message;
use isophote::text::Message;

use crate::error::ExportError;
use crate::format::Format;
use attributes::text;
use planes::Plane;

pub(crate) use read::read_json;

/// Writes one part with all channels of the map, lossless except for the rounding to 32 bits (relative 6e-8; values
/// below 1.2e-38 lose digits and below 7e-46 become 0).
///
/// Attributes: `isophote` (the metadata as JSON), `units` (one line per channel), `comments`, `software`; all UTF-8.
///
/// `threads` threads compress; the bytes do not depend on their number. The output must be seekable, because the offset
/// table of the blocks precedes the pixels and is known only at the end.
///
/// # Errors
/// A value or index that 32 bits cannot hold; an image beyond the format's coordinates; an error of `out`.
pub fn write(map: &Map, threads: NonZeroUsize, out: impl Write + Seek) -> Result<(), ExportError> {
    check_extent(map)?;
    let names = channel_names::of(map);
    let planes = planes(map, &names)?;
    let size = map.region.size;
    let channels = planes.iter().map(|plane| ChannelDescription::named(text(plane.name), SampleType::F32)).collect();
    let header = Header::new(text(""), (size.width as usize, size.height as usize), channels)
        .with_encoding(Compression::ZIP16, BlockDescription::ScanLines, LineOrder::Increasing)
        .with_attributes(attributes::of_layer(map, &names))
        .with_shared_attributes(attributes::of_image(map, &names));
    let headers = std::iter::once(header).collect();
    exr::block::write(out, headers, true, |_, chunks| blocks::write(map, &planes, threads, chunks)).map_err(from_exr)
}

/// All channels of the file, in the order that the format requires; fails for values that 32 bits cannot hold.
fn planes<'m>(map: &'m Map, names: &'m [Vec<String>]) -> Result<Vec<Plane<'m>>, ExportError> {
    let mut planes = Vec::new();
    for (channel, names) in map.channels().iter().zip(names) {
        for (component, name) in names.iter().enumerate() {
            let plane = Plane::new(name, &channel.values, component);
            if let Some((index, value)) = plane.overflow(map.mask()) {
                return Err(ExportError::Overflow { name: channel.quantity.name(), value, pixel: map.pixel(index) });
            }
            planes.push(plane);
        }
    }
    planes.sort_unstable_by_key(|plane| plane.name);
    Ok(planes)
}

/// The format's coordinates are signed, and programs agree only on half of their range.
fn check_extent(map: &Map) -> Result<(), ExportError> {
    let Region { corner, size } = map.region;
    let ends = [corner.column.saturating_add(size.width), corner.row.saturating_add(size.height)];
    match [map.full.width, map.full.height].into_iter().chain(ends).find(|end| *end > LARGEST_COORDINATE) {
        None => Ok(()),
        Some(end) => Err(ExportError::Unsuitable {
            format: Format::Exr,
            reason: message!("the image reaches to {end}, its coordinates to {most}", end, most = LARGEST_COORDINATE),
        }),
    }
}

const LARGEST_COORDINATE: u32 = (1 << 30) - 2;

fn from_exr(error: exr::error::Error) -> ExportError {
    match error {
        exr::error::Error::Io(reason) => ExportError::Write(reason),
        other => ExportError::Unsuitable { format: Format::Exr, reason: Message::verbatim(other.to_string()) },
    }
}
