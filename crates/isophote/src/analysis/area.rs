//! The brightness over an area of interest: extremes and mean.
//!
//! The mean is an integral by Gaussian quadrature (on a circle in the radius, with evenly spaced angles), whose points are
//! doubled in each direction until it changes no more. The best of these points, of the outline and the centre are then
//! followed to the extreme by a search whose step is halved wherever no neighbour is better, so that an extreme between the
//! points, at the centre or on the outline is found to a billionth of the area's size.

use std::cell::Cell;

use super::probe::SeenFromEye;
use crate::camera::ScreenPosition;
use crate::prepare::PreparedScene;
use crate::render::{Observer, RenderError};
use crate::scene::{Area, AreaOutline, AreaPlace};
use crate::shade::Shading;
use crate::shape::Located;
use crate::sum::Sum;
use crate::vector::Vector;

/// What is known of the brightness over an area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AreaReading {
    /// The largest value.
    pub max: AreaExtreme,
    /// The smallest value.
    pub min: AreaExtreme,
    /// The mean over the area, as far as it shows a surface.
    pub mean: f64,
    /// By how much the mean changed when the points were doubled for the last time: an estimate of its error.
    pub mean_error: f64,
    /// The fraction of an area on the screen that shows a surface, or of one on a surface that the eye sees.
    pub visible: f64,
}

/// The largest or smallest value over an area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AreaExtreme {
    /// The value, in the unit of the brightness.
    pub value: f64,
    /// Where it is on the surface, in metres.
    pub point: Vector,
    /// Where it is on the screen, x and y in metres or degrees, for an area there.
    pub screen: Option<[f64; 2]>,
    /// Whether the eye sees the point.
    pub seen: SeenFromEye,
}

/// Points of the quadrature in each direction, from the first attempt to the last.
const LEAST: usize = 16;
const MOST: usize = 128;
/// The change of the mean, as a fraction of it, at which it is taken as final.
const SETTLED: f64 = 1e-12;
/// Places from which an extreme is searched.
const STARTS: usize = 6;
/// The step, as a fraction of the area's half size, at which a search ends.
const LAST_STEP: f64 = 1e-9;

/// A place within an area: (1, 0) and (0, 1) are at the ends of its half axes.
type Place = [f64; 2];

impl PreparedScene {
    /// The extremes and the mean of the brightness over an area; `None` if it shows no surface.
    #[must_use]
    pub fn area(&self, area: &Area) -> Option<AreaReading> {
        // Nobody asks to stop.
        self.area_observed(area, None).unwrap_or_default()
    }

    /// As [`area`](Self::area), with an observer, which hears of points and may end the work.
    ///
    /// # Errors
    /// [`RenderError::Interrupted`] at the observer's wish.
    pub fn area_observed(
        &self,
        area: &Area,
        observer: Option<&dyn Observer>,
    ) -> Result<Option<AreaReading>, RenderError> {
        let over = Over { scene: self, area, observer, is_stopped: Cell::new(false) };
        let reading = over.reading();
        if over.is_stopped.get() { Err(RenderError::Interrupted) } else { Ok(reading) }
    }

    /// The shading of a point on a surface; in a scene with colours, its luminances (3.10).
    fn shade_surface(&self, located: &Located) -> Shading {
        let shade = |scene: &Self| scene.shade(&scene.surface_point(located), None, |_, _| {});
        match self.components() {
            None => shade(self),
            Some(components) => {
                Shading::luminance(&components.scenes().map(shade), components.space.luminance_weights())
            }
        }
    }
}

/// The values at the points of a quadrature.
struct Pass {
    /// Place, weight and value; no value where no surface is seen.
    nodes: Vec<(Place, f64, Option<f64>)>,
}

impl Pass {
    fn mean(&self) -> Option<f64> {
        let (mut values, mut weights) = (Sum::new(), Sum::new());
        for (_, weight, value) in &self.nodes {
            if let Some(value) = value {
                values.add(weight * value);
                weights.add(*weight);
            }
        }
        (weights.value() > 0.0).then(|| values.value() / weights.value())
    }
}

struct Over<'a> {
    scene: &'a PreparedScene,
    area: &'a Area,
    observer: Option<&'a dyn Observer>,
    /// Whether the observer has asked to stop: there are no values then, and the reading is of no use.
    is_stopped: Cell<bool>,
}

