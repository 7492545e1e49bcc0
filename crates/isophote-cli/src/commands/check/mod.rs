//! `isophote check`: the scene as Isophote understands it.

mod amounts;
mod json;
mod text;

use anyhow::Result;

use crate::args::CheckArguments;
use crate::{load, numbers};

/// Checks a scene and prints it.
pub fn run(arguments: &CheckArguments) -> Result<String> {
    let scene = load::scene(&arguments.scene, arguments.quiet, arguments.language.lang)?;
    if arguments.json { numbers::json(&json::of(&scene)) } else { Ok(text::of(&scene, arguments.language.lang)) }
}
