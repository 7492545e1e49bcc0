//! Builds the tree from boxes: obvhs builds binary trees over parts of the scene, whose nodes are then merged into wide
//! ones.

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

/// The number of neighbouring primitives that make up a part of the scene with a binary tree of its own: building it then
/// needs little memory beside the result, and parts are built in parallel.
const PART: usize = 1 << 14;

/// The number of pieces of which a part consists in the tree over all parts: as a single box, it would overlap others more
/// than necessary.
const PIECES: usize = 64;

/// The number of parts built before their nodes are added to the tree.
const AT_ONCE: usize = 8;

/// Builds the tree over boxes. The boxes are computed again rather than stored: a million of them take a lot of memory.
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

/// The numbers of all boxes, in Morton order; the high bits of each entry hold the position on the curve.
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

/// A box in the unit frame, in single precision.
#[expect(clippy::cast_possible_truncation, reason = "rounded outwards after that")]
fn single_box(unit: &Unit, bounds: &Bounds) -> Aabb {
    // Two steps, because the position in the unit frame has been rounded too.
    let least = |x: f64| (x as f32).next_down().next_down();
    let greatest = |x: f64| (x as f32).next_up().next_up();
    let place = |corner: Vector| unit.place(corner).to_array();
    Aabb::new(place(bounds.least).map(least).into(), place(bounds.greatest).map(greatest).into())
}

/// A leaf of a binary tree.
fn leaf(bounds: Aabb, child: Child) -> Bvh2Node {
    Bvh2Node::new(bounds, 1, child.to_bits())
}

/// The shortest neighbour search, without optimisation afterwards: the trees of large clouds are usually built for a single
/// image.
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
    /// Leaves for the tree over all parts: boxes of the nodes above, or of primitives.
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

    /// Appends its nodes and its pieces to the others.
    fn append_to(self, nodes: &mut Vec<Node>, pieces: &mut Vec<Bvh2Node>) {
        let by = nodes.len();
        nodes.extend(
            self.nodes.into_iter().map(|node| Node { children: node.children.map(|child| child.moved(by)), ..node }),
        );
        let moved = |piece: Bvh2Node| leaf(*piece.aabb(), Child::from_bits(piece.first_index).moved(by));
        pieces.extend(self.pieces.into_iter().map(moved));
    }
}

/// Converts a whole tree, whose root goes to index 0.
fn widen_all(tree: &Bvh2, nodes: &mut Vec<Node>) {
    widen(tree, &leaf_counts(tree), 0, nodes, 0);
}

/// Merges the nodes of a binary tree below `root` into wide ones, the first of which goes to `place`: each takes the
/// children of its largest boxes as long as there is room. A subtree that fits into one node stays together; otherwise the
/// lowest nodes, which are the most numerous, would be almost empty.
fn widen(tree: &Bvh2, counts: &[u32], root: usize, nodes: &mut Vec<Node>, place: usize) {
    let fits = |node: usize| counts[node] as usize <= WIDTH;
    // Indices in `nodes` that are still to be filled, with the binary node that goes there.
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

/// The number of leaves below each node; nodes come before their children.
fn leaf_counts(tree: &Bvh2) -> Vec<u32> {
    let mut counts = vec![1; tree.nodes.len()];
    for (index, node) in tree.nodes.iter().enumerate().rev().filter(|(_, node)| !node.is_leaf()) {
        let first = node.first_index as usize;
        counts[index] = counts[first] + counts[first + 1];
    }
    counts
}

/// The binary node with the largest box among those that have children and may be opened.
fn largest(tree: &Bvh2, members: &[usize], may_open: impl Fn(usize) -> bool) -> Option<usize> {
    let area = |place: &usize| tree.nodes[members[*place]].aabb().half_area();
    let inner = (0..members.len()).filter(|place| !tree.nodes[members[*place]].is_leaf() && may_open(members[*place]));
    inner.max_by(|first, second| area(first).total_cmp(&area(second)))
}

/// Replaces a node by its children.
fn open(tree: &Bvh2, members: &mut Vec<usize>, place: usize) {
    let first = tree.nodes[members[place]].first_index as usize;
    members[place] = first;
    members.push(first + 1);
}
