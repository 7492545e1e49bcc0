//! Embeds the scenes of the repository and the files they name: in a browser's WebAssembly, there are no files.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs};

fn main() {
    let folder = fs::canonicalize("../../scenes").expect("the scenes are there");
    println!("cargo::rerun-if-changed={}", folder.display());
    let mut list = String::from("[");
    for path in files_in(&folder) {
        let name = path.strip_prefix(&folder).expect("it is in the folder").to_str().expect("names are plain");
        write!(list, "({name:?}, include_bytes!({:?}).as_slice()),", path.display().to_string())
            .expect("a text takes it");
    }
    list.push(']');
    let target = Path::new(&env::var_os("OUT_DIR").expect("Cargo says where")).join("scenes.rs");
    fs::write(target, list).expect("the folder is Cargo's");
}

/// The files in a folder and in the folders in it.
fn files_in(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("it is readable").map(|entry| entry.expect("it is readable").path());
    entries.flat_map(|path| if path.is_dir() { files_in(&path) } else { vec![path] }).collect()
}
