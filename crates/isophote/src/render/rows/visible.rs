//! What the pixels of a row see, from the outlines of the shapes: rays are traced only for pixels in doubt.

use std::ops::Range;

use crate::outline::{Ellipse, Outline, RowOfEllipse};
use crate::prepare::{ERROR_OF_DISTANCE, PreparedScene};
use crate::shape::{Geometry, Primitive, Sphere};

/// Columns of a row that see the same shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stretch {
    /// The first column.
    pub start: u32,
    /// The column after the last.
    pub end: u32,
    /// The shape.
    pub shape: usize,
}

/// The view of one row; its memory is reused for the next.
#[derive(Default)]
pub struct RowView {
    /// From left to right; columns in doubt belong to none.
    pub stretches: Vec<Stretch>,
    /// The columns that are too close to call in double precision, from left to right.
    pub doubtful: Vec<u32>,
    spans: Vec<Span>,
    edges: Vec<u32>,
}

/// The columns that a shape covers, whatever is in front of it.
#[derive(Clone, Copy)]
struct Span {
    start: u32,
    end: u32,
    shape: usize,
    /// Bounds of the distance from the eye, in metres.
    near: f64,
    far: f64,
}

/// A shape that may be visible, with its outline.
#[derive(Clone)]
pub struct Candidate<'s> {
    /// The shape.
    pub shape: usize,
    /// Its outline.
    pub ellipse: &'s Ellipse,
    /// The rows in which it can be visible.
    pub rows: Range<u32>,
    /// The shape's geometry.
    pub sphere: Sphere,
    doubtful: &'s Range<f64>,
}

impl<'s> Candidate<'s> {
    /// The shapes that may be visible in these rows; `None` if the outline of one is unknown, or if one may shadow another.
    pub fn all(scene: &'s PreparedScene, rows: Range<u32>) -> Option<Vec<Self>> {
        let mut candidates = Vec::new();
        if scene.casts_shadows_between_shapes() {
            return None;
        }
        for (shape, description) in scene.scene().shapes().iter().enumerate() {
            let Geometry::Sphere(sphere) = &description.geometry else { return None };
            match scene.outline(shape) {
                Outline::Unseen => {}
                Outline::Unknown => return None,
                Outline::Ellipse(ellipse) => {
                    // With one extra row on either side, for pixels in doubt.
                    let bound = |row: f64| whole(row.clamp(rows.start.into(), rows.end.into()));
                    let [first, last] = ellipse.rows.map(|row| row + ellipse.row);
                    let rows = bound(first - 1.0)..bound(last + 3.0);
                    if !rows.is_empty() {
                        let doubtful = scene.doubtful_in_outline(Primitive { shape, part: 0 });
                        candidates.push(Self { shape, ellipse, rows, sphere: *sphere, doubtful });
                    }
                }
            }
        }
        Some(candidates)
    }

    /// The primitive that rays hit.
    pub fn primitive(&self) -> Primitive {
        Primitive { shape: self.shape, part: 0 }
    }

    /// The columns of a row that the shape covers, and those in doubt.
    #[inline(always)]
    fn span(&self, row: u32, columns: &Range<u32>, doubtful: &mut Vec<u32>) -> Option<Span> {
        let in_row = self.ellipse.in_row(row);
        let [first, last] = in_row.roots.map(|root| root + self.ellipse.column);
        // Whole columns strictly between the roots.
        let start = (first.floor() + 1.0).max(columns.start.into());
        let end = last.ceil().min(columns.end.into());
        self.doubt(&in_row, columns, [first, last], doubtful);
        if start >= end {
            return None;
        }
        let center = in_row.center.length();
        let near = (center - 1.0) * self.sphere.radius;
        let far = ((center - 1.0) * (center + 1.0)).sqrt() * self.sphere.radius;
        Some(Span { start: whole(start), end: whole(end), shape: self.shape, near, far })
    }

    /// Columns whose clearance leaves in doubt whether they hit, or what they see: searched inwards and outwards from both
    /// roots.
    #[inline(always)]
    fn doubt(&self, row: &RowOfEllipse, columns: &Range<u32>, roots: [f64; 2], doubtful: &mut Vec<u32>) {
        let is_doubtful = |column: f64| self.doubtful.contains(&row.clearance_at(column - self.ellipse.column));
        let [first, last] = [f64::from(columns.start), f64::from(columns.end) - 1.0];
        let mut walk = |from: f64, step: f64| {
            let mut column = if step > 0.0 { from.max(first) } else { from.min(last) };
            while column >= first && column <= last && is_doubtful(column) {
                doubtful.push(whole(column));
                column += step;
            }
        };
        walk(roots[0].floor() + 1.0, 1.0);
        walk(roots[0].floor(), -1.0);
        walk(roots[1].ceil() - 1.0, -1.0);
        walk(roots[1].ceil(), 1.0);
    }
}

