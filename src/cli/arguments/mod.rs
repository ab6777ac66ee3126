//! Arguments of the command line.

use clap::{Args, Parser, Subcommand, ValueEnum};
use scree::verify::robustness::randomised::Field;
use std::net::SocketAddr;
use std::path::PathBuf;

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

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Start the HTTP service
    Serve(ServeOptions),
    /// Copy the service's database, which may be in use, to a file
    Backup(BackupOptions),
    /// Make an access token for the service
    Token(TokenOptions),
    /// Compute one scenario here, without the service
    Run(RunOptions),
    /// Print the computation, the reductions and the cost of a scenario's run
    Plan(PlanOptions),
    /// Check a scenario and list everything that is wrong with it
    Validate(ValidateOptions),
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
    /// SQLite file; created if it does not exist [default: scree.db]
    #[arg(long, value_name = "FILE")]
    pub(super) database: Option<PathBuf>,
    /// Configuration file in TOML; flags and environment variables override it
    /// [default: configs/service.toml, if it exists]
    #[arg(long, value_name = "FILE")]
    pub(super) config: Option<PathBuf>,
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
    /// Database of the service
    #[arg(long, value_name = "FILE", default_value = "scree.db")]
    pub(super) database: PathBuf,
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
    /// Write outcome, trajectories and pictures into this directory; an earlier run's results
    /// stay there until the new ones are whole
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// Continue the run with results in this directory where Ctrl-C, SIGTERM or a crash
    /// interrupted it; results are the same bits as without the interruption
    #[arg(long, value_name = "DIR", conflicts_with_all = ["scenario", "out"])]
    pub(super) resume: Option<PathBuf>,
    /// Print only the outcome, as JSON, on standard output
    #[arg(long)]
    pub(super) json: bool,
    /// Number of solver threads [default: the scenario's, else all cores]; results do not
    /// depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(super) threads: Option<u16>,
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
}

#[derive(Debug, Args)]
pub(super) struct BenchOptions {
    /// Run only this measurement; may be given several times [default: all]
    #[arg(long, value_name = "NAME", value_enum)]
    pub(super) only: Vec<Measurement>,
    /// Measure all 0.15 s of the collapse instead of its start, the channel on
    /// a finer grid and for twice as long, and also ten million points; takes many
    /// minutes instead of two
    #[arg(long)]
    pub(super) full: bool,
    /// Repetitions of every variant, in turn with the variants it is compared with;
    /// medians are reported
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub(super) repeats: u32,
    /// Points of the collapse [default: 200000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1000..=20_000_000))]
    pub(super) points: Option<u32>,
    /// Write pictures of sizes and roofline into this directory
    #[arg(long, value_name = "DIR")]
    pub(super) figures: Option<PathBuf>,
    /// Print one JSON document instead of tables
    #[arg(long)]
    pub(super) json: bool,
}

#[derive(Debug, Args)]
pub(super) struct VerifyOptions {
    /// Cases to run
    #[arg(long, value_name = "NAME", value_enum, default_value = "standard")]
    pub(super) suite: SuiteWord,
    /// Run only this case; may be given several times [default: all of the suite]
    #[arg(long, value_name = "NAME")]
    pub(super) case: Vec<String>,
    /// Number of scenarios of each randomised test
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u64).range(1..=10_000_000))]
    pub(super) count: u64,
    /// Seed of the first scenario of a randomised test; each next scenario takes the next seed
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(super) seed: u64,
    /// Run more and finer resolutions and longer runs, and measure the margin of the robustness
    /// tests' steps against instability; takes ten minutes or more instead of one
    #[arg(long)]
    pub(super) full: bool,
    /// Write diagrams of error against wall time into this directory; needs additional
    /// runs
    #[arg(long, value_name = "DIR")]
    pub(super) figures: Option<PathBuf>,
    /// Replace the tables between the marks in this Markdown file
    #[arg(long, value_name = "FILE")]
    pub(super) markdown: Option<PathBuf>,
    /// Print one JSON document instead of tables
    #[arg(long)]
    pub(super) json: bool,
}

/// Suites of `scree verify`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum SuiteWord {
    /// Cases of known answer
    Standard,
    /// Scenes chosen to break the computation
    #[value(alias = "hard")]
    Robustness,
    /// Scenarios drawn at random from all legal ones
    #[value(alias = "sweep")]
    Randomised,
    /// Bodies without a flow, drawn at random, whose contacts must not create energy
    Bodies,
    /// Standard, robustness, randomised and bodies
    All,
}

impl SuiteWord {
    /// True if a part of the suite is asked for.
    pub(super) fn takes(self, part: Self) -> bool {
        self == part || self == Self::All
    }

    /// Fields from which the scenarios of the randomised tests are drawn.
    pub(super) fn randomised(self) -> &'static [Field] {
        match self {
            Self::Standard | Self::Robustness => &[],
            Self::Randomised => &[Field::Everything],
            Self::Bodies => &[Field::BodiesAlone],
            Self::All => &[Field::Everything, Field::BodiesAlone],
        }
    }
}

/// Measurements of `scree bench`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Measurement {
    /// Collapse of a block of 200,000 points: each precision and instruction set,
    /// on one thread and on all
    S200k,
    /// The collapse at 10,000 to 1,000,000 points (full: to 10,000,000), on one
    /// thread and on all
    Size,
    /// The source paper's channel with and without its cube
    Channel,
    /// The channel with none, 1, 10 and 100 small cubes
    Bodies,
    /// 1, 10 and 100 bodies dropped onto each other
    Heaps,
    /// Shares of the step's stages
    Stages,
    /// The collapse on one thread up to all, with the hash of its final state
    Threads,
    /// Limits of the machine, and the share of them that the collapse reaches
    Roofline,
    /// The source paper's scene with and without each reduction (full: also on finer
    /// grids)
    Plan,
    /// Ten scenes, with their predicted and measured wall times and memory
    Forecast,
}

impl Measurement {
    /// Name on the command line.
    pub(super) fn name(self) -> String {
        let value = self.to_possible_value();
        value.map_or_else(String::new, |value| value.get_name().to_owned())
    }
}
