//! Points of one surface that are shaded together, and the results: arrays that stay in the L1 cache.

use super::lobe::Terms;
use crate::lanes::{Element, Lane, LaneJob};
use crate::outline::{Ellipse, PlaceInRow, PointInRow};
use crate::prepare::Hit;
use crate::render::vectors::{get, load, put, store};
use crate::shape::{Primitive, SurfacePoint};
use crate::vector::Vector;

/// The maximum number of points in a block.
pub const POINTS: usize = 256;

/// Room after the last point: vectors may extend beyond it.
pub const SIZE: usize = POINTS + 32;

/// Points of a primitive in the form that the kernel reads: lengths are in units of `unit` from `anchor`. Every visibility
/// method produces such blocks.
pub struct SurfaceBlock<E> {
    /// The number of points.
    pub count: usize,
    /// The primitive that they are on.
    pub primitive: Primitive,
    /// A place near them, in metres.
    pub anchor: Vector,
    /// The unit of lengths, in metres.
    pub unit: f64,
    /// From the anchor to an anchor of each point, if the points have their own.
    pub anchors: Option<Box<[[E; SIZE]; 3]>>,
    /// From the anchor to the points.
    pub offset: [[E; SIZE]; 3],
    /// N.
    pub normal: [[E; SIZE]; 3],
    /// V.
    pub view: [[E; SIZE]; 3],
    /// cosθ_o.
    pub cos_theta_o: [E; SIZE],
    /// t.
    pub distance: [E; SIZE],
    /// E_a, W/m² or lx.
    pub ambient: [E; SIZE],
}

/// The kernel's output for a block. Values that were not requested may be left over from another block.
pub struct ShadedBlock<E> {
    /// B, in the convention's unit.
    pub brightness: [E; SIZE],
    /// E, W/m² or lx.
    pub irradiance: [E; SIZE],
    /// The diffuse part of B.
    pub diffuse: [E; SIZE],
    /// The specular part of B.
    pub specular: [E; SIZE],
    /// E_a, W/m² or lx.
    pub ambient: [E; SIZE],
    /// Its standard error.
    pub ambient_error: [E; SIZE],
    /// E_j of each light whose own irradiance is requested, W/m² or lx.
    pub by_light: Vec<[E; SIZE]>,
    /// Whether more than the brightness is requested.
    pub is_whole: bool,
    /// What the kernel keeps between its loops: cosθ_o.
    pub cosines: [E; SIZE],
    /// Σ E_j (N·H_j)ⁿ (Σ v_j I_j/r_j² (N·H_j)ⁿ in (3.11) and (3.12)).
    pub lobes: [E; SIZE],
    /// The terms of this sum.
    pub terms: Terms<E>,
}

/// Screen positions within an outline, in the outline's columns and rows.
pub struct Places<'p> {
    /// u.
    pub columns: &'p [f64],
    /// v.
    pub rows: &'p [f64],
    /// u − u_a, where it is known more accurately than from columns and rows.
    pub after_first: &'p [f64],
    /// u − u_b, likewise.
    pub after_last: &'p [f64],
}

impl<E: Element> SurfaceBlock<E> {
    /// Room for points.
    #[expect(clippy::unnecessary_box_returns, reason = "too large for the stack")]
    pub fn new() -> Box<Self> {
        let zeros = [E::default(); SIZE];
        Box::new(Self {
            count: 0,
            primitive: Primitive { shape: 0, part: 0 },
            anchor: Vector::default(),
            unit: 1.0,
            anchors: None,
            offset: [zeros; 3],
            normal: [zeros; 3],
            view: [zeros; 3],
            cos_theta_o: zeros,
            distance: zeros,
            ambient: zeros,
        })
    }

    /// The points of a sphere that are visible at positions within its outline. The positions are padded to the end of a
    /// vector with anything within the outline.
    #[inline(always)]
    fn see<V: Lane<Element = E>>(&mut self, token: V::Token, outline: &Ellipse, places: &Places<'_>) {
        let outline = outline.map(
            #[inline(always)]
            |number| V::splat(token, E::from_f64(number)),
        );
        for at in (0..self.count).step_by(V::COUNT) {
            let [columns, rows, after_first, after_last] =
                [places.columns, places.rows, places.after_first, places.after_last].map(
                    #[inline(always)]
                    |numbers| V::load_doubles(token, &numbers[at..]),
                );
            let place = PlaceInRow { column: columns, after_first, after_last };
            self.store(at, &outline.row_at(rows).point(self.anchor, &place));
        }
    }

    /// Writes a vector of points.
    #[inline(always)]
    pub fn store<V: Lane<Element = E>>(&mut self, at: usize, seen: &PointInRow<V>) {
        seen.distance.store(&mut self.distance[at..]);
        self.store_point(at, &seen.point);
    }

    /// Writes a vector of points without distances.
    #[inline(always)]
    pub fn store_point<V: Lane<Element = E>>(&mut self, at: usize, point: &SurfacePoint<V>) {
        store(point.offset, at, &mut self.offset);
        store(point.normal, at, &mut self.normal);
        store(point.view, at, &mut self.view);
        point.cos_theta_o.store(&mut self.cos_theta_o[at..]);
    }

