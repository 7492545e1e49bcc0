//! Maps larger than memory: `isophote render -o NAME.zarr` and `isophote merge`.

use std::num::NonZeroUsize;
use std::path::Path;

use anyhow::{Error, Result};
use isophote::map::Quantity;
use isophote::message;
use isophote::prepare::PreparedScene;
use isophote::render::{RenderError, SimdRenderer};
use isophote::scene::Scene;
use isophote::text::{Language, Message};
use isophote::threads::Threads;
use isophote_zarr::{Check, MapStatistics, Opening, Outcome, Request, Store, StoreError, Workers};
use serde_json::json;

use super::summary::Summary;
use crate::args::{DEFAULT_ISOPHOTES, MergeArguments, RenderArguments};
use crate::channels;
use crate::failure::{self, Failed, Paused, Usage};
use crate::progress::{self, Patience, Progress, end_in_order};
use crate::{load, memory, numbers, threads};

/// Two processes that compute the same shard write the same bytes, but one that merges meanwhile may see half of them.
fn no_locks() -> Message {
    message!(
        "warning: this file system has no locks, so nothing keeps another process from writing to the store; make sure that none does, except with --shard"
    )
}

/// The store to render, if there is one; refuses options that need a store, or that do not work with one.
pub fn asked_for(arguments: &RenderArguments) -> Result<Option<&Path>, Usage> {
    let Some(store) = arguments.output.iter().find(|path| load::is_store(path)) else {
        let store = &arguments.store;
        let given = [
            ("--resume", store.resume),
            ("--shard", store.shard.is_some()),
            ("--memory", store.memory.is_some()),
            ("--shard-side", store.shard_side.is_some()),
        ];
        return match given.into_iter().find(|(_, is_given)| *is_given) {
            Some((option, _)) => Err(Usage(message!("{option} needs -o NAME.zarr", option))),
            None => Ok(None),
        };
    };
    let refused = [
        (message!("another -o"), arguments.output.len() > 1),
        (Message::verbatim("--figure"), !arguments.figure.is_empty()),
        (Message::verbatim("--region"), arguments.region.is_some()),
    ];
    match refused.into_iter().find(|(_, is_given)| *is_given) {
        Some((option, _)) => Err(Usage(message!(
            "-o {store} does not go with {option}: the map is never in memory as a whole; render that by itself",
            store = store.display(),
            option
        ))),
        None => Ok(Some(store)),
    }
}

/// Renders a scene into a store.
pub fn render(arguments: &RenderArguments, path: &Path) -> Result<String> {
    let threads = Threads::new(arguments.threads);
    let scene = PreparedScene::on_threads(&load::scene_to_render(arguments)?, &threads);
    // From here on a store may exist, so Ctrl-C must say how to resume it.
    end_in_order();
    let language = arguments.language.lang;
    progress::say_what_stays(message!("the shards that are done stay: {way} from there", way = way(arguments)));
    let workers = Workers {
        threads: arguments.threads.unwrap_or_else(threads::all),
        memory: arguments.store.memory,
        used: memory::peak(),
    };
    let renderer = SimdRenderer::new(arguments.precision, Some(NonZeroUsize::MIN));
    let part = arguments.store.shard;
    let is_continued = arguments.store.resume || part.is_some();
    let request = Request {
        quantities: wanted(arguments, scene.scene())?,
        opening: if is_continued { Opening::Continue } else { Opening::New },
        part,
        shard_side: arguments.store.shard_side,
        workers: Some(workers),
    };
    let store = Store::prepare(path, &scene, &renderer, &request).map_err(explained)?;
    if !arguments.quiet {
        if !store.is_locked() {
            failure::note(&no_locks().in_language(language));
        }
        for note in options_without_effect(arguments) {
            failure::note(&note.in_language(language));
        }
    }
    let progress = Progress::resumed(store.pixels(part), arguments.quiet, language);
    let outcome = store.render(&scene, &renderer, workers, part, Some(&progress));
    progress.finish();
    match outcome.map_err(|error| resumable(error, &store, arguments))? {
        Outcome::Complete(statistics) => {
            if !arguments.quiet {
                let (path, count) = (path.display(), store.plan().count());
                failure::note(&message!("wrote {path}: {count} shards", path, count).in_language(language));
            }
            printed(&statistics, &scene, arguments.json, language)
        }
        Outcome::Part { done, left } => {
            if !arguments.quiet {
                let path = path.display();
                let note = message!("{path}: {done} shards are done, {left} are left", path, done, left);
                let note = if left == 0 { message!("{note}; isophote merge finishes it", note) } else { note };
                failure::note(&note.in_language(language));
            }
            let counts = json!({ "shards_done": done, "shards_left": left });
            if arguments.json { numbers::json(&counts) } else { Ok(String::new()) }
        }
    }
}

