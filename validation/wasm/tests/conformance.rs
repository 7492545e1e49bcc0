//! The conformance suite of the core; elsewhere than in a browser's WebAssembly the core's own tests run it.
#![cfg(all(target_family = "wasm", target_os = "unknown"))]

#[path = "../../../crates/isophote/tests/conformance.rs"]
mod conformance;

/// What the suite otherwise gets from the system.
mod system {
    use std::path::Path;
    use std::sync::{Once, OnceLock};

    use isophote::import::MemoryFiles;
    use wasm_bindgen::prelude::wasm_bindgen;

    const FILES: &[(&str, &[u8])] = &include!(concat!(env!("OUT_DIR"), "/scenes.rs"));

    #[wasm_bindgen]
    extern "C" {
        #[wasm_bindgen(js_namespace = console)]
        fn error(message: &str);

        #[wasm_bindgen(js_namespace = Math)]
        fn random() -> f64;
    }

    /// What the random numbers of a test start from, which is told if it fails.
    static SEED: OnceLock<f64> = OnceLock::new();

    /// The seed of random scenes: another one each time.
    pub fn seed() -> u64 {
        SEED.get_or_init(random).to_bits()
    }

    /// Has the runner print why a test fails: here, a panic ends the program without a word.
    pub fn report_panics() {
        static ONCE: Once = Once::new();
        ONCE.call_once(|| {
            std::panic::set_hook(Box::new(|panic| error(&format!("{panic}\nSEED={:?}", SEED.get()))));
        });
    }

    /// The names of the scene files of the repository.
    pub fn scene_names() -> Vec<String> {
        let names = FILES.iter().map(|(name, _)| *name).filter(|name| !name.contains('/'));
        names
            .filter(|name| Path::new(name).extension().is_some_and(|suffix| suffix == "toml"))
            .map(str::to_owned)
            .collect()
    }

    /// These and the files they name.
    pub fn files() -> MemoryFiles {
        FILES.iter().copied().collect()
    }
}
