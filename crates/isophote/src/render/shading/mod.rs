//! The shading of blocks of points, however they were found: one kernel, in SIMD vectors.

pub mod block;
pub mod emitters;
pub mod kernel;
pub mod lobe;
