//! Finds the surface that a point lies on.

use super::{Geometry, NearestPoint};
use crate::message;
use crate::text::{Message, significant};
use crate::units::{Keyword, LengthUnit};
use crate::vector::Vector;

/// A point found on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Located {
    /// Index of the shape among those that were searched.
    pub shape: usize,
    /// The point, moved onto the surface by less than the tolerance.
    pub nearest: NearestPoint,
}

/// A point that is on no surface, and the nearest surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Miss {
    /// Index of the nearest shape among those that were searched.
    pub shape: usize,
    /// Its signed distance in metres, negative where the point is inside.
    pub distance: f64,
    /// The nearest point of that surface.
    pub nearest: NearestPoint,
}

/// The surface that a point lies on, to [`Geometry::surface_tolerance`].
///
/// # Errors
/// The nearest surface if the point is on none; `None` if there are no shapes at all.
pub fn surface_at<'g>(shapes: impl Iterator<Item = &'g Geometry>, point: Vector) -> Result<Located, Option<Box<Miss>>> {
    let nearest = shapes
        .enumerate()
        .map(|(index, geometry)| (index, geometry, geometry.signed_distance(point)))
        .min_by(|first, second| first.2.abs().total_cmp(&second.2.abs()));
    let Some((shape, geometry, distance)) = nearest else { return Err(None) };
    let nearest = geometry.nearest(point);
    if distance.abs() <= geometry.surface_tolerance(point) {
        Ok(Located { shape, nearest })
    } else {
        Err(Some(Box::new(Miss { shape, distance, nearest })))
    }
}

impl Miss {
    /// Describes where the nearest surface is, in the scene's unit. `name` is the nearest shape's.
    #[must_use]
    pub fn describe(&self, name: &str, length: LengthUnit) -> Message {
        let distance = length.from_metres(self.distance.abs());
        let [x, y, z] = self.point().map(|coordinate| length.from_metres(coordinate));
        let distance = significant(distance, 6);
        let unit = length.name();
        let point = format!("[{x}, {y}, {z}]");
        if self.distance < 0.0 {
            message!(
                "it is {distance} {unit} inside the surface of \"{name}\"; the nearest point there is {point}",
                distance,
                unit,
                name,
                point
            )
        } else {
            message!(
                "it is {distance} {unit} outside the surface of \"{name}\"; the nearest point there is {point}",
                distance,
                unit,
                name,
                point
            )
        }
    }

    /// The nearest surface point, in metres.
    #[must_use]
    pub fn point(&self) -> [f64; 3] {
        (self.nearest.anchor + self.nearest.offset).to_array()
    }
}
