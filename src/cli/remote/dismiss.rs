//! `scree dismiss`: jobs and studies are stopped.

use super::transport::Transport;
use super::{job, study};
use crate::cli::arguments::DismissOptions;
use crate::cli::console;
use crate::cli::failure::Failure;
use uuid::Uuid;

/// Dismisses jobs and studies, one after the other.
///
/// # Errors
/// One does not exist or has ended; those before it are dismissed.
pub(in crate::cli) fn dismiss(options: &DismissOptions) -> Result<(), Failure> {
    let transport = Transport::open(&options.service)?;
    for id in &options.ids {
        let kind = dismiss_one(&transport, id)?;
        console::answer(&format!("{kind} {id} is dismissed"))?;
    }
    Ok(())
}

/// Kind of what is dismissed now.
fn dismiss_one(transport: &Transport, id: &Uuid) -> Result<&'static str, Failure> {
    for (kind, path) in [("job", job::path(id)), ("study", study::path(id))] {
        if transport.delete_if_there(&path)?.is_some() {
            return Ok(kind);
        }
    }
    Err(job::unknown(transport, id))
}
