//! A contour on the page, parameterised by its length.

use crate::figure::drawing::Place;

/// A polyline on the page, with the length in px from its start to each point.
pub(super) struct Curve {
    places: Vec<Place>,
    lengths: Vec<f64>,
    pub(super) closed: bool,
}

impl Curve {
    /// At least two points. A closed curve returns to its first point, which is not repeated.
    pub(super) fn new(mut places: Vec<Place>, closed: bool) -> Self {
        if closed {
            places.push(places[0]);
        }
        let mut lengths = vec![0.0];
        lengths.extend(places.windows(2).scan(0.0, |length, pair| {
            *length += pair[0].distance(pair[1]);
            Some(*length)
        }));
        Self { places, lengths, closed }
    }

    /// The total length in px.
    pub(super) fn length(&self) -> f64 {
        self.lengths[self.lengths.len() - 1]
    }

    /// The point at a given length from the start; on a closed curve lengths wrap around, on an open one they stop at
    /// the ends.
    pub(super) fn at(&self, length: f64) -> Place {
        let total = self.length();
        let length = if self.closed { length.rem_euclid(total) } else { length.clamp(0.0, total) };
        let after = self.lengths.partition_point(|&reached| reached < length).clamp(1, self.lengths.len() - 1);
        let (from, to) = (self.places[after - 1], self.places[after]);
        let step = self.lengths[after] - self.lengths[after - 1];
        let fraction = if step > 0.0 { (length - self.lengths[after - 1]) / step } else { 0.0 };
        Place { x: from.x + fraction * (to.x - from.x), y: from.y + fraction * (to.y - from.y) }
    }

    /// The distance between two lengths along the curve; on a closed one, the shorter way round.
    pub(super) fn apart(&self, one: f64, other: f64) -> f64 {
        let apart = (one - other).abs();
        if self.closed { apart.min(self.length() - apart) } else { apart }
    }

    /// The part between two lengths; on a closed curve `to` may be one round further.
    pub(super) fn piece(&self, from: f64, to: f64) -> Vec<Place> {
        let rounds: &[f64] = if self.closed { &[0.0, 1.0] } else { &[0.0] };
        let mut piece = vec![self.at(from)];
        for round in rounds {
            let inner = self.lengths.iter().zip(&self.places).filter(|(length, _)| {
                let length = **length + round * self.length();
                length > from && length < to
            });
            piece.extend(inner.map(|(_, place)| *place));
        }
        piece.push(self.at(to));
        piece
    }

    /// Points at most `step` px apart along the whole curve, with their lengths from the start.
    pub(super) fn samples(&self, step: f64) -> impl Iterator<Item = (f64, Place)> {
        let total = self.length();
        let count = (total / step).ceil().max(1.0);
        let lengths = std::iter::successors(Some(0.0), |n| Some(n + 1.0)).take_while(move |n| *n <= count);
        lengths.map(move |n| {
            let length = n / count * total;
            (length, self.at(length.min(0.999_999 * total)))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(closed: bool) -> Curve {
        let corners = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)];
        Curve::new(corners.map(|(x, y)| Place { x, y }).to_vec(), closed)
    }

    #[test]
    fn a_closed_curve_is_measured_all_the_way_round() {
        assert_eq!((square(false).length(), square(true).length()), (30.0, 40.0));
        assert_eq!(square(true).at(35.0), Place { x: 0.0, y: 5.0 });
        assert_eq!(square(true).at(-5.0), square(true).at(35.0));
        assert_eq!(square(false).at(35.0), Place { x: 0.0, y: 10.0 });
        assert_eq!((square(true).apart(2.0, 38.0), square(false).apart(2.0, 28.0)), (4.0, 26.0));
    }

    #[test]
    fn a_piece_round_the_start_of_a_closed_curve_keeps_its_corners() {
        let piece = square(true).piece(35.0, 52.0);
        let corners = [(0.0, 5.0), (0.0, 0.0), (0.0, 0.0), (10.0, 0.0), (10.0, 2.0)];
        assert_eq!(piece, corners.map(|(x, y)| Place { x, y }));
    }
}
