//! Pictures of spheres by every projection, against their closed forms.

use std::f64::consts::PI;

use isophote::analysis::probe::{ProbePosition, SeenFromEye};
use isophote::map::{Coordinates, Map, Quantity};
use isophote::prepare::PreparedScene;
use isophote::render::{ReferenceRenderer, RenderSettings, Renderer};
use isophote::scene::source::{CameraSource, ProjectionName, ScreenSource, SphereSource, WindowSource};
use isophote::scene::{Scene, SceneSource};
use isophote::vector::Vector;

/// A sphere of radius 1 at a distance along −z, and a lamp beside the eye.
fn source(distance: f64, camera: CameraSource) -> SceneSource {
    let path = format!("{}/../../scenes/sun.toml", env!("CARGO_MANIFEST_DIR"));
    let sun = Scene::from_file(path.as_ref()).unwrap_or_else(|error| panic!("{error}"));
    let mut source = sun.source().clone();
    source.probe.clear();
    source.sphere =
        vec![SphereSource { center: Some([0.0, 0.0, -distance]), radius: Some(1.0), ..SphereSource::default() }];
    let eye = Some([0.0, 0.0, 0.0]);
    source.camera = Some(CameraSource { eye, forward: Some([0.0, 0.0, -1.0]), ..camera });
    source
}

fn prepared(source: SceneSource) -> PreparedScene {
    PreparedScene::new(&Scene::try_from(source).unwrap_or_else(|error| panic!("{error}")))
}

fn render(scene: &PreparedScene) -> Map {
    let settings = RenderSettings { quantities: Quantity::COMMON.to_vec(), ..RenderSettings::default() };
    ReferenceRenderer.render(scene, &settings).expect("it renders")
}

fn fisheye(projection: ProjectionName, field_of_view: f64, side: u64) -> CameraSource {
    CameraSource {
        projection: Some(projection),
        field_of_view: Some(field_of_view),
        resolution: Some([side, side]),
        ..CameraSource::default()
    }
}

/// Area of the pixels that see something, in the window's unit.
#[expect(clippy::cast_precision_loss, reason = "fewer than 2^53 pixels")]
fn covered(map: &Map) -> f64 {
    let window = map.window;
    let whole = (window.x[1] - window.x[0]) * (window.y[1] - window.y[0]);
    whole * map.mask().visible() as f64 / map.region.size.pixels() as f64
}

/// (2.8): the silhouette of a sphere straight ahead has the radius asin(R/D), as an angle.
#[test]
fn an_equidistant_silhouette_is_as_wide_as_its_angle() {
    use isophote::camera::ScreenPosition;
    for (distance, field_of_view) in [(2.6, 180.0), (1.01, 360.0), (40.0, 20.0)] {
        let scene = prepared(source(distance, fisheye(ProjectionName::FisheyeEquidistant, field_of_view, 9)));
        let limb = (1.0 / distance).asin().to_degrees();
        for turn in [0.0, 0.7, 2.0, 4.4_f64] {
            let sees = |radius: f64| {
                scene.trace(ScreenPosition::Point { x: radius * turn.cos(), y: radius * turn.sin() }).is_some()
            };
            assert!(sees(limb * (1.0 - 1e-14)) && !sees(limb * (1.0 + 1e-14)), "D = {distance}, {turn}");
        }
    }
}

/// (2.9): the sphere covers the solid angle 2π(1 − cos asin(R/D)), wherever in the picture it is.
#[test]
fn an_equal_area_fisheye_shows_the_solid_angle_of_a_sphere() {
    for forward in [[0.0, 0.0, -1.0], [0.8, 0.0, -0.6], [1.0, 1.0, 1.0]] {
        let mut source = source(2.5, fisheye(ProjectionName::FisheyeEqualArea, 360.0, 700));
        source.camera.get_or_insert_default().forward = Some(forward);
        let map = render(&prepared(source));
        let radian = 1.0_f64.to_degrees();
        let expected = 2.0 * PI * (1.0 - (1.0 - 1.0 / (2.5 * 2.5_f64)).sqrt()) * radian * radian;
        let pixel = (map.window.x[1] - map.window.x[0]) / 700.0;
        // The error of counting pixels along the limb: far less than all of its pixels.
        let limb = 2.0 * PI * (1.0 / 2.5_f64).asin() * radian / pixel;
        let error = (covered(&map) - expected).abs() / (pixel * pixel);
        assert!(error < 0.1 * limb, "{forward:?}: {error} pixels of {limb} along the limb");
    }
}

