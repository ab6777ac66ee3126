//! The command line of Scree.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::run()
}
