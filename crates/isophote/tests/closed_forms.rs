//! The closed forms of docs/physics.md, section 5, to the precision that is promised.

use isophote::analysis::probe::ProbePosition;
use isophote::light::{Emission, Emitters, Light, LightKind, PointLight};
use isophote::prepare::PreparedScene;
use isophote::reflectance::{BrightnessFormula, Convention, Reflectance};
use isophote::scene::{Scene, Syntax};
use isophote::shade::light_term;
use isophote::shape::SurfacePoint;
use isophote::vector::Vector;
use serde_json::Value;

fn scene(file: &str) -> PreparedScene {
    let path = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes")).join(file);
    PreparedScene::new(&Scene::from_file(&path).unwrap_or_else(|error| panic!("{error}")))
}

fn number(value: &Value) -> f64 {
    value.as_f64().or_else(|| value.as_str().and_then(|text| text.parse().ok())).expect("a number")
}

fn reference(name: &str) -> Value {
    let path = format!("{}/tests/reference/{name}", env!("CARGO_MANIFEST_DIR"));
    serde_json::from_str(&std::fs::read_to_string(path).expect("it is in the repository")).expect("it is JSON")
}

fn assert_relative(actual: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((actual - expected).abs() <= tolerance * expected.abs(), "{what}: {actual} instead of {expected}");
}

/// The four points of the lab, in three conventions.
#[test]
fn the_lab_points_have_the_values_of_the_formulas() {
    let table = reference("lab.json");
    let source = scene("lab.toml").scene().source().clone();
    for (key, convention) in
        [("irradiance", Convention::Irradiance), ("lambert", Convention::Lambert), ("lab", Convention::Lab)]
    {
        let mut source = source.clone();
        source.convention = Some(convention);
        let prepared = PreparedScene::new(&Scene::try_from(source).expect("it is valid"));
        for (probe, row) in prepared.scene().probes().iter().zip(table["probes"].as_array().expect("rows")) {
            let reading = prepared.probe(&ProbePosition::Point(probe.at)).expect("it is on the sphere");
            assert_eq!(probe.name, row["name"]);
            assert_relative(reading.shading.brightness(), number(&row[key]), 1e-12, &format!("{} {key}", probe.name));
            assert_relative(reading.shading.irradiance, number(&row["irradiance"]), 1e-12, &probe.name);
            assert_eq!(probe.published, Some(number(&row["printed_value"])));
        }
    }
}

/// (5.1), (5.2): relative to 1e-12, near the terminator to 1e-12 of the peak.
#[test]
fn a_sphere_under_a_point_source_has_the_irradiance_of_the_closed_form() {
    let table = reference("closed_forms.json");
    for (file, key) in [("closed-form-5.1.toml", "isotropic"), ("closed-form-5.2.toml", "lambertian")] {
        let prepared = scene(file);
        let peak = number(&table["sphere_source"]["rows"][0][key]);
        for row in table["sphere_source"]["rows"].as_array().expect("rows") {
            let beta = number(&row["beta_deg"]).to_radians();
            let direction = Vector::new(beta.sin(), beta.cos(), 0.0);
            let reading = prepared.probe(&ProbePosition::Point(direction * 0.25)).expect("it is on the sphere");
            let expected = number(&row[key]);
            let error = (reading.shading.irradiance - expected).abs();
            let near_terminator = reading.terms[0].cos_theta_i < 0.1;
            let allowed = if near_terminator { 1e-12 * peak } else { 1e-12 * expected };
            assert!(error <= allowed, "{key} β = {}: {error:e}", row["beta_deg"]);
        }
    }
}

/// (5.3): the flux on the whole sphere, 2πR² ∫ E dcosβ by Gauss-Legendre from the terminator up.
#[test]
fn the_flux_on_a_sphere_is_that_of_the_closed_form() {
    let table = reference("closed_forms.json");
    for (file, key) in [("closed-form-5.1.toml", "flux_isotropic"), ("closed-form-5.2.toml", "flux_lambertian")] {
        let prepared = scene(file);
        let lowest = 0.25 / 1.6;
        let flux = 2.0
            * std::f64::consts::PI
            * 0.25
            * 0.25
            * integrate(lowest, 1.0, |cosine| {
                let direction = Vector::new((1.0 - cosine * cosine).sqrt(), cosine, 0.0);
                prepared.probe(&ProbePosition::NearestTo(direction * 0.25)).expect("it is there").shading.irradiance
            });
        assert_relative(flux, number(&table["sphere_source"][key]), 1e-12, key);
    }
}

