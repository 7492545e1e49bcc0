//! The command `isophote`, shared by the program of that name and the Python package.

mod args;
mod channels;
mod commands;
mod failure;
mod load;
mod memory;
mod numbers;
mod progress;
mod table;
mod threads;

use std::ffi::OsString;
use std::io::Write;

use clap::Parser;
use isophote::message;
use isophote::text::Language;

pub use commands::APP_PAGE;

/// Parses the arguments and runs the command: results go to standard output, everything else to standard error. The
/// first argument is the program's name; returns the exit code.
///
/// Meant for a process that does nothing else: from then on the command handles Ctrl-C, and may end the process.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let arguments = match args::Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        // Help and version texts arrive here too. The reader may have closed the pipe.
        Err(answer) => {
            let _ = answer.print();
            return u8::try_from(answer.exit_code()).unwrap_or(2);
        }
    };
    let language = arguments.language();
    progress::watch_for_interrupts(language);
    match commands::run(arguments) {
        Ok(result) => print(&result, language),
        Err(error) => failure::report(&error, language),
    }
}

/// The reader may close standard output at any time: that is not an error.
fn print(result: &str, language: Language) -> u8 {
    let mut stdout = std::io::stdout().lock();
    match stdout.write_all(result.as_bytes()).and_then(|()| stdout.flush()) {
        Ok(()) => 0,
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => 0,
        Err(error) => {
            let error = error.to_string();
            let failed = failure::Failed(message!("cannot write to standard output: {error}", error));
            failure::report(&failed.into(), language)
        }
    }
}
