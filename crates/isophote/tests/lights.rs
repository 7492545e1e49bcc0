//! Spots, parallel light and ambient light against their closed forms (3.7) to (3.9).

use std::f64::consts::PI;

use isophote::analysis::probe::ProbePosition;
use isophote::lanes::Precision;
use isophote::map::Quantity;
use isophote::prepare::PreparedScene;
use isophote::reflectance::Convention;
use isophote::render::{ReferenceRenderer, RenderSettings, Renderer, SimdRenderer};
use isophote::scene::source::{AmbientSource, EmissionName, LightSource};
use isophote::scene::{Scene, SceneSource};
use isophote::vector::Vector;

fn scene_file(name: &str) -> SceneSource {
    let path = format!("{}/../../scenes/{name}", env!("CARGO_MANIFEST_DIR"));
    Scene::from_file(path.as_ref()).unwrap_or_else(|error| panic!("{error}")).source().clone()
}

fn prepared(source: SceneSource) -> PreparedScene {
    PreparedScene::new(&Scene::try_from(source).unwrap_or_else(|error| panic!("{error}")))
}

fn irradiance(scene: &PreparedScene, direction: Vector) -> f64 {
    scene.probe(&ProbePosition::NearestTo(direction)).expect("there is a sphere").shading.irradiance
}

/// E = E₀ cosβ, wherever the sphere is and however large; the flux is that through its shadow, π R² E₀.
#[test]
fn a_sphere_in_the_sun_has_the_irradiance_of_the_cosine() {
    let scene = prepared(scene_file("sun.toml"));
    let sun = Vector::new(0.6, 0.8, 0.0);
    let across = Vector::new(0.8, -0.6, 0.0);
    for degrees in 0..=180_i32 {
        let beta = f64::from(degrees).to_radians();
        let expected = 1000.0 * beta.cos().max(0.0);
        let found = irradiance(&scene, sun * beta.cos() + across * beta.sin());
        assert!((found - expected).abs() <= 1e-12 * expected.max(10.0), "β = {degrees}°: {found} {expected}");
    }
    let steps = 1000;
    let band = |index: i32| {
        let cosine = (f64::from(index) + 0.5) / f64::from(steps);
        irradiance(&scene, sun * cosine + across * (1.0 - cosine * cosine).sqrt()) / f64::from(steps)
    };
    let flux = 2.0 * PI * (0..steps).map(band).sum::<f64>();
    assert!((flux / (PI * 1000.0) - 1.0).abs() < 1e-9, "{flux}");
}

/// Nothing falls off with the distance and nothing depends on the length unit.
#[test]
fn the_sun_is_as_strong_everywhere() {
    let mut source = scene_file("sun.toml");
    source.probe.clear();
    source.sphere[0].center = Some([1e6, -2e6, 3e6]);
    source.sphere[0].radius = Some(1e3);
    let far = prepared(source);
    let near = prepared(scene_file("sun.toml"));
    for direction in [Vector::new(0.0, 1.0, 0.0), Vector::new(0.6, 0.0, 0.8), Vector::new(0.48, 0.64, 0.6)] {
        let place = Vector::new(1e6, -2e6, 3e6) + direction * 1e3;
        let [found, expected] = [irradiance(&far, place), irradiance(&near, direction)];
        assert!((found / expected - 1.0).abs() < 1e-8, "{found} {expected}");
    }
}

