//! Every renderer within its tolerance of exact arithmetic, on the scenes of the repository and on random ones.

mod random;

use isophote::analysis::probe::ProbePosition;
use isophote::conformance::{conforms, cosine_of_emission};
use isophote::double_double::DoubleDouble;
use isophote::import::Resolver;
use isophote::lanes::{Instructions, Precision};
use isophote::map::{Map, Pixel, Quantity, Region, Resolution, Values};
use isophote::prepare::{Hit, PreparedScene};
use isophote::reflectance::Convention;
use isophote::render::{ReferenceRenderer, RenderError, RenderSettings, Renderer, SimdRenderer};
use isophote::scene::source::{EmissionName, LightSource, MaterialSource, ProjectionName, WindowSource};
use isophote::scene::{Scene, SceneSource, Syntax};
use isophote::shape::{Geometry, Primitive, SurfacePoint};
use isophote::tolerance::{DOUBLE, PROBE, SINGLE};
use isophote::units::Keyword;
use isophote::vector::Vector;
use proptest::prelude::*;

// In a browser's WebAssembly there are no files and no output: what runs the suite provides these.
#[cfg(target_os = "unknown")]
use super::system::{files, report_panics, scene_names, seed};

fn prepared(source: SceneSource) -> PreparedScene {
    report_panics();
    PreparedScene::new(&Scene::from_source_with(&files(), source).unwrap_or_else(|error| panic!("{error}")))
}

#[cfg(not(target_os = "unknown"))]
fn report_panics() {}

/// The scenes of the repository, and the files they name.
#[cfg(not(target_os = "unknown"))]
fn files() -> impl Resolver {
    isophote::scene::FileResolver::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes"))
}

fn scene_file(name: &str) -> SceneSource {
    let files = files();
    let text = files.read(name).expect("it is in the repository");
    let text = std::str::from_utf8(&text).expect("a scene is text");
    let scene = Scene::from_text_with(&files, None, name, text, Syntax::Toml);
    scene.unwrap_or_else(|error| panic!("{error}")).source().clone()
}

fn scene_text(text: &str) -> PreparedScene {
    report_panics();
    PreparedScene::new(&Scene::from_text("scene", text, Syntax::Toml).unwrap_or_else(|error| panic!("{error}")))
}

/// In all renderers, this many pixels see a surface, and all are within double precision's tolerance.
fn is_within_tolerance(scene: &PreparedScene, visible: usize) {
    for renderer in renderers() {
        let deviation =
            conforms(renderer.as_ref(), scene, &DOUBLE).unwrap_or_else(|error| panic!("{}: {error}", renderer.name()));
        assert_eq!(deviation.visible, visible, "{}", renderer.name());
    }
}

/// In single precision, this many pixels see a surface, and all are within its tolerance.
fn is_within_tolerance_of_single(scene: &PreparedScene, visible: usize) {
    let renderer = SimdRenderer::new(Precision::Single, None);
    let deviation = conforms(&renderer, scene, &SINGLE).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(deviation.visible, visible);
}

/// The names of these scenes.
#[cfg(not(target_os = "unknown"))]
fn scene_names() -> Vec<String> {
    let names = std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes")).expect("it is there");
    let names = names.map(|entry| entry.expect("it is readable").file_name().to_string_lossy().into_owned());
    let names: Vec<String> =
        names.filter(|name| std::path::Path::new(name).extension().is_some_and(|suffix| suffix == "toml")).collect();
    names
}

fn bits(values: &Values, index: usize) -> Vec<u64> {
    match values {
        Values::Scalar(values) => vec![values[index].to_bits()],
        Values::Single(values) => vec![u64::from(values[index].to_bits())],
        Values::Vector(values) => values[index].map(f64::to_bits).to_vec(),
        Values::Index(values) => vec![u64::from(values[index].cast_unsigned())],
    }
}

fn renderers() -> Vec<Box<dyn Renderer>> {
    let lanes = |instructions| -> Box<dyn Renderer> {
        Box::new(SimdRenderer::new(Precision::Double, None).with_instructions(instructions))
    };
    std::iter::once::<Box<dyn Renderer>>(Box::new(ReferenceRenderer))
        .chain(Instructions::all().into_iter().map(lanes))
        .collect()
}

