//! Points whose values are reported, one by one or on grids, as they are written.

use super::declare::tables;
use crate::map::Resolution;
use crate::shape::Side;

tables! {
    /// A point on a surface whose values are reported.
    #[serde(deny_unknown_fields)]
    pub struct ProbeSource {
        /// A name of its own; by default `probe[0]`, `probe[1]` and so on.
        pub name: Option<String>,
        /// The point; it must lie on a surface, to a billionth of the shape's size.
        #[schemars(required)]
        pub at: Option<[f64; 3]>,
        /// A value that somebody published for this point, shown beside the computed brightness and used for nothing else.
        pub published: Option<f64>,
    }

    /// A circle or a rectangle, on a plane or on the screen, whose largest, smallest and mean brightness are reported.
    #[serde(deny_unknown_fields)]
    pub struct AreaSource {
        /// A name of its own; by default `area[0]`, `area[1]` and so on.
        pub name: Option<String>,
        /// The name of the plane, rectangle or disk that it is on. Without it, it is on the screen.
        pub on: Option<String>,
        /// Its centre, a point of that surface.
        pub center: Option<[f64; 3]>,
        /// Its centre on the screen: x and y, in the unit of the screen. Only without `on`.
        pub at: Option<[f64; 2]>,
        /// The radius of a circle. Either this or `size`.
        #[schemars(extend("exclusiveMinimum" = 0))]
        pub radius: Option<f64>,
        /// Width and height of a rectangle. Either this or `radius`.
        pub size: Option<[f64; 2]>,
        /// The direction of the height of a rectangle on a surface; what of it is along the normal does not count.
        #[schemars(extend("default" = [0, 1, 0]))]
        pub up: Option<[f64; 3]>,
    }

    /// Points on a rectangle at which the irradiance (illuminance) is computed, with no need of a surface there.
    #[serde(deny_unknown_fields)]
    pub struct GridSource {
        /// A name of its own; by default `grid[0]`, `grid[1]` and so on.
        pub name: Option<String>,
        /// The corner at which both edges begin. Either this or `center`.
        pub corner: Option<[f64; 3]>,
        /// The middle of the rectangle. Either this or `corner`.
        pub center: Option<[f64; 3]>,
        /// An edge of the rectangle: where it leads and how long it is.
        #[schemars(required)]
        pub u: Option<[f64; 3]>,
        /// The other edge, at right angles to the first.
        #[schemars(required)]
        pub v: Option<[f64; 3]>,
        /// Points along `u` and along `v`; each stands in the middle of its cell.
        #[schemars(required, inner(range(min = 1, max = Resolution::LONGEST_IN_MEMORY)))]
        pub points: Option<[u64; 2]>,
        /// The side that is lit: `front` is the one to which u × v leads.
        #[schemars(extend("default" = "front"))]
        pub side: Option<Side>,
    }
}
