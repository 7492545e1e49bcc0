//! `isophote new`: a scene file to start from.

use std::path::{Path, PathBuf};

use anyhow::Result;
use isophote::message;
use isophote::units::Keyword;
use isophote_export::write_atomically;

use crate::args::NewArguments;
use crate::failure::Usage;

/// Writes a starter scene.
pub fn run(arguments: &NewArguments) -> Result<String> {
    let name = arguments.name.name();
    let text = arguments.name.text_in(arguments.lang);
    let path = arguments.output.clone().unwrap_or_else(|| PathBuf::from(format!("{name}.toml")));
    if path == Path::new("-") {
        return Ok(text.to_owned());
    }
    if path.exists() && !arguments.force {
        return Err(Usage(message!("{path} exists; --force overwrites it", path = path.display())).into());
    }
    write_atomically(&path, |file| Ok(std::io::Write::write_all(file, text.as_bytes())?))?;
    Ok(format!("{}\n", path.display()))
}
