//! Shapes by themselves: closed forms, and double precision against 32 digits.

use std::sync::Arc;

use isophote::double_double::DoubleDouble;
use isophote::ray::Ray;
use isophote::scalar::Scalar;
use isophote::shape::{
    Accuracy, Cone, CornerNormals, Cuboid, Cylinder, Disk, Ellipsoid, Geometry, Mesh, MeshData, MeshError, MeshPlacing,
    Plane, Rectangle, Rotation, ShapeHit, Sphere, SurfacePoint,
};
use isophote::vector::Vector;

/// Numbers that look random and are the same every time (Marsaglia's xorshift).
struct Random(u64);

impl Random {
    #[expect(clippy::cast_precision_loss, reason = "53 bits are kept")]
    fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn signed(&mut self) -> f64 {
        2.0 * self.unit() - 1.0
    }

    fn direction(&mut self) -> Vector {
        loop {
            let vector = Vector::new(self.signed(), self.signed(), self.signed());
            if (0.1..1.0).contains(&vector.length()) {
                return vector.normalized();
            }
        }
    }

    fn size(&mut self) -> f64 {
        0.1 + self.unit()
    }

    fn rotation(&mut self) -> Rotation {
        if self.unit() < 0.2 { Rotation::NONE } else { Rotation::about(self.direction(), 180.0 * self.signed()) }
    }
}

const KINDS: [&str; 10] =
    ["sphere", "ellipsoid", "box", "cylinder", "cone", "plane", "rectangle", "disk", "mesh", "smooth mesh"];

/// A shape of a kind, of about this size, up to five times as long as wide, at a place.
fn shape(kind: &str, center: Vector, scale: f64, random: &mut Random) -> Geometry {
    let length = scale * random.size() * libm::pow(5.0, random.signed());
    let [first, second] = [random.size() * scale, random.size() * scale];
    let sides = Vector::new(first, second, length);
    let axis = random.direction();
    match kind {
        "sphere" => Geometry::Sphere(Sphere { center, radius: first }),
        "ellipsoid" => Geometry::Ellipsoid(Arc::new(Ellipsoid::new(center, sides, random.rotation()))),
        "box" => Geometry::Cuboid(Arc::new(Cuboid::new(center, sides, random.rotation()))),
        "cylinder" => Geometry::Cylinder(Arc::new(Cylinder::new(center, center + axis * length, first))),
        "cone" => {
            let end = if random.unit() < 0.5 { 0.0 } else { second };
            Geometry::Cone(Arc::new(Cone::new(center, center + axis * length, [first, end])))
        }
        "plane" => Geometry::Plane(Arc::new(Plane::new(center, axis))),
        "rectangle" => Geometry::Rectangle(Arc::new(Rectangle::new(center, [first, length], axis, random.direction()))),
        "disk" => Geometry::Disk(Arc::new(Disk::new(center, axis, first))),
        _ => {
            let placing = MeshPlacing { scale: sides, rotation: random.rotation(), position: center };
            let data = if kind == "mesh" { cube() } else { icosphere(1) };
            Geometry::Mesh(Arc::new(Mesh::new(data, &placing).expect("it is valid")))
        }
    }
}

/// The cube from −1 to 1, without normals.
fn cube() -> MeshData {
    let sign = |bit: u32| if bit == 0 { -1.0 } else { 1.0 };
    let vertices = (0_u32..8).map(|corner| [sign(corner & 1), sign(corner & 2), sign(corner & 4)]).collect();
    let sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let triangles = sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    MeshData { vertices, triangles, ..MeshData::default() }
}

