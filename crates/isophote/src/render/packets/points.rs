//! The points that rays hit, once it is known which primitive each of them hits.
//!
//! They are computed in lanes of 32 digits: the accuracy of a double, which the result has, is then enough for any highlight.

use super::precise::{PreciseRays, Way, exact, exact_number, exactly, nearest};
use super::rays::{OCTET, OCTETS, RAYS, Vectors, has_any_of};
use super::set_bits;
use crate::double_double::DoubleDouble;
use crate::lanes::{Lane, LaneJob, SimdToken};
use crate::prepare::Hit;
use crate::real::Real;
use crate::render::vectors::{get, load, put, splat};
use crate::shape::{Cone, Cuboid, Ellipsoid, Geometry, Placement, Primitive, Sphere, SurfacePoint};
use crate::vector::Vector;

/// The points of some rays, by axis.
pub struct Points {
    offset: Vectors,
    normal: Vectors,
    cos_theta_o: [f64; RAYS],
    distance: [f64; RAYS],
    shadow_ray_offset: Vectors,
    from_inside: u64,
    /// The rays for which a double is not enough.
    doubtful: u64,
    /// The corners of the triangles. Of other shapes, the first one is the anchor of the points; of spheres, which is the centre,
    /// the second one holds the radius.
    corners: [Vectors; 3],
    normals: [Vectors; 3],
}

impl Points {
    /// No points.
    pub fn new() -> Box<Self> {
        let zeros = [[0.0; RAYS]; 3];
        Box::new(Self {
            offset: zeros,
            normal: zeros,
            cos_theta_o: [0.0; RAYS],
            distance: [0.0; RAYS],
            shadow_ray_offset: zeros,
            from_inside: 0,
            doubtful: 0,
            corners: [zeros; 3],
            normals: [zeros; 3],
        })
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        (self.from_inside, self.doubtful) = (0, 0);
    }

    /// The point of a ray on a primitive; `None` if it takes more than a double.
    pub fn hit(&self, ray: usize, primitive: Primitive, rays: &PreciseRays<'_>) -> Option<Hit> {
        if self.doubtful >> ray & 1 == 1 {
            return None;
        }
        let point = SurfacePoint {
            anchor: get(&self.corners[0], ray),
            offset: get(&self.offset, ray),
            normal: get(&self.normal, ray),
            view: -rays.direction_of(ray),
            cos_theta_o: self.cos_theta_o[ray],
        };
        Some(Hit {
            primitive,
            distance: self.distance[ray],
            point,
            from_inside: self.from_inside >> ray & 1 == 1,
            shadow_ray_offset: get(&self.shadow_ray_offset, ray),
        })
    }
}

/// Computes the points of some rays, all on one shape.
pub struct FindPoints<'f, 'a> {
    /// The rays.
    pub rays: &'f PreciseRays<'a>,
    /// Those on the shape, as bits.
    pub on_shape: u64,
    /// The shape.
    pub geometry: &'f Geometry,
    /// The primitive that each of them hits.
    pub primitives: &'f [Primitive; RAYS],
    /// Where the points go.
    pub points: &'f mut Points,
}

/// The place of a flat shape.
fn flat(geometry: &Geometry) -> Option<&Placement> {
    match geometry {
        Geometry::Plane(plane) => Some(plane.placement()),
        Geometry::Rectangle(rectangle) => Some(rectangle.placement()),
        Geometry::Disk(disk) => Some(disk.placement()),
        _ => None,
    }
}

