//! Instructions counted by valgrind, one benchmark per stage: noise-free numbers for comparing two versions.
//!
//! Run with `make bench-instructions`. The images are small because valgrind is some fifty times slower than the
//! machine.

#![expect(missing_docs, reason = "the macros of gungraun make public things without documentation")]

use std::hint::black_box;
use std::num::NonZeroUsize;

use gungraun::{library_benchmark, library_benchmark_group, main};
use isophote::lanes::Precision;
use isophote::map::{Map, Quantity, Resolution};
use isophote::prepare::PreparedScene;
use isophote::render::{ReferenceRenderer, RenderSettings, Renderer, SimdRenderer};
use isophote::scene::library::Starter;
use isophote::scene::source::LightSource;
use isophote::scene::{Scene, Syntax};

const SMALL: Resolution = Resolution { width: 80, height: 60 };

fn lab() -> Scene {
    let scene = Scene::from_text("lab", Starter::Lab.text(), Syntax::Toml).expect("the lab's scene is valid");
    scene.with_resolution(SMALL).expect("the size is allowed")
}

fn prepared_lab() -> PreparedScene {
    PreparedScene::new(&lab())
}

/// The lab's sphere with `count` lights on a spiral around the eye.
fn many_lights(count: u32) -> PreparedScene {
    let mut source = lab().source().clone();
    let light = source.light[0].clone();
    let on_spiral = |index| {
        let angle = f64::from(index) * 2.4;
        let position = Some([10.0 * angle.cos(), 10.0 * angle.sin(), -f64::from(index % 16)]);
        LightSource { name: None, position, ..light.clone() }
    };
    source.light = (0..count).map(on_spiral).collect();
    PreparedScene::new(&Scene::try_from(source).expect("the lights are outside the sphere"))
}

fn brightness(renderer: &dyn Renderer, scene: &PreparedScene) -> Map {
    let settings = RenderSettings { quantities: vec![Quantity::Brightness], ..RenderSettings::default() };
    renderer.render(scene, &settings).expect("the scene renders")
}

#[library_benchmark]
fn read() -> Scene {
    let text = black_box(Starter::Lab.text());
    black_box(Scene::from_text("lab", text, Syntax::Toml).expect("the lab's scene is valid"))
}

#[library_benchmark]
#[bench::lab(lab())]
fn prepare(scene: Scene) -> PreparedScene {
    black_box(PreparedScene::new(black_box(&scene)))
}

#[library_benchmark]
#[bench::lab(prepared_lab())]
#[bench::lights_64(many_lights(64))]
fn render_reference(scene: PreparedScene) -> Map {
    black_box(brightness(&ReferenceRenderer, black_box(&scene)))
}

/// With the instructions that valgrind knows, which are not always the machine's best.
#[library_benchmark]
#[bench::lab_in_single(Precision::Single, prepared_lab())]
#[bench::lab_in_double(Precision::Double, prepared_lab())]
#[bench::lights_64_in_single(Precision::Single, many_lights(64))]
#[bench::lights_64_in_double(Precision::Double, many_lights(64))]
fn render_lanes(precision: Precision, scene: PreparedScene) -> Map {
    black_box(brightness(&SimdRenderer::new(precision, NonZeroUsize::new(1)), black_box(&scene)))
}

library_benchmark_group!(name = stages, benchmarks = [read, prepare, render_reference, render_lanes]);
main!(library_benchmark_groups = stages);
