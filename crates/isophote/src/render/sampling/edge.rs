//! The edge between two parts of a pixel: first a line that separates the samples on both sides, then where the edge really is.
//! So the areas of the parts are known far better than from how many samples fall into each.

/// A place in a pixel: fractions of its width and height.
type Place = [f64; 2];

/// The places p with p·normal = distance.
#[derive(Clone, Copy)]
pub struct Line {
    /// Of length 1, to the brighter part.
    pub normal: [f64; 2],
    pub distance: f64,
}

/// The number of places along an edge where it is located.
const NODES: usize = 3;

/// The number of places across an edge that are tried at once.
const TRIES: usize = 3;

/// The number of samples in a round.
pub const ROUND: usize = NODES * TRIES;

/// How far the outer nodes are from the middle of the chord, as a fraction of half its length.
const OUTER: f64 = 0.8;

/// How far the edge may bulge, as a fraction of half its chord: with a stronger bend, the ends of the parabola may leave the pixel
/// elsewhere than the edge does.
const MOST_BULGE: f64 = 0.2;

/// The part of the area between the chord and the parabola by which the edge may differ from the parabola.
const UNLIKE_PARABOLA: f64 = 0.2;

/// How closely the nodes must be known before that matters, as a fraction of half the chord.
const CLEAR: f64 = 0.06;

/// How far the chord may move away from the nodes, as a fraction of half its length.
const ASIDE: f64 = 0.3;

/// An edge that is being located: as a parabola over the chord of a line that separates the samples.
pub struct Edge {
    line: Line,
    /// The middle of the chord.
    middle: Place,
    /// Half its length.
    half: f64,
    /// How far from the line the edge is looked for first.
    step: f64,
    nodes: [Node; NODES],
}

/// Between which distances from the line the edge is, towards the brighter part, at a place along it.
#[derive(Clone, Copy)]
struct Node {
    along: f64,
    dark: Option<f64>,
    bright: Option<f64>,
}

fn dot(one: [f64; 2], other: [f64; 2]) -> f64 {
    one[0] * other[0] + one[1] * other[1]
}

fn difference(one: Place, other: Place) -> [f64; 2] {
    [one[0] - other[0], one[1] - other[1]]
}

fn moved(place: Place, direction: [f64; 2], by: f64) -> Place {
    [place[0] + direction[0] * by, place[1] + direction[1] * by]
}

impl Line {
    /// The line midway between two convex sets of points, and the distance between these, if they are apart.
    fn between(dark: &[Place], bright: &[Place]) -> Option<(Self, f64)> {
        let [one, other] =
            [closest(dark, bright), closest(bright, dark).map(|[on_bright, on_dark]| [on_dark, on_bright])];
        let length = |ends: &[Place; 2]| {
            let way = difference(ends[1], ends[0]);
            dot(way, way).sqrt()
        };
        let ends = [one?, other?].into_iter().min_by(|one, other| length(one).total_cmp(&length(other)))?;
        let gap = length(&ends);
        let normal = difference(ends[1], ends[0]).map(|part| part / gap);
        let line = Self { normal, distance: 0.5 * (dot(normal, ends[0]) + dot(normal, ends[1])) };
        let is_apart =
            dark.iter().all(|place| line.height(*place) < 0.0) && bright.iter().all(|place| line.height(*place) > 0.0);
        is_apart.then_some((line, gap))
    }

    /// How far a place is from the line, towards the brighter part.
    fn height(&self, place: Place) -> f64 {
        dot(self.normal, place) - self.distance
    }

    /// The direction of the line.
    fn direction(&self) -> [f64; 2] {
        [-self.normal[1], self.normal[0]]
    }

    /// Where the line enters and leaves the pixel.
    fn chord(&self) -> Option<[Place; 2]> {
        let foot = self.normal.map(|part| part * self.distance);
        let direction = self.direction();
        let (mut first, mut last) = (f64::NEG_INFINITY, f64::INFINITY);
        for axis in 0..2 {
            if direction[axis].abs() < 1e-12 {
                if !(0.0..=1.0).contains(&foot[axis]) {
                    return None;
                }
                continue;
            }
            let [one, other] = [0.0, 1.0].map(|side| (side - foot[axis]) / direction[axis]);
            first = first.max(one.min(other));
            last = last.min(one.max(other));
        }
        (first < last).then(|| [first, last].map(|along| moved(foot, direction, along)))
    }

