//! Stopped, continued, shared out: the bytes are those of one uninterrupted run.

use std::fs;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU64, Ordering};

use isophote::map::Quantity;
use isophote::render::{Observer, ReferenceRenderer, RenderError};
use isophote_zarr::{Check, Opening, Outcome, Part, Request, Store, StoreError, Workers};

use crate::common::{Folder, Job, TWO_LIGHTS, scene};

/// Stops after so many pixels.
struct Patience(AtomicU64);

impl Observer for Patience {
    fn advance(&self, pixels: u64) -> ControlFlow<()> {
        let left = self.0.load(Ordering::Relaxed);
        self.0.store(left.saturating_sub(pixels), Ordering::Relaxed);
        if left == 0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

#[test]
fn the_bytes_do_not_depend_on_threads() {
    let scene = scene(TWO_LIGHTS, 70, 50);
    let (one, statistics) = Job { threads: 1, ..Job::default() }.complete(&scene);
    let (seven, same) = Job { threads: 7, ..Job::default() }.complete(&scene);
    assert_eq!(one.tree(), seven.tree());
    assert_eq!(statistics, same);
}

#[test]
fn an_interrupted_computation_is_continued_to_the_same_bytes() {
    let scene = scene(TWO_LIGHTS, 70, 50);
    let (whole, _) = Job::default().complete(&scene);
    let request = Request {
        quantities: Job::default().quantities,
        opening: Opening::Continue,
        part: None,
        shard_side: 16.try_into().ok(),
        workers: None,
    };
    let workers = Workers { threads: 2.try_into().unwrap(), memory: None, used: 0 };
    for patience in [0, 500, 1500, 2500] {
        let folder = Folder::new();
        let store = Store::prepare(&folder.store(), &scene, &ReferenceRenderer, &request).unwrap();
        let observer = Patience(AtomicU64::new(patience));
        let error = store.render(&scene, &ReferenceRenderer, workers, None, Some(&observer)).unwrap_err();
        assert!(matches!(error, StoreError::Render(RenderError::Interrupted)), "{error}");
        let [done, pixels] = store.pixels(None);
        assert_eq!((done, pixels), (0, 3500));
        drop(store);
        // The plan is that of the store, even if nobody says so again.
        let request = Request { shard_side: None, ..request.clone() };
        let store = Store::prepare(&folder.store(), &scene, &ReferenceRenderer, &request).unwrap();
        assert_eq!(store.pixels(None)[0] > 0, patience > 1000, "{patience}");
        store.render(&scene, &ReferenceRenderer, workers, None, None).unwrap();
        assert_eq!(folder.tree(), whole.tree(), "{patience}");
    }
}

#[test]
fn parts_in_any_order_merge_to_the_same_bytes() {
    let scene = scene(TWO_LIGHTS, 70, 50);
    let (whole, statistics) = Job::default().complete(&scene);
    let folder = Folder::new();
    for number in [2, 3, 1] {
        let outcome = Job { part: Part::new(number, 3), opening: Opening::Continue, ..Job::default() }
            .run(&folder.store(), &scene)
            .unwrap();
        let left = [(2, 13), (3, 7), (1, 0)].into_iter().find(|(part, _)| *part == number).unwrap().1;
        assert_eq!(outcome, Outcome::Part { done: 20 - left, left });
    }
    assert_eq!(Store::open(&folder.store()).unwrap().merge(Check::Presence).unwrap(), statistics);
    assert_eq!(folder.tree(), whole.tree());
}

#[test]
fn parts_at_the_same_time_share_a_store() {
    let scene = scene(TWO_LIGHTS, 70, 50);
    let (whole, _) = Job::default().complete(&scene);
    let folder = Folder::new();
    std::thread::scope(|scope| {
        for number in 1..=4 {
            let job = Job { part: Part::new(number, 4), opening: Opening::Continue, threads: 1, ..Job::default() };
            let (path, scene) = (folder.store(), &scene);
            scope.spawn(move || job.run(&path, scene).unwrap());
        }
    });
    Store::open(&folder.store()).unwrap().merge(Check::Content).unwrap();
    assert_eq!(folder.tree(), whole.tree());
}

#[test]
fn a_store_that_exists_is_never_replaced() {
    let small = scene(TWO_LIGHTS, 70, 50);
    let (folder, _) = Job::default().complete(&small);
    let before = folder.tree();
    let error = Job::default().run(&folder.store(), &small).unwrap_err();
    assert!(error.to_string().ends_with("exists already: 20 of its 20 shards are done"), "{error}");
    // To continue what is complete changes nothing.
    let continued = Job { opening: Opening::Continue, ..Job::default() };
    assert!(matches!(continued.run(&folder.store(), &small).unwrap(), Outcome::Complete(_)));
    assert_eq!(folder.tree(), before);
    let refused = |job: &Job, scene: &_, words: &str| {
        let error = job.run(&folder.store(), scene).unwrap_err().to_string();
        assert!(error.contains(words), "no {words:?} in {error}");
    };
    refused(&continued, &scene(TWO_LIGHTS, 70, 51), "the size is 70×50 there and 70×51 here");
    let other = Job { quantities: vec![Quantity::Depth], ..continued.clone() };
    refused(&other, &small, "the list of channels is brightness, shape, normal there and depth here");
    let brighter = TWO_LIGHTS.replacen("intensity = ", "intensity = 1", 1);
    refused(&continued, &scene(&brighter, 70, 50), "a line of the scene is ‘intensity = ");
    refused(&Job { side: 32, ..continued.clone() }, &small, "the side of a shard is 16 there and 32 here");
    assert_eq!(folder.tree(), before);
}

#[test]
fn a_place_that_belongs_to_others_is_left_alone() {
    let scene = scene(TWO_LIGHTS, 7, 5);
    let folder = Folder::new();
    fs::write(folder.store(), "mine").unwrap();
    let error = Job::default().run(&folder.store(), &scene).unwrap_err();
    assert!(error.to_string().ends_with("map.zarr’ is a file"), "{error}");
    fs::remove_file(folder.store()).unwrap();
    fs::create_dir(folder.store()).unwrap();
    fs::write(folder.file("thesis.txt"), "mine").unwrap();
    let error = Job { opening: Opening::Continue, ..Job::default() }.run(&folder.store(), &scene).unwrap_err();
    assert!(error.to_string().ends_with("is a folder with other things in it"), "{error}");
    assert_eq!(folder.tree().len(), 1);
    let error = Job::default().run(&folder.file("none/map.zarr"), &scene).unwrap_err();
    assert!(error.to_string().contains("that does not exist"), "{error}");
}

#[test]
fn too_little_memory_for_one_shard_is_refused_with_the_least() {
    let scene = scene(TWO_LIGHTS, 5000, 4000);
    let folder = Folder::new();
    let job = Job { side: 2048, memory: Some(100 << 20), quantities: vec![Quantity::Brightness], ..Job::default() };
    let error = job.run(&folder.store(), &scene).unwrap_err();
    assert_eq!(error.to_string(), "a limit of 100 MiB of memory is too small: one shard of this map needs 209 MiB");
}
