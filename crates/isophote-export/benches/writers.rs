//! One benchmark per file format.

use std::io::Cursor;
use std::num::NonZeroUsize;

use criterion::{Criterion, criterion_group, criterion_main};
use isophote::lanes::Precision;
use isophote::map::{Map, Quantity, Resolution};
use isophote::prepare::PreparedScene;
use isophote::render::{RenderSettings, Renderer, SimdRenderer};
use isophote::scene::library::Starter;
use isophote::scene::{Scene, Syntax};
use isophote_export::png::PictureOptions;
use isophote_export::{exr, figure, npz, png};

fn lab(size: Resolution, quantities: &[Quantity]) -> Map {
    let scene = Scene::from_text("lab", Starter::Lab.text(), Syntax::Toml).expect("the lab's scene is valid");
    let scene = PreparedScene::new(&scene.with_resolution(size).expect("an allowed size"));
    let settings = RenderSettings { quantities: quantities.to_vec(), ..RenderSettings::default() };
    SimdRenderer::new(Precision::Double, None).render(&scene, &settings).expect("the lab's scene renders")
}

fn all_threads() -> NonZeroUsize {
    std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN)
}

fn export(criterion: &mut Criterion) {
    let map = lab(Resolution { width: 800, height: 600 }, &Quantity::COMMON);
    let mut group = criterion.benchmark_group("export 800×600");
    group.sample_size(20);
    group.bench_function("png", |bencher| {
        let options = PictureOptions::new(Quantity::Brightness);
        bencher.iter(|| png::write(&map, &options, Vec::new()).expect("memory is there"));
    });
    group.bench_function("exr, all channels", |bencher| {
        bencher.iter(|| exr::write(&map, all_threads(), Cursor::new(Vec::new())).expect("memory is there"));
    });
    group.bench_function("npz, all channels", |bencher| {
        bencher.iter(|| npz::write(&map, Cursor::new(Vec::new())).expect("memory is there"));
    });
    group.bench_function("figure, svg and png", |bencher| {
        let options = figure::FigureOptions::new(Quantity::Brightness, "brightness");
        bencher.iter(|| {
            let figure = figure::map_figure(&map, &options).expect("it can be drawn");
            figure.to_png(2.0, None).expect("it can be drawn")
        });
    });
    group.finish();
}

/// An image whose buffers no longer fit into a cache: here the cost per background pixel shows.
fn large(criterion: &mut Criterion) {
    let map = lab(Resolution { width: 3840, height: 2160 }, &[Quantity::Brightness, Quantity::Shape]);
    let mut group = criterion.benchmark_group("export 3840×2160");
    group.sample_size(20);
    group.bench_function("png", |bencher| {
        let options = PictureOptions::new(Quantity::Brightness);
        bencher.iter(|| png::write(&map, &options, Vec::new()).expect("memory is there"));
    });
    group.bench_function("exr, brightness and shape", |bencher| {
        bencher.iter(|| exr::write(&map, all_threads(), Cursor::new(Vec::new())).expect("memory is there"));
    });
    group.finish();
}

criterion_group!(writers, export, large);
criterion_main!(writers);
