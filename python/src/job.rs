//! Long work: without the interpreter's lock, with an ear for Ctrl-C, and with panics turned into exceptions.

use std::any::Any;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, OnceLock, mpsc};
use std::time::Duration;

use isophote::render::Observer;
use pyo3::prelude::*;

use crate::error;

/// How often Python's signal handlers and the progress function get their turn.
const PAUSE: Duration = Duration::from_millis(40);

/// What a job tells of itself, and what it is told.
#[derive(Default)]
pub struct Watch {
    done: AtomicU64,
    is_stopped: AtomicBool,
}

impl Watch {
    /// Whether nobody waits for the result any more.
    pub fn is_stopped(&self) -> bool {
        self.is_stopped.load(Ordering::Relaxed)
    }
}

impl Observer for Watch {
    fn advance(&self, amount: u64) -> ControlFlow<()> {
        self.done.fetch_add(amount, Ordering::Relaxed);
        if self.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// The progress function of the caller, and what it counts up to.
pub struct Progress {
    pub function: Option<Py<PyAny>>,
    pub total: u64,
}

impl Progress {
    pub fn none() -> Self {
        Self { function: None, total: 0 }
    }

    fn report(&self, py: Python<'_>, watch: &Watch) -> PyResult<()> {
        let Some(function) = &self.function else { return Ok(()) };
        function.call1(py, (watch.done.load(Ordering::Relaxed).min(self.total), self.total))?;
        Ok(())
    }
}

/// What becomes of a job that is interrupted.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// Its result is let go of; it ends when it next looks, and nobody waits for that.
    Alone,
    /// It holds files, which the caller may use next: it is waited for.
    AwaitedBecauseOfFiles,
}

/// Runs a job on a thread of its own. This thread waits without the interpreter's lock, and takes it now and then for the
/// signal handlers and the progress function; what they raise ends the waiting at once, and the job as soon as it looks.
pub fn run<T: Send + 'static>(
    py: Python<'_>,
    progress: &Progress,
    job: impl FnOnce(&Watch) -> T + Send + 'static,
) -> PyResult<T> {
    run_to(py, Ending::Alone, progress, job)
}

/// The same, with a word about the end.
pub fn run_to<T: Send + 'static>(
    py: Python<'_>,
    ending: Ending,
    progress: &Progress,
    job: impl FnOnce(&Watch) -> T + Send + 'static,
) -> PyResult<T> {
    let watch = Arc::new(Watch::default());
    let (sender, mut receiver) = mpsc::channel();
    let worker = {
        let watch = Arc::clone(&watch);
        move || {
            let result = catch_unwind(AssertUnwindSafe(|| apart_from_the_parent(|| job(&watch))));
            // Nobody listens any more after an interruption.
            let _ = sender.send(result);
        }
    };
    std::thread::Builder::new().name("isophote".into()).spawn(worker).map_err(error::file)?;
    loop {
        let answer;
        (receiver, answer) = py.detach(move || {
            let answer = receiver.recv_timeout(PAUSE);
            (receiver, answer)
        });
        match answer {
            Ok(Ok(result)) => {
                progress.report(py, &watch)?;
                return Ok(result);
            }
            Ok(Err(panic)) => return Err(error::internal(py, message(&*panic))),
            Err(mpsc::RecvTimeoutError::Timeout) => {
                if let Err(error) = py.check_signals().and_then(|()| progress.report(py, &watch)) {
                    watch.is_stopped.store(true, Ordering::Relaxed);
                    if ending == Ending::AwaitedBecauseOfFiles {
                        // What it says does not matter any more.
                        let _ = py.detach(move || receiver.recv());
                    }
                    return Err(error);
                }
            }
            Err(mpsc::RecvTimeoutError::Disconnected) => {
                return Err(error::internal(py, "the work ended without a word"));
            }
        }
    }
}

/// Runs a job, in a process that was forked off on threads of its own: those of the parent's pool do not exist there, and
/// who waits for them waits for ever.
fn apart_from_the_parent<T: Send>(job: impl FnOnce() -> T + Send) -> T {
    static FIRST_PROCESS: OnceLock<u32> = OnceLock::new();
    let process = std::process::id();
    if *FIRST_PROCESS.get_or_init(|| process) == process {
        return job();
    }
    match rayon::ThreadPoolBuilder::new().build() {
        Ok(pool) => pool.install(job),
        // No threads are to be had: as well here.
        Err(_) => job(),
    }
}

fn message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str).or_else(|| panic.downcast_ref::<&str>().copied());
    format!("{}; this is a fault of Isophote, please report it", text.unwrap_or("the work broke off"))
}

/// For the test that a panic becomes an exception: one that is asked for.
#[pyfunction]
pub fn panic_on_purpose(py: Python<'_>, message: String) -> PyResult<()> {
    run(py, &Progress::none(), move |_| panic!("{message}"))
}
