//! Instructions counted by valgrind, one benchmark per format: noise-free numbers for comparing two versions.
//!
//! Run with `make bench-instructions`. The image is small because valgrind is some fifty times slower than the machine.

#![expect(missing_docs, reason = "the macros of gungraun make public things without documentation")]

use std::hint::black_box;
use std::io::Cursor;
use std::num::NonZeroUsize;

use gungraun::{library_benchmark, library_benchmark_group, main};
use isophote::map::{Map, Quantity, Resolution};
use isophote::prepare::PreparedScene;
use isophote::render::{ReferenceRenderer, RenderSettings, Renderer};
use isophote::scene::library::Starter;
use isophote::scene::{Scene, Syntax};
use isophote_export::png::PictureOptions;
use isophote_export::{exr, png};

fn lab_map() -> Map {
    let scene = Scene::from_text("lab", Starter::Lab.text(), Syntax::Toml).expect("the lab's scene is valid");
    let scene = scene.with_resolution(Resolution { width: 80, height: 60 }).expect("the size is allowed");
    let settings = RenderSettings { quantities: vec![Quantity::Brightness], ..RenderSettings::default() };
    ReferenceRenderer.render(&PreparedScene::new(&scene), &settings).expect("the scene renders")
}

#[library_benchmark]
#[bench::lab(lab_map())]
fn write_png(map: Map) -> Vec<u8> {
    let mut bytes = Vec::new();
    let options = PictureOptions::new(Quantity::Brightness);
    png::write(black_box(&map), &options, &mut bytes).expect("memory is there");
    black_box(bytes)
}

#[library_benchmark]
#[bench::lab(lab_map())]
fn write_exr(map: Map) -> Vec<u8> {
    let mut file = Cursor::new(Vec::new());
    exr::write(black_box(&map), NonZeroUsize::MIN, &mut file).expect("memory is there");
    black_box(file.into_inner())
}

library_benchmark_group!(name = writers, benchmarks = [write_png, write_exr]);
main!(library_benchmark_groups = writers);
