//! The rays of a packet with 32 digits, and numbers with 32 digits in lanes.

use super::place_of;
use super::rays::{RAYS, RayPacket, Vectors};
use crate::camera::{LinearRays, ScreenPosition};
use crate::double_double::DoubleDouble;
use crate::lanes::{Lane, LaneJob};
use crate::map::Pixel;
use crate::render::band::{Band, Tile};
use crate::render::vectors::{get, load, put, splat, store};
use crate::vector::Vector;

/// The rays of a packet with 32 digits: a ray's direction, or its start if all rays are parallel, is the sum of what its
/// column and its row contribute.
pub struct PreciseRays<'a> {
    rays: LinearRays<'a>,
    /// The upper and the lower halves of what the columns and the rows of a band contribute, and where these begin.
    columns: Vec<[Vector; 2]>,
    rows: Vec<[Vector; 2]>,
    first: Pixel,
    /// The same for each ray.
    of_columns: [Vectors; 2],
    of_rows: [Vectors; 2],
    /// The upper and the lower halves of the sums.
    sums: [Vectors; 2],
    /// Unit vectors along the rays.
    directions: Vectors,
}

/// How some rays run, in lanes.
pub struct Way<V> {
    /// Where they start, in metres.
    pub start: Vector<DoubleDouble<V>>,
    /// Their directions, of any length.
    pub along: Vector<DoubleDouble<V>>,
    /// Their directions, unit vectors.
    pub direction: Vector<V>,
}

impl<'a> PreciseRays<'a> {
    /// No rays yet of a camera.
    pub fn new(rays: LinearRays<'a>) -> Box<Self> {
        let zeros = [[0.0; RAYS]; 3];
        Box::new(Self {
            rays,
            columns: Vec::new(),
            rows: Vec::new(),
            first: Pixel { column: 0, row: 0 },
            of_columns: [zeros; 2],
            of_rows: [zeros; 2],
            sums: [zeros; 2],
            directions: zeros,
        })
    }

    /// The unit vector along a ray.
    pub fn direction_of(&self, ray: usize) -> Vector {
        get(&self.directions, ray)
    }

    /// Prepares the rays through the pixels of a band.
    pub fn begin(&mut self, band: &Band<'_>) {
        let Self { rays, .. } = self;
        let Pixel { column, row } = band.first;
        self.first = band.first;
        self.columns.extend((column..column + band.size.width).map(|column| halves(rays.of_column(column))));
        self.rows.extend((row..row + band.size.height).map(|row| halves(rays.of_row(row))));
    }

    /// Chooses the rays of a tile of the band; those beyond its last column or row are copies.
    pub fn aim_at_tile(&mut self, tile: Tile) {
        let (column, row) = (tile.first.column - self.first.column, tile.first.row - self.first.row);
        for ray in 0..RAYS {
            let (across, down) = place_of(ray);
            let column = self.columns[(column + across.min(tile.width - 1)) as usize];
            let row = self.rows[(row + down.min(tile.height - 1)) as usize];
            self.set(ray, column, row);
        }
    }

    /// Chooses the rays through screen positions; those after the last one are copies of it.
    pub fn aim(&mut self, positions: &[ScreenPosition]) {
        let Some(last) = positions.last() else { return };
        for ray in 0..RAYS {
            let [column, row] = self.rays.of(*positions.get(ray).unwrap_or(last)).map(halves);
            self.set(ray, column, row);
        }
    }

    fn set(&mut self, ray: usize, column: [Vector; 2], row: [Vector; 2]) {
        for half in 0..2 {
            put(column[half], ray, &mut self.of_columns[half]);
            put(row[half], ray, &mut self.of_rows[half]);
        }
    }

    /// Some of the rays.
    #[inline(always)]
    pub fn way<V: Lane<Element = f64>>(&self, token: V::Token, at: usize) -> Way<V> {
        let sum = pairs::<V>(token, &self.sums, at);
        let common = exact::<V>(token, self.rays.common);
        let direction = load::<V, _>(token, at, &self.directions);
        if self.rays.is_parallel {
            Way { start: sum, along: common, direction }
        } else {
            Way { start: common, along: sum, direction }
        }
    }
}