    /// The part of the pixel that is on the darker side.
    pub fn area_below(&self) -> f64 {
        let [across, down] = self.normal;
        let (longer, shorter) = (across.abs().max(down.abs()), across.abs().min(down.abs()));
        let distance = (self.distance - across.min(0.0) - down.min(0.0)).clamp(0.0, longer + shorter);
        if shorter < 1e-12 {
            return (distance / longer).min(1.0);
        }
        let square = |part: f64| part.max(0.0) * part.max(0.0);
        let cut = square(distance - longer) + square(distance - shorter) - square(distance - longer - shorter);
        (square(distance) - cut) / (2.0 * longer * shorter)
    }
}

/// The corners of the convex hull of points, given from left to right.
fn hull(points: &[Place]) -> Vec<Place> {
    let half = |points: &mut dyn Iterator<Item = &Place>| {
        let mut corners: Vec<Place> = Vec::new();
        for point in points {
            while let [.., before, last] = corners[..] {
                let ([x, y], [u, v]) = (difference(last, before), difference(*point, last));
                if x * v - y * u > 0.0 {
                    break;
                }
                corners.pop();
            }
            corners.push(*point);
        }
        corners
    };
    let mut corners = half(&mut points.iter());
    let back = half(&mut points.iter().rev());
    corners.extend(&back[1..back.len().max(2) - 1]);
    corners
}

/// The corner of one polygon that is closest to the sides of another, and the place there.
fn closest(corners: &[Place], polygon: &[Place]) -> Option<[Place; 2]> {
    let sides = polygon.iter().zip(polygon.iter().cycle().skip(1));
    let pairs = sides.flat_map(|(start, end)| {
        let side = difference(*end, *start);
        let length_squared = dot(side, side).max(f64::MIN_POSITIVE);
        corners.iter().map(move |corner| {
            let along = (dot(difference(*corner, *start), side) / length_squared).clamp(0.0, 1.0);
            let place = moved(*start, side, along);
            let way = difference(place, *corner);
            (dot(way, way), [*corner, place])
        })
    });
    pairs.min_by(|one, other| one.0.total_cmp(&other.0)).map(|(_, ends)| ends)
}

impl Edge {
    /// The edge between two sets of samples, each from left to right, if a straight line separates them.
    pub fn between(dark: &[Place], bright: &[Place]) -> Option<Self> {
        #[expect(clippy::cast_precision_loss, reason = "small")]
        let distance_of_samples = 1.0 / ((dark.len() + bright.len()) as f64).sqrt();
        let (line, gap) = Line::between(&hull(dark), &hull(bright))?;
        Self::near(line, gap.max(distance_of_samples))
    }

    /// The edge somewhere around a line.
    fn near(line: Line, step: f64) -> Option<Self> {
        let [first, last] = line.chord()?;
        let way = difference(last, first);
        let half = 0.5 * dot(way, way).sqrt();
        let node = |along| Node { along, dark: None, bright: None };
        Some(Self {
            line,
            middle: moved(first, way, 0.5),
            half,
            step,
            nodes: [-OUTER, 0.0, OUTER].map(|part| node(part * half)),
        })
    }

    /// The places to try next.
    pub fn places(&self) -> [Place; ROUND] {
        let mut places = [[0.0; 2]; ROUND];
        for (node, places) in self.nodes.iter().zip(places.chunks_exact_mut(TRIES)) {
            let on_line = moved(self.middle, self.line.direction(), node.along);
            for (place, height) in places.iter_mut().zip(node.heights(self.step)) {
                *place = moved(on_line, self.line.normal, height);
            }
        }
        places
    }

    /// Takes which of the places are bright; `None` if they are dark and bright in turns.
    pub fn bisect(&mut self, is_bright: &[bool; ROUND]) -> Option<()> {
        for (node, is_bright) in self.nodes.iter_mut().zip(is_bright.chunks_exact(TRIES)) {
            let dark = is_bright.iter().take_while(|is_bright| !**is_bright).count();
            if is_bright[dark..].contains(&false) {
                return None;
            }
            let heights = node.heights(self.step);
            if dark > 0 {
                node.dark = Some(heights[dark - 1]);
            }
            if dark < TRIES {
                node.bright = Some(heights[dark]);
            }
        }
        match self.width() {
            Some(width) if width <= CLEAR * self.half => self.recenter(width),
            _ => Some(()),
        }
    }

    /// Starts again around the edge as it is known by now, if the nodes are not spread over its chord.
    fn recenter(&mut self, width: f64) -> Option<()> {
        let straight = self.straight();
        let chord = straight.chord()?;
        let [first, last] = self.ends(chord).map(|end| end / self.half);
        if (first + 1.0).abs().max((last - 1.0).abs()) > ASIDE {
            *self = Self::near(straight, width * first.abs().max(last.abs()))?;
        }
        Some(())
    }

