//! Isophote computes the brightness of surfaces lit by point lights, with units and a formula number on every value.

pub mod accelerate;
pub mod analysis;
pub mod camera;
pub mod color;
pub mod conformance;
pub mod double_double;
mod hammersley;
pub mod import;
pub mod lanes;
pub mod light;
pub mod map;
pub mod outline;
pub mod prepare;
pub mod ray;
pub mod real;
pub mod reflectance;
pub mod render;
#[cfg(test)]
mod sample_map;
pub mod scalar;
pub mod scene;
pub mod shade;
pub mod shape;
pub mod sum;
pub mod text;
pub mod threads;
pub mod tolerance;
pub mod units;
pub mod vector;
