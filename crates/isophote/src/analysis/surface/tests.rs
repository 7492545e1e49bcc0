use super::*;
use crate::analysis::probe::{ProbePosition, ProbeReading};
use crate::scene::{Scene, Syntax};
use std::f64::consts::PI;

const HEAD: &str = "version = 1\nlength = \"m\"\nconvention = \"irradiance\"\n";

fn prepared(text: &str) -> PreparedScene {
    PreparedScene::new(&Scene::from_text("test", text, Syntax::Toml).unwrap_or_else(|error| panic!("{error}")))
}

fn camera(eye: [f64; 3]) -> String {
    let screen = "screen = { distance = 1, x = [-1, 1], y = [-1, 1] }";
    format!("[camera]\neye = {eye:?}\nforward = [0.1, 0.2, 0.97]\nresolution = [4, 4]\n{screen}\n")
}

/// The sphere of (5.1) and (5.2): R = 0.25, I = 100, d = 1.6.
fn ball_and_source(emission: &str) -> PreparedScene {
    let light = format!("[[light]]\nposition = [0.96, 0, 1.28]\nintensity = 100\n{emission}");
    prepared(&format!("{HEAD}{}[[sphere]]\ncenter = [0, 0, 0]\nradius = 0.25\n{light}", camera([3.0, 0.0, 0.0])))
}

const LAMBERTIAN: &str = "emission = \"lambertian\"\ntarget = [0, 0, 0]\n";

fn request() -> SurfaceRequest {
    SurfaceRequest {
        primitive: Primitive { shape: 0, part: 0 },
        projection: SurfaceProjection::Equirectangular,
        axis: None,
        side: Side::Front,
        size: None,
    }
}

#[expect(clippy::unnecessary_wraps, reason = "requests hold it so")]
fn size(width: u32, height: u32) -> Option<Resolution> {
    Some(Resolution { width, height })
}

/// The irradiance of a surface and its totals.
fn irradiance(surface: &Surface<'_>) -> (Map, SurfaceTotals) {
    let map = surface.map(&[Quantity::Irradiance]).expect("the channel exists");
    let totals = surface.totals(&map, &Quantity::Irradiance).expect("every cell has a value");
    (map, totals)
}

#[track_caller]
fn assert_close(value: f64, expected: f64, tolerance: f64) {
    assert!((value - expected).abs() <= tolerance * expected.abs(), "{value:e} is not {expected:e} to {tolerance:e}");
}

/// (5.1) and (5.2): E as a function of β, with an axis towards the source, so that cosβ is the sine of the latitude.
#[test]
fn every_cell_of_a_sphere_has_the_irradiance_of_the_closed_form() {
    let (radius, distance, intensity) = (0.25, 1.6, 100.0);
    for (emission, is_lambertian) in [("", false), (LAMBERTIAN, true)] {
        let scene = ball_and_source(emission);
        for projection in [SurfaceProjection::Equirectangular, SurfaceProjection::EqualArea] {
            let axis = Some(Vector::new(3.0, 0.0, 4.0));
            let request = SurfaceRequest { projection, axis, size: size(12, 400), ..request() };
            let surface = scene.surface(&request).expect("a sphere has coordinates");
            let (map, _) = irradiance(&surface);
            let values = map.scalar(&Quantity::Irradiance).expect("it is there");
            let mut lit = 0;
            for (index, value) in values.iter().enumerate() {
                let y = surface.coordinates(map.pixel(index))[1];
                let cosine = if projection == SurfaceProjection::EqualArea { y } else { libm::sin(y.to_radians()) };
                let square = radius * radius + distance * distance - 2.0 * radius * distance * cosine;
                let above = distance * cosine - radius;
                let pattern = if is_lambertian { (distance - radius * cosine) / square.sqrt() } else { 1.0 };
                let expected = intensity * pattern * above.max(0.0) / (square * square.sqrt());
                let cos_theta_i = above / square.sqrt();
                // Where light grazes the surface, the lost digits of the cosine are negligible compared with the whole.
                let scale = if cos_theta_i > 1e-3 { expected } else { 54.0 };
                assert!((value - expected).abs() <= 1e-12 * scale, "{value:e} {expected:e} at cosβ = {cosine}");
                lit += usize::from(value > 0.0);
            }
            assert!(lit > 1000 && lit < values.len() - 1000, "{lit}");
        }
    }
}