/// The upper and the lower half of a vector.
fn halves(vector: Vector<DoubleDouble>) -> [Vector; 2] {
    let high = vector.map(DoubleDouble::rounded);
    [high, (vector - Vector::from_f64(high)).map(DoubleDouble::rounded)]
}

/// Adds what columns and rows contribute, and sets the rays of a packet.
pub struct Combine<'c, 'a> {
    /// The rays.
    pub rays: &'c mut PreciseRays<'a>,
    /// The packet.
    pub packet: &'c mut RayPacket,
}

impl LaneJob for Combine<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<S, D>(self, token: S::Token)
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>,
    {
        self.combine::<D::Narrow>(token);
    }
}

impl Combine<'_, '_> {
    #[inline(always)]
    fn combine<V: Lane<Element = f64>>(self, token: V::Token) {
        let PreciseRays { rays: LinearRays { is_parallel, common, .. }, of_columns, of_rows, sums, directions, .. } =
            self.rays;
        let parallel = nearest(exact::<V>(token, *common));
        let packet = self.packet;
        packet.origin = common.map(DoubleDouble::rounded);
        if *is_parallel {
            // The first start.
            let first = |halves: &[Vectors; 2]| get(&halves[0], 0);
            packet.origin = first(of_columns) + first(of_rows);
        }
        let origin = exactly(splat::<V>(token, packet.origin));
        let zero = V::splat(token, 0.0);
        for at in (0..RAYS).step_by(V::COUNT) {
            let sum = pairs::<V>(token, of_columns, at) + pairs(token, of_rows, at);
            let high = nearest(sum);
            store(high, at, &mut sums[0]);
            let low = sum - exactly(high);
            store(nearest(low), at, &mut sums[1]);
            let (start, direction) = if *is_parallel {
                (nearest(sum - origin), parallel)
            } else {
                (Vector::new(zero, zero, zero), high.normalized())
            };
            store(direction, at, directions);
            store(start, at, &mut packet.start);
            store(direction, at, &mut packet.direction);
        }
    }
}

#[inline(always)]
fn pairs<V: Lane<Element = f64>>(token: V::Token, [high, low]: &[Vectors; 2], at: usize) -> Vector<DoubleDouble<V>> {
    let (high, low) = (load::<V, _>(token, at, high), load::<V, _>(token, at, low));
    Vector::new(
        DoubleDouble::sum_of(high.x, low.x),
        DoubleDouble::sum_of(high.y, low.y),
        DoubleDouble::sum_of(high.z, low.z),
    )
}

/// The same vector in every lane.
#[inline(always)]
pub fn exact<V: Lane<Element = f64>>(token: V::Token, vector: Vector<DoubleDouble>) -> Vector<DoubleDouble<V>> {
    vector.map(
        #[inline(always)]
        |number| {
            number.map(
                #[inline(always)]
                |half| V::splat(token, half),
            )
        },
    )
}

/// Vectors of doubles, exactly.
#[inline(always)]
pub fn exactly<V: Lane<Element = f64>>(vector: Vector<V>) -> Vector<DoubleDouble<V>> {
    Vector::new(DoubleDouble::exactly(vector.x), DoubleDouble::exactly(vector.y), DoubleDouble::exactly(vector.z))
}

/// The nearest vectors of doubles.
#[inline(always)]
pub fn nearest<V: Lane<Element = f64>>(vector: Vector<DoubleDouble<V>>) -> Vector<V> {
    Vector::new(vector.x.nearest(), vector.y.nearest(), vector.z.nearest())
}

/// The same number in every lane.
#[inline(always)]
pub fn exact_number<V: Lane<Element = f64>>(token: V::Token, number: DoubleDouble) -> DoubleDouble<V> {
    number.map(
        #[inline(always)]
        |half| V::splat(token, half),
    )
}
