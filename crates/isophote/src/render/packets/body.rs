//! A shape without parts as the rays of a packet meet it.
//!
//! As for triangles, only what is certain is decided here, with margins for every rounding error.

use super::rays::RayPacket;
use super::triangle::Met;
use crate::lanes::Lane;
use crate::render::vectors::splat;
use crate::shape::{Body, Form};
use crate::vector::Vector;

/// A body relative to a packet.
pub struct PacketBody {
    body: Body,
    /// From the body's origin to the packet's, in the body's coordinates.
    start: Vector,
    /// The possible rounding errors of the coordinates of starts and of directions.
    error: f64,
    direction_error: f64,
}

/// In lanes, the parts of rays' lines that are inside a body: bounds on t where they begin and where they end.
struct Inside<V> {
    enter: [V; 2],
    leave: [V; 2],
}

/// In lanes, rays in the coordinates of a body.
struct LocalRays<V> {
    start: Vector<V>,
    direction: Vector<V>,
}

/// Where some rays meet a body first.
pub struct First<V> {
    /// t.
    pub t: V,
    /// Its possible error.
    pub error: V,
    /// Which of them do.
    pub met: Met,
}

/// Roundings that go into a coordinate, in units of ε.
const ROUNDINGS: f64 = 16.0 * f64::EPSILON;

/// Beyond everything.
const NEVER: f64 = 1e200;

impl PacketBody {
    /// From a body in metres.
    #[inline(always)]
    pub fn new(body: Body, packet: &RayPacket) -> Self {
        let from_origin = packet.origin - body.origin;
        let [x, y, z] = &body.axes;
        let start = Vector::new(x.dot(from_origin), y.dot(from_origin), z.dot(from_origin));
        let stretch = x.length().max(y.length()).max(z.length());
        let error = ROUNDINGS * (stretch * (from_origin.length() + packet.reach) + body.size);
        Self { body, start, error, direction_error: ROUNDINGS * stretch * packet.lengths[1] }
    }

    #[inline(always)]
    fn local<V: Lane<Element = f64>>(&self, token: V::Token, packet: &RayPacket, at: usize) -> LocalRays<V> {
        let [start, direction] = packet.rays::<V>(token, at);
        let [x, y, z] = &self.body.axes;
        let (x, y, z) = (splat::<V>(token, *x), splat::<V>(token, *y), splat::<V>(token, *z));
        let direction = Vector::new(x.dot(direction), y.dot(direction), z.dot(direction));
        let mut at_origin = splat::<V>(token, self.start);
        if !packet.is_central() {
            at_origin = at_origin + Vector::new(x.dot(start), y.dot(start), z.dot(start));
        }
        LocalRays { start: at_origin, direction }
    }

    /// Where some rays meet it first.
    #[inline(always)]
    pub fn first<V: Lane<Element = f64>>(&self, token: V::Token, packet: &RayPacket, at: usize) -> First<V> {
        let Inside { enter, leave } = self.inside(token, &self.local::<V>(token, packet, at));
        let zero = V::splat(token, 0.0);
        let passes = V::bits(enter[1].is_less(leave[0]));
        let may_pass = V::bits_not(leave[1].is_less(enter[0])) & V::bits_not(leave[1].is_less(zero));
        let is_outside = zero.is_less(enter[0]);
        let is_inside = V::bits(enter[1].is_less(zero)) & V::bits(zero.is_less(leave[0]));
        let surely = passes & (V::bits(is_outside) | is_inside);
        let low = V::select(is_outside, enter[0], leave[0]);
        let high = V::select(is_outside, enter[1], leave[1]);
        let half = V::splat(token, 0.5);
        First { t: (low + high) * half, error: (high - low) * half, met: Met { surely, maybe: may_pass & !surely } }
    }

    /// Which rays certainly cross its surface with t in a range, and which may; at the ends of the range, t is uncertain by
    /// this margin.
    #[inline(always)]
    pub fn met<V: Lane<Element = f64>>(
        &self,
        token: V::Token,
        packet: &RayPacket,
        at: usize,
        [first, last]: [f64; 2],
        margin: f64,
    ) -> Met {
        let Inside { enter, leave } = self.inside(token, &self.local::<V>(token, packet, at));
        let passes = V::bits(enter[1].is_less(leave[0]));
        let may_pass = V::bits_not(leave[1].is_less(enter[0]));
        let (soonest, latest) = (V::splat(token, first + margin), V::splat(token, last - margin));
        let surely = passes & (within(enter, soonest, latest) | within(leave, soonest, latest));
        let (soonest, latest) = (V::splat(token, first - margin), V::splat(token, last + margin));
        Met {
            surely,
            maybe: may_pass & (may_be_within(enter, soonest, latest) | may_be_within(leave, soonest, latest)) & !surely,
        }
    }