/// The surface point nearest to `point`, all of it in 32 digits; the eye is outside.
fn precise_hit(scene: &PreparedScene, primitive: Primitive, point: Vector) -> Hit<DoubleDouble> {
    let Geometry::Sphere(sphere) = scene.scene().shapes()[primitive.shape].geometry else {
        panic!("these scenes are made of spheres");
    };
    let center = Vector::<DoubleDouble>::from_f64(sphere.center);
    let normal = (Vector::from_f64(point) - center).normalized();
    let offset = normal * DoubleDouble::from_f64(sphere.radius);
    let to_eye = (Vector::from_f64(scene.frame().eye) - center) - offset;
    let (distance, view) = (to_eye.length(), to_eye.normalized());
    let point = SurfacePoint { anchor: sphere.center, offset, normal, view, cos_theta_o: normal.dot(view) };
    let shadow_ray_offset = Vector::from_f64(Vector::default());
    Hit { primitive, distance, point, from_inside: false, shadow_ray_offset }
}

#[test]
fn the_scenes_of_the_repository_are_rendered_within_tolerance() {
    let names = scene_names();
    assert!(names.len() >= 20);
    for name in names {
        let mut source = scene_file(&name);
        // Renderers are held to the exact values of single rays.
        source.sampling = None;
        // An odd size: no pixel centre on an axis, some rays close to the limb.
        source.camera.get_or_insert_default().resolution = Some([163, 121]);
        let scene = prepared(source);
        for renderer in renderers() {
            let deviation = conforms(renderer.as_ref(), &scene, &DOUBLE)
                .unwrap_or_else(|error| panic!("{name}, {}: {error}", renderer.name()));
            assert!(deviation.visible > 100, "{name}: {deviation:?}");
        }
    }
}

#[test]
fn every_convention_is_rendered_within_tolerance() {
    for name in ["two-lights.toml", "lab.toml", "spheres.toml", "solids.toml", "sun.toml", "color.toml"] {
        for convention in Convention::ALL {
            let mut source = scene_file(name);
            source.sampling = None;
            source.convention = Some(*convention);
            if source.material.is_empty() {
                source.material = scene_file("lab.toml").material;
                for sphere in &mut source.sphere {
                    sphere.material = Some("clay".into());
                }
                for plane in &mut source.plane {
                    plane.material = Some("clay".into());
                }
            }
            source.camera.get_or_insert_default().resolution = Some([63, 47]);
            let scene = prepared(source);
            let single = SimdRenderer::new(Precision::Single, None);
            for (renderer, tolerance) in
                renderers().iter().map(|one| (one.as_ref(), &DOUBLE)).chain([(&single as &dyn Renderer, &SINGLE)])
            {
                let deviation = conforms(renderer, &scene, tolerance)
                    .unwrap_or_else(|error| panic!("{name}, {convention:?}, {}: {error}", renderer.name()));
                assert!(deviation.visible > 15, "{name}: {deviation:?}");
            }
        }
    }
}

/// In single precision, where the geometry stays double; at every level of instructions.
#[test]
fn single_precision_is_within_its_tolerance_on_the_scenes_of_the_repository() {
    for name in scene_names() {
        let mut source = scene_file(&name);
        source.sampling = None;
        source.camera.get_or_insert_default().resolution = Some([163, 121]);
        let scene = prepared(source);
        for instructions in Instructions::all() {
            let renderer = SimdRenderer::new(Precision::Single, None).with_instructions(instructions);
            let deviation = conforms(&renderer, &scene, &SINGLE)
                .unwrap_or_else(|error| panic!("{name}, {}: {error}", instructions.name()));
            println!("{name} {}: {deviation:?}", instructions.name());
        }
    }
}

