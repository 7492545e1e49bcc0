//! Rays that are traced together.

use crate::lanes::Lane;
use crate::ray::Ray;
use crate::shape::Bounds;
use crate::vector::Vector;

/// The number of rays in a packet.
pub const RAYS: usize = 64;

/// Neighbouring rays that are skipped together.
pub const OCTET: usize = 8;

/// The number of octets in a packet.
const OCTETS: usize = RAYS / OCTET;

/// A vector per ray, by axis.
pub type Vectors = [[f64; RAYS]; 3];

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
    middle: [[[f64; OCTETS]; 3]; 2],
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
        put(&mut self.start, ray, start);
        put(&mut self.direction, ray, direction);
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
            let (start, direction) = (load::<V>(token, &self.start, at), load::<V>(token, &self.direction, at));
            store(&mut self.moment, at, direction.cross(start));
            reach = reach.max(start.dot(start));
            let square = direction.dot(direction);
            (longest, shortest) = (longest.max(square), shortest.min(square));
        }
        self.reach = largest(reach).sqrt();
        self.lengths = [(-largest(-shortest)).sqrt(), largest(longest).sqrt()];
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
            let start = load::<V>(token, &self.start, at);
            starts.widen(start);
            ends.widen(load::<V>(token, &self.direction, at).mul_add(t, start));
        }
        [starts.bounds(self.origin), ends.bounds(self.origin)]
    }

    /// S and D of some rays.
    #[inline(always)]
    pub fn rays<V: Lane<Element = f64>>(&self, token: V::Token, at: usize) -> [Vector<V>; 2] {
        [load(token, &self.start, at), load(token, &self.direction, at)]
    }

    /// On which side of an edge some rays pass.
    #[inline(always)]
    pub fn side<V: Lane<Element = f64>>(&self, token: V::Token, at: usize, edge: &EdgeSide) -> V {
        let side = load::<V>(token, &self.direction, at).dot(splat(token, edge.across));
        if self.is_central() {
            return side;
        }
        side - load::<V>(token, &self.moment, at).dot(splat(token, edge.along))
    }

    /// The range of that function over each octet: of some octets, its middle and half its width.
    #[inline(always)]
    pub fn side_of_octets<V: Lane<Element = f64>>(&self, token: V::Token, at: usize, edge: &EdgeSide) -> [V; 2] {
        let direction = of_octets::<V>(token, &self.middle[0], at);
        let of_direction = V::load(token, &self.spread[0][at..]);
        let middle = direction.dot(splat(token, edge.across));
        let half = of_direction * V::splat(token, edge.across.length());
        if self.is_central() {
            return [middle, half];
        }
        let moment = of_octets::<V>(token, &self.middle[1], at);
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
        let least = Vector::new(-largest(-least.x), -largest(-least.y), -largest(-least.z));
        let greatest = Vector::new(largest(greatest.x), largest(greatest.y), largest(greatest.z));
        Bounds { least: origin + least, greatest: origin + greatest }
    }
}

#[inline(always)]
fn of_octets<V: Lane<Element = f64>>(token: V::Token, [x, y, z]: &[[f64; OCTETS]; 3], at: usize) -> Vector<V> {
    Vector::new(V::load(token, &x[at..]), V::load(token, &y[at..]), V::load(token, &z[at..]))
}

/// Whether any bit of an octet is set.
#[inline(always)]
pub fn has_any_of(bits: u64, octet: usize) -> bool {
    bits >> (octet * OCTET) << (RAYS - OCTET) != 0
}

/// Writes a vector.
#[inline(always)]
pub fn put([x, y, z]: &mut Vectors, at: usize, vector: Vector) {
    (x[at], y[at], z[at]) = (vector.x, vector.y, vector.z);
}

/// Reads a vector.
#[inline(always)]
pub fn get([x, y, z]: &Vectors, at: usize) -> Vector {
    Vector::new(x[at], y[at], z[at])
}

/// Reads some vectors.
#[inline(always)]
pub fn load<V: Lane<Element = f64>>(token: V::Token, [x, y, z]: &Vectors, at: usize) -> Vector<V> {
    Vector::new(V::load(token, &x[at..]), V::load(token, &y[at..]), V::load(token, &z[at..]))
}

/// Writes some vectors.
#[inline(always)]
pub fn store<V: Lane<Element = f64>>([x, y, z]: &mut Vectors, at: usize, vectors: Vector<V>) {
    vectors.x.store(&mut x[at..]);
    vectors.y.store(&mut y[at..]);
    vectors.z.store(&mut z[at..]);
}

/// The same vector in every lane.
#[inline(always)]
pub fn splat<V: Lane<Element = f64>>(token: V::Token, vector: Vector) -> Vector<V> {
    Vector::new(V::splat(token, vector.x), V::splat(token, vector.y), V::splat(token, vector.z))
}

/// The largest number of a vector.
#[inline(always)]
fn largest<V: Lane<Element = f64>>(numbers: V) -> f64 {
    let mut all = [f64::NEG_INFINITY; 16];
    numbers.store(&mut all);
    let mut largest = all[0];
    for number in &all[1..V::COUNT] {
        largest = if *number > largest { *number } else { largest };
    }
    largest
}
