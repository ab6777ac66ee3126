//! `scree backup`: a consistent copy of the service's database.

use super::arguments::BackupOptions;
use super::console;
use super::failure::Failure;
use scree::service::{self, BackupError};

/// Copies the database, and prints size and number of jobs of the copy.
///
/// # Errors
/// The database can't be read, or the copy can't be written.
pub(super) fn backup(options: &BackupOptions) -> Result<(), Failure> {
    let BackupOptions {
        database,
        destination,
        replace,
    } = options;
    let runtime = tokio::runtime::Runtime::new()?;
    let made = runtime
        .block_on(service::back_up(database, destination, *replace))
        .map_err(|error| not_made(&error))?;
    Ok(console::answer(&format!(
        "{}: {} jobs, {} bytes, checked",
        destination.display(),
        made.jobs,
        made.bytes
    ))?)
}

/// Failure of a backup, by the person who can act on it.
fn not_made(error: &BackupError) -> Failure {
    match error {
        BackupError::OnServer
        | BackupError::Missing(_)
        | BackupError::Exists(_)
        | BackupError::Itself(_)
        | BackupError::Destination { .. } => Failure::Input(error.to_string()),
        BackupError::LogMissing(_) | BackupError::Unsound(_) | BackupError::Store(_) => {
            Failure::Other(error.to_string())
        }
    }
}
