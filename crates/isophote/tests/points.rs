//! Values at many points at once, held to those at single points.

mod random;

use isophote::analysis::probe::{ProbeError, ProbePosition, ProbeReading};
use isophote::prepare::PreparedScene;
use isophote::render::{PointKernel, PointValues};
use isophote::scene::library::Starter;
use isophote::scene::{Scene, SceneSource, Syntax};
use isophote::shape::Geometry;
use isophote::vector::Vector;
use proptest::prelude::*;

struct Values {
    brightness: Vec<f64>,
    irradiance: Vec<f64>,
    shape: Vec<i32>,
    misses: usize,
}

fn values(kernel: &PointKernel<'_>, points: &[[f64; 3]], snaps: bool) -> Values {
    let count = points.len();
    let mut values =
        Values { brightness: vec![0.0; count], irradiance: vec![0.0; count], shape: vec![0; count], misses: 0 };
    let Values { brightness, irradiance, shape, .. } = &mut values;
    values.misses = kernel.fill(points, snaps, &mut PointValues { brightness, irradiance, shape });
    values
}

fn prepared(source: SceneSource) -> PreparedScene {
    PreparedScene::new(&Scene::try_from(source).unwrap_or_else(|error| panic!("{error}")))
}

/// Where neither cosine is so small that the problem itself loses digits, nor a highlight so faint that it shows nothing.
fn is_well_conditioned(reading: &ProbeReading) -> bool {
    let is_lit_well = |cosine: f64| cosine == 0.0 || cosine > 1e-3;
    reading.hit.point.cos_theta_o.abs() > 1e-3
        && reading.terms.iter().all(|term| is_lit_well(term.cos_theta_i) && (term.lobe == 0.0 || term.lobe > 1e-6))
}

proptest! {
    #![proptest_config(random::config(200))]

    #[test]
    fn many_points_have_the_values_of_single_ones(
        source in prop_oneof![random::scenes(), random::worlds()],
        directions in prop::collection::vec(prop::array::uniform3(-1.0..1.0_f64), 1..70),
        height in prop::sample::select(vec![0.0, 1e-11, 0.2]),
        snaps in any::<bool>(),
    ) {
        let scene = prepared(source);
        let Some(kernel) = PointKernel::new(&scene) else { return Ok(()) };
        let length = scene.scene().length();
        let shapes = scene.scene().shapes();
        let point = |(index, direction): (usize, &[f64; 3])| {
            let Geometry::Sphere(sphere) = shapes[index % shapes.len()].geometry else { panic!("a kernel is of spheres") };
            let direction = Vector::from(*direction);
            let unit = if direction.length() > 0.1 { direction.normalized() } else { Vector::new(0.0, 1.0, 0.0) };
            let point = sphere.center + unit * (sphere.radius * (1.0 + height));
            point.to_array().map(|metres| length.from_metres(metres))
        };
        let points: Vec<[f64; 3]> = directions.iter().enumerate().map(point).collect();
        let found = values(&kernel, &points, snaps);
        let mut misses = 0;
        for (index, point) in points.iter().enumerate() {
            let metres = Vector::from(point.map(|coordinate| length.to_metres(coordinate)));
            let place = if snaps { ProbePosition::NearestTo(metres) } else { ProbePosition::Point(metres) };
            match scene.probe(&place) {
                Err(ProbeError::OffSurface(_)) => {
                    misses += 1;
                    prop_assert!(found.brightness[index].is_nan() && found.irradiance[index].is_nan());
                    prop_assert_eq!(found.shape[index], -1);
                }
                Err(error) => panic!("{error}"),
                Ok(reading) => {
                    prop_assert_eq!(found.shape[index], i32::try_from(reading.hit.primitive.shape).unwrap_or(-1));
                    if is_well_conditioned(&reading) {
                        let pairs = [
                            (found.brightness[index], reading.shading.brightness()),
                            (found.irradiance[index], reading.shading.irradiance),
                        ];
                        for (many, single) in pairs {
                            prop_assert!((many - single).abs() <= 1e-12 * single.abs(), "{many} {single} at {point:?}");
                        }
                    }
                }
            }
        }
        prop_assert_eq!(found.misses, misses);
    }
}

#[test]
fn the_labs_points_have_their_published_digits() {
    let scene = Scene::from_text("lab", Starter::Lab.text(), Syntax::Toml).unwrap_or_else(|error| panic!("{error}"));
    let scene = PreparedScene::new(&scene);
    let kernel = PointKernel::new(&scene).expect("the lab has one sphere");
    let half = 0.5_f64.sqrt();
    let found = values(&kernel, &[[0.0, 0.0, 4.0], [half, 0.0, 5.0 - half], [0.0, 0.0, 4.1]], false);
    for (value, expected) in found.brightness.iter().zip([0.316_677_297_547_093, 0.137_736_208_646_845]) {
        assert!((value - expected).abs() < 1e-12 * expected, "{value}");
    }
    assert!(found.brightness[2].is_nan());
    assert_eq!((found.shape, found.misses), (vec![0, 0, -1], 1));
}

/// What the kernel does not compute is left to the single points: no scene gets wrong values.
#[test]
fn scenes_that_need_more_have_no_kernel() {
    let directory = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    for name in ["solids", "shadows", "color", "orthographic", "spheres", "mesh"] {
        let scene = Scene::from_file(&directory.join(format!("{name}.toml"))).unwrap_or_else(|error| panic!("{error}"));
        assert!(PointKernel::new(&PreparedScene::new(&scene)).is_none(), "{name}");
    }
}
