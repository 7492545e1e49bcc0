//! Progress and interruption.

use std::fmt;
use std::io::{self, Seek, SeekFrom, Write};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use isophote::message;
use isophote::render::Observer;
use isophote::text::{Language, Message};

use crate::failure::{self, Interrupted};

static INTERRUPTED: AtomicBool = AtomicBool::new(false);
static ENDS_IN_ORDER: AtomicBool = AtomicBool::new(false);
static STAYS: Mutex<Option<Message>> = Mutex::new(None);

/// How long the work may take to end in order. Not all of it has a [`check`] every now and then.
const GRACE: Duration = Duration::from_millis(700);

/// From now on Ctrl-C ends the program with exit code 130, until [`end_in_order`] is called. It exits immediately,
/// because the program may be waiting for input or far from the next [`check`]. After [`end_in_order`] the program has a
/// moment for that; then, or at the second Ctrl-C, it ends all the same, without the files that were being written.
pub fn watch_for_interrupts(language: Language) {
    // Without the handler Ctrl-C kills the program, which at worst leaves a temporary file behind.
    let _ = ctrlc::set_handler(move || {
        let is_second = INTERRUPTED.swap(true, Ordering::Relaxed);
        if !ENDS_IN_ORDER.load(Ordering::Relaxed) {
            failure::note(&message!("interrupted; nothing was written").in_language(language));
            std::process::exit(130);
        }
        if is_second {
            end_at_once(language);
        }
        // On a thread of its own, so that the handler is free for the second signal. Without one, waiting would hide it.
        let waiting = std::thread::Builder::new().spawn(move || {
            std::thread::sleep(GRACE);
            end_at_once(language);
        });
        if waiting.is_err() {
            end_at_once(language);
        }
    });
}

/// Ends the program although it is at work. Files appear under their names only when they are complete, so removing those
/// that are being written leaves nothing half-written.
fn end_at_once(language: Language) -> ! {
    let stays = STAYS.lock().unwrap_or_else(PoisonError::into_inner).take();
    isophote_export::atomic::abandon_unfinished();
    let message = match stays {
        Some(stays) => message!("interrupted; {stays}", stays),
        None => failure::nothing_half_written(),
    };
    failure::note(&message.in_language(language));
    std::process::exit(130)
}

/// What to say when the program ends at once: what stays, and how to go on.
pub fn say_what_stays(what: Message) {
    *STAYS.lock().unwrap_or_else(PoisonError::into_inner) = Some(what);
}

/// From now on Ctrl-C ends the work at the next [`check`], after cleaning up.
pub fn end_in_order() {
    ENDS_IN_ORDER.store(true, Ordering::Relaxed);
}

/// Ends work that reports no progress when Ctrl-C is pressed.
pub struct Patience;

impl Observer for Patience {
    fn advance(&self, _: u64) -> ControlFlow<()> {
        if check().is_err() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// Whether Ctrl-C was pressed.
pub fn check() -> Result<(), Interrupted> {
    if INTERRUPTED.load(Ordering::Relaxed) { Err(Interrupted) } else { Ok(()) }
}

/// A progress bar for work that takes more than a second; hidden when standard error is not a terminal.
pub struct Progress {
    bar: ProgressBar,
    since: Instant,
    is_shown: AtomicBool,
}

impl Progress {
    pub fn new(pixels: u64, quiet: bool, language: Language) -> Self {
        Self::resumed([0, pixels], quiet, language)
    }

    /// A bar for work that was partly done before.
    pub fn resumed([done, pixels]: [u64; 2], quiet: bool, language: Language) -> Self {
        end_in_order();
        let bar = ProgressBar::with_draw_target(Some(pixels), ProgressDrawTarget::hidden());
        let left = message!("{eta} left", eta = "{eta}").in_language(language);
        let style = ProgressStyle::with_template(&format!("{{bar:40}} {{percent}}%  {{rate}}  {left}"));
        let rate = move |state: &ProgressState, text: &mut dyn fmt::Write| {
            let rate = message!("{rate} Mpixel/s", rate = format!("{:.1}", state.per_sec() / 1e6));
            // If the formatting fails, the bar just omits it.
            let _ = text.write_str(&rate.in_language(language));
        };
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()).with_key("rate", rate));
        bar.set_position(done);
        // Pixels from earlier runs say nothing about the speed of this one.
        bar.reset_eta();
        Self { bar, since: Instant::now(), is_shown: AtomicBool::new(quiet) }
    }

    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

impl Observer for Progress {
    fn advance(&self, pixels: u64) -> ControlFlow<()> {
        self.bar.inc(pixels);
        if self.since.elapsed() > Duration::from_secs(1) && !self.is_shown.swap(true, Ordering::Relaxed) {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        if check().is_err() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// A file whose writing stops when Ctrl-C is pressed.
pub struct Interruptible<W>(pub W);

impl<W: Write> Write for Interruptible<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        check().map_err(io::Error::other)?;
        self.0.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

impl<W: Seek> Seek for Interruptible<W> {
    fn seek(&mut self, position: SeekFrom) -> io::Result<u64> {
        self.0.seek(position)
    }
}
