//! The kernel: the brightness of points, summed over all lights, several points at a time. It does not know how the points
//! were found.

use std::ops::Range;

use super::block::{SIZE, ShadedBlock, SurfaceBlock};
use super::emitters::Selection;
use super::lobe::{NoLobe, Power};
use crate::lanes::{Element, Lane, LaneJob, SimdToken};
use crate::light::PlacedEmitter;
use crate::reflectance::{BrightnessFormula, Lobe};
use crate::shade::{Shading, light_term};
use crate::shape::SurfacePoint;
use crate::sum::Sum;
use crate::vector::Vector;

/// Where a kernel's points come from: from a block, or straight from the outline that they lie in.
pub trait Points<V: Lane> {
    /// A vector of points, starting at an index.
    fn point(&self, token: V::Token, at: usize) -> SurfacePoint<V>;

    /// E_a of these points.
    fn ambient(&self, token: V::Token, at: usize) -> V;

    /// Their own anchors, if emitters are given relative to another place.
    #[inline(always)]
    fn anchors(&self, _: V::Token, _: usize) -> Option<Vector<V>> {
        None
    }
}

impl<V: Lane> Points<V> for SurfaceBlock<V::Element> {
    #[inline(always)]
    fn point(&self, token: V::Token, at: usize) -> SurfacePoint<V> {
        self.point_at(token, at)
    }

    #[inline(always)]
    fn ambient(&self, token: V::Token, at: usize) -> V {
        V::load(token, &self.ambient[at..])
    }

    #[inline(always)]
    fn anchors(&self, token: V::Token, at: usize) -> Option<Vector<V>> {
        self.anchors_at(token, at)
    }
}

/// The fraction of each emitter that the points see.
pub trait Visibility<V: Lane> {
    /// v of an emitter, by its index in the selection, at a vector of points.
    fn of(&self, token: V::Token, emitter: usize, at: usize) -> V;
}

/// Every emitter is fully visible.
pub struct Unobstructed;

impl<V: Lane> Visibility<V> for Unobstructed {
    #[inline(always)]
    fn of(&self, token: V::Token, _: usize, _: usize) -> V {
        V::splat(token, V::Element::default()).splat_like(1.0)
    }
}

/// A number from 0 to 1 for each emitter and point.
pub struct PerPoint<'v> {
    /// All of the numbers, emitter after emitter.
    pub visible: &'v [f64],
    /// The offset from one emitter to the next.
    pub stride: usize,
}

impl PerPoint<'_> {
    /// All of every emitter.
    pub const ALL: PerPoint<'static> = PerPoint { visible: &ONES, stride: 0 };
}

static ONES: [f64; SIZE] = [1.0; SIZE];

impl<V: Lane> Visibility<V> for PerPoint<'_> {
    #[inline(always)]
    fn of(&self, token: V::Token, emitter: usize, at: usize) -> V {
        V::load_doubles(token, &self.visible[emitter * self.stride + at..])
    }
}

/// A block of points to be shaded: a job of its own, which is compiled once, whatever found the points.
pub struct ShadeBlock<'b, E> {
    /// The points.
    pub points: &'b SurfaceBlock<E>,
    /// Their convention, applied to their material.
    pub formula: &'b BrightnessFormula,
    /// How the lobe of the formula is computed.
    pub power: &'b Power,
    /// What may light any of the points.
    pub selection: Selection<'b, E>,
    /// What part of each of these emitters the points see.
    pub visibility: PerPoint<'b>,
    /// Where the results go.
    pub shaded: &'b mut ShadedBlock<E>,
}

impl<E: Element> LaneJob for ShadeBlock<'_, E> {
    type Output = ();

    #[inline(always)]
    fn run<S, D>(self, token: S::Token)
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>,
    {
        let Self { points, formula, power, selection, visibility, shaded } = self;
        let lit = Lit { points, count: points.count, formula, power, selection, visibility: &visibility };
        lit.shade::<<E::LaneOf<S, D> as Lane>::Narrow>(token, shaded);
    }
}

/// Points and the light that falls on them.
pub struct Lit<'l, P, S, E> {
    /// The points.
    pub points: &'l P,
    /// How many there are.
    pub count: usize,
    /// The convention, applied to their material.
    pub formula: &'l BrightnessFormula,
    /// How the formula's lobe is computed.
    pub power: &'l Power,
    /// The emitters that may light any of the points.
    pub selection: Selection<'l, E>,
    /// The fraction of each emitter that the points see.
    pub visibility: &'l S,
}