/// Merges the parts of a store.
pub fn merge(arguments: &MergeArguments) -> Result<String> {
    // Once a record may have been removed, Ctrl-C must not say that nothing was written.
    end_in_order();
    progress::say_what_stays(message!("the shards of the store stay as they are"));
    let store = Store::open(&arguments.store).map_err(explained)?;
    if !store.is_locked() {
        failure::note(&no_locks().in_language(arguments.language.lang));
    }
    let name = arguments.store.display().to_string();
    let scene = PreparedScene::new(&load::carried_scene(&arguments.store, &name, store.metadata())?);
    let check = if arguments.check { Check::Content } else { Check::Presence };
    let statistics = store.merge_observed(check, Some(&Patience)).map_err(explained)?;
    printed(&statistics, &scene, arguments.json, arguments.language.lang)
}

fn printed(statistics: &MapStatistics, scene: &PreparedScene, as_json: bool, language: Language) -> Result<String> {
    let summary = Summary::of_store(statistics, scene);
    if as_json { numbers::json(&summary.to_json(scene)) } else { Ok(summary.to_text(scene, language)) }
}

/// The channels of the store: the brightness, plus the colours if the scene has any, unless others are named.
fn wanted(arguments: &RenderArguments, scene: &Scene) -> Result<Vec<Quantity>> {
    let mut named = channels::named(&arguments.channel, scene)?;
    if named.is_empty() {
        named.push(Quantity::Brightness);
        named.extend(scene.color().map(|_| Quantity::Color));
    }
    if arguments.lights {
        named.extend(scene.lights().iter().map(|light| Quantity::Light(light.name.clone())));
    }
    let mut wanted = Vec::with_capacity(named.len());
    for quantity in named {
        if !wanted.contains(&quantity) {
            wanted.push(quantity);
        }
    }
    Ok(wanted)
}

fn options_without_effect(arguments: &RenderArguments) -> Vec<Message> {
    let options = [
        ("--range", arguments.range.is_some()),
        ("--colormap", arguments.colormap.is_some()),
        ("--gamma", arguments.gamma != 1.0),
        ("--bits", arguments.bits == "16"),
        ("--isophotes", arguments.isophotes != DEFAULT_ISOPHOTES),
        ("--visible-only", arguments.visible_only),
    ];
    let given = options.into_iter().filter(|(_, is_given)| *is_given);
    given.map(|(option, _)| message!("{option} has no effect: it is not for .zarr stores", option)).collect()
}

/// How a computation that was stopped goes on.
fn way(arguments: &RenderArguments) -> Message {
    if arguments.store.shard.is_some() { message!("the same command goes on") } else { message!("--resume goes on") }
}

/// An error of the store with advice.
fn advised(error: &StoreError, advice: &Message) -> Usage {
    Usage(message!("{first}; {second}", first = error.message(), second = advice))
}

/// The error, with what the user can do about it.
fn explained(error: StoreError) -> Error {
    match &error {
        StoreError::Exists { done, shards, .. } if done == shards => {
            let advice = message!("isophote merge prints its results; to begin anew, remove it or choose another name");
            advised(&error, &advice).into()
        }
        StoreError::Exists { .. } => {
            let advice = message!("--resume goes on with it; to begin anew, remove it or choose another name");
            advised(&error, &advice).into()
        }
        StoreError::Changed { .. } => {
            advised(&error, &message!("go on with the same scene and options, or choose another name")).into()
        }
        StoreError::Incomplete { .. } => {
            let advice = message!("isophote render with --resume computes what is missing or damaged");
            Failed(message!("{first}; {second}", first = error.message(), second = advice)).into()
        }
        StoreError::TooManyShards { .. } => {
            Usage(message!("{option}: {error}", option = "--shard-side", error = error.message())).into()
        }
        StoreError::Memory { .. } => {
            Usage(message!("{option}: {error}", option = "--memory", error = error.message())).into()
        }
        _ => error.into(),
    }
}

/// The error of a computation that has already begun: shards that are done are kept.
fn resumable(error: StoreError, store: &Store, arguments: &RenderArguments) -> Error {
    let (done, shards) = (store.done(), store.plan().count());
    let way = way(arguments);
    match error {
        StoreError::Render(RenderError::Interrupted) => {
            Paused(message!("{done} of {shards} shards are done and stay: {way} from there", done, shards, way)).into()
        }
        StoreError::Write { .. } => Failed(message!(
            "{error}; {done} of {shards} shards are done and stay usable: {way}",
            error = error.message(),
            done,
            shards,
            way
        ))
        .into(),
        error => explained(error),
    }
}