/// The unit sphere as an octahedron whose triangles were cut into four so many times, with the sphere's normals.
fn icosphere(cuts: usize) -> MeshData {
    let mut vertices: Vec<[f64; 3]> = [0, 1, 2]
        .into_iter()
        .flat_map(|axis| [1.0, -1.0].map(|side| [0, 1, 2].map(|other| if other == axis { side } else { 0.0 })))
        .collect();
    let mut triangles: Vec<[u32; 3]> =
        vec![[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
    for _ in 0..cuts {
        let mut middles = std::collections::HashMap::new();
        let mut middle = |first: u32, second: u32| {
            *middles.entry((first.min(second), first.max(second))).or_insert_with(|| {
                let [first, second] = [first, second].map(|index| Vector::from(vertices[index as usize]));
                vertices.push((first + second).normalized().to_array());
                u32::try_from(vertices.len() - 1).expect("there are few")
            })
        };
        triangles = triangles
            .iter()
            .flat_map(|&[a, b, c]| {
                let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            })
            .collect();
    }
    let normals = Some(CornerNormals { vectors: vertices.clone(), corners: triangles.clone() });
    MeshData { vertices, triangles, normals, ..MeshData::default() }
}

fn ray<T: Scalar>(start: Vector, direction: Vector) -> Ray<T> {
    Ray { anchor: Vector::from_f64(start), offset: Vector::zero(), direction: Vector::from_f64(direction).normalized() }
}

/// The part that is met first and where; and whether that is in doubt.
fn first<T: Scalar>(geometry: &Geometry, ray: &Ray<T>, accuracy: Accuracy) -> (Option<(u32, ShapeHit<T>)>, bool) {
    let mut nearest: Option<(u32, ShapeHit<T>)> = None;
    let mut doubtful_from: Option<T> = None;
    for part in 0..geometry.parts() {
        let intersection = geometry.intersect(part, ray, accuracy);
        if let Some(from) = intersection.doubtful_from {
            doubtful_from = Some(doubtful_from.map_or(from, |earlier| T::select(from.is_less(earlier), from, earlier)));
        }
        if let Some(hit) = intersection.hit
            && nearest.is_none_or(|(_, nearest)| hit.distance.is_less(nearest.distance))
        {
            nearest = Some((part, hit));
        }
    }
    let is_beyond = |from: T| nearest.is_some_and(|(_, hit)| hit.distance.is_less(from));
    (nearest, doubtful_from.is_some_and(|from| !is_beyond(from)))
}

/// As a scene finds it: what is in doubt is traced again.
fn hit(geometry: &Geometry, start: Vector, direction: Vector) -> Option<ShapeHit> {
    let (found, is_doubtful) = first::<f64>(geometry, &ray(start, direction), Accuracy::for_shading(None, 0.0));
    if !is_doubtful {
        return found.map(|(_, hit)| hit);
    }
    let (exact, _) = first::<DoubleDouble>(geometry, &ray(start, direction), Accuracy::for_shading(None, 0.0));
    exact.map(|(_, hit)| {
        let SurfacePoint { anchor, offset, normal, view, cos_theta_o } = hit.point;
        let (offset, normal, view) = (rounded(offset), rounded(normal), rounded(view));
        let point = SurfacePoint { anchor, offset, normal, view, cos_theta_o: cos_theta_o.rounded() };
        let (distance, shadow_ray_offset) = (hit.distance.rounded(), rounded(hit.shadow_ray_offset));
        ShapeHit { distance, point, from_inside: hit.from_inside, shadow_ray_offset }
    })
}

fn rounded(vector: Vector<DoubleDouble>) -> Vector {
    vector.map(DoubleDouble::rounded)
}

fn difference(double: Vector, exact: Vector<DoubleDouble>) -> f64 {
    rounded(Vector::from_f64(double) - exact).length()
}

/// What double precision does not call doubtful is what 32 digits see, to the promised digits: with rays from near and far,
/// from inside, along edges and silhouettes; with shapes from a millionth to a million metres, near the origin and far.
#[test]
fn where_double_precision_is_not_in_doubt_it_agrees_with_32_digits() {
    for kind in KINDS {
        let mut random = Random(88_172_645_463_325_252);
        let (mut hits, mut doubtful) = (0, 0);
        for round in 0..3000 {
            let scale = [1.0, 1e-6, 1e6][round % 3];
            let from_origin = if random.unit() < 0.3 { libm::pow(10.0, 6.0 * random.unit()) } else { 1.0 };
            let center = random.direction() * (scale * from_origin * random.unit());
            let geometry = shape(kind, center, scale, &mut random);
            let away = libm::pow(10.0, 1.5 * random.signed()) * scale;
            let eye = center + random.direction() * (scale * random.unit()) + random.direction() * away;
            let aims_at_surface = random.unit() < 0.3;
            let target = if aims_at_surface {
                let nearest = geometry.nearest(eye + random.direction() * (3.0 * away));
                nearest.anchor + nearest.offset
            } else {
                center + random.direction() * (scale * random.unit())
            };
            let direction = target - eye;
            let (exact, _) = first::<DoubleDouble>(&geometry, &ray(eye, direction), Accuracy::OF_VISIBILITY);
            let (seen, is_doubtful) = first::<f64>(&geometry, &ray(eye, direction), Accuracy::OF_VISIBILITY);
            let what = || format!("{kind}, {round}: {geometry:?} {eye:?} {direction:?}");
            assert!(is_doubtful || seen.is_some() == exact.is_some(), "{}", what());
            let (found, is_doubtful) = first::<f64>(&geometry, &ray(eye, direction), Accuracy::for_shading(None, 0.0));
            if is_doubtful {
                doubtful += 1;
                continue;
            }
            assert_eq!(found.map(|(part, _)| part), exact.map(|(part, _)| part), "{}", what());
            let (Some((_, found)), Some((_, exact))) = (found, exact) else { continue };
            hits += 1;
            assert_eq!(found.from_inside, exact.from_inside, "{}", what());
            assert!(difference(found.point.normal, exact.point.normal) < 1e-12, "{}", what());
            let cosine = exact.point.cos_theta_o.rounded();
            assert!((found.point.cos_theta_o - cosine).abs() < 5e-13, "{}", what());
            let size = geometry.size_near(rounded(exact.point.position()));
            assert!(difference(found.point.offset, exact.point.offset) < 1e-12 * size, "{}", what());
            let distance = exact.distance.rounded();
            assert!((found.distance - distance).abs() < 1e-12 * (distance + size), "{}", what());
        }
        assert!(hits > 150, "{kind}: {hits} hits");
        assert!(doubtful < 2400, "{kind}: {doubtful} doubtful");
    }
}

/// The normal is a unit vector on the viewer's side, cosθ_o is N·V, and the point is on the surface and on the ray.
#[test]
fn a_hit_is_on_the_surface_with_its_normal_towards_the_viewer() {
    for kind in KINDS {
        let mut random = Random(2_463_534_242);
        let mut from_inside = 0;
        for _ in 0..600 {
            let center = random.direction() * random.unit();
            let geometry = shape(kind, center, 1.0, &mut random);
            let eye = center + random.direction() * (4.0 * random.unit());
            let direction = center + random.direction() * random.unit() - eye;
            let Some(hit) = hit(&geometry, eye, direction) else { continue };
            let point = hit.point;
            let position = point.position();
            assert!(
                geometry.signed_distance(position).abs() < 1e-13,
                "{kind} {position:?} {}",
                geometry.signed_distance(position)
            );
            assert!((eye - position - point.view * hit.distance).length() < 1e-12 * (1.0 + hit.distance), "{kind}");
            assert!((point.normal.length() - 1.0).abs() < 1e-14, "{kind}");
            assert!((point.normal.dot(point.view) - point.cos_theta_o).abs() < 1e-12, "{kind}");
            assert!(kind == "smooth mesh" || point.cos_theta_o > 0.0, "{kind}");
            assert_eq!(hit.from_inside, geometry.part_encloses(0, eye), "{kind}");
            from_inside += usize::from(hit.from_inside);
            let nearest = geometry.nearest(position);
            assert!((nearest.anchor + nearest.offset - position).length() < 1e-13, "{kind}");
            let bounds = geometry.bounds(nearest.part);
            let is_within = bounds.is_none_or(|bounds| {
                let [least, greatest, at] = [bounds.least, bounds.greatest, position].map(Vector::to_array);
                (0..3).all(|axis| least[axis] - 1e-13 <= at[axis] && at[axis] <= greatest[axis] + 1e-13)
            });
            assert!(is_within, "{kind}: {position:?} {bounds:?}");
        }
        assert_eq!(from_inside > 20, geometry_is_closed(kind), "{kind}: {from_inside}");
    }
}

fn geometry_is_closed(kind: &str) -> bool {
    ["sphere", "ellipsoid", "box", "cylinder", "cone"].contains(&kind)
}

/// Nearest points: no other point of the surface is nearer, as rays in all directions from the point find.
#[test]
fn no_surface_point_is_nearer_than_the_nearest() {
    for kind in KINDS {
        let mut random = Random(1_181_783_497_276_652_981);
        for _ in 0..60 {
            let center = random.direction() * random.unit();
            let geometry = shape(kind, center, 1.0, &mut random);
            let point = center + random.direction() * (2.0 * random.unit());
            let distance = geometry.signed_distance(point);
            let nearest = geometry.nearest(point);
            let way = nearest.anchor + nearest.offset - point;
            assert!((way.length() - distance.abs()).abs() < 1e-13, "{kind}");
            if geometry_is_closed(kind) {
                assert_eq!(distance < 0.0, way.dot(nearest.outward_normal) > 0.0, "{kind}");
            }
            for _ in 0..60 {
                if let Some(hit) = hit(&geometry, point, random.direction()) {
                    assert!(hit.distance >= way.length() - 1e-13, "{kind}");
                }
            }
        }
    }
}

#[test]
fn an_ellipsoid_of_equal_radii_is_a_sphere() {
    let mut random = Random(7_777_777);
    for _ in 0..500 {
        let center = random.direction();
        let radius = random.size();
        let sphere = Geometry::Sphere(Sphere { center, radius });
        let radii = Vector::new(radius, radius, radius);
        let ellipsoid = Geometry::Ellipsoid(Arc::new(Ellipsoid::new(center, radii, random.rotation())));
        let eye = random.direction() * 3.0;
        let direction = center + random.direction() * (0.99 * radius * random.unit()) - eye;
        let [first, second] = [&sphere, &ellipsoid].map(|geometry| hit(geometry, eye, direction));
        let [Some(first), Some(second)] = [first, second] else { panic!("the rays go through it") };
        assert!((first.distance - second.distance).abs() < 1e-12);
        assert!((first.point.normal - second.point.normal).length() < 1e-12);
        let [first, second] = [&sphere, &ellipsoid].map(|geometry| geometry.signed_distance(eye));
        assert!((first - second).abs() < 1e-14);
    }
}

/// A turned shape, seen by a ray that is turned with it, is the unturned one.
#[test]
fn a_turned_shape_is_the_unturned_one_in_turned_axes() {
    let mut random = Random(99_991);
    for _ in 0..300 {
        let sides = Vector::new(random.size(), random.size(), random.size());
        let rotation = random.rotation();
        let [x, y, z] = rotation.matrix();
        let turned = |vector: Vector| x * vector.x + y * vector.y + z * vector.z;
        let origin = Vector::default();
        let axis = random.direction();
        let pairs = [Rotation::NONE, rotation].map(|rotation| {
            let turn = |vector| if rotation == Rotation::NONE { vector } else { turned(vector) };
            [
                Geometry::Ellipsoid(Arc::new(Ellipsoid::new(origin, sides, rotation))),
                Geometry::Cuboid(Arc::new(Cuboid::new(origin, sides, rotation))),
                Geometry::Cylinder(Arc::new(Cylinder::new(origin, turn(axis), sides.x))),
                Geometry::Cone(Arc::new(Cone::new(origin, turn(axis), [sides.x, 0.0]))),
                Geometry::Disk(Arc::new(Disk::new(origin, turn(axis), sides.y))),
            ]
        });
        let eye = random.direction() * 3.0;
        let direction = random.direction() * 0.3 - eye;
        for (straight, slanted) in pairs[0].iter().zip(&pairs[1]) {
            let (first, is_doubtful) = first::<f64>(straight, &ray(eye, direction), Accuracy::for_shading(None, 0.0));
            let second = hit(slanted, turned(eye), turned(direction));
            assert!(is_doubtful || first.is_some() == second.is_some());
            if let (Some((_, first)), Some(second), false) = (first, second, is_doubtful) {
                assert!((first.distance - second.distance).abs() < 1e-12);
                assert!((turned(first.point.normal) - second.point.normal).length() < 1e-12);
            }
        }
    }
}

#[test]
fn silhouettes_are_where_the_closed_forms_have_them() {
    let away = |x: f64, y: f64| Vector::new(x, y, 10.0);
    let towards = Vector::new(0.0, 0.0, -1.0);
    let (up, ends) = (Vector::new(0.0, 2.0, 0.0), 1e-15);
    let cylinder = Geometry::Cylinder(Arc::new(Cylinder::new(Vector::default(), up, 0.5)));
    let cone = Geometry::Cone(Arc::new(Cone::new(Vector::default(), up, [0.5, 0.0])));
    let cut = Geometry::Cone(Arc::new(Cone::new(Vector::default(), up, [0.5, 0.25])));
    let cuboid =
        Geometry::Cuboid(Arc::new(Cuboid::new(Vector::new(0.0, 1.0, 0.0), Vector::new(1.0, 2.0, 1.0), Rotation::NONE)));
    for y in [0.1, 0.8, 1.5, 1.9] {
        let widths = [(&cylinder, 0.5), (&cone, 0.5 - 0.25 * y), (&cut, 0.5 - 0.125 * y), (&cuboid, 0.5)];
        for (geometry, half_width) in widths {
            for side in [-1.0, 1.0] {
                let at = |part: f64| side * half_width * part;
                let sees = |part: f64| {
                    let ray = ray::<DoubleDouble>(away(at(part), y), towards);
                    geometry.intersect(0, &ray, Accuracy::OF_VISIBILITY).hit.is_some()
                };
                assert!(sees(1.0 - ends) && !sees(1.0 + ends), "{geometry:?} at {y}");
            }
        }
    }
    let below = |y: f64| hit(&cylinder, away(0.0, y), towards).is_some();
    assert!(below(2.0 - 1e-12) && !below(2.0 + 1e-12) && !below(-1e-12) && below(1e-12), "the flat ends");
}

/// A ray along a plane, but for rounding, sees nothing of it however far it goes.
#[test]
fn a_plane_ends_at_its_horizon() {
    let normal = Vector::new(0.48, 0.6, 0.64);
    let plane = Geometry::Plane(Arc::new(Plane::new(Vector::default(), normal)));
    for along in [Vector::new(0.8, 0.0, -0.6), Vector::new(0.36, -0.8, 0.48), Vector::new(0.6, -0.48, 0.0)] {
        let eye = normal * 2.0;
        let exact = Vector::<DoubleDouble>::from_f64(along) - plane_part(along, &plane);
        let ray = Ray { direction: exact.normalized(), ..ray(eye, along) };
        assert!(plane.intersect(0, &ray, Accuracy::OF_VISIBILITY).hit.is_none());
        let rounded = Ray { direction: rounded(exact.normalized()), ..self::ray::<f64>(eye, along) };
        assert!(plane.intersect(0, &rounded, Accuracy::OF_VISIBILITY).doubtful_from.is_some());
    }
}

/// The part of a vector across a plane, with 32 digits.
fn plane_part(vector: Vector, plane: &Geometry) -> Vector<DoubleDouble> {
    let start = ray::<DoubleDouble>(Vector::new(1.0, 2.0, 3.0), Vector::new(-0.3, -2.0, -1.0));
    let normal = plane.intersect(0, &start, Accuracy::OF_VISIBILITY).hit.expect("it is there").point.normal;
    normal * normal.dot(Vector::from_f64(vector))
}

/// Along the axis, exactly: through the apex, through flat ends, and nothing is NaN.
#[test]
fn rays_along_an_axis_meet_the_ends() {
    let origin = Vector::default();
    let up = Vector::new(0.0, 2.0, 0.0);
    for radii in [[0.5, 0.5], [0.5, 0.25], [0.5, 0.0], [0.25, 0.5]] {
        let cone = Geometry::Cone(Arc::new(Cone::new(origin, up, radii)));
        let above = hit(&cone, Vector::new(0.0, 5.0, 0.0), Vector::new(0.0, -1.0, 0.0)).expect("the end is there");
        assert!((above.distance - 3.0).abs() < 1e-15, "{radii:?}");
        assert!(above.point.normal.dot(above.point.view) > 0.99 && above.point.cos_theta_o > 0.99, "{radii:?}");
        let below = hit(&cone, Vector::new(0.0, -1.0, 0.0), Vector::new(0.0, 1.0, 0.0)).expect("the base is there");
        assert_eq!(below.distance, 1.0);
        let inside = hit(&cone, Vector::new(0.0, 0.5, 0.0), Vector::new(0.0, -1.0, 0.0)).expect("the base is there");
        assert!(inside.from_inside && inside.distance == 0.5);
    }
}

#[test]
fn a_mesh_of_a_cube_is_a_box() {
    let mut random = Random(5_555);
    for _ in 0..400 {
        let half = Vector::new(random.size(), random.size(), random.size());
        let (center, rotation) = (random.direction(), random.rotation());
        let placing = MeshPlacing { scale: half, rotation, position: center };
        let mesh = Geometry::Mesh(Arc::new(Mesh::new(cube(), &placing).expect("it is valid")));
        let cuboid = Geometry::Cuboid(Arc::new(Cuboid::new(center, half * 2.0, rotation)));
        for away in [3.0, 0.05] {
            let eye = center + random.direction() * away;
            let direction = center + random.direction() * (0.1 * random.unit()) - eye;
            let [first, second] = [&mesh, &cuboid].map(|geometry| hit(geometry, eye, direction));
            let [Some(first), Some(second)] = [first, second] else { panic!("the rays go through it") };
            assert!((first.distance - second.distance).abs() < 1e-13);
            assert!((first.point.normal - second.point.normal).length() < 1e-13);
            assert_eq!(first.shadow_ray_offset, Vector::default());
        }
    }
}

/// Through corners and edges that triangles share, exactly: never a gap.
#[test]
fn rays_through_shared_edges_hit() {
    let mesh = Mesh::new(icosphere(3), &placing(Vector::new(1.0, 1.0, 1.0))).expect("it is valid");
    let mesh = Geometry::Mesh(Arc::new(mesh));
    let eye = Vector::new(0.3, -0.2, 0.1);
    let MeshData { vertices, triangles, .. } = icosphere(3);
    for [a, b, c] in triangles {
        let [a, b, c] = [a, b, c].map(|index| Vector::from(vertices[index as usize]));
        for target in [a, (a + b) * 0.5, (b + c) * 0.5, a * 0.25 + b * 0.75] {
            let (exact, _) = first::<DoubleDouble>(&mesh, &ray(eye, target - eye), Accuracy::OF_VISIBILITY);
            assert!(exact.is_some(), "{target:?}");
        }
    }
}

fn placing(scale: Vector) -> MeshPlacing {
    MeshPlacing { scale, rotation: Rotation::NONE, position: Vector::default() }
}

/// Also when scaled to an ellipsoid: normals turn the other way than tangents.
#[test]
fn a_smooth_mesh_has_the_normals_of_the_surface_at_its_vertices() {
    for scale in [Vector::new(1.0, 1.0, 1.0), Vector::new(1.0, 0.5, 2.0)] {
        let mesh = Geometry::Mesh(Arc::new(Mesh::new(icosphere(2), &placing(scale)).expect("it is valid")));
        for [x, y, z] in icosphere(2).vertices {
            let vertex = Vector::new(x * scale.x, y * scale.y, z * scale.z);
            let expected = Vector::new(x / scale.x, y / scale.y, z / scale.z).normalized();
            let nearest = mesh.nearest(vertex);
            assert!((nearest.outward_normal - expected).length() < 1e-14);
            assert!(nearest.shadow_ray_offset.length() < 1e-15);
            let inner = Vector::new(0.011, -0.013, 0.017);
            let seen = hit(&mesh, inner, vertex * (1.0 - 1e-9) - inner).expect("it is all around");
            assert!((seen.point.normal + expected).length() < 1e-8, "on the viewer's side, which is inside");
        }
    }
}

/// Shadow rays of a smooth mesh start above the tangent planes of the corners, of flat ones where they are.
#[test]
fn the_lift_clears_the_tangent_planes_of_the_corners() {
    let mesh =
        Geometry::Mesh(Arc::new(Mesh::new(icosphere(1), &placing(Vector::new(1.0, 1.0, 1.0))).expect("it is valid")));
    let mut random = Random(31_337);
    for _ in 0..200 {
        let hit = hit(&mesh, random.direction() * 3.0, random.direction() * 0.01);
        assert!(hit.is_none_or(
            |hit| hit.shadow_ray_offset == Vector::default() || hit.shadow_ray_offset.dot(hit.point.normal) > 0.0
        ));
        let eye = random.direction() * 3.0;
        let hit = self::hit(&mesh, eye, -eye).expect("it is in the middle");
        let start = hit.point.position() + hit.shadow_ray_offset;
        assert!(start.length() > hit.point.position().length());
        assert!((0.99..1.15).contains(&start.length()), "near the sphere that it stands for");
    }
}

#[test]
fn triangles_that_make_no_mesh_are_refused() {
    let refused = |data: MeshData, scale: Vector| Mesh::new(data, &placing(scale)).expect_err("it is wrong");
    let one = Vector::new(1.0, 1.0, 1.0);
    for scale in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(refused(cube(), Vector::new(1.0, scale, 1.0)), MeshError::Scale { .. }));
    }
    let mut data = cube();
    data.vertices[3][1] = f64::NAN;
    assert_eq!(refused(data, one).to_string(), "vertex 3 has the coordinate NaN; allowed: finite numbers");
    let mut data = cube();
    data.triangles[5] = [0, 1, 8];
    assert_eq!(refused(data, one).to_string(), "triangle 5 refers to vertex 8; there are 8, counted from 0");
    let mut data = icosphere(0);
    data.normals.as_mut().expect("it has some").corners[2] = [0, 6, 1];
    assert_eq!(refused(data, one).to_string(), "triangle 2 refers to normal 6; there are 6, counted from 0");
    let data = MeshData { slots: vec![0; 11], materials: vec![None], ..cube() };
    assert_eq!(refused(data, one).to_string(), "there are 11 material slots for 12 triangles");
    let flat = MeshData { triangles: vec![[0, 1, 1], [2, 2, 2]], ..cube() };
    assert_eq!(refused(flat, one).to_string(), "it has no triangle with an area (2 without)");
    let mut data =
        MeshData { slots: vec![0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1], materials: vec![Some(7), None], ..cube() };
    data.triangles[1] = [4, 4, 5];
    let mesh = Mesh::new(data, &placing(one)).expect("what has no area is left out");
    assert_eq!((mesh.parts(), mesh.left_out()), (11, 1));
    assert_eq!([0, 1].map(|part| mesh.material_of(part)), [Some(7), None], "slots stay with their triangles");
}
