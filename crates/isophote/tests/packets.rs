//! Rays in packets: shapes of every kind, meshes, shadows and cameras, within tolerance and to the last bit the same however
//! the work is cut.

use isophote::conformance::conforms;
use isophote::lanes::{Instructions, Precision};
use isophote::map::{Map, Pixel, Quantity, Region, Resolution, Values};
use isophote::prepare::PreparedScene;
use isophote::render::{ReferenceRenderer, RenderSettings, Renderer, SimdRenderer};
use isophote::scene::source::{AmbientSource, ProjectionName, SamplingSource, WindowSource};
use isophote::scene::{Filter, MemoryFiles, Scene, SceneSource, Syntax};
use isophote::tolerance::DOUBLE;
use proptest::prelude::*;

#[allow(dead_code, reason = "not every file of tests asks for everything")]
mod random;

fn prepared(source: SceneSource) -> PreparedScene {
    PreparedScene::new(&Scene::try_from(source).unwrap_or_else(|error| panic!("{error}")))
}

fn renderers() -> Vec<SimdRenderer> {
    let renderer = |instructions| SimdRenderer::new(Precision::Double, None).with_instructions(instructions);
    Instructions::all().into_iter().filter(|instructions| instructions.are_wide()).map(renderer).collect()
}

fn rendered(renderer: &dyn Renderer, scene: &PreparedScene, region: Option<Region>) -> Map {
    let settings = RenderSettings { region, quantities: Quantity::COMMON.to_vec(), ..RenderSettings::default() };
    renderer.render(scene, &settings).unwrap_or_else(|error| panic!("{error}"))
}

fn bits(values: &Values, index: usize) -> Vec<u64> {
    match values {
        Values::Scalar(values) => vec![values[index].to_bits()],
        Values::Single(values) => vec![u64::from(values[index].to_bits())],
        Values::Vector(values) => values[index].map(f64::to_bits).to_vec(),
        Values::Index(values) => vec![u64::from(values[index].cast_unsigned())],
    }
}

/// Whether every value of a part is, bit by bit, that of the whole.
fn is_part(part: &Map, whole: &Map) -> bool {
    let width = whole.region.size.width as usize;
    let mut channels = part.channels().iter().zip(whole.channels());
    channels.all(|(part_of_it, whole)| {
        (0..part.region.size.pixels()).all(|index| {
            let Pixel { column, row } = part.pixel(index);
            bits(&part_of_it.values, index) == bits(&whole.values, row as usize * width + column as usize)
        })
    })
}

/// The same scene seen by another camera.
fn seen_by(source: &mut SceneSource, projection: usize) {
    let camera = source.camera.get_or_insert_default();
    let names = [ProjectionName::FisheyeEquidistant, ProjectionName::FisheyeEqualArea, ProjectionName::Panorama];
    if let Some(name) = names.get(projection) {
        camera.screen = None;
        camera.projection = Some(*name);
        camera.field_of_view = (*name != ProjectionName::Panorama).then_some(120.0);
        camera.eye = camera.eye.map(|eye| eye.map(|coordinate| 0.3 * coordinate));
    } else if projection == 3 {
        camera.screen = None;
        camera.projection = Some(ProjectionName::Orthographic);
        camera.window = Some(WindowSource { x: Some([-2.0, 2.0]), y: Some([-1.5, 1.5]) });
    }
}

/// Triangles anywhere, large and small, some of them slivers, with or without normals, some of them sharing edges.
fn meshes() -> impl Strategy<Value = String> {
    let corner = [-1.0..1.0_f64, -1.0..1.0, -1.0..1.0];
    let size = prop_oneof![Just(1.0), Just(0.1), Just(0.01)];
    let triangle = (corner.clone(), corner.clone(), corner.clone(), size, any::<bool>());
    (prop::collection::vec(triangle, 1..40), any::<bool>()).prop_map(|(triangles, is_smooth)| {
        let mut lines = Vec::new();
        let mut corners = Vec::new();
        for (place, second, third, size, is_sliver) in triangles {
            let at = |corner: [f64; 3], part: f64| [0, 1, 2].map(|axis| place[axis] + corner[axis] * size * part);
            let ends = if is_sliver { [at(second, 1.0), at(second, 0.501)] } else { [at(second, 1.0), at(third, 1.0)] };
            let last = if is_sliver { ends[1].map(|coordinate| coordinate + 1e-3 * size) } else { ends[1] };
            corners.extend([place, ends[0], last]);
        }
        for [x, y, z] in &corners {
            lines.push(format!("v {x} {y} {z}\nvn {x} {} {z}", y + 0.3));
        }
        for first in (1..corners.len()).step_by(3) {
            let corner = |index: usize| if is_smooth { format!("{index}//{index}") } else { index.to_string() };
            lines.push(format!("f {} {} {}", corner(first), corner(first + 1), corner(first + 2)));
            // A neighbour that shares an edge.
            if first > 3 {
                lines.push(format!("f {} {} {}", corner(first + 1), corner(first), corner(first - 1)));
            }
        }
        lines.join("\n")
    })
}

