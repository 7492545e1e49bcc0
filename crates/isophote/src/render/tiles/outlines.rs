//! The outlines of the spheres in a beam, eight at a time in pairs of doubles.

use crate::accelerate::{Accelerator, Beam, Walk};
use crate::camera::Screen;
use crate::double_double::DoubleDouble;
use crate::lanes::{Lane, LaneJob, SimdToken};
use crate::map::Resolution;
use crate::outline::{BEFORE_THE_EYE, Ellipse, PixelGrid};
use crate::prepare::PreparedScene;
use crate::render::band::Tile;
use crate::shape::Sphere;
use crate::vector::Vector;

/// The camera in the form that tiles use.
pub struct View {
    grid: PixelGrid,
    eye: Vector,
    forward: Vector,
    right: Vector,
    up: Vector,
    /// x of the middle of column 0 and y of the middle of row 0, on a screen at distance 1, and their steps.
    first: [f64; 2],
    step: [f64; 2],
    /// The greatest length of d in the image.
    pub greatest_length: f64,
}

impl View {
    /// The view of a scene's camera through its window.
    pub fn new(scene: &PreparedScene, window: &Screen) -> Self {
        let (frame, grid) = (scene.frame(), PixelGrid::new(scene.precise_frame(), window));
        let (first, step) = grid.rounded();
        let mut view = Self {
            grid,
            eye: frame.eye,
            forward: frame.forward,
            right: frame.right,
            up: frame.up,
            first,
            step,
            greatest_length: 1.0,
        };
        let Resolution { width, height } = frame.resolution;
        let corners = [[0.0, 0.0], [width.into(), 0.0], [0.0, height.into()], [width.into(), height.into()]];
        view.greatest_length = corners.into_iter().map(|at| view.direction(at).length()).fold(1.0, f64::max);
        view
    }

    /// d at the upper left corner of pixel (column, row).
    fn direction(&self, [column, row]: [f64; 2]) -> Vector {
        let x = self.first[0] + self.step[0] * (column - 0.5);
        let y = self.first[1] + self.step[1] * (row - 0.5);
        self.forward + self.right * x + self.up * y
    }

    /// The beam of a tile, with a margin of one pixel for pixels in doubt.
    pub fn beam(&self, tree: &Accelerator, tile: Tile) -> Beam {
        let Tile { first, width, height } = tile;
        let [left, top] = [f64::from(first.column) - 1.0, f64::from(first.row) - 1.0];
        let [right, bottom] = [left + f64::from(width) + 2.0, top + f64::from(height) + 2.0];
        let corners = [[left, top], [right, top], [right, bottom], [left, bottom]];
        tree.beam(self.eye, corners.map(|corner| self.direction(corner)), self.forward)
    }

    /// The smallest length of d in a tile.
    pub fn least_length(&self, tile: Tile) -> f64 {
        let nearest = |first: f64, step: f64, start: u32, count: u32| {
            let [a, b] = [f64::from(start) - 1.0, f64::from(start + count)].map(|index| first + step * index);
            if a.signum() == b.signum() { a.abs().min(b.abs()) } else { 0.0 }
        };
        let x = nearest(self.first[0], self.step[0], tile.first.column, tile.width);
        let y = nearest(self.first[1], self.step[1], tile.first.row, tile.height);
        (1.0 + x * x + y * y).sqrt()
    }
}

/// The number of outlines computed at once.
pub const BLOCK: usize = 8;

/// The number of spheres that are taken from the beam at a time, and then drawn in order of distance.
const BATCH: usize = 64;

/// The spheres in a beam, in the order in which they were found.
#[derive(Default)]
pub struct Outlines {
    blocks: Vec<Block>,
    taken: Vec<u32>,
    order: Vec<u32>,
}

/// Eight outlines.
pub struct Block {
    pub ellipse: Ellipse<[f64; BLOCK]>,
    /// d·c, in metres, at the outline's reference pixel, and its change per column and per row.
    pub depth: [[f64; BLOCK]; 3],
    /// From the eye to the centre, in metres.
    pub distance: [f64; BLOCK],
    pub radius: [f64; BLOCK],
    /// The largest clearance at which a pixel is in doubt.
    pub doubtful: [f64; BLOCK],
    number: [u32; BLOCK],
}

/// A sphere with its outline.
pub struct Seen {
    /// Its outline.
    pub ellipse: Ellipse,
    /// The number of its primitive.
    pub primitive: u32,
}

/// Takes the next few spheres from a beam.
pub struct Take<'t> {
    /// Where to put them.
    pub outlines: &'t mut Outlines,
    /// The tree to search.
    pub tree: &'t Accelerator,
    /// The beam to search.
    pub beam: &'t Beam,
    /// The depth beyond which nothing is visible.
    pub limit: f32,
    /// The state of the search.
    pub walk: &'t mut Walk,
}

impl LaneJob for Take<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S, D>(self, token: S::Token)
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>,
    {
        let Self { outlines, tree, beam, limit, walk } = self;
        outlines.taken.clear();
        while outlines.taken.len() < BATCH
            && let Some(number) = walk.next::<S::Narrow>(token, tree, beam, limit)
        {
            outlines.taken.push(number);
        }
    }
}

/// Computes the outlines of the last batch; false if one of them is not an ellipse.
pub struct Prepare<'t> {
    /// The spheres that were taken, and where their outlines go.
    pub outlines: &'t mut Outlines,
    /// The scene.
    pub scene: &'t PreparedScene,
    /// Its camera.
    pub view: &'t View,
}