impl LaneJob for FindPoints<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<S, D>(mut self, token: S::Token)
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>,
    {
        let is_smooth = self.gather();
        for at in (0..RAYS).step_by(D::Narrow::COUNT) {
            let lanes = self.on_shape >> at & ((1 << D::Narrow::COUNT) - 1);
            if lanes == 0 {
                continue;
            }
            // Each kind in a function of its own, which compiles sooner.
            match self.geometry {
                Geometry::Mesh(_) => token.in_own_function(
                    #[inline(always)]
                    || self.on_triangles::<D::Narrow>(token, at, lanes, is_smooth),
                ),
                Geometry::Sphere(_) | Geometry::Spheres(_) => token.in_own_function(
                    #[inline(always)]
                    || self.on_spheres::<D::Narrow>(token, at, lanes),
                ),
                Geometry::Ellipsoid(ellipsoid) => token.in_own_function(
                    #[inline(always)]
                    || self.on_ellipsoid::<D::Narrow>(token, at, lanes, ellipsoid),
                ),
                Geometry::Cuboid(cuboid) => token.in_own_function(
                    #[inline(always)]
                    || self.on_box::<D::Narrow>(token, at, lanes, cuboid),
                ),
                Geometry::Cylinder(_) | Geometry::Cone(_) => token.in_own_function(
                    #[inline(always)]
                    || self.on_cone::<D::Narrow>(token, at, lanes),
                ),
                Geometry::Plane(_) | Geometry::Rectangle(_) | Geometry::Disk(_) => token.in_own_function(
                    #[inline(always)]
                    || self.on_plane::<D::Narrow>(token, at, lanes),
                ),
            }
        }
    }
}

/// The numbers of a box's axes, in lanes.
const AXES: [f64; 3] = [0.0, 1.0, 2.0];

/// In lanes, the points of some rays.
struct Found<V> {
    offset: Vector<V>,
    normal: Vector<V>,
    cos_theta_o: V,
    distance: V,
    shadow_ray_offset: Vector<V>,
}

impl FindPoints<'_, '_> {
    /// Looks up where the shape is; returns whether it is made of triangles that have normals.
    fn gather(&mut self) -> bool {
        let mut is_smooth = false;
        let origin = self.geometry.body(0).map(|body| body.origin).unwrap_or_default();
        for ray in set_bits(self.on_shape) {
            let part = self.primitives[ray].part;
            let (corners, normals) = match self.geometry {
                Geometry::Mesh(mesh) => mesh.corners_and_normals(part),
                Geometry::Sphere(sphere) => (of_sphere(sphere), None),
                Geometry::Spheres(cloud) => (of_sphere(&cloud.spheres[part as usize]), None),
                _ => ([origin; 3], None),
            };
            for (out, corner) in self.points.corners.iter_mut().zip(corners) {
                put(corner, ray, out);
            }
            for (out, normal) in self.points.normals.iter_mut().zip(normals.into_iter().flatten()) {
                put(normal, ray, out);
                is_smooth = true;
            }
        }
        // The other lanes of a vector compute something too.
        let any = self.on_shape.trailing_zeros() as usize;
        for octet in (0..OCTETS).filter(|octet| has_any_of(self.on_shape, *octet)) {
            for ray in (octet * OCTET..(octet + 1) * OCTET).filter(|ray| self.on_shape >> ray & 1 == 0) {
                for vectors in self.points.corners.iter_mut().chain(&mut self.points.normals) {
                    let vector = get(vectors, any);
                    put(vector, ray, vectors);
                }
            }
        }
        is_smooth
    }

    /// Keeps the points of some lanes.
    #[inline(always)]
    fn keep<V: Lane<Element = f64>>(&mut self, at: usize, lanes: u64, found: &Found<V>, doubtful: u32) {
        let Points { offset, normal, cos_theta_o, distance, shadow_ray_offset, doubtful: all, .. } = self.points;
        *all |= (u64::from(doubtful) & lanes) << at;
        keep(at, lanes, found.cos_theta_o, cos_theta_o);
        keep(at, lanes, found.distance, distance);
        keep_vectors(at, lanes, found.offset, offset);
        keep_vectors(at, lanes, found.normal, normal);
        keep_vectors(at, lanes, found.shadow_ray_offset, shadow_ray_offset);
    }

