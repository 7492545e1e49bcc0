//! The shapes other than spheres.

use super::{Table, read_shadow};
use crate::scene::source::{
    ConeSource, CuboidSource, CylinderSource, DiskSource, EllipsoidSource, PlaneSource, RectangleSource, RotationSource,
};

pub(super) fn read_ellipsoid(table: &mut Table<'_>) -> EllipsoidSource {
    EllipsoidSource {
        name: table.text("name"),
        center: table.numbers("center"),
        radii: table.numbers("radii"),
        rotation: table.table("rotation", read_rotation),
        material: table.text("material"),
        shadow: read_shadow(table),
    }
}

pub(super) fn read_cuboid(table: &mut Table<'_>) -> CuboidSource {
    CuboidSource {
        name: table.text("name"),
        center: table.numbers("center"),
        size: table.numbers("size"),
        rotation: table.table("rotation", read_rotation),
        material: table.text("material"),
        shadow: read_shadow(table),
    }
}

pub(super) fn read_cylinder(table: &mut Table<'_>) -> CylinderSource {
    CylinderSource {
        name: table.text("name"),
        from: table.numbers("from"),
        to: table.numbers("to"),
        radius: table.number("radius"),
        material: table.text("material"),
        shadow: read_shadow(table),
    }
}

pub(super) fn read_cone(table: &mut Table<'_>) -> ConeSource {
    ConeSource {
        name: table.text("name"),
        base: table.numbers("base"),
        apex: table.numbers("apex"),
        radius: table.number("radius"),
        apex_radius: table.number("apex_radius"),
        material: table.text("material"),
        shadow: read_shadow(table),
    }
}

pub(super) fn read_plane(table: &mut Table<'_>) -> PlaneSource {
    PlaneSource {
        name: table.text("name"),
        point: table.numbers("point"),
        normal: table.numbers("normal"),
        material: table.text("material"),
        shadow: read_shadow(table),
    }
}

pub(super) fn read_rectangle(table: &mut Table<'_>) -> RectangleSource {
    RectangleSource {
        name: table.text("name"),
        center: table.numbers("center"),
        normal: table.numbers("normal"),
        up: table.numbers("up"),
        width: table.number("width"),
        height: table.number("height"),
        material: table.text("material"),
        shadow: read_shadow(table),
    }
}

pub(super) fn read_disk(table: &mut Table<'_>) -> DiskSource {
    DiskSource {
        name: table.text("name"),
        center: table.numbers("center"),
        normal: table.numbers("normal"),
        radius: table.number("radius"),
        material: table.text("material"),
        shadow: read_shadow(table),
    }
}

pub(super) fn read_rotation(table: &mut Table<'_>) -> RotationSource {
    RotationSource { axis: table.numbers("axis"), degrees: table.number("degrees") }
}
