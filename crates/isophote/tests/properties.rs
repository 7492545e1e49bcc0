//! What holds for any scene (docs/physics.md, the end of section 5).

mod random;

use isophote::map::Quantity;
use isophote::prepare::PreparedScene;
use isophote::reflectance::Convention;
use isophote::render::{ReferenceRenderer, RenderSettings, Renderer};
use isophote::scene::{Scene, SceneSource};
use isophote::units::LengthUnit;
use proptest::prelude::*;

/// A rendered scene, pixel by pixel.
struct Rendered {
    brightness: Vec<f64>,
    shapes: Vec<i32>,
    cos_theta_o: Vec<f64>,
}

fn render(source: &SceneSource) -> Rendered {
    let scene = Scene::try_from(source.clone()).unwrap_or_else(|error| panic!("{error}"));
    let scene = PreparedScene::new(&scene);
    let settings = RenderSettings { quantities: vec![Quantity::Brightness], ..RenderSettings::default() };
    let map = ReferenceRenderer.render(&scene, &settings).expect("it renders");
    let cosine = |index| scene.trace_pixel(map.pixel(index)).map_or(1.0, |hit| hit.point.cos_theta_o);
    Rendered {
        brightness: map.scalar(&Quantity::Brightness).expect("asked for").iter().collect(),
        shapes: map.mask().shapes(),
        cos_theta_o: (0..map.region.size.pixels()).map(cosine).collect(),
    }
}

/// Equal to a part of the peak, for changes that round nothing or nothing but the sum.
fn assert_equal(found: &Rendered, expected: &Rendered, factor: f64, of_peak: f64) {
    assert_eq!(found.shapes, expected.shapes);
    assert_close(found, expected, factor, |_| of_peak);
}

/// Equal to a part of the peak over cosθ_o, for changes that round the places of things: the limb feels those as
/// 1/cosθ_o, and a few rays that graze it may see something else.
fn assert_equal_but_for_rounded_places(found: &Rendered, expected: &Rendered, factor: f64, of_peak: f64) {
    let differing = found.shapes.iter().zip(&expected.shapes).filter(|(found, expected)| found != expected).count();
    assert!(differing <= 2, "{differing} pixels see something else");
    assert_close(found, expected, factor, |index| of_peak / expected.cos_theta_o[index]);
}

fn assert_close(found: &Rendered, expected: &Rendered, factor: f64, of_peak: impl Fn(usize) -> f64) {
    let peak = expected.brightness.iter().copied().fold(0.0, f64::max) * factor;
    for (index, (found_value, value)) in found.brightness.iter().zip(&expected.brightness).enumerate() {
        let error = (found_value - value * factor).abs();
        let is_same_shape = found.shapes[index] == expected.shapes[index];
        assert!(!is_same_shape || error <= of_peak(index) * peak, "pixel {index}: {found_value} {}", value * factor);
    }
}

fn map_points(source: &mut SceneSource, map: impl Fn([f64; 3]) -> [f64; 3]) {
    let camera = source.camera.get_or_insert_default();
    camera.eye = camera.eye.map(&map);
    camera.target = camera.target.map(&map);
    for sphere in &mut source.sphere {
        sphere.center = sphere.center.map(&map);
    }
    for light in &mut source.light {
        light.position = light.position.map(&map);
        light.target = light.target.map(&map);
    }
}

