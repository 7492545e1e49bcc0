//! Which pixels of a group see a light.

use super::group::{Group, MOST};
use crate::lanes::Lane;
use crate::prepare::PreparedScene;
use crate::render::shading::block::SurfaceBlock;
use crate::render::vectors::{greatest_of, least_of, splat};
use crate::vector::Vector;

/// Decisions with a smaller relative margin than this are left to 32 digits. Rounding errors can reach some 1e-14.
const DOUBTFUL: f64 = 1e-9;

/// The rounding error of squared distances, as a fraction of the squared distance to the blocker from which they are
/// computed.
const ROUNDING: f64 = 32.0 * f64::EPSILON;

/// The visibility of one light.
pub struct Shadows {
    /// For each vector, the lanes above the light's horizon, those that are certainly blocked, and those that may be
    /// blocked.
    lit: [u32; VECTORS],
    blocked: [u32; VECTORS],
    possible: [u32; VECTORS],
}

/// The number of vectors of the shortest kind, which have two lanes.
const VECTORS: usize = MOST / 2;

/// A sphere that may block the light, in units of the receiving sphere's radius, relative to its centre.
struct Blocker {
    center: Vector,
    radius: f64,
}

impl Shadows {
    /// No lights tested yet.
    pub const NEW: Self = Self { lit: [0; VECTORS], blocked: [0; VECTORS], possible: [0; VECTORS] };

    /// Computes v_j of the pixels of a group into `visible`: 1 where they see a light, 0 where they do not. Returns false if
    /// all of them are below its horizon. Lanes in doubt are given by [`doubtful`](Self::doubtful).
    #[inline(always)]
    pub fn find<S, D>(
        &mut self,
        token: S::Token,
        scene: &PreparedScene,
        group: &mut Group<'_>,
        points: &SurfaceBlock<f64>,
        light: Vector,
        visible: &mut [f64],
    ) -> bool
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>,
    {
        let vectors = points.count.div_ceil(D::COUNT);
        let Some([least, greatest]) = self.horizon::<D>(token, points, vectors, light) else { return false };
        self.search::<S, D>(token, scene, group, points, light, [least, greatest], vectors);
        let (zero, one) = (D::splat(token, 0.0), D::splat(token, 1.0));
        for vector in 0..vectors {
            let at = vector * D::COUNT;
            let out = &mut visible[at..at + D::COUNT];
            if self.blocked[vector] == 0 {
                one.store(out);
            } else {
                zero.store(out);
                for (lane, out) in out.iter_mut().enumerate() {
                    if self.blocked[vector] >> lane & 1 == 0 {
                        *out = 1.0;
                    }
                }
            }
        }
        true
    }

    /// The lanes of a vector for which the answer is uncertain.
    #[inline(always)]
    pub fn doubtful(&self, vector: usize) -> u32 {
        self.lit[vector] & self.possible[vector] & !self.blocked[vector]
    }

    /// Finds the lanes that face the light, and the box around their points.
    #[inline(always)]
    fn horizon<D: Lane<Element = f64>>(
        &mut self,
        token: D::Token,
        points: &SurfaceBlock<f64>,
        vectors: usize,
        light: Vector,
    ) -> Option<[Vector; 2]> {
        let light = splat::<D>(token, light);
        let zero = D::splat(token, 0.0);
        let far = D::splat(token, 2.0);
        let (mut x_range, mut y_range, mut z_range) = ([far, -far], [far, -far], [far, -far]);
        let mut any = 0;
        for vector in 0..vectors {
            let normal = points.normal_at::<D>(token, vector * D::COUNT);
            let is_lit = zero.is_less(normal.dot(light - normal));
            let lit = D::bits(is_lit);
            (self.lit[vector], self.blocked[vector], self.possible[vector]) = (lit, 0, 0);
            any |= lit;
            x_range = widened(x_range, is_lit, normal.x, far);
            y_range = widened(y_range, is_lit, normal.y, far);
            z_range = widened(z_range, is_lit, normal.z, far);
        }
        if any == 0 {
            return None;
        }
        let least = Vector::new(least_of(x_range[0]), least_of(y_range[0]), least_of(z_range[0]));
        let greatest = Vector::new(greatest_of(x_range[1]), greatest_of(y_range[1]), greatest_of(z_range[1]));
        Some([least, greatest])
    }

