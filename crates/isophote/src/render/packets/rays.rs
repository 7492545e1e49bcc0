//! Rays that are traced together.

use crate::lanes::Lane;
use crate::ray::Ray;
use crate::render::vectors::{self, get, greatest_of, least_of, load, put, splat, store};
use crate::shape::Bounds;
use crate::vector::Vector;

/// The number of rays in a packet.
pub const RAYS: usize = 64;

/// Neighbouring rays that are skipped together.
pub const OCTET: usize = 8;

/// The number of octets in a packet.
pub const OCTETS: usize = RAYS / OCTET;

/// A vector per ray, by axis.
pub type Vectors = vectors::Vectors<f64, RAYS>;

/// Rays from `origin + start`, in metres. The parameter t of a point counts lengths of its ray's direction.
pub struct RayPacket {
    /// A place near the starts, or where all of them are, in metres.
    pub origin: Vector,
    /// From the origin to the starts.
    pub start: Vectors,
    /// Their directions, of any nonzero length.
    pub direction: Vectors,
    /// The rays in use, as bits. The others are copies of one of them.
    pub in_use: u64,
    /// Where t may lie: `[0, 1]` for segments.
    pub range: [f64; 2],
    /// The largest distance of a start from the origin.
    pub reach: f64,
    /// The lengths of the shortest and of the longest direction.
    pub lengths: [f64; 2],
    /// direction × start: zero where all rays start at the origin.
    moment: Vectors,
    /// The middle of each octet's directions and moments, and the largest distance from there.
    middle: [vectors::Vectors<f64, OCTETS>; 2],
    spread: [[f64; OCTETS]; 2],
}

/// An edge's function of a ray: on which side of the edge it passes, as D·`across` − (D×S)·`along`.
#[derive(Clone, Copy)]
pub struct EdgeSide {
    /// The product of the edge's ends, relative to the packet's origin.
    pub across: Vector,
    /// The vector from one end to the other.
    pub along: Vector,
}

impl RayPacket {
    /// Without rays.
    pub fn new() -> Box<Self> {
        let zeros = [[0.0; RAYS]; 3];
        Box::new(Self {
            origin: Vector::default(),
            start: zeros,
            direction: zeros,
            in_use: 0,
            range: [0.0, 1.0],
            reach: 0.0,
            lengths: [0.0; 2],
            moment: zeros,
            middle: [[[0.0; OCTETS]; 3]; 2],
            spread: [[0.0; OCTETS]; 2],
        })
    }

    /// Sets a ray.
    #[inline(always)]
    pub fn set(&mut self, ray: usize, start: Vector, direction: Vector) {
        put(start, ray, &mut self.start);
        put(direction, ray, &mut self.direction);
    }

    /// A ray, whose direction is a unit vector.
    pub fn ray(&self, index: usize) -> Ray {
        Ray { anchor: self.origin, offset: self.start_of(index), direction: self.direction_of(index) }
    }

    /// The start of a ray, relative to the origin.
    pub fn start_of(&self, ray: usize) -> Vector {
        get(&self.start, ray)
    }

    /// The direction of a ray.
    pub fn direction_of(&self, ray: usize) -> Vector {
        get(&self.direction, ray)
    }

    /// Derives what the tests need, once `in_use` and the rays in use are set; there must be one.
    #[inline(always)]
    pub fn finish<V: Lane<Element = f64>>(&mut self, token: V::Token) {
        let in_use = self.in_use;
        let any = in_use.trailing_zeros() as usize;
        for octet in 0..OCTETS {
            let used = in_use >> (octet * OCTET) & 0xff;
            let source = if used == 0 { any } else { octet * OCTET + used.trailing_zeros() as usize };
            for ray in (octet * OCTET..(octet + 1) * OCTET).filter(|ray| in_use >> ray & 1 == 0) {
                self.set(ray, self.start_of(source), self.direction_of(source));
            }
        }
        let zero = V::splat(token, 0.0);
        let (mut reach, mut longest, mut shortest) = (zero, zero, V::splat(token, f64::MAX));
        for at in (0..RAYS).step_by(V::COUNT) {
            let (start, direction) = (load::<V, _>(token, at, &self.start), load::<V, _>(token, at, &self.direction));
            store(direction.cross(start), at, &mut self.moment);
            reach = reach.max(start.dot(start));
            let square = direction.dot(direction);
            (longest, shortest) = (longest.max(square), shortest.min(square));
        }
        self.reach = greatest_of(reach).sqrt();
        self.lengths = [least_of(shortest).sqrt(), greatest_of(longest).sqrt()];
        for octet in 0..OCTETS {
            let rays = octet * OCTET..(octet + 1) * OCTET;
            for (of, vectors) in [&self.direction, &self.moment].into_iter().enumerate() {
                let mut square = 0.0;
                for (numbers, middle) in vectors.iter().zip(&mut self.middle[of]) {
                    let numbers = &numbers[rays.clone()];
                    let (mut low, mut high) = (numbers[0], numbers[0]);
                    for number in numbers {
                        (low, high) = (low.min(*number), high.max(*number));
                    }
                    middle[octet] = 0.5 * (low + high);
                    let half = 0.5 * (high - low);
                    square += half * half;
                }
                self.spread[of][octet] = square.sqrt();
            }
        }
    }

