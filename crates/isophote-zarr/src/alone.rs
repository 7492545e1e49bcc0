//! Work that stays on one thread.

/// Does something in a pool of one thread, outside of the workers' own. The library for Zarr asks now and then how many
/// threads rayon has; where there is no pool that starts the shared one, with a thread for each processor.
///
/// The pool does not outlive the work: in a process that is forked off later its thread would be missing.
pub fn alone<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    match rayon::ThreadPoolBuilder::new().num_threads(1).build() {
        Ok(pool) => pool.install(work),
        // No threads are to be had: as well here.
        Err(_) => work(),
    }
}
