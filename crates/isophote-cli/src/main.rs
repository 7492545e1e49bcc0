//! The command `isophote`.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(isophote_cli::run(std::env::args_os()))
}
