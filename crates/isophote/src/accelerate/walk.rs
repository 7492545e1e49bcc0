//! The traversal of the tree, from near to far.

use super::node::{Child, Node};
use super::{Accelerator, Query};
use crate::lanes::{Instructions, Lane};

/// The state of a query; its memory is reused for the next one.
#[derive(Clone, Debug, Default)]
pub struct Walk {
    /// The boxes still to be visited, the nearest last.
    open: Vec<(f32, Child)>,
}

impl Walk {
    /// Starts at the root.
    pub fn start(&mut self, tree: &Accelerator) {
        self.open.clear();
        if tree.nodes[0].used != 0 {
            self.open.push((0.0, Child::node(0)));
        }
    }

    /// The next primitive that may be hit, up to a depth. (Its box may be closer than an earlier one.)
    #[inline(always)]
    pub fn next<V: Lane<Element = f32>>(
        &mut self,
        token: V::Token,
        tree: &Accelerator,
        query: &impl Query,
        limit: f32,
    ) -> Option<u32> {
        self.next_by(
            tree,
            limit,
            #[inline(always)]
            |node| query.intersect::<V>(token, node),
        )
    }

    /// The next primitive, with this instruction set.
    pub fn next_with(
        &mut self,
        instructions: Instructions,
        tree: &Accelerator,
        query: &impl Query,
        limit: f32,
    ) -> Option<u32> {
        self.next_by(tree, limit, |node| query.intersect_with(instructions, node))
    }

    #[inline(always)]
    fn next_by(&mut self, tree: &Accelerator, limit: f32, meet: impl Fn(&Node) -> ([f32; 16], u32)) -> Option<u32> {
        while let Some((near, child)) = self.open.pop() {
            // Written so that a NaN limit ends nothing.
            if near > limit {
                continue;
            }
            match child.get() {
                Ok(primitive) => return Some(primitive),
                Err(index) => {
                    let node = &tree.nodes[index];
                    let (depths, met) = meet(node);
                    self.insert(node, &depths, met, limit);
                }
            }
        }
        None
    }

    /// Inserts the boxes that were hit in order, the nearest last.
    #[inline(always)]
    fn insert(&mut self, node: &Node, depths: &[f32; 16], mut met: u32, limit: f32) {
        let base = self.open.len();
        while met != 0 {
            let index = met.trailing_zeros() as usize;
            met &= met - 1;
            let depth = depths[index];
            if depth > limit {
                continue;
            }
            let entry = (depth, node.children[index]);
            self.open.push(entry);
            let mut place = self.open.len() - 1;
            while place > base && self.open[place - 1].0 < depth {
                self.open[place] = self.open[place - 1];
                place -= 1;
            }
            self.open[place] = entry;
        }
    }
}
