//! `scree terrain put`: a file is uploaded to a service.

use super::answer::understood;
use super::indented::indented;
use super::maps;
use super::transport::Transport;
use crate::cli::arguments::PutOptions;
use crate::cli::failure::Failure;
use crate::cli::terrain::{in_words, read_file};
use crate::cli::{console, scenario_file};
use scree::terrains::Description;
use serde::Deserialize;

/// Document of a terrain.
#[derive(Deserialize)]
struct Received {
    hash: String,
    bytes: u64,
    #[serde(flatten)]
    description: Description,
}

/// Uploads a file and prints what the service says of it.
///
/// # Errors
/// The file can't be read, the service refuses it or does not answer.
pub(in crate::cli) fn put(options: &PutOptions) -> Result<(), Failure> {
    let file = read_file(&options.file)?;
    let transport = Transport::open(&options.service)?;
    let name = scenario_file::name(&options.file);
    let answer = maps::put(&transport, (&name, &file), options.purpose)?;
    if options.json {
        return Ok(console::answer(&indented(&answer))?);
    }
    let terrain: Received = understood(&answer)?;
    let facts = in_words(&terrain.hash, terrain.bytes, &terrain.description);
    Ok(console::answer(&facts)?)
}
