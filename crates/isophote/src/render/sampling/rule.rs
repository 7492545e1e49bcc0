//! The nodes and weights that integrate over the part of a pixel that an outline covers.

use crate::outline::Ellipse;

/// Nodes in an outline and their weights, which add up to the covered fraction of the pixel.
pub struct NodePlaces {
    /// The number of nodes; the weights of all others are zero.
    pub count: usize,
    /// u, counted from [`Ellipse::column`].
    pub columns: [f64; MOST],
    /// v, counted from [`Ellipse::row`].
    pub rows: [f64; MOST],
    /// u − u_a.
    pub after_first: [f64; MOST],
    /// u − u_b.
    pub after_last: [f64; MOST],
    /// Fractions of the pixel.
    pub weights: [f64; MOST],
    /// The covered fraction of the pixel.
    pub coverage: f64,
    /// The middle of the longest line on which nodes were placed: its column and row.
    pub inside: [f64; 2],
}

/// The maximum number of nodes: five pieces of four rows of four. (A whole number of vectors, the last one perhaps half
/// empty.)
pub const MOST: usize = 80;

/// The centre of a pixel, in the outline's coordinates.
#[derive(Clone, Copy)]
pub struct Center {
    pub column: f64,
    pub row: f64,
}

/// The ends of an interval at which the function behaves like the square root of the distance: those on the outline.
#[derive(Clone, Copy)]
struct Roots {
    first: bool,
    last: bool,
}

/// Gauss nodes on [0, 1] and their weights.
const TWO: [[f64; 2]; 2] = [[0.211_324_865_405_187_13, 0.5], [0.788_675_134_594_812_9, 0.5]];
const FOUR: [[f64; 2]; 4] = [
    [0.069_431_844_202_973_71, 0.173_927_422_568_726_93],
    [0.330_009_478_207_571_87, 0.326_072_577_431_273_07],
    [0.669_990_521_792_428_1, 0.326_072_577_431_273_07],
    [0.930_568_155_797_026_3, 0.173_927_422_568_726_93],
];

/// The number of rows in each piece of a pixel; each row has four nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RowRule {
    Two,
    Four,
}

impl RowRule {
    /// The range of the brightness in a pixel, in units of its allowed error, at which the error is at most half of that. Where
    /// the brightness has a kink, at a terminator, two rows may be off by 0.03 of its range and four by 0.014.
    pub fn widest(self) -> f64 {
        match self {
            Self::Two => 16.0,
            Self::Four => 36.0,
        }
    }

    fn rule(self) -> &'static [[f64; 2]] {
        match self {
            Self::Two => &TWO,
            Self::Four => &FOUR,
        }
    }
}

impl Roots {
    /// A node and its weight after a change of variable that makes the function smooth again.
    #[inline(always)]
    fn map(self, [t, weight]: [f64; 2]) -> [f64; 2] {
        let rest = 1.0 - t;
        match (self.first, self.last) {
            (false, false) => [t, weight],
            (true, false) => [t * t, 2.0 * t * weight],
            (false, true) => [1.0 - rest * rest, 2.0 * rest * weight],
            (true, true) => [t * t * (3.0 - 2.0 * t), 6.0 * t * rest * weight],
        }
    }
}

impl NodePlaces {
    /// No nodes yet.
    pub fn new() -> Self {
        let none = [0.0; MOST];
        Self {
            count: 0,
            columns: none,
            rows: none,
            after_first: none,
            after_last: none,
            weights: none,
            coverage: 0.0,
            inside: [0.0; 2],
        }
    }

    /// Cuts the pixel into pieces at the rows where the outline enters or leaves it through its left or right edge: between
    /// those rows, all integrands are smooth.
    pub fn place(&mut self, outline: &Ellipse, pixel: Center, rows: RowRule) {
        (self.count, self.coverage) = (0, 0.0);
        let first = (pixel.row - 0.5).max(outline.rows[0]);
        let last = (pixel.row + 0.5).min(outline.rows[1]);
        let mut longest = 0.0;
        let mut from = first;
        let cuts = crossings(outline, pixel);
        for to in cuts.into_iter().filter(|row| first < *row && *row < last).chain([last]) {
            if from < to {
                let roots = Roots { first: from == outline.rows[0], last: to == outline.rows[1] };
                for node in rows.rule() {
                    let [part, weight] = roots.map(*node);
                    self.line(outline, pixel, from + (to - from) * part, (to - from) * weight, &mut longest);
                }
            }
            from = to;
        }
        for index in self.count..self.count.next_multiple_of(16) {
            (self.columns[index], self.rows[index]) = (self.inside[0], self.inside[1]);
            (self.after_first[index], self.after_last[index], self.weights[index]) = (1.0, -1.0, 0.0);
        }
    }

