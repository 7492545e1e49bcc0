//! Spheres of PLY files: element `vertex` with `x`, `y`, `z`, `radius` and optionally `material`, an integer: the material's
//! name is that number.

use super::{Header, Rows};
use crate::import::{Fault, FilePosition, FileProblem, SphereList, spheres::SpheresBuilder};
use crate::message;

/// The spheres of a PLY file.
pub(in crate::import) fn read(bytes: &[u8]) -> Result<SphereList, Fault> {
    let (header, rest) = Header::split(bytes)?;
    let (numbers, material) = layout(&header).map_err(|problem| problem.at(FilePosition::Header))?;
    let mut rows = Rows::new(&header, rest);
    let mut builder = SpheresBuilder::default();
    for element in &header.elements {
        if element.name != "vertex" {
            rows.read(element, None, |_| Ok(()))?;
            continue;
        }
        rows.read(element, None, |row| {
            builder.sphere(numbers.map(|index| row.values[index]))?;
            if let Some(index) = material {
                let slot = builder.materials.slot(Some(&row.values[index].to_string()))?;
                builder.materials.push(slot);
            }
            Ok(())
        })?;
    }
    rows.finish()?;
    builder.finish()
}

/// The indices of a sphere's numbers, and of its material if it has one.
fn layout(header: &Header) -> Result<([usize; 4], Option<usize>), FileProblem> {
    let vertex = header.element("vertex", || message!("x, y, z and radius stand there"))?;
    let numbers = vertex.values(["x", "y", "z", "radius"])?;
    let Some(index) = vertex.property(&["material"]) else { return Ok((numbers, None)) };
    let property = &vertex.properties[index];
    if property.length.is_some() || !property.kind.is_integer() {
        let what = message!("property material of element vertex as a whole number");
        return Err(FileProblem::Missing { what, needed: message!("the number is the material's name") });
    }
    Ok((numbers, Some(index)))
}
