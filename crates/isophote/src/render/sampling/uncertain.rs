//! Which pixels need more than the value at their centre.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::lanes::{Element, Instructions, Lane, LaneJob};
use crate::map::{Map, Quantity, Region, Run, Scalars};

/// A pixel whose value differs from that at its centre.
#[derive(Clone)]
pub struct Uncertain {
    /// Index in the map.
    pub index: usize,
    /// How much its neighbours differ from it in each layer: a corner that the first samples miss may differ by as much.
    pub contrasts: Vec<f64>,
    /// Whether its centre sees a surface.
    pub sees: bool,
}

/// An uncertain pixel in one layer.
#[derive(Clone, Copy)]
pub struct Suspect {
    index: usize,
    contrast: f64,
    sees: bool,
}

/// The pixels of some rows, in reading order, that are uncertain in any layer.
///
/// `narrow` are those that show something which no centre sees.
pub fn uncertain_in_rows(
    finders: &[Finder<'_>],
    narrow: &[Uncertain],
    rows: Range<usize>,
    suspects: &mut Suspects,
) -> Vec<Uncertain> {
    let width = finders.first().map_or(0, |finder| finder.width);
    let place = |row: usize| narrow.partition_point(|uncertain| uncertain.index < row * width);
    let narrow = narrow[place(rows.start)..place(rows.end)].iter();
    let mut all: BTreeMap<usize, Uncertain> = narrow.map(|narrow| (narrow.index, narrow.clone())).collect();
    for (layer, finder) in finders.iter().enumerate() {
        for Suspect { index, contrast, sees } in finder.in_rows(rows.clone(), suspects) {
            let new = || Uncertain { index, contrasts: vec![0.0; finders.len()], sees };
            let known = &mut all.entry(index).or_insert_with(new).contrasts[layer];
            *known = known.max(contrast);
        }
    }
    all.into_values().collect()
}

/// A pixel and its neighbours.
struct Surroundings {
    suspect: Suspect,
    /// How far the brightness is from a straight line, along the worst of the four.
    bend: f64,
    /// Whether a neighbour sees another shape, of another brightness.
    is_unlike: bool,
}

/// Columns of a row that are to be checked; the memory is reused for the next row.
#[derive(Default)]
pub struct Suspects {
    columns: Vec<usize>,
    cuts: Vec<usize>,
}

/// Finds the uncertain pixels of a region: those where the brightness curves by more than the tolerance along one of the
/// four lines through the pixel and two of its neighbours, or differs by more than that from a neighbour that sees something
/// else; and their neighbours. A slope alone needs no refinement: its mean is the value at the centre. Where something ends,
/// however, a straight line may be a coincidence, and the tip of a thin shadow may reach into a pixel beside all centres. Only
/// the neighbours of a pixel that is uncertain by itself are added, not theirs in turn: a value depends on the two rings of
/// pixels around it, whatever part of the image is rendered.
pub struct Finder<'m> {
    brightness: Scalars<'m>,
    runs: &'m [Run],
    /// Where the runs of each row begin and end.
    of_row: Vec<Range<usize>>,
    /// The columns of the region.
    columns: Range<usize>,
    /// The same and one more on each side, as far as the map extends: what is uncertain there matters to its neighbours.
    searched: Range<usize>,
    width: usize,
    height: usize,
    tolerance: f64,
    instructions: Instructions,
}

impl<'m> Finder<'m> {
    /// For a region of a map that holds two more pixels on each side, as far as the image extends.
    pub fn new(map: &'m Map, region: Region, tolerance: f64) -> Self {
        let Region { corner, size } = map.region;
        let first = (region.corner.column - corner.column) as usize;
        let (width, height) = (size.width as usize, size.height as usize);
        let runs = map.mask().runs();
        let columns = first..first + region.size.width as usize;
        let mut next = 0;
        let of_row = (1..=height).map(|row| {
            let start = next;
            next += runs[next..].iter().take_while(|run| run.start < row * width).count();
            start..next
        });
        Self {
            brightness: map.scalar(&Quantity::Brightness).expect("it was asked for"),
            runs,
            of_row: of_row.collect(),
            searched: columns.start.saturating_sub(1)..(columns.end + 1).min(width),
            columns,
            width,
            height,
            tolerance,
            instructions: Instructions::best(),
        }
    }