/// (5.3), about an axis unrelated to the source.
#[test]
fn the_flux_on_a_sphere_converges_to_the_closed_form_with_the_square_of_the_resolution() {
    let ratio: f64 = 0.25 / 1.6;
    let isotropic = 200.0 * PI * (1.0 - (1.0 - ratio * ratio).sqrt());
    let lambertian = 100.0 * PI * ratio * ratio;
    assert_close(isotropic, 7.717_297_641_8, 1e-10);
    assert_close(lambertian, 7.669_903_939_4, 1e-10);
    for (emission, flux) in [("", isotropic), (LAMBERTIAN, lambertian)] {
        let scene = ball_and_source(emission);
        for projection in [SurfaceProjection::Equirectangular, SurfaceProjection::EqualArea] {
            for axis in [Vector::new(0.0, 1.0, 0.0), Vector::new(0.3, -0.2, 0.9)] {
                for rows in [15, 30, 60, 120, 240] {
                    let request =
                        SurfaceRequest { projection, axis: Some(axis), size: size(2 * rows, rows), ..request() };
                    let surface = scene.surface(&request).expect("a sphere has coordinates");
                    let (_, totals) = irradiance(&surface);
                    let error = (totals.integral / flux - 1.0).abs();
                    let bound = 2.5 / f64::from(rows * rows);
                    assert!(error <= bound, "{projection:?} {axis:?} {rows}: {error:e} of {bound:e}");
                    assert_close(totals.mean(), totals.integral / (PI * 0.25), 1e-12);
                }
            }
        }
    }
}

#[test]
fn the_cells_of_every_shape_cover_it_once() {
    let shapes = "[[sphere]]\ncenter = [1, 2, 30]\nradius = 0.7\n\
        [[cylinder]]\nfrom = [5, 0, 0]\nto = [5, 3, 1]\nradius = 0.4\n\
        [[rectangle]]\ncenter = [-5, 0, 0]\nwidth = 2\nheight = 0.3\nnormal = [1, 1, 0]\n\
        [[disk]]\ncenter = [0, -5, 0]\nnormal = [0, 1, 2]\nradius = 1.5\n";
    let scene = prepared(&format!("{HEAD}{}{shapes}", camera([0.0, 0.0, -5.0])));
    let areas = [4.0 * PI * 0.49, 2.0 * PI * 0.4 * 10.0_f64.sqrt(), 0.6, PI * 2.25];
    for (shape, area) in areas.into_iter().enumerate() {
        for projection in [SurfaceProjection::Equirectangular, SurfaceProjection::EqualArea] {
            let primitive = Primitive { shape, part: 0 };
            let request = SurfaceRequest { primitive, projection, size: size(37, 23), ..request() };
            let surface = scene.surface(&request).expect("it has coordinates");
            let (_, totals) = irradiance(&surface);
            assert_close(totals.area, area, 1e-13);
            assert_close(surface.area(), area, 1e-13);
            assert_eq!(totals.integral, 0.0, "there is no light");
        }
    }
}

