//! Long-running work: without the interpreter's lock, responsive to Ctrl-C, and with panics turned into exceptions.

use std::any::Any;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, mpsc};
use std::time::Duration;

use isophote::render::Observer;
use pyo3::prelude::*;

use crate::error;

/// How often Python's signal handlers and the progress function run.
const PAUSE: Duration = Duration::from_millis(40);

/// The state shared with a running job: its progress, and the request to stop.
#[derive(Default)]
pub struct Watch {
    done: AtomicU64,
    is_stopped: AtomicBool,
}

impl Watch {
    /// Whether the result is no longer needed.
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

/// The caller's progress function, and the total that it counts up to.
pub struct Progress {
    pub function: Option<Py<PyAny>>,
    pub total: u64,
}

impl Progress {
    pub fn none() -> Self {
        Self { function: None, total: 0 }
    }

    fn report(&self, py: Python<'_>, watch: &Watch) -> PyResult<()> {
        self.say(py, watch.done.load(Ordering::Relaxed).min(self.total))
    }

    fn say(&self, py: Python<'_>, done: u64) -> PyResult<()> {
        if let Some(function) = &self.function {
            function.call1(py, (done, self.total))?;
        }
        Ok(())
    }
}

/// Runs a short job on this thread, without the interpreter's lock.
pub fn run_here<T: Send>(py: Python<'_>, progress: &Progress, job: impl FnOnce() -> T + Send) -> PyResult<T> {
    let result = py.detach(|| catch_unwind(AssertUnwindSafe(job)));
    let result = result.map_err(|panic| error::internal(py, message(&*panic)))?;
    progress.say(py, progress.total)?;
    Ok(result)
}

/// Runs a job on its own thread. This thread waits without the interpreter's lock, and takes it periodically for the
/// signal handlers and the progress function. If they raise an exception, the wait ends at once, and the job at its
/// next check.
pub fn run<T: Send + 'static>(
    py: Python<'_>,
    progress: &Progress,
    job: impl FnOnce(&Watch) -> T + Send + 'static,
) -> PyResult<T> {
    let watch = Arc::new(Watch::default());
    let (sender, receiver) = mpsc::channel();
    let worker = {
        let watch = Arc::clone(&watch);
        // After an interruption there is no receiver any more.
        move || drop(sender.send(outcome(|| job(&watch))))
    };
    named().spawn(worker).map_err(error::file)?;
    wait(py, progress, &watch, receiver).map_err(|Interruption { error, .. }| error)
}

/// Like [`run`], for a job that borrows, or that holds files the caller may use next: after an interruption it waits
/// for the job to end.
pub fn run_to_its_end<T: Send>(
    py: Python<'_>,
    progress: &Progress,
    job: impl FnOnce(&Watch) -> T + Send,
) -> PyResult<T> {
    let watch = &Watch::default();
    std::thread::scope(|scope| {
        let (sender, receiver) = mpsc::channel();
        named().spawn_scoped(scope, move || drop(sender.send(outcome(|| job(watch))))).map_err(error::file)?;
        wait(py, progress, watch, receiver).map_err(|Interruption { error, receiver }| {
            // The result no longer matters.
            drop(py.detach(move || receiver.map(|receiver| receiver.recv())));
            error
        })
    })
}

type Outcome<T> = Result<T, Box<dyn Any + Send>>;

fn named() -> std::thread::Builder {
    std::thread::Builder::new().name("isophote".into())
}

fn outcome<T: Send>(job: impl FnOnce() -> T + Send) -> Outcome<T> {
    catch_unwind(AssertUnwindSafe(job))
}

/// The error that ended the wait, and the channel on which the job's end is still to be reported, if it is.
struct Interruption<T> {
    error: PyErr,
    receiver: Option<mpsc::Receiver<Outcome<T>>>,
}

impl<T> From<PyErr> for Interruption<T> {
    fn from(error: PyErr) -> Self {
        Self { error, receiver: None }
    }
}

/// Waits for a job.
fn wait<T: Send>(
    py: Python<'_>,
    progress: &Progress,
    watch: &Watch,
    mut receiver: mpsc::Receiver<Outcome<T>>,
) -> Result<T, Interruption<T>> {
    loop {
        let answer;
        (receiver, answer) = py.detach(move || {
            let answer = receiver.recv_timeout(PAUSE);
            (receiver, answer)
        });
        match answer {
            Ok(Ok(result)) => {
                progress.report(py, watch)?;
                return Ok(result);
            }
            Ok(Err(panic)) => return Err(error::internal(py, message(&*panic)).into()),
            Err(mpsc::RecvTimeoutError::Timeout) => {
                if let Err(error) = py.check_signals().and_then(|()| progress.report(py, watch)) {
                    watch.is_stopped.store(true, Ordering::Relaxed);
                    return Err(Interruption { error, receiver: Some(receiver) });
                }
            }
            Err(mpsc::RecvTimeoutError::Disconnected) => {
                return Err(error::internal(py, "the work ended without a word").into());
            }
        }
    }
}

fn message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str).or_else(|| panic.downcast_ref::<&str>().copied());
    format!("{}; this is a fault of Isophote, please report it", text.unwrap_or("the work broke off"))
}

/// Panics on request, to test that a panic becomes an exception.
#[pyfunction]
pub fn panic_on_purpose(py: Python<'_>, message: String) -> PyResult<()> {
    run(py, &Progress::none(), move |_| panic!("{message}"))
}
