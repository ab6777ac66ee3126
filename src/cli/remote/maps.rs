//! Maps that a scenario names by their paths, uploaded on the way to a service.

use super::answer::{text, understood};
use super::transport::{Submission, Transport};
use crate::cli::failure::Failure;
use crate::cli::scenario_maps::{files, rename};
use crate::cli::terrain::read_file;
use scree::terrains::{FilePurpose, purpose};
use serde::Deserialize;
use serde_json::Value;
use std::path::Path;

/// Document of a terrain.
#[derive(Deserialize)]
struct Uploaded {
    hash: String,
}

/// Uploads the maps that a scenario names by paths, and names them by their hashes instead.
///
/// # Errors
/// A file can't be read, the service refuses it or does not answer.
pub(super) fn upload(transport: &Transport, scenario: &mut Value) -> Result<(), Failure> {
    for map in files(scenario) {
        let file = read_file(Path::new(&map.name))?;
        let answer = put(transport, (&map.name, &file), purpose(map.of))?;
        let uploaded: Uploaded = understood(&answer)?;
        rename(scenario, &map, uploaded.hash);
    }
    Ok(())
}

/// The scenario of this text with its maps uploaded; a text without maps as it is.
///
/// # Errors
/// As for [`upload`].
pub(super) fn with_uploaded(transport: &Transport, scenario: &str) -> Result<String, Failure> {
    match serde_json::from_str::<Value>(scenario) {
        Ok(mut document) if !files(&document).is_empty() => {
            upload(transport, &mut document)?;
            Ok(document.to_string())
        }
        _ => Ok(scenario.to_owned()),
    }
}

/// Uploads a file; returns the document of its terrain.
///
/// # Errors
/// The service refuses it or does not answer.
pub(super) fn put(
    transport: &Transport,
    (name, file): (&str, &[u8]),
    purpose: FilePurpose,
) -> Result<String, Failure> {
    let path = format!("/v1/terrains?purpose={}", purpose.word());
    let answer = transport.post(&path, Submission::file(file));
    text(answer.map_err(|error| error.about(name))?)
}