impl LaneJob for Prepare<'_> {
    type Output = bool;

    #[inline(always)]
    fn run<S, D>(self, token: S::Token) -> bool
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>,
    {
        self.outlines.prepare::<D::Narrow>(token, self.scene, self.view)
    }
}

impl Outlines {
    /// Removes all outlines.
    pub fn clear(&mut self) {
        self.blocks.clear();
    }

    /// Whether the last batch was empty.
    pub fn is_exhausted(&self) -> bool {
        self.taken.is_empty()
    }

    /// The number of slots for outlines.
    pub fn count(&self) -> usize {
        self.blocks.len() * BLOCK
    }

    /// The block and the lane of an outline.
    #[inline(always)]
    pub fn place(&self, index: u32) -> (&Block, usize) {
        (&self.blocks[index as usize / BLOCK], index as usize % BLOCK)
    }

    /// An outline with its sphere.
    pub fn get(&self, index: u32) -> Seen {
        let (block, lane) = self.place(index);
        Seen { ellipse: block.ellipse.map(|numbers| numbers[lane]), primitive: block.number[lane] }
    }

    /// The last batch, from near to far.
    pub fn by_distance(&self) -> &[u32] {
        &self.order
    }

    #[inline(always)]
    fn prepare<D: Lane<Element = f64>>(&mut self, token: D::Token, scene: &PreparedScene, view: &View) -> bool {
        self.order.clear();
        let grid = view.grid.map(
            #[inline(always)]
            |number| D::splat(token, number),
        );
        for numbers in self.taken.chunks(BLOCK) {
            let mut spheres = [(Vector::default(), 1.0); BLOCK];
            let mut doubtful = [0.0; BLOCK];
            let mut number = [numbers[0]; BLOCK];
            number[..numbers.len()].copy_from_slice(numbers);
            for (lane, number) in number.iter().enumerate() {
                let primitive = scene.primitive(*number);
                let Some(Sphere { center, radius }) = scene.sphere(primitive) else { return false };
                spheres[lane] = (*center, *radius);
                doubtful[lane] = scene.doubtful_in_outline(primitive).end;
            }
            let block = token.in_own_function(
                #[inline(always)]
                || Block::new::<D>(token, &grid, &spheres, doubtful, number),
            );
            let first = u32::try_from(self.count()).unwrap_or(u32::MAX);
            for lane in 0..numbers.len() {
                let z = block.depth_in_radii(lane, view);
                if z <= -1.0 {
                    continue;
                }
                // Written so that NaN counts as no ellipse.
                if !(z >= 1.0 + BEFORE_THE_EYE) {
                    return false;
                }
                self.order.push(first + u32::try_from(lane).unwrap_or(0));
            }
            self.blocks.push(block);
        }
        let Self { blocks, order, .. } = self;
        let near = |index: &u32| {
            let (block, lane) = (&blocks[*index as usize / BLOCK], *index as usize % BLOCK);
            block.distance[lane] - block.radius[lane]
        };
        order.sort_unstable_by(|first, second| near(first).total_cmp(&near(second)));
        true
    }
}

#[inline(always)]
fn exactly<D: Lane<Element = f64>>(token: D::Token, numbers: &[f64]) -> DoubleDouble<D> {
    DoubleDouble::exactly(D::load(token, numbers))
}

impl Block {
    #[inline(always)]
    fn new<D: Lane<Element = f64>>(
        token: D::Token,
        grid: &PixelGrid<D>,
        spheres: &[(Vector, f64); BLOCK],
        doubtful: [f64; BLOCK],
        number: [u32; BLOCK],
    ) -> Self {
        let zeros = [0.0; BLOCK];
        let radius = spheres.map(|(_, radius)| radius);
        let [x, y, z] = [|center: Vector| center.x, |center: Vector| center.y, |center: Vector| center.z]
            .map(|of: fn(Vector) -> f64| spheres.map(|(center, _)| of(center)));
        let ellipse = Ellipse::filled_with(zeros);
        let mut block = Self { ellipse, depth: [zeros; 3], distance: zeros, radius, doubtful, number };
        for at in (0..BLOCK).step_by(D::COUNT) {
            let center = Vector::new(
                exactly::<D>(token, &x[at..]),
                exactly::<D>(token, &y[at..]),
                exactly::<D>(token, &z[at..]),
            );
            let from_eye = grid.seen_from_eye(center, exactly::<D>(token, &radius[at..]));
            let ellipse = Ellipse::new(from_eye, grid.in_camera(from_eye), grid);
            let metres = D::load(token, &radius[at..]);
            for (depth, direction) in block.depth.iter_mut().zip(ellipse.direction) {
                (direction.dot(ellipse.center) * metres).store(&mut depth[at..]);
            }
            (ellipse.center.length() * metres).store(&mut block.distance[at..]);
            ellipse.put_into(
                &mut block.ellipse,
                #[inline(always)]
                |numbers, out| numbers.store(&mut out[at..]),
            );
        }
        block
    }

    /// How far in front of the eye the centre is, in radii.
    fn depth_in_radii(&self, lane: usize, view: &View) -> f64 {
        self.ellipse.center.map(|numbers| numbers[lane]).dot(view.forward)
    }
}
