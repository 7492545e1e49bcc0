//! Shapes that appear narrower than a pixel, and their shadows: the centres of pixels may all pass them by.

use std::collections::BTreeMap;
use std::ops::Range;

use super::uncertain::{Finder, Uncertain};
use crate::camera::{Projection, ScreenPosition};
use crate::map::{Map, Pixel, Region};
use crate::prepare::{Hit, PreparedScene};
use crate::render::hits::HitBlock;
use crate::render::{Observer, RenderError, band};
use crate::shape::{CenterLine, Geometry};
use crate::threads::Threads;
use crate::vector::Vector;

/// Looks for narrow shapes along their center lines.
pub struct Narrow<'n> {
    scene: &'n PreparedScene,
    finders: &'n [Finder<'n>],
    tolerances: &'n [f64],
    /// The pixels to refine, in the full image.
    region: Region,
    /// The first pixel of the map.
    corner: Pixel,
    /// Whether a line in space is a line on the screen.
    is_straight: bool,
}

/// What is looked for along a line: a shape, or its shadow.
#[derive(Clone, Copy)]
struct Sought {
    shape: usize,
    /// The emitter that casts the shadow.
    emitter: Option<usize>,
}

/// A part of a center line.
#[derive(Clone, Copy)]
struct Part {
    line: CenterLine,
    /// Where its ends appear, in pixels.
    seen: [Option<[f64; 2]>; 2],
    /// How many times the line has been halved.
    depth: u32,
}

/// A disc with half this diameter, in pixels, contains the centre of a pixel wherever it is: √½, and some room.
const WIDE: f64 = 0.75;

/// The distance between places along a line, in pixels.
const STEP: f64 = 0.5;

/// A line that is not straight on the screen is nearly so after this many halvings.
const NEARLY_STRAIGHT: u32 = 3;

/// The line of a shadow breaks off where it changes from one surface to another: there it is halved no more than this.
const DEEPEST_SHADOW: u32 = 14;

/// A ray meets a shadow if it ends this close to it, as a fraction of the distance from what casts it.
const NEAR: f64 = 1e-3;

/// With more pairs of primitives and emitters than this, narrow shadows are not looked for.
const MOST_SHADOWS: usize = 1000;

/// A line that has been halved as often is shorter than anything that can be seen, or begins behind the eye.
const DEEPEST: u32 = 40;

/// The number of primitives that one thread looks for at a time.
const PRIMITIVES: usize = 4096;