/// A column, clamped to the image.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it was held within the columns")]
fn whole(column: f64) -> u32 {
    column as u32
}

impl RowView {
    /// Finds what some columns of a row see.
    #[inline(always)]
    pub fn look(&mut self, candidates: &[Candidate<'_>], row: u32, columns: &Range<u32>) {
        self.stretches.clear();
        self.spans.clear();
        self.doubtful.clear();
        for candidate in candidates.iter().filter(|candidate| candidate.rows.contains(&row)) {
            self.spans.extend(candidate.span(row, columns, &mut self.doubtful));
        }
        match self.spans.as_slice() {
            [] => {}
            [span] => self.stretches.push(Stretch { start: span.start, end: span.end, shape: span.shape }),
            _ => self.sweep(candidates, row),
        }
        if !self.doubtful.is_empty() {
            self.take_out_doubtful();
        }
    }

    /// Sweeps the edges of the spans from left to right; between two edges the same shapes compete.
    #[inline(never)]
    fn sweep(&mut self, candidates: &[Candidate<'_>], row: u32) {
        self.spans.sort_by_key(|span| span.start);
        self.edges.clear();
        self.edges.extend(self.spans.iter().flat_map(|span| [span.start, span.end]));
        self.edges.sort_unstable();
        self.edges.dedup();
        let mut active: Vec<Span> = Vec::new();
        let mut next = 0;
        for pair in self.edges.windows(2) {
            let [start, end] = [pair[0], pair[1]];
            active.retain(|span| span.end > start);
            while self.spans.get(next).is_some_and(|span| span.start == start) {
                active.push(self.spans[next]);
                next += 1;
            }
            let nearest_far = active.iter().map(|span| span.far).fold(f64::INFINITY, f64::min);
            let mut front = active.iter().filter(|span| span.near <= nearest_far);
            match (front.next(), front.next()) {
                (Some(span), None) => push(&mut self.stretches, Stretch { start, end, shape: span.shape }),
                (None, _) => {}
                (Some(_), Some(_)) => {
                    let front: Vec<&Candidate<'_>> = active
                        .iter()
                        .filter(|span| span.near <= nearest_far)
                        .filter_map(|span| {
                            let index = candidates.binary_search_by_key(&span.shape, |candidate| candidate.shape);
                            index.ok().map(|index| &candidates[index])
                        })
                        .collect();
                    for column in start..end {
                        let shape = nearest(&front, row, column, &mut self.doubtful);
                        push(&mut self.stretches, Stretch { start: column, end: column + 1, shape });
                    }
                }
            }
        }
    }

    /// Removes the columns in doubt from the stretches.
    #[inline(never)]
    fn take_out_doubtful(&mut self) {
        self.doubtful.sort_unstable();
        self.doubtful.dedup();
        let mut rest = Vec::with_capacity(self.stretches.len() + 1);
        let mut doubtful = self.doubtful.iter().peekable();
        for stretch in &self.stretches {
            let mut start = stretch.start;
            while let Some(&&column) = doubtful.peek().filter(|column| ***column < stretch.end) {
                if column > start {
                    rest.push(Stretch { start, end: column, ..*stretch });
                }
                start = start.max(column + 1);
                doubtful.next();
            }
            if start < stretch.end {
                rest.push(Stretch { start, ..*stretch });
            }
        }
        self.stretches = rest;
    }
}

/// The nearest of several shapes at a pixel that all of them cover. If two are too close to be told apart, the column is in
/// doubt.
fn nearest(front: &[&Candidate<'_>], row: u32, column: u32, doubtful: &mut Vec<u32>) -> usize {
    let (mut best, mut second) = ((f64::INFINITY, usize::MAX), f64::INFINITY);
    for candidate in front {
        let distance = candidate.ellipse.distance_at(row, column.into()) * candidate.sphere.radius;
        if distance < best.0 {
            second = best.0;
            best = (distance, candidate.shape);
        } else {
            second = second.min(distance);
        }
    }
    // The error of half the chord is a fraction of the radius, whatever the distance.
    let radius = front.iter().map(|candidate| candidate.sphere.radius).fold(0.0, f64::max);
    if second - best.0 < ERROR_OF_DISTANCE * (best.0 + radius) {
        doubtful.push(column);
    }
    best.1
}

fn push(stretches: &mut Vec<Stretch>, stretch: Stretch) {
    match stretches.last_mut() {
        Some(last) if last.end == stretch.start && last.shape == stretch.shape => last.end = stretch.end,
        _ => stretches.push(stretch),
    }
}
