//! Who may use whom: the table of layers in ARCHITECTURE.md, checked against the `use` lines of the code.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Modules by name, with those that each uses.
type Uses = BTreeMap<String, BTreeSet<String>>;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The Rust files below a folder, without those of tests.
fn sources(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().and_then(|name| name.to_str()).unwrap_or_default();
        if name == "tests" {
            continue;
        }
        if path.is_dir() {
            sources(&path, files);
        } else if path.extension().is_some_and(|suffix| suffix == "rs") {
            files.push(path);
        }
    }
}

/// The modules directly under `crate::` that each of them names, outside of tests and comments.
fn uses(crate_folder: &str) -> Uses {
    let folder = root().join(crate_folder).join("src");
    let mut files = Vec::new();
    sources(&folder, &mut files);
    let mut uses = Uses::new();
    for file in files {
        let inner = file.strip_prefix(&folder).unwrap();
        let module = inner.components().next().unwrap().as_os_str().to_str().unwrap().trim_end_matches(".rs");
        if matches!(module, "lib" | "main" | "sample_map") {
            continue;
        }
        let text = fs::read_to_string(&file).unwrap();
        let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
        let used = uses.entry(module.to_owned()).or_default();
        for line in code.lines().filter(|line| !line.trim_start().starts_with("//")) {
            for rest in line.split("crate::").skip(1) {
                let name: String = rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
                if !name.is_empty() && name != module {
                    used.insert(name);
                }
            }
        }
    }
    let known: BTreeSet<String> = uses.keys().cloned().collect();
    for used in uses.values_mut() {
        used.retain(|name| known.contains(name));
    }
    uses
}

/// The rows of the table: a module, and those that it may use.
fn table() -> Vec<(String, BTreeSet<String>)> {
    let text = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let section = text.split("## Layers").nth(1).expect("ARCHITECTURE.md has a section \"Layers\"");
    let section = section.split("\n## ").next().unwrap();
    let names = |cell: &str| cell.split('`').skip(1).step_by(2).map(str::to_owned).collect::<Vec<_>>();
    let rows = section.lines().filter(|line| line.starts_with("| `")).flat_map(|line| {
        let mut cells = line.trim_matches('|').split('|');
        let (modules, allowed) = (names(cells.next().unwrap()), names(cells.next().unwrap_or_default()));
        modules.into_iter().map(move |module| (module, allowed.iter().cloned().collect()))
    });
    rows.collect()
}

#[test]
fn modules_of_the_core_use_only_those_that_the_table_allows() {
    let (uses, table) = (uses("crates/isophote"), table());
    let mut above = BTreeSet::new();
    for (module, allowed) in &table {
        let used = uses.get(module).unwrap_or_else(|| panic!("the table names `{module}`, which is no module"));
        let forbidden: Vec<_> = used.difference(allowed).collect();
        assert!(forbidden.is_empty(), "`{module}` uses {forbidden:?}, which the table does not allow");
        let stale: Vec<_> = allowed.difference(used).collect();
        assert!(stale.is_empty(), "the table allows `{module}` to use {stale:?}, which it does not");
        let upwards: Vec<_> = allowed.difference(&above).collect();
        assert!(upwards.is_empty(), "`{module}` may use {upwards:?}, which stand below it in the table");
        above.insert(module.clone());
    }
    let missing: Vec<_> = uses.keys().filter(|module| !above.contains(*module)).collect();
    assert!(missing.is_empty(), "the table lacks {missing:?}");
}

#[test]
fn no_two_modules_of_another_crate_use_each_other() {
    for crate_folder in ["crates/isophote-export", "crates/isophote-zarr", "crates/isophote-cli", "python"] {
        let mut uses = uses(crate_folder);
        // Takes away what uses nothing that is left, again and again: what stays is a circle.
        while let Some(module) = uses.iter().find(|(_, used)| used.is_empty()).map(|(module, _)| module.clone()) {
            uses.remove(&module);
            for used in uses.values_mut() {
                used.remove(&module);
            }
        }
        assert!(uses.is_empty(), "{crate_folder}: these use each other in a circle: {uses:?}");
    }
}
