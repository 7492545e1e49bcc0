//! The transform of a glTF node.

use super::document::Node;
use crate::import::{FileProblem, text::finite};
use crate::message;
use crate::text::Message;
use crate::vector::Vector;

/// x ↦ Ax + t.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Transform {
    rows: [Vector; 3],
    translation: Vector,
    /// Whether it is a reflection, which reverses the order of corners.
    pub is_mirror: bool,
}

impl Transform {
    pub const IDENTITY: Self = Self {
        rows: [Vector::new(1.0, 0.0, 0.0), Vector::new(0.0, 1.0, 0.0), Vector::new(0.0, 0.0, 1.0)],
        translation: Vector::new(0.0, 0.0, 0.0),
        is_mirror: false,
    };

    /// A node's own transform: a matrix, or first scale, then rotation, then translation.
    pub fn of(node: &Node) -> Result<Self, FileProblem> {
        if let Some(m) = node.matrix {
            if [m[3], m[7], m[11], m[15]] != [0.0, 0.0, 0.0, 1.0] {
                let found = format!("{}, {}, {}, {}", m[3], m[7], m[11], m[15]);
                let (what, allowed) = (message!("the last row of the matrix"), Message::verbatim("0, 0, 0, 1"));
                return Err(FileProblem::Unexpected { what, found, allowed });
            }
            let rows = [0, 1, 2].map(|i| Vector::new(m[i], m[i + 4], m[i + 8]));
            return Ok(Self::new(rows, Vector::new(m[12], m[13], m[14])));
        }
        let [x, y, z] = node.scale.unwrap_or([1.0; 3]);
        let rows = rotation(node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]))?;
        let rows = rows.map(|row| Vector::new(row.x * x, row.y * y, row.z * z));
        Ok(Self::new(rows, node.translation.unwrap_or_default().into()))
    }

    /// Applies `inner` first, then this.
    pub fn after(&self, inner: &Self) -> Self {
        let [a, b, c] = inner.rows;
        let rows = self.rows.map(|row| a * row.x + b * row.y + c * row.z);
        Self::new(rows, self.point(inner.translation))
    }

    /// Checks that it does not flatten triangles.
    pub fn check(&self) -> Result<(), FileProblem> {
        let determinant = determinant(self.rows);
        if determinant != 0.0 && determinant.is_finite() {
            return Ok(());
        }
        let (what, allowed) = (message!("the determinant of its transform"), message!("a finite number other than 0"));
        Err(FileProblem::Unexpected { what, found: determinant.to_string(), allowed })
    }

    pub fn points(&self, points: &[[f64; 3]]) -> Result<Vec<[f64; 3]>, FileProblem> {
        let place = |point: &[f64; 3]| {
            let [x, y, z] = self.point((*point).into()).to_array();
            Ok([finite(x, "x")?, finite(y, "y")?, finite(z, "z")?])
        };
        points.iter().map(place).collect()
    }

    /// Transforms normals by the inverse transpose of A, up to a positive factor: they stay normal to the surface under any
    /// scale, and on the same side.
    pub fn normals(&self, normals: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let [a, b, c] = self.rows;
        // Scaled to about 1; otherwise products of four small scales would underflow.
        let entries = self.rows.map(Vector::to_array);
        let largest = entries.as_flattened().iter().fold(0.0, |largest: f64, entry| largest.max(entry.abs()));
        let sign = if self.is_mirror { -1.0 } else { 1.0 };
        let [a, b, c] = [a, b, c].map(|row| row.map(|entry| entry / largest));
        let cofactors = [b.cross(c), c.cross(a), a.cross(b)].map(|row| row * sign);
        normals.iter().map(|normal| cofactors.map(|row| row.dot(Vector::from(*normal)))).collect()
    }

    fn new(rows: [Vector; 3], translation: Vector) -> Self {
        Self { rows, translation, is_mirror: determinant(rows) < 0.0 }
    }

    fn point(&self, point: Vector) -> Vector {
        Vector::from(self.rows.map(|row| row.dot(point))) + self.translation
    }
}

/// From the quaternion (x, y, z, w), normalised because files store it in single precision.
fn rotation(quaternion: [f64; 4]) -> Result<[Vector; 3], FileProblem> {
    let length = quaternion.iter().map(|part| part * part).sum::<f64>().sqrt();
    if !((length - 1.0).abs() < 1e-3) {
        let (what, allowed) = (message!("the length of the rotation"), Message::verbatim("1"));
        return Err(FileProblem::Unexpected { what, found: length.to_string(), allowed });
    }
    let [x, y, z, w] = quaternion.map(|part| part / length);
    Ok([
        Vector::new(1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - z * w), 2.0 * (x * z + y * w)),
        Vector::new(2.0 * (x * y + z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - x * w)),
        Vector::new(2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (x * x + y * y)),
    ])
}

fn determinant([a, b, c]: [Vector; 3]) -> f64 {
    a.dot(b.cross(c))
}

#[cfg(test)]
mod tests {
    use super::Transform;
    use crate::vector::Vector;

    #[test]
    fn normals_stay_normal_to_tangents_under_a_skew_mirror() {
        let rows = [[2.0, 0.5, 0.0], [0.0, -0.1, 0.3], [1.0, 0.0, 4.0]].map(Vector::from);
        let transform = Transform::new(rows, Vector::new(5.0, 6.0, 7.0));
        assert!(transform.is_mirror);
        let image = transform.points(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]).unwrap();
        let edge = |i: usize| Vector::from(image[i]) - Vector::from(image[0]);
        let [normal] = transform.normals(&[[0.0, 0.0, 1.0]])[..] else { panic!("one normal") };
        let normal = Vector::from(normal);
        assert!(normal.dot(edge(1)).abs() < 1e-15);
        assert!(normal.dot(edge(2)).abs() < 1e-15);
        // The third axis was on the normal's side, and still is.
        assert!(normal.dot(edge(3)) > 0.0);
    }
}
