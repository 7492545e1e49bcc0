//! Files: a [`Map`](isophote::map::Map) as a picture, as layers, as arrays, as a table, or as a figure for a report.
//!
//! Every writer takes the map and an output to write to, so that the caller controls names, interrupts and progress;
//! [`write_atomically`] makes the bytes appear under a name only when they are complete. Every file carries a
//! [`FileMetadata`], which [`read_metadata`] reads back, and the same map gives the same bytes on every run.
//!
//! ```
//! use isophote::lanes::Precision;
//! use isophote::map::Quantity;
//! use isophote::prepare::PreparedScene;
//! use isophote::render::{RenderSettings, Renderer, SimdRenderer};
//! use isophote::scene::{Scene, Syntax, library::Starter};
//! use isophote_export::png::PictureOptions;
//!
//! let scene = PreparedScene::new(&Scene::from_text("lab", Starter::Lab.text(), Syntax::Toml)?);
//! let settings = RenderSettings { quantities: vec![Quantity::Brightness], ..RenderSettings::default() };
//! let map = SimdRenderer::new(Precision::Double, None).render(&scene, &settings)?;
//! let mut picture = Vec::new();
//! isophote_export::png::write(&map, &PictureOptions::new(Quantity::Brightness), &mut picture)?;
//! let metadata = isophote_export::read_metadata_from(&mut std::io::Cursor::new(picture), std::path::Path::new("lab.png"))?;
//! assert_eq!(metadata.channels[0].unit, "W/m²");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod atomic;
mod channel;
mod color_scale;
pub mod colormap;
mod colormap_tables;
pub mod csv;
mod error;
pub mod exr;
pub mod figure;
mod format;
mod limits;
pub mod metadata;
pub mod names;
pub mod npy;
pub mod npz;
pub mod png;
pub mod read;
#[cfg(test)]
mod sample_map;
#[cfg(test)]
mod tests;
mod text;

pub use atomic::write_atomically;
pub use error::ExportError;
pub use format::Format;
pub use metadata::{ChannelMetadata, FileMetadata, PictureMetadata};
pub use read::{ReadError, read_metadata, read_metadata_from};