/// (3.7): as an isotropic light within the inner cone, nothing outside the outer one, half of it where cosγ is in the middle.
#[test]
fn a_spot_lights_its_cone() {
    let mut source = scene_file("sun.toml");
    source.probe.clear();
    let isotropic =
        LightSource { position: Some([0.0, 0.0, 3.0]), intensity: Some(50.0.into()), ..LightSource::default() };
    let spot = LightSource {
        emission: Some(EmissionName::Spot),
        axis: Some([0.0, 0.0, -2.0]),
        inner_angle: Some(5.0),
        outer_angle: Some(12.0),
        ..isotropic.clone()
    };
    let with = |light: LightSource| prepared(SceneSource { light: vec![light], ..source.clone() });
    let (isotropic, spot) = (with(isotropic), with(spot));
    let [inner, outer] = [5.0_f64, 12.0].map(|angle| angle.to_radians().cos());
    for tenths in 0..500_i32 {
        let beta = f64::from(tenths) * 0.1_f64.to_radians();
        let point = Vector::new(beta.sin(), 0.0, beta.cos());
        let gamma = point.x.atan2(3.0 - point.z);
        let x = ((gamma.cos() - outer) / (inner - outer)).clamp(0.0, 1.0);
        let expected = irradiance(&isotropic, point) * x * x * (3.0 - 2.0 * x);
        let found = irradiance(&spot, point);
        assert!((found - expected).abs() <= 1e-11 * irradiance(&isotropic, point), "{gamma}: {found} {expected}");
    }
}

/// (3.9): without lights E = π L_a at every point, in every renderer and convention.
#[test]
fn ambient_light_alone_gives_the_same_irradiance_everywhere() {
    for convention in [Convention::Irradiance, Convention::Lambert, Convention::Lab, Convention::Radiance] {
        let mut source = scene_file("two-lights.toml");
        source.light.clear();
        source.ambient = Some(AmbientSource { radiance: Some(7.0.into()), ..AmbientSource::default() });
        source.convention = Some(convention);
        let scene = prepared(source);
        let renderers: [&dyn Renderer; 3] = [
            &ReferenceRenderer,
            &SimdRenderer::new(Precision::Double, None),
            &SimdRenderer::new(Precision::Single, None),
        ];
        for (renderer, allowed) in renderers.into_iter().zip([1e-15, 1e-15, 1e-7]) {
            let settings = RenderSettings { quantities: Quantity::COMMON.to_vec(), ..RenderSettings::default() };
            let map = renderer.render(&scene, &settings).expect("it renders");
            let value = |quantity: Quantity, index| map.scalar(&quantity).expect("asked for").at(index);
            assert!(map.mask().visible() > 10_000);
            for index in map.mask().indices() {
                let expected = PI * 7.0;
                for quantity in [Quantity::Irradiance, Quantity::Ambient] {
                    assert!((value(quantity, index) / expected - 1.0).abs() <= allowed);
                }
                let k_d = if map.mask().shape_at(index) == Some(0) { 0.9 } else { 0.4 };
                let expected = match convention {
                    Convention::Irradiance => expected,
                    Convention::Lambert => k_d * expected,
                    Convention::Radiance => k_d * 7.0,
                    _ => k_d * expected * scene.trace_pixel(map.pixel(index)).expect("seen").point.cos_theta_o,
                };
                let found = value(Quantity::Brightness, index);
                // cosθ_o of (3.3) is as exact as maps are.
                let allowed =
                    if convention == Convention::Lab { f64::max(4.0 * allowed, 1e-12) } else { 4.0 * allowed };
                assert!((found - expected).abs() <= allowed * 21.0, "{convention:?}: {found} {expected}");
                assert_eq!(value(Quantity::Specular, index), 0.0);
            }
        }
    }
}

/// The irradiance is the sum of what the lights give by themselves and of the ambient light, which is in none of them.
#[test]
fn ambient_light_belongs_to_no_light() {
    let scene = prepared(scene_file("ambient.toml"));
    let lamp = Quantity::Light("lamp".into());
    let quantities = vec![Quantity::Irradiance, Quantity::Ambient, lamp.clone()];
    let settings = RenderSettings { quantities, ..RenderSettings::default() };
    for renderer in [&ReferenceRenderer as &dyn Renderer, &SimdRenderer::new(Precision::Double, None)] {
        let map = renderer.render(&scene, &settings).expect("it renders");
        let [irradiance, ambient, lamp] =
            [&Quantity::Irradiance, &Quantity::Ambient, &lamp].map(|quantity| map.scalar(quantity).expect("asked for"));
        for index in 0..map.region.size.pixels() {
            let sum = ambient.at(index) + lamp.at(index);
            assert!((irradiance.at(index) - sum).abs() <= 1e-15 * sum);
        }
        assert!(map.mask().indices().any(|index| lamp.at(index) == 0.0 && irradiance.at(index) == 0.25 * PI));
    }
}