    /// The uncertain pixels of some rows of the region.
    fn in_rows(&self, rows: Range<usize>, suspects: &mut Suspects) -> Vec<Suspect> {
        let searched = rows.start.saturating_sub(1)..(rows.end + 1).min(self.height);
        let first = searched.start;
        let found: Vec<Vec<Suspect>> = searched.map(|row| self.in_row(row, suspects)).collect();
        let mut all = Vec::new();
        for row in rows {
            let known = &found[row - first];
            all.extend(known.iter().filter(|suspect| self.columns.contains(&self.column(suspect))));
            let around = &found[(row - first).saturating_sub(1)..(row - first + 2).min(found.len())];
            let beside = around.iter().flatten().map(|suspect| self.column(suspect));
            suspects.columns.clear();
            suspects.columns.extend(beside.flat_map(|column| column.saturating_sub(1)..column + 2));
            suspects.columns.sort_unstable();
            suspects.columns.dedup();
            for column in suspects.columns.iter().filter(|column| self.columns.contains(column)) {
                let index = row * self.width + column;
                if known.binary_search_by_key(&index, |suspect| suspect.index).is_err() {
                    all.push(self.look_around(row, *column).suspect);
                }
            }
        }
        all
    }

    fn column(&self, suspect: &Suspect) -> usize {
        suspect.index % self.width
    }

    /// The pixels of a row, from left to right, that are uncertain by themselves.
    fn in_row(&self, row: usize, suspects: &mut Suspects) -> Vec<Suspect> {
        suspects.columns.clear();
        self.suspect_edges(row, suspects);
        if let Some(inner) = self.inner(row) {
            self.instructions.run(Bends { finder: self, row, inner, suspects: &mut suspects.columns });
        }
        suspects.columns.sort_unstable();
        suspects.columns.dedup();
        suspects.columns.iter().filter_map(|column| self.uncertain(row, *column)).collect()
    }

    fn runs_of(&self, row: usize) -> &[Run] {
        &self.runs[self.of_row[row].clone()]
    }

    /// The rows around a row, as far as the map extends.
    fn around(&self, row: usize) -> Range<usize> {
        row.saturating_sub(1)..(row + 2).min(self.height)
    }

    /// The columns of a row between the first and the last with anything visible next to them, without those at the border.
    fn inner(&self, row: usize) -> Option<Range<usize>> {
        let seen = self.around(row).filter_map(|row| {
            let runs = self.runs_of(row);
            Some((runs.first()?.start - row * self.width, runs.last()?.end - row * self.width))
        });
        let (start, end) = seen.reduce(|one, other| (one.0.min(other.0), one.1.max(other.1)))?;
        let start = start.saturating_sub(1).max(self.searched.start).max(1);
        let end = (end + 1).min(self.searched.end).min(self.width - 1);
        (row > 0 && row + 1 < self.height && start < end).then_some(start..end)
    }

    /// The columns next to which another shape is visible, and those at the border of the map.
    fn suspect_edges(&self, row: usize, suspects: &mut Suspects) {
        let Suspects { columns: suspects, cuts } = suspects;
        // Between two cuts, each of the three rows sees one shape or none.
        cuts.clear();
        cuts.extend([0, self.width]);
        for around in self.around(row) {
            let runs = self.runs_of(around).iter();
            cuts.extend(runs.flat_map(|run| [run.start, run.end]).map(|index| index - around * self.width));
        }
        cuts.sort_unstable();
        cuts.dedup();
        if cuts.len() == 2 && self.runs_of(row).is_empty() {
            return;
        }
        let mut suspect = |columns: Range<usize>| {
            suspects.extend(columns.start.max(self.searched.start)..columns.end.min(self.searched.end));
        };
        for pair in cuts.windows(2) {
            let [start, end] = [pair[0], pair[1]];
            let mut shapes = self.around(row).map(|row| self.shape(row, start));
            let shape = shapes.next().flatten();
            if shapes.all(|other| other == shape) {
                suspect(start.saturating_sub(1)..(start + 1).min(end));
                suspect((end - 1).max(start)..end + 1);
            } else {
                suspect(start.saturating_sub(1)..end + 1);
            }
        }
        if row == 0 || row + 1 == self.height {
            suspect(0..self.width);
        }
    }

    /// The shape visible at a pixel.
    fn shape(&self, row: usize, column: usize) -> Option<u32> {
        let (runs, index) = (self.runs_of(row), row * self.width + column);
        let before = runs.partition_point(|run| run.end <= index);
        runs.get(before).filter(|run| run.start <= index).map(|run| run.shape)
    }

    fn uncertain(&self, row: usize, column: usize) -> Option<Suspect> {
        let Surroundings { suspect, bend, is_unlike } = self.look_around(row, column);
        (bend > self.tolerance || is_unlike).then_some(suspect)
    }

