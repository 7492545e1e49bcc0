//! Rays and projections, tested against each other and against known results.

use super::*;

fn lab(handedness: Handedness) -> Camera {
    Camera {
        eye: Vector::default(),
        forward: Vector::new(0.0, 0.0, 2.0),
        up: Vector::new(0.0, 3.0, 0.0),
        handedness,
        projection: Projection::Perspective(Screen { distance: 5.0, x: [-4.0, 4.0], y: [-3.0, 3.0] }),
        resolution: Resolution { width: 800, height: 600 },
    }
}

#[test]
fn handedness_decides_which_way_x_runs() {
    let left = CameraFrame::<f64>::new(&lab(Handedness::Left));
    assert_eq!(left.right, Vector::new(1.0, 0.0, 0.0));
    assert_eq!(left.up, Vector::new(0.0, 1.0, 0.0));
    let right = CameraFrame::<f64>::new(&lab(Handedness::Right));
    assert_eq!(right.right, Vector::new(-1.0, 0.0, 0.0));
    assert_eq!(right.up, Vector::new(0.0, 1.0, 0.0));
}

#[test]
fn the_first_pixel_is_the_top_left_one_and_its_centre_half_a_pixel_inside() {
    let frame = CameraFrame::<f64>::new(&lab(Handedness::Left));
    let point = |column, row| frame.point_on_screen(ScreenPosition::PixelCenter(Pixel { column, row }));
    assert_eq!(point(0, 0), [-3.995, 2.995]);
    assert_eq!(point(799, 599), [3.995, -2.995]);
    assert_eq!(point(400, 299), [0.005, 0.005]);
}

#[test]
fn a_tilted_camera_keeps_up_upright() {
    let mut camera = lab(Handedness::Right);
    camera.forward = Vector::new(1.0, -1.0, 0.5);
    let frame = CameraFrame::<f64>::new(&camera);
    assert!(frame.right.y.abs() < 1e-15, "the horizon stays horizontal");
    assert!(frame.up.y > 0.0);
    assert!((frame.up.length() - 1.0).abs() < 1e-15);
    assert!((frame.right.cross(frame.up) + frame.forward).length() < 1e-15, "right × up = −forward");
}

#[test]
fn projection_undoes_the_ray() {
    let mut camera = lab(Handedness::Left);
    camera.eye = Vector::new(1.0, 2.0, 3.0);
    camera.forward = Vector::new(0.3, -0.2, 0.9);
    let frame = CameraFrame::<f64>::new(&camera);
    let position = ScreenPosition::Point { x: 0.7, y: -1.3 };
    let ray = frame.ray(position).expect("a plane has no end");
    let [x, y] = frame.project(ray.anchor + ray.direction * 7.0).expect("it is ahead");
    assert!((x - 0.7).abs() < 1e-14 && (y + 1.3).abs() < 1e-14);
    assert_eq!(frame.project(ray.anchor - ray.direction), None);
}

fn seeing(projection: Projection) -> Camera {
    Camera {
        eye: Vector::new(1.0, 2.0, 3.0),
        forward: Vector::new(0.3, -0.2, 0.9),
        projection,
        resolution: Resolution { width: 400, height: 300 },
        ..lab(Handedness::Right)
    }
}

fn all_projections() -> Vec<Projection> {
    let fisheye = |mapping, field_of_view| Projection::Fisheye(Fisheye { mapping, field_of_view });
    vec![
        Projection::Perspective(Screen { distance: 2.0, x: [-2.0, 1.0], y: [-1.0, 1.5] }),
        Projection::Orthographic(Extent { x: [-2.0, 1.0], y: [-1.0, 1.5] }),
        fisheye(Mapping::Equidistant, 150.0),
        fisheye(Mapping::Equidistant, 360.0),
        fisheye(Mapping::EqualArea, 150.0),
        fisheye(Mapping::EqualArea, 360.0),
        Projection::Panorama(Extent { x: [-180.0, 180.0], y: [-90.0, 90.0] }),
        Projection::Panorama(Extent { x: [20.0, 380.0], y: [-30.0, 90.0] }),
    ]
}

/// World → screen → world: whatever a pixel's ray hits appears at that pixel, at any distance.
#[test]
fn every_projection_undoes_its_rays() {
    for projection in all_projections() {
        let frame = CameraFrame::<f64>::new(&seeing(projection));
        let mut seen = 0;
        for (column, row) in (0..400).step_by(23).flat_map(|column| (0..300).step_by(19).map(move |row| (column, row)))
        {
            let position = ScreenPosition::PixelCenter(Pixel { column, row });
            let Some(ray) = frame.ray(position) else { continue };
            assert!((ray.direction.length() - 1.0).abs() < 4e-16);
            let expected = frame.point_on_screen(position);
            for distance in [0.01, 1.0, 300.0] {
                let point = (ray.anchor + ray.offset) + ray.direction * distance;
                let found = frame.project(point).expect("it is seen");
                let error = (found[0] - expected[0]).hypot(found[1] - expected[1]);
                // In degrees, for a point that is rounded like the coordinates of the eye.
                assert!(error < 1e-10 / distance.min(1.0), "{projection:?} {column} {row}: {found:?} {expected:?}");
                let sight = frame.sight(point, Vector::default());
                assert!((sight.view + ray.direction).length() < 1e-12 / distance.min(1.0));
                assert!((sight.distance - distance).abs() < 1e-12 * distance.max(1.0));
                assert!((sight.start - (ray.anchor + ray.offset)).length() < 1e-12 * distance.max(1.0));
            }
            seen += 1;
        }
        assert!(seen > 150, "{projection:?}: {seen}");
    }
}

