//! Shadows against closed forms, and without artefacts at any scale.

use isophote::analysis::probe::ProbePosition;
use isophote::lanes::Precision;
use isophote::map::{Map, Quantity};
use isophote::prepare::PreparedScene;
use isophote::render::{ReferenceRenderer, RenderSettings, Renderer, SimdRenderer};
use isophote::scene::{MemoryFiles, Scene, Syntax};
use isophote::vector::Vector;

fn prepared(text: &str) -> PreparedScene {
    PreparedScene::new(&Scene::from_text("test", text, Syntax::Toml).unwrap_or_else(|error| panic!("{error}\n{text}")))
}

fn map(scene: &PreparedScene) -> Map {
    let quantities = vec![Quantity::Brightness, Quantity::Irradiance];
    let settings = RenderSettings { quantities, ..RenderSettings::default() };
    SimdRenderer::new(Precision::Double, None).render(scene, &settings).expect("it renders")
}

fn brightness(map: &Map) -> Vec<u64> {
    map.scalar(&Quantity::Brightness).expect("it was asked for").iter().map(f64::to_bits).collect()
}

/// A ball between a lamp and a floor, seen from the side.
fn ball_over_floor(settings: &str) -> PreparedScene {
    prepared(&format!(
        "version = 1\nlength = \"m\"\nconvention = \"irradiance\"\n{settings}
        [camera]\neye = [0, 6, -12]\ntarget = [0, 0, 0]\nresolution = [64, 48]
        screen = {{ distance = 1, x = [-0.4, 0.4], y = [-0.3, 0.3] }}
        [[sphere]]\nname = \"ball\"\ncenter = [0, 1, 0]\nradius = 0.5
        [[rectangle]]\nname = \"floor\"\ncenter = [0, 0, 0]\nnormal = [0, 1, 0]\nup = [0, 0, 1]\nwidth = 20\nheight = 20
        [[light]]\nname = \"lamp\"\nposition = [0, 3, 0]\nintensity = 90"
    ))
}

/// The cone from the lamp (height 3) that touches the ball (radius 0.5, 2 below the lamp) has sin α = 0.25; it meets the
/// floor in a circle of radius 3 tan α.
const EDGE: f64 = 3.0 * 0.258_198_889_747_161_1;

fn irradiance(scene: &PreparedScene, x: f64, z: f64) -> f64 {
    scene.probe(&ProbePosition::Point(Vector::new(x, 0.0, z))).expect("it is on the floor").shading.irradiance
}

#[test]
fn the_shadow_of_a_ball_is_the_cone_that_touches_it() {
    let scene = ball_over_floor("shadows = true");
    for turn in 0..16 {
        let (sine, cosine) = (f64::from(turn) * 0.39).sin_cos();
        for (part, is_lit) in [(0.1, false), (0.999_999_999, false), (1.000_000_001, true), (1.5, true)] {
            let distance = EDGE * part;
            let found = irradiance(&scene, distance * cosine, distance * sine);
            // (3.1): I cosθ/r², cosθ = h/r.
            let expected = 90.0 * 3.0 / (distance * distance + 9.0).powf(1.5);
            let expected = if is_lit { expected } else { 0.0 };
            assert!((found - expected).abs() <= 1e-12 * expected, "{part} at {turn}: {found} instead of {expected}");
        }
    }
}

#[test]
fn a_blocker_is_named() {
    let scene = ball_over_floor("shadows = true");
    let reading = scene.probe(&ProbePosition::Point(Vector::new(0.1, 0.0, 0.1))).expect("it is on the floor");
    let blocker = reading.blockers[0].expect("the ball is before the lamp");
    assert_eq!(scene.scene().name_of(blocker), "ball");
    assert_eq!(scene.probe(&ProbePosition::Point(Vector::new(3.0, 0.0, 0.0))).expect("likewise").blockers, [None]);
    assert!(reading.explain(&scene, "P", isophote::text::Language::English).contains("\"ball\" stands between"));
}

