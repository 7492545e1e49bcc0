//! The values of channels.

/// The values of a channel, row by row from the top, each row from the left. Zero (−1 for indices) where no
/// surface is seen, never NaN: the map's [mask](super::Map::mask) tells the two kinds of zero apart.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// One number per pixel.
    Scalar(Vec<f64>),
    /// One number per pixel, computed in single precision.
    Single(Vec<f32>),
    /// Three numbers per pixel: x, y, z, or red, green, blue.
    Vector(Vec<[f64; 3]>),
    /// One index per pixel.
    Index(Vec<i32>),
}

impl Values {
    /// The number of pixels.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Scalar(values) => values.len(),
            Self::Single(values) => values.len(),
            Self::Vector(values) => values.len(),
            Self::Index(values) => values.len(),
        }
    }

    /// Whether there are no pixels.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// The numbers of a scalar channel, of either precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scalars<'m> {
    /// In double precision.
    Double(&'m [f64]),
    /// In single precision.
    Single(&'m [f32]),
}

impl<'m> Scalars<'m> {
    /// The numbers of a channel with one number per pixel.
    #[must_use]
    pub fn of(values: &'m Values) -> Option<Self> {
        match values {
            Values::Scalar(values) => Some(Self::Double(values)),
            Values::Single(values) => Some(Self::Single(values)),
            Values::Vector(_) | Values::Index(_) => None,
        }
    }

    /// The value of the pixel with this index (row × width + column).
    #[must_use]
    #[inline]
    pub fn at(self, index: usize) -> f64 {
        match self {
            Self::Double(values) => values[index],
            Self::Single(values) => f64::from(values[index]),
        }
    }

    /// The number of pixels.
    #[must_use]
    pub fn len(self) -> usize {
        match self {
            Self::Double(values) => values.len(),
            Self::Single(values) => values.len(),
        }
    }

    /// Whether there are no pixels.
    #[must_use]
    pub fn is_empty(self) -> bool {
        self.len() == 0
    }

    /// All values, in reading order.
    pub fn iter(self) -> impl Iterator<Item = f64> {
        (0..self.len()).map(move |index| self.at(index))
    }
}
