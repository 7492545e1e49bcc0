//! The kernel: the brightness of points, summed over all lights, several points at a time. It does not know how the points
//! were found.

use std::ops::Range;

use super::block::{SIZE, ShadedBlock, SurfaceBlock};
use super::emitters::{BLOCK, Selection};
use super::lobe::{LobeOfKernel, NoLobe, Power, Room, WithCosine, WithoutCosine};
use crate::lanes::{Element, Lane, LaneJob, SimdToken};
use crate::light::{Pattern, PlacedEmitter};
use crate::reflectance::BrightnessFormula;
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
    /// Shades the points. Each of these kinds of lobes is compiled separately.
    #[inline(always)]
    pub fn shade<V>(&self, token: V::Token, shaded: &mut ShadedBlock<E>)
    where
        V: Lane<Element = E>,
        P: Points<V>,
        S: Visibility<V>,
    {
        match self.power {
            Power::None => self.shade_with::<V, _>(token, &NoLobe, shaded),
            Power::Whole(_) | Power::Any(_) => self.shade_with::<V, _>(token, &WithCosine, shaded),
            Power::WithoutCosine(_) => self.shade_with::<V, _>(token, &WithoutCosine, shaded),
        }
        if !shaded.by_light.is_empty() {
            token.in_own_function(
                #[inline(always)]
                || self.shade_by_light::<V>(token, shaded),
            );
        }
    }

    /// In three loops: the terms of the emitters, the sums of the lobes, the brightness. So each is short enough for the
    /// registers, and only the first is compiled for every way of finding points.
    #[inline(always)]
    fn shade_with<V, L>(&self, token: V::Token, lobe: &L, shaded: &mut ShadedBlock<E>)
    where
        V: Lane<Element = E>,
        L: LobeOfKernel<V>,
        P: Points<V>,
        S: Visibility<V>,
    {
        token.in_own_function(
            #[inline(always)]
            || match self.selection.block_ends {
                Some(ends) => self.sum_blocks::<V, L>(token, ends, lobe, shaded),
                None => self.sum::<V, L>(token, lobe, shaded),
            },
        );
    }

    /// Shades with a single block of emitters: as many points at a time as there is room for their terms.
    #[inline(always)]
    fn sum<V, L>(&self, token: V::Token, lobe: &L, shaded: &mut ShadedBlock<E>)
    where
        V: Lane<Element = E>,
        L: LobeOfKernel<V>,
        P: Points<V>,
        S: Visibility<V>,
    {
        let emitters = self.selection.emitters.len();
        let together = (BLOCK / emitters.max(1)).max(1) * V::COUNT;
        for start in (0..self.count).step_by(together) {
            let end = (start + together).min(self.count).next_multiple_of(V::COUNT);
            let mut room = shaded.terms.room::<V>((end - start) / V::COUNT * emitters);
            for at in (start..end).step_by(V::COUNT) {
                let point = self.points.point(token, at);
                let irradiance = self.terms(token, &point, at, 0..emitters, lobe, &mut room);
                irradiance.store(&mut shaded.irradiance[at..]);
                point.cos_theta_o.store(&mut shaded.cosines[at..]);
            }
            if L::IS_THERE {
                self.power.sum::<V>(token, &mut shaded.terms, emitters, &mut shaded.lobes[start..end]);
            }
            for at in (start..end).step_by(V::COUNT) {
                self.finish::<V, L>(token, at, shaded);
            }
        }
    }

    /// Shades with several blocks of emitters. Those of a block are summed plainly, and the blocks' sums with compensation, so
    /// that the error does not grow with the number of lights.
    #[inline(always)]
    fn sum_blocks<V, L>(&self, token: V::Token, ends: &[usize], lobe: &L, shaded: &mut ShadedBlock<E>)
    where
        V: Lane<Element = E>,
        L: LobeOfKernel<V>,
        P: Points<V>,
        S: Visibility<V>,
    {
        for at in (0..self.count).step_by(V::COUNT) {
            let point = self.points.point(token, at);
            let zero = point.cos_theta_o.splat_like(0.0);
            let (mut irradiance, mut lobes) = (Sum::starting_at(zero), Sum::starting_at(zero));
            let mut first = 0;
            for end in ends {
                let mut room = shaded.terms.room::<V>(end - first);
                irradiance.add(self.terms(token, &point, at, first..*end, lobe, &mut room));
                if L::IS_THERE {
                    let of_block = &mut shaded.lobes[at..at + V::COUNT];
                    self.power.sum::<V>(token, &mut shaded.terms, end - first, of_block);
                    lobes.add(V::load(token, of_block));
                }
                first = *end;
            }
            irradiance.value().store(&mut shaded.irradiance[at..]);
            lobes.value().store(&mut shaded.lobes[at..]);
            point.cos_theta_o.store(&mut shaded.cosines[at..]);
            self.finish::<V, L>(token, at, shaded);
        }
    }

    /// Σ E_j of up to [`BLOCK`] of the emitters at a vector of points, and the terms of the sum of the lobes. The loop for
    /// emitters that shine alike in all directions has no branches, so that the processor overlaps one emitter with the next.
    #[inline(always)]
    fn terms<V, L>(
        &self,
        token: V::Token,
        point: &SurfacePoint<V>,
        at: usize,
        emitters: Range<usize>,
        lobe: &L,
        room: &mut Room<'_, E>,
    ) -> V
    where
        V: Lane<Element = E>,
        L: LobeOfKernel<V>,
        P: Points<V>,
        S: Visibility<V>,
    {
        let anchors = self.points.anchors(token, at);
        let mut irradiance = point.cos_theta_o.splat_like(0.0);
        let those = self.selection.emitters[emitters.clone()].iter().zip(emitters);
        if self.selection.are_isotropic {
            for (emitter, index) in those {
                let emitter = placed(token, &PlacedEmitter { pattern: Pattern::Isotropic, ..*emitter }, anchors);
                let visibility = self.visibility.of(token, index, at);
                irradiance = irradiance + contribution(point, &emitter, visibility, lobe, room);
            }
        } else {
            for (emitter, index) in those {
                let emitter = placed(token, emitter, anchors);
                let visibility = self.visibility.of(token, index, at);
                irradiance = irradiance + contribution(point, &emitter, visibility, lobe, room);
            }
        }
        irradiance
    }

    /// B of a vector of points, and its parts if they are requested, from the sums.
    #[inline(always)]
    fn finish<V, L>(&self, token: V::Token, at: usize, shaded: &mut ShadedBlock<E>)
    where
        V: Lane<Element = E>,
        L: LobeOfKernel<V>,
        P: Points<V>,
    {
        let [irradiance, cosines] = [&shaded.irradiance, &shaded.cosines];
        let (irradiance, cos_theta_o) = (V::load(token, &irradiance[at..]), V::load(token, &cosines[at..]));
        let zero = cos_theta_o.splat_like(0.0);
        let lobes = if L::IS_THERE { V::load(token, &shaded.lobes[at..]) } else { zero };
        let ambient = self.points.ambient(token, at);
        let shading = Shading::new(irradiance + ambient, lobes, ambient, self.formula, cos_theta_o);
        shading.brightness().store(&mut shaded.brightness[at..]);
        if shaded.is_whole {
            shading.irradiance.store(&mut shaded.irradiance[at..]);
            shading.diffuse.store(&mut shaded.diffuse[at..]);
            shading.specular.store(&mut shaded.specular[at..]);
            shading.ambient.store(&mut shaded.ambient[at..]);
        }
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

/// E_j of an emitter at a vector of points; the term of its lobe is written down.
#[inline(always)]
fn contribution<V: Lane, L: LobeOfKernel<V>>(
    point: &SurfacePoint<V>,
    emitter: &PlacedEmitter<V>,
    visibility: V,
    lobe: &L,
    room: &mut Room<'_, V::Element>,
) -> V {
    let term = light_term(point, emitter, visibility, lobe);
    if L::IS_THERE {
        room.put(term.lobe_irradiance, term.lobe);
    }
    term.irradiance
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