#[test]
fn what_casts_or_receives_no_shadow_is_lit() {
    let text = |scene: &str, ball: &str, floor: &str, lamp: &str| {
        let text = ball_over_floor(scene).source_text().to_owned();
        let text = text.replace("name = \"ball\"", &format!("name = \"ball\"\n{ball}"));
        let text = text.replace("name = \"floor\"", &format!("name = \"floor\"\n{floor}"));
        prepared(&text.replace("name = \"lamp\"", &format!("name = \"lamp\"\n{lamp}")))
    };
    let on = "shadows = true";
    assert_eq!(irradiance(&text(on, "", "", ""), 0.0, 0.0), 0.0);
    for scene in [
        text("shadows = false", "", "", ""),
        text(on, "casts_shadow = false", "", ""),
        text(on, "", "receives_shadow = false", ""),
        text(on, "", "", "casts_shadows = false"),
    ] {
        assert!((irradiance(&scene, 0.0, 0.0) - 10.0).abs() < 1e-14, "90 W/sr at 3 m");
    }
}

/// Two spheres of one cloud, the upper one between the lamp and the lower: its flags hold for its shadow on itself too.
#[test]
fn what_casts_or_receives_no_shadow_does_not_shadow_itself() {
    let lowest = |flags: &str| {
        let files = MemoryFiles::from_iter([("two.csv", "x,y,z,radius\n0,0,0,0.5\n0,2,0,0.5\n")]);
        let text = format!(
            "version = 1\nlength = \"m\"\nconvention = \"irradiance\"\nshadows = true
            [camera]\neye = [0, 6, -12]\ntarget = [0, 0, 0]\nscreen = {{ distance = 1, x = [-0.4, 0.4], y = [-0.3, 0.3] }}
            [[spheres]]\nname = \"pair\"\nfile = \"two.csv\"\n{flags}
            [[light]]\nposition = [0, 3.5, 0]\nintensity = 90"
        );
        let scene = Scene::from_text_with(&files, None, "test", &text, Syntax::Toml);
        let scene = PreparedScene::new(&scene.unwrap_or_else(|error| panic!("{error}")));
        let reading = scene.probe(&ProbePosition::Point(Vector::new(0.0, 0.5, 0.0))).expect("it is on the lower one");
        reading.shading.irradiance
    };
    assert_eq!(lowest(""), 0.0);
    for flags in ["casts_shadow = false", "receives_shadow = false"] {
        assert!((lowest(flags) - 10.0).abs() < 1e-14, "{flags}: 90 W/sr at 3 m");
    }
}

/// On a floor around a box, the ambient light from a few directions is within two standard errors of that from many nearly
/// everywhere, also where none of the few is blocked.
#[test]
fn the_standard_error_of_ambient_light_is_one() {
    let scene = |samples: u32| {
        prepared(&format!(
            "version = 1\nlength = \"m\"\nconvention = \"irradiance\"
            ambient = {{ radiance = 1, obstructed = true, samples = {samples} }}
            [camera]\neye = [0, 6, -12]\ntarget = [0, 0, 0]\nscreen = {{ distance = 1, x = [-0.4, 0.4], y = [-0.3, 0.3] }}
            [[rectangle]]\nname = \"floor\"\ncenter = [0, 0, 0]\nnormal = [0, 1, 0]\nup = [0, 0, 1]\nwidth = 20\nheight = 20
            [[box]]\nname = \"block\"\ncenter = [0, 1, 0]\nsize = [1, 2, 1]"
        ))
    };
    let true_light = scene(4096);
    for samples in [16, 64] {
        let few = scene(samples);
        let mut beyond = 0;
        for index in 0..400_u32 {
            let place = |index: u32| (f64::from(index) + 0.5) / 20.0 * 8.0 + 0.6;
            let point = ProbePosition::Point(Vector::new(place(index % 20), 0.0, place(index / 20) - 4.6));
            let of = |scene: &PreparedScene| {
                let reading = scene.probe(&point).expect("it is on the floor");
                scene.ambient_irradiance(&reading.hit)
            };
            let (estimate, exact) = (of(&few), of(&true_light));
            assert!(estimate.standard_error > 0.0);
            beyond += i32::from((estimate.irradiance - exact.irradiance).abs() > 2.0 * estimate.standard_error);
        }
        assert!(beyond <= 20, "{samples} directions: {beyond} of 400 points are off by more than two standard errors");
    }
}

