//! From the triangles of a file to a mesh in a scene.

use super::Mesh;
use crate::message;
use crate::shape::{Bounds, Rotation};
use crate::text::Message;
use crate::vector::Vector;

/// The triangles as stored in a file, in its own axes and unit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshData {
    /// Positions.
    pub vertices: Vec<[f64; 3]>,
    /// The corners of each triangle: indices into `vertices`.
    pub triangles: Vec<[u32; 3]>,
    /// Directions for smooth shading, if any; of any length, with zero for none (the triangle's own normal is used there).
    pub normals: Option<CornerNormals>,
    /// The slot of each triangle: an index into `materials`. Empty if all use the shape's own material.
    pub slots: Vec<u16>,
    /// The material of each slot; `None` stands for the shape's own.
    pub materials: Vec<Option<u32>>,
}

/// A direction for each corner of each triangle. Triangles without normals, in a file that has normals for others, get the
/// normal of their plane.
#[derive(Clone, Debug, PartialEq)]
pub struct CornerNormals {
    /// Unit vectors, no two equal.
    pub vectors: Vec<[f64; 3]>,
    /// The three normals of each triangle: indices into `vectors`.
    pub corners: Vec<[u32; 3]>,
}

/// The transformations of a file's triangles, in this order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshPlacing {
    /// Factors along the file's axes, positive: metres per unit of the file.
    pub scale: Vector,
    /// The rotation that follows.
    pub rotation: Rotation,
    /// Finally, the position of their origin, in metres.
    pub position: Vector,
}

/// Why the triangles do not make a mesh.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{}", self.message())]
pub enum MeshError {
    /// A scale factor that would flatten or mirror the mesh.
    Scale {
        /// The factor.
        scale: f64,
    },
    /// A coordinate that is not finite.
    NotFinite {
        /// `vertex` or `normal`.
        what: &'static str,
        /// Its index.
        index: usize,
        /// The coordinate.
        value: f64,
    },
    /// A corner that does not exist.
    OutOfRange {
        /// Index of the triangle.
        triangle: usize,
        /// `vertex`, `normal` or `material slot`.
        what: &'static str,
        /// The index that it refers to.
        index: usize,
        /// The number of elements.
        count: usize,
    },
    /// A list that should have one entry per triangle but does not.
    Lengths {
        /// `triples of normals` or `material slots`.
        what: &'static str,
        /// The number of entries.
        count: usize,
        /// The number of triangles.
        triangles: usize,
    },
    /// A mesh with nothing visible.
    Empty {
        /// The number of triangles without area.
        without_area: usize,
    },
    /// More triangles than 32 bits can count.
    TooMany {
        /// The number of triangles.
        triangles: usize,
    },
}

impl MeshError {
    /// What is wrong, in either language.
    #[must_use]
    pub fn message(&self) -> Message {
        match self {
            Self::Scale { scale } => message!("the scale is {scale}; allowed: finite numbers above 0", scale),
            Self::NotFinite { what: "vertex", index, value } => {
                message!("vertex {index} has the coordinate {value}; allowed: finite numbers", index, value)
            }
            Self::NotFinite { index, value, .. } => {
                message!("normal {index} has the coordinate {value}; allowed: finite numbers", index, value)
            }
            Self::OutOfRange { triangle, what, index, count } => {
                let what = match *what {
                    "vertex" => message!("vertex {index}", index),
                    "normal" => message!("normal {index}", index),
                    _ => message!("material slot {index}", index),
                };
                message!(
                    "triangle {triangle} refers to {what}; there are {count}, counted from 0",
                    triangle,
                    what,
                    count
                )
            }
            Self::Lengths { what: "material slots", count, triangles } => {
                message!("there are {count} material slots for {triangles} triangles", count, triangles)
            }
            Self::Lengths { count, triangles, .. } => {
                message!("there are {count} triples of normals for {triangles} triangles", count, triangles)
            }
            Self::Empty { without_area } => {
                message!("it has no triangle with an area ({without_area} without)", without_area)
            }
            Self::TooMany { triangles } => {
                message!("it has {triangles} triangles; allowed: at most {most}", triangles, most = u32::MAX)
            }
        }
    }
}