/// Lights on all sides, of all kinds: blocks of them are skipped below the horizon, and the sums have many terms.
fn with_many_lights(count: u32) -> SceneSource {
    let mut source = scene_file("lab.toml");
    source.probe.clear();
    let lamp = source.light[0].clone();
    let light = |index: u32| {
        let (turn, height) = (f64::from(index) * 2.399_963, 1.0 - 2.0 * (f64::from(index) + 0.5) / f64::from(count));
        let (ring, distance) = ((1.0 - height * height).sqrt(), 1.5 + f64::from(index % 7));
        let is_lambertian = index.is_multiple_of(3);
        if index % 11 == 5 {
            return LightSource {
                emission: Some(EmissionName::Parallel),
                direction: Some([ring * turn.cos(), height, ring * turn.sin()]),
                irradiance: Some(0.25.into()),
                ..LightSource::default()
            };
        }
        let is_spot = index % 3 == 1;
        LightSource {
            name: None,
            inner_angle: is_spot.then_some(10.0),
            outer_angle: is_spot.then_some(40.0),
            position: Some([distance * ring * turn.cos(), distance * height, 5.0 + distance * ring * turn.sin()]),
            emission: Some([EmissionName::Lambertian, EmissionName::Spot, EmissionName::Isotropic][index as usize % 3]),
            target: (is_lambertian || is_spot).then_some([0.3, 0.0, 5.0]),
            intensity: Some(f64::from(index % 5).into()),
            ..lamp.clone()
        }
    };
    source.light = (0..count).map(light).collect();
    source.camera.get_or_insert_default().screen.get_or_insert_default().x = Some([-1.2, 1.2]);
    source.camera.get_or_insert_default().screen.get_or_insert_default().y = Some([-1.2, 1.2]);
    source.camera.get_or_insert_default().resolution = Some([31, 29]);
    source
}

#[test]
fn many_lights_are_summed_within_tolerance() {
    for count in [64, 65, 1000] {
        let scene = prepared(with_many_lights(count));
        for renderer in renderers() {
            let deviation = conforms(renderer.as_ref(), &scene, &DOUBLE)
                .unwrap_or_else(|error| panic!("{count} lights, {}: {error}", renderer.name()));
            assert!(deviation.visible > 400, "{deviation:?}");
        }
        conforms(&SimdRenderer::new(Precision::Single, None), &scene, &SINGLE)
            .unwrap_or_else(|error| panic!("{count} lights: {error}"));
    }
}

fn bytes(map: &Map) -> Vec<Vec<u64>> {
    let pixels = map.region.size.pixels();
    map.channels().iter().map(|channel| (0..pixels).flat_map(|index| bits(&channel.values, index)).collect()).collect()
}

/// AVX2 and AVX-512 agree in every bit, and so do all that round products before they add them.
#[test]
fn the_bytes_do_not_depend_on_the_width_of_the_registers() {
    for precision in [Precision::Double, Precision::Single] {
        for source in [scene_file("two-lights.toml"), with_many_lights(200)] {
            let scene = prepared(source);
            let settings = RenderSettings { quantities: Quantity::COMMON.to_vec(), ..RenderSettings::default() };
            for fuse in [false, true] {
                let maps: Vec<_> = Instructions::all()
                    .into_iter()
                    .filter(|instructions| instructions.fuse() == fuse)
                    .map(|instructions| {
                        let renderer = SimdRenderer::new(precision, None).with_instructions(instructions);
                        (instructions.name(), renderer.render(&scene, &settings).expect("it renders"))
                    })
                    .collect();
                for (name, map) in maps.iter().skip(1) {
                    assert!(bytes(map) == bytes(&maps[0].1), "{precision:?}: {name} is not {}", maps[0].0);
                }
            }
        }
    }
}

