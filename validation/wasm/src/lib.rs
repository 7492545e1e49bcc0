//! Runs the conformance suite of the core as WebAssembly: `make test-wasm`. The suite itself is that of the core.

pub use isophote::conformance;
