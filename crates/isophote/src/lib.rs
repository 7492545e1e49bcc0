//! Isophote
pub mod analysis;
pub mod export;
pub mod map;
#[cfg(test)]
mod sample_map;
pub mod units;
