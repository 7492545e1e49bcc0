//! From a file's vertices and faces to a mesh.

use super::{TriangleMesh, weld::Welder};
use crate::import::{Fault, FilePosition, FileProblem, materials::SlotBook};
use crate::message;
use crate::shape::CornerNormals;

/// Builds a mesh from triangles as stored in a file.
#[derive(Debug, Default)]
pub(in crate::import) struct MeshBuilder {
    vertices: Welder,
    triangles: Vec<[u32; 3]>,
    normals: Welder,
    corners: Vec<[u32; 3]>,
    pub materials: SlotBook,
    degenerate: u64,
}

/// The normals of a triangle for which the file has none.
pub(in crate::import) const NO_NORMALS: Option<[([f64; 3], u64); 3]> = None;

impl MeshBuilder {
    /// Adds one triangle of a face; `normals` are those of its corners, with the numbers that messages refer to.
    pub fn triangle(
        &mut self,
        corners: [[f64; 3]; 3],
        normals: Option<[([f64; 3], u64); 3]>,
        material: u16,
    ) -> Result<(), FileProblem> {
        if plane_normal(corners).is_none() {
            self.degenerate += 1;
            return Ok(());
        }
        self.triangles.push(welded(&mut self.vertices, corners)?);
        self.materials.push(material);
        if let Some(normals) = normals {
            self.flat_until(self.triangles.len() - 1)?;
            let mut units = [[0.0; 3]; 3];
            for (unit, (vector, number)) in units.iter_mut().zip(normals) {
                *unit = normalized(vector).ok_or(FileProblem::NoDirection { number })?;
            }
            self.corners.push(welded(&mut self.normals, units)?);
        }
        Ok(())
    }

    /// The mesh of all triangles so far.
    pub fn finish(mut self) -> Result<TriangleMesh, Fault> {
        if self.triangles.is_empty() {
            return Err(FileProblem::NoTriangles { degenerate: self.degenerate }.at(FilePosition::Whole));
        }
        if !self.corners.is_empty() {
            self.flat_until(self.triangles.len()).map_err(|problem| problem.at(FilePosition::Whole))?;
        }
        let normals = (!self.corners.is_empty()).then(|| {
            self.corners.shrink_to_fit();
            CornerNormals { vectors: self.normals.finish(), corners: self.corners }
        });
        self.triangles.shrink_to_fit();
        Ok(TriangleMesh {
            vertices: self.vertices.finish(),
            triangles: self.triangles,
            normals,
            materials: self.materials.finish(),
            degenerate: self.degenerate,
        })
    }

    /// Gives the triangles without normals, up to this one, the normals of their planes.
    fn flat_until(&mut self, end: usize) -> Result<(), FileProblem> {
        for triangle in &self.triangles[self.corners.len()..end] {
            let corners = triangle.map(|index| self.vertices.vector(index));
            let normal = plane_normal(corners).expect("it was kept because it has one");
            self.corners.push(welded(&mut self.normals, [normal; 3])?);
        }
        Ok(())
    }
}

fn welded(welder: &mut Welder, vectors: [[f64; 3]; 3]) -> Result<[u32; 3], FileProblem> {
    let mut indices = [0; 3];
    for (index, vector) in indices.iter_mut().zip(vectors) {
        *index = welder
            .index(vector)
            .ok_or_else(|| FileProblem::TooMany { what: message!("vertices"), most: u64::from(u32::MAX) })?;
    }
    Ok(indices)
}

/// The unit normal, in the direction of (B − A) × (C − A); `None` if the corners are collinear as far as double precision
/// can tell.
fn plane_normal(corners: [[f64; 3]; 3]) -> Option<[f64; 3]> {
    // Otherwise, the difference of two of them could be infinite.
    let corners =
        if largest(corners.map(largest)) > 1e300 { corners.map(|corner| times(corner, 1e-10)) } else { corners };
    let [a, b, c] = corners;
    let edges = [minus(b, a), minus(c, b), minus(a, c)];
    let lengths = edges.map(largest);
    // The angle between the two shorter edges is the most accurate one.
    let longest = (0..3).max_by(|i, j| lengths[*i].total_cmp(&lengths[*j]))?;
    let (first, second) = ((longest + 1) % 3, (longest + 2) % 3);
    if lengths[first] == 0.0 || lengths[second] == 0.0 {
        return None;
    }
    let edge = |i: usize| edges[i].map(|component| component / lengths[i]);
    let normal = cross(edge(first), edge(second));
    // The rounding error of the edges and of the products: three half units in the last place of 1, twice.
    if largest(normal) > 3.0 * f64::EPSILON { normalized(normal) } else { None }
}

/// The vector scaled to length 1; `None` for zero.
fn normalized(vector: [f64; 3]) -> Option<[f64; 3]> {
    let largest = largest(vector);
    let scaled = vector.map(|component| component / largest);
    let length = scaled.iter().map(|component| component * component).sum::<f64>().sqrt();
    (largest > 0.0).then(|| scaled.map(|component| component / length))
}

fn largest(vector: [f64; 3]) -> f64 {
    vector.into_iter().map(f64::abs).fold(0.0, f64::max)
}

fn times(vector: [f64; 3], factor: f64) -> [f64; 3] {
    vector.map(|component| component * factor)
}

fn minus([a, b, c]: [f64; 3], [d, e, f]: [f64; 3]) -> [f64; 3] {
    [a - d, b - e, c - f]
}

fn cross([a, b, c]: [f64; 3], [d, e, f]: [f64; 3]) -> [f64; 3] {
    [b * f - c * e, c * d - a * f, a * e - b * d]
}

#[cfg(test)]
mod tests {
    use super::plane_normal;

    #[test]
    fn a_triangle_has_an_area_at_any_scale_but_not_on_a_line() {
        for scale in [1e-300, 1e-6, 1.0, 1e12, 1e307] {
            let at = |x: f64, y: f64| [x * scale, y * scale, 0.0];
            assert_eq!(plane_normal([at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0)]), Some([0.0, 0.0, 1.0]));
            assert_eq!(plane_normal([at(0.0, 0.0), at(0.0, 1.0), at(1.0, 0.0)]), Some([0.0, 0.0, -1.0]));
            assert_eq!(plane_normal([at(0.0, 0.0), at(1.0, 1.0), at(3.0, 3.0)]), None);
            assert_eq!(plane_normal([at(-1.0, 0.1), at(-1.0, 0.1), at(1.0, 0.3)]), None);
        }
        let line = |t: f64| [0.1 + 0.7 * t, 0.2 - 0.3 * t, 0.3 + 0.11 * t].map(|x| (x * 8192.0).round() / 8192.0);
        assert_eq!(plane_normal([line(0.0), line(0.0), line(1.0)]), None);
        // A needle: two corners are 1e-12 apart, and the numbers are exact.
        assert_eq!(plane_normal([[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1e-12, 0.0]]), Some([0.0, 0.0, 1.0]));
    }
}