fn scene_of(mesh: &str, camera: &str, shadows: bool) -> PreparedScene {
    let text = format!(
        r#"
        version = 1
        length = "m"
        convention = "radiance"
        shadows = {shadows}
        camera = {{ eye = [0.3, 0.4, 5], target = [0, 0, 0], resolution = [37, 29], {camera} }}
        material.a = {{ diffuse = 0.6, specular = 0.3, shininess = 25 }}
        material.b = {{ diffuse = 0.4 }}
        mesh = [{{ file = "mesh.obj", material = "a" }}]
        plane = [{{ point = [0, -1.5, 0], normal = [0, 1, 0], material = "b" }}]
        sphere = [{{ center = [0.2, 0.1, 0.3], radius = 0.4, material = "b" }}]
        light = [
            {{ position = [3, 4, 2], intensity = 30 }},
            {{ position = [-2, 1, 3.5], intensity = 10 }},
            {{ emission = "parallel", direction = [-1, -2, -1], irradiance = 2 }},
        ]
        "#
    );
    let files = MemoryFiles::from_iter([("mesh.obj", mesh)]);
    let scene = Scene::from_text_with(&files, None, "scene.toml", &text, Syntax::Toml);
    PreparedScene::new(&scene.unwrap_or_else(|error| panic!("{error}\n{mesh}")))
}

const CAMERAS: [&str; 4] = [
    "field_of_view = 40",
    r#"projection = "orthographic", window = { x = [-2, 2], y = [-1.5, 1.5] }"#,
    r#"projection = "fisheye-equidistant", field_of_view = 60"#,
    r#"projection = "panorama""#,
];

