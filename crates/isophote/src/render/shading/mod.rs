//! The shading of blocks of points, whatever found them: one kernel, in lanes.

pub mod block;
pub mod emitters;
pub mod kernel;
pub mod lobe;