impl<P, S, E: Element> Lit<'_, P, S, E> {
    /// Shades the points: the only place that chooses the kind of lobe. Each kind is compiled separately.
    #[inline(always)]
    pub fn shade<V>(&self, token: V::Token, shaded: &mut ShadedBlock<E>)
    where
        V: Lane<Element = E>,
        P: Points<V>,
        S: Visibility<V>,
    {
        match self.power {
            Power::None => self.shade_with::<V, _>(token, &NoLobe, shaded),
            Power::Even(lobe) => self.shade_with::<V, _>(token, lobe, shaded),
            Power::Odd(lobe) => self.shade_with::<V, _>(token, lobe, shaded),
            Power::Any(lobe) => self.shade_with::<V, _>(token, lobe, shaded),
            Power::WithoutCosine(lobe) => self.shade_with::<V, _>(token, lobe, shaded),
        }
        if !shaded.by_light.is_empty() {
            token.in_own_function(
                #[inline(always)]
                || self.shade_by_light::<V>(token, shaded),
            );
        }
    }

    #[inline(always)]
    fn shade_with<V, L>(&self, token: V::Token, lobe: &L, shaded: &mut ShadedBlock<E>)
    where
        V: Lane<Element = E>,
        L: Lobe<V>,
        P: Points<V>,
        S: Visibility<V>,
    {
        token.in_own_function(
            #[inline(always)]
            || {
                for at in (0..self.count).step_by(V::COUNT) {
                    let point = self.points.point(token, at);
                    let [irradiance, lobes] = self.sum(token, &point, at, lobe);
                    let ambient = self.points.ambient(token, at);
                    let shading = Shading::new(irradiance + ambient, lobes, ambient, self.formula, point.cos_theta_o);
                    shading.brightness().store(&mut shaded.brightness[at..]);
                    shading.irradiance.store(&mut shaded.irradiance[at..]);
                    shading.diffuse.store(&mut shaded.diffuse[at..]);
                    shading.specular.store(&mut shaded.specular[at..]);
                    shading.ambient.store(&mut shaded.ambient[at..]);
                }
            },
        );
    }

    /// Σ E_j and Σ E_j (N·H_j)ⁿ (Σ v_j I_j/r_j² (N·H_j)ⁿ in (3.11) and (3.12)) at a vector of points. Emitters of a block are summed plainly, and the blocks' sums with
    /// compensation, so that the error does not grow with the number of lights.
    #[inline(always)]
    fn sum<V, L>(&self, token: V::Token, point: &SurfacePoint<V>, at: usize, lobe: &L) -> [V; 2]
    where
        V: Lane<Element = E>,
        L: Lobe<V>,
        P: Points<V>,
        S: Visibility<V>,
    {
        let zero = point.cos_theta_o.splat_like(0.0);
        let Some(ends) = self.selection.block_ends else {
            return self.plain_sum(token, point, at, 0..self.selection.emitters.len(), lobe);
        };
        let (mut irradiance, mut lobes) = (Sum::starting_at(zero), Sum::starting_at(zero));
        let mut first = 0;
        for end in ends {
            let [of_block, lobes_of_block] = self.plain_sum(token, point, at, first..*end, lobe);
            irradiance.add(of_block);
            lobes.add(lobes_of_block);
            first = *end;
        }
        [irradiance.value(), lobes.value()]
    }

    /// The same sums over some of the emitters, by plain addition.
    #[inline(always)]
    fn plain_sum<V, L>(
        &self,
        token: V::Token,
        point: &SurfacePoint<V>,
        at: usize,
        emitters: Range<usize>,
        lobe: &L,
    ) -> [V; 2]
    where
        V: Lane<Element = E>,
        L: Lobe<V>,
        P: Points<V>,
        S: Visibility<V>,
    {
        let zero = point.cos_theta_o.splat_like(0.0);
        let (mut irradiance, mut lobes) = (zero, zero);
        let anchors = self.points.anchors(token, at);
        for (emitter, index) in self.selection.emitters[emitters.clone()].iter().zip(emitters) {
            let emitter = placed(token, emitter, anchors);
            let term = light_term(point, &emitter, self.visibility.of(token, index, at), lobe);
            irradiance = irradiance + term.irradiance;
            lobes = term.lobe_irradiance.mul_add(term.lobe, lobes);
        }
        [irradiance, lobes]
    }

    /// E_j of the lights whose own irradiance is requested.
    #[inline(always)]
    fn shade_by_light<V>(&self, token: V::Token, shaded: &mut ShadedBlock<E>)
    where
        V: Lane<Element = E>,
        P: Points<V>,
        S: Visibility<V>,
    {
        for at in (0..self.count).step_by(V::COUNT) {
            let point = self.points.point(token, at);
            for out in &mut shaded.by_light {
                point.cos_theta_o.splat_like(0.0).store(&mut out[at..]);
            }
            for (place, index) in self.selection.asked_for {
                let emitter = placed(token, &self.selection.emitters[*index], self.points.anchors(token, at));
                let visibility = self.visibility.of(token, *index, at);
                let irradiance = light_term(&point, &emitter, visibility, &NoLobe).irradiance;
                let out = &mut shaded.by_light[*place][at..];
                (V::load(token, out) + irradiance).store(out);
            }
        }
    }
}

/// An emitter as seen from the anchors of some points, or, if they have none of their own, from that of their block.
#[inline(always)]
fn placed<V: Lane>(
    token: V::Token,
    emitter: &PlacedEmitter<V::Element>,
    anchors: Option<Vector<V>>,
) -> PlacedEmitter<V> {
    let emitter = emitter.map(
        #[inline(always)]
        |element| V::splat(token, element),
    );
    match anchors {
        Some(anchors) if !emitter.pattern.is_parallel() => {
            PlacedEmitter { position: emitter.position - anchors, ..emitter }
        }
        _ => emitter,
    }
}
