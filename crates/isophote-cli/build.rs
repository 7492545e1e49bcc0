//! Finds the app, if `make app` has built it: a page that `isophote app` serves. Without it the program is built all the same, and says
//! what is missing when it is asked for the page.

use std::path::Path;
use std::{env, fs};

fn main() {
    let folder = Path::new("../../web/dist");
    let page = folder.join("isophote.html.gz");
    let value = if let Ok(page) = fs::canonicalize(&page) {
        println!("cargo::rerun-if-changed={}", page.display());
        format!("Some(include_bytes!({:?}))", page.display().to_string())
    } else {
        // The folder is always there, and changes when the page is built. Cargo takes a missing file for one that has changed.
        println!("cargo::rerun-if-changed={}", folder.display());
        "None".into()
    };
    let target = Path::new(&env::var_os("OUT_DIR").expect("Cargo says where")).join("page.rs");
    fs::write(target, value).expect("the folder is Cargo's");
}
