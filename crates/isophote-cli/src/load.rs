//! The scene that a command works on.

use std::path::Path;

use anyhow::Result;
use isophote::message;
use isophote::scene::library::Starter;
use isophote::scene::source::SamplingSource;
use isophote::scene::{CarriedFiles, FileResolver, Resolver, Scene, SceneError, Syntax, error};
use isophote::text::{Language, Message, ToValue};
use isophote_export::{FileMetadata, Format, read_metadata};

use crate::args::{RenderArguments, SceneArgument};
use crate::failure::{self, Usage};
use crate::memory::WithinMemory;

/// Reads the scene and prints its warnings.
pub fn scene(argument: &SceneArgument, quiet: bool, language: Language) -> Result<Scene> {
    let (name, scene) = read(argument, None)?;
    warn(&name, &scene, quiet, language);
    Ok(scene)
}

/// Reads the scene to render, with the overrides from the arguments applied.
pub fn scene_to_render(arguments: &RenderArguments) -> Result<Scene> {
    let (name, mut scene) = read(&arguments.scene, arguments.store.memory)?;
    if let Some(size) = arguments.size {
        scene = scene.with_resolution(size).map_err(|error| wrong("--size", &error))?;
    }
    let sampling = arguments.sampling.source();
    if sampling != SamplingSource::default() {
        scene = scene.with_sampling(&sampling).map_err(|error| wrong(message!("--samples or --tolerance"), &error))?;
    }
    warn(&name, &scene, arguments.quiet, arguments.language.lang);
    Ok(scene)
}

fn warn(name: &str, scene: &Scene, quiet: bool, language: Language) {
    if !quiet && !scene.warnings().is_empty() {
        failure::note_drawn(&error::report_in(name, scene.warnings(), language, failure::use_color()));
    }
}

/// Reads the scene, the files that it names within a limit of memory in bytes.
fn read(argument: &SceneArgument, memory: Option<u64>) -> Result<(String, Scene)> {
    let Some(path) = &argument.scene else {
        let name = "the lab's scene".to_owned();
        let scene = Scene::from_text(&name, Starter::Lab.text(), Syntax::Toml)?;
        return Ok((name, scene));
    };
    let name = path.display().to_string();
    let scene = if path == Path::new("-") {
        let name = "standard input";
        let text = Scene::read_text(&mut std::io::stdin().lock(), name)?;
        let syntax = if text.trim_start().starts_with('{') { Syntax::Json } else { Syntax::Toml };
        within(memory, &FileResolver::new(""), |files| Scene::from_text_with(files, None, name, &text, syntax))?
    } else if Format::from_path(path).is_some() || is_store(path) {
        let no_scene = |error: anyhow::Error| {
            let reason = error.to_string();
            SceneError::unreadable(&name, message!("no scene can be taken out of it: {reason}", reason), None)
        };
        let metadata = metadata(path).map_err(no_scene)?;
        let files = CarriedFiles::of_output(path, &metadata.files);
        within(memory, &files, |files| Scene::from_text_with(files, None, &name, &metadata.scene, Syntax::Toml))?
    } else {
        let files = FileResolver::new(path.parent().unwrap_or(Path::new("")));
        within(memory, &files, |files| Scene::from_file_with(files, path))?
    };
    Ok((name, scene))
}

/// Reads a scene with a limit on the memory for its files. If they exceed it, the option is wrong, and not the scene.
fn within(
    memory: Option<u64>,
    files: &dyn Resolver,
    read: impl FnOnce(&dyn Resolver) -> Result<Scene, SceneError>,
) -> Result<Scene> {
    let files = WithinMemory::new(files, memory);
    read(&files).map_err(|error| if files.is_exceeded() { wrong("--memory", &error).into() } else { error.into() })
}

/// The scene in an output, with the files that it was made of.
pub fn carried_scene(output: &Path, name: &str, metadata: &FileMetadata) -> Result<Scene, SceneError> {
    let files = CarriedFiles::of_output(output, &metadata.files);
    Scene::from_text_with(&files, None, name, &metadata.scene, Syntax::Toml)
}

/// The metadata of an output file or store.
pub fn metadata(path: &Path) -> Result<FileMetadata> {
    if path.is_dir() { Ok(isophote_zarr::read_metadata(path)?) } else { Ok(read_metadata(path)?) }
}

/// Whether a path names a store, judging by its suffix.
pub fn is_store(path: &Path) -> bool {
    path.extension().is_some_and(|suffix| suffix.eq_ignore_ascii_case("zarr"))
}

/// The scene is valid: the argument is wrong.
pub fn wrong(options: impl ToValue, error: &SceneError) -> Usage {
    let reasons = error.problems.iter().map(|problem| match &problem.help {
        Some(help) => message!("{first}; {second}", first = problem.message, second = help),
        None => problem.message.clone(),
    });
    let reasons = reasons.reduce(|first, second| message!("{first}; {second}", first, second));
    Usage(message!("{options}: {reasons}", options, reasons = reasons.unwrap_or_else(Message::empty)))
}
