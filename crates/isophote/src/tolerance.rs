//! The single table of tolerances: what is promised, and what the tests check.

/// How far a value may deviate from exact arithmetic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// At every visible pixel, limb included, as a fraction of the map's peak.
    pub of_peak: f64,
    /// If even at a light's brightest pixel cosθ_o cosθ_i is below this, the picture shows only the neighbourhood of that
    /// light's terminator or of the limb: all that comes from the light is then as uncertain as these cosines, and `of_peak` of
    /// the light's own peak grows as 1/(cosθ_o cosθ_i).
    pub peak_cosine: f64,
    /// Relative, wherever cosθ_o, cosθ_i of every lit light and cosγ of every Lambertian one exceed
    /// [`above_cosine`](Self::above_cosine), for values above [`above_value`](Self::above_value).
    pub relative: f64,
    /// As a fraction of the peak. (A highlight never stops falling off, and its relative error grows as it falls, but by
    /// then it is invisible.)
    pub above_value: f64,
    /// Towards the limb and the terminator, the problem itself loses digits, as 1/cosine.
    pub above_cosine: f64,
    /// On the flank of a highlight, the problem itself loses digits too, as n tanθ_h (weighted by the share of each
    /// highlight in the value): `relative` increases by its own amount for every such flank, and so does `of_peak` if even a
    /// light's brightest pixel is on one.
    pub flank: f64,
    /// If a channel's peak is smaller than this, its numbers have already lost digits through being so small.
    pub least_peak: f64,
    /// Relative, for values above a thousandth of the peak; it grows like `of_peak`, and as 1/cosine below
    /// [`edge_cosine`](Self::edge_cosine).
    pub at_edges: f64,
    /// For a smaller cosine, the rounding of the directions leaves no more digits: next to a light that is brighter than
    /// anything else would be, even such a cosine gives a value above a thousandth of the peak.
    pub edge_cosine: f64,
}

/// Maps in double precision, compared with exact arithmetic on the scene as stored, in metres.
///
/// It holds if every light is at least a thousandth of a shape's size away from its surface (next to a light, E ∝ 1/r² loses
/// the digits that r has lost, whatever the arithmetic), and the eye is within 1e9 sizes of every shape.
pub const DOUBLE: Tolerance = Tolerance {
    of_peak: 1e-12,
    peak_cosine: 1e-2,
    relative: 1e-12,
    above_value: 1e-6,
    above_cosine: 0.1,
    flank: f64::INFINITY,
    least_peak: 1e-290,
    at_edges: 1e-9,
    // Near an edge, everything is computed with 32 digits.
    edge_cosine: 0.0,
};

/// Brightness and its parts in single precision; geometry is still in double precision. The conditions are those of
/// [`DOUBLE`].
///
/// A number of 32 bits has a relative error of 6e-8. Some ten roundings go into the directions N, L and V; even if those
/// were rounded only once from exact ones, the lobe would amplify that by n tanθ_h. Highlights with n above 24, or below
/// 1, are computed in double precision.
pub const SINGLE: Tolerance = Tolerance {
    of_peak: 3e-6,
    peak_cosine: 1e-2,
    relative: 3e-6,
    above_value: 1e-3,
    above_cosine: 0.1,
    flank: 20.0,
    least_peak: 1e-30,
    at_edges: 1e-4,
    // Five roundings of 6e-8 give 3e-7 of a cosine, which is 1e-4 of this one.
    edge_cosine: 3e-3,
};

/// Values at a given point: no accuracy is lost in finding the point, so the cosines may be smaller.
pub const PROBE: Tolerance = Tolerance { above_cosine: 1e-3, ..DOUBLE };

/// A highlight without cosθ_i, (3.11) and (3.12), jumps where cosθ_i = 0. Where |N·L| is smaller than this, the rounding of
/// a double (a few 1e-16 for N and L, a few times that for a grid of pixels far from the origin) may put a point on
/// the other side of the jump. In a picture a pixel is there about once in 1e12.
pub const AT_JUMP: f64 = 1e-14;

impl Tolerance {
    /// How much larger the tolerance is for a light whose brightest pixel has this cosθ_o cosθ_i.
    #[must_use]
    pub fn growth(&self, cosines: f64) -> f64 {
        (self.peak_cosine / cosines).max(1.0)
    }

    /// [`at_edges`](Self::at_edges) for a value with this cosine, in a picture whose tolerance has this
    /// [growth](Self::growth).
    #[must_use]
    pub fn at_edge(&self, cosine: f64, growth: f64) -> f64 {
        self.at_edges * growth * (self.edge_cosine / cosine).max(1.0)
    }
}