    /// The anchors of a vector of points, if they have their own.
    #[inline(always)]
    pub fn anchors_at<V: Lane<Element = E>>(&self, token: V::Token, at: usize) -> Option<Vector<V>> {
        self.anchors.as_deref().map(
            #[inline(always)]
            |anchors| load(token, at, anchors),
        )
    }

    /// N of a vector of points.
    #[inline(always)]
    pub fn normal_at<V: Lane<Element = E>>(&self, token: V::Token, at: usize) -> Vector<V> {
        load(token, at, &self.normal)
    }

    /// N of a point.
    pub fn normal_of(&self, index: usize) -> [E; 3] {
        get(&self.normal, index).to_array()
    }

    /// A vector of points.
    #[inline(always)]
    pub fn point_at<V: Lane<Element = E>>(&self, token: V::Token, at: usize) -> SurfacePoint<V> {
        SurfacePoint {
            anchor: self.anchor,
            offset: load(token, at, &self.offset),
            normal: load(token, at, &self.normal),
            view: load(token, at, &self.view),
            cos_theta_o: V::load(token, &self.cos_theta_o[at..]),
        }
    }
}

impl SurfaceBlock<f64> {
    /// Room for points that have anchors of their own, in metres.
    pub fn anchored() -> Box<Self> {
        let mut block = Self::new();
        block.anchors = Some(Box::new([[0.0; SIZE]; 3]));
        block
    }

    /// Writes a point of an [anchored](Self::anchored) block.
    pub fn set(&mut self, at: usize, hit: &Hit) {
        let point = &hit.point;
        put(point.offset, at, &mut self.offset);
        put(point.normal, at, &mut self.normal);
        put(point.view, at, &mut self.view);
        if let Some(anchors) = self.anchors.as_deref_mut() {
            put(point.anchor, at, anchors);
        }
        (self.cos_theta_o[at], self.distance[at]) = (point.cos_theta_o, hit.distance);
    }

    /// Fills the last vector up with copies of the last point.
    pub fn repeat_last(&mut self) {
        let Some(last) = self.count.checked_sub(1) else { return };
        let end = self.count.next_multiple_of(16);
        let vectors =
            [&mut self.offset, &mut self.normal, &mut self.view].into_iter().chain(self.anchors.as_deref_mut());
        for numbers in vectors.flatten().chain([&mut self.cos_theta_o, &mut self.distance, &mut self.ambient]) {
            let number = numbers[last];
            numbers[self.count..end].fill(number);
        }
    }

    /// The position of a point, in metres.
    pub fn position_of(&self, index: usize) -> Vector {
        let own_anchor = self.anchors.as_deref().map(|anchors| get(anchors, index));
        own_anchor.map_or(self.anchor, |own| self.anchor + own) + get(&self.offset, index) * self.unit
    }
}

/// Finds the points of a sphere that are seen at places within its outline: a job of its own, like
/// [`ShadeBlock`](super::kernel::ShadeBlock).
pub struct SeePoints<'b, E> {
    /// Where they go; how many there are, and of which sphere, is known.
    pub points: &'b mut SurfaceBlock<E>,
    /// The outline of the sphere.
    pub outline: &'b Ellipse,
    /// The places.
    pub places: Places<'b>,
}

impl<E: Element> LaneJob for SeePoints<'_, E> {
    type Output = ();

    #[inline(always)]
    fn run<S, D>(self, token: S::Token)
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>,
    {
        self.points.see::<<E::LaneOf<S, D> as Lane>::Narrow>(token, self.outline, &self.places);
    }
}

impl<E: Element> ShadedBlock<E> {
    /// With room for the separate irradiances of this many lights.
    #[expect(clippy::unnecessary_box_returns, reason = "too large for the stack")]
    pub fn new(lights: usize) -> Box<Self> {
        let zeros = [E::default(); SIZE];
        Box::new(Self {
            brightness: zeros,
            irradiance: zeros,
            diffuse: zeros,
            specular: zeros,
            ambient: zeros,
            ambient_error: zeros,
            by_light: vec![zeros; lights],
            is_whole: true,
            cosines: zeros,
            lobes: zeros,
            terms: Terms::default(),
        })
    }

    /// Takes the values of another block: each point's to its place.
    pub fn scatter(&mut self, places: &[usize], points: &Self) {
        let Self { brightness, irradiance, diffuse, specular, ambient, ambient_error, by_light, .. } = self;
        let arrays = [
            (brightness, &points.brightness),
            (irradiance, &points.irradiance),
            (diffuse, &points.diffuse),
            (specular, &points.specular),
            (ambient, &points.ambient),
            (ambient_error, &points.ambient_error),
        ];
        for (out, values) in arrays.into_iter().chain(by_light.iter_mut().zip(&points.by_light)) {
            for (value, place) in values.iter().zip(places) {
                out[*place] = *value;
            }
        }
    }
}
