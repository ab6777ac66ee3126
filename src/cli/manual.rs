//! `scree completions` and `scree man`: what a shell and a manual know of the command line.

use super::arguments::{Arguments, CompletionsOptions, ManOptions};
use super::console;
use super::failure::Failure;
use clap::CommandFactory;
use std::fs;

/// Prints the completions for a shell.
///
/// # Errors
/// Standard output can't be written.
pub(super) fn completions(options: &CompletionsOptions) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(
        options.shell,
        &mut Arguments::command(),
        "scree",
        &mut script,
    );
    let script = String::from_utf8_lossy(&script);
    Ok(console::answer(script.trim_end())?)
}

/// Writes a manual page for each command into a folder.
///
/// # Errors
/// The folder can't be written, or standard output is closed.
pub(super) fn man(options: &ManOptions) -> Result<(), Failure> {
    let folder = &options.folder;
    let written = fs::create_dir_all(folder)
        .and_then(|()| clap_mangen::generate_to(Arguments::command(), folder));
    written.map_err(|error| Failure::path("write", folder, &error))?;
    Ok(console::answer(&format!(
        "{}: manual pages; man -l {}",
        folder.display(),
        folder.join("scree.1").display()
    ))?)
}