/// With many lights too, where neighbouring pixels share a choice of lights.
#[test]
fn a_region_lit_by_many_lights_is_a_part_of_the_whole() {
    for precision in [Precision::Double, Precision::Single] {
        let mut source = with_many_lights(400);
        source.camera.get_or_insert_default().resolution = Some([300, 9]);
        let scene = prepared(source);
        let renderer = SimdRenderer::new(precision, None);
        let settings = RenderSettings { quantities: vec![Quantity::Brightness], ..RenderSettings::default() };
        let whole = renderer.render(&scene, &settings).expect("it renders");
        for column in [50, 128, 131, 200] {
            let size = Resolution { width: 90, height: 9 };
            let region = Some(Region { corner: Pixel { column, row: 0 }, size });
            let part = renderer.render(&scene, &RenderSettings { region, ..settings.clone() }).expect("it renders");
            for index in 0..size.pixels() {
                let Pixel { column, row } = part.pixel(index);
                let in_whole = row as usize * 300 + column as usize;
                let values = |map: &Map, index| bits(&map.channels()[0].values, index);
                assert_eq!(values(&part, index), values(&whole, in_whole), "{precision:?}, column {column}, row {row}");
            }
        }
    }
}

/// Next to a surface, far away, and as strong as a scene allows: what single precision cannot compute is computed in
/// double, and what it cannot hold is an error.
#[test]
fn single_precision_keeps_its_bound_for_lights_anywhere() {
    let with_light = |z: f64, intensity: f64| {
        let mut source = scene_file("lab.toml");
        source.probe.clear();
        source.light[0].position = Some([0.0, 0.0, z]);
        source.light[0].intensity = Some(intensity.into());
        source.camera.get_or_insert_default().resolution = Some([41, 31]);
        prepared(source)
    };
    let renderer = SimdRenderer::new(Precision::Single, None);
    for z in [3.999, 3.99, 3.95, 3.8, 3.0, -100.0, -1e4, -1e6, -1e9] {
        conforms(&renderer, &with_light(z, 100.0), &SINGLE).unwrap_or_else(|error| panic!("z = {z}: {error}"));
    }
    let error = renderer.render(
        &with_light(3.999_999, 1e30),
        &RenderSettings { quantities: vec![Quantity::Brightness], ..RenderSettings::default() },
    );
    assert!(matches!(error, Err(RenderError::Overflow { .. })), "{error:?}");
}

/// What an earlier map saw leaves no trace in the memory that it hands on.
#[test]
fn a_map_in_the_memory_of_an_earlier_one_is_the_same() {
    for precision in [Precision::Double, Precision::Single] {
        let renderer = SimdRenderer::new(precision, None);
        let settings = RenderSettings { quantities: Quantity::COMMON.to_vec(), ..RenderSettings::default() };
        let mut source = scene_file("lab.toml");
        source.probe.clear();
        source.sphere[0].center = Some([-1.0, 0.5, 6.0]);
        let moved = prepared(source);
        let scene = prepared(scene_file("lab.toml"));
        let fresh = renderer.render(&scene, &settings).expect("it renders");
        let earlier = renderer.render(&moved, &settings).expect("it renders");
        assert!(renderer.render_again(&scene, &settings, earlier).expect("it renders") == fresh);
        let other_size = Region { size: Resolution { width: 5, height: 7 }, ..fresh.region };
        let small = RenderSettings { region: Some(other_size), ..settings.clone() };
        let earlier = renderer.render(&scene, &small).expect("it renders");
        assert!(renderer.render_again(&scene, &settings, earlier).expect("it renders") == fresh);
    }
}

/// A window so narrow that every one of its pixels is within 1e-9 radii of the silhouette (5.6), where a plain double
/// would be wrong in the fourth digit of cosθ_o.
#[test]
fn grazing_rays_keep_their_digits() {
    let mut source = scene_file("closed-form-5.6.toml");
    source.convention = Some(Convention::Lab);
    source.material = scene_file("lab.toml").material;
    source.sphere[0].material = Some("clay".into());
    source.light[0].position = Some([0.3, 0.0, 0.0]);
    let limb = 0.289_804_351_502_968_3;
    let camera = source.camera.get_or_insert_default();
    camera.screen.get_or_insert_default().x = Some([limb - 2e-10, limb + 1e-10]);
    camera.screen.get_or_insert_default().y = Some([-1e-10, 1e-10]);
    camera.resolution = Some([90, 60]);
    let scene = prepared(source);
    for renderer in renderers() {
        let deviation = conforms(renderer.as_ref(), &scene, &DOUBLE).unwrap_or_else(|error| panic!("{error}"));
        assert!((3000..5400).contains(&deviation.visible), "the limb runs through the window: {deviation:?}");
    }
}

