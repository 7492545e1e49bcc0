//! From boxes to the tree: obvhs finds binary trees over parts of the scene, whose nodes are then merged to wide ones.

use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::ploc::{PlocBuilder, SortPrecision};

use super::node::{Child, Node, WIDTH};
use super::{Accelerator, Unit};
use crate::lanes::Instructions;
use crate::shape::Bounds;
use crate::threads::Threads;
use crate::vector::Vector;

/// So many primitives that are near each other make a part of the scene, with a binary tree of its own: what building it
/// needs beside the result is small then, and parts are built at the same time.
const PART: usize = 1 << 14;

/// A part goes into the tree over all parts as so many pieces: as one, it would overlap others more than it has to.
const PIECES: usize = 64;

/// So many parts are built before their nodes are put to the others.
const AT_ONCE: usize = 8;

/// The tree over boxes, each of which is asked for again rather than kept: a million of them are not small.
pub fn build(threads: &Threads, count: u32, bounds: impl Fn(u32) -> Option<Bounds> + Sync) -> Accelerator {
    let bounded = |number: u32| bounds(number).filter(is_bounded);
    let unit = Unit::around((0..count).filter_map(bounded).reduce(Bounds::union).unwrap_or_default());
    let leaf = |number: u32| bounded(number).map(|bounds| leaf(single_box(&unit, &bounds), Child::primitive(number)));
    let mut nodes = vec![Node::EMPTY];
    let numbers = sorted(threads, count, |number| {
        bounded(number).map(|bounds| unit.place((bounds.least + bounds.greatest) * 0.5))
    });
    let parts: Vec<&[u64]> = numbers.chunks(PART).collect();
    let leaves = |part: &[u64]| part.iter().filter_map(|entry| leaf(number_of(*entry))).collect();
    if let [part] = parts[..] {
        widen_all(&binary_tree(leaves(part)), &mut nodes);
    } else if !parts.is_empty() {
        let mut pieces = Vec::with_capacity(parts.len() * PIECES);
        for parts in parts.chunks(AT_ONCE) {
            let built: Vec<Subtree> = threads.map(parts.to_vec(), |part| Subtree::of(&binary_tree(leaves(part))));
            for part in built {
                part.append_to(&mut nodes, &mut pieces);
            }
        }
        widen_all(&binary_tree(pieces), &mut nodes);
    }
    nodes.shrink_to_fit();
    let unbounded = (0..count).filter(|number| bounded(*number).is_none()).collect();
    Accelerator { unit, nodes, unbounded, instructions: Instructions::best() }
}

fn is_bounded(bounds: &Bounds) -> bool {
    bounds.least.to_array().into_iter().chain(bounds.greatest.to_array()).all(f64::is_finite)
}

/// The numbers of all boxes, in the order of a curve that fills space (Morton's); above each its place on the curve.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "ten bits of places from −1 to 1")]
fn sorted(threads: &Threads, count: u32, middle: impl Fn(u32) -> Option<Vector>) -> Vec<u64> {
    let along_curve = |number: u32| {
        let spread = |coordinate: f64| {
            let bits = ((coordinate + 1.0) * 512.0).clamp(0.0, 1023.0) as u64;
            (0..10).fold(0, |spread, bit| spread | (bits >> bit & 1) << (3 * bit))
        };
        let [x, y, z] = middle(number)?.to_array().map(spread);
        Some((x | y << 1 | z << 2) << 32 | u64::from(number))
    };
    let mut entries: Vec<u64> = (0..count).filter_map(along_curve).collect();
    if entries.len() > PART {
        threads.sort(&mut entries);
    }
    entries
}

#[expect(clippy::cast_possible_truncation, reason = "the lower half")]
fn number_of(entry: u64) -> u32 {
    entry as u32
}

/// A box in the unit frame, of single precision.
#[expect(clippy::cast_possible_truncation, reason = "rounded outwards after that")]
fn single_box(unit: &Unit, bounds: &Bounds) -> Aabb {
    // Two steps: the place in the unit frame has been rounded too.
    let least = |x: f64| (x as f32).next_down().next_down();
    let greatest = |x: f64| (x as f32).next_up().next_up();
    let place = |corner: Vector| unit.place(corner).to_array();
    Aabb::new(place(bounds.least).map(least).into(), place(bounds.greatest).map(greatest).into())
}

/// A leaf of a binary tree.
fn leaf(bounds: Aabb, child: Child) -> Bvh2Node {
    Bvh2Node::new(bounds, 1, child.to_bits())
}

