//! The limits of a scene. The bounds on numbers keep every formula far from overflow.

use std::ops::RangeInclusive;

use crate::light::Spot;

/// Size of a scene file in bytes.
pub const FILE_BYTES: u64 = 64 << 20;
/// Pixels in a row, and rows. A map in memory has its own limits, [`crate::map::Resolution::fits_memory`].
pub const SIDE: u32 = 1_000_000;
/// A name, in bytes of UTF-8.
pub const NAME_BYTES: usize = 1000;
/// The title, in bytes of UTF-8.
pub const TITLE_BYTES: usize = 10_000;
/// Lights in a scene.
pub const LIGHTS: usize = 100_000;
/// Shapes in a scene, of all kinds together.
pub const SHAPES: usize = 100_000;
/// Probes in a scene.
pub const PROBES: usize = 100_000;
/// Areas in a scene.
pub const AREAS: usize = 1000;
/// Grids in a scene.
pub const GRIDS: usize = 1000;
/// The largest coordinate, in metres: a tenth of a light year.
pub const COORDINATE: f64 = 1e15;
/// The smallest radius or screen, in metres.
pub const SMALLEST: f64 = 1e-12;
/// The largest intensity, power, irradiance or radiance.
pub const INTENSITY: f64 = 1e30;
/// The distance of the eye, in sizes of a shape, beyond which a warning says that the promised accuracy is not kept.
pub const RELATIVE_DISTANCE: f64 = 1e9;
/// Rays per pixel, and sampled directions of the ambient light.
pub const SAMPLES: u32 = 4096;
/// The allowed error of a pixel, as a fraction of the largest brightness.
pub const TOLERANCE: RangeInclusive<f64> = 1e-4..=1.0;
/// The largest coefficient of a material that is an albedo in the scene's convention, the fraction of light that it reflects.
pub const ALBEDO: f64 = 1.0;
/// The largest coefficient of a material that is none, such as one in sr⁻¹.
pub const COEFFICIENT: f64 = 1e6;
/// The largest shininess.
pub const SHININESS: f64 = 1e5;
/// The field of view of a perspective camera, in degrees: outside this range, its screen would be a point or unbounded.
pub const PERSPECTIVE_FIELD: RangeInclusive<f64> = 1e-6..=179.9999;
/// The field of view of a fisheye camera, in degrees.
pub const FISHEYE_FIELD: RangeInclusive<f64> = 1e-6..=360.0;
/// Focal lengths of a calibrated camera, in pixels.
pub const FOCAL_LENGTH: RangeInclusive<f64> = 1e-3..=1e9;
/// The farthest that a principal point may be from the first pixel, in pixels.
pub const PRINCIPAL_POINT: f64 = 1e9;
/// How far the product of a rotation and its transpose may be from the identity, in any element.
pub const ROTATION: f64 = 1e-6;
/// The farthest edges of a panorama in longitude, in degrees.
pub const LONGITUDE: f64 = 360.0;
/// The farthest edges of a panorama in latitude, in degrees.
pub const LATITUDE: f64 = 90.0;
/// The largest angle of a direction from −z, in degrees.
pub const TILT: f64 = 180.0;
/// The largest angle of a direction about the z axis, in degrees, either way.
pub const AZIMUTH: f64 = 360.0;
/// Half the opening of a spot's cones, in degrees.
pub const CONE: f64 = 90.0;
/// The smallest difference between a spot's cones, in degrees.
pub const CONE_STEP: f64 = Spot::SHARPEST.to_degrees();
/// The scale factors of a mesh.
pub const SCALE: RangeInclusive<f64> = 1e-12..=1e12;