proptest! {
    #![proptest_config(random::config(96))]

    /// Within tolerance of the whole formula in 32 digits, which traces every ray by itself: no pixel sees another shape, or
    /// another light.
    #[test]
    fn random_solids_are_rendered_within_tolerance(mut source in random::solids(), projection in 0_usize..8) {
        seen_by(&mut source, projection);
        let Ok(scene) = Scene::try_from(source) else { return Ok(()) };
        let scene = PreparedScene::new(&scene);
        for renderer in renderers() {
            let result = conforms(&renderer, &scene, &DOUBLE);
            prop_assert!(result.is_ok(), "{}: {}", renderer.name(), result.unwrap_err());
        }
    }

    /// Shapes block ambient light in the same directions, and samples of pixels see the same, as when rays are traced one by
    /// one.
    #[test]
    fn random_samples_and_ambient_light_are_those_of_single_rays(
        mut source in random::solids(),
        projection in 0_usize..8,
        has_ambient in any::<bool>(),
        filter in prop_oneof![Just(Filter::Box), Just(Filter::Triangle)],
    ) {
        seen_by(&mut source, projection);
        if has_ambient {
            let (radiance, samples) = (Some(0.5.into()), Some(16));
            source.ambient = Some(AmbientSource { radiance, obstructed: Some(true), samples });
        } else {
            let (samples, tolerance) = (Some(1024), Some(0.02));
            source.sampling = Some(SamplingSource { samples, tolerance, filter: Some(filter) });
        }
        let Ok(scene) = Scene::try_from(source) else { return Ok(()) };
        let scene = PreparedScene::new(&scene);
        // Where all light is grazing, its relative error is larger.
        let intensities: f64 = scene.emitters().all().iter().map(|emitter| emitter.intensity).sum();
        let expected = rendered(&ReferenceRenderer, &scene, None);
        for renderer in renderers() {
            let found = rendered(&renderer, &scene, None);
            prop_assert_eq!(found.mask().shapes(), expected.mask().shapes());
            for quantity in [Quantity::Brightness, Quantity::Irradiance, Quantity::Ambient, Quantity::Specular] {
                let values = [&found, &expected].map(|map| map.scalar(&quantity).expect("it is common"));
                let pixels = found.region.size.pixels();
                let peak = (0..pixels).map(|index| values[1].at(index)).fold(1e-6 * intensities, f64::max);
                for index in 0..pixels {
                    let off = (values[0].at(index) - values[1].at(index)).abs();
                    prop_assert!(off <= 1e-12 * peak, "{quantity:?} of pixel {index} is off by {off}, of {peak}");
                }
            }
        }
    }

    #[test]
    fn random_meshes_are_rendered_within_tolerance(mesh in meshes(), camera in 0_usize..4, shadows in any::<bool>()) {
        let scene = scene_of(&mesh, CAMERAS[camera], shadows);
        for renderer in renderers() {
            let result = conforms(&renderer, &scene, &DOUBLE);
            prop_assert!(result.is_ok(), "{}: {}", renderer.name(), result.unwrap_err());
        }
    }

    /// A tile may be cut anywhere, by the edge of the image, of a region or of a thread's band; samples of other pixels may share
    /// a packet.
    #[test]
    fn threads_and_regions_change_nothing(
        mut source in random::solids(),
        projection in 0_usize..8,
        has_ambient in any::<bool>(),
        is_sampled in any::<bool>(),
        threads in 1_usize..5,
        corner in (0_u32..20, 0_u32..15),
        size in (1_u32..20, 1_u32..15),
    ) {
        seen_by(&mut source, projection);
        if has_ambient {
            let (radiance, samples) = (Some(0.5.into()), Some(8));
            source.ambient = Some(AmbientSource { radiance, obstructed: Some(true), samples });
        }
        if is_sampled {
            let (samples, tolerance) = (Some(1024), Some(0.02));
            source.sampling = Some(SamplingSource { samples, tolerance, filter: None });
        }
        let Ok(scene) = Scene::try_from(source) else { return Ok(()) };
        let scene = PreparedScene::new(&scene);
        let renderer = |threads: usize| SimdRenderer::new(Precision::Double, threads.try_into().ok());
        let whole = rendered(&renderer(1), &scene, None);
        let region = Region {
            corner: Pixel { column: corner.0, row: corner.1 },
            size: Resolution { width: size.0.min(20 - corner.0), height: size.1.min(15 - corner.1) },
        };
        prop_assert!(is_part(&rendered(&renderer(threads), &scene, Some(region)), &whole));
        prop_assert!(is_part(&rendered(&renderer(threads), &scene, None), &whole));
    }

    /// AVX2 and AVX-512 agree in every bit.
    #[test]
    fn the_bytes_do_not_depend_on_the_width_of_the_registers(mut source in random::solids(), projection in 0_usize..8) {
        seen_by(&mut source, projection);
        let Ok(scene) = Scene::try_from(source) else { return Ok(()) };
        let scene = PreparedScene::new(&scene);
        let maps: Vec<Map> = renderers().iter().map(|renderer| rendered(renderer, &scene, None)).collect();
        for map in maps.iter().skip(1) {
            prop_assert!(is_part(map, &maps[0]));
        }
    }
}

/// In the repository's scenes every pixel sees what the reference sees there.
#[test]
fn packets_see_what_single_rays_see() {
    for name in ["solids", "room", "mesh", "sun", "orthographic", "fisheye", "panorama", "color"] {
        let path = format!("{}/../../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let mut source = Scene::from_file(path.as_ref()).unwrap_or_else(|error| panic!("{error}")).source().clone();
        source.sampling = None;
        source.camera.get_or_insert_default().resolution = Some([203, 151]);
        let scene = prepared(source);
        let reference = rendered(&ReferenceRenderer, &scene, None).mask().shapes();
        assert!(reference.iter().any(|shape| *shape >= 0), "{name}");
        for renderer in renderers() {
            assert!(rendered(&renderer, &scene, None).mask().shapes() == reference, "{name}, {}", renderer.name());
        }
    }
}