/// A ray of doubles agrees with one of 32 digits, apart from its own rounding.
#[test]
fn rays_of_doubles_agree_with_rays_of_32_digits() {
    use crate::double_double::DoubleDouble;
    for projection in all_projections() {
        let camera = seeing(projection);
        let (frame, precise) = (CameraFrame::<f64>::new(&camera), CameraFrame::<DoubleDouble>::new(&camera));
        let mut worst = 0.0_f64;
        for (column, row) in (0..400).step_by(7).flat_map(|column| (0..300).step_by(11).map(move |row| (column, row))) {
            let position = ScreenPosition::PixelCenter(Pixel { column, row });
            let (ray, exact) = (frame.ray(position), precise.ray(position));
            assert_eq!(ray.is_some(), exact.is_some(), "{projection:?} {column} {row}");
            let (Some(ray), Some(exact)) = (ray, exact) else { continue };
            let difference = Vector::<DoubleDouble>::from_f64(ray.direction) - exact.direction;
            worst = worst.max(difference.length().rounded());
            let start = |anchor: Vector<DoubleDouble>, offset: Vector<DoubleDouble>| anchor + offset;
            let rounded = start(Vector::from_f64(ray.anchor), Vector::from_f64(ray.offset));
            assert!((rounded - start(exact.anchor, exact.offset)).length().rounded() < 1e-30, "{projection:?}");
            let length = exact.direction.length() - DoubleDouble::from_f64(1.0);
            assert!(length.rounded().abs() < 1e-29, "{projection:?}: {length:?}");
        }
        assert!(worst < 4.0 * f64::EPSILON, "{projection:?}: {worst:e}");
    }
}

#[test]
fn a_fisheye_sees_its_field_of_view_and_nothing_else() {
    for (mapping, radius) in [(Mapping::Equidistant, 90.0), (Mapping::EqualArea, 2.0_f64.sqrt().to_degrees())] {
        let fisheye = Fisheye { mapping, field_of_view: 180.0 };
        assert!((fisheye.radius() - radius).abs() < 1e-13, "{mapping:?}");
        let camera = Camera { projection: Projection::Fisheye(fisheye), ..lab(Handedness::Left) };
        let frame = CameraFrame::<f64>::new(&camera);
        let ray = |x, y| frame.ray(ScreenPosition::Point { x, y });
        // At the edge of the circle, perpendicular to the direction of view.
        let inside = fisheye.radius() * (1.0 - 1e-14);
        let edge = ray(0.6 * inside, 0.8 * inside).expect("within the circle").direction;
        assert!((edge - Vector::new(0.6, 0.8, 0.0)).length() < 1e-13, "{mapping:?}: {edge:?}");
        assert_eq!(ray(0.0, 0.0).expect("the middle").direction, Vector::new(0.0, 0.0, 1.0));
        assert!(ray(fisheye.radius() * 1.000_001, 0.0).is_none());
        assert_eq!(frame.project(Vector::new(0.1, 0.0, -0.1)), None, "it is behind");
        // 800 × 600: the circle touches the upper and lower edge.
        let extent = camera.projection.extent(camera.resolution);
        assert_eq!(extent.y, [-fisheye.radius(), fisheye.radius()]);
        assert_eq!(extent.x, [-fisheye.radius() * (800.0 / 600.0), fisheye.radius() * (800.0 / 600.0)]);
    }
}

/// (2.9): the part of the circle within the angle θ of the axis is 2π(1 − cosθ) in square radians, at every θ.
#[test]
fn areas_of_the_equal_area_fisheye_are_solid_angles() {
    use std::f64::consts::PI;
    let fisheye = Fisheye { mapping: Mapping::EqualArea, field_of_view: 360.0 };
    for degrees in [1.0, 30.0, 90.0, 150.0, 179.0_f64] {
        let theta = degrees.to_radians();
        let [x, _] = fisheye.project(Vector::new(theta.sin(), 0.0, theta.cos())).expect("all is seen");
        let area = PI * x.to_radians() * x.to_radians();
        assert!((area / (2.0 * PI * (1.0 - theta.cos())) - 1.0).abs() < 1e-12, "{degrees}");
    }
}

#[test]
fn a_panorama_has_longitude_and_latitude() {
    let projection = Projection::Panorama(Extent { x: [0.0, 360.0], y: [-90.0, 90.0] });
    let frame = CameraFrame::<f64>::new(&Camera { projection, ..lab(Handedness::Left) });
    let ray = |x, y| frame.ray(ScreenPosition::Point { x, y });
    for ([x, y], expected) in [
        ([0.0, 0.0], Vector::new(0.0, 0.0, 1.0)),
        ([90.0, 0.0], Vector::new(1.0, 0.0, 0.0)),
        ([270.0, 30.0], Vector::new(-0.75_f64.sqrt(), 0.5, 0.0)),
        ([12.0, 90.0], Vector::new(0.0, 1.0, 0.0)),
    ] {
        let direction = ray(x, y).expect("it is within the poles").direction;
        assert!((direction - expected).length() < 4e-16, "{x} {y}: {direction:?}");
    }
    assert!(ray(0.0, 90.1).is_none() && ray(0.0, -91.0).is_none());
    let [longitude, latitude] = frame.project(Vector::new(-1.0, 0.0, 0.0)).expect("all is seen");
    assert!((longitude - 270.0).abs() < 1e-13 && latitude.abs() < 1e-13);
}
