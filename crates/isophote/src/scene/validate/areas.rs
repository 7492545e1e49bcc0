//! Validates areas of interest.

use super::names::{Kind, Names};
use super::numbers::vector_text;
use super::{Checked, Validator};
use crate::camera::Camera;
use crate::message;
use crate::scene::document::Path;
use crate::scene::limits;
use crate::scene::problems::{closest, short, suggestion};
use crate::scene::source::{AreaSource, SceneSource};
use crate::scene::{Area, AreaOutline, AreaPlace, Shape};
use crate::shape::{Geometry, Measure};
use crate::units::ScreenUnit;
use crate::vector::Vector;

/// Places on the outline of a circle at which it has to be on its surface.
const OUTLINE: u32 = 360;

impl Validator<'_> {
    pub(super) fn areas(
        &mut self,
        source: &SceneSource,
        camera: Option<&Camera>,
        shapes: &Checked<Shape>,
    ) -> Checked<Area> {
        if !self.few_enough("area", source.area.len(), limits::AREAS) {
            return Vec::new();
        }
        let mut names = Names::new(Kind::Area);
        let check = |(index, area): (usize, &AreaSource)| {
            let path = Path::root().key("area").index(index);
            let name = names.check(self, &path, area.name.as_deref());
            let is_angular = camera.is_some_and(|camera| camera.projection.is_angular());
            let unit = ScreenUnit::of(self.length, is_angular && area.on.is_none());
            let outline = self.area_outline(&path, area, unit);
            let place = match &area.on {
                Some(on) => self.area_on_surface(&path, area, on, shapes, outline),
                None => self.area_on_screen(&path, area, unit),
            };
            Some(Area { name: name?, place: place?, outline: outline? })
        };
        source.area.iter().enumerate().map(check).collect()
    }

    fn area_outline(&mut self, path: &Path, area: &AreaSource, unit: ScreenUnit) -> Option<AreaOutline> {
        let mut length = |path: &Path, written: f64| {
            let inside = unit.to_internal(written);
            let is_allowed = (limits::SMALLEST..=limits::COORDINATE).contains(&inside);
            if !is_allowed {
                let help = message!("allowed: above 0, in {unit}", unit = unit.name());
                self.wrong(path, message!("`{path}` is {value}", path, value = written), help);
            }
            is_allowed.then_some(inside)
        };
        match (area.radius, area.size) {
            (Some(radius), None) => Some(AreaOutline::Circle { radius: length(&path.key("radius"), radius)? }),
            (None, Some([width, height])) => {
                let size = path.key("size");
                let [width, height] = [length(&size.index(0), width), length(&size.index(1), height)];
                Some(AreaOutline::Rectangle { half: [0.5 * width?, 0.5 * height?] })
            }
            (Some(_), Some(_)) => {
                let message = message!("`{path}` has both `radius` and `size`", path);
                self.wrong(
                    &path.key("size"),
                    message,
                    message!("allowed: `radius` for a circle, or `size` for a rectangle"),
                );
                None
            }
            (None, None) => {
                let help = message!("write `radius = …` for a circle, or `size = [width, height]` for a rectangle");
                self.problems.missing(path, "radius", help);
                None
            }
        }
    }

    fn area_on_screen(&mut self, path: &Path, area: &AreaSource, unit: ScreenUnit) -> Option<AreaPlace> {
        for (key, is_written) in [("center", area.center.is_some()), ("up", area.up.is_some())] {
            if is_written {
                let message = message!("`{path}.{key}` means nothing for an area on the screen", path, key);
                self.wrong(
                    &path.key(key),
                    message,
                    message!("leave it out, or write `on = …` with the name of a plane, rectangle or disk"),
                );
            }
        }
        let Some(at) = area.at else {
            let help = message!(
                "write `at = [x, y]`, its centre on the screen, or `on = …`, the surface that it is on, and `center`"
            );
            self.problems.missing(path, "at", help);
            return None;
        };
        let at = at.map(|coordinate| unit.to_internal(coordinate));
        if at.iter().any(|coordinate| coordinate.abs() > limits::COORDINATE) {
            self.too_far(&path.key("at"));
            return None;
        }
        Some(AreaPlace::Screen(at))
    }

    fn area_on_surface(
        &mut self,
        path: &Path,
        area: &AreaSource,
        on: &str,
        shapes: &Checked<Shape>,
        outline: Option<AreaOutline>,
    ) -> Option<AreaPlace> {
        if area.at.is_some() {
            let message = message!("`{path}` is on \"{on}\", where `at` means nothing", path, on = short(on));
            self.wrong(
                &path.key("at"),
                message,
                message!("write `center = [x, y, z]`, or leave out `on` for an area on the screen"),
            );
        }
        let center = self.required_point(path, "center", area.center);
        let up = self.direction(&path.key("up"), area.up.unwrap_or([0.0, 1.0, 0.0]));
        // If a shape is wrong, its name may be that of the area.
        if shapes.iter().any(Option::is_none) {
            return None;
        }
        let Some((index, shape)) = shapes.iter().flatten().enumerate().find(|(_, shape)| shape.name == on) else {
            let names: Vec<&str> = shapes.iter().flatten().map(|shape| shape.name.as_str()).take(20).collect();
            let help = match names.as_slice() {
                [] => message!("the scene has no shapes"),
                _ => message!(
                    "allowed: {names}{meant}",
                    names = names.join(", "),
                    meant = suggestion(closest(on, &names))
                ),
            };
            self.wrong(&path.key("on"), message!("there is no shape \"{on}\"", on = short(on)), help);
            return None;
        };
        let is_flat = matches!(shape.geometry, Geometry::Plane(_) | Geometry::Rectangle(_) | Geometry::Disk(_));
        let normal = shape.geometry.measures().into_iter().find_map(|(name, measure)| match measure {
            Measure::Vector(normal) if is_flat && name == "normal" => Some(normal.normalized()),
            _ => None,
        });
        let Some(normal) = normal else {
            let message =
                message!("`{path}` is on \"{on}\", a {kind}", path, on = short(on), kind = shape.geometry.kind());
            self.wrong(&path.key("on"), message, message!("allowed: the name of a plane, a rectangle or a disk"));
            return None;
        };
        let (center, up) = (center?, up?.normalized());
        let height = up - normal * normal.dot(up);
        if height.length() < 1e-6 {
            let (normal, on) = (vector_text(normal.to_array()), short(on));
            let message = if area.up.is_some() {
                message!("`{path}.up` is along the normal {normal} of \"{on}\"", path, normal, on)
            } else {
                message!("`{path}.up` is (by default) along the normal {normal} of \"{on}\"", path, normal, on)
            };
            self.wrong(
                &path.key("up"),
                message,
                message!("write `up = [x, y, z]`, any other direction: that of the area's height"),
            );
            return None;
        }
        let height = height.normalized();
        let place = AreaPlace::Surface { shape: index, center, axes: [height.cross(normal), height] };
        let distance = |point: Vector| shape.geometry.signed_distance(point).abs();
        let is_off = |point: Vector| distance(point) > shape.geometry.surface_tolerance(point);
        if is_off(center) {
            let away = self.length_text(distance(center));
            let message = message!("`{path}.center` is not on \"{on}\": it is {away} away", path, on = short(on), away);
            self.wrong(&path.key("center"), message, message!("allowed: a point of the surface"));
            return None;
        }
        let outline = outline?;
        let edge: Vec<[f64; 2]> = match outline {
            AreaOutline::Circle { .. } => {
                let turn = |step: u32| f64::from(step) / f64::from(OUTLINE) * std::f64::consts::TAU;
                (0..OUTLINE).map(|step| [libm::cos(turn(step)), libm::sin(turn(step))]).collect()
            }
            AreaOutline::Rectangle { .. } => vec![[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]],
        };
        if edge.into_iter().filter_map(|place_within| place.point(outline.offset(place_within))).any(is_off) {
            let message = message!("`{path}` reaches beyond the edge of \"{on}\"", path, on = short(on));
            self.wrong(&path.key("center"), message, message!("allowed: an area that is wholly on the surface"));
            return None;
        }
        Some(place)
    }
}