/// A panorama too, where a pixel at the latitude φ is cosφ of one at the equator.
#[test]
fn a_panorama_shows_the_solid_angle_of_a_sphere() {
    for forward in [[0.0, 0.0, -1.0], [0.1, 1.0, 0.0], [0.3, -0.5, 1.0]] {
        let camera = CameraSource {
            projection: Some(ProjectionName::Panorama),
            resolution: Some([720, 360]),
            up: Some([0.0, 0.3, 1.0]),
            ..CameraSource::default()
        };
        let mut source = source(2.5, camera);
        source.camera.get_or_insert_default().forward = Some(forward);
        let map = render(&prepared(source));
        let half_degree = 0.5_f64.to_radians();
        let area = |index| {
            let row = f64::from(map.pixel(index).row);
            (PI / 2.0 - half_degree * (row + 0.5)).cos() * half_degree * half_degree
        };
        let found: f64 = map.mask().indices().map(area).sum();
        let expected = 2.0 * PI * (1.0 - (1.0 - 1.0 / (2.5 * 2.5_f64)).sqrt());
        assert!((found / expected - 1.0).abs() < 5e-3, "{forward:?}: {found} {expected}");
        assert!(map.window.coordinates == Coordinates::ScreenAngles && map.window.x == [-180.0, 180.0]);
    }
}

/// (2.7): the disc of a sphere covers π R², at any distance, and every point is looked at along one direction.
#[test]
fn an_orthographic_disc_covers_the_area_of_the_great_circle() {
    for distance in [1.5, 30.0, 1e6] {
        let window = WindowSource { x: Some([-1.5, 1.3]), y: Some([-1.2, 1.6]) };
        let camera = CameraSource {
            projection: Some(ProjectionName::Orthographic),
            window: Some(window),
            resolution: Some([500, 500]),
            ..CameraSource::default()
        };
        let scene = prepared(source(distance, camera));
        let map = render(&scene);
        assert!((covered(&map) / PI - 1.0).abs() < 1e-3, "{distance}: {}", covered(&map));
        for index in map.mask().indices().step_by(997) {
            let hit = scene.trace_pixel(map.pixel(index)).expect("it is seen");
            assert_eq!(hit.point.view, Vector::new(0.0, 0.0, 1.0));
            let depth = -hit.point.position().z;
            assert!((hit.distance - depth).abs() <= 1e-12 * depth, "the depth is counted from the plane of the eye");
        }
    }
}

/// Parallel rays that start inside a sphere see its far wall, and their neighbours that start outside the near one.
#[test]
fn the_plane_of_parallel_rays_may_cut_a_sphere() {
    let window = WindowSource { x: Some([-1.5, 1.5]), y: Some([-1.5, 1.5]) };
    let camera = CameraSource {
        projection: Some(ProjectionName::Orthographic),
        window: Some(window),
        resolution: Some([101, 101]),
        ..CameraSource::default()
    };
    // The plane cuts the sphere in a circle of radius 0.8: within it rays start inside.
    let scene = prepared(source(0.6, camera));
    let map = render(&scene);
    let seen = |column| scene.trace_pixel(isophote::map::Pixel { column, row: 50 }).expect("it is seen");
    let inside = seen(50);
    assert!(inside.from_inside && (inside.distance - 1.6).abs() < 1e-14, "{inside:?}");
    let outside = seen(50 + 30);
    assert!(!outside.from_inside && outside.distance < 0.6, "{outside:?}");
    assert!((covered(&map) / PI - 1.0).abs() < 1e-2);
    let behind = scene.probe(&ProbePosition::Point(Vector::new(0.0, 0.0, 0.4))).expect("it is on the sphere");
    assert_eq!(behind.seen, SeenFromEye::FacesAway, "it is the outside of a wall that is seen from inside");
}

