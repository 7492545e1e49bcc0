//! `bindgen MODULE.wasm FOLDER`: the module and its JavaScript side, for browsers and workers.

use std::env::args;
use std::error::Error;

use wasm_bindgen_cli_support::Bindgen;

fn main() -> Result<(), Box<dyn Error>> {
    let [module, folder] = <[String; 2]>::try_from(args().skip(1).collect::<Vec<_>>())
        .map_err(|_| "usage: bindgen MODULE.wasm FOLDER")?;
    Bindgen::new().input_path(module).web(true)?.typescript(true).generate(folder)?;
    Ok(())
}
