//! From boxes to the tree: obvhs finds a binary tree, whose nodes are then merged to wide ones.

use obvhs::Boundable;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};

use super::node::{Child, Node, WIDTH};
use super::{Accelerator, Unit};
use crate::lanes::Instructions;
use crate::shape::Bounds;
use crate::vector::Vector;

/// The tree over boxes, each of which is asked for twice rather than kept: a million of them are not small.
pub fn build(count: u32, bounds: impl Fn(u32) -> Option<Bounds>) -> Accelerator {
    let bounded = |number: u32| bounds(number).filter(is_bounded);
    let unit = Unit::around((0..count).filter_map(bounded).reduce(Bounds::union).unwrap_or_default());
    let (mut numbers, mut boxes, mut unbounded) = (Vec::new(), Vec::with_capacity(count as usize), Vec::new());
    for number in 0..count {
        match bounded(number) {
            Some(bounds) => {
                numbers.push(number);
                boxes.push(SingleBox::around(&unit, &bounds));
            }
            None => unbounded.push(number),
        }
    }
    let nodes = if boxes.is_empty() { vec![Node::EMPTY] } else { widen(&binary_tree(boxes, numbers)) };
    Accelerator { unit, nodes, unbounded, instructions: Instructions::best() }
}

fn is_bounded(bounds: &Bounds) -> bool {
    bounds.least.to_array().into_iter().chain(bounds.greatest.to_array()).all(f64::is_finite)
}

/// A search for neighbours as short as can be, and no optimisation after it: trees of large clouds are built for a
/// single image more often than not.
fn binary_tree(boxes: Vec<SingleBox>, numbers: Vec<u32>) -> Bvh2 {
    let positions = (0..).take(numbers.len()).collect();
    let mut tree = PlocBuilder::new().build(PlocSearchDistance::VeryLow, &boxes, positions, SortPrecision::U64, 0);
    drop(boxes);
    tree.primitive_indices = numbers;
    tree
}

/// A box in the unit frame, of single precision.
#[derive(Clone, Copy, Debug)]
struct SingleBox {
    least: [f32; 3],
    greatest: [f32; 3],
}

impl SingleBox {
    #[expect(clippy::cast_possible_truncation, reason = "rounded outwards after that")]
    fn around(unit: &Unit, bounds: &Bounds) -> Self {
        // Two steps: the place in the unit frame has been rounded too.
        let least = |x: f64| (x as f32).next_down().next_down();
        let greatest = |x: f64| (x as f32).next_up().next_up();
        let place = |corner: Vector| unit.place(corner).to_array();
        Self { least: place(bounds.least).map(least), greatest: place(bounds.greatest).map(greatest) }
    }
}

impl Boundable for SingleBox {
    fn aabb(&self) -> Aabb {
        Aabb::new(self.least.into(), self.greatest.into())
    }
}

/// Merges the nodes of a binary tree: each wide one takes the children of its largest boxes for as long as there is room.
fn widen(tree: &Bvh2) -> Vec<Node> {
    let mut nodes = Vec::with_capacity(tree.nodes.len() / 8 + 1);
    // (Room for more nodes than there will be: to move them would take the memory twice.)
    nodes.push(Node::EMPTY);
    // Places in `nodes` to be filled, with the binary node that goes there.
    let mut open = vec![(0, tree.nodes[0])];
    while let Some((place, root)) = open.pop() {
        let (members, count) = members(tree, root);
        for member in &members[..count] {
            let child = if member.is_leaf() {
                Child::primitive(tree.primitive_indices[member.first_index as usize])
            } else {
                nodes.push(Node::EMPTY);
                open.push((nodes.len() - 1, *member));
                Child::node(nodes.len() - 1)
            };
            let bounds = member.aabb();
            nodes[place].push(bounds.min.to_array(), bounds.max.to_array(), child);
        }
    }
    nodes.shrink_to_fit();
    nodes
}

/// The binary nodes that make a wide one.
fn members(tree: &Bvh2, root: Bvh2Node) -> ([Bvh2Node; WIDTH], usize) {
    let mut members = [root; WIDTH];
    let mut areas = [f32::NEG_INFINITY; WIDTH];
    let area = |node: &Bvh2Node| if node.is_leaf() { f32::NEG_INFINITY } else { node.aabb().half_area() };
    areas[0] = area(&root);
    let mut count = 1;
    while count < WIDTH {
        let largest = (0..count).max_by(|first, second| areas[*first].total_cmp(&areas[*second])).unwrap_or(0);
        if members[largest].is_leaf() {
            break;
        }
        let first = members[largest].first_index as usize;
        for (place, node) in [(largest, tree.nodes[first]), (count, tree.nodes[first + 1])] {
            members[place] = node;
            areas[place] = area(&node);
        }
        count += 1;
    }
    (members, count)
}