    #[inline(always)]
    fn inside<V: Lane<Element = f64>>(&self, token: V::Token, rays: &LocalRays<V>) -> Inside<V> {
        let LocalRays { start, direction } = rays;
        let zero = V::splat(token, 0.0);
        match self.body.form {
            Form::Ball => self.round(token, rays, [1.0, 0.0, 1.0]),
            Form::Box(half) => {
                let x = self.slab(token, start.x, direction.x, [-half.x, half.x]);
                let y = self.slab(token, start.y, direction.y, [-half.y, half.y]);
                let z = self.slab(token, start.z, direction.z, [-half.z, half.z]);
                x.and(&y).and(&z)
            }
            Form::Cone { radius, slope, height } => {
                let ends = self.slab(token, start.z, direction.z, [0.0, height]);
                self.round(token, rays, [radius, slope, 0.0]).and(&ends)
            }
            Form::Plane => self.flat(
                token,
                rays,
                #[inline(always)]
                |_, _| V::splat(token, NEVER),
            ),
            Form::Rectangle([width, height]) => self.flat(
                token,
                rays,
                #[inline(always)]
                |x, y| {
                    let across = V::splat(token, width) - x.max(-x);
                    across.min(V::splat(token, height) - y.max(-y))
                },
            ),
            Form::Disk(radius) => self.flat(
                token,
                rays,
                #[inline(always)]
                |x, y| V::splat(token, radius) - y.mul_add(y, x * x).max(zero).sqrt(),
            ),
        }
    }

    /// Between two planes.
    #[inline(always)]
    fn slab<V: Lane<Element = f64>>(
        &self,
        token: V::Token,
        start: V,
        direction: V,
        [low, high]: [f64; 2],
    ) -> Inside<V> {
        let (low, high) = (V::splat(token, low) - start, V::splat(token, high) - start);
        let error = V::splat(token, self.error);
        let never = V::splat(token, NEVER);
        let size = direction.max(-direction);
        let direction_error = V::splat(token, self.direction_error);
        // So small a component is only rounding error: the ray stays between the planes, or outside.
        let is_parallel = size.is_less(direction_error);
        let inverse = V::splat(token, 1.0) / V::select(is_parallel, V::splat(token, 1.0), direction);
        let (first, last) = (low * inverse, high * inverse);
        let (near, far) = (first.min(last), first.max(last));
        let latest = near.max(-near).max(far.max(-far));
        let spread = latest.mul_add(direction_error, error) * inverse.max(-inverse);
        // On its way past the body, such a ray moves by no more than that.
        let error = error * V::splat(token, 4.0);
        let clearance = (-low).min(high);
        let inside = V::select(error.is_less(clearance), -never, never);
        let outside = V::select(clearance.is_less(-error), never, -never);
        Inside {
            enter: [V::select(is_parallel, outside, near - spread), V::select(is_parallel, inside, near + spread)],
            leave: [V::select(is_parallel, -inside, far - spread), V::select(is_parallel, -outside, far + spread)],
        }
    }

    /// Within x² + y² + wz² = (R + kz)², given R, k and w.
    #[inline(always)]
    fn round<V: Lane<Element = f64>>(
        &self,
        token: V::Token,
        rays: &LocalRays<V>,
        [radius, slope, weight]: [f64; 3],
    ) -> Inside<V> {
        let LocalRays { start, direction } = rays;
        let (slope_there, weight) = (V::splat(token, slope), V::splat(token, weight));
        let radius_there = slope_there.mul_add(start.z, V::splat(token, radius));
        let widening = slope_there * direction.z;
        let a = product(weight, direction, direction) - widening * widening;
        let b = product(weight, start, direction) - widening * radius_there;
        let c = product(weight, start, start) - radius_there * radius_there;
        let discriminant = b * b - a * c;
        let growth = 1.0 + slope * slope;
        let (square, along) = (direction.dot(*direction), start.dot(*start));
        let reach = (along + V::splat(token, radius * radius)) * V::splat(token, growth);
        let (speed, radius_of_reach) = (square.sqrt(), reach.sqrt());
        let [error, direction_error] = [self.error, self.direction_error];
        let by_product = V::splat(token, 4.0 * ROUNDINGS * growth) * square * reach;
        let by_start = V::splat(token, 8.0 * error * growth) * square * radius_of_reach;
        let by_direction = V::splat(token, 4.0 * direction_error * growth) * speed * reach;
        let lost = by_product + by_start + by_direction;
        let zero = V::splat(token, 0.0);
        let never = V::splat(token, NEVER);
        let is_there = (lost * V::splat(token, 4.0)).is_less(discriminant);
        let root = V::select(is_there, discriminant, lost * V::splat(token, 4.0)).sqrt();
        let inverse = V::splat(token, 1.0) / a;
        let middle = -(b * inverse);
        let half = root * inverse;
        let of_numerator = V::splat(token, 2.0 * ROUNDINGS) * speed * radius_of_reach
            + V::splat(token, direction_error) * radius_of_reach
            + V::splat(token, error) * speed;
        let of_quotient = (V::splat(token, 2.0 * ROUNDINGS * growth) * square
            + V::splat(token, 2.0 * direction_error * growth) * speed)
            * inverse;
        let spread = (middle.max(-middle) + half).mul_add(of_quotient, (lost / root + of_numerator) * inverse);
        let (near, far) = (middle - half, middle + half);
        // Steep rays of a cone, and those along a cylinder, are left to others.
        let is_regular = (square * V::splat(token, 1e-4)).is_less(a);
        let misses = V::select(is_regular, V::select(discriminant.is_less(-lost), never, -never), -never);
        let is_sure = both::<V>(is_regular, is_there, zero);
        Inside {
            enter: [V::select(is_sure, near - spread, misses), V::select(is_sure, near + spread, never)],
            leave: [V::select(is_sure, far - spread, -never), V::select(is_sure, far + spread, -misses)],
        }
    }