/// A light in the middle of a closed shape, whose inside is its back: everything that it emits arrives. A flat shape
/// receives what a light above it emits into the shape's solid angle.
#[test]
fn the_flux_on_every_shape_is_the_intensity_times_the_solid_angle() {
    let light = "[[light]]\nposition = [0, 0, 0]\nintensity = 3\n";
    let scene = |shape: &str| prepared(&format!("{HEAD}{}{shape}{light}", camera([0.1, 0.05, 0.0])));
    let sphere = scene("[[sphere]]\ncenter = [0, 0, 0]\nradius = 2\n");
    let cylinder = scene("[[cylinder]]\nfrom = [0, -1, 0]\nto = [0, 1, 0]\nradius = 0.5\n");
    let disk = scene("[[disk]]\ncenter = [0, 2, 0]\nnormal = [0, -1, 0]\nradius = 1.5\n");
    let rectangle = scene("[[rectangle]]\ncenter = [0, 0, 2]\nwidth = 3\nheight = 1\nnormal = [0, 0, 1]\n");
    let cases = [
        (&sphere, Side::Back, 4.0 * PI),
        (&cylinder, Side::Back, 4.0 * PI / 1.25_f64.sqrt()),
        (&disk, Side::Front, 2.0 * PI * (1.0 - 2.0 / 2.5)),
        (&rectangle, Side::Back, 4.0 * libm::atan(1.5 * 0.5 / (2.0 * 6.5_f64.sqrt()))),
    ];
    for (scene, side, solid_angle) in cases {
        for projection in [SurfaceProjection::Equirectangular, SurfaceProjection::EqualArea] {
            let request = SurfaceRequest { side, projection, size: size(200, 100), ..request() };
            let (_, totals) = irradiance(&scene.surface(&request).expect("it has coordinates"));
            assert_close(totals.integral, 3.0 * solid_angle, 1e-4);
            let other = if side == Side::Back { Side::Front } else { Side::Back };
            let request = SurfaceRequest { side: other, ..request };
            let (_, dark) = irradiance(&scene.surface(&request).expect("it has coordinates"));
            assert_eq!(dark.integral, 0.0, "the other side is dark");
        }
    }
}

const CROWD: &str = "version = 1\nlength = \"cm\"\nconvention = \"radiance\"\nshadows = true\n\
    [material.paint]\ndiffuse = 0.6\nspecular = 0.3\nshininess = 9\n\
    [[sphere]]\ncenter = [0, 0, 0]\nradius = 50\nmaterial = \"paint\"\n\
    [[sphere]]\ncenter = [60, 60, -60]\nradius = 25\nmaterial = \"paint\"\n\
    [[cylinder]]\nfrom = [100, 0, 0]\nto = [100, 90, 10]\nradius = 20\nmaterial = \"paint\"\n\
    [[rectangle]]\ncenter = [0, -60, 0]\nwidth = 200\nheight = 200\nnormal = [0, 1, 0]\nup = [0, 0, 1]\nmaterial = \"paint\"\n\
    [[disk]]\ncenter = [-90, 0, 0]\nnormal = [1, 0, 0]\nradius = 40\nmaterial = \"paint\"\n\
    [[light]]\nname = \"sun\"\nposition = [200, 210, -190]\nintensity = 40\n\
    [[light]]\nname = \"moon\"\nposition = [-30, 250, 60]\nintensity = 20\n";

fn crowd() -> PreparedScene {
    prepared(&format!("{CROWD}{}", camera([20.0, 30.0, -300.0])))
}