impl Mesh {
    /// Transforms the triangles of a file into the scene. Normals stay perpendicular to the surface under any scale: each of
    /// their components is divided by the factor of its axis, because normals transform inversely to tangents. Triangles
    /// without area are left out and counted.
    ///
    /// # Errors
    /// [`MeshError`]: a scale, an index or a coordinate that is not allowed; no triangle with an area.
    pub fn new(data: MeshData, placing: &MeshPlacing) -> Result<Self, MeshError> {
        check(&data, placing)?;
        let MeshData { mut vertices, mut triangles, mut normals, mut slots, materials } = data;
        let MeshPlacing { scale, rotation, position } = *placing;
        let turn = rotation.matrix();
        for vertex in &mut vertices {
            let [x, y, z] = *vertex;
            let scaled = Vector::new(x * scale.x, y * scale.y, z * scale.z);
            *vertex = (turned(&turn, scaled) + position).to_array();
        }
        if let Some(normals) = &mut normals {
            for normal in &mut normals.vectors {
                *normal = turned_normal(&turn, Vector::from(*normal), scale).to_array();
            }
        }
        let before = triangles.len();
        let has_area: Vec<bool> = triangles.iter().map(|corners| has_area(&vertices, *corners)).collect();
        keep(&mut triangles, &has_area);
        keep(&mut slots, &has_area);
        if let Some(normals) = &mut normals {
            keep(&mut normals.corners, &has_area);
        }
        let left_out = before - triangles.len();
        let corners = triangles.iter().flatten().map(|index| Vector::from(vertices[*index as usize]));
        let bounds = corners.map(|corner| Bounds { least: corner, greatest: corner }).reduce(Bounds::union);
        let bounds = bounds.ok_or(MeshError::Empty { without_area: left_out })?;
        Ok(Self { vertices, triangles, normals, slots, materials, left_out, bounds })
    }
}

fn check(data: &MeshData, placing: &MeshPlacing) -> Result<(), MeshError> {
    let allowed = |scale: &f64| scale.is_finite() && *scale > 0.0;
    if let Some(scale) = placing.scale.to_array().into_iter().find(|scale| !allowed(scale)) {
        return Err(MeshError::Scale { scale });
    }
    let count = data.triangles.len();
    if u32::try_from(count).is_err() {
        return Err(MeshError::TooMany { triangles: count });
    }
    all_finite("vertex", &data.vertices)?;
    all_in_range("vertex", &data.triangles, data.vertices.len())?;
    if let Some(normals) = &data.normals {
        all_finite("normal", &normals.vectors)?;
        same_length("triples of normals", normals.corners.len(), count)?;
        all_in_range("normal", &normals.corners, normals.vectors.len())?;
    }
    if !data.slots.is_empty() {
        same_length("material slots", data.slots.len(), count)?;
        let (what, count) = ("material slot", data.materials.len());
        if let Some((triangle, slot)) = (0..).zip(&data.slots).find(|(_, slot)| usize::from(**slot) >= count) {
            return Err(MeshError::OutOfRange { triangle, what, index: (*slot).into(), count });
        }
    }
    Ok(())
}

fn all_finite(what: &'static str, vectors: &[[f64; 3]]) -> Result<(), MeshError> {
    for (index, vector) in vectors.iter().enumerate() {
        if let Some(&value) = vector.iter().find(|value| !value.is_finite()) {
            return Err(MeshError::NotFinite { what, index, value });
        }
    }
    Ok(())
}

fn all_in_range(what: &'static str, corners: &[[u32; 3]], count: usize) -> Result<(), MeshError> {
    for (triangle, corners) in corners.iter().enumerate() {
        if let Some(&index) = corners.iter().find(|index| **index as usize >= count) {
            return Err(MeshError::OutOfRange { triangle, what, index: index as usize, count });
        }
    }
    Ok(())
}

fn same_length(what: &'static str, count: usize, triangles: usize) -> Result<(), MeshError> {
    if count == triangles { Ok(()) } else { Err(MeshError::Lengths { what, count, triangles }) }
}

/// Keeps the items of kept triangles; an empty list stays empty.
fn keep<T>(items: &mut Vec<T>, is_kept: &[bool]) {
    let mut is_kept = is_kept.iter();
    items.retain(|_| is_kept.next().is_none_or(|kept| *kept));
}

fn turned(matrix: &[Vector; 3], vector: Vector) -> Vector {
    let [x, y, z] = matrix;
    *x * vector.x + *y * vector.y + *z * vector.z
}

fn turned_normal(matrix: &[Vector; 3], normal: Vector, scale: Vector) -> Vector {
    let largest = normal.to_array().into_iter().fold(0.0_f64, |largest, component| largest.max(component.abs()));
    if largest == 0.0 {
        return normal;
    }
    // Divided by the largest component first, so that the squares neither underflow nor overflow.
    let least_scale = scale.x.min(scale.y).min(scale.z);
    let part = |component: f64, scale: f64| component / largest * (least_scale / scale);
    let scaled = Vector::new(part(normal.x, scale.x), part(normal.y, scale.y), part(normal.z, scale.z));
    turned(matrix, scaled.normalized())
}

/// Whether a triangle is wider than a billionth of a thousandth of its longest side: anything less is only rounding error.
fn has_area(vertices: &[[f64; 3]], corners: [u32; 3]) -> bool {
    let [a, b, c] = corners.map(|index| Vector::from(vertices[index as usize]));
    let sides = [b - a, c - b, a - c];
    let longest = sides.map(Vector::length).into_iter().fold(0.0, f64::max);
    // The squares of smaller numbers underflow.
    let part = |side: Vector| side * (1.0 / longest);
    longest > 1e-150 && part(sides[0]).cross(part(sides[2])).length() > 1e-12
}
