//! Isophotes: contours of equal value of a map's scalar channel, by marching squares that respect the silhouette.

mod contour_grid;

use std::collections::{HashMap, HashSet};

use self::contour_grid::ContourGrid;
pub use crate::analysis::levels::nice_levels;
use crate::map::{Map, Quantity, Scalars};
use crate::message;
use crate::render::Observer;
use crate::text::Message;

/// The contour of one level.
#[derive(Clone, Debug, PartialEq)]
pub struct Isophote {
    /// The value along the contour, in the channel's unit.
    pub level: f64,
    /// Its pieces; empty if the level is not reached.
    pub lines: Vec<Polyline>,
}

/// A connected piece of a contour. Higher values lie to the left when following the points.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyline {
    /// At least two points; successive points are never equal.
    pub points: Vec<ScreenPoint>,
    /// Whether the last point is connected to the first one (which is not repeated).
    pub closed: bool,
}

/// A point on the screen, in the unit of the map's window: x to the right, y up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScreenPoint {
    /// To the right.
    pub x: f64,
    /// Up.
    pub y: f64,
}

/// Why no isophotes could be drawn.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}", self.message())]
pub enum IsophoteError {
    /// The map was rendered without this channel.
    Missing {
        /// The requested channel.
        name: String,
        /// The channels of the map, joined by commas.
        held: String,
    },
    /// Vectors and indices have no contours.
    NotScalar {
        /// The requested channel.
        name: String,
    },
    /// A level is infinite or not a number.
    LevelNotFinite {
        /// Its index in the list, from 0.
        index: usize,
        /// Its value.
        level: f64,
    },
    /// The observer asked to stop.
    Interrupted,
}

impl IsophoteError {
    /// What is wrong, in either language.
    #[must_use]
    pub fn message(&self) -> Message {
        match self {
            Self::Missing { name, held } => {
                message!("the map holds no channel `{name}`; it holds {held}", name, held)
            }
            Self::NotScalar { name } => {
                message!("the channel `{name}` holds no single number a pixel, so it has no contours", name)
            }
            Self::LevelNotFinite { index, level } => {
                message!("level {index} is {level}: a contour needs a finite level", index, level)
            }
            Self::Interrupted => message!("interrupted"),
        }
    }
}

/// The contours of a scalar channel, one [`Isophote`] for each level and in the order of the levels.
///
/// The channel is sampled at pixel centres and interpolated linearly along the edges between neighbouring centres, so a
/// contour is off by O(h²) for pixels of size h. A cell between four centres takes part only if all four show the same
/// shape: no contour runs along a silhouette, and contours end up to one pixel short of it and half a pixel short of the
/// window's edge. In a cell with a saddle, the value at the saddle point of the bilinear interpolant decides (G. Nielson and
/// B. Hamann, "The asymptotic decider", Visualization 1991). A value equal to the level counts as above.
///
/// # Errors
/// [`IsophoteError`]: the channel is missing or not scalar, or a level is not finite.
pub fn isophotes(map: &Map, quantity: &Quantity, levels: &[f64]) -> Result<Vec<Isophote>, IsophoteError> {
    isophotes_observed(map, quantity, levels, None)
}

/// As [`isophotes`], with an observer, which hears of levels and may end the work.
///
/// # Errors
/// Those of [`isophotes`], or the observer's wish to end.
pub fn isophotes_observed(
    map: &Map,
    quantity: &Quantity,
    levels: &[f64],
    observer: Option<&dyn Observer>,
) -> Result<Vec<Isophote>, IsophoteError> {
    if let Some((index, &level)) = levels.iter().enumerate().find(|(_, level)| !level.is_finite()) {
        return Err(IsophoteError::LevelNotFinite { index, level });
    }
    let grid = ContourGrid::new(map, scalar(map, quantity)?);
    let contour = |&level: &f64| {
        if observer.is_some_and(|observer| observer.advance(1).is_break()) {
            return Err(IsophoteError::Interrupted);
        }
        Ok(Isophote { level, lines: lines(&grid, level) })
    };
    levels.iter().map(contour).collect()
}

fn scalar<'map>(map: &'map Map, quantity: &Quantity) -> Result<Scalars<'map>, IsophoteError> {
    let name = quantity.name();
    if map.channel(quantity).is_none() {
        let held: Vec<String> = map.channels().iter().map(|channel| channel.quantity.name()).collect();
        return Err(IsophoteError::Missing { name, held: held.join(", ") });
    }
    map.scalar(quantity).ok_or(IsophoteError::NotScalar { name })
}

/// Joins the segments of all cells. Since each segment has the higher values on its left, a crossing starts at most one
/// segment and ends at most one, so the path along the segments is never ambiguous.
fn lines(grid: &ContourGrid, level: f64) -> Vec<Polyline> {
    let segments = grid.segments(level);
    let mut next: HashMap<usize, usize> = segments.iter().map(|segment| (segment.start, segment.end)).collect();
    let ends: HashSet<usize> = segments.iter().map(|segment| segment.end).collect();
    // Open lines first: starting in the middle of one would cut it in two.
    let open_starts = segments.iter().filter(|segment| !ends.contains(&segment.start));
    let mut lines = Vec::new();
    for first in open_starts.chain(&segments).map(|segment| segment.start) {
        if let Some(second) = next.remove(&first) {
            lines.extend(walk(grid, level, first, second, &mut next));
        }
    }
    lines
}

/// Follows the segments from one crossing until they end or return to it; `None` if the line is a single point (a peak that
/// equals the level).
fn walk(
    grid: &ContourGrid,
    level: f64,
    first: usize,
    second: usize,
    next: &mut HashMap<usize, usize>,
) -> Option<Polyline> {
    let mut points = vec![grid.crossing(first, level)];
    let mut edge = second;
    let closed = loop {
        if edge == first {
            break true;
        }
        points.push(grid.crossing(edge, level));
        match next.remove(&edge) {
            Some(following) => edge = following,
            None => break false,
        }
    };
    // Crossings of neighbouring edges coincide where a pixel equals the level.
    points.dedup();
    if closed && points.first() == points.last() {
        points.pop();
    }
    let smallest = if closed { 3 } else { 2 };
    (points.len() >= smallest).then_some(Polyline { points, closed })
}

#[cfg(test)]
mod tests;