impl Over<'_> {
    fn reading(&self) -> Option<AreaReading> {
        let mut points = LEAST;
        let mut pass = self.pass(points);
        loop {
            let finer = self.pass(2 * points);
            let change = (finer.mean()? - pass.mean().unwrap_or(f64::INFINITY)).abs();
            (points, pass) = (2 * points, finer);
            if change <= SETTLED * pass.mean()?.abs() || points == MOST {
                let visible = self.visible(&pass);
                let (max, min) = (self.extreme(&pass, points, 1.0)?, self.extreme(&pass, points, -1.0)?);
                return Some(AreaReading { max, min, mean: pass.mean()?, mean_error: change, visible });
            }
        }
    }

    fn pass(&self, points: usize) -> Pass {
        let nodes = nodes(&self.area.outline, points);
        Pass { nodes: nodes.into_iter().map(|(place, weight)| (place, weight, self.value(place))).collect() }
    }

    /// B at a place within the area.
    fn value(&self, place: Place) -> Option<f64> {
        if self.is_stopped.get() || self.observer.is_some_and(|observer| observer.advance(1).is_break()) {
            self.is_stopped.set(true);
            return None;
        }
        let shading = match self.area.place {
            AreaPlace::Surface { .. } => self.scene.shade_surface(&self.located(place)?),
            AreaPlace::Screen(_) => {
                let position = self.position(place)?;
                let hit = self.scene.trace(position)?;
                self.scene.shade_colored(&hit, position)
            }
        };
        Some(shading.brightness())
    }

    fn located(&self, place: Place) -> Option<Located> {
        let AreaPlace::Surface { shape, .. } = self.area.place else { return None };
        let point = self.area.place.point(self.area.outline.offset(place))?;
        Some(Located { shape, nearest: self.scene.scene().shapes()[shape].geometry.nearest(point) })
    }

    fn position(&self, place: Place) -> Option<ScreenPosition> {
        let AreaPlace::Screen([x, y]) = self.area.place else { return None };
        let [across, up] = self.area.outline.offset(place);
        Some(ScreenPosition::Point { x: x + across, y: y + up })
    }

    /// The fraction that shows a surface, or that the eye sees.
    #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^53 points")]
    fn visible(&self, pass: &Pass) -> f64 {
        let is_visible = |place: Place, value: Option<f64>| match self.located(place) {
            Some(located) => self.scene.seen_from_eye(&self.scene.surface_point(&located)) == SeenFromEye::Seen,
            None => value.is_some(),
        };
        // Counted, and not weighted, where all or nothing is visible: then it is exactly 1 or 0.
        let (mut visible, mut all, mut count) = (Sum::new(), Sum::new(), 0);
        for (place, weight, value) in &pass.nodes {
            all.add(*weight);
            if is_visible(*place, *value) {
                visible.add(*weight);
                count += 1;
            }
        }
        if count == pass.nodes.len() || count == 0 {
            return count as f64 / pass.nodes.len() as f64;
        }
        visible.value() / all.value()
    }

    /// The largest value (`sign` 1) or the smallest one (−1).
    fn extreme(&self, pass: &Pass, points: usize, sign: f64) -> Option<AreaExtreme> {
        #[expect(clippy::cast_precision_loss, reason = "at most 128")]
        let step = 4.0 / points as f64;
        let mut found: Option<(Place, f64)> = None;
        for start in self.starts(pass, points, step, sign) {
            let best = self.climb(start, step, sign);
            if found.is_none_or(|(_, value)| best.1 > value) {
                found = Some(best);
            }
        }
        let (place, value) = found?;
        self.told(place, sign * value)
    }

    /// The best places, no two of them neighbours, with their values times the sign.
    #[expect(clippy::cast_precision_loss, reason = "at most 512")]
    fn starts(&self, pass: &Pass, points: usize, step: f64, sign: f64) -> Vec<(Place, f64)> {
        let mut places: Vec<(Place, f64)> = Vec::new();
        // The centre comes first: of equal values, the first is kept.
        let edge = (0..4 * points).map(|index| {
            let turn = index as f64 / (4 * points) as f64 * std::f64::consts::TAU;
            let [u, v] = [libm::cos(turn), libm::sin(turn)];
            match self.area.outline {
                AreaOutline::Circle { .. } => [u, v],
                AreaOutline::Rectangle { .. } => [u, v].map(|side| side / u.abs().max(v.abs())),
            }
        });
        for place in std::iter::once([0.0, 0.0]).chain(edge) {
            places.extend(self.value(place).map(|value| (place, sign * value)));
        }
        places.extend(pass.nodes.iter().filter_map(|(place, _, value)| Some((*place, sign * (*value)?))));
        places.sort_by(|(_, one), (_, other)| other.total_cmp(one));
        let mut chosen: Vec<(Place, f64)> = Vec::new();
        for (place, value) in places {
            let is_apart =
                |other: &(Place, f64)| libm::hypot(place[0] - other.0[0], place[1] - other.0[1]) > 2.0 * step;
            if chosen.iter().all(is_apart) {
                chosen.push((place, value));
            }
            if chosen.len() == STARTS {
                break;
            }
        }
        chosen
    }

    /// Follows the value upwards, within the area.
    fn climb(&self, (mut place, mut value): (Place, f64), mut step: f64, sign: f64) -> (Place, f64) {
        const ASIDE: f64 = std::f64::consts::FRAC_1_SQRT_2;
        const WAYS: [[f64; 2]; 8] = [
            [1.0, 0.0],
            [0.0, 1.0],
            [-1.0, 0.0],
            [0.0, -1.0],
            [ASIDE, ASIDE],
            [-ASIDE, ASIDE],
            [-ASIDE, -ASIDE],
            [ASIDE, -ASIDE],
        ];
        while step > LAST_STEP {
            let best = WAYS
                .iter()
                .map(|[u, v]| self.area.outline.within([place[0] + step * u, place[1] + step * v]))
                .filter_map(|next| Some((next, sign * self.value(next)?)))
                .reduce(|best, next| if next.1 > best.1 { next } else { best });
            match best {
                Some((next, higher)) if higher > value => (place, value) = (next, higher),
                _ => step *= 0.5,
            }
        }
        (place, value)
    }

    fn told(&self, place: Place, value: f64) -> Option<AreaExtreme> {
        if let Some(located) = self.located(place) {
            let hit = self.scene.surface_point(&located);
            let seen = self.scene.seen_from_eye(&hit);
            return Some(AreaExtreme { value, point: hit.point.position(), screen: None, seen });
        }
        let position = self.position(place)?;
        let hit = self.scene.trace(position)?;
        let screen = Some(self.scene.frame().point_on_screen(position));
        Some(AreaExtreme { value, point: hit.point.position(), screen, seen: SeenFromEye::Seen })
    }
}

