//! Longitude and latitude on a sphere.

use super::SurfaceProjection;
use super::chart::{ChartPoint, around, meridians};
use crate::map::Coordinates;
use crate::shape::Sphere;
use crate::vector::Vector;

/// The longitude λ, and the latitude φ or its sine.
#[derive(Clone, Debug)]
pub(super) struct SphereChart {
    center: Vector,
    radius: f64,
    axis: Vector,
    meridians: [Vector; 2],
    projection: SurfaceProjection,
}

impl SphereChart {
    pub(super) fn new(sphere: &Sphere, projection: SurfaceProjection, axis: Option<Vector>) -> Self {
        let axis = axis.map_or(Vector::new(0.0, 1.0, 0.0), Vector::normalized);
        let Sphere { center, radius } = *sphere;
        Self { center, radius, axis, meridians: meridians(axis), projection }
    }

    pub(super) fn axis(&self) -> Vector {
        self.axis
    }

    pub(super) fn coordinates(&self) -> Coordinates {
        match self.projection {
            SurfaceProjection::Equirectangular => Coordinates::LongitudeLatitude,
            SurfaceProjection::EqualArea => Coordinates::LongitudeSine,
        }
    }

    pub(super) fn latitudes(&self) -> [f64; 2] {
        match self.projection {
            SurfaceProjection::Equirectangular => [-90.0, 90.0],
            SurfaceProjection::EqualArea => [-1.0, 1.0],
        }
    }

    /// True to scale along the equator, and along the meridians either there or everywhere.
    pub(super) fn proportions(&self) -> [f64; 2] {
        let equator = std::f64::consts::TAU * self.radius;
        match self.projection {
            SurfaceProjection::Equirectangular => [equator, 0.5 * equator],
            SurfaceProjection::EqualArea => [equator, 2.0 * self.radius],
        }
    }

    pub(super) fn point(&self, [longitude, y]: [f64; 2]) -> ChartPoint {
        let (sine, cosine) = match self.projection {
            SurfaceProjection::Equirectangular => (libm::sin(y.to_radians()), libm::cos(y.to_radians())),
            SurfaceProjection::EqualArea => (y, ((1.0 - y) * (1.0 + y)).sqrt()),
        };
        let normal = self.axis * sine + around(self.meridians, longitude) * cosine;
        ChartPoint { anchor: self.center, offset: normal * self.radius, normal }
    }

    /// R² Δλ Δ(sin φ). The difference of the sines is written as a product, which keeps its accuracy near the poles.
    pub(super) fn area(&self, [west, east]: [f64; 2], [south, north]: [f64; 2]) -> f64 {
        let height = match self.projection {
            SurfaceProjection::Equirectangular => {
                let (middle, half) = ((0.5 * (south + north)).to_radians(), (0.5 * (north - south)).to_radians());
                2.0 * libm::cos(middle) * libm::sin(half)
            }
            SurfaceProjection::EqualArea => north - south,
        };
        self.radius * self.radius * (east - west).to_radians() * height
    }
}