proptest! {
    #![proptest_config(random::config(64))]

    #[test]
    fn brightness_is_linear_in_the_intensities(mut source in random::scenes(), factor in 0.1..50.0_f64) {
        let before = render(&source);
        for light in &mut source.light {
            light.intensity = light.intensity.map(|intensity| intensity.map(|number| number * factor));
        }
        assert_equal(&render(&source), &before, factor, 1e-15);
    }

    /// Lights are put out rather than removed: the steepest edge of a scene's cones decides which rays are traced again with
    /// more digits, and the points on the two sides of the sum have to be the same to the last bit.
    #[test]
    fn brightness_is_additive_over_the_lights(source in random::scenes(), split in 0_usize..5) {
        let (mut first, mut second) = (source.clone(), source.clone());
        for index in 0..source.light.len() {
            let put_out = if index < split { &mut second.light[index] } else { &mut first.light[index] };
            put_out.intensity = put_out.intensity.map(|intensity| intensity.map(|_| 0.0));
        }
        let (whole, first, second) = (render(&source), render(&first), render(&second));
        let brightness = first.brightness.iter().zip(&second.brightness).map(|(first, second)| first + second).collect();
        let sum = Rendered { brightness, ..first };
        assert_equal(&sum, &whole, 1.0, 1e-15);
    }

    #[test]
    fn swapping_lights_changes_nothing(mut source in random::worlds()) {
        let before = render(&source);
        source.light.reverse();
        assert_equal(&render(&source), &before, 1.0, 1e-15);
    }

    /// All lengths × s: E × 1/s². A power of two scales without rounding, so that the maps agree to the last bits.
    #[test]
    fn brightness_falls_with_the_square_of_the_scale(mut source in random::scenes(), exponent in -10_i32..10) {
        let scale = 2.0_f64.powi(exponent);
        let before = render(&source);
        map_points(&mut source, |point| point.map(|coordinate| coordinate * scale));
        let screen = source.camera.get_or_insert_default().screen.get_or_insert_default();
        screen.distance = screen.distance.map(|length| length * scale);
        screen.x = screen.x.map(|edges| edges.map(|edge| edge * scale));
        screen.y = screen.y.map(|edges| edges.map(|edge| edge * scale));
        for sphere in &mut source.sphere {
            sphere.radius = sphere.radius.map(|radius| radius * scale);
        }
        assert_equal(&render(&source), &before, 1.0 / (scale * scale), 1e-12);
    }

    /// 1 W/sr at 1 mm is a million times as bright as at 1 m.
    #[test]
    fn the_length_unit_is_minded(mut source in random::scenes()) {
        source.length = Some(LengthUnit::Metre);
        let metres = render(&source);
        source.length = Some(LengthUnit::Millimetre);
        assert_equal_but_for_rounded_places(&render(&source), &metres, 1e6, 1e-11);
    }

    #[test]
    fn brightness_is_invariant_under_rigid_motion(
        mut source in random::scenes(),
        turn in 0.0..6.3_f64,
        tilt in 0.0..6.3_f64,
        shift in prop::array::uniform3(-20.0..20.0_f64),
    ) {
        let before = render(&source);
        let (sin, cos) = turn.sin_cos();
        let (sin_tilt, cos_tilt) = tilt.sin_cos();
        let turned = |[x, y, z]: [f64; 3]| {
            let (x, y) = (x * cos - y * sin, x * sin + y * cos);
            [x, y * cos_tilt - z * sin_tilt, y * sin_tilt + z * cos_tilt]
        };
        map_points(&mut source, |point| {
            let [x, y, z] = turned(point);
            [x + shift[0], y + shift[1], z + shift[2]]
        });
        let camera = source.camera.get_or_insert_default();
        camera.up = camera.up.map(turned);
        assert_equal_but_for_rounded_places(&render(&source), &before, 1.0, 1e-10);
    }

    /// (3.3) ≤ (3.4) pixel by pixel: cosθ_o ≤ 1.
    #[test]
    fn the_lab_convention_is_never_brighter_than_the_course_convention(mut source in random::worlds()) {
        source.convention = Some(Convention::Lab);
        let lab = render(&source);
        source.convention = Some(Convention::Course);
        let course = render(&source);
        for (lab, course) in lab.brightness.iter().zip(&course.brightness) {
            prop_assert!(*lab <= course * (1.0 + 1e-15), "{lab} {course}");
        }
    }

    /// Mirrored scenes seen with the other handedness give the same picture (2.3).
    #[test]
    fn handedness_mirrors_space(mut source in random::scenes()) {
        use isophote::camera::Handedness;
        let before = render(&source);
        map_points(&mut source, |[x, y, z]| [x, y, -z]);
        let camera = source.camera.get_or_insert_default();
        camera.up = camera.up.map(|[x, y, z]| [x, y, -z]);
        source.handedness = source.handedness.map(|handedness| match handedness {
            Handedness::Left => Handedness::Right,
            Handedness::Right => Handedness::Left,
        });
        assert_equal(&render(&source), &before, 1.0, 1e-15);
    }

    #[test]
    fn a_scene_survives_being_written_and_read(source in random::worlds()) {
        let text = source.to_toml();
        let again = Scene::from_text("again", &text, isophote::scene::Syntax::Toml).expect("it is valid");
        prop_assert_eq!(again.source(), &source);
    }
}
