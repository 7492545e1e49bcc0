//! The nodes of the tree, each with sixteen boxes that are tested at once.

/// The number of boxes in a node.
pub const WIDTH: usize = 16;

/// Sixteen boxes, by axis.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub struct Node {
    /// The smallest and the largest coordinates.
    pub sides: [[[f32; WIDTH]; 3]; 2],
    /// What is in the boxes.
    pub children: [Child; WIDTH],
    /// Bit i tells whether box i is in use.
    pub used: u32,
}

/// What is in a box: another node, or a primitive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Child(u32);

const PRIMITIVE: u32 = 1 << 31;

impl Node {
    /// A node without boxes.
    pub const EMPTY: Self = Self { sides: [[[0.0; WIDTH]; 3]; 2], children: [Child(0); WIDTH], used: 0 };

    /// Adds a box.
    pub fn push(&mut self, least: [f32; 3], greatest: [f32; 3], child: Child) {
        let place = self.used.count_ones() as usize;
        for axis in 0..3 {
            self.sides[0][axis][place] = least[axis];
            self.sides[1][axis][place] = greatest[axis];
        }
        self.children[place] = child;
        self.used |= 1 << place;
    }
}

impl Child {
    /// A node.
    #[expect(clippy::cast_possible_truncation, reason = "there are fewer nodes than primitives")]
    pub fn node(index: usize) -> Self {
        Self(index as u32)
    }

    /// A primitive.
    pub fn primitive(index: u32) -> Self {
        Self(index | PRIMITIVE)
    }

    /// Its stored form.
    pub fn to_bits(self) -> u32 {
        self.0
    }

    /// The reverse of [`to_bits`](Self::to_bits).
    pub fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The same child after `by` nodes were inserted in front of those that it counts.
    pub fn moved(self, by: usize) -> Self {
        self.get().map_or_else(|index| Self::node(index + by), Self::primitive)
    }

    /// The primitive's number, or the node's index as the error.
    #[inline(always)]
    pub fn get(self) -> Result<u32, usize> {
        if self.0 & PRIMITIVE == 0 { Err(self.0 as usize) } else { Ok(self.0 & !PRIMITIVE) }
    }
}