/// (5.8): the eye is where the lamp is, so that H = L = V and N·H = cosθ_i; the highlight does not fade at the terminator.
#[test]
fn the_highlight_of_blinn_phong_is_not_multiplied_by_the_cosine() {
    for (convention, divisor) in [("blinn-phong", 1.0), ("blinn-phong-pi", std::f64::consts::PI)] {
        let text = format!(
            r#"
            version = 1
            length = "m"
            convention = "{convention}"
            camera.eye = [0, 0, 1.6]
            camera.target = [0, 0, 0]
            camera.up = [0, 1, 0]
            camera.screen = {{ distance = 1.6, x = [-0.4, 0.4], y = [-0.4, 0.4] }}
            material.clay = {{ diffuse = 0.7, specular = 0.3, shininess = 20 }}
            [[sphere]]
            center = [0, 0, 0]
            radius = 0.25
            material = "clay"
            [[light]]
            position = [0, 0, 1.6]
            intensity = 100
            "#
        );
        let scene = Scene::from_text("beside the lamp", &text, Syntax::Toml).unwrap_or_else(|error| panic!("{error}"));
        let prepared = PreparedScene::new(&scene);
        for degrees in [0.0, 10.0, 30.0, 60.0, 75.0, 81.0, 81.1, 120.0_f64] {
            let beta = degrees.to_radians();
            let point = Vector::new(0.25 * beta.sin(), 0.0, 0.25 * beta.cos());
            let reading = prepared.probe(&ProbePosition::NearestTo(point)).expect("it is there");
            let squared: f64 = 0.25 * 0.25 + 1.6 * 1.6 - 2.0 * 0.25 * 1.6 * beta.cos();
            let cosine = (1.6 * beta.cos() - 0.25) / squared.sqrt();
            let across = 100.0 / squared;
            let expected = if cosine > 0.0 { across * (0.7 * cosine + 0.3 * cosine.powf(20.0)) / divisor } else { 0.0 };
            let allowed = if cosine < 0.1 { 1e-12 * across } else { 1e-12 * expected };
            let found = reading.shading.brightness();
            assert!((found - expected).abs() <= allowed, "{convention}, {degrees}°: {found:e} {expected:e}");
        }
    }
}

/// (3.11): just above the horizon the highlight is all there, I/r² k_s (N·H)ⁿ; below it there is none.
#[test]
fn the_highlight_of_blinn_phong_jumps_at_the_terminator() {
    let material = Reflectance { diffuse: 0.7, specular: 0.3, shininess: 2.0 };
    let formula = BrightnessFormula::new(Convention::BlinnPhong, &material);
    let light = |height: f64| {
        let kind = LightKind::Point(PointLight {
            position: Vector::new(2.0, height, 0.0),
            intensity: 100.0,
            emission: Emission::Isotropic,
        });
        let light = Light { name: "source".into(), kind, casts_shadows: true, is_on: true };
        let normal = Vector::new(0.0, 1.0, 0.0);
        let (anchor, offset) = (Vector::default(), Vector::default());
        let point = SurfacePoint { anchor, offset, normal, view: normal, cos_theta_o: 1.0 };
        isophote::shade::shade(&point, Emitters::of(&[light]).all(), &formula, 0.0, |_| 1.0, |_, _| {}).specular
    };
    // N·H = cos 45°, and n is 2.
    assert_relative(light(1e-9), 100.0 / 4.0 * 0.3 * 0.5, 1e-8, "above the horizon");
    assert_eq!([light(0.0), light(-1e-9)], [0.0, 0.0]);
}

/// (5.4): a plane under a Lambertian source; the plane's point is made by hand, the formula is the one in use.
#[test]
fn a_plane_under_a_lambertian_source_has_the_irradiance_of_cie_171_case_5_2() {
    let table = reference("cie171_5_2.json");
    let (intensity, height) = (number(&table["intensity"]), number(&table["height"]));
    let axis = Vector::new(0.0, -1.0, 0.0);
    let light = Light {
        name: "source".into(),
        kind: LightKind::Point(PointLight {
            position: Vector::new(0.0, height, 0.0),
            intensity,
            emission: Emission::Lambertian { axis },
        }),
        casts_shadows: true,
        is_on: true,
    };
    let [emitter] = *Emitters::of(&[light]).all() else { panic!("a point light is one emitter") };
    let material = Reflectance { diffuse: 0.0, specular: 0.0, shininess: 1.0 };
    let formula = BrightnessFormula::new(Convention::Irradiance, &material);
    for row in table["rows"].as_array().expect("rows") {
        let point = SurfacePoint {
            anchor: Vector::default(),
            offset: Vector::new(number(&row["x"]), 0.0, number(&row["y"])),
            normal: Vector::new(0.0, 1.0, 0.0),
            view: Vector::new(0.0, 1.0, 0.0),
            cos_theta_o: 1.0,
        };
        let irradiance = light_term(&point, &emitter.seen_from(point.anchor), 1.0, &formula.lobe()).irradiance;
        assert_relative(irradiance, number(&row["exact"]), 1e-12, "exact");
        // The published table is rounded by hand: its entries are off by up to 0.023.
        assert!((irradiance - number(&row["published"])).abs() < 0.025, "{row}");
    }
}

