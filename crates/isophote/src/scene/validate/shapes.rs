//! Validates each shape by itself.

use crate::message;
use std::sync::Arc;

use super::names::{Kind, Names};
use super::numbers::vector_text;
use super::{Checked, Validator};
use crate::scene::Shape;
use crate::scene::document::Path;
use crate::scene::limits;
use crate::scene::source::{
    ConeSource, CuboidSource, CylinderSource, DiskSource, EllipsoidSource, PlaneSource, RectangleSource,
    RotationSource, SceneSource, ShadowSource, SphereSource,
};
use crate::shape::{Cone, Cuboid, Cylinder, Disk, Ellipsoid, Geometry, Plane, Rectangle, Rotation, Sphere};
use crate::vector::Vector;

/// The tables of shapes, in the order of a scene's shapes: first by kind, then as in the file.
pub(super) const KINDS: [&str; 10] =
    ["sphere", "ellipsoid", "box", "cylinder", "cone", "plane", "rectangle", "disk", "mesh", "spheres"];

/// A shape of any kind, as written.
pub(super) trait ShapeSource {
    /// Its name, the name of its material, and its shadow settings.
    fn head(&self) -> (Option<&str>, Option<&str>, ShadowSource);

    /// Whether its form comes from a file, which may name materials for its parts.
    fn is_from_file(&self) -> bool {
        false
    }

    /// Its form and place.
    fn geometry(&self, validator: &mut Validator<'_>, path: &Path) -> Option<Geometry>;
}

/// Implements [`ShapeSource::head`] from the fields that all shapes have.
macro_rules! shape_head {
    () => {
        fn head(&self) -> (Option<&str>, Option<&str>, ShadowSource) {
            (self.name.as_deref(), self.material.as_deref(), self.shadow)
        }
    };
}
pub(super) use shape_head;

/// All shapes as written, with their paths.
fn written(source: &SceneSource) -> impl Iterator<Item = (Path, &dyn ShapeSource)> {
    fn of_kind<'s, S: ShapeSource + 's>(
        kind: &'static str,
        shapes: &'s [S],
    ) -> impl Iterator<Item = (Path, &'s dyn ShapeSource)> {
        let table = Path::root().key(kind);
        shapes.iter().enumerate().map(move |(index, shape)| (table.index(index), shape as &dyn ShapeSource))
    }
    let [sphere, ellipsoid, cuboid, cylinder, cone, plane, rectangle, disk, mesh, spheres] = KINDS;
    of_kind(sphere, &source.sphere)
        .chain(of_kind(ellipsoid, &source.ellipsoid))
        .chain(of_kind(cuboid, &source.cuboid))
        .chain(of_kind(cylinder, &source.cylinder))
        .chain(of_kind(cone, &source.cone))
        .chain(of_kind(plane, &source.plane))
        .chain(of_kind(rectangle, &source.rectangle))
        .chain(of_kind(disk, &source.disk))
        .chain(of_kind(mesh, &source.mesh))
        .chain(of_kind(spheres, &source.spheres))
}

/// The names of the materials that shapes use, one for each shape that names one.
pub(super) fn materials_in_use(source: &SceneSource) -> impl Iterator<Item = &str> {
    written(source).filter_map(|(_, shape)| shape.head().1)
}

/// The number of shapes as written.
pub(super) fn count(source: &SceneSource) -> usize {
    written(source).count()
}

impl Validator<'_> {
    pub(super) fn shapes(&mut self, source: &SceneSource) -> Checked<Shape> {
        if let Some((path, _)) = written(source).nth(limits::SHAPES) {
            let message = message!("the scene has {count} shapes", count = count(source));
            self.wrong(&path, message, message!("allowed: at most {most}", most = limits::SHAPES));
            return Vec::new();
        }
        let mut names = Names::new(Kind::Shape);
        let known: Vec<&str> = source.material.keys().map(String::as_str).collect();
        let check = |(path, shape): (Path, &dyn ShapeSource)| {
            let (name, material, shadow) = shape.head();
            let name = names.check(self, &path, name);
            let geometry = shape.geometry(self, &path);
            // If all parts have materials of their own, no other is needed; for a faulty file it is unknown whether they
            // have.
            let has_own = geometry.as_ref().map_or(shape.is_from_file(), Geometry::has_own_materials);
            let material =
                if has_own && material.is_none() { Ok(None) } else { self.material_of(&path, material, &known) };
            Some(Shape::new(name?, material.ok()?, geometry?, shadow))
        };
        written(source).map(check).collect()
    }

    pub(super) fn rotation(&mut self, path: &Path, rotation: Option<RotationSource>) -> Option<Rotation> {
        let path = path.key("rotation");
        let Some(RotationSource { axis, degrees }) = rotation else {
            // It may have been written but not understood.
            return (!self.problems.has(&path)).then_some(Rotation::NONE);
        };
        let axis = self.required_direction(&path, "axis", axis);
        if degrees.is_none() {
            self.problems.missing(
                &path,
                "degrees",
                message!("write `degrees = …`: how far it is turned about the axis"),
            );
        }
        Some(Rotation::about(axis?, degrees?))
    }