impl<'n> Narrow<'n> {
    /// For a region of a map.
    pub fn new(
        scene: &'n PreparedScene,
        map: &Map,
        region: Region,
        finders: &'n [Finder<'n>],
        tolerances: &'n [f64],
    ) -> Self {
        let projection = &scene.scene().camera().projection;
        let is_straight = matches!(projection, Projection::Perspective(_) | Projection::Orthographic(_));
        Self { scene, finders, tolerances, region, corner: map.region.corner, is_straight }
    }

    /// The pixels that show a shape which no centre of them or their neighbours sees, in reading order, with how much its
    /// brightness differs from theirs.
    pub fn find(
        &self,
        asked_for: &[usize],
        threads: &Threads,
        observer: Option<&dyn Observer>,
    ) -> Result<Vec<Uncertain>, RenderError> {
        let count = self.scene.primitive_count() as usize;
        let parts: Vec<Range<usize>> =
            (0..count).step_by(PRIMITIVES).map(|first| first..(first + PRIMITIVES).min(count)).collect();
        let find = |numbers: Range<usize>| {
            let mut search =
                Search { narrow: self, hits: HitBlock::new(self.scene, asked_for), found: BTreeMap::new() };
            for number in numbers {
                band::advance(observer, 0)?;
                search.look_for(u32::try_from(number).unwrap_or(u32::MAX));
            }
            Ok(search.found)
        };
        let found: Vec<BTreeMap<usize, Uncertain>> = if parts.len() > 1 {
            threads.start()?;
            threads.map::<_, _, Result<_, RenderError>>(parts, find)?
        } else {
            parts.into_iter().map(find).collect::<Result<_, RenderError>>()?
        };
        let mut all = BTreeMap::new();
        for uncertain in found.into_iter().flat_map(BTreeMap::into_values) {
            merge(&mut all, uncertain);
        }
        Ok(all.into_values().collect())
    }

    /// Where a point appears, in pixels from the upper left corner of the image.
    fn place_of(&self, point: Vector) -> Option<[f64; 2]> {
        let frame = self.scene.frame();
        frame.project(point).map(|screen| frame.column_and_row(screen))
    }

    /// Where the shadow of a point falls, and how much larger it is than what casts it.
    fn shadow_of(&self, point: Vector, shape: usize, emitter: usize) -> Option<(Vector, f64)> {
        let source = &self.scene.emitters().all()[emitter];
        let to_light = source.from_place(point, Vector::default());
        let distance = to_light.length();
        let shadow = self.scene.first_beyond(shape, point, to_light * (-1.0 / distance))?;
        let growth = source.place().map_or(1.0, |_| 1.0 + (shadow - point).length() / distance);
        Some((shadow, growth))
    }

    /// Where what is sought is seen for a point of a line, and how much larger it is than there.
    fn seen_at(&self, point: Vector, sought: Sought) -> Option<(Vector, f64)> {
        match sought.emitter {
            None => Some((point, 1.0)),
            Some(emitter) => self.shadow_of(point, sought.shape, emitter),
        }
    }

    /// Where what is sought appears for a point of a line.
    fn place_at(&self, point: Vector, sought: Sought) -> Option<[f64; 2]> {
        self.place_of(self.seen_at(point, sought)?.0)
    }

    /// The emitters whose shadows are looked for.
    fn emitters_behind(&self, shape: usize) -> Range<usize> {
        let (scene, count) = (self.scene, self.scene.emitters().all().len());
        let is_mesh = matches!(scene.geometry(shape), Geometry::Mesh(_));
        let casts = scene.scene().shadows() && scene.scene().shapes()[shape].casts_shadow && !is_mesh;
        let is_affordable = scene.primitive_count() as usize * count <= MOST_SHADOWS;
        if casts && is_affordable { 0..count } else { 0..0 }
    }

    /// The half width of something at a point, in pixels.
    fn half_width(&self, point: Vector, radius: f64) -> f64 {
        let frame = self.scene.frame();
        let Some([column, row]) = self.place_of(point) else { return f64::INFINITY };
        let beside = [frame.right, frame.up, frame.forward].map(|axis| {
            self.place_of(point + axis * radius).map_or(f64::INFINITY, |[x, y]| (x - column).hypot(y - row))
        });
        beside.into_iter().fold(0.0, f64::max)
    }

    /// Whether two places, and all between them, are beside the region.
    fn is_outside(&self, [one, other]: [[f64; 2]; 2]) -> bool {
        let Region { corner, size } = self.region;
        let beside = |axis: usize, first: u32, count: u32| {
            let (first, last) = (f64::from(first) - 1.0, f64::from(first) + f64::from(count) + 1.0);
            one[axis].max(other[axis]) < first || one[axis].min(other[axis]) > last
        };
        beside(0, corner.column, size.width) || beside(1, corner.row, size.height)
    }

    /// The pixels of the region that something at a place may reach into, as rows and columns of the map.
    fn reached(&self, [column, row]: [f64; 2], reach: f64) -> impl Iterator<Item = (usize, usize)> {
        let Region { corner, size } = self.region;
        let range = |place: f64, first: u32, count: u32, from: u32| {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "what is too large saturates")]
            let [start, end] = [place - reach, place + reach + 1.0].map(|place| place.floor().max(0.0) as u32);
            (start.max(first)..end.min(first + count)).map(move |at| (at, (at - from) as usize))
        };
        let columns = range(column, corner.column, size.width, self.corner.column);
        let rows = range(row, corner.row, size.height, self.corner.row);
        let apart = |place: f64, at: u32| (f64::from(at) - place).max(place - f64::from(at) - 1.0).max(0.0);
        rows.flat_map(move |(down, in_rows)| {
            let is_near = move |across: u32| apart(column, across).hypot(apart(row, down)) <= reach;
            let near = columns.clone().filter(move |(across, _)| is_near(*across));
            near.map(move |(_, in_columns)| (in_rows, in_columns))
        })
    }
}

/// Adds a pixel to those that were found.
pub fn merge(all: &mut BTreeMap<usize, Uncertain>, uncertain: Uncertain) {
    match all.get_mut(&uncertain.index) {
        Some(known) => {
            for (known, contrast) in known.contrasts.iter_mut().zip(uncertain.contrasts) {
                *known = known.max(contrast);
            }
        }
        None => drop(all.insert(uncertain.index, uncertain)),
    }
}

/// The search of a thread.
struct Search<'n, 's> {
    narrow: &'n Narrow<'n>,
    hits: HitBlock<'s>,
    found: BTreeMap<usize, Uncertain>,
}

