//! The command line: commands and exit codes.
//!
//! Exit codes: 0 success; 2 invalid input (arguments, files, scenario); 3 failure of the
//! computation; 4 a case of known answer failed; 130 and 143 Ctrl-C and SIGTERM; 1 any other
//! failure (a full disk, a port in use).

mod arguments;
mod backup;
mod bench;
mod charts;
mod columns;
mod console;
mod demo;
mod failure;
mod files;
mod interrupts;
mod intervals;
mod job_document;
mod local_run;
mod machine;
mod manual;
mod meter;
mod plan;
mod remote;
mod results_folder;
mod scenario_file;
mod scenario_maps;
mod serve;
mod signals;
mod study;
mod table;
mod terrain;
mod token;
mod validate;
mod verify;
mod work;

use arguments::{Arguments, Command};
use clap::Parser;
use failure::Failure;
use std::process::ExitCode;

/// Executes the command line.
pub(crate) fn run() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(answer) => return usage(&answer),
    };
    let result = match &arguments.command {
        Command::Serve(options) => serve::serve(options),
        Command::Work(options) => work::work(options),
        Command::Backup(options) => backup::backup(options),
        Command::Token(options) => token::token(options),
        Command::Run(options) => local_run::run(options),
        Command::Study(options) => study::study(options),
        Command::Submit(options) => remote::submit(options),
        Command::Watch(options) => remote::watch(options),
        Command::Get(options) => remote::get(options),
        Command::Dismiss(options) => remote::dismiss(options),
        Command::Plan(options) => plan::plan(options),
        Command::Validate(options) => validate::validate(options),
        Command::Terrain(options) => terrain::terrain(options),
        Command::Demo(options) => demo::demo(options),
        Command::Bench(options) => bench::bench(options),
        Command::Verify(options) => verify::verify(options),
        Command::Completions(options) => manual::completions(options),
        Command::Man(options) => manual::man(options),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}

/// Prints help, version or an argument error.
fn usage(answer: &clap::Error) -> ExitCode {
    // The output may be closed; the exit code still reports the result.
    let _ = answer.print();
    if answer.use_stderr() {
        ExitCode::from(Failure::Input(String::new()).exit_code())
    } else {
        ExitCode::SUCCESS
    }
}
