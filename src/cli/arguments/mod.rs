//! Arguments of the command line.

mod format;
mod measuring;
mod quiet;
mod remote;
mod terrain;

use clap::{Args, Parser, Subcommand, ValueEnum};
use jiff::SignedDuration;
pub(super) use measuring::{BenchOptions, Measurement, SuiteWord, VerifyOptions};
pub(super) use quiet::Quiet;
pub(super) use remote::{DismissOptions, GetOptions, ServiceOptions, SubmitOptions, WatchOptions};
use scree::config::Database;
use scree::results::table::Format;
use std::net::SocketAddr;
use std::path::PathBuf;
use std::time::Duration;
pub(super) use terrain::{CheckOptions, PutOptions, TerrainCommand, TerrainOptions};

/// Simulates objects that are hit and carried by granular flows, and reports where they end up.
#[derive(Debug, Parser)]
#[command(version = VERSION, max_term_width = 100, after_help = EXIT_CODES)]
pub(super) struct Arguments {
    #[command(subcommand)]
    pub(super) command: Command,
}

/// Version, and the commit it was built from.
const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), " (", env!("BUILD_COMMIT"), ")");

const EXIT_CODES: &str = "Exit codes: 0 fine, 2 invalid input, 3 numerical failure, 4 a case failed, 130 Ctrl-C, \
     143 SIGTERM, 1 other.";

const STUDY_BY_A_SERVICE: &str = "With any of the options of the service, the service computes the study. Ctrl-C then ends this \
     command alone: the study goes on.";

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Start the HTTP service
    Serve(ServeOptions),
    /// Start workers alone, for a PostgreSQL database that services and other workers share
    Work(WorkOptions),
    /// Copy the service's database, which may be in use, to a file
    Backup(BackupOptions),
    /// Make an access token for the service
    Token(TokenOptions),
    /// Compute one scenario here, without the service
    Run(RunOptions),
    /// Compute a study, here or by a service: one scenario many times, with uncertain inputs
    Study(StudyOptions),
    /// Submit scenarios to a service, as jobs
    Submit(SubmitOptions),
    /// Follow a job or study of a service until it ends
    Watch(WatchOptions),
    /// Fetch the outcome and results of a job, or the answers of a study; or list jobs
    Get(GetOptions),
    /// Stop jobs or studies of a service
    Dismiss(DismissOptions),
    /// Print the computation, the reductions and the cost of a scenario's run
    Plan(PlanOptions),
    /// Check a scenario and list everything that is wrong with it
    Validate(ValidateOptions),
    /// Check the raster of a terrain, or upload it to a service
    Terrain(TerrainOptions),
    /// Send the source paper's scene through a service of its own
    Demo(DemoOptions),
    /// Measure how fast the solver is on this machine
    Bench(BenchOptions),
    /// Compare the solver with cases of known answer
    Verify(VerifyOptions),
    /// Print completions for a shell
    Completions(CompletionsOptions),
    /// Write manual pages into a folder
    Man(ManOptions),
}

#[derive(Debug, Args)]
pub(super) struct ServeOptions {
    /// Address and port to listen on; port 0 selects a free port; an address beyond
    /// loopback needs access tokens
    /// [default: 127.0.0.1:8080]
    #[arg(long, value_name = "ADDRESS")]
    pub(super) listen: Option<SocketAddr>,
    /// SQLite file, created if it does not exist, or URL of a PostgreSQL database, which several
    /// services and workers can share (SCREE_DATABASE says it without showing a password to others
    /// on this machine) [default: scree.db]
    #[arg(long, value_name = "FILE|URL")]
    pub(super) database: Option<Database>,
    /// Number of jobs that run at the same time; 0 leaves them to worker processes
    /// [default: all cores]
    #[arg(long, value_name = "N")]
    pub(super) workers: Option<u16>,
    /// Configuration file in TOML; flags and environment variables override it
    /// [default: configs/service.toml, if it exists]
    #[arg(long, value_name = "FILE")]
    pub(super) config: Option<PathBuf>,
    /// Stop once standard input ends, so that the service ends with the program that
    /// started it, however that ends
    #[arg(long)]
    pub(super) until_stdin_ends: bool,
}

#[derive(Debug, Args)]
pub(super) struct WorkOptions {
    /// URL of the PostgreSQL database (SCREE_DATABASE says it without showing a password to others
    /// on this machine)
    #[arg(long, value_name = "URL")]
    pub(super) database: Option<Database>,
    /// Number of threads; as many jobs run at the same time, and share them if they are fewer
    /// [default: all cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(super) threads: Option<u16>,
    /// Leave once no job waits or runs, here or elsewhere, and no study runs
    #[arg(long)]
    pub(super) until_empty: bool,
    /// Leave after this time; running jobs are saved and go on elsewhere
    #[arg(long, value_name = "TIME", value_parser = time)]
    pub(super) max_time: Option<Duration>,
    /// Time to save running jobs before the process leaves [default: 20s]
    #[arg(long, value_name = "TIME", value_parser = time)]
    pub(super) grace: Option<Duration>,
    /// Configuration file in TOML; flags and environment variables override it
    /// [default: configs/service.toml, if it exists]
    #[arg(long, value_name = "FILE")]
    pub(super) config: Option<PathBuf>,
}