    #[inline(always)]
    fn line(&mut self, outline: &Ellipse, pixel: Center, row: f64, weight: f64, longest: &mut f64) {
        let [root, other] = outline.row_at(row).roots;
        let (first, last) = (root.max(pixel.column - 0.5), other.min(pixel.column + 0.5));
        let length = last - first;
        if !(length > 0.0) {
            return;
        }
        if length > *longest {
            *longest = length;
            self.inside = [first + 0.5 * length, row];
        }
        self.coverage += weight * length;
        let roots = Roots { first: first == root, last: last == other };
        for node in &FOUR {
            let [part, share] = roots.map(*node);
            let column = first + length * part;
            let index = self.count;
            self.columns[index] = column;
            self.rows[index] = row;
            self.after_first[index] = column - root;
            self.after_last[index] = column - other;
            self.weights[index] = weight * length * share;
            self.count += 1;
        }
    }
}

/// The rows, in order, where the outline crosses the lines of the pixel's left and right edges; NaN where it does not.
///
/// ```text
/// (u − m₀ − m₁v)² = W (v − v_a)(v_b − v)
/// ```
fn crossings(outline: &Ellipse, pixel: Center) -> [f64; 4] {
    let ([middle, growth], width) = (outline.middle, outline.width_squared);
    let [first, last] = outline.rows;
    // Counted from the pixel, so that few digits are lost even for a large outline.
    let (first, last) = (first - pixel.row, last - pixel.row);
    let square = growth * growth + width;
    let of_edge = |edge: f64| {
        let across = pixel.column + edge - middle - growth * pixel.row;
        let half = across * growth + 0.5 * width * (first + last);
        let rest = across * across + width * first * last;
        let root = (half * half - square * rest).sqrt();
        // The root without cancellation, and the other one from their product.
        let sum = half + root.copysign(half);
        [sum / square, rest / sum].map(|row| row + pixel.row)
    };
    let ([a, b], [c, d]) = (of_edge(-0.5), of_edge(0.5));
    let mut rows = [a, b, c, d];
    rows.sort_unstable_by(f64::total_cmp);
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outline::Outline;
    use crate::prepare::PreparedScene;
    use crate::scene::{Scene, Syntax};

    fn disc(radius: f64) -> PreparedScene {
        let text = format!(
            "version = 1\nlength = \"m\"\nconvention = \"irradiance\"\n
            [camera]\neye = [0, 0, 0]\nforward = [0, 0, 1]\nresolution = [40, 30]
            screen = {{ distance = 1, x = [-20, 20], y = [-15, 15] }}
            [[sphere]]\ncenter = [10, 7, 40]\nradius = {radius}
            [[light]]\nposition = [0, 0, -3]\nintensity = 10"
        );
        PreparedScene::new(&Scene::from_text("test", &text, Syntax::Toml).unwrap_or_else(|error| panic!("{error}")))
    }

    /// Computed with 4000 lines.
    fn covered(outline: &Ellipse, pixel: Center) -> f64 {
        let line = |index: u32| {
            let row = pixel.row - 0.5 + (f64::from(index) + 0.5) / 4000.0;
            if !(outline.rows[0] < row && row < outline.rows[1]) {
                return 0.0;
            }
            let [first, last] = outline.row_at(row).roots;
            (last.min(pixel.column + 0.5) - first.max(pixel.column - 0.5)).max(0.0)
        };
        (0..4000).map(line).sum::<f64>() / 4000.0
    }

    #[test]
    fn the_weights_add_up_to_the_covered_area() {
        for radius in [39.0, 30.0, 10.0, 2.0, 0.3] {
            let scene = disc(radius);
            let Outline::Ellipse(outline) = scene.outline(0) else { panic!("it is before the eye") };
            let mut cut = 0;
            for (rows, error) in [(RowRule::Two, 4e-3), (RowRule::Four, 3e-4)] {
                for row in 0..30_u32 {
                    for column in 0..40_u32 {
                        let pixel =
                            Center { column: f64::from(column) - outline.column, row: f64::from(row) - outline.row };
                        let mut nodes = NodePlaces::new();
                        nodes.place(outline, pixel, rows);
                        let expected = covered(outline, pixel);
                        let found = nodes.weights[..nodes.count].iter().sum::<f64>();
                        assert!(
                            (found - expected).abs() < error,
                            "{radius}, {rows:?}, {column} {row}: {found} {expected}"
                        );
                        assert!((found - nodes.coverage).abs() < 1e-14);
                        cut += u32::from(expected > 0.0 && expected < 1.0);
                    }
                }
            }
            assert!(cut > 0, "{radius}");
        }
    }
}
