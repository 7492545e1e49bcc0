//! The default threads, for work with no thread count given.

use std::sync::{Mutex, PoisonError};

use isophote::threads::Threads;

/// One thread per processor, shared by all calls of this process. (A forked process gets its own: its parent's threads
/// do not exist there.)
pub fn threads() -> Threads {
    static SHARED: Mutex<Option<(u32, Threads)>> = Mutex::new(None);
    let process = std::process::id();
    let mut shared = SHARED.lock().unwrap_or_else(PoisonError::into_inner);
    match &*shared {
        Some((of, threads)) if *of == process => threads.clone(),
        _ => shared.insert((process, Threads::default())).1.clone(),
    }
}