/// A lamp far behind a sphere, of whose light a single pixel is seen: near the limb, where the normal is uncertain as
/// 1/cosθ_o, and near the terminator, which magnifies that by 1/cosθ_i.
#[test]
fn a_rim_lit_from_behind_has_the_digits_of_both_cosines() {
    let scene = r#"
        version = 1
        length = "cm"
        handedness = "left"
        convention = "lab"
        camera.eye = [-3.1944107944705458, -2.8239897012051633, -4.547261686467446]
        camera.target = [0.1, -0.2, 0.05]
        camera.up = [0.5606012171559106, 0.4224177659846777, 0.7122425895043244]
        camera.screen = { distance = 6.233519631922044, x = [-2.0, 2.0], y = [-1.5, 1.5] }
        camera.resolution = [32, 24]
        material.clay = { diffuse = 0.0, specular = 0.004585172349215819, shininess = 1.0 }

        [[sphere]]
        center = [-0.4788160629472567, 0.7785411150310472, 0.9362396137938241]
        radius = 1.0363877766457497
        material = "clay"

        [[light]]
        position = [3.0064274538017344, 3.3572734245463254, 3.0392920323174004]
        intensity = 0.04569130665154959
    "#;
    is_within_tolerance(&scene_text(scene), 162);
}

/// A map whose only lit pixel is far down the flank of a highlight: 32 bits leave it the digits that n tanθ_h leaves.
#[test]
fn the_flank_of_a_highlight_alone_has_the_digits_of_a_flank() {
    let scene = r#"
        version = 1
        length = "mm"
        handedness = "left"
        convention = "lab"
        camera.eye = [2.099748036103266, 2.6030306400445893, 4.417951137598115]
        camera.target = [0.1, -0.2, 0.05]
        camera.up = [1.0, 0.0, 0.0]
        camera.screen = { distance = 5.541029018362469, x = [-2.0, 2.0], y = [-1.5, 1.5] }
        camera.resolution = [32, 24]
        material.clay = { diffuse = 0.0, specular = 0.7008702469231558, shininess = 13.0 }

        [[sphere]]
        center = [0.456710219847021, -0.019254653650458982, 0.7905032935362961]
        radius = 1.1638955745622808
        material = "clay"

        [[sphere]]
        center = [0.0, 0.929657233505472, 0.0]
        radius = 1.1433339435246908
        material = "clay"

        [[light]]
        position = [-4.640288470136054, 1.3426498229082426, -5.38797912461627]
        intensity = 78.46999000368378
    "#;
    is_within_tolerance_of_single(&scene_text(scene), 566);
}

/// The same far down the flank of a sharper highlight, whose logarithm 32 bits do not hold well enough: it is computed in 64.
#[test]
fn the_flank_of_a_sharp_highlight_is_left_to_double_precision() {
    let scene = r#"
        version = 1
        length = "mm"
        handedness = "left"
        convention = "lab"
        camera.eye = [0.7297238756825094, 16.8775598318406, 14.654020324907103]
        camera.target = [0.1, -0.2, 0.05]
        camera.up = [0.7178680942378699, 0.4907596665945718, 0.49378168143347856]
        camera.screen = { distance = 22.363470984954258, x = [-2.0, 2.0], y = [-1.5, 1.5] }
        camera.resolution = [32, 24]
        material.clay = { diffuse = 0.0, specular = 0.5835454323773949, shininess = 29.0 }

        [[sphere]]
        center = [-0.8905337146021937, 0.4536568044051576, -0.025524221824326326]
        radius = 0.7270559460277526
        material = "clay"

        [[light]]
        position = [2.7859283448555408, -4.1958158745750485, -4.981584511447524]
        intensity = 54.67864314784505
    "#;
    is_within_tolerance_of_single(&scene_text(scene), 93);
}

