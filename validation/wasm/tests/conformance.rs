//! The conformance suite of the core; elsewhere than on WebAssembly the core's own tests run it.
#![cfg(target_family = "wasm")]

#[path = "../../../crates/isophote/tests/conformance.rs"]
mod conformance;
