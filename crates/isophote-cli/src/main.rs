//! The command `isophote`.

mod args;
mod commands;
mod failure;
mod load;
mod numbers;
mod progress;
mod table;

use std::io::Write;
use std::process::ExitCode;

use clap::Parser;

/// Arguments, job, run: results to standard output, everything else to standard error.
fn main() -> ExitCode {
    let arguments = args::Arguments::parse();
    progress::watch_for_interrupts();
    match commands::run(arguments) {
        Ok(result) => print(&result),
        Err(error) => failure::report(&error),
    }
}

/// Whoever reads standard output may stop listening at any time: that is no failure.
fn print(result: &str) -> ExitCode {
    let mut stdout = std::io::stdout().lock();
    match stdout.write_all(result.as_bytes()).and_then(|()| stdout.flush()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(error) => failure::report(&anyhow::Error::new(error).context("cannot write to standard output")),
    }
}
