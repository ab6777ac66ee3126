//! Arguments of the commands that use a service elsewhere.

use super::{Quiet, format};
use clap::{Args, ValueEnum};
use scree::results::table::Format;
use std::path::PathBuf;
use std::time::Duration;
use uuid::Uuid;

/// Time for which requests are repeated, if none is given [s].
const PATIENCE_S: u32 = 300;

/// Place of the service, and the right to use it.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "Service")]
pub(in crate::cli) struct ServiceOptions {
    /// Address of the service [default: the environment's SCREE_URL, else `url` of the client file]
    #[arg(long, value_name = "URL")]
    pub(in crate::cli) url: Option<String>,
    /// File with the access token, which only its owner may read [default: the environment's
    /// SCREE_TOKEN, else `token` of the client file]
    #[arg(long, value_name = "FILE", conflicts_with = "token")]
    pub(in crate::cli) token_file: Option<PathBuf>,
    /// The access token itself. All users of this machine can see it in the list of processes, and
    /// shells keep it in their history: prefer SCREE_TOKEN, --token-file or the client file
    #[arg(long, value_name = "TOKEN")]
    pub(in crate::cli) token: Option<String>,
    /// TOML file with `url` and `token` [default: ~/.config/scree/client.toml, or in
    /// $XDG_CONFIG_HOME instead of ~/.config]
    #[arg(long, value_name = "FILE")]
    pub(in crate::cli) client_file: Option<PathBuf>,
    /// Longest time for which a request is repeated while the service does not answer or has no
    /// room [default: 300]
    #[arg(long, value_name = "SECONDS")]
    patience: Option<u32>,
}

impl ServiceOptions {
    /// True if one of them is given.
    pub(in crate::cli) fn are_given(&self) -> bool {
        let texts = self.url.is_some() || self.token.is_some();
        let files = self.token_file.is_some() || self.client_file.is_some();
        texts || files || self.patience.is_some()
    }

    /// Longest time for which a request is repeated.
    pub(in crate::cli) fn patience(&self) -> Duration {
        Duration::from_secs(self.patience.unwrap_or(PATIENCE_S).into())
    }
}

#[derive(Debug, Args)]
pub(in crate::cli) struct SubmitOptions {
    /// Scenarios, JSON files, each of which becomes a job; - reads standard input
    #[arg(value_name = "SCENARIO.json", required = true)]
    pub(in crate::cli) scenarios: Vec<PathBuf>,
    /// Label of the jobs, by which they can be listed; may be given several times
    #[arg(long, value_name = "TEXT")]
    pub(in crate::cli) label: Vec<String>,
    /// Wait for the end of the jobs; the exit code is then that of `scree run`, of several
    /// unsuccessful jobs that of the last
    #[arg(long)]
    pub(in crate::cli) wait: bool,
    /// Print each job's document, as JSON on a line of its own, instead of its identifier
    #[arg(long)]
    pub(in crate::cli) json: bool,
    #[command(flatten)]
    pub(in crate::cli) quiet: Quiet,
    #[command(flatten)]
    pub(in crate::cli) service: ServiceOptions,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct WatchOptions {
    /// Job or study
    #[arg(value_name = "ID")]
    pub(in crate::cli) id: Uuid,
    /// Print the final document, as JSON, on standard output
    #[arg(long)]
    pub(in crate::cli) json: bool,
    #[command(flatten)]
    pub(in crate::cli) quiet: Quiet,
    #[command(flatten)]
    pub(in crate::cli) service: ServiceOptions,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct GetOptions {
    /// Job or study; without it, the newest jobs are listed
    #[arg(value_name = "ID")]
    pub(in crate::cli) id: Option<Uuid>,
    /// Write the results of a job that has ended, or the answers of a study so far, into this
    /// directory, in the files of `scree run` and `scree study`
    #[arg(long, value_name = "DIR", requires = "id")]
    pub(in crate::cli) out: Option<PathBuf>,
    /// Format of the trajectories in the directory; may be given several times, or as a list
    /// [default: json]
    #[arg(long, value_name = "FORMAT", requires = "out", value_delimiter = ',', value_parser = format::parser())]
    pub(in crate::cli) format: Vec<Format>,
    /// Print only the document, as JSON, on standard output
    #[arg(long)]
    pub(in crate::cli) json: bool,
    /// List only jobs of this state; may be given several times, or as a list
    #[arg(
        long,
        value_name = "STATE",
        value_enum,
        value_delimiter = ',',
        conflicts_with = "id"
    )]
    pub(in crate::cli) status: Vec<StatusWord>,
    /// List only jobs with this label
    #[arg(long, value_name = "TEXT", conflicts_with = "id")]
    pub(in crate::cli) label: Option<String>,
    /// Most jobs to list [default: 20]
    #[arg(long, value_name = "N", conflicts_with = "id", value_parser = clap::value_parser!(u32).range(1..=100))]
    pub(in crate::cli) limit: Option<u32>,
    #[command(flatten)]
    pub(in crate::cli) service: ServiceOptions,
}

/// States of a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum StatusWord {
    /// Waits for a worker
    Accepted,
    /// Is computed
    Running,
    /// Was computed to the end
    Successful,
    /// Ended without an answer
    Failed,
    /// Was dismissed by a client
    Dismissed,
}

impl StatusWord {
    /// Name over HTTP.
    pub(in crate::cli) fn word(self) -> String {
        let value = self.to_possible_value();
        value.map_or_else(String::new, |value| value.get_name().to_owned())
    }
}

#[derive(Debug, Args)]
pub(in crate::cli) struct DismissOptions {
    /// Jobs or studies; what was computed until then is kept
    #[arg(value_name = "ID", required = true)]
    pub(in crate::cli) ids: Vec<Uuid>,
    #[command(flatten)]
    pub(in crate::cli) service: ServiceOptions,
}