/// A parallel light is outside every shape: from inside, it lights nothing.
#[test]
fn the_sun_does_not_shine_into_a_closed_sphere() {
    let mut source = scene_file("sun.toml");
    source.probe.clear();
    let camera = source.camera.get_or_insert_default();
    camera.eye = Some([0.1, 0.0, 0.2]);
    let scene = Scene::try_from(source).unwrap_or_else(|error| panic!("{error}"));
    let warning = &scene.warnings()[0];
    assert_eq!(warning.path, "light[0].direction");
    assert!(warning.message.to_string().contains("lights nothing there"), "{}", warning.message);
    let scene = PreparedScene::new(&scene);
    let reading = scene.probe(&ProbePosition::NearestTo(Vector::new(-0.6, -0.8, 0.0))).expect("there is a sphere");
    assert!(reading.terms[0].cos_theta_i > 0.9, "it would shine on it");
    assert_eq!(reading.shading.irradiance, 0.0);
}

/// A light aimed by tilt and azimuth is the same as one aimed by the axis that they mean.
#[test]
fn a_light_shines_along_the_direction_of_its_angles() {
    let by_axis = |axis: [f64; 3]| LightSource { axis: Some(axis), ..LightSource::default() };
    let by_angles =
        |tilt: f64, azimuth: Option<f64>| LightSource { tilt: Some(tilt), azimuth, ..LightSource::default() };
    let (sin, cos) = (0.5, 0.75_f64.sqrt());
    for (angles, axis) in [
        (by_angles(0.0, None), [0.0, 0.0, -1.0]),
        (by_angles(0.0, Some(10.0)), [0.0, 0.0, -1.0]),
        (by_angles(90.0, Some(180.0)), [-1.0, 0.0, 0.0]),
        (by_angles(30.0, Some(60.0)), [sin * 0.5, sin * cos, -cos]),
    ] {
        let with = |light: LightSource| {
            let mut source = scene_file("sun.toml");
            let place = axis.map(|coordinate: f64| -3.0 * coordinate);
            let (position, intensity) = (Some(place), Some(100.0.into()));
            source.light = vec![LightSource { emission: Some(EmissionName::Lambertian), position, intensity, ..light }];
            prepared(source)
        };
        let [found, expected] =
            [with(angles), with(by_axis(axis))].map(|scene| irradiance(&scene, Vector::from(axis) * -1.0));
        assert!((expected - 25.0).abs() < 1e-12 && (found - expected).abs() < 1e-13, "{axis:?}: {found} {expected}");
    }
}

/// A light that is switched off is as good as none, in every renderer, but keeps its name.
#[test]
fn a_light_that_is_off_gives_no_light() {
    let with = |change: fn(&mut Vec<LightSource>)| {
        let mut source = scene_file("two-lights.toml");
        source.camera.get_or_insert_default().resolution = Some([60, 45]);
        change(&mut source.light);
        prepared(source)
    };
    let off = with(|lights| lights[1].on = Some(false));
    let without = with(|lights| drop(lights.pop()));
    assert_eq!(off.scene().lights().len(), 2);
    assert!(!off.scene().lights()[1].is_on && off.scene().lights()[0].is_on);
    let renderers: [&dyn Renderer; 2] = [&ReferenceRenderer, &SimdRenderer::new(Precision::Double, None)];
    for renderer in renderers {
        let settings = RenderSettings { quantities: Quantity::COMMON.to_vec(), ..RenderSettings::default() };
        let [off, without] = [&off, &without].map(|scene| renderer.render(scene, &settings).expect("it renders"));
        for (off, without) in off.channels().iter().zip(without.channels()) {
            assert!(off.values == without.values, "{}", off.quantity.name());
        }
    }
    let reading = off.probe(&ProbePosition::Pixel(isophote::map::Pixel { column: 20, row: 20 }));
    if let Ok(reading) = reading {
        assert_eq!(reading.terms[1].irradiance, 0.0);
        assert!(reading.explain(&off, "here", isophote::text::Language::English).contains("switched off"));
    }
}