/// A lamp so close that it would be the brightest by far lights no more than a rim of the visible side, where
/// cosθ_i < 2e-4; the picture's peak is another light's. What comes from the lamp is as uncertain as its cosines.
#[test]
fn a_lamp_of_which_only_the_terminator_is_seen_has_the_digits_of_its_cosines() {
    let scene = r#"
        version = 1
        length = "mm"
        handedness = "left"
        convention = "lab"
        camera.eye = [-4.505183491992847, -5.711192734549307, -22.843578451498573]
        camera.target = [0.1, -0.2, 0.05]
        camera.up = [0.47215487460444794, 0.21631328388357854, 0.8545632437700329]
        camera.screen = { distance = 23.973808150092957, x = [-2.0, 2.0], y = [-1.5, 1.5] }
        camera.resolution = [32, 24]
        material.clay = { diffuse = 0.6136702591377421, specular = 0.9648911791095501, shininess = 9.0 }

        [[sphere]]
        center = [-0.17211123267736397, 0.3017329611235427, 0.5837494529107726]
        radius = 1.0084805266747865
        material = "clay"

        [[light]]
        position = [3.3202386210592705, 2.717926420564469, 8.937545204742749]
        intensity = 66.73224542120249

        [[light]]
        emission = "parallel"
        direction = [0.0, -1.0, 0.0]
        irradiance = 7.90674143150637
    "#;
    is_within_tolerance(&scene_text(scene), 198);
}

/// The same picture from a hundred, ten thousand and a million radii away, through a screen that far away.
#[test]
fn distant_spheres_keep_their_digits() {
    for distance in [1e2, 1e4, 1e6] {
        let mut source = scene_file("closed-form-5.5.toml");
        source.light[0].position = Some([3.0, 4.0, 5.0]);
        source.light[0].intensity = Some(100.0.into());
        let camera = source.camera.get_or_insert_default();
        camera.eye = Some([0.3 * distance, 0.2 * distance, distance]);
        camera.screen.get_or_insert_default().distance = Some(distance);
        camera.resolution = Some([60, 60]);
        let scene = prepared(source);
        let deviation =
            conforms(&ReferenceRenderer, &scene, &DOUBLE).unwrap_or_else(|error| panic!("{distance}: {error}"));
        assert!(deviation.visible > 1000);
    }
}

/// In the plane where two spheres of different materials cross, rounding must not decide which is seen.
#[test]
fn crossing_spheres_are_told_apart_to_the_last_digit() {
    let mut source = scene_file("lab.toml");
    source.probe.clear();
    let dark = MaterialSource { diffuse: Some(0.1.into()), ..MaterialSource::default() };
    source.material.insert("dark".into(), dark);
    source.sphere.push(source.sphere[0].clone());
    source.sphere[0].center = Some([-0.3, 0.0, 5.0]);
    source.sphere[1].center = Some([0.3, 0.0, 5.0]);
    source.sphere[1].name = Some("right".into());
    source.sphere[1].material = Some("dark".into());
    let camera = source.camera.get_or_insert_default();
    camera.screen.get_or_insert_default().x = Some([-1.0, 1.0 + 2.0 * f64::EPSILON]);
    camera.resolution = Some([3, 9]);
    let scene = prepared(source);
    for renderer in renderers() {
        conforms(renderer.as_ref(), &scene, &DOUBLE).unwrap_or_else(|error| panic!("{error}"));
    }
    let middle = scene.trace_pixel(Pixel { column: 1, row: 4 }).expect("the spheres cross there");
    assert_eq!(middle.primitive.shape, 1, "the middle pixel is a hair to the right");
}

