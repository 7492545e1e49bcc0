//! Work that stays on one thread.

/// Runs work in a pool of one thread, outside the workers' own pools. The Zarr library occasionally asks rayon for its
/// number of threads; outside a pool, that starts the shared one, with a thread per processor.
///
/// The pool is dropped with the work: in a process forked later, its thread would be missing.
pub fn alone<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    match rayon::ThreadPoolBuilder::new().num_threads(1).build() {
        Ok(pool) => pool.install(work),
        // No thread can be started, so run the work here.
        Err(_) => work(),
    }
}
