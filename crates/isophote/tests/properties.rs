//! What holds for any scene (docs/physics.md, the end of section 5).

mod random;

use isophote::map::Quantity;
use isophote::prepare::PreparedScene;
use isophote::reflectance::Convention;
use isophote::render::{Reference, RenderSettings, Renderer};
use isophote::scene::{Scene, SceneSource};
use isophote::units::LengthUnit;
use proptest::prelude::*;

/// Brightness of every pixel, and which shape it sees.
fn render(source: &SceneSource) -> (Vec<f64>, Vec<i32>) {
    let scene = Scene::try_from(source.clone()).unwrap_or_else(|error| panic!("{error}"));
    let settings = RenderSettings { quantities: vec![Quantity::Brightness], ..RenderSettings::default() };
    let map = Reference.render(&PreparedScene::new(&scene), &settings).expect("it renders");
    (map.scalar(&Quantity::Brightness).expect("asked for").to_vec(), map.shapes().to_vec())
}

fn peak(values: &[f64]) -> f64 {
    values.iter().copied().fold(0.0, f64::max)
}

/// Equal to a part of the peak; pixels whose shape differs (rays that graze a limb) must be few.
fn assert_equal(found: &(Vec<f64>, Vec<i32>), expected: &(Vec<f64>, Vec<i32>), factor: f64, tolerance: f64) {
    let peak = peak(&expected.0) * factor;
    let mut differing = 0;
    for (index, (found_value, value)) in found.0.iter().zip(&expected.0).enumerate() {
        if found.1[index] != expected.1[index] {
            differing += 1;
            continue;
        }
        let error = (found_value - value * factor).abs();
        assert!(error <= tolerance * peak, "pixel {index}: {found_value} {}", value * factor);
    }
    assert!(differing <= 2, "{differing} pixels see something else");
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
            light.intensity = light.intensity.map(|intensity| intensity * factor);
        }
        assert_equal(&render(&source), &before, factor, 1e-15);
    }

    #[test]
    fn brightness_is_additive_over_the_lights(source in random::scenes(), split in 0_usize..5) {
        let split = split.min(source.light.len());
        let (mut first, mut second) = (source.clone(), source.clone());
        first.light.truncate(split);
        second.light.drain(..split);
        let (whole, first, second) = (render(&source), render(&first), render(&second));
        let sum = (first.0.iter().zip(&second.0).map(|(first, second)| first + second).collect(), first.1);
        assert_equal(&sum, &whole, 1.0, 1e-15);
    }

    #[test]
    fn swapping_lights_changes_nothing(mut source in random::scenes()) {
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
        assert_equal(&render(&source), &metres, 1e6, 1e-11);
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
        // Turned and shifted places are rounded, which the limb feels as 1/cosθ_o.
        assert_equal(&render(&source), &before, 1.0, 1e-9);
    }

    /// (3.3) ≤ (3.4) pixel by pixel: cosθ_o ≤ 1.
    #[test]
    fn the_lab_convention_is_never_brighter_than_the_course_convention(mut source in random::scenes()) {
        source.convention = Some(Convention::Lab);
        let lab = render(&source);
        source.convention = Some(Convention::Course);
        let course = render(&source);
        for (lab, course) in lab.0.iter().zip(&course.0) {
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
    fn a_scene_survives_being_written_and_read(source in random::scenes()) {
        let text = source.to_toml();
        let again = Scene::from_text("again", &text, isophote::scene::Syntax::Toml).expect("it is valid");
        prop_assert_eq!(again.source(), &source);
    }
}
