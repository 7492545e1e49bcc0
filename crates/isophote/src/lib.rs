//! Isophote
pub mod export;
pub mod map;
pub mod units;
