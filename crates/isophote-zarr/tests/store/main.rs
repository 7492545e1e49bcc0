//! Stores as their users meet them.

mod common;
mod content;
mod continued;
mod damage;
mod python;
