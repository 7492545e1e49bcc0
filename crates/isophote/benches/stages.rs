//! One benchmark per stage from a scene file to a map.

use std::fmt::Write as _;
use std::fs;
use std::hint::black_box;
use std::num::NonZeroUsize;
use std::path::Path;

use criterion::{Criterion, criterion_group, criterion_main};
use isophote::analysis::statistics::statistics;
use isophote::lanes::Precision;
use isophote::map::{Map, Quantity, Resolution};
use isophote::prepare::PreparedScene;
use isophote::render::{ReferenceRenderer, RenderSettings, Renderer, SimdRenderer};
use isophote::scene::library::Starter;
use isophote::scene::{Scene, Syntax};
use isophote::units::Keyword;

fn lab() -> Scene {
    Scene::from_text("lab", Starter::Lab.text(), Syntax::Toml).expect("the lab's scene is valid")
}

fn render(renderer: &dyn Renderer, scene: &PreparedScene, quantities: &[Quantity]) -> Map {
    let settings = RenderSettings { quantities: quantities.to_vec(), ..RenderSettings::default() };
    renderer.render(scene, &settings).expect("the lab's scene renders")
}

fn read(criterion: &mut Criterion) {
    criterion.bench_function("read and check the lab's scene", |bencher| bencher.iter(|| black_box(lab())));
}

fn prepare(criterion: &mut Criterion) {
    let scene = lab();
    criterion.bench_function("prepare", |bencher| bencher.iter(|| black_box(PreparedScene::new(&scene))));
}

fn kernel(criterion: &mut Criterion) {
    let scene = PreparedScene::new(&lab());
    let brightness = [Quantity::Brightness];
    criterion.bench_function("render 800×600, reference", |bencher| {
        bencher.iter(|| black_box(render(&ReferenceRenderer, &scene, &brightness)));
    });
    for precision in [Precision::Double, Precision::Single] {
        let lanes = SimdRenderer::new(precision, None);
        criterion.bench_function(&format!("render 800×600, lanes, {}", precision.name()), |bencher| {
            bencher.iter(|| black_box(render(&lanes, &scene, &brightness)));
        });
        criterion.bench_function(&format!("render 800×600 again, lanes, {}", precision.name()), |bencher| {
            let settings = RenderSettings { quantities: brightness.to_vec(), ..RenderSettings::default() };
            let mut map = Some(render(&lanes, &scene, &brightness));
            bencher.iter(|| {
                let earlier = map.take().expect("the last turn left one");
                map = Some(lanes.render_again(&scene, &settings, earlier).expect("the lab's scene renders"));
            });
        });
    }
}

/// The cost of smooth edges: compare with "render 800×600, lanes".
fn samples(criterion: &mut Criterion) {
    let brightness = [Quantity::Brightness];
    let lanes = SimdRenderer::new(Precision::Double, None);
    let mut group = criterion.benchmark_group("samples 800×600");
    group.sample_size(20);
    for (name, sampling) in [("16 everywhere", "samples = 16"), ("tolerance 0.01", "tolerance = 0.01")] {
        let text = format!("{}\n[sampling]\n{sampling}\n", Starter::Lab.text());
        let scene = Scene::from_text("lab", &text, Syntax::Toml).expect("the lab's scene is valid");
        let scene = PreparedScene::new(&scene);
        group.bench_function(name, |bencher| bencher.iter(|| black_box(render(&lanes, &scene, &brightness))));
    }
    group.finish();
}

fn many_lights(criterion: &mut Criterion) {
    let mut source = lab().source().clone();
    let light = source.light[0].clone();
    source.light = (0..256)
        .map(|index| {
            let angle = f64::from(index) * 2.399_963;
            let position = Some([10.0 * angle.cos(), 10.0 * angle.sin(), -f64::from(index % 16)]);
            isophote::scene::source::LightSource { name: None, position, ..light.clone() }
        })
        .collect();
    let scene = PreparedScene::new(&Scene::try_from(source).expect("lights outside the sphere"));
    let mut group = criterion.benchmark_group("many lights");
    group.sample_size(10);
    for precision in [Precision::Double, Precision::Single] {
        let lanes = SimdRenderer::new(precision, None);
        group.bench_function(format!("render 800×600, 256 lights, lanes, {}", precision.name()), |bencher| {
            bencher.iter(|| black_box(render(&lanes, &scene, &[Quantity::Brightness])));
        });
    }
    group.finish();
}