    /// How far apart a place known to be dark and one known to be bright are at most; `None` while a node lacks one of them.
    fn width(&self) -> Option<f64> {
        let mut widest = 0.0_f64;
        for Node { dark, bright, .. } in self.nodes {
            widest = widest.max(bright? - dark?);
        }
        Some(widest)
    }

    /// How much of the pixel may be on the other side of the edge than assumed; `None` while too little of it is known.
    pub fn uncertainty(&self) -> Option<f64> {
        let (width, bulge) = (self.width()?, self.bulge().abs());
        let is_known = self.beyond()? <= 1.0 + ASIDE && bulge <= MOST_BULGE * self.half;
        // The weights of the heights in the integral over the chord are all positive and add up to its length; if the chord is a
        // bit longer than the first one, to a bit more.
        let of_nodes = width * self.half * (1.0 + ASIDE) * (1.0 + ASIDE);
        let of_bend = UNLIKE_PARABOLA * 4.0 / 3.0 * bulge * self.half;
        is_known.then_some(of_nodes + of_bend)
    }

    /// How far from the middle the chord ends, in units of half the first one.
    fn beyond(&self) -> Option<f64> {
        let [first, last] = self.ends(self.straight().chord()?);
        Some((first.abs().max(last.abs()) / self.half).max(1.0))
    }

    /// The heights of the nodes.
    fn heights(&self) -> [f64; NODES] {
        self.nodes.map(|node| 0.5 * (node.dark.unwrap_or(0.0) + node.bright.unwrap_or(0.0)))
    }

    /// How far the outer nodes are from the middle.
    fn outer(&self) -> f64 {
        OUTER * self.half
    }

    /// How far the edge is from the line through its outer nodes, in the middle.
    fn bulge(&self) -> f64 {
        let [first, middle, last] = self.heights();
        middle - 0.5 * (first + last)
    }

    /// The line through the outer nodes.
    fn straight(&self) -> Line {
        let [first, _, last] = self.heights();
        let slope = (last - first) / (2.0 * self.outer());
        let scale = 1.0 / slope.hypot(1.0);
        let normal = moved(self.line.normal, self.line.direction(), -slope).map(|part| part * scale);
        let through = moved(self.middle, self.line.normal, 0.5 * (first + last));
        Line { normal, distance: dot(normal, through) }
    }

    /// How far a chord extends along the line.
    fn ends(&self, chord: [Place; 2]) -> [f64; 2] {
        chord.map(|place| dot(difference(place, self.middle), self.line.direction()))
    }

    /// The fraction of the pixel that is dark.
    pub fn dark_area(&self) -> f64 {
        let outer = self.outer();
        let straight = self.straight();
        let [first, last] = straight.chord().map_or([0.0; 2], |chord| self.ends(chord));
        let integral = |along: f64| along - along * along * along / (3.0 * outer * outer);
        (straight.area_below() + self.bulge() * (integral(last) - integral(first))).clamp(0.0, 1.0)
    }

    /// Whether samples are on the side of the edge where they should be, but for those that are too close to it to tell.
    pub fn agrees(&self, mut samples: impl Iterator<Item = (Place, bool)>) -> bool {
        let (Some(width), Some(beyond)) = (self.width(), self.beyond()) else { return false };
        // What the heights of the nodes weigh at the ends of the chord.
        let slack = width * (beyond * beyond / (OUTER * OUTER) - 0.5);
        let [before, _, after] = self.heights();
        let outer = self.outer();
        samples.all(|(place, is_bright)| {
            let way = difference(place, self.middle);
            let along = dot(way, self.line.direction());
            let straight = 0.5 * (before + after) + 0.5 * (after - before) * along / outer;
            let within = along.abs().min(beyond * self.half) / outer;
            let above = dot(way, self.line.normal) - straight - self.bulge() * (1.0 - within * within);
            (above > 0.0) == is_bright || above.abs() <= slack
        })
    }
}

