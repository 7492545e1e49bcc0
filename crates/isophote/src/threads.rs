//! The threads of a computation: every parallel loop runs on the threads that the caller asked for.

use std::fmt;
use std::num::NonZeroUsize;
use std::sync::{Arc, OnceLock};

use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// A number of threads, started when first needed and shared by clones. With one thread, on systems without threads, or in a
/// forked process whose parent started them, the calling thread does all the work.
#[derive(Clone, Debug)]
pub struct Threads {
    /// How many were asked for, if it was said.
    asked_for: Option<NonZeroUsize>,
    shared: Arc<Shared>,
}

/// What is found out when it is first needed: the system is slow to tell how many processors there are.
#[derive(Debug, Default)]
struct Shared {
    count: OnceLock<usize>,
    pool: OnceLock<Pool>,
}

/// The started threads (or the reason why they did not start) and the process that they belong to: a parent's threads do not
/// exist in a forked process, and waiting for them there would never end.
#[derive(Debug)]
struct Pool {
    process: u32,
    threads: Result<ThreadPool, String>,
}

/// WebAssembly has no threads unless it is compiled for shared memory.
const HAS_THREADS: bool = cfg!(any(not(target_family = "wasm"), target_feature = "atomics"));

/// The threads could not be started.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ThreadsError {
    /// The number of threads that was asked for.
    pub threads: usize,
    /// The system's error message.
    pub reason: String,
}

impl fmt::Display for ThreadsError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "cannot start {} threads: {}", self.threads, self.reason)
    }
}

impl std::error::Error for ThreadsError {}

impl Default for Threads {
    /// One thread per processor.
    fn default() -> Self {
        Self::new(None)
    }
}

impl Threads {
    /// This many threads; one per processor when `None`.
    #[must_use]
    pub fn new(count: Option<NonZeroUsize>) -> Self {
        Self { asked_for: count, shared: Arc::default() }
    }

    /// The caller's alone.
    #[must_use]
    pub fn single() -> Self {
        Self::new(Some(NonZeroUsize::MIN))
    }

    /// How many there are.
    #[must_use]
    pub fn count(&self) -> usize {
        if !HAS_THREADS {
            return 1;
        }
        // Told outright: a pool would otherwise take its size from an environment variable.
        let available = || std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
        self.asked_for.map_or_else(|| *self.shared.count.get_or_init(available), NonZeroUsize::get)
    }

    fn pool(&self) -> Result<Option<&ThreadPool>, ThreadsError> {
        let count = self.count();
        if count == 1 {
            return Ok(None);
        }
        let start = || Pool {
            process: std::process::id(),
            threads: ThreadPoolBuilder::new().num_threads(count).build().map_err(|error| error.to_string()),
        };
        match self.shared.pool.get_or_init(start) {
            Pool { process, .. } if *process != std::process::id() => Ok(None),
            Pool { threads: Ok(pool), .. } => Ok(Some(pool)),
            Pool { threads: Err(reason), .. } => Err(ThreadsError { threads: count, reason: reason.clone() }),
        }
    }

    /// Starts the threads if they are not running yet.
    ///
    /// # Errors
    /// The system's message if it refuses.
    pub fn start(&self) -> Result<(), ThreadsError> {
        self.pool().map(|_| ())
    }

    /// Applies a function to each item, in parallel. (On the calling thread alone if no others could be started:
    /// [`start`](Self::start) reports that.)
    pub fn map<T: Send, U: Send, C: FromParallelIterator<U> + FromIterator<U> + Send>(
        &self,
        things: Vec<T>,
        work: impl Fn(T) -> U + Sync + Send,
    ) -> C {
        match self.pool() {
            Ok(Some(pool)) => pool.install(|| things.into_par_iter().with_max_len(1).map(work).collect()),
            _ => things.into_iter().map(work).collect(),
        }
    }

    /// Sorts numbers.
    pub(crate) fn sort(&self, numbers: &mut [u64]) {
        match self.pool() {
            Ok(Some(pool)) => pool.install(|| numbers.par_sort_unstable()),
            _ => numbers.sort_unstable(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_is_done_in_order_on_as_many_threads_as_were_asked_for() {
        for count in [1, 2, 5] {
            let threads = Threads::new(NonZeroUsize::new(count));
            let squares: Vec<u32> = threads.map((0..100).collect(), |number: u32| number * number);
            assert!(squares.iter().zip(0..).all(|(square, number)| *square == number * number));
            let ours: Vec<usize> = threads.map(vec![(); 8], |()| rayon::current_num_threads());
            let expected = if count == 1 { rayon::current_num_threads() } else { count };
            assert_eq!(ours, vec![expected; 8]);
        }
    }
}