    /// The points of triangles (2.5).
    #[inline(always)]
    fn on_triangles<V: Lane<Element = f64>>(&mut self, token: V::Token, at: usize, lanes: u64, is_smooth: bool) {
        let Way { start, along, direction } = self.rays.way::<V>(token, at);
        let [a, b, c] = &self.points.corners;
        let corners = [load::<V, _>(token, at, a), load::<V, _>(token, at, b), load::<V, _>(token, at, c)];
        let wide = [exactly(corners[0]), exactly(corners[1]), exactly(corners[2])];
        let seen = [wide[0] - start, wide[1] - start, wide[2] - start];
        let edges =
            [along.dot(seen[1].cross(seen[2])), along.dot(seen[2].cross(seen[0])), along.dot(seen[0].cross(seen[1]))];
        let whole = edges[0] + edges[1] + edges[2];
        let inverse = whole.splat_like(1.0) / whole;
        let weights = [(edges[0] * inverse).nearest(), (edges[1] * inverse).nearest(), (edges[2] * inverse).nearest()];
        let sides = [corners[1] - corners[0], corners[2] - corners[0]];
        let offset = sides[0] * weights[1] + sides[1] * weights[2];
        let across = (wide[1] - wide[0]).cross(wide[2] - wide[0]);
        let face = nearest(across).normalized();
        let zero = V::splat(token, 0.0);
        let negligible = V::splat(token, 1e-14);
        let slope = face.dot(direction);
        let towards_eye = V::select(zero.is_less(slope), V::splat(token, -1.0), V::splat(token, 1.0));
        let none = Vector::new(zero, zero, zero);
        let (normal, shadow_ray_offset, mut doubtful) = if is_smooth {
            let [a, b, c] = &self.points.normals;
            let filled = [
                or_else(load::<V, _>(token, at, a), face),
                or_else(load::<V, _>(token, at, b), face),
                or_else(load::<V, _>(token, at, c), face),
            ];
            let mixed = filled[0] * weights[0] + filled[1] * weights[1] + filled[2] * weights[2];
            let square = mixed.dot(mixed);
            let side = mixed.dot(face);
            // The normals determine which side is the front; then all of them are turned to the viewer's side together.
            let turn = V::select(side.is_less(zero), -towards_eye, towards_eye);
            let normal = mixed * (turn / square.sqrt());
            let corners = [none, sides[0], sides[1]];
            let mut shadow_ray_offset = none;
            for corner in 0..3 {
                let normal = filled[corner] * turn;
                let below = (-(offset - corners[corner]).dot(normal)).max_zero();
                shadow_ray_offset = shadow_ray_offset + normal * (below * weights[corner]);
            }
            let doubtful =
                V::bits(square.is_less(V::splat(token, 1e-6))) | V::bits_not(negligible.is_less(side.max(-side)));
            (normal, shadow_ray_offset, doubtful)
        } else {
            (face * towards_eye, none, 0)
        };
        let cos_theta_o = -normal.dot(direction);
        doubtful |= V::bits_not(negligible.is_less(cos_theta_o.max(-cos_theta_o)));
        doubtful |= V::bits_not(negligible.is_less(slope.max(-slope)));
        let distance = (nearest(seen[0]) + offset).dot(direction);
        let found = Found { offset, normal, cos_theta_o, distance, shadow_ray_offset };
        self.keep(at, lanes, &found, doubtful);
    }

    /// The points of a flat shape, which the third axis of its placement is normal to.
    #[inline(always)]
    fn on_plane<V: Lane<Element = f64>>(&mut self, token: V::Token, at: usize, lanes: u64) {
        let Some(placement) = flat(self.geometry) else { return };
        let way = self.rays.way::<V>(token, at);
        let along = way.along;
        let start = way.start - exact::<V>(token, Vector::from_f64(placement.origin));
        let [first, second, third] = placement.axes::<DoubleDouble>();
        let (first, second) = (exact::<V>(token, first), exact::<V>(token, second));
        let third = exact::<V>(token, third);
        let (height, slope) = (start.dot(third), along.dot(third));
        let parameter = -(height / slope);
        let place = along.mul_add(parameter, start);
        let [x, y] = [place.dot(first).nearest(), place.dot(second).nearest()];
        let offset = nearest(first) * x + nearest(second) * y;
        let found = Self::facing::<V>(token, &way, offset, nearest(third), parameter.nearest());
        self.keep(at, lanes, &found, 0);
    }

