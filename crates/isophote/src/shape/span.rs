//! The part of a ray that is inside a convex body: the intersection of the parts between its pairs of faces.

use crate::scalar::Scalar;

/// Where a ray crosses a face, measured from the point of the ray that is nearest to the body's origin.
#[derive(Clone, Copy, Debug)]
pub struct Crossing<T> {
    /// The distance along the ray, in metres.
    pub at: T,
    /// Its possible rounding error in double precision, in metres.
    pub error: f64,
    /// The index of the face.
    pub face: usize,
}

/// The part of a ray between two faces; empty if it leaves before it enters.
#[derive(Clone, Copy, Debug)]
pub struct Span<T> {
    /// Where it begins.
    pub enter: Crossing<T>,
    /// Where it ends.
    pub leave: Crossing<T>,
}

/// How a ray passes through a convex body.
#[derive(Clone, Copy, Debug)]
pub struct Passage<T> {
    /// The nearest face that is crossed in front of the start.
    pub crossing: Option<Crossing<T>>,
    /// Whether the ray starts inside.
    pub from_inside: bool,
    /// See [`Intersection::doubtful_from`](super::Intersection::doubtful_from), in metres.
    pub doubtful_from: Option<f64>,
}

/// Farther away than anything in a scene, in metres.
pub const NEVER: f64 = 1e200;

impl<T: Scalar> Span<T> {
    /// Between two parallel planes: where `place + at · direction` is between `low` and `high`. `error` is the error of the
    /// place.
    #[inline]
    pub fn between(place: T, direction: T, [low, high]: [T; 2], error: f64, [low_face, high_face]: [usize; 2]) -> Self {
        let slope = direction.rounded();
        if slope == 0.0 {
            let is_inside = low.is_less(place) && place.is_less(high);
            let margin = (place - low).rounded().abs().min((high - place).rounded().abs());
            let error = if margin > error { 0.0 } else { 2.0 * NEVER };
            return Self::always(is_inside, error, low_face);
        }
        let error = error / slope.abs();
        let inverse = T::from_f64(1.0) / direction;
        let first = Crossing { at: (low - place) * inverse, error, face: low_face };
        let second = Crossing { at: (high - place) * inverse, error, face: high_face };
        if slope > 0.0 { Self { enter: first, leave: second } } else { Self { enter: second, leave: first } }
    }

    /// The whole ray, or none of it.
    #[inline]
    pub fn always(is_inside: bool, error: f64, face: usize) -> Self {
        let end = if is_inside { NEVER } else { -NEVER };
        let crossing = |at| Crossing { at: T::from_f64(at), error, face };
        Self { enter: crossing(-end), leave: crossing(end) }
    }
}

/// How a ray that starts at −`along` passes through the body that is the intersection of these spans.
#[inline]
pub fn pass<T: Scalar, const N: usize>(spans: [Span<T>; N], along: T) -> Passage<T> {
    let (mut enter, mut leave) = (spans[0].enter, spans[0].leave);
    let [mut earliest_enter, mut latest_enter] = [f64::NEG_INFINITY; 2];
    let [mut earliest_leave, mut latest_leave] = [f64::INFINITY; 2];
    for span in &spans {
        if enter.at.is_less(span.enter.at) {
            enter = span.enter;
        }
        if span.leave.at.is_less(leave.at) {
            leave = span.leave;
        }
        let (first, last) = (span.enter.at.rounded(), span.leave.at.rounded());
        earliest_enter = earliest_enter.max(first - span.enter.error);
        latest_enter = latest_enter.max(first + span.enter.error);
        earliest_leave = earliest_leave.min(last - span.leave.error);
        latest_leave = latest_leave.min(last + span.leave.error);
    }
    let start = -along.rounded();
    if earliest_enter > latest_leave || latest_leave < start {
        return Passage { crossing: None, from_inside: false, doubtful_from: None };
    }
    let is_before_start = |at: T| !T::zero().is_less(along + at);
    let from_inside = is_before_start(enter.at);
    let is_hit = enter.at.is_less(leave.at) && !is_before_start(leave.at);
    let starts_at_surface = earliest_enter <= start && start <= latest_enter || earliest_leave <= start;
    let rivals = |ours: usize, may_be_first: &dyn Fn(&Span<T>) -> bool| {
        spans.iter().filter(|span| may_be_first(span)).count() > ours
    };
    let is_other_face = if from_inside {
        let last = leave.at.rounded() + leave.error;
        rivals(1, &|span| span.leave.at.rounded() - span.leave.error <= last)
    } else {
        let first = enter.at.rounded() - enter.error;
        rivals(1, &|span| span.enter.at.rounded() + span.enter.error >= first)
    };
    let is_doubtful = latest_enter >= earliest_leave || starts_at_surface || is_other_face;
    let from = if from_inside && !starts_at_surface { earliest_leave } else { earliest_enter };
    Passage {
        crossing: is_hit.then_some(if from_inside { leave } else { enter }),
        from_inside,
        doubtful_from: is_doubtful.then(|| (from - start).max(0.0)),
    }
}