#[test]
fn a_point_behind_the_plane_of_parallel_rays_is_not_seen() {
    let window = WindowSource { x: Some([-1.5, 1.5]), y: Some([-1.5, 1.5]) };
    let camera = CameraSource {
        projection: Some(ProjectionName::Orthographic),
        window: Some(window),
        ..CameraSource::default()
    };
    let scene = prepared(source(-5.0, camera));
    let reading = scene.probe(&ProbePosition::Point(Vector::new(0.0, 0.0, 6.0))).expect("it is on the sphere");
    assert_eq!(reading.seen, SeenFromEye::Behind);
    assert_eq!(render(&scene).mask().visible(), 0);
}

/// The width of the image spans the field of view: the same camera by its window gives the same picture, bit by bit.
#[test]
fn a_field_of_view_is_a_window() {
    for (field_of_view, [width, height]) in [(40.0, [120, 90]), (100.0, [77, 131]), (1.5, [64, 64_u32])] {
        let size = Some([width.into(), height.into()]);
        let by_angle = CameraSource { field_of_view: Some(field_of_view), resolution: size, ..CameraSource::default() };
        let half = libm::tan(f64::to_radians(0.5 * field_of_view));
        let half_height = half * f64::from(height) / f64::from(width);
        let screen = ScreenSource { distance: Some(1.0), x: Some([-half, half]), y: Some([-half_height, half_height]) };
        let by_window = CameraSource { screen: Some(screen), resolution: size, ..CameraSource::default() };
        let [by_angle, by_window] = [by_angle, by_window].map(|camera| render(&prepared(source(4.0, camera))));
        assert_eq!(by_angle.window, by_window.window);
        assert!(by_angle.channels() == by_window.channels() && by_angle.mask() == by_window.mask());
        assert!(by_angle.mask().visible() > 30);
    }
}

/// The axes of a camera at the origin: right, up, forward.
fn axes(camera: CameraSource) -> [[f64; 3]; 3] {
    let screen = ScreenSource { distance: Some(1.0), x: Some([-1.0, 1.0]), y: Some([-1.0, 1.0]) };
    let mut source = source(5.0, CameraSource::default());
    let eye = Some([0.0, 0.0, 0.0]);
    source.camera = Some(CameraSource { eye, screen: Some(screen), resolution: Some([2, 2]), ..camera });
    let frame = *prepared(source).frame();
    [frame.right, frame.up, frame.forward].map(Vector::to_array)
}

/// Tilt 0 is straight down −z with +y on top; the view then rises towards the azimuth, and the top of the picture with it.
#[test]
fn a_camera_looks_along_the_direction_of_its_angles() {
    let by_angles =
        |tilt: f64, azimuth: Option<f64>| axes(CameraSource { tilt: Some(tilt), azimuth, ..CameraSource::default() });
    assert_eq!(by_angles(0.0, None), [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]);
    assert_eq!(by_angles(180.0, None), [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]]);
    assert_eq!(by_angles(90.0, Some(90.0)), [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]);
    assert_eq!(by_angles(90.0, Some(0.0)), [[0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]);
    assert_eq!(by_angles(90.0, Some(-90.0))[2], [0.0, -1.0, 0.0]);
    // A quarter turn of the azimuth turns the picture of a view straight down.
    assert_eq!(by_angles(0.0, Some(0.0))[1], [1.0, 0.0, 0.0]);
    let [right, up, forward] = by_angles(30.0, Some(60.0));
    let (sin, cos) = (0.5, 0.75_f64.sqrt());
    for (found, expected) in
        [(forward, [sin * 0.5, sin * cos, -cos]), (up, [cos * 0.5, cos * cos, sin]), (right, [cos, -0.5, 0.0])]
    {
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-15, "{found} {expected}");
        }
    }
}

/// Straight down −y or up +y, the top is what +y becomes when a level view along −z is turned that far.
#[test]
fn a_view_straight_down_or_up_has_a_top() {
    let along = |y: f64| axes(CameraSource { forward: Some([0.0, y, 0.0]), ..CameraSource::default() });
    assert_eq!(along(-2.0), [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, -1.0, 0.0]]);
    assert_eq!(along(1.0), [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]);
    let nearly = axes(CameraSource { forward: Some([0.0, -1.0, -1e-5]), ..CameraSource::default() });
    for (found, expected) in nearly.as_flattened().iter().zip(along(-1.0).as_flattened()) {
        assert!((found - expected).abs() < 2e-5, "{nearly:?}");
    }
}