    /// The points of a box.
    #[inline(always)]
    fn on_box<V: Lane<Element = f64>>(&mut self, token: V::Token, at: usize, lanes: u64, cuboid: &Cuboid) {
        let way = self.rays.way::<V>(token, at);
        let along = way.along;
        let placement = cuboid.placement();
        let start = way.start - exact::<V>(token, Vector::from_f64(placement.origin));
        let [x, y, z] = placement.axes::<DoubleDouble>();
        let (x, y, z) = (exact::<V>(token, x), exact::<V>(token, y), exact::<V>(token, z));
        let local = [(start.dot(x), along.dot(x)), (start.dot(y), along.dot(y)), (start.dot(z), along.dot(z))];
        let half = cuboid.half_sides().to_array();
        let zero = V::splat(token, 0.0);
        let wide_zero = DoubleDouble::exactly(zero);
        // The face through which the ray enters, and the one through which it leaves.
        let mut enter = (DoubleDouble::exactly(V::splat(token, f64::MIN)), zero, zero);
        let mut leave = (DoubleDouble::exactly(V::splat(token, f64::MAX)), zero, zero);
        for axis in 0..3 {
            let (start, along) = local[axis];
            // So small a component never reaches a face.
            let smallest = V::splat(token, 1e-250);
            let is_parallel = along.nearest().max(-along.nearest()).is_less(smallest);
            let along = DoubleDouble::select(is_parallel, DoubleDouble::exactly(smallest), along);
            let side =
                V::select(along.nearest().is_less(zero), V::splat(token, half[axis]), V::splat(token, -half[axis]));
            let number = V::splat(token, AXES[axis]);
            let inverse = DoubleDouble::exactly(V::splat(token, 1.0)) / along;
            let wide_side = DoubleDouble::exactly(side);
            let (first, last) = ((wide_side - start) * inverse, (-wide_side - start) * inverse);
            let is_later = enter.0.is_less(first);
            enter = (
                DoubleDouble::select(is_later, first, enter.0),
                V::select(is_later, number, enter.1),
                V::select(is_later, side, enter.2),
            );
            let is_sooner = last.is_less(leave.0);
            leave = (
                DoubleDouble::select(is_sooner, last, leave.0),
                V::select(is_sooner, number, leave.1),
                V::select(is_sooner, -side, leave.2),
            );
        }
        let is_outside = wide_zero.is_less(enter.0);
        self.points.from_inside |= (u64::from(V::bits_not(is_outside)) & lanes) << at;
        let parameter = DoubleDouble::select(is_outside, enter.0, leave.0);
        let face = V::select(is_outside, enter.1, leave.1);
        let side = V::select(is_outside, enter.2, leave.2);
        let units = [nearest(x), nearest(y), nearest(z)];
        let mut offset = Vector::new(zero, zero, zero);
        let mut normal = units[0];
        for axis in 0..3 {
            let (start, along) = local[axis];
            let place = along.mul_add(parameter, start).nearest();
            let from_face = face - V::splat(token, AXES[axis]);
            let is_face = (from_face * from_face).is_less(V::splat(token, 0.25));
            offset = units[axis].mul_add(V::select(is_face, side, place), offset);
            normal = Vector::new(
                V::select(is_face, units[axis].x, normal.x),
                V::select(is_face, units[axis].y, normal.y),
                V::select(is_face, units[axis].z, normal.z),
            );
        }
        let found = Self::facing::<V>(token, &way, offset, normal, parameter.nearest());
        self.keep(at, lanes, &found, 0);
    }

