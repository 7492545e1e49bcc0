//! Validates each grid by itself.

use super::names::{Kind, Names};
use super::{Checked, Validator};
use crate::map::Resolution;
use crate::message;
use crate::scene::Grid;
use crate::scene::document::Path;
use crate::scene::limits;
use crate::scene::source::{GridSource, SceneSource};
use crate::vector::Vector;

/// The allowed deviation of a grid's edges from a right angle: the cosine between them.
const RIGHT_ANGLE: f64 = 1e-9;

impl Validator<'_> {
    pub(super) fn grids(&mut self, source: &SceneSource) -> Checked<Grid> {
        if !self.few_enough("grid", source.grid.len(), limits::GRIDS) {
            return Vec::new();
        }
        let mut names = Names::new(Kind::Grid);
        let check = |(index, grid): (usize, &GridSource)| {
            let path = Path::root().key("grid").index(index);
            let name = names.check(self, &path, grid.name.as_deref());
            let edges = self.grid_edges(&path, grid);
            let place = self.grid_place(&path, grid);
            let points = self.grid_points(&path, grid);
            let ([u, v], (place, is_corner)) = (edges?, place?);
            let corner = if is_corner { place } else { place - (u + v) * 0.5 };
            Some(Grid { name: name?, corner, u, v, points: points?, side: grid.side.unwrap_or_default() })
        };
        source.grid.iter().enumerate().map(check).collect()
    }

    fn grid_edges(&mut self, path: &Path, grid: &GridSource) -> Option<[Vector; 2]> {
        let u = self.grid_edge(path, "u", grid.u);
        let v = self.grid_edge(path, "v", grid.v);
        let (u, v) = (u?, v?);
        let cosine = u.normalized().dot(v.normalized());
        if cosine.abs() > RIGHT_ANGLE {
            let degrees = super::rounded(libm::acos(cosine.clamp(-1.0, 1.0)).to_degrees());
            let message =
                message!("`{path}.v` is not at right angles to `{path}.u`: {degrees}° are between them", path, degrees);
            self.wrong(&path.key("v"), message, message!("a grid is a rectangle; write edges with u · v = 0"));
            return None;
        }
        Some([u, v])
    }

    fn grid_edge(&mut self, path: &Path, key: &'static str, edge: Option<[f64; 3]>) -> Option<Vector> {
        let edge = self.required_point(path, key, edge)?;
        if edge.length() < limits::SMALLEST {
            let smallest = self.length.from_metres(limits::SMALLEST);
            let help = message!(
                "allowed: an edge of at least {smallest} {unit}",
                smallest = format!("{smallest:e}"),
                unit = self.unit()
            );
            self.wrong(&path.key(key), message!("`{path}.{key}` has no length", path, key), help);
            return None;
        }
        Some(edge)
    }

    /// The point that gives the grid's position, and whether it is the corner.
    fn grid_place(&mut self, path: &Path, grid: &GridSource) -> Option<(Vector, bool)> {
        match (grid.corner, grid.center) {
            (Some(corner), None) => Some((self.point(&path.key("corner"), corner)?, true)),
            (None, Some(center)) => Some((self.point(&path.key("center"), center)?, false)),
            (Some(_), Some(_)) => {
                let message = message!("`{path}` has both `corner` and `center`", path);
                self.wrong(&path.key("center"), message, message!("allowed: one of the two"));
                None
            }
            (None, None) => {
                let help =
                    message!("write `corner = [x, y, z]`, where both edges begin, or `center = [x, y, z]` instead");
                self.problems.missing(path, "corner", help);
                None
            }
        }
    }

    fn grid_points(&mut self, path: &Path, grid: &GridSource) -> Option<Resolution> {
        let Some([across, along]) = grid.points else {
            self.problems.missing(
                path,
                "points",
                message!("write `points = [n, m]`: how many along `u` and along `v`"),
            );
            return None;
        };
        let side = |count: u64| u32::try_from(count).ok().filter(|count| *count > 0);
        let points = side(across).zip(side(along)).map(|(width, height)| Resolution { width, height });
        let points = points.filter(|points| points.fits_memory());
        if points.is_none() {
            let (longest, most) = (Resolution::LONGEST_IN_MEMORY, Resolution::MOST_IN_MEMORY);
            let help = message!("allowed: 1 to {longest} each, together at most {most}", longest, most);
            self.wrong(
                &path.key("points"),
                message!("`{path}.points` is [{across}, {along}]", path, across, along),
                help,
            );
        }
        points
    }
}
