//! Which of many boxes contain a point.

use super::Bounds;
use crate::vector::Vector;

/// A tree of boxes: it finds those that contain a point in a time that grows with the logarithm of their number.
pub struct BoxTree {
    /// The tree below [`BoxTree::root`], each node after its parent.
    nodes: Vec<Node>,
    /// Items without bounds, which contain every point.
    unbounded: Vec<usize>,
}

struct Node {
    bounds: Bounds,
    content: Content,
}

enum Content {
    Items(Vec<(usize, Bounds)>),
    /// The second child; the first one is the next node.
    Children(usize),
}

/// Items in a leaf.
const LEAF: usize = 4;

impl BoxTree {
    /// The tree of items that are numbered in the order of their boxes; `None` is unbounded. A point also counts as inside
    /// within a hundred-millionth of the box's longest side, so that what is on a surface is found.
    #[must_use]
    pub fn new(boxes: impl Iterator<Item = Option<Bounds>>) -> Self {
        let mut unbounded = Vec::new();
        let mut items = Vec::new();
        for (item, bounds) in boxes.enumerate() {
            match bounds {
                Some(bounds) => items.push((item, widened(bounds))),
                None => unbounded.push(item),
            }
        }
        let mut tree = Self { nodes: Vec::new(), unbounded };
        if !items.is_empty() {
            tree.add(&mut items);
        }
        tree
    }

    fn add(&mut self, items: &mut [(usize, Bounds)]) {
        let bounds = items.iter().map(|(_, bounds)| *bounds).reduce(Bounds::union).unwrap_or_default();
        let at = self.nodes.len();
        if items.len() <= LEAF {
            let content = Content::Items(items.to_vec());
            self.nodes.push(Node { bounds, content });
            return;
        }
        let sides = (bounds.greatest - bounds.least).to_array();
        let axis = (0..3).max_by(|first, second| sides[*first].total_cmp(&sides[*second])).unwrap_or(0);
        let middle = |bounds: &Bounds| bounds.least.to_array()[axis] + bounds.greatest.to_array()[axis];
        let half = items.len() / 2;
        items.select_nth_unstable_by(half, |(_, first), (_, second)| middle(first).total_cmp(&middle(second)));
        self.nodes.push(Node { bounds, content: Content::Children(0) });
        let (first, second) = items.split_at_mut(half);
        self.add(first);
        self.nodes[at].content = Content::Children(self.nodes.len());
        self.add(second);
    }

    /// The items whose boxes contain a point, in the order of their numbers.
    #[must_use]
    pub fn around(&self, point: Vector) -> Vec<usize> {
        let mut found = self.unbounded.clone();
        let mut waiting = Vec::from_iter((!self.nodes.is_empty()).then_some(0));
        while let Some(at) = waiting.pop() {
            let Node { bounds, content } = &self.nodes[at];
            if contains(bounds, point) {
                match content {
                    Content::Items(items) => {
                        let inside = items.iter().filter(|(_, bounds)| contains(bounds, point));
                        found.extend(inside.map(|(item, _)| *item));
                    }
                    Content::Children(second) => waiting.extend([at + 1, *second]),
                }
            }
        }
        found.sort_unstable();
        found
    }
}

fn widened(bounds: Bounds) -> Bounds {
    let sides = (bounds.greatest - bounds.least).to_array();
    let far = bounds
        .least
        .to_array()
        .into_iter()
        .chain(bounds.greatest.to_array())
        .fold(0.0, |far, c| f64::max(far, c.abs()));
    // The second term is rounding in a box far away.
    let margin = 1e-8 * sides.into_iter().fold(0.0, f64::max) + 8.0 * f64::EPSILON * far;
    let margin = Vector::new(margin, margin, margin);
    Bounds { least: bounds.least - margin, greatest: bounds.greatest + margin }
}

fn contains(bounds: &Bounds, point: Vector) -> bool {
    let [least, greatest, point] = [bounds.least, bounds.greatest, point].map(Vector::to_array);
    (0..3).all(|axis| (least[axis]..=greatest[axis]).contains(&point[axis]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers from 0 to 1 that are the same on every run.
    fn numbers() -> impl FnMut() -> f64 {
        let mut state = 0x9E37_79B9_7F4A_7C15_u64;
        move || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            f64::from(u32::try_from(state >> 32).unwrap()) / f64::from(u32::MAX)
        }
    }

    #[test]
    fn it_finds_the_boxes_that_contain_a_point_and_only_those() {
        let mut number = numbers();
        let boxes: Vec<Option<Bounds>> = (0..500)
            .map(|item| {
                let middle = Vector::new(number(), number(), number());
                let half = Vector::new(number(), number(), 0.0) * 0.1;
                (item % 50 != 7).then(|| Bounds::around(middle, half + Vector::new(0.0, 0.0, 0.2 * number())))
            })
            .collect();
        let tree = BoxTree::new(boxes.iter().copied());
        for _ in 0..500 {
            let point = Vector::new(number(), number(), number());
            let is_in = |bounds: &Option<Bounds>| bounds.is_none_or(|bounds| contains(&widened(bounds), point));
            let expected: Vec<usize> = (0..500).filter(|item| is_in(&boxes[*item])).collect();
            assert_eq!(tree.around(point), expected);
        }
        assert!(BoxTree::new(std::iter::empty()).around(Vector::default()).is_empty());
    }

    /// Equal boxes cannot be told apart by their middles.
    #[test]
    fn equal_boxes_are_all_found() {
        let bounds = Bounds::around(Vector::default(), Vector::new(1.0, 1.0, 1.0));
        let tree = BoxTree::new(std::iter::repeat_n(Some(bounds), 1000));
        assert_eq!(tree.around(Vector::new(1.0, -1.0, 0.5)).len(), 1000);
        assert!(tree.around(Vector::new(1.1, 0.0, 0.0)).is_empty());
    }
}