    /// The points of spheres.
    #[inline(always)]
    fn on_spheres<V: Lane<Element = f64>>(&mut self, token: V::Token, at: usize, lanes: u64) {
        let Way { start, along, .. } = self.rays.way::<V>(token, at);
        let [center, radius, _] = &self.points.corners;
        let start = start - exactly(load::<V, _>(token, at, center));
        let radius = V::load(token, &radius[0][at..]);
        let wide = DoubleDouble::exactly(radius);
        let squares = [along.dot(along), start.dot(along), start.dot(start) - (wide * wide)];
        let Roots { parameter, root, is_inside } = roots(squares);
        self.points.from_inside |= (u64::from(V::bits(is_inside)) & lanes) << at;
        let offset = nearest(along.mul_add(parameter, start));
        let zero = V::splat(token, 0.0);
        let turn = V::select(is_inside, V::splat(token, -1.0), V::splat(token, 1.0));
        let length = nearest(along).length();
        let found = Found {
            offset,
            normal: offset * (turn / radius),
            cos_theta_o: root / (length * radius),
            distance: parameter.nearest() * length,
            shadow_ray_offset: Vector::new(zero, zero, zero),
        };
        self.keep(at, lanes, &found, 0);
    }

    /// The points of an ellipsoid: those of a sphere, in the space where its radii are 1.
    #[inline(always)]
    fn on_ellipsoid<V: Lane<Element = f64>>(&mut self, token: V::Token, at: usize, lanes: u64, ellipsoid: &Ellipsoid) {
        let Way { start, along, .. } = self.rays.way::<V>(token, at);
        let placement = ellipsoid.placement();
        let start = start - exact::<V>(token, Vector::from_f64(placement.origin));
        let [x, y, z] = placement.axes::<DoubleDouble>();
        let (x, y, z) = (exact::<V>(token, x), exact::<V>(token, y), exact::<V>(token, z));
        let radii = ellipsoid.radii();
        let inverse =
            exact::<V>(token, radii.map(|radius| DoubleDouble::from_f64(1.0) / DoubleDouble::from_f64(radius)));
        let scaled_start = Vector::new(start.dot(x) * inverse.x, start.dot(y) * inverse.y, start.dot(z) * inverse.z);
        let scaled = Vector::new(along.dot(x) * inverse.x, along.dot(y) * inverse.y, along.dot(z) * inverse.z);
        let one = DoubleDouble::exactly(V::splat(token, 1.0));
        let squares = [scaled.dot(scaled), scaled_start.dot(scaled), scaled_start.dot(scaled_start) - one];
        let Roots { parameter, root, is_inside } = roots(squares);
        self.points.from_inside |= (u64::from(V::bits(is_inside)) & lanes) << at;
        let unit = nearest(scaled.mul_add(parameter, scaled_start));
        let (x, y, z) = (nearest(x), nearest(y), nearest(z));
        let (inverse, zero) = (nearest(inverse), V::splat(token, 0.0));
        let gradient = Vector::new(unit.x * inverse.x, unit.y * inverse.y, unit.z * inverse.z);
        let steepness = gradient.length();
        let turn = V::select(is_inside, V::splat(token, -1.0), V::splat(token, 1.0)) / steepness;
        let radii = splat::<V>(token, radii);
        let length = nearest(along).length();
        let found = Found {
            offset: x * (unit.x * radii.x) + y * (unit.y * radii.y) + z * (unit.z * radii.z),
            normal: (x * gradient.x + y * gradient.y + z * gradient.z) * turn,
            cos_theta_o: root / (length * steepness),
            distance: parameter.nearest() * length,
            shadow_ray_offset: Vector::new(zero, zero, zero),
        };
        self.keep(at, lanes, &found, 0);
    }