/// One sphere alone, seen under grazing light as well.
fn lone_sphere(size: f64, offset: f64, shadows: bool, more: &str) -> PreparedScene {
    let at =
        |x: f64, y: f64, z: f64| format!("[{:?}, {:?}, {:?}]", x * size + offset, y * size + offset, z * size + offset);
    prepared(&format!(
        "version = 1\nlength = \"m\"\nconvention = \"lab\"\nshadows = {shadows}
        [camera]\neye = {}\ntarget = {}\nresolution = [64, 48]
        screen = {{ distance = {:?}, x = [{:?}, {:?}], y = [{:?}, {:?}] }}
        [material.clay]\ndiffuse = 0.7\nspecular = 0.3\nshininess = 20
        [[sphere]]\ncenter = {}\nradius = {size:?}\nmaterial = \"clay\"
        [[light]]\nposition = {}\nintensity = {:?}\n{more}",
        at(0.0, 0.0, -5.0),
        at(0.0, 0.0, 0.0),
        5.0 * size,
        -1.6 * size,
        1.6 * size,
        -1.2 * size,
        1.2 * size,
        at(0.0, 0.0, 0.0),
        at(4.0, 1.0, 0.3),
        50.0 * size * size,
    ))
}

#[test]
fn a_lone_convex_shape_never_shadows_itself() {
    for (size, offset) in [(1.0, 0.0), (1e-6, 0.0), (1e6, 0.0), (1.0, 1e6), (1e-3, -1e5)] {
        let [with, without] = [true, false].map(|shadows| map(&lone_sphere(size, offset, shadows, "")));
        assert_eq!(brightness(&with), brightness(&without), "size {size}, offset {offset}");
        // The same where every pixel is traced and shaded by itself.
        let scene = lone_sphere(size, offset, true, "");
        let settings = RenderSettings { quantities: vec![Quantity::Brightness], ..RenderSettings::default() };
        let reference = ReferenceRenderer.render(&scene, &settings).expect("it renders");
        let peak = reference.scalar(&Quantity::Brightness).expect("asked for").iter().fold(0.0, f64::max);
        let pairs = reference.scalar(&Quantity::Brightness).expect("asked for").iter();
        let of_lanes: Vec<f64> = without.scalar(&Quantity::Brightness).expect("asked for").iter().collect();
        for (traced, lanes) in pairs.zip(of_lanes) {
            assert!((traced - lanes).abs() <= 1e-12 * peak, "{traced} {lanes}");
        }
    }
}

#[test]
fn a_light_inside_a_sphere_lights_its_inside() {
    let scene = prepared(
        "version = 1\nlength = \"m\"\nconvention = \"irradiance\"\nshadows = true
        [camera]\neye = [0, 0, 0.5]\nforward = [0, 0, 1]\nresolution = [32, 24]
        screen = { distance = 1, x = [-4, 4], y = [-3, 3] }
        [[sphere]]\ncenter = [0, 0, 0]\nradius = 2
        [[light]]\nposition = [0, 0, 0]\nintensity = 12",
    );
    let map = map(&scene);
    assert_eq!(map.mask().visible(), 32 * 24, "the wall is everywhere");
    // From the centre every ray meets the wall at right angles: E = I/R².
    for value in map.scalar(&Quantity::Irradiance).expect("it was asked for").iter() {
        assert!((value - 3.0).abs() < 1e-12, "{value}");
    }
}

