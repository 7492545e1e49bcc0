//! Exact values at a point.

use crate::map::Pixel;
use crate::prepare::PreparedScene;
use crate::shade::{LightTerm, Shading};
use crate::shape::{Located, Miss, SurfacePoint, surface_at};
use crate::units::LengthUnit;
use crate::vector::Vector;

/// Where a value is asked for.
#[derive(Clone, Debug, PartialEq)]
pub enum Place {
    /// A point in space, in metres.
    Point(Vector),
    /// The point of the nearest surface to this one, in metres.
    NearestTo(Vector),
    /// What is seen at the centre of a pixel.
    Pixel(Pixel),
    /// A point of a sphere by its angles in the camera's axes, in radians: θ from the direction towards the viewer
    /// (against the direction of view), φ from +x of the screen towards +y.
    Angles {
        /// Index of the shape.
        shape: usize,
        /// θ.
        theta: f64,
        /// φ.
        phi: f64,
    },
}

/// Values at a point of a surface, in double precision: within 1e-12 relative where cosθ_i and cosθ_o exceed 1e-3.
#[derive(Clone, Debug)]
pub struct ProbeReading {
    /// Index of the shape.
    pub shape: usize,
    /// The point and its directions.
    pub point: SurfacePoint,
    /// Irradiance and brightness.
    pub shading: Shading,
    /// Each light's term, in the order of the scene.
    pub terms: Vec<LightTerm>,
    /// Whether the eye sees the point.
    pub seen: SeenFromEye,
}

/// Whether the eye would see a point if it looked there, in the picture or not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SeenFromEye {
    /// It does.
    Seen,
    /// The surface faces away from the eye there: θ_o ≥ 90°.
    FacesAway,
    /// A shape with this index stands before it.
    HiddenBy(usize),
}

impl ProbeReading {
    /// The point, in the scene's unit.
    #[must_use]
    pub fn position(&self, length: LengthUnit) -> [f64; 3] {
        self.point.position().to_array().map(|metres| length.from_metres(metres))
    }

    /// Whether the eye sees the point.
    #[must_use]
    pub fn is_seen(&self) -> bool {
        self.seen == SeenFromEye::Seen
    }
}

/// Why there is no value.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ProbeError {
    /// The point is on no surface.
    #[error("the point is on no surface")]
    OffSurface(Miss),
    /// The scene has no shapes.
    #[error("the scene has no shapes")]
    NoShapes,
    /// The pixel is outside the image.
    #[error("there is no pixel at column {}, row {}", pixel.column, pixel.row)]
    NoSuchPixel {
        /// What was asked for.
        pixel: Pixel,
    },
    /// The pixel sees no surface.
    #[error("no surface is seen at column {}, row {}", pixel.column, pixel.row)]
    NothingSeen {
        /// What was asked for.
        pixel: Pixel,
    },
}

impl PreparedScene {
    /// The values at a place (3.1) to (3.6).
    ///
    /// # Errors
    /// A place that is on no surface.
    pub fn probe(&self, place: &Place) -> Result<ProbeReading, ProbeError> {
        let geometries = || self.scene().shapes().iter().map(|shape| &shape.geometry);
        match *place {
            Place::Point(point) => match surface_at(geometries(), point) {
                Ok(located) => Ok(self.reading_at(&located)),
                Err(Some(miss)) => Err(ProbeError::OffSurface(miss)),
                Err(None) => Err(ProbeError::NoShapes),
            },
            Place::NearestTo(point) => match surface_at(geometries(), point) {
                Ok(located) => Ok(self.reading_at(&located)),
                Err(Some(Miss { shape, nearest, .. })) => Ok(self.reading_at(&Located { shape, nearest })),
                Err(None) => Err(ProbeError::NoShapes),
            },
            Place::Pixel(pixel) => self.probe_pixel(pixel),
            Place::Angles { shape, theta, phi } => {
                let frame = self.frame();
                let ring = frame.right * libm::cos(phi) + frame.up * libm::sin(phi);
                let direction = ring * libm::sin(theta) - frame.forward * libm::cos(theta);
                let geometry = self.scene().shapes().get(shape).ok_or(ProbeError::NoShapes)?.geometry;
                Ok(self.reading_at(&Located { shape, nearest: geometry.in_direction(direction) }))
            }
        }
    }

    fn probe_pixel(&self, pixel: Pixel) -> Result<ProbeReading, ProbeError> {
        let resolution = self.scene().camera().resolution;
        if pixel.column >= resolution.width || pixel.row >= resolution.height {
            return Err(ProbeError::NoSuchPixel { pixel });
        }
        let hit = self.trace_pixel(pixel).ok_or(ProbeError::NothingSeen { pixel })?;
        Ok(self.reading(hit.shape, hit.point, SeenFromEye::Seen))
    }

    fn reading_at(&self, located: &Located) -> ProbeReading {
        let point = self.surface_point(located);
        self.reading(located.shape, point, self.seen_from_eye(located.shape, &point))
    }

    fn reading(&self, shape: usize, point: SurfacePoint, seen: SeenFromEye) -> ProbeReading {
        let mut terms = Vec::with_capacity(self.scene().lights().len());
        let shading = self.shade(shape, &point, |_, term| terms.push(*term));
        ProbeReading { shape, point, shading, terms, seen }
    }

    fn seen_from_eye(&self, shape: usize, point: &SurfacePoint) -> SeenFromEye {
        if point.cos_theta_o <= 0.0 {
            return SeenFromEye::FacesAway;
        }
        match self.first_shape_towards(point.position()) {
            Some(first) if first != shape => SeenFromEye::HiddenBy(first),
            _ => SeenFromEye::Seen,
        }
    }
}