/// The places of a quadrature and their weights, which add up to the area of the unit circle or square.
fn nodes(outline: &AreaOutline, points: usize) -> Vec<(Place, f64)> {
    let gauss = gauss_legendre(points);
    match outline {
        AreaOutline::Rectangle { .. } => {
            let of_row = |&(v, of_v): &(f64, f64)| gauss.iter().map(move |&(u, of_u)| ([u, v], of_u * of_v));
            gauss.iter().flat_map(of_row).collect()
        }
        AreaOutline::Circle { .. } => {
            let angles = 2 * points;
            #[expect(clippy::cast_precision_loss, reason = "at most 256")]
            let turn = |index: usize| (index as f64 + 0.5) / angles as f64 * std::f64::consts::TAU;
            #[expect(clippy::cast_precision_loss, reason = "at most 256")]
            let share = std::f64::consts::TAU / angles as f64;
            let of_ring = |&(u, weight): &(f64, f64)| {
                let radius = f64::midpoint(u, 1.0);
                (0..angles).map(move |index| {
                    let place = [radius * libm::cos(turn(index)), radius * libm::sin(turn(index))];
                    (place, 0.5 * weight * radius * share)
                })
            };
            gauss.iter().flat_map(of_ring).collect()
        }
    }
}

/// The nodes and weights of Gauss-Legendre quadrature from −1 to 1, by Newton's method on the Legendre polynomial.
#[expect(clippy::cast_precision_loss, reason = "at most 128")]
fn gauss_legendre(points: usize) -> Vec<(f64, f64)> {
    let node = |index: usize| {
        let mut x = libm::cos(std::f64::consts::PI * (index as f64 + 0.75) / (points as f64 + 0.5));
        let mut slope = 1.0;
        for _ in 0..8 {
            let (mut before, mut value) = (1.0, x);
            for degree in 2..=points {
                let k = degree as f64;
                (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
            }
            slope = points as f64 * (x * value - before) / (x * x - 1.0);
            x -= value / slope;
        }
        (x, 2.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..points).map(node).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Exact for polynomials up to degree 2n − 1.
    #[test]
    fn the_quadrature_integrates_polynomials_exactly() {
        for points in [1, 2, 5, 16, 128] {
            for power in 0..(2 * points).min(40) {
                #[expect(clippy::cast_possible_wrap, clippy::cast_possible_truncation, reason = "small")]
                let exponent = power as i32;
                let found: f64 = gauss_legendre(points).iter().map(|(x, weight)| weight * x.powi(exponent)).sum();
                let expected = if power % 2 == 0 { 2.0 / f64::from(exponent + 1) } else { 0.0 };
                assert!((found - expected).abs() < 1e-14, "{points} {power}: {found}");
            }
        }
    }

    /// ∫ x² over the unit circle is π/4, over the square 4/3.
    #[test]
    fn the_nodes_cover_the_outline() {
        let moment = |outline: AreaOutline| -> [f64; 2] {
            let nodes = nodes(&outline, 16);
            [0, 2].map(|power| nodes.iter().map(|([u, _], weight)| weight * u.powi(power)).sum())
        };
        let [area, moment_of_circle] = moment(AreaOutline::Circle { radius: 3.0 });
        assert!(
            (area - std::f64::consts::PI).abs() < 1e-13
                && (moment_of_circle - std::f64::consts::FRAC_PI_4).abs() < 1e-13
        );
        let [area, moment_of_square] = moment(AreaOutline::Rectangle { half: [3.0, 1.0] });
        assert!((area - 4.0).abs() < 1e-13 && (moment_of_square - 4.0 / 3.0).abs() < 1e-13);
    }
}