    /// Whether all rays start at the origin.
    pub fn is_central(&self) -> bool {
        self.reach == 0.0
    }

    /// The boxes of the starts and of the points at this t.
    #[inline(always)]
    pub fn ends<V: Lane<Element = f64>>(&self, token: V::Token, t: f64) -> [Bounds; 2] {
        let t = V::splat(token, t);
        let (mut starts, mut ends) = (Range::none(token), Range::none(token));
        for at in (0..RAYS).step_by(V::COUNT) {
            let start = load::<V, _>(token, at, &self.start);
            starts.widen(start);
            ends.widen(load::<V, _>(token, at, &self.direction).mul_add(t, start));
        }
        [starts.bounds(self.origin), ends.bounds(self.origin)]
    }

    /// S and D of some rays.
    #[inline(always)]
    pub fn rays<V: Lane<Element = f64>>(&self, token: V::Token, at: usize) -> [Vector<V>; 2] {
        [load(token, at, &self.start), load(token, at, &self.direction)]
    }

    /// On which side of an edge some rays pass.
    #[inline(always)]
    pub fn side<V: Lane<Element = f64>>(&self, token: V::Token, at: usize, edge: &EdgeSide) -> V {
        let side = load::<V, _>(token, at, &self.direction).dot(splat(token, edge.across));
        if self.is_central() {
            return side;
        }
        side - load::<V, _>(token, at, &self.moment).dot(splat(token, edge.along))
    }

    /// The range of that function over each octet: of some octets, its middle and half its width.
    #[inline(always)]
    pub fn side_of_octets<V: Lane<Element = f64>>(&self, token: V::Token, at: usize, edge: &EdgeSide) -> [V; 2] {
        let direction = load::<V, _>(token, at, &self.middle[0]);
        let of_direction = V::load(token, &self.spread[0][at..]);
        let middle = direction.dot(splat(token, edge.across));
        let half = of_direction * V::splat(token, edge.across.length());
        if self.is_central() {
            return [middle, half];
        }
        let moment = load::<V, _>(token, at, &self.middle[1]);
        let of_moment = V::load(token, &self.spread[1][at..]);
        let middle = middle - moment.dot(splat(token, edge.along));
        [middle, of_moment.mul_add(V::splat(token, edge.along.length()), half)]
    }
}

/// The ranges of coordinates, lane by lane.
struct Range<V> {
    least: Vector<V>,
    greatest: Vector<V>,
}

impl<V: Lane<Element = f64>> Range<V> {
    #[inline(always)]
    fn none(token: V::Token) -> Self {
        let (most, least) = (V::splat(token, f64::MAX), V::splat(token, f64::MIN));
        Self { least: Vector::new(most, most, most), greatest: Vector::new(least, least, least) }
    }

    #[inline(always)]
    fn widen(&mut self, point: Vector<V>) {
        let Self { least, greatest } = self;
        *least = Vector::new(least.x.min(point.x), least.y.min(point.y), least.z.min(point.z));
        *greatest = Vector::new(greatest.x.max(point.x), greatest.y.max(point.y), greatest.z.max(point.z));
    }

    #[inline(always)]
    fn bounds(self, origin: Vector) -> Bounds {
        let Self { least, greatest } = self;
        let least = Vector::new(least_of(least.x), least_of(least.y), least_of(least.z));
        let greatest = Vector::new(greatest_of(greatest.x), greatest_of(greatest.y), greatest_of(greatest.z));
        Bounds { least: origin + least, greatest: origin + greatest }
    }
}

/// Whether any bit of an octet is set.
#[inline(always)]
pub fn has_any_of(bits: u64, octet: usize) -> bool {
    bits >> (octet * OCTET) << (RAYS - OCTET) != 0
}
