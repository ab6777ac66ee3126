//! Reasons for the failure of a command.

use super::console::{self, OutputError};
use super::files::FileError;
use super::signals::Signal;
use scree::jobs::forecast::ForecastError;
use scree::pictures::PictureError;
use scree::studies::export::ExportError;
use scree_solver::SetupError;
use std::fmt::Display;
use std::io;
use std::path::Path;
use std::process::ExitCode;
use thiserror::Error;

/// Failure of a command, by the person who can act on it.
#[derive(Debug, Error)]
pub(super) enum Failure {
    /// Invalid arguments, files or scenario: the user.
    #[error("{0}")]
    Input(String),
    /// Failure of the computation: an expert of the method.
    #[error("{0}")]
    Numerical(String),
    /// Number of cases that failed their tolerance: an expert of the method.
    #[error("{0} failed")]
    Missed(usize),
    /// A run stopped by a signal, and what became of it: whoever sent the signal.
    #[error("stopped by {0}{1}")]
    Stopped(Signal, String),
    /// Any other failure: the operator of the machine.
    #[error("{0}")]
    Other(String),
}

impl Failure {
    /// An external failure, and its message.
    pub(super) fn other(what: &str, why: impl Display) -> Self {
        Self::Other(format!("{what}: {why}"))
    }

    /// A file or directory named on the command line that can't be used. A full disk is none
    /// of the command line's faults.
    pub(super) fn path(doing: &str, path: &Path, why: &io::Error) -> Self {
        let text = format!("cannot {doing} {}: {why}", path.display());
        match why.kind() {
            io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => Self::Other(text),
            _ => Self::Input(text),
        }
    }

    /// The same failure, said of one thing among several.
    pub(super) fn of(self, what: &str) -> Self {
        self.reworded(|text| format!("{what}: {text}"))
    }

    /// The same failure, with more to say about it.
    pub(super) fn and(self, more: &str) -> Self {
        self.reworded(|text| format!("{text}{more}"))
    }

    fn reworded(self, reword: impl FnOnce(String) -> String) -> Self {
        match self {
            Self::Input(text) => Self::Input(reword(text)),
            Self::Numerical(text) => Self::Numerical(reword(text)),
            Self::Other(text) => Self::Other(reword(text)),
            same @ (Self::Missed(_) | Self::Stopped(..)) => same,
        }
    }

    /// Reports the failure on standard error and returns the exit code of the process.
    pub(super) fn report(&self) -> ExitCode {
        match self {
            // What was asked for is no error.
            Self::Stopped(..) => console::note(&self.to_string()),
            error => console::note(&format!("error: {error}")),
        }
        ExitCode::from(self.exit_code())
    }

    /// Exit code: 2 invalid input, 3 numerical failure, 4 a failed case, 130 Ctrl-C,
    /// 143 SIGTERM, 1 other.
    pub(super) fn exit_code(&self) -> u8 {
        match self {
            Self::Other(_) => 1,
            Self::Input(_) => 2,
            Self::Numerical(_) => 3,
            Self::Missed(_) => 4,
            Self::Stopped(signal, _) => signal.exit_code(),
        }
    }
}

impl From<ForecastError> for Failure {
    fn from(error: ForecastError) -> Self {
        match error {
            ForecastError::Setup(error) => not_set_up(&error),
            ForecastError::Step(error) => Self::Numerical(error.to_string()),
            error @ ForecastError::Cancelled => Self::Other(error.to_string()),
        }
    }
}

impl From<FileError> for Failure {
    fn from(error: FileError) -> Self {
        Self::Other(error.to_string())
    }
}

impl From<OutputError> for Failure {
    fn from(error: OutputError) -> Self {
        Self::Other(error.to_string())
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Self::other("input or output failed", error)
    }
}

impl From<serde_json::Error> for Failure {
    fn from(error: serde_json::Error) -> Self {
        Self::other("the results can't be written as JSON", error)
    }
}

impl From<PictureError> for Failure {
    fn from(error: PictureError) -> Self {
        Self::Other(error.to_string())
    }
}

impl From<ExportError> for Failure {
    fn from(error: ExportError) -> Self {
        Self::Other(error.to_string())
    }
}

/// Failure of a legal scenario that can't be set up: one that is too large is invalid input.
pub(super) fn not_set_up(error: &SetupError) -> Failure {
    match error {
        SetupError::TooManyPoints { .. } | SetupError::NotReducible { .. } => {
            Failure::Input(error.to_string())
        }
        SetupError::Threads { .. } => Failure::Other(error.to_string()),
    }
}