    /// The two ends of something with a length in between.
    fn ends(&mut self, path: &Path, keys: [&'static str; 2], points: [Option<[f64; 3]>; 2]) -> Option<[Vector; 2]> {
        let first = self.required_point(path, keys[0], points[0]);
        let second = self.required_point(path, keys[1], points[1]);
        let (first, second) = (first?, second?);
        if (second - first).length() < limits::SMALLEST {
            let message =
                message!("`{path}.{second}` is where `{path}.{first}` is", path, second = keys[1], first = keys[0]);
            self.wrong(&path.key(keys[1]), message, message!("allowed: any other point"));
            return None;
        }
        Some([first, second])
    }

    /// A direction perpendicular to a shape, and one in its plane.
    fn facing(&mut self, path: &Path, rectangle: &RectangleSource) -> Option<[Vector; 2]> {
        let normal = self.required_direction(path, "normal", rectangle.normal);
        let up = self.direction(&path.key("up"), rectangle.up.unwrap_or([0.0, 1.0, 0.0]));
        let (normal, up) = (normal?, up?);
        if normal.normalized().cross(up.normalized()).length() < 1e-6 {
            let key = if rectangle.up.is_some() { "up" } else { "normal" };
            let message = message!(
                "`{path}.up` is parallel to the normal {direction}",
                path,
                direction = vector_text(normal.to_array())
            );
            self.wrong(
                &path.key(key),
                message,
                message!("write for `up` any other direction: the height runs along it"),
            );
            return None;
        }
        Some([normal, up])
    }
}

impl ShapeSource for SphereSource {
    shape_head!();

    fn geometry(&self, validator: &mut Validator<'_>, path: &Path) -> Option<Geometry> {
        let center = validator.required_point(path, "center", self.center);
        let radius = validator.required_size(path, "radius", self.radius);
        Some(Geometry::Sphere(Sphere { center: center?, radius: radius? }))
    }
}

impl ShapeSource for EllipsoidSource {
    shape_head!();

    fn geometry(&self, validator: &mut Validator<'_>, path: &Path) -> Option<Geometry> {
        let center = validator.required_point(path, "center", self.center);
        let radii = validator.required_sizes(path, "radii", self.radii);
        let rotation = validator.rotation(path, self.rotation);
        Some(Geometry::Ellipsoid(Arc::new(Ellipsoid::new(center?, radii?, rotation?))))
    }
}

impl ShapeSource for CuboidSource {
    shape_head!();

    fn geometry(&self, validator: &mut Validator<'_>, path: &Path) -> Option<Geometry> {
        let center = validator.required_point(path, "center", self.center);
        let size = validator.required_sizes(path, "size", self.size);
        let rotation = validator.rotation(path, self.rotation);
        Some(Geometry::Cuboid(Arc::new(Cuboid::new(center?, size?, rotation?))))
    }
}

impl ShapeSource for CylinderSource {
    shape_head!();

    fn geometry(&self, validator: &mut Validator<'_>, path: &Path) -> Option<Geometry> {
        let ends = validator.ends(path, ["from", "to"], [self.from, self.to]);
        let radius = validator.required_size(path, "radius", self.radius);
        let [from, to] = ends?;
        Some(Geometry::Cylinder(Arc::new(Cylinder::new(from, to, radius?))))
    }
}

impl ShapeSource for ConeSource {
    shape_head!();

    fn geometry(&self, validator: &mut Validator<'_>, path: &Path) -> Option<Geometry> {
        let ends = validator.ends(path, ["base", "apex"], [self.base, self.apex]);
        let radius = validator.required_size(path, "radius", self.radius);
        let apex_radius = match self.apex_radius {
            None | Some(0.0) => Some(0.0),
            Some(negative) if negative < 0.0 => {
                let message = message!("`{path}.apex_radius` is {negative}", path, negative);
                validator.wrong(&path.key("apex_radius"), message, message!("allowed: 0 for a pointed cone, or above"));
                None
            }
            written => validator.required_size(path, "apex_radius", written),
        };
        let [base, apex] = ends?;
        Some(Geometry::Cone(Arc::new(Cone::new(base, apex, [radius?, apex_radius?]))))
    }
}

impl ShapeSource for PlaneSource {
    shape_head!();

    fn geometry(&self, validator: &mut Validator<'_>, path: &Path) -> Option<Geometry> {
        let point = validator.required_point(path, "point", self.point);
        let normal = validator.required_direction(path, "normal", self.normal);
        Some(Geometry::Plane(Arc::new(Plane::new(point?, normal?))))
    }
}

impl ShapeSource for RectangleSource {
    shape_head!();

    fn geometry(&self, validator: &mut Validator<'_>, path: &Path) -> Option<Geometry> {
        let center = validator.required_point(path, "center", self.center);
        let facing = validator.facing(path, self);
        let width = validator.required_size(path, "width", self.width);
        let height = validator.required_size(path, "height", self.height);
        let [normal, up] = facing?;
        Some(Geometry::Rectangle(Arc::new(Rectangle::new(center?, [width?, height?], normal, up))))
    }
}

impl ShapeSource for DiskSource {
    shape_head!();

    fn geometry(&self, validator: &mut Validator<'_>, path: &Path) -> Option<Geometry> {
        let center = validator.required_point(path, "center", self.center);
        let normal = validator.required_direction(path, "normal", self.normal);
        let radius = validator.required_size(path, "radius", self.radius);
        Some(Geometry::Disk(Arc::new(Disk::new(center?, normal?, radius?))))
    }
}
