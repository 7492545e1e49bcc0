//! Instructions counted by valgrind, one benchmark per stage and per way of rendering: noise-free numbers for comparing two
//! versions.
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

/// A scene with shadows, seen by a camera whose view is given.
fn shadowed(view: &str, rest: &str) -> PreparedScene {
    let text = format!(
        r#"
        version = 1
        length = "m"
        convention = "radiance"
        shadows = true
        camera = {{ {view}, target = [0, 0, 0], resolution = [80, 60] }}
        material.chalk = {{ diffuse = 0.6, specular = 0.3, shininess = 20 }}
        {rest}
        "#
    );
    PreparedScene::new(&Scene::from_text("shadowed", &text, Syntax::Toml).expect("it is valid"))
}

/// A box, a cylinder and a sphere over a floor, and something more.
fn solids(more: &str) -> PreparedScene {
    let solids = r#"
        plane = [{ point = [0, -1, 0], normal = [0, 1, 0], material = "chalk" }]
        box = [{ center = [-1.2, -0.5, 0], size = [0.8, 1, 0.9], material = "chalk" }]
        cylinder = [{ from = [1.2, -1, 0], to = [1.2, 0.5, 0], radius = 0.4, material = "chalk" }]
        sphere = [{ center = [0, 0, 0], radius = 0.5, material = "chalk" }]
        light = [{ position = [2, 3, 4], intensity = 20 }, { position = [-3, 2, 1], intensity = 10 }]
    "#;
    shadowed("eye = [0, 2, 6], field_of_view = 40", &format!("{solids}\n{more}"))
}

/// Spheres in a cube.
fn cloud() -> PreparedScene {
    let ball = |index: u32| {
        let [x, y, z] = [index % 6, index / 6 % 6, index / 36].map(|step| 0.4 * f64::from(step) - 1.0);
        format!("{{ center = [{x}, {y}, {z}], radius = 0.15, material = \"chalk\" }}")
    };
    let balls: Vec<String> = (0..216).map(ball).collect();
    let light = "light = [{ position = [2, 3, 4], intensity = 20 }]";
    shadowed("eye = [1, 2, 6], field_of_view = 30", &format!("sphere = [{}]\n{light}", balls.join(", ")))
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

// With the instructions that valgrind knows, which are not always the machine's best.
#[library_benchmark]
#[bench::rows_in_single(Precision::Single, prepared_lab())]
#[bench::rows_in_double(Precision::Double, prepared_lab())]
#[bench::rows_64_lights_in_single(Precision::Single, many_lights(64))]
#[bench::rows_64_lights_in_double(Precision::Double, many_lights(64))]
#[bench::tiles(Precision::Double, cloud())]
#[bench::packets(Precision::Double, solids(""))]
#[bench::samples(Precision::Double, solids("sampling = { tolerance = 0.05 }"))]
#[bench::ambient(Precision::Double, solids("ambient = { radiance = 1, obstructed = true, samples = 16 }"))]
fn render_lanes(precision: Precision, scene: PreparedScene) -> Map {
    black_box(brightness(&SimdRenderer::new(precision, NonZeroUsize::new(1)), black_box(&scene)))
}

#[library_benchmark]
#[bench::among_solids(solids(
    r#"grid = [{ name = "g", corner = [-2, -0.3, -2], u = [0, 0, 4], v = [4, 0, 0], points = [60, 60] }]"#
))]
fn grid(scene: PreparedScene) -> Map {
    let grid = &scene.scene().grids()[0];
    black_box(scene.grid(black_box(grid), &[Quantity::Irradiance]).expect("no light is in the way"))
}

library_benchmark_group!(name = stages, benchmarks = [read, prepare, render_reference, render_lanes, grid]);
main!(library_benchmark_groups = stages);
