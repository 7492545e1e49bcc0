//! Assigns the same index to equal vectors.

use std::hash::{BuildHasher, RandomState};

/// An open-addressing hash table from vectors to their indices, in the order of first use.
#[derive(Debug)]
pub(super) struct Welder {
    /// Differs from run to run, so that nobody can write a file whose vectors all have the same place in the table.
    seed: [u64; 2],
    vectors: Vec<[f64; 3]>,
    /// Indices into `vectors`; the length is a power of two, and at most half of it is used.
    table: Vec<u32>,
}

impl Default for Welder {
    fn default() -> Self {
        let random = RandomState::new();
        // An odd number has a product with every other one.
        Self { seed: [random.hash_one(0), random.hash_one(1) | 1], vectors: Vec::new(), table: Vec::new() }
    }
}

impl Welder {
    /// The index of this vector, a new one on first use; `None` if there are too many to be numbered. Zeros of both signs
    /// are equal.
    pub fn index(&mut self, vector: [f64; 3]) -> Option<u32> {
        let vector = vector.map(|component| component + 0.0);
        if self.table.len() < 2 * (self.vectors.len() + 1) {
            self.grow();
        }
        let slot = self.slot(vector);
        if self.table[slot] == FREE {
            let index = u32::try_from(self.vectors.len()).ok().filter(|index| *index != FREE)?;
            self.table[slot] = index;
            self.vectors.push(vector);
        }
        Some(self.table[slot])
    }

    /// The vector with this index.
    pub fn vector(&self, index: u32) -> [f64; 3] {
        self.vectors[index as usize]
    }

    /// The vectors, no two equal.
    pub fn finish(mut self) -> Vec<[f64; 3]> {
        self.vectors.shrink_to_fit();
        self.vectors
    }

    /// The vector's place in the table, or where it is to be inserted.
    fn slot(&self, vector: [f64; 3]) -> usize {
        let mask = self.table.len() - 1;
        let mut slot = hash(self.seed, vector) & mask;
        while self.table[slot] != FREE && self.vectors[self.table[slot] as usize] != vector {
            slot = (slot + 1) & mask;
        }
        slot
    }

    fn grow(&mut self) {
        self.table = vec![FREE; (4 * self.vectors.len()).next_power_of_two().max(64)];
        for index in 0..self.vectors.len() {
            let slot = self.slot(self.vectors[index]);
            self.table[slot] = u32::try_from(index).expect("it had an index before");
        }
    }
}

const FREE: u32 = u32::MAX;

/// Coordinates of meshes often differ only in their upper bits (short decimals, single precision): multiplication spreads
/// these over all others.
#[expect(clippy::cast_possible_truncation, reason = "any bits of the products will do")]
fn hash([start, factor]: [u64; 2], vector: [f64; 3]) -> usize {
    let fold = |hash: u64, component: f64| {
        let product = u128::from(hash ^ component.to_bits()) * u128::from(factor);
        (product ^ (product >> 64)) as u64
    };
    vector.into_iter().fold(start, fold) as usize
}

#[cfg(test)]
mod tests {
    use super::{Welder, hash};

    /// How far a vector is from its place in the table, summed over all of them.
    fn displacement(welder: &Welder) -> usize {
        let mask = welder.table.len() - 1;
        let away = |vector: &[f64; 3]| welder.slot(*vector).wrapping_sub(hash(welder.seed, *vector)) & mask;
        welder.vectors.iter().map(away).sum()
    }

    /// Vectors that all have one place in a table by one seed are spread by another.
    #[test]
    fn vectors_that_collide_by_one_seed_do_not_by_another() {
        let known = Welder { seed: [0x243f_6a88_85a3_08d3, 0x9e37_79b9_7f4a_7c15], ..Welder::default() };
        let numbers = (0..u32::MAX).map(|number| [1.0, 2.0, f64::from(number) / 7.0]);
        let colliding: Vec<[f64; 3]> =
            numbers.filter(|vector| hash(known.seed, *vector).trailing_zeros() >= 11).take(500).collect();
        let fill = |mut welder: Welder| {
            for vector in &colliding {
                welder.index(*vector);
            }
            displacement(&welder)
        };
        let attacked = fill(known);
        assert!(attacked > 100 * 500, "{attacked}");
        let spread = fill(Welder::default());
        assert!(spread < 10 * 500, "{spread}");
    }

    #[test]
    fn equal_vectors_share_an_index_and_others_do_not() {
        let mut welder = Welder::default();
        let grid = |i: u32| [f64::from(i % 10), f64::from(i / 10 % 10) * 0.1, f64::from(i / 100) - 5.0];
        for _ in 0..2 {
            for i in 0..1000 {
                assert_eq!(welder.index(grid(i)), Some(i));
            }
        }
        assert_eq!(welder.index([0.0, -0.0, -5.0]), Some(0));
        assert_eq!(welder.finish().len(), 1000);
    }
}
