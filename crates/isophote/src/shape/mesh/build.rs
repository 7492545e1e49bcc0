//! From the triangles of a file to a mesh that stands in a scene.

use super::Mesh;
use crate::shape::{Bounds, Rotation};
use crate::vector::Vector;

/// The triangles as a file has them, in its own axes and unit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshData {
    /// Positions.
    pub vertices: Vec<[f64; 3]>,
    /// The corners of each triangle: indices into `vertices`.
    pub triangles: Vec<[u32; 3]>,
    /// Directions for smooth shading, if any; of any length, but zero for none (the triangle's own normal then stands
    /// there).
    pub normals: Option<CornerNormals>,
    /// The slot of each triangle: an index into `materials`. Empty where all have the shape's own material.
    pub slots: Vec<u16>,
    /// The material of each slot; none stands for the shape's own.
    pub materials: Vec<Option<u32>>,
}

/// A direction for each corner of each triangle. Triangles for which the file gives none, while it gives some for others,
/// have that of their plane.
#[derive(Clone, Debug, PartialEq)]
pub struct CornerNormals {
    /// Unit vectors, no two equal.
    pub vectors: Vec<[f64; 3]>,
    /// Each triangle's three: indices into `vectors`.
    pub corners: Vec<[u32; 3]>,
}

/// What is done with the triangles of a file, in this order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshPlacing {
    /// Factors along the file's axes, positive: metres per unit of the file.
    pub scale: Vector,
    /// Then they are turned.
    pub rotation: Rotation,
    /// Then moved to where this is their origin, in metres.
    pub position: Vector,
}

/// Why triangles make no mesh.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// A factor that would flatten or mirror it.
    #[error("the scale is {scale}; allowed: finite numbers above 0")]
    Scale {
        /// The factor.
        scale: f64,
    },
    /// A position or direction that is none.
    #[error("{what} {index} has the coordinate {value}; allowed: finite numbers")]
    NotFinite {
        /// `vertex` or `normal`.
        what: &'static str,
        /// Which.
        index: usize,
        /// The coordinate.
        value: f64,
    },
    /// A corner that does not exist.
    #[error("triangle {triangle} refers to {what} {index}; there are {count}, counted from 0")]
    OutOfRange {
        /// Which triangle.
        triangle: usize,
        /// `vertex`, `normal` or `material slot`.
        what: &'static str,
        /// To which.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// Lists that should have an entry for each triangle and have not.
    #[error("there are {count} {what} for {triangles} triangles")]
    Lengths {
        /// `triples of normals` or `material slots`.
        what: &'static str,
        /// How many.
        count: usize,
        /// How many triangles.
        triangles: usize,
    },
    /// Nothing that could be seen.
    #[error("it has no triangle with an area ({without_area} without)")]
    Empty {
        /// How many triangles there are without one.
        without_area: usize,
    },
    /// More than 32 bits can count.
    #[error("it has {triangles} triangles; allowed: at most {}", u32::MAX)]
    TooMany {
        /// How many.
        triangles: usize,
    },
}

impl Mesh {
    /// Puts the triangles of a file in their place. Normals stay at right angles to the surface whatever the scale: each
    /// of their components is divided by the factor of its axis, since a plane's normal turns the other way than its
    /// tangents. Triangles without area are left out and counted.
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

/// The items whose triangle is kept; a list without items has none to lose.
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
    // Divided first by what is largest: the squares then neither vanish nor overflow.
    let least_scale = scale.x.min(scale.y).min(scale.z);
    let part = |component: f64, scale: f64| component / largest * (least_scale / scale);
    let scaled = Vector::new(part(normal.x, scale.x), part(normal.y, scale.y), part(normal.z, scale.z));
    turned(matrix, scaled.normalized())
}

/// Whether a triangle is wider than a billionth of a thousandth of its longest side: less is nothing but rounding.
fn has_area(vertices: &[[f64; 3]], corners: [u32; 3]) -> bool {
    let [a, b, c] = corners.map(|index| Vector::from(vertices[index as usize]));
    let sides = [b - a, c - b, a - c];
    let longest = sides.map(Vector::length).into_iter().fold(0.0, f64::max);
    // Squares of what is smaller than this vanish.
    let part = |side: Vector| side * (1.0 / longest);
    longest > 1e-150 && part(sides[0]).cross(part(sides[2])).length() > 1e-12
}
