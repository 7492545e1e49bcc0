//! The rays of a packet with 32 digits, and numbers with 32 digits in lanes.

use super::Place;
use super::rays::{RAYS, RayPacket, Vectors};
use crate::camera::{Differing, PreciseCamera};
use crate::double_double::DoubleDouble;
use crate::lanes::{Lane, LaneJob};
use crate::render::vectors::{get, load, splat, store};
use crate::vector::Vector;

/// The rays of a packet with 32 digits.
pub struct PreciseRays<'a> {
    camera: PreciseCamera<'a>,
    /// Their columns and rows, counted from the centre of the first pixel.
    columns: [f64; RAYS],
    rows: [f64; RAYS],
    /// The upper and the lower halves of their directions, or starts if they are parallel.
    halves: [Vectors; 2],
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
    pub fn new(camera: PreciseCamera<'a>) -> Box<Self> {
        let (numbers, zeros) = ([0.0; RAYS], [[0.0; RAYS]; 3]);
        Box::new(Self { camera, columns: numbers, rows: numbers, halves: [zeros; 2], directions: zeros })
    }

    /// The unit vector along a ray.
    pub fn direction_of(&self, ray: usize) -> Vector {
        get(&self.directions, ray)
    }

    /// Chooses the rays.
    pub fn aim(&mut self, places: &[Place; RAYS]) {
        for (ray, Place { pixel, within: [across, down] }) in places.iter().enumerate() {
            self.columns[ray] = f64::from(pixel.column) + (across - 0.5);
            self.rows[ray] = f64::from(pixel.row) + (down - 0.5);
        }
    }

    /// Some of the rays.
    #[inline(always)]
    pub fn way<V: Lane<Element = f64>>(&self, token: V::Token, at: usize) -> Way<V> {
        let differing = pairs::<V>(token, &self.halves, at);
        let common = exact::<V>(token, self.camera.common);
        let direction = load::<V, _>(token, at, &self.directions);
        if self.camera.is_parallel() {
            Way { start: differing, along: common, direction }
        } else {
            Way { start: common, along: differing, direction }
        }
    }
}

/// Computes the rays, and sets those of a packet.
pub struct Aim<'c, 'a> {
    /// The rays.
    pub rays: &'c mut PreciseRays<'a>,
    /// The packet.
    pub packet: &'c mut RayPacket,
}

impl LaneJob for Aim<'_, '_> {
    type Output = Visible;

    #[inline(always)]
    fn run<S, D>(self, token: S::Token) -> Visible
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>,
    {
        self.aim::<D::Narrow>(token)
    }
}

/// Which rays the camera has, as bits.
#[derive(Default)]
pub struct Visible {
    /// Those that it certainly has.
    pub surely: u64,
    /// Those at the edge of what it sees.
    pub maybe: u64,
}

impl Aim<'_, '_> {
    #[inline(always)]
    fn aim<V: Lane<Element = f64>>(self, token: V::Token) -> Visible {
        /// How far the edge of what a camera sees may be off.
        const MARGIN: f64 = 1e-12;
        let PreciseRays { camera, columns, rows, halves, directions } = self.rays;
        let common = camera.common.map(DoubleDouble::rounded);
        let parallel = splat::<V>(token, common);
        let packet = self.packet;
        let is_parallel = camera.is_parallel();
        packet.origin = common;
        let zero = V::splat(token, 0.0);
        let mut visible = Visible::default();
        for at in (0..RAYS).step_by(V::COUNT) {
            let Differing { vector, eccentricity } =
                camera.at(V::load(token, &columns[at..]), V::load(token, &rows[at..]));
            let bits = |limit: f64| u64::from(V::bits(eccentricity.is_less(V::splat(token, limit)))) << at;
            let surely = bits(1.0 - MARGIN);
            visible.surely |= surely;
            visible.maybe |= bits(1.0 + MARGIN) & !surely;
            let high = nearest(vector);
            if is_parallel && at == 0 {
                // The first start.
                let mut first = [[0.0; RAYS]; 3];
                store(high, 0, &mut first);
                packet.origin = get(&first, 0);
            }
            store(high, at, &mut halves[0]);
            store(nearest(vector - exactly(high)), at, &mut halves[1]);
            let (start, direction) = if is_parallel {
                (nearest(vector - exactly(splat::<V>(token, packet.origin))), parallel)
            } else {
                (Vector::new(zero, zero, zero), high.normalized())
            };
            store(direction, at, directions);
            store(start, at, &mut packet.start);
            store(direction, at, &mut packet.direction);
        }
        visible
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
