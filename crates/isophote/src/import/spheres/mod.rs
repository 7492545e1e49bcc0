//! Lists of spheres, one file per format.

pub(super) mod csv;
pub(super) mod npy;

use super::{Fault, FilePosition, FileProblem, MaterialSlots, materials::SlotBook, text::finite};

/// Spheres in the order of their file.
#[derive(Debug, Clone, PartialEq)]
pub struct SphereList {
    /// Centres in the file's unit of length, all finite.
    pub centers: Vec<[f64; 3]>,
    /// Radii in the same unit, all finite and greater than 0.
    pub radii: Vec<f64>,
    /// Materials by name, if the file has any.
    pub materials: Option<MaterialSlots>,
}

/// Builds a list from spheres as stored in a file.
#[derive(Debug, Default)]
pub(super) struct SpheresBuilder {
    centers: Vec<[f64; 3]>,
    radii: Vec<f64>,
    pub materials: SlotBook,
}

impl SpheresBuilder {
    /// With capacity for this many.
    pub fn with_capacity(count: usize) -> Self {
        let (centers, radii) = (Vec::with_capacity(count), Vec::with_capacity(count));
        Self { centers, radii, materials: SlotBook::default() }
    }

    /// Adds one sphere.
    pub fn sphere(&mut self, [x, y, z, radius]: [f64; 4]) -> Result<(), FileProblem> {
        let center = [finite(x, "x")?, finite(y, "y")?, finite(z, "z")?];
        let radius = finite(radius, "radius")?;
        if radius <= 0.0 {
            return Err(FileProblem::Radius { value: radius });
        }
        self.centers.push(center);
        self.radii.push(radius);
        Ok(())
    }

    /// The list of all spheres so far.
    pub fn finish(mut self) -> Result<SphereList, Fault> {
        if self.centers.is_empty() {
            return Err(FileProblem::NoSpheres.at(FilePosition::Whole));
        }
        self.centers.shrink_to_fit();
        self.radii.shrink_to_fit();
        Ok(SphereList { centers: self.centers, radii: self.radii, materials: self.materials.finish() })
    }
}
