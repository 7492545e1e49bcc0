//! Shapes that are read from files of their own.

use super::shapes::read_rotation;
use super::{Table, read_shadow};
use crate::scene::source::{MeshSource, SpheresSource};

pub(super) fn read_mesh(table: &mut Table<'_>) -> MeshSource {
    MeshSource {
        name: table.text("name"),
        file: table.text("file"),
        scale: table.numbers("scale"),
        rotation: table.table("rotation", read_rotation),
        position: table.numbers("position"),
        smooth: table.boolean("smooth"),
        material: table.text("material"),
        shadow: read_shadow(table),
    }
}

pub(super) fn read_spheres(table: &mut Table<'_>) -> SpheresSource {
    SpheresSource {
        name: table.text("name"),
        file: table.text("file"),
        material: table.text("material"),
        shadow: read_shadow(table),
    }
}