/// The lab's sphere seen so closely that it covers every pixel, by whole and other n: what the kernel alone takes.
fn fill(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("sphere fills 800×600");
    group.sample_size(20);
    for (count, shininess) in [(1, 20.0), (1, 20.5), (256, 20.0), (256, 20.5)] {
        let mut text = format!(
            "version = 1\nlength = \"m\"\nhandedness = \"left\"\nconvention = \"lab\"\n\
             [camera]\neye = [0, 0, 0]\nforward = [0, 0, 1]\nresolution = [800, 600]\n\
             screen = {{ distance = 5, x = [-0.6, 0.6], y = [-0.45, 0.45] }}\n\
             [material.clay]\ndiffuse = 0.7\nspecular = 0.3\nshininess = {shininess}\n\
             [[sphere]]\ncenter = [0, 0, 5]\nradius = 1\nmaterial = \"clay\"\n"
        );
        for index in 0..count {
            let angle = f64::from(index) * 2.399_963;
            let radius = 0.5 + 3.0 * f64::from(index) / f64::from(count);
            let [x, y, z] = [radius * angle.cos(), radius * angle.sin(), -1.0 - 0.3 * f64::from(index % 16)];
            let _ = write!(text, "[[light]]\nposition = [{x}, {y}, {z}]\nintensity = 100\n");
        }
        let scene = PreparedScene::new(&Scene::from_text("fill", &text, Syntax::Toml).expect("it is valid"));
        for precision in [Precision::Double, Precision::Single] {
            let lanes = SimdRenderer::new(precision, NonZeroUsize::new(1));
            group.bench_function(format!("{count} lights, n = {shininess}, lanes, {}", precision.name()), |bencher| {
                bencher.iter(|| black_box(render(&lanes, &scene, &[Quantity::Brightness])));
            });
        }
    }
    group.finish();
}

/// An image whose buffers no longer fit into a cache: here the cost per background pixel shows.
fn large(criterion: &mut Criterion) {
    let scene = lab().with_resolution(Resolution { width: 3840, height: 2160 }).expect("an allowed size");
    let renderer = SimdRenderer::new(Precision::Double, None);
    let map = render(&renderer, &PreparedScene::new(&scene), &[Quantity::Brightness]);
    let mut group = criterion.benchmark_group("map of 3840×2160");
    group.sample_size(20);
    group.bench_function("statistics", |bencher| bencher.iter(|| black_box(statistics(&map, &Quantity::Brightness))));
    group.finish();
}

/// Every way of finding what pixels see but the sphere's: the shapes that fill most of the view, by each camera.
fn shapes(criterion: &mut Criterion) {
    let shapes = [
        ("sphere", "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1.1"),
        ("ellipsoid", "[[ellipsoid]]\ncenter = [0, 0, 0]\nradii = [1.1, 1.0, 0.8]"),
        ("box", "[[box]]\ncenter = [0, 0, 0]\nsize = [2, 2, 2]\nrotation = { axis = [0, 1, 0], degrees = 20 }"),
        ("cylinder", "[[cylinder]]\nfrom = [0, -1, 0]\nto = [0, 1, 0.2]\nradius = 1"),
        ("cone", "[[cone]]\nbase = [0, -1, 0]\napex = [0, 1.2, 0]\nradius = 1.2"),
        ("plane", "[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 0.2, 1]"),
    ];
    let cameras = [
        ("perspective", "screen = { distance = 1, x = [-0.4, 0.4], y = [-0.3, 0.3] }"),
        ("orthographic", "projection = \"orthographic\"\nwindow = { x = [-1.2, 1.2], y = [-0.9, 0.9] }"),
        ("fisheye", "projection = \"fisheye-equidistant\"\nfield_of_view = 46"),
    ];
    let lanes = SimdRenderer::new(Precision::Double, None);
    let mut group = criterion.benchmark_group("shapes 800×600");
    group.sample_size(10);
    for (shape, text) in shapes {
        for (camera, view) in cameras {
            let text = format!(
                "version = 1\nlength = \"m\"\nconvention = \"radiance\"\n\
                 [camera]\neye = [0, 0, 3]\ntarget = [0, 0, 0]\nresolution = [800, 600]\n{view}\n\
                 [material.chalk]\ndiffuse = 0.6\nspecular = 0.3\nshininess = 20\n\
                 [[light]]\nposition = [2, 3, 4]\nintensity = 20\n\
                 {text}\nmaterial = \"chalk\"\n"
            );
            let scene = Scene::from_text(shape, &text, Syntax::Toml).expect("it is valid");
            let scene = PreparedScene::new(&scene);
            group.bench_function(format!("{shape}, {camera}"), |bencher| {
                bencher.iter(|| black_box(render(&lanes, &scene, &[Quantity::Brightness])));
            });
        }
    }
    group.finish();
}

/// Shapes of all kinds with shadows, and a mesh, as in the gallery, with one ray through each pixel.
fn gallery(criterion: &mut Criterion) {
    let lanes = SimdRenderer::new(Precision::Double, None);
    let mut group = criterion.benchmark_group("gallery 800×600");
    group.sample_size(10);
    for name in ["solids", "room", "mesh", "sun", "orthographic"] {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
        let text = fs::read_to_string(folder.join(name).with_extension("toml")).expect("it is there");
        let text: Vec<&str> = text.lines().filter(|line| !line.starts_with("tolerance")).collect();
        let scene = Scene::from_text_in(&folder, name, &text.join("\n"), Syntax::Toml).expect("it is valid");
        let scene = PreparedScene::new(&scene).at_resolution(Resolution { width: 800, height: 600 });
        group.bench_function(name, |bencher| {
            bencher.iter(|| black_box(render(&lanes, &scene, &[Quantity::Brightness])));
        });
    }
    group.finish();
}

criterion_group!(stages, read, prepare, kernel, samples, many_lights, fill, large, shapes, gallery);
criterion_main!(stages);