/// A time like 90s, 30m, 1h or 1h30m.
fn time(text: &str) -> Result<Duration, String> {
    let parsed: Result<SignedDuration, _> = text.parse();
    let time = parsed.ok().and_then(|time| Duration::try_from(time).ok());
    let time = time.filter(|time| !time.is_zero());
    time.ok_or_else(|| "a time is written like 90s, 30m, 1h or 1h30m".to_owned())
}

#[derive(Debug, Args)]
pub(super) struct CompletionsOptions {
    /// The shell
    #[arg(value_name = "SHELL")]
    pub(super) shell: clap_complete::Shell,
}

#[derive(Debug, Args)]
pub(super) struct ManOptions {
    /// Folder of the pages; made if it does not exist
    #[arg(value_name = "FOLDER")]
    pub(super) folder: PathBuf,
}

#[derive(Debug, Args)]
pub(super) struct BackupOptions {
    /// Database of the service, a file
    #[arg(long, value_name = "FILE", default_value = "scree.db")]
    pub(super) database: Database,
    /// File to write
    #[arg(value_name = "DEST")]
    pub(super) destination: PathBuf,
    /// Replace the destination if it exists
    #[arg(long)]
    pub(super) replace: bool,
}

#[derive(Debug, Args)]
pub(super) struct TokenOptions {
    /// Name of the holder; jobs are stored under this name
    pub(super) name: String,
    /// Scope of the token; may be given several times
    #[arg(long, value_name = "SCOPE", value_enum, required = true)]
    pub(super) scope: Vec<ScopeWord>,
    /// Largest number of its jobs that may wait or run [default: limit of the queue]
    #[arg(long, value_name = "N")]
    pub(super) active_jobs: Option<u32>,
}

/// Scopes of a token.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum ScopeWord {
    /// Submit jobs; dismiss and remove one's own jobs
    Submit,
    /// Read jobs and results
    Read,
    /// Dismiss and remove jobs of any holder
    Admin,
}

#[derive(Debug, Args)]
pub(super) struct RunOptions {
    /// Scenario, a JSON file; - reads standard input
    #[arg(value_name = "SCENARIO.json", required_unless_present = "resume")]
    pub(super) scenario: Option<PathBuf>,
    /// Write outcome, trajectories, pictures, the plan and the scenario with its defaults into
    /// this directory; an earlier run's results stay there until the new ones are whole
    #[arg(long, value_name = "DIR", group = "directory")]
    pub(super) out: Option<PathBuf>,
    /// Continue the run with results in this directory where Ctrl-C, SIGTERM or a crash
    /// interrupted it; results are the same bits as without the interruption
    #[arg(long, value_name = "DIR", group = "directory", conflicts_with_all = ["scenario", "out"])]
    pub(super) resume: Option<PathBuf>,
    /// Format of the trajectories in the directory; may be given several times, or as a list
    /// [default: json, or those that an interrupted run was begun with]
    #[arg(long, value_name = "FORMAT", requires = "directory", value_delimiter = ',', value_parser = format::parser())]
    pub(super) format: Vec<Format>,
    /// Print only the outcome, as JSON, on standard output
    #[arg(long)]
    pub(super) json: bool,
    /// Number of solver threads [default: the scenario's, else all cores]; results do not
    /// depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(super) threads: Option<u16>,
    #[command(flatten)]
    pub(super) quiet: Quiet,
}

#[derive(Debug, Args)]
#[command(after_help = STUDY_BY_A_SERVICE)]
pub(super) struct StudyOptions {
    /// Study, a JSON file; - reads standard input
    #[arg(value_name = "STUDY.json")]
    pub(super) study: PathBuf,
    /// Write answers, members, regions and pictures into this directory; members that are there
    /// already from the same study, also a smaller one, are not computed again
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// Print only the answers, as JSON, on standard output
    #[arg(long)]
    pub(super) json: bool,
    /// Number of members computed at a time, each on one thread [default: all cores]; answers do
    /// not depend on it
    #[arg(
        long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024),
        conflicts_with_all = ["url", "token_file", "token", "client_file", "patience"],
    )]
    pub(super) threads: Option<u16>,
    #[command(flatten)]
    pub(super) quiet: Quiet,
    #[command(flatten)]
    pub(super) service: ServiceOptions,
}

#[derive(Debug, Args)]
pub(super) struct PlanOptions {
    /// Scenario, a JSON file; - reads standard input
    #[arg(value_name = "SCENARIO.json")]
    pub(super) scenario: PathBuf,
    /// Print only the plan, as JSON, on standard output
    #[arg(long)]
    pub(super) json: bool,
    /// Number of solver threads [default: the scenario's, else all cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(super) threads: Option<u16>,
}

#[derive(Debug, Args)]
pub(super) struct ValidateOptions {
    /// Scenario, a JSON file; - reads standard input
    #[arg(value_name = "SCENARIO.json")]
    pub(super) scenario: PathBuf,
}

#[derive(Debug, Args)]
pub(super) struct DemoOptions {
    /// Directory for outcome, trajectories and pictures
    #[arg(long, value_name = "DIR", default_value = "scree-out/demo")]
    pub(super) out: PathBuf,
    /// Scenario to compute instead of the source paper's
    #[arg(long, value_name = "SCENARIO.json")]
    pub(super) scenario: Option<PathBuf>,
    #[command(flatten)]
    pub(super) quiet: Quiet,
}
