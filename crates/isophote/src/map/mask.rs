//! Which pixels see a surface, and which surface.

use super::Resolution;

/// Consecutive pixels of a row that see the same shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Run {
    /// Index in the map (row × width + column) of the first pixel.
    pub start: usize,
    /// Index after the last pixel, which is in the same row as the first.
    pub end: usize,
    /// Index of the shape.
    pub shape: u32,
}

/// The mask of a map: runs of pixels, in reading order. Pixels in no run see no surface.
///
/// An image is mostly background and large surfaces: a run replaces thousands of indices, and readers of the map skip the
/// background without looking at it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mask {
    size: Resolution,
    runs: Vec<Run>,
}

impl Mask {
    /// A mask of runs, which must be in reading order and must not overlap.
    pub(crate) fn new(size: Resolution, runs: Vec<Run>) -> Self {
        debug_assert!(runs.iter().all(|run| run.start < run.end));
        debug_assert!(runs.windows(2).all(|pair| pair[0].end <= pair[1].start));
        debug_assert!(runs.iter().all(|run| run.start / size.width as usize == (run.end - 1) / size.width as usize));
        Self { size, runs }
    }

    /// The mask of these shapes, one index per pixel, negative where there is none.
    pub(crate) fn of_shapes(size: Resolution, shapes: &[i32]) -> Self {
        let width = size.width as usize;
        let mut runs: Vec<Run> = Vec::new();
        for (index, shape) in shapes.iter().enumerate() {
            let Ok(shape) = u32::try_from(*shape) else { continue };
            match runs.last_mut() {
                Some(run) if run.end == index && run.shape == shape && index % width != 0 => run.end += 1,
                _ => runs.push(Run { start: index, end: index + 1, shape }),
            }
        }
        Self::new(size, runs)
    }

    /// The mask with more runs, also in reading order, where nothing was seen so far.
    pub(crate) fn with(&self, more: &[Run]) -> Self {
        let width = self.size.width as usize;
        let mut runs: Vec<Run> = Vec::with_capacity(self.runs.len() + more.len());
        let mut more = more.iter().copied().peekable();
        let mut push = |run: Run| match runs.last_mut() {
            Some(last) if last.end == run.start && last.shape == run.shape && !run.start.is_multiple_of(width) => {
                last.end = run.end;
            }
            _ => runs.push(run),
        };
        for run in &self.runs {
            while let Some(other) = more.next_if(|other| other.start < run.start) {
                push(other);
            }
            push(*run);
        }
        more.for_each(push);
        Self::new(self.size, runs)
    }

    /// The runs, in reading order.
    #[must_use]
    pub fn runs(&self) -> &[Run] {
        &self.runs
    }

    /// The number of pixels that see a surface.
    #[must_use]
    pub fn visible(&self) -> usize {
        self.runs.iter().map(|run| run.end - run.start).sum()
    }

    /// The indices of the pixels that see a surface, in reading order.
    pub fn indices(&self) -> impl Iterator<Item = usize> {
        self.runs.iter().flat_map(|run| run.start..run.end)
    }

    /// The shape seen at the pixel with this index.
    #[must_use]
    pub fn shape_at(&self, index: usize) -> Option<u32> {
        let before = self.runs.partition_point(|run| run.end <= index);
        self.runs.get(before).filter(|run| run.start <= index).map(|run| run.shape)
    }

    /// One index per pixel, −1 where no surface is seen.
    #[must_use]
    pub fn shapes(&self) -> Vec<i32> {
        let mut shapes = vec![-1; self.size.pixels()];
        for run in &self.runs {
            shapes[run.start..run.end].fill(i32::try_from(run.shape).unwrap_or(i32::MAX));
        }
        shapes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_that_are_added_join_those_beside_them() {
        let size = Resolution { width: 4, height: 3 };
        let shapes = [-1, 0, -1, 1, -1, -1, 2, -1, -1, -1, -1, -1];
        let more = [(0, 0), (2, 1), (4, 1), (7, 3), (11, 2)];
        let all = [0, 0, 1, 1, 1, -1, 2, 3, -1, -1, -1, 2];
        let runs = more.map(|(start, shape)| Run { start, end: start + 1, shape });
        assert_eq!(Mask::of_shapes(size, &shapes).with(&runs), Mask::of_shapes(size, &all));
    }

    #[test]
    fn a_mask_tells_every_pixel_and_keeps_rows_apart() {
        let size = Resolution { width: 4, height: 3 };
        let shapes = [-1, 0, 0, 1, 1, -1, -1, 2, 2, 2, -1, -1];
        let mask = Mask::of_shapes(size, &shapes);
        assert_eq!(mask.shapes(), shapes);
        assert_eq!(mask.visible(), 7);
        assert_eq!(mask.indices().collect::<Vec<_>>(), [1, 2, 3, 4, 7, 8, 9]);
        for (index, shape) in shapes.into_iter().enumerate() {
            assert_eq!(mask.shape_at(index).map_or(-1, u32::cast_signed), shape, "{index}");
        }
        let starts: Vec<_> = mask.runs().iter().map(|run| run.start).collect();
        assert_eq!(starts, [1, 3, 4, 7, 8], "a run ends with its row");
    }
}
