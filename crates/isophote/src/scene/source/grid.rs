//! Grids as they are written.

use schemars::JsonSchema;
use serde::Serialize;

use crate::shape::Side;

/// Points on a rectangle at which the irradiance (illuminance) is computed, with no need of a surface there.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GridSource {
    /// A name of its own; by default `grid[0]`, `grid[1]` and so on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// The corner at which both edges begin. Either this or `center`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corner: Option<[f64; 3]>,
    /// The middle of the rectangle. Either this or `corner`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub center: Option<[f64; 3]>,
    /// An edge of the rectangle: where it leads and how long it is.
    #[schemars(required)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub u: Option<[f64; 3]>,
    /// The other edge, at right angles to the first.
    #[schemars(required)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub v: Option<[f64; 3]>,
    /// Points along `u` and along `v`; each stands in the middle of its cell.
    #[schemars(required, inner(range(min = 1, max = 65536)))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub points: Option<[u64; 2]>,
    /// The side that is lit: `front` is the one to which u × v leads.
    #[schemars(extend("default" = "front"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub side: Option<Side>,
}
