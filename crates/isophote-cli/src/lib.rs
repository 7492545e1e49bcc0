//! The command `isophote`, for the program of that name and for the Python package, which has the same command.

mod args;
mod channels;
mod commands;
mod failure;
mod load;
mod numbers;
mod progress;
mod table;
mod threads;

use std::ffi::OsString;
use std::io::Write;

use clap::Parser;

/// Arguments, job, run: results to standard output, everything else to standard error. Takes the program's name first, and
/// gives its exit code.
///
/// It is for whoever runs a whole process with it: Ctrl-C is the command's from then on, and may end the process.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let arguments = match args::Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        // Help and versions come this way too. Whoever reads them may stop listening.
        Err(answer) => {
            let _ = answer.print();
            return u8::try_from(answer.exit_code()).unwrap_or(2);
        }
    };
    progress::watch_for_interrupts();
    match commands::run(arguments) {
        Ok(result) => print(&result),
        Err(error) => failure::report(&error),
    }
}

/// Whoever reads standard output may stop listening at any time: that is no failure.
fn print(result: &str) -> u8 {
    let mut stdout = std::io::stdout().lock();
    match stdout.write_all(result.as_bytes()).and_then(|()| stdout.flush()) {
        Ok(()) => 0,
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => 0,
        Err(error) => failure::report(&anyhow::Error::new(error).context("cannot write to standard output")),
    }
}