    /// On the plane z = 0, as far inside an edge as a function of x and y tells.
    #[inline(always)]
    fn flat<V: Lane<Element = f64>>(
        &self,
        token: V::Token,
        rays: &LocalRays<V>,
        clearance: impl Fn(V, V) -> V,
    ) -> Inside<V> {
        let LocalRays { start, direction } = rays;
        let never = V::splat(token, NEVER);
        let error = V::splat(token, self.error);
        let size = direction.z.max(-direction.z);
        let inverse = V::splat(token, 1.0) / direction.z;
        let t = -(start.z * inverse);
        let length = direction.dot(*direction).sqrt();
        let direction_error = V::splat(token, self.direction_error);
        let error = t.max(-t).mul_add(direction_error, error);
        let spread = error * inverse.max(-inverse);
        let (x, y) = (direction.x.mul_add(t, start.x), direction.y.mul_add(t, start.y));
        let inside = clearance(x, y);
        let unsure = error + spread * length;
        // Seen edge-on.
        let is_steep = (length * V::splat(token, 1e-9)).is_less(size);
        let zero = V::splat(token, 0.0);
        let (soonest, latest) = (t - spread, t + spread);
        let is_hit = both::<V>(is_steep, unsure.is_less(inside), zero);
        let is_hit = both::<V>(is_hit, zero.is_less(soonest), zero);
        // Certainly beside it or behind the start; or seen edge-on, from outside its plane.
        let is_beside = V::select(inside.is_less(-unsure), never, V::select(latest.is_less(zero), never, -never));
        let is_above = V::select(V::splat(token, 4.0 * self.error).is_less(start.z.max(-start.z)), never, -never);
        let misses = V::select(is_steep, is_beside, V::select(size.is_less(direction_error), is_above, -never));
        // There is nothing to leave.
        let endless = V::splat(token, f64::INFINITY);
        Inside {
            enter: [V::select(is_hit, soonest, misses), V::select(is_hit, latest, never)],
            leave: [V::select(is_hit, endless, -never), V::select(is_hit, endless, -misses)],
        }
    }
}

impl<V: Lane<Element = f64>> Inside<V> {
    /// What is inside another body too.
    #[inline(always)]
    fn and(&self, other: &Self) -> Self {
        Self {
            enter: [self.enter[0].max(other.enter[0]), self.enter[1].max(other.enter[1])],
            leave: [self.leave[0].min(other.leave[0]), self.leave[1].min(other.leave[1])],
        }
    }
}

/// The lanes that both masks are set in; `zero` is in all lanes.
#[inline(always)]
fn both<V: Lane<Element = f64>>(first: V::Mask, second: V::Mask, zero: V) -> V::Mask {
    zero.is_less(V::select(first, V::select(second, zero.splat_like(1.0), zero), zero))
}

/// The lanes in which a range is certainly between two numbers, as bits.
#[inline(always)]
fn within<V: Lane<Element = f64>>([low, high]: [V; 2], soonest: V, latest: V) -> u32 {
    V::bits(soonest.is_less(low)) & V::bits(high.is_less(latest))
}

/// The lanes in which something of a range may be between two numbers, as bits.
#[inline(always)]
fn may_be_within<V: Lane<Element = f64>>([low, high]: [V; 2], soonest: V, latest: V) -> u32 {
    V::bits_not(high.is_less(soonest)) & V::bits_not(latest.is_less(low))
}

/// x x' + y y' + w z z'.
#[inline(always)]
fn product<V: Lane<Element = f64>>(weight: V, first: &Vector<V>, second: &Vector<V>) -> V {
    let flat = first.y.mul_add(second.y, first.x * second.x);
    (weight * first.z).mul_add(second.z, flat)
}