    /// Tests the spheres in the tube to the light, until no pixel sees the light any more.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "none of them belongs to another")]
    fn search<S, D>(
        &mut self,
        token: S::Token,
        scene: &PreparedScene,
        group: &mut Group<'_>,
        points: &SurfaceBlock<f64>,
        light: Vector,
        [least, greatest]: [Vector; 2],
        vectors: usize,
    ) where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>,
    {
        let SurfaceBlock { anchor: center, unit: radius, .. } = *points;
        let middle = (least + greatest) * 0.5;
        // Pixels in doubt may be slightly outside.
        let half = (greatest - least) * (0.5 + 1e-6) + Vector::new(1e-6, 1e-6, 1e-6);
        let axis = light - middle;
        let tree = scene.accelerator();
        let Some(tube) = tree.tube(center + middle * radius, axis * radius, half * radius) else { return };
        let (reach, per_radius) = (half.length(), 1.0 / radius);
        let per_squared = 1.0 / axis.dot(axis);
        group.walk.start(tree);
        while let Some(number) = group.walk.next::<S>(token, tree, &tube, tube.depth_of(1.0)) {
            let primitive = scene.primitive(number);
            if number == group.seen.primitive || !scene.scene().shapes()[primitive.shape].casts_shadow {
                continue;
            }
            let Some(other) = scene.sphere(primitive) else { continue };
            let blocker = Blocker { center: (other.center - center) * per_radius, radius: other.radius * per_radius };
            let from_middle = blocker.center - middle;
            let along = (from_middle.dot(axis) * per_squared).clamp(0.0, 1.0);
            let off = from_middle - axis * along;
            let widest = (reach + blocker.radius) * (1.0 + 1e-6) + 1e-12 * from_middle.length();
            if off.dot(off) > widest * widest {
                continue;
            }
            let to_light = light - blocker.center;
            let nearest = blocker.radius * blocker.radius * (1.0 + DOUBTFUL);
            if to_light.dot(to_light) * (1.0 - ROUNDING) <= nearest {
                // The light is inside the blocker, or on its surface.
                self.possible.fill(u32::MAX);
                return;
            }
            if self.block::<D>(token, points, light, &blocker, vectors) {
                return;
            }
        }
    }

    /// Tests a blocker; returns true if no pixel sees the light any more.
    #[inline(always)]
    fn block<D: Lane<Element = f64>>(
        &mut self,
        token: D::Token,
        points: &SurfaceBlock<f64>,
        light: Vector,
        blocker: &Blocker,
        vectors: usize,
    ) -> bool {
        let light = splat::<D>(token, light);
        let center = splat::<D>(token, blocker.center);
        let squared = blocker.radius * blocker.radius;
        let margin = D::splat(token, DOUBTFUL * squared + ROUNDING * blocker.radius);
        let squared = D::splat(token, squared);
        let (zero, rounding) = (D::splat(token, 0.0), D::splat(token, ROUNDING));
        let mut rest = 0;
        for vector in 0..vectors {
            if self.lit[vector] & !self.blocked[vector] == 0 {
                continue;
            }
            let normal = points.normal_at::<D>(token, vector * D::COUNT);
            let (to_light, to_blocker) = (light - normal, center - normal);
            let length = to_light.dot(to_light);
            let along = to_blocker.dot(to_light);
            let distance = to_blocker.dot(to_blocker);
            let margin = rounding.mul_add(distance, margin);
            // The squared distance of the blocker's centre from the ray, times the squared distance of the light.
            let across = (-along).mul_add(along, distance * length);
            let between = along.min(length - along);
            let certain = (squared - margin).mul_add(length, -across).min(between);
            let possible = (squared + margin).mul_add(length, -across).min(between);
            let touching = squared + margin - distance;
            self.blocked[vector] |= D::bits(zero.is_less(certain)) & !D::bits(zero.is_less(touching));
            self.possible[vector] |= D::bits(zero.is_less(possible.max(touching)));
            rest |= self.lit[vector] & !self.blocked[vector];
        }
        rest == 0
    }
}

/// Extends a range of numbers to include more.
#[inline(always)]
fn widened<D: Lane<Element = f64>>([least, greatest]: [D; 2], is_lit: D::Mask, numbers: D, far: D) -> [D; 2] {
    [least.min(D::select(is_lit, numbers, far)), greatest.max(D::select(is_lit, numbers, -far))]
}
