//! Angle and radius on a disk.

use super::SurfaceProjection;
use super::chart::{ChartPoint, around, meridians};
use crate::map::Coordinates;
use crate::shape::Disk;
use crate::vector::Vector;

/// The angle about the normal, and the distance r from the centre or (r/R)².
#[derive(Clone, Debug)]
pub(super) struct DiskChart {
    center: Vector,
    normal: Vector,
    radius: f64,
    meridians: [Vector; 2],
    projection: SurfaceProjection,
}

impl DiskChart {
    /// A disk does not unroll: these proportions merely make the numbers readable.
    pub(super) const PROPORTIONS: [f64; 2] = [2.0, 1.0];

    pub(super) fn new(disk: &Disk, projection: SurfaceProjection) -> Self {
        let normal = disk.normal();
        Self { center: disk.center(), normal, radius: disk.size(), meridians: meridians(normal), projection }
    }

    pub(super) fn coordinates(&self) -> Coordinates {
        match self.projection {
            SurfaceProjection::Equirectangular => Coordinates::AngleRadius,
            SurfaceProjection::EqualArea => Coordinates::AngleSquare,
        }
    }

    pub(super) fn radii(&self) -> [f64; 2] {
        match self.projection {
            SurfaceProjection::Equirectangular => [0.0, self.radius],
            SurfaceProjection::EqualArea => [0.0, 1.0],
        }
    }

    pub(super) fn point(&self, [angle, y]: [f64; 2]) -> ChartPoint {
        let radius = match self.projection {
            SurfaceProjection::Equirectangular => y,
            SurfaceProjection::EqualArea => self.radius * y.sqrt(),
        };
        ChartPoint { anchor: self.center, offset: around(self.meridians, angle) * radius, normal: self.normal }
    }

    /// Δφ Δ(r²)/2.
    pub(super) fn area(&self, [first, last]: [f64; 2], [inner, outer]: [f64; 2]) -> f64 {
        let squares = match self.projection {
            SurfaceProjection::Equirectangular => (outer - inner) * (outer + inner),
            SurfaceProjection::EqualArea => self.radius * self.radius * (outer - inner),
        };
        0.5 * (last - first).to_radians() * squares
    }
}