    /// The points of a cone or of a cylinder.
    #[inline(always)]
    fn on_cone<V: Lane<Element = f64>>(&mut self, token: V::Token, at: usize, lanes: u64) {
        let cone: &Cone = match self.geometry {
            Geometry::Cylinder(cylinder) => cylinder.as_cone(),
            Geometry::Cone(cone) => cone,
            _ => return,
        };
        let Way { start, along, .. } = self.rays.way::<V>(token, at);
        let placement = cone.placement();
        let start = start - exact::<V>(token, Vector::from_f64(placement.origin));
        let [x, y, z] = placement.axes::<DoubleDouble>();
        let (x, y, z) = (exact::<V>(token, x), exact::<V>(token, y), exact::<V>(token, z));
        let start = Vector::new(start.dot(x), start.dot(y), start.dot(z));
        let local = Vector::new(along.dot(x), along.dot(y), along.dot(z));
        let (zero, one) = (V::splat(token, 0.0), V::splat(token, 1.0));
        let wide_zero = DoubleDouble::exactly(zero);
        let [base_radius, slope, height] = cone.profile();
        let (base_radius, slope, height) =
            (exact_number::<V>(token, base_radius), exact_number::<V>(token, slope), exact_number::<V>(token, height));
        // The side: x² + y² = R(z)².
        let radius = slope.mul_add(start.z, base_radius);
        let widening = slope * local.z;
        let squares = [
            across(&local, &local) - (widening * widening),
            across(&start, &local) - (widening * radius),
            across(&start, &start) - (radius * radius),
        ];
        let root = wide_root(squares);
        let inverse = DoubleDouble::exactly(one) / squares[0];
        let (near, far) = ((-squares[1] - root) * inverse, (-squares[1] + root) * inverse);
        // The ends: z = 0 and z = h.
        let smallest = V::splat(token, 1e-250);
        let is_parallel = local.z.nearest().max(-local.z.nearest()).is_less(smallest);
        let way = DoubleDouble::select(is_parallel, DoubleDouble::exactly(smallest), local.z);
        let inverse = DoubleDouble::exactly(one) / way;
        let (base, end) = (-start.z * inverse, (height - start.z) * inverse);
        let is_rising = zero.is_less(way.nearest());
        let (first, last) = (DoubleDouble::select(is_rising, base, end), DoubleDouble::select(is_rising, end, base));
        // From outside, the later of the entrances; from inside, the sooner of the exits.
        let enters_side = first.is_less(near);
        let leaves_side = far.is_less(last);
        let enter = DoubleDouble::select(enters_side, near, first);
        let leave = DoubleDouble::select(leaves_side, far, last);
        let is_outside = wide_zero.is_less(enter);
        self.points.from_inside |= (u64::from(V::bits_not(is_outside)) & lanes) << at;
        let parameter = DoubleDouble::select(is_outside, enter, leave);
        let half = V::splat(token, 0.5);
        let on_side =
            half.is_less(V::select(is_outside, V::select(enters_side, one, zero), V::select(leaves_side, one, zero)));
        let is_at_end = V::select(is_rising, V::select(is_outside, zero, one), V::select(is_outside, one, zero));
        let place = local.mul_add(parameter, start);
        let at_end = DoubleDouble::select(half.is_less(is_at_end), height, wide_zero);
        let place = Vector::new(place.x, place.y, DoubleDouble::select(on_side, place.z, at_end));
        let there = nearest(place);
        let radius_there = slope.mul_add(place.z, base_radius);
        // Outward: (x, y, −kR) on the side, ±z at the ends.
        let [kr, radius_there] = [(slope * radius_there).nearest(), radius_there.nearest()];
        let end_normal = V::select(half.is_less(is_at_end), one, V::splat(token, -1.0));
        let outward = Vector::new(
            V::select(on_side, there.x, zero),
            V::select(on_side, there.y, zero),
            V::select(on_side, -kr, end_normal),
        );
        let steepness = outward.length();
        let length = nearest(along).length();
        let slope_there = V::select(on_side, root.nearest(), local.z.nearest().max(-local.z.nearest()));
        let turn = V::select(is_outside, one, V::splat(token, -1.0)) / steepness;
        let (x, y, z) = (nearest(x), nearest(y), nearest(z));
        let found = Found {
            offset: x * there.x + y * there.y + z * there.z,
            normal: (x * outward.x + y * outward.y + z * outward.z) * turn,
            cos_theta_o: slope_there / (length * steepness),
            distance: parameter.nearest() * length,
            shadow_ray_offset: Vector::new(zero, zero, zero),
        };
        // Steep rays, and the apex, are left to others.
        let square = nearest(local);
        let is_regular = (square.dot(square) * V::splat(token, 1e-4)).is_less(squares[0].nearest());
        let is_apex = radius_there.is_less(V::splat(token, 1e-9 * cone.size()));
        let doubtful = V::bits_not(is_regular) | V::bits(is_apex) & V::bits(on_side);
        self.keep(at, lanes, &found, doubtful);
    }

