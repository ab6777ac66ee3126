//! The command line as a user sees it: arguments in; exit code, texts and
//! files out.

mod backup;
mod bench;
mod command;
mod demo;
mod folder;
#[cfg(unix)]
mod interrupted;
mod packaging;
mod plan;
mod remote;
mod run;
mod serve;
mod study;
mod terrain;
mod usage;
mod validate;
mod verify;
