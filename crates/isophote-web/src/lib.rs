//! The core in the browser: WebAssembly for the workers of the app. A worker holds one [`Core`] with a scene, and asks it questions;
//! scenes and answers are JSON, maps are arrays. `web/src/engine/types.ts` says what the answers hold.
//!
//! There are no files here but those that the page hands in, by the names that scenes have for them.

mod answers;
mod core;
mod export;
mod files;
mod frame;
mod info;
mod problem;
mod request;
mod section;

use wasm_bindgen::prelude::wasm_bindgen;

pub use crate::core::Core;
pub use crate::frame::Band;

/// The version of the core.
#[wasm_bindgen]
#[must_use]
pub fn version() -> String {
    env!("CARGO_PKG_VERSION").into()
}