/// From inside, the far wall is seen, with N towards the eye; a light inside lights it, one outside does not.
#[test]
fn the_inside_of_a_sphere_is_seen_and_lit_from_inside() {
    let text = r#"
        version = 1
        length = "m"
        convention = "lab"
        camera = { eye = [0.2, 0.1, 0], forward = [0, 0, 1], screen = { distance = 1, x = [-3, 3], y = [-3, 3] }, resolution = [40, 40] }
        material.wall = { diffuse = 0.5, specular = 0.3, shininess = 10 }
        sphere = [{ name = "room", center = [0, 0, 0], radius = 2, material = "wall" }]
        light = [
            { name = "inside", position = [0, 1, 0.5], intensity = 10 },
            { name = "outside", position = [0, 0, -9], intensity = 10 },
        ]
    "#;
    let scene = Scene::from_text("room", text, Syntax::Toml).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(scene.warnings().len(), 1, "the light outside deserves a word");
    let scene = PreparedScene::new(&scene);
    let deviation = conforms(&ReferenceRenderer, &scene, &DOUBLE).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(deviation.visible, 1600, "the wall is everywhere");
    let reading = scene.probe(&ProbePosition::Pixel(Pixel { column: 3, row: 30 })).expect("the wall is there");
    assert!(reading.hit.point.offset.dot(reading.hit.point.normal) < 0.0, "N points inwards");
    assert!((reading.hit.point.offset.length() - 2.0).abs() < 1e-15);
    assert!(reading.terms[0].irradiance > 0.0);
    assert_eq!(reading.terms[1].irradiance, 0.0);
    assert_eq!(reading.shading.irradiance, reading.terms[0].irradiance);
}

#[test]
fn the_nearest_sphere_hides_the_others_and_spheres_behind_the_eye_are_not_seen() {
    let mut source = scene_file("lab.toml");
    source.probe.clear();
    let ball = source.sphere[0].clone();
    let mut at = |name: &str, z: f64| {
        let mut sphere = ball.clone();
        sphere.name = Some(name.into());
        sphere.center = Some([0.0, 0.0, z]);
        source.sphere.push(sphere);
    };
    at("behind", 9.0);
    at("before", 3.0);
    at("at the back", -5.0);
    let scene = prepared(source);
    let hit = scene.trace_pixel(Pixel { column: 400, row: 300 }).expect("a sphere is there");
    assert_eq!(scene.scene().shapes()[hit.primitive.shape].name, "before");
    assert!((hit.distance - 2.0).abs() < 1e-4);
    let map = ReferenceRenderer.render(&scene, &RenderSettings::default()).expect("it renders");
    let seen: std::collections::BTreeSet<i32> = map.mask().shapes().into_iter().collect();
    assert_eq!(seen, [-1, 2].into(), "the one before covers those of the same size behind it");
}

