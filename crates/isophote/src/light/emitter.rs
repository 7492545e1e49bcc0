//! Lights in the form that the sums over them use.

use std::ops::Range;

use super::{Light, LightKind, Pattern};
use crate::real::Real;
use crate::scalar::Scalar;
use crate::vector::Vector;

/// One term of the sum (3.1). A point light or a parallel light is one emitter; a lamp with a size is several.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emitter {
    /// Index of its light among those of the scene.
    pub light: usize,
    /// Its position, in metres; L, a unit vector, for a parallel light.
    pub position: Vector,
    /// I₀, in W/sr or cd; E₀, in W/m² or lx, for a parallel light.
    pub intensity: f64,
    /// How the intensity depends on the direction.
    pub pattern: Pattern,
}

/// An emitter as seen from a place near the points that it lights.
///
/// A parallel emitter is at distance 1 from each point, so that its irradiance is E₀ cosθ_i/1².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedEmitter<T = f64> {
    /// From that place to the emitter; L for a parallel one.
    pub position: Vector<T>,
    /// I₀; E₀ for a parallel one.
    pub intensity: T,
    /// How the intensity depends on the direction.
    pub pattern: Pattern<T>,
}

/// The emitters of a scene, in the order of its lights, which is the order of every sum.
#[derive(Clone, Debug, PartialEq)]
pub struct Emitters {
    all: Vec<Emitter>,
    /// The index of each light's first emitter, followed by the number of emitters.
    first: Vec<usize>,
}

impl Emitters {
    /// The emitters of these lights.
    #[must_use]
    pub fn of(lights: &[Light]) -> Self {
        Self::new(lights.iter().map(|light| [light.emitter()]))
    }

    /// From the emitters of each light.
    fn new<E: IntoIterator<Item = Emitter>>(of_lights: impl ExactSizeIterator<Item = E>) -> Self {
        let lights = of_lights.len();
        let (mut all, mut first) = (Vec::with_capacity(lights), Vec::with_capacity(lights + 1));
        first.push(0);
        for (light, emitters) in of_lights.enumerate() {
            all.extend(emitters.into_iter().map(|emitter| Emitter { light, ..emitter }));
            first.push(all.len());
        }
        Self { all, first }
    }

    /// All emitters.
    #[must_use]
    #[inline(always)]
    pub fn all(&self) -> &[Emitter] {
        &self.all
    }

    /// The indices of a light's emitters.
    #[must_use]
    pub fn of_light(&self, light: usize) -> Range<usize> {
        self.first[light]..self.first[light + 1]
    }

    /// The same lights, with each emitter replaced by two of half its strength.
    #[cfg(test)]
    pub(crate) fn halved(&self) -> Self {
        let halves = |light| {
            let half = |emitter: &Emitter| Emitter { intensity: 0.5 * emitter.intensity, ..*emitter };
            self.all[self.of_light(light)].iter().flat_map(|emitter| [half(emitter); 2]).collect::<Vec<_>>()
        };
        Self::new((0..self.first.len() - 1).map(halves))
    }
}

impl Light {
    fn emitter(&self) -> Emitter {
        let (position, intensity, pattern) = match &self.kind {
            LightKind::Point(light) => (light.position, light.intensity, light.emission.pattern()),
            LightKind::Parallel(light) => (-light.direction, light.irradiance, Pattern::Parallel),
        };
        Emitter { light: 0, position, intensity, pattern }
    }
}

impl Emitter {
    /// Its position, in metres; `None` for a parallel emitter, which is outside everything.
    #[must_use]
    pub fn place(&self) -> Option<Vector> {
        (!self.pattern.is_parallel()).then_some(self.position)
    }

    /// The vector from a place to the emitter, in metres; L, a unit vector, for a parallel one.
    #[must_use]
    #[inline(always)]
    pub fn from_place<T: Scalar>(&self, anchor: Vector, offset: Vector<T>) -> Vector<T> {
        self.seen_from(anchor).from_point(offset)
    }

    /// The emitter as seen from a place.
    #[must_use]
    #[inline(always)]
    pub fn seen_from<T: Scalar>(&self, place: Vector) -> PlacedEmitter<T> {
        let position = Vector::from_f64(self.position);
        PlacedEmitter {
            position: if self.pattern.is_parallel() { position } else { position - Vector::from_f64(place) },
            intensity: T::from_f64(self.intensity),
            pattern: self.pattern.map(T::from_f64),
        }
    }
}

impl PlacedEmitter {
    /// The same emitter with lengths in another unit, given in metres. Irradiances do not change.
    #[must_use]
    #[inline(always)]
    pub fn in_unit(self, unit: f64) -> Self {
        if self.pattern.is_parallel() {
            return self;
        }
        Self { position: self.position * (1.0 / unit), intensity: self.intensity / (unit * unit), ..self }
    }
}

impl<T: Copy> PlacedEmitter<T> {
    /// The same emitter in another number type.
    #[must_use]
    #[inline(always)]
    pub fn map<U>(&self, convert: impl Fn(T) -> U) -> PlacedEmitter<U> {
        PlacedEmitter {
            position: self.position.map(&convert),
            intensity: convert(self.intensity),
            pattern: self.pattern.map(convert),
        }
    }
}

impl<T: Real> PlacedEmitter<T> {
    /// The vector from a point, given relative to the same place as the emitter, to the emitter.
    #[inline(always)]
    pub fn from_point(&self, offset: Vector<T>) -> Vector<T> {
        if self.pattern.is_parallel() { self.position } else { self.position - offset }
    }

    /// I(ω) towards a point, in W/sr or cd. `to_light` is the vector from the point to the emitter; its length is
    /// 1/`inverse_distance`.
    #[inline(always)]
    pub fn intensity_towards(&self, to_light: Vector<T>, inverse_distance: T) -> T {
        self.pattern.towards(self.intensity, to_light, inverse_distance)
    }
}
