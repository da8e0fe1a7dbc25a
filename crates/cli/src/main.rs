//! The `delone` program.

use std::process::ExitCode;

fn main() -> ExitCode {
    delone_cli::run()
}