/// (5.4) on planes of a scene, lying and slanted: the light stands at the height over the plane's point.
#[test]
fn a_plane_of_a_scene_has_the_irradiance_of_cie_171_case_5_2() {
    let table = reference("cie171_5_2.json");
    let (intensity, height) = (number(&table["intensity"]), number(&table["height"]));
    for [first, normal, second] in
        [[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], [[0.36, -0.8, 0.48], [0.48, 0.6, 0.64], [0.8, 0.0, -0.6]]]
    {
        let [first, normal, second] = [first, normal, second].map(Vector::from);
        let source = normal * height;
        let text = format!(
            "version = 1\nlength = \"m\"\nconvention = \"irradiance\"\n\
             plane = [{{ point = [0, 0, 0], normal = {:?} }}]\n\
             light = [{{ position = {:?}, target = [0, 0, 0], emission = \"lambertian\", intensity = {intensity} }}]\n\
             [camera]\neye = [1, 30, 1]\nforward = [1, -1, 1]\nscreen = {{ distance = 1, x = [-1, 1], y = [-1, 1] }}\n",
            normal.to_array(),
            source.to_array()
        );
        let scene =
            Scene::from_text("plane", &text, isophote::scene::Syntax::Toml).unwrap_or_else(|error| panic!("{error}"));
        let prepared = PreparedScene::new(&scene);
        for row in table["rows"].as_array().expect("rows") {
            let point = first * number(&row["x"]) + second * number(&row["y"]);
            let reading = prepared.probe(&ProbePosition::NearestTo(point)).expect("it is there");
            assert_relative(reading.shading.irradiance, number(&row["exact"]), 1e-12, "exact");
        }
    }
}

/// (5.5): the intensity of the whole disc, ∫ B cosθ_o dA over the part that is both lit and seen. At a distance of
/// 1e6 radii the far-field law holds to about 1e-6.
#[test]
fn a_distant_lambert_sphere_follows_the_phase_law() {
    let table = reference("closed_forms.json");
    let source = scene("closed-form-5.5.toml").scene().source().clone();
    for row in table["lambert_phase"].as_array().expect("rows") {
        let alpha = number(&row["alpha_deg"]).to_radians();
        let mut source = source.clone();
        source.light[0].position = Some([1e6 * alpha.sin(), 0.0, 1e6 * alpha.cos()]);
        let prepared = PreparedScene::new(&Scene::try_from(source).expect("it is valid"));
        // Longitude from the direction of the viewer, towards the light; latitude from the plane of both.
        let half_pi = std::f64::consts::FRAC_PI_2;
        let intensity = integrate(alpha - half_pi, half_pi, |longitude| {
            integrate(-half_pi, half_pi, |latitude| {
                let ring = latitude.cos();
                let direction = Vector::new(ring * longitude.sin(), latitude.sin(), ring * longitude.cos());
                let reading = prepared.probe(&ProbePosition::NearestTo(direction)).expect("it is there");
                reading.shading.brightness() * reading.hit.point.cos_theta_o.max(0.0) * ring
            })
        });
        let full = 2.0 / 3.0 * std::f64::consts::PI;
        let error = (intensity / full - number(&row["value"])).abs();
        assert!(error < 5e-6, "α = {}: {error:e}", row["alpha_deg"]);
    }
}

/// (5.6): rays just inside the silhouette's radius hit, rays just outside miss, to the last digits.
#[test]
fn the_silhouette_has_the_radius_of_the_closed_form() {
    use isophote::camera::ScreenPosition;
    let radius = number(&reference("closed_forms.json")["silhouette"]["screen_radius"]);
    let prepared = scene("closed-form-5.6.toml");
    for step in 0..360 {
        let (sine, cosine) = f64::from(step).to_radians().sin_cos();
        let at = |radius: f64| prepared.trace(ScreenPosition::Point { x: radius * cosine, y: radius * sine });
        assert!(at(radius * (1.0 - 1e-15)).is_some(), "{step}° inside");
        assert!(at(radius * (1.0 + 1e-15)).is_none(), "{step}° outside");
    }
}

/// ∫ f by Gauss-Legendre with 20 points on each of 8 equal parts.
fn integrate(from: f64, to: f64, f: impl Fn(f64) -> f64) -> f64 {
    let nodes = legendre_nodes(20);
    let parts = 8;
    let width = (to - from) / f64::from(parts);
    (0..parts)
        .map(|part| {
            let middle = from + width * (f64::from(part) + 0.5);
            nodes.iter().map(|(node, weight)| weight * f(middle + 0.5 * width * node)).sum::<f64>() * 0.5 * width
        })
        .sum()
}

/// Nodes and weights on −1…1, by Newton's method on the Legendre polynomial.
fn legendre_nodes(count: u32) -> Vec<(f64, f64)> {
    (0..count)
        .map(|index| {
            let mut x = (std::f64::consts::PI * (f64::from(index) + 0.75) / (f64::from(count) + 0.5)).cos();
            let mut slope = 0.0;
            for _ in 0..20 {
                let (mut before, mut value) = (1.0, x);
                for n in 1..count {
                    let n = f64::from(n);
                    (before, value) = (value, ((2.0 * n + 1.0) * x * value - n * before) / (n + 1.0));
                }
                slope = f64::from(count) * (x * value - before) / (x * x - 1.0);
                x -= value / slope;
            }
            (x, 2.0 / ((1.0 - x * x) * slope * slope))
        })
        .collect()
}