impl Search<'_, '_> {
    fn look_for(&mut self, number: u32) {
        let scene = self.narrow.scene;
        let primitive = scene.primitive(number);
        for line in scene.geometry(primitive.shape).center_lines(primitive.part) {
            let shadows = self.narrow.emitters_behind(primitive.shape).map(Some);
            for emitter in [None].into_iter().chain(shadows) {
                let sought = Sought { shape: primitive.shape, emitter };
                let seen = line.ends.map(|end| self.narrow.place_at(end, sought));
                self.follow(Part { line, seen, depth: 0 }, sought);
            }
        }
    }

    /// Halves a line until its parts are no longer than a step. Where it is halved does not depend on the region.
    fn follow(&mut self, part: Part, sought: Sought) {
        let Part { line: CenterLine { ends, radii }, seen, depth } = part;
        let is_shadow = sought.emitter.is_some();
        let is_straight = self.narrow.is_straight && !is_shadow || depth >= NEARLY_STRAIGHT;
        let (middle, radius) = ((ends[0] + ends[1]) * 0.5, 0.5 * (radii[0] + radii[1]));
        match seen {
            [Some(one), Some(other)] => {
                if is_straight && self.narrow.is_outside([one, other]) {
                    return;
                }
                if (one[0] - other[0]).abs().max((one[1] - other[1]).abs()) <= STEP {
                    self.look_at(middle, radius, sought);
                    return;
                }
            }
            [None, None] if is_straight => return,
            _ => {}
        }
        if depth == if is_shadow { DEEPEST_SHADOW } else { DEEPEST } {
            return;
        }
        let (between, depth) = (self.narrow.place_at(middle, sought), depth + 1);
        let first = CenterLine { ends: [ends[0], middle], radii: [radii[0], radius] };
        let last = CenterLine { ends: [middle, ends[1]], radii: [radius, radii[1]] };
        self.follow(Part { line: first, seen: [seen[0], between], depth }, sought);
        self.follow(Part { line: last, seen: [between, seen[1]], depth }, sought);
    }

    /// Marks the pixels around what is sought for a point of a line, if it is narrow and visible there.
    fn look_at(&mut self, point: Vector, radius: f64, sought: Sought) {
        let narrow = self.narrow;
        let Some((seen, growth)) = narrow.seen_at(point, sought) else { return };
        let Some(screen) = narrow.scene.frame().project(seen) else { return };
        let place = narrow.scene.frame().column_and_row(screen);
        let half_width = if radius > 0.0 { narrow.half_width(seen, growth * radius) } else { 0.0 };
        if half_width >= WIDE {
            return;
        }
        let first = &narrow.finders[0];
        // Beside the silhouette of a narrow shape a centre may see it, but in another light than most of it.
        let is_missed = |(row, column): &(usize, usize)| {
            radius > 0.0
                || match sought.emitter {
                    None => !first.is_seen_nearby(*row, *column, sought.shape),
                    // The edges of a wide shadow are uncertain anyway.
                    Some(_) => !first.is_uncertain(*row, *column),
                }
        };
        let mut missed = narrow.reached(place, half_width + 0.5 * STEP).filter(is_missed).peekable();
        if missed.peek().is_none() {
            return;
        }
        let position = ScreenPosition::Point { x: screen[0], y: screen[1] };
        let is_it = |hit: &Hit| match sought.emitter {
            None => hit.primitive.shape == sought.shape,
            Some(_) => (hit.point.position() - seen).length() <= NEAR * (seen - point).length(),
        };
        let Some(hit) = self.hits.trace(position).filter(is_it) else { return };
        self.mark(&hit, position, missed);
    }

    /// Marks pixels, as rows and columns of the map, whose centres are not as bright as what a ray has hit.
    fn mark(&mut self, hit: &Hit, position: ScreenPosition, missed: impl Iterator<Item = (usize, usize)>) {
        let narrow = self.narrow;
        self.hits.clear();
        self.hits.push(0, hit, Some(position));
        for (row, column) in missed {
            let contrast = |(layer, finder): (usize, &Finder<'_>)| {
                (self.hits.shaded(layer).brightness[0] - finder.value(row, column)).abs()
            };
            let contrasts: Vec<f64> = narrow.finders.iter().enumerate().map(contrast).collect();
            if contrasts.iter().zip(narrow.tolerances).any(|(contrast, tolerance)| contrast > tolerance) {
                merge(&mut self.found, narrow.finders[0].uncertain_by(row, column, contrasts));
            }
        }
    }
}