impl Node {
    /// The distances from the line that are tried next, towards the brighter part.
    fn heights(&self, step: f64) -> [f64; TRIES] {
        match (self.dark, self.bright) {
            (None, None) => [-step, 0.0, step],
            (Some(dark), None) => [1.0, 2.0, 4.0].map(|steps| dark + steps * step),
            (None, Some(bright)) => [4.0, 2.0, 1.0].map(|steps| bright - steps * step),
            (Some(dark), Some(bright)) => [0.25, 0.5, 0.75].map(|part| dark + part * (bright - dark)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hammersley::scrambled_points;
    use crate::render::sampling::cut::ROUNDS;
    use crate::render::sampling::pattern::undetected_error;

    /// Locates the edge of what is bright, with this many samples, until its area is known to this.
    fn located(samples: u32, uncertainty: f64, is_bright: impl Fn(Place) -> bool) -> Option<Edge> {
        let places = scrambled_points(samples);
        let (bright, dark): (Vec<Place>, Vec<Place>) = places.iter().partition(|place| is_bright(**place));
        if bright.is_empty() || dark.is_empty() {
            return None;
        }
        let mut edge = Edge::between(&dark, &bright)?;
        for _ in 0..ROUNDS {
            edge.bisect(&edge.places().map(&is_bright))?;
            if edge.uncertainty().is_some_and(|found| found <= uncertainty) {
                return edge.agrees(places.iter().map(|place| (*place, is_bright(*place)))).then_some(edge);
            }
        }
        None
    }

    #[test]
    fn straight_edges_are_located_wherever_they_are() {
        let mut missed = 0;
        for turn in 0..97 {
            let angle = std::f64::consts::TAU * f64::from(turn) / 97.0;
            let normal = [angle.cos(), angle.sin()];
            for step in 1..40_u32 {
                let through = [
                    0.5 + 0.7 * (f64::from(step) / 20.0 - 1.0) * normal[0],
                    0.5 + 0.7 * (f64::from(step) / 20.0 - 1.0) * normal[1],
                ];
                let line = Line { normal, distance: dot(normal, through) };
                let exact = line.area_below();
                let samples = [64, 128, 256][step as usize % 3];
                let uncertainty = 0.8 / f64::from(samples);
                if let Some(edge) = located(samples, uncertainty, |place| line.height(place) > 0.0) {
                    let error = (edge.dark_area() - exact).abs();
                    let bound = edge.uncertainty().unwrap();
                    assert!(error <= bound, "{normal:?} {through:?}: off by {error} of {exact}, {bound}");
                } else {
                    // Either it is beside all samples, or it cuts off no more than a corner.
                    missed += 1;
                    assert!(exact.min(1.0 - exact) < 0.03, "{normal:?} {through:?}: {exact}");
                }
            }
        }
        assert!(missed < 97 * 20, "{missed}");
    }

    #[test]
    fn the_area_in_a_circle_is_that_of_its_sectors() {
        let mut found = 0;
        for radius in [2.0_f64, 5.0, 20.0] {
            // Circles through the pixel; the area inside by a fine sum over columns.
            for turn in 0..16 {
                let angle = f64::from(turn) * 0.1;
                let [x, y] = [0.5 - radius * angle.cos(), 0.4 - radius * angle.sin()];
                let columns = 4000;
                let inside = |column: u32| {
                    let across = (f64::from(column) + 0.5) / f64::from(columns) - x;
                    let square = radius * radius - across * across;
                    if square <= 0.0 {
                        0.0
                    } else {
                        (y + square.sqrt()).clamp(0.0, 1.0) - (y - square.sqrt()).clamp(0.0, 1.0)
                    }
                };
                let exact = (0..columns).map(inside).sum::<f64>() / f64::from(columns);
                let is_bright = |[across, down]: Place| (across - x).hypot(down - y) > radius;
                if let Some(edge) = located(64, 0.01, is_bright) {
                    let error = (edge.dark_area() - exact).abs();
                    // A second piece of the edge may be where no sample is.
                    let bound = edge.uncertainty().unwrap().max(undetected_error(1.0, 64));
                    assert!(error <= bound, "{radius} {x} {y}: off by {error} of {exact}, {bound}");
                    found += 1;
                }
            }
        }
        assert!(found >= 24, "{found}");
    }

    #[test]
    fn corners_and_stripes_are_no_edges() {
        assert!(located(64, 1e-3, |[x, y]| x > 0.4 && y > 0.3).is_none());
        assert!(located(64, 1e-3, |[x, y]| (x + 0.3 * y - 0.6).abs() < 0.2).is_none());
    }

    #[test]
    fn a_hull_is_the_corners_around_all_points() {
        let points = scrambled_points(64);
        let corners = hull(&points);
        for (start, end) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            let ([x, y], start) = (difference(*end, *start), *start);
            for point in &points {
                let [u, v] = difference(*point, start);
                assert!(x * v - y * u >= -1e-12);
            }
        }
        assert_eq!(hull(&points[..1]), points[..1]);
        assert_eq!(hull(&points[..2]).len(), 2);
    }
}