/// Every channel at every cell, compared with the probe at the cell's centre: two routes to the same formulas.
#[test]
fn a_cell_has_the_values_of_a_probe_at_its_centre_with_shadows() {
    let scene = crowd();
    let light = Quantity::Light("moon".into());
    let quantities = [Quantity::Irradiance, Quantity::Position, light.clone(), Quantity::Normal, Quantity::Shape];
    let of_eye = [Quantity::Brightness, Quantity::Specular, Quantity::Diffuse];
    let mut blocked = 0;
    for shape in 0..5 {
        let request = SurfaceRequest { primitive: Primitive { shape, part: 0 }, size: size(16, 11), ..request() };
        let surface = scene.surface(&request).expect("it has coordinates");
        let [all, seen] = [&quantities[..], &of_eye[..]].map(|wanted| surface.map(wanted).expect("they exist"));
        for index in 0..176 {
            let point = surface.point(all.pixel(index));
            let reading = scene.probe(&ProbePosition::NearestTo(point)).expect("there are shapes");
            let ProbeReading { hit, shading, terms, blockers, .. } = &reading;
            assert_eq!(hit.primitive.shape, shape, "cells of the shapes do not touch");
            let faces = hit.point.cos_theta_o > 0.0;
            assert_eq!(seen.mask().shape_at(index).is_some(), faces, "{index}");
            let close = |map: &Map, quantity: &Quantity, expected: f64| {
                let value = map.scalar(quantity).expect("it is there").at(index);
                assert!(
                    (value - expected).abs() <= 1e-12 * expected.abs().max(1e-3),
                    "{quantity:?} {value} {expected}"
                );
            };
            if faces {
                close(&seen, &Quantity::Brightness, shading.brightness());
                close(&seen, &Quantity::Specular, shading.specular);
            }
            // For a flat shape, the probe sees the side that faces the eye.
            if faces || shape < 3 {
                close(&all, &Quantity::Irradiance, shading.irradiance);
                close(&all, &light, terms[1].irradiance);
                blocked += blockers.iter().flatten().count();
            }
        }
    }
    assert!(blocked > 20, "{blocked} shadows: else this test shows little");
}

#[test]
fn extremes_have_their_cells_and_a_channel_of_the_eye_its_own_area() {
    let scene = ball_and_source("");
    let axis = Some(Vector::new(3.0, 0.0, 4.0));
    let surface = scene.surface(&SurfaceRequest { axis, size: size(36, 18), ..request() }).expect("a sphere");
    let (map, totals) = irradiance(&surface);
    assert_eq!((totals.max.cell.row, totals.min.value), (0, 0.0), "the pole is nearest to the source");
    assert_eq!(surface.coordinates(totals.max.cell)[1], 85.0);
    let towards = surface.point(totals.max.cell).dot(Vector::new(0.6, 0.0, 0.8));
    assert_close(towards, 0.25 * libm::sin(85_f64.to_radians()), 1e-14);
    assert_eq!(map.mask().visible(), map.region.size.pixels());
    let seen = surface.map(&[Quantity::Brightness]).expect("it exists");
    let seen = surface.totals(&seen, &Quantity::Brightness).expect("some cells are seen");
    // An eye at distance D sees a cap of area 2πR²(1 − R/D).
    assert_close(seen.area, 2.0 * PI * 0.0625 * (1.0 - 0.25 / 3.0), 0.05);
}

#[test]
fn what_has_no_map_is_refused_with_a_reason() {
    let scene = crowd();
    let of = |shape, part| SurfaceRequest { primitive: Primitive { shape, part }, ..request() };
    let refusal = |request: SurfaceRequest| scene.surface(&request).expect_err("it is refused").to_string();
    assert_eq!(refusal(of(0, 1)), "there is no part 1: the shape has 1, counted from 0");
    let axis = Some(Vector::new(0.0, 0.0, 1.0));
    let own = refusal(SurfaceRequest { axis, ..of(2, 0) });
    assert_eq!(own, "an axis is chosen for a sphere only: a cylinder has its own");
    assert!(refusal(SurfaceRequest { size: size(0, 5), ..of(0, 0) }).contains("0×5 cells"));
    assert!(refusal(SurfaceRequest { size: size(60_000, 60_000), ..of(0, 0) }).contains("60000×60000 cells"));
    let surface = scene.surface(&of(0, 0)).expect("a sphere");
    assert_eq!(surface.size(), Resolution { width: 360, height: 180 });
    let refusal = |quantity| surface.map(&[quantity]).expect_err("it is refused").to_string();
    assert_eq!(refusal(Quantity::Depth), "a surface has no channel `depth`: it belongs to a camera's map");
    assert_eq!(refusal(Quantity::Light("star".into())), "the scene has no light named \"star\"");
    let text = format!("{HEAD}{}[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\n", camera([0.0, 1.0, 0.0]));
    let plane = prepared(&text).surface(&request()).expect_err("it is refused").to_string();
    assert!(plane.starts_with("the surface of a plane has no coordinates; allowed: a sphere"), "{plane}");
}
