//! The command line: what can be asked, and the exit codes of the answers.
//!
//! 0: fine. 2: the input is at fault (arguments, files, scenario). 3: the
//! computation could not go on. 4: a case with a known answer was missed.
//! 1: anything else (a full disk, a busy port).

mod arguments;
mod bench;
mod charts;
mod columns;
mod console;
mod demo;
mod failure;
mod intervals;
mod local_run;
mod machine;
mod meter;
mod output;
mod plan;
mod scenario_file;
mod serve;
mod table;
mod token;
mod validate;
mod verify;

use arguments::{Arguments, Command};
use clap::Parser;
use failure::Failure;
use std::process::ExitCode;

/// Does what the command line asks for.
pub(crate) fn run() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(answer) => return usage(&answer),
    };
    let result = match &arguments.command {
        Command::Serve(options) => serve::serve(options),
        Command::Token(options) => token::token(options),
        Command::Run(options) => local_run::run(options),
        Command::Plan(options) => plan::plan(options),
        Command::Validate(options) => validate::validate(options),
        Command::Demo(options) => demo::demo(options),
        Command::Bench(options) => bench::bench(options),
        Command::Verify(options) => verify::verify(options),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}

/// Help and version asked for, or arguments that can't be understood.
fn usage(answer: &clap::Error) -> ExitCode {
    // Nobody may be listening any more; the exit code still tells.
    let _ = answer.print();
    if answer.use_stderr() {
        ExitCode::from(Failure::Input(String::new()).exit_code())
    } else {
        ExitCode::SUCCESS
    }
}