    fn look_around(&self, row: usize, column: usize) -> Surroundings {
        let index = row * self.width + column;
        let here = self.brightness.at(index);
        let (mut contrast, mut bend) = (0.0_f64, 0.0_f64);
        for [one, other] in LINES {
            let by = |offset| self.beside(row, column, offset).map(|(row, column)| self.value(row, column) - here);
            let (one, other) = (by(one).unwrap_or(0.0), by(other).unwrap_or(0.0));
            contrast = contrast.max(one.abs()).max(other.abs());
            bend = bend.max((one + other).abs());
        }
        let shape = self.shape(row, column);
        let is_unlike = |offset: [isize; 2]| {
            self.beside(row, column, offset).is_some_and(|(row, column)| {
                (self.value(row, column) - here).abs() > self.tolerance && self.shape(row, column) != shape
            })
        };
        let is_unlike = contrast > self.tolerance && LINES.into_iter().flatten().any(is_unlike);
        Surroundings { suspect: Suspect { index, contrast, sees: shape.is_some() }, bend, is_unlike }
    }

    /// Whether a pixel's centre, or a neighbour's, sees a shape.
    pub fn is_seen_nearby(&self, row: usize, column: usize, shape: usize) -> bool {
        let around = LINES.into_iter().flatten().filter_map(|offset| self.beside(row, column, offset));
        let mut pixels = around.chain([(row, column)]);
        pixels.any(|(row, column)| self.shape(row, column).is_some_and(|seen| seen as usize == shape))
    }

    /// Whether a pixel is uncertain by what its neighbours see.
    pub fn is_uncertain(&self, row: usize, column: usize) -> bool {
        self.uncertain(row, column).is_some()
    }

    /// A pixel that is uncertain by so much.
    pub fn uncertain_by(&self, row: usize, column: usize, contrasts: Vec<f64>) -> Uncertain {
        let sees = self.shape(row, column).is_some();
        Uncertain { index: row * self.width + column, contrasts, sees }
    }

    /// The brightness at the centre of a pixel of the map.
    pub fn value(&self, row: usize, column: usize) -> f64 {
        self.brightness.at(row * self.width + column)
    }

    fn beside(&self, row: usize, column: usize, [down, across]: [isize; 2]) -> Option<(usize, usize)> {
        let row = row.checked_add_signed(down).filter(|row| *row < self.height)?;
        let column = column.checked_add_signed(across).filter(|column| *column < self.width)?;
        Some((row, column))
    }
}

/// The lines through a pixel: the neighbours on both sides, as row and column offsets.
const LINES: [[[isize; 2]; 2]; 4] = [[[0, 1], [0, -1]], [[1, 0], [-1, 0]], [[1, 1], [-1, -1]], [[1, -1], [-1, 1]]];

/// Finds the columns of a row where the brightness curves, several at a time.
struct Bends<'b, 'm> {
    finder: &'b Finder<'m>,
    row: usize,
    /// Columns that have neighbours on all sides.
    inner: Range<usize>,
    suspects: &'b mut Vec<usize>,
}

impl LaneJob for Bends<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<S, D>(self, token: S::Token)
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>,
    {
        match self.finder.brightness {
            Scalars::Double(values) => self.find::<D>(token, values),
            Scalars::Single(values) => self.find::<S>(token, values),
        }
    }
}

impl Bends<'_, '_> {
    #[inline(always)]
    fn find<V: Lane>(self, token: V::Token, values: &[V::Element]) {
        let Self { finder, row, inner, suspects } = self;
        if inner.len() < V::COUNT {
            suspects.extend(inner);
            return;
        }
        let tolerance = V::splat(token, V::Element::from_f64(finder.tolerance));
        let two = V::splat(token, V::Element::from_f64(2.0));
        let width = finder.width;
        let [above, here, below] = [row - 1, row, row + 1].map(|row| &values[row * width..][..width]);
        let mut first = inner.start;
        loop {
            // The last vector overlaps the one before, so that no column is processed one by one.
            let column = first.min(inner.end - V::COUNT);
            let bend = |before: &[V::Element], after: &[V::Element]| V::load(token, before) + V::load(token, after);
            let [left, middle, right] = [column - 1, column, column + 1];
            let sums = [
                bend(&here[left..], &here[right..]),
                bend(&above[middle..], &below[middle..]),
                bend(&above[left..], &below[right..]),
                bend(&above[right..], &below[left..]),
            ];
            let twice = V::load(token, &here[middle..]) * two;
            let greatest = sums[0].max(sums[1]).max(sums[2].max(sums[3])) - twice;
            let least = twice - sums[0].min(sums[1]).min(sums[2].min(sums[3]));
            let mut found = V::bits(tolerance.is_less(greatest.max(least)));
            while found != 0 {
                suspects.push(column + found.trailing_zeros() as usize);
                found &= found - 1;
            }
            first += V::COUNT;
            if first >= inner.end {
                break;
            }
        }
    }
}
