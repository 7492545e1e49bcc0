//! The threads of a computation: every parallel loop runs on those that the caller asked for.

use std::fmt;
use std::num::NonZeroUsize;
use std::sync::{Arc, OnceLock};

use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// So many threads, started when they are first needed and shared by clones. With one thread, where the system
/// has none, or in a process that was forked off from theirs, the caller's does all the work.
#[derive(Clone, Debug)]
pub struct Threads {
    count: usize,
    pool: Arc<OnceLock<Pool>>,
}

/// Threads that were started, or why they were not, and in which process: those of a parent do not exist in one that was
/// forked off, and who waits for them waits for ever.
#[derive(Debug)]
struct Pool {
    process: u32,
    threads: Result<ThreadPool, String>,
}

/// WebAssembly has none, unless it is compiled for shared memory.
const HAS_THREADS: bool = cfg!(any(not(target_family = "wasm"), target_feature = "atomics"));

/// The threads could not be started.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ThreadsError {
    /// What was asked for.
    pub threads: usize,
    /// What the system says.
    pub reason: String,
}

impl fmt::Display for ThreadsError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "cannot start {} threads: {}", self.threads, self.reason)
    }
}

impl std::error::Error for ThreadsError {}

impl Default for Threads {
    /// As many as there are processors.
    fn default() -> Self {
        Self::new(None)
    }
}

impl Threads {
    /// So many; as many as there are processors when unstated.
    #[must_use]
    pub fn new(count: Option<NonZeroUsize>) -> Self {
        // Told outright: a pool would otherwise take its size from an environment variable.
        let count = count.or_else(|| std::thread::available_parallelism().ok()).map_or(1, NonZeroUsize::get);
        Self { count: if HAS_THREADS { count } else { 1 }, pool: Arc::default() }
    }

    /// The caller's alone.
    #[must_use]
    pub fn single() -> Self {
        Self { count: 1, pool: Arc::default() }
    }

    /// How many there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    fn pool(&self) -> Result<Option<&ThreadPool>, ThreadsError> {
        if self.count == 1 {
            return Ok(None);
        }
        let start = || Pool {
            process: std::process::id(),
            threads: ThreadPoolBuilder::new().num_threads(self.count).build().map_err(|error| error.to_string()),
        };
        match self.pool.get_or_init(start) {
            Pool { process, .. } if *process != std::process::id() => Ok(None),
            Pool { threads: Ok(pool), .. } => Ok(Some(pool)),
            Pool { threads: Err(reason), .. } => Err(ThreadsError { threads: self.count, reason: reason.clone() }),
        }
    }

    /// Starts them, if they are not yet.
    ///
    /// # Errors
    /// What the system says if it refuses.
    pub fn start(&self) -> Result<(), ThreadsError> {
        self.pool().map(|_| ())
    }

    /// Does the same to each of some things, one at a time on each thread. (On the caller's alone where others could not
    /// be started: [`start`](Self::start) tells.)
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