/// Two spheres in a row with the lamp: the far one is dark where the near one hides the lamp, and only there.
#[test]
fn shadows_take_light_away_and_never_add_any() {
    let more = "[[sphere]]\ncenter = [2.5, 0.7, 0.2]\nradius = 0.4\nmaterial = \"clay\"";
    let [with, without] = [true, false].map(|shadows| lone_sphere(1.0, 0.0, shadows, more));
    let (with_map, without_map) = (map(&with), map(&without));
    let values = |map: &Map| map.scalar(&Quantity::Irradiance).expect("asked for").iter().collect::<Vec<_>>();
    let (mut darker, mut same) = (0, 0);
    for (index, (with_shadow, without_shadow)) in values(&with_map).into_iter().zip(values(&without_map)).enumerate() {
        let is_hidden =
            with.trace_pixel(with_map.pixel(index)).is_some_and(|hit| with.blocking(&hit, 0).blocker.is_some());
        if is_hidden {
            assert_eq!(with_shadow, 0.0);
            darker += usize::from(without_shadow > 0.0);
        } else {
            assert!((with_shadow - without_shadow).abs() <= 1e-12 * without_shadow, "{with_shadow} {without_shadow}");
            same += usize::from(without_shadow > 0.0);
        }
    }
    assert!(darker > 20 && same > 50, "{darker} darker, {same} the same");
}

/// Whether drawn in tiles or through the tree, a light inside a closed shape lights nothing outside, and its inside as if
/// there were no more.
#[test]
fn a_lamp_in_a_ball_lights_only_the_inside_of_it() {
    let scene = |eye: &str, more: &str| {
        prepared(&format!(
            "version = 1\nlength = \"m\"\nconvention = \"radiance\"\nshadows = true
            material = {{ chalk = {{ diffuse = 0.5 }} }}
            [camera]\neye = {eye}\ntarget = [0, 0, 0]\nresolution = [64, 48]
            screen = {{ distance = 1, x = [-0.4, 0.4], y = [-0.3, 0.3] }}
            [[sphere]]\nname = \"shade\"\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"chalk\"
            [[sphere]]\nname = \"neighbour\"\ncenter = [1.5, 0, 0]\nradius = 0.4\nmaterial = \"chalk\"
            [[light]]\nname = \"lamp\"\nposition = [0.5, 0, 0]\nintensity = 10\n{more}"
        ))
    };
    let box_behind = "[[box]]\ncenter = [0, -3, 0]\nsize = [4, 1, 4]\nmaterial = \"chalk\"";
    for more in ["", box_behind] {
        let outside = map(&scene("[0, 2, -9]", more));
        assert!(outside.mask().runs().len() > 10, "something is seen");
        assert!(brightness(&outside).iter().all(|bits| *bits == 0), "and all is dark");
        let inside = scene("[-0.5, 0.1, 0]", more);
        let lit = inside.probe(&ProbePosition::Point(Vector::new(-1.0, 0.0, 0.0))).expect("it is on the shade");
        // (3.1), 1.5 m away and straight on.
        assert!((lit.shading.irradiance - 10.0 / 2.25).abs() < 1e-14, "{}", lit.shading.irradiance);
        let reference = ReferenceRenderer
            .render(&inside, &RenderSettings { quantities: vec![Quantity::Irradiance], ..RenderSettings::default() });
        let reference = reference.expect("it renders");
        let [expected, found] = [&reference, &map(&inside)]
            .map(|map| map.scalar(&Quantity::Irradiance).expect("it was asked for").iter().collect::<Vec<f64>>());
        assert!(found.iter().all(|value| *value > 1.0), "all that is seen is lit");
        for (expected, found) in expected.iter().zip(&found) {
            assert!((found - expected).abs() <= 1e-12 * expected, "{found} instead of {expected}");
        }
    }
}

/// An icosahedron of radius 1 about the origin, with the normals of the sphere around it.
fn icosahedron() -> MemoryFiles {
    use std::fmt::Write;

    let golden = f64::midpoint(1.0, 5.0_f64.sqrt());
    let mut corners: Vec<Vector> = Vec::new();
    for (one, other) in [(1.0, golden), (1.0, -golden), (-1.0, golden), (-1.0, -golden)] {
        corners.extend([Vector::new(0.0, one, other), Vector::new(one, other, 0.0), Vector::new(other, 0.0, one)]);
    }
    let side = 2.0;
    let mut file = String::new();
    for corner in &corners {
        let Vector { x, y, z } = corner.normalized();
        let _ = write!(file, "v {x} {y} {z}\nvn {x} {y} {z}\n");
    }
    let is_side = |a: usize, b: usize| ((corners[a] - corners[b]).length() - side).abs() < 1e-9;
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                if is_side(a, b) && is_side(b, c) && is_side(c, a) {
                    let outward = (corners[b] - corners[a]).cross(corners[c] - corners[a]).dot(corners[a]) > 0.0;
                    let [b, c] = if outward { [b, c] } else { [c, b] };
                    let _ = writeln!(file, "f {0}//{0} {1}//{1} {2}//{2}", a + 1, b + 1, c + 1);
                }
            }
        }
    }
    assert_eq!(file.matches('f').count(), 20);
    MemoryFiles::from_iter([("icosahedron.obj", file)])
}