/// A search for neighbours as short as can be, and no optimisation after it: trees of large clouds are built for a
/// single image more often than not.
fn binary_tree(leaves: Vec<Bvh2Node>) -> Bvh2 {
    const SEARCH_DISTANCE: usize = 2;
    let whole = leaves.iter().fold(Aabb::empty(), |whole, leaf| whole.union(leaf.aabb()));
    let mut builder = PlocBuilder { current_nodes: leaves, ..PlocBuilder::new() };
    let mut tree = Bvh2::default();
    builder.build_ploc_from_leaves::<SEARCH_DISTANCE, false>(&mut tree, whole, SortPrecision::U64, 0);
    tree
}

/// Wide nodes over a part of the scene.
struct Subtree {
    nodes: Vec<Node>,
    /// Leaves for the tree over all parts: boxes of nodes above, or of primitives.
    pieces: Vec<Bvh2Node>,
}

impl Subtree {
    fn of(tree: &Bvh2) -> Self {
        let counts = leaf_counts(tree);
        let mut part = Self { nodes: Vec::new(), pieces: Vec::with_capacity(PIECES) };
        let mut pieces = vec![0];
        while pieces.len() < PIECES
            && let Some(largest) = largest(tree, &pieces, |_| true)
        {
            open(tree, &mut pieces, largest);
        }
        for piece in pieces {
            let node = tree.nodes[piece];
            part.pieces.push(if node.is_leaf() {
                node
            } else {
                part.nodes.push(Node::EMPTY);
                let place = part.nodes.len() - 1;
                widen(tree, &counts, piece, &mut part.nodes, place);
                leaf(*node.aabb(), Child::node(place))
            });
        }
        part
    }

    /// Puts its nodes after others, and its pieces.
    fn append_to(self, nodes: &mut Vec<Node>, pieces: &mut Vec<Bvh2Node>) {
        let by = nodes.len();
        nodes.extend(
            self.nodes.into_iter().map(|node| Node { children: node.children.map(|child| child.moved(by)), ..node }),
        );
        let moved = |piece: Bvh2Node| leaf(*piece.aabb(), Child::from_bits(piece.first_index).moved(by));
        pieces.extend(self.pieces.into_iter().map(moved));
    }
}

/// A whole tree, whose root goes to the first place.
fn widen_all(tree: &Bvh2, nodes: &mut Vec<Node>) {
    widen(tree, &leaf_counts(tree), 0, nodes, 0);
}

/// Merges the nodes of a binary tree from `root` on into wide ones, the first of which goes to `place`: each takes the
/// children of its largest boxes for as long as there is room. But what fits into one node stays together, else the lowest
/// ones, which are most of all, would be almost empty.
fn widen(tree: &Bvh2, counts: &[u32], root: usize, nodes: &mut Vec<Node>, place: usize) {
    let fits = |node: usize| counts[node] as usize <= WIDTH;
    // Places in `nodes` to be filled, with the binary node that goes there.
    let mut to_fill = vec![(place, root)];
    let mut members = Vec::with_capacity(WIDTH);
    while let Some((place, root)) = to_fill.pop() {
        members.clear();
        members.push(root);
        while members.len() < WIDTH
            && let Some(largest) = largest(tree, &members, |node| fits(root) || !fits(node))
        {
            open(tree, &mut members, largest);
        }
        for member in &members {
            let node = &tree.nodes[*member];
            let child = if node.is_leaf() {
                Child::from_bits(node.first_index)
            } else {
                nodes.push(Node::EMPTY);
                to_fill.push((nodes.len() - 1, *member));
                Child::node(nodes.len() - 1)
            };
            nodes[place].push(node.min.to_array(), node.max.to_array(), child);
        }
    }
}

/// How many leaves are below each node, which comes before its children.
fn leaf_counts(tree: &Bvh2) -> Vec<u32> {
    let mut counts = vec![1; tree.nodes.len()];
    for (index, node) in tree.nodes.iter().enumerate().rev().filter(|(_, node)| !node.is_leaf()) {
        let first = node.first_index as usize;
        counts[index] = counts[first] + counts[first + 1];
    }
    counts
}

/// Which of some binary nodes has the largest box, of those that have children and may be opened.
fn largest(tree: &Bvh2, members: &[usize], may_open: impl Fn(usize) -> bool) -> Option<usize> {
    let area = |place: &usize| tree.nodes[members[*place]].aabb().half_area();
    let inner = (0..members.len()).filter(|place| !tree.nodes[members[*place]].is_leaf() && may_open(members[*place]));
    inner.max_by(|first, second| area(first).total_cmp(&area(second)))
}

/// Puts a node's children into its place.
fn open(tree: &Bvh2, members: &mut Vec<usize>, place: usize) {
    let first = tree.nodes[members[place]].first_index as usize;
    members[place] = first;
    members.push(first + 1);
}