    /// Points at a place of a plane, whose normal is turned to the eye.
    #[inline(always)]
    fn facing<V: Lane<Element = f64>>(
        token: V::Token,
        way: &Way<V>,
        offset: Vector<V>,
        normal: Vector<V>,
        parameter: V,
    ) -> Found<V> {
        let zero = V::splat(token, 0.0);
        let slope = normal.dot(way.direction);
        let normal = normal * V::select(zero.is_less(slope), V::splat(token, -1.0), V::splat(token, 1.0));
        Found {
            offset,
            normal,
            cos_theta_o: -normal.dot(way.direction),
            distance: parameter * nearest(way.along).length(),
            shadow_ray_offset: Vector::new(zero, zero, zero),
        }
    }
}

/// A vector, or another one where it is zero.
#[inline(always)]
fn or_else<V: Lane<Element = f64>>(vector: Vector<V>, other: Vector<V>) -> Vector<V> {
    let is_there = vector.x.splat_like(0.0).is_less(vector.dot(vector));
    Vector::new(
        V::select(is_there, vector.x, other.x),
        V::select(is_there, vector.y, other.y),
        V::select(is_there, vector.z, other.z),
    )
}

/// Writes some lanes.
#[inline(always)]
fn keep<V: Lane<Element = f64>>(at: usize, lanes: u64, numbers: V, out: &mut [f64; RAYS]) {
    let out = &mut out[at..at + V::COUNT];
    if lanes == (1 << V::COUNT) - 1 {
        numbers.store(out);
        return;
    }
    let mut all = [0.0; 16];
    numbers.store(&mut all);
    for (lane, out) in out.iter_mut().enumerate() {
        if lanes >> lane & 1 == 1 {
            *out = all[lane];
        }
    }
}

#[inline(always)]
fn keep_vectors<V: Lane<Element = f64>>(at: usize, lanes: u64, vectors: Vector<V>, [x, y, z]: &mut Vectors) {
    keep(at, lanes, vectors.x, x);
    keep(at, lanes, vectors.y, y);
    keep(at, lanes, vectors.z, z);
}

/// Where a ray meets a quadric.
struct Roots<V: Lane> {
    /// The t of the first root ahead of the start.
    parameter: DoubleDouble<V>,
    /// √(b² − ac).
    root: V,
    /// Whether the start is inside.
    is_inside: V::Mask,
}

/// √(b² − ac), 0 where it is negative.
#[inline(always)]
fn wide_root<V: Lane<Element = f64>>([a, b, c]: [DoubleDouble<V>; 3]) -> DoubleDouble<V> {
    (b * b - (a * c)).max_zero().sqrt()
}

/// The roots of at² + 2bt + c.
#[inline(always)]
fn roots<V: Lane<Element = f64>>(squares: [DoubleDouble<V>; 3]) -> Roots<V> {
    let [a, b, _] = squares;
    let root = wide_root(squares);
    let inverse = a.splat_like(1.0) / a;
    let (near, far) = ((-b - root) * inverse, (-b + root) * inverse);
    let is_inside = near.is_less(near.splat_like(0.0));
    Roots { parameter: DoubleDouble::select(is_inside, far, near), root: root.nearest(), is_inside }
}

/// The centre of a sphere and its radius, in place of corners.
fn of_sphere(sphere: &Sphere) -> [Vector; 3] {
    [sphere.center, Vector::new(sphere.radius, 0.0, 0.0), Vector::default()]
}

/// x x' + y y'.
#[inline(always)]
fn across<V: Lane<Element = f64>>(
    first: &Vector<DoubleDouble<V>>,
    second: &Vector<DoubleDouble<V>>,
) -> DoubleDouble<V> {
    first.y.mul_add(second.y, first.x * second.x)
}
