//! What can be asked on the command line.

use clap::{Args, Parser, Subcommand};
use std::net::SocketAddr;
use std::path::PathBuf;

/// Where does it end up? Simulates objects hit and carried by granular flows.
#[derive(Debug, Parser)]
#[command(version, max_term_width = 100, after_help = EXIT_CODES)]
pub(super) struct Arguments {
    #[command(subcommand)]
    pub(super) command: Command,
}

const EXIT_CODES: &str = "Exit codes: 0 fine, 2 invalid input, 3 numerical failure, 1 other.";

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Start the HTTP service
    Serve(ServeOptions),
    /// Compute one scenario here, without the service
    Run(RunOptions),
    /// Check a scenario and list everything that is wrong with it
    Validate(ValidateOptions),
    /// Send the source paper's scene through a service of its own
    Demo(DemoOptions),
}

#[derive(Debug, Args)]
pub(super) struct ServeOptions {
    /// Address and port to listen on, loopback only; port 0 takes a free one
    /// [default: 127.0.0.1:8080]
    #[arg(long, value_name = "ADDRESS")]
    pub(super) listen: Option<SocketAddr>,
    /// The SQLite file; made if it is not there [default: scree.db]
    #[arg(long, value_name = "FILE")]
    pub(super) database: Option<PathBuf>,
    /// Configuration in TOML; flags and environment win over it
    /// [default: configs/service.toml, if there is one]
    #[arg(long, value_name = "FILE")]
    pub(super) config: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(super) struct RunOptions {
    /// The scenario, a JSON file; - reads standard input
    #[arg(value_name = "SCENARIO.json")]
    pub(super) scenario: PathBuf,
    /// Write outcome, trajectories and pictures into this directory
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// Print the outcome as JSON, and nothing else, on standard output
    #[arg(long)]
    pub(super) json: bool,
    /// Solver threads [default: the scenario's, else all cores]; results do not
    /// depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(super) threads: Option<u16>,
}

#[derive(Debug, Args)]
pub(super) struct ValidateOptions {
    /// The scenario, a JSON file; - reads standard input
    #[arg(value_name = "SCENARIO.json")]
    pub(super) scenario: PathBuf,
}

#[derive(Debug, Args)]
pub(super) struct DemoOptions {
    /// Where outcome, trajectories and pictures go
    #[arg(long, value_name = "DIR", default_value = "scree-out/demo")]
    pub(super) out: PathBuf,
    /// Another scenario than the source paper's
    #[arg(long, value_name = "SCENARIO.json")]
    pub(super) scenario: Option<PathBuf>,
}
