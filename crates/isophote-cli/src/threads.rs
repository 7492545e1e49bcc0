//! How many threads work.

use std::num::NonZeroUsize;

/// As many as the machine runs at a time, where nobody says how many.
pub fn all() -> NonZeroUsize {
    std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN)
}
