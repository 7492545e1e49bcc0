//! The default number of threads.

use std::num::NonZeroUsize;

/// As many threads as the machine can run at once, unless the user sets a number.
pub fn all() -> NonZeroUsize {
    std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN)
}
