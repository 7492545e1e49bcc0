//! The threads of what is computed without being told on how many.

use std::sync::{Mutex, PoisonError};

use isophote::threads::Threads;

/// As many as there are processors, the same for all calls of this process. (One that was forked off has its own: those of
/// its parent do not exist there.)
pub fn threads() -> Threads {
    static SHARED: Mutex<Option<(u32, Threads)>> = Mutex::new(None);
    let process = std::process::id();
    let mut shared = SHARED.lock().unwrap_or_else(PoisonError::into_inner);
    match &*shared {
        Some((of, threads)) if *of == process => threads.clone(),
        _ => shared.insert((process, Threads::default())).1.clone(),
    }
}