/// The icosahedron with smooth normals, shadows, and more.
fn smooth_ball(more: &str) -> PreparedScene {
    let text = format!(
        "version = 1\nlength = \"m\"\nconvention = \"irradiance\"\nshadows = true
        [camera]\neye = [3, 5, -5]\ntarget = [0, 0, 0]\nresolution = [200, 150]
        screen = {{ distance = 1, x = [-0.2, 0.2], y = [-0.15, 0.15] }}
        [[mesh]]\nname = \"ball\"\nfile = \"icosahedron.obj\"\nsmooth = true
        {more}"
    );
    let scene = Scene::from_text_with(&icosahedron(), None, "test", &text, Syntax::Toml);
    PreparedScene::new(&scene.unwrap_or_else(|error| panic!("{error}\n{text}")))
}

/// The middle of a facet, and its normal: the facet's plane is 0.795 from the centre, the smooth surface about 1.
const FACET: f64 = 0.794_654_472_291_766_1;

fn facet_normal() -> Vector {
    Vector::new(1.0, 1.0, 1.0).normalized()
}

/// Shadow rays of a smooth mesh start above its facets; near the terminator that may be above the horizon of a light that the
/// point still sees.
#[test]
fn a_lamp_in_a_closed_crate_lights_nothing_outside() {
    for lamp in [[0.8, 1.2, -0.8], [2.0, 0.3, -1.0], [0.0, 1.3, -0.4]] {
        let [x, y, z] = lamp;
        let scene = smooth_ball(&format!(
            "[[box]]\nname = \"crate\"\ncenter = [{x}, {y}, {z}]\nsize = [0.1, 0.1, 0.1]
            [[light]]\nposition = [{x}, {y}, {z}]\nintensity = 1"
        ));
        let map = map(&scene);
        let irradiance = map.scalar(&Quantity::Irradiance).expect("it was asked for");
        let lit = map.mask().indices().filter(|&index| irradiance.at(index) > 0.0).count();
        assert_eq!(lit, 0, "lamp at {lamp:?}");
    }
}

/// What stands between a facet and the smooth surface above it shades the facet.
#[test]
fn a_plate_close_to_a_facet_shades_it() {
    let normal = facet_normal();
    let at = |distance: f64| {
        let Vector { x, y, z } = normal * distance;
        format!("[{x}, {y}, {z}]")
    };
    let irradiance = |plate: f64, lamp: f64| {
        let scene = smooth_ball(&format!(
            "[[disk]]\nname = \"plate\"\ncenter = {}\nnormal = [1, 1, 1]\nradius = 0.1
            [[light]]\nposition = {}\nintensity = 1",
            at(plate),
            at(lamp)
        ));
        let reading = scene.probe(&ProbePosition::Point(normal * FACET)).expect("it is on the ball");
        reading.shading.irradiance
    };
    let lit = |lamp: f64| 1.0 / (lamp - FACET).powi(2);
    for (plate, lamp, is_lit) in [
        (0.8, 3.0, false),
        (0.9, 3.0, false),
        (0.99, 3.0, false),
        (1.2, 3.0, false),
        // The lamp itself is that close: below the plate and above it.
        (0.9, 0.85, true),
        (0.99, 0.8, true),
        (0.8, 0.85, false),
    ] {
        let expected = if is_lit { lit(lamp) } else { 0.0 };
        let found = irradiance(plate, lamp);
        assert!(
            (found - expected).abs() <= 1e-9 * expected,
            "plate at {plate}, lamp at {lamp}: {found}, not {expected}"
        );
    }
}