proptest! {
    #![proptest_config(random::config(128))]

    #[test]
    fn random_scenes_are_rendered_within_tolerance(source in random::worlds()) {
        let scene = prepared(source);
        for renderer in renderers() {
            let result = conforms(renderer.as_ref(), &scene, &DOUBLE);
            prop_assert!(result.is_ok(), "{}: {}", renderer.name(), result.unwrap_err());
        }
    }

    #[test]
    fn random_scenes_are_rendered_within_tolerance_by_every_projection(
        mut source in random::worlds(),
        projection in 0_usize..6,
        field_of_view in 20.0..360.0_f64,
        off in -1.0..1.0_f64,
    ) {
        let camera = source.camera.get_or_insert_default();
        camera.screen = None;
        let names = [ProjectionName::FisheyeEquidistant, ProjectionName::FisheyeEqualArea, ProjectionName::Panorama];
        if let Some(name) = names.get(projection) {
            camera.projection = Some(*name);
            camera.field_of_view = (*name != ProjectionName::Panorama).then_some(field_of_view);
            // From near by, or nothing of it would be seen.
            camera.eye = camera.eye.map(|eye| eye.map(|coordinate| 0.5 * coordinate + off));
        } else if projection == 3 {
            camera.field_of_view = Some(0.4 * field_of_view);
        } else {
            camera.projection = Some(ProjectionName::Orthographic);
            // In the second case the window reaches far beyond what is seen in it.
            let width = if projection == 4 { 1.0 } else { 50.0 };
            let window = WindowSource { x: Some([-2.0 * width, 2.0]), y: Some([-1.5, 1.5 * width]) };
            camera.window = Some(window);
        }
        let Ok(scene) = Scene::try_from(source) else { return Ok(()) };
        let scene = PreparedScene::new(&scene);
        for renderer in [&ReferenceRenderer as &dyn Renderer, &SimdRenderer::new(Precision::Double, None)] {
            let result = conforms(renderer, &scene, &DOUBLE);
            prop_assert!(result.is_ok(), "{}: {}", renderer.name(), result.unwrap_err());
        }
    }

    #[test]
    fn random_scenes_in_single_precision_are_within_its_tolerance(source in random::worlds()) {
        let scene = prepared(source);
        let result = conforms(&SimdRenderer::new(Precision::Single, None), &scene, &SINGLE);
        prop_assert!(result.is_ok(), "{}", result.unwrap_err());
    }

    /// Against the same point in 32 digits; a highlight that has fallen below a millionth of its peak is left out, as it
    /// is in maps.
    #[test]
    fn random_probes_are_within_tolerance(source in random::worlds(), toward in prop::array::uniform3(-1.0..1.0_f64)) {
        let scene = prepared(source);
        for shape in scene.scene().shapes() {
            let Geometry::Sphere(sphere) = shape.geometry else { panic!("these scenes are made of spheres") };
            let toward = Vector::from(toward);
            prop_assume!(toward.length() > 0.1);
            let point = sphere.center + toward.normalized() * sphere.radius;
            let reading = scene.probe(&ProbePosition::NearestTo(point)).expect("there are spheres");
            let primitive = reading.hit.primitive;
            let exact = precise_hit(&scene, primitive, point);
            let mut least_cosine = exact.point.cos_theta_o.rounded().abs();
            let mut faintest_lobe = 1.0_f64;
            let shininess = scene.scene().shapes()[primitive.shape].material.map_or(1.0, |material| {
                scene.scene().materials()[material].reflectance.shininess
            });
            let expected = scene.shade_precisely(&exact, |light, term| {
                if term.irradiance.rounded() > 0.0 {
                    least_cosine = least_cosine.min(cosine_of_emission(&scene.scene().lights()[light], term));
                    least_cosine = least_cosine.min(term.cos_theta_i.rounded());
                    faintest_lobe = faintest_lobe.min(term.cos_theta_h.rounded().powf(shininess));
                }
            });
            if least_cosine <= PROBE.above_cosine {
                continue;
            }
            let mut pairs = vec![
                (reading.shading.irradiance, expected.irradiance.rounded()),
                (reading.shading.diffuse, expected.diffuse.rounded()),
            ];
            if faintest_lobe > 1e-6 {
                pairs.push((reading.shading.specular, expected.specular.rounded()));
                pairs.push((reading.shading.brightness(), expected.brightness().rounded()));
            }
            for (found, expected) in pairs {
                prop_assert!((found - expected).abs() <= PROBE.relative * expected, "{found:e} {expected:e} {least_cosine}");
            }
        }
    }

    /// Bytes do not depend on the number of threads, and a region is a part of the whole.
    #[test]
    fn threads_and_regions_change_nothing(
        source in random::worlds(),
        threads in 1_usize..5,
        corner in (0_u32..32, 0_u32..24),
        size in (1_u32..32, 1_u32..24),
        is_single in any::<bool>(),
    ) {
        let scene = prepared(source);
        let settings = RenderSettings { quantities: Quantity::COMMON.to_vec(), ..RenderSettings::default() };
        let precision = if is_single { Precision::Single } else { Precision::Double };
        let renderer = |threads: usize| SimdRenderer::new(precision, threads.try_into().ok());
        let whole = renderer(1).render(&scene, &settings).expect("it renders");
        let region = Region {
            corner: Pixel { column: corner.0, row: corner.1 },
            size: Resolution { width: size.0.min(32 - corner.0), height: size.1.min(24 - corner.1) },
        };
        let settings = RenderSettings { region: Some(region), ..settings };
        let part = renderer(threads).render(&scene, &settings).expect("it renders");
        for (whole, part_of_it) in whole.channels().iter().zip(part.channels()) {
            for index in 0..part.region.size.pixels() {
                let Pixel { column, row } = part.pixel(index);
                let in_whole = row as usize * 32 + column as usize;
                prop_assert_eq!(bits(&part_of_it.values, index), bits(&whole.values, in_whole));
            }
        }
    }
}
