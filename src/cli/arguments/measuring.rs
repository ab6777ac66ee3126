//! Arguments of the commands that measure and verify.

use super::Quiet;
use clap::{Args, ValueEnum};
use scree::verify::robustness::randomised::Field;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(in crate::cli) struct BenchOptions {
    /// Run only this measurement; may be given several times [default: all]
    #[arg(long, value_name = "NAME", value_enum)]
    pub(in crate::cli) only: Vec<Measurement>,
    /// Measure all 0.15 s of the collapse instead of its start, the channel on
    /// a finer grid and for twice as long, and also ten million points; takes many
    /// minutes instead of two
    #[arg(long)]
    pub(in crate::cli) full: bool,
    /// Repetitions of every variant, in turn with the variants it is compared with;
    /// medians are reported
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub(in crate::cli) repeats: u32,
    /// Points of the collapse [default: 200000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1000..=20_000_000))]
    pub(in crate::cli) points: Option<u32>,
    /// Write pictures of sizes and roofline into this directory
    #[arg(long, value_name = "DIR")]
    pub(in crate::cli) figures: Option<PathBuf>,
    /// Print one JSON document instead of tables
    #[arg(long)]
    pub(in crate::cli) json: bool,
    #[command(flatten)]
    pub(in crate::cli) quiet: Quiet,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct VerifyOptions {
    /// Cases to run
    #[arg(long, value_name = "NAME", value_enum, default_value = "standard")]
    pub(in crate::cli) suite: SuiteWord,
    /// Run only this case; may be given several times [default: all of the suite]
    #[arg(long, value_name = "NAME")]
    pub(in crate::cli) case: Vec<String>,
    /// Number of scenarios of each randomised test
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u64).range(1..=10_000_000))]
    pub(in crate::cli) count: u64,
    /// Seed of the first scenario of a randomised test; each next scenario takes the next seed
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(in crate::cli) seed: u64,
    /// Run more and finer resolutions and longer runs, and measure the margin of the robustness
    /// tests' steps against instability; takes ten minutes or more instead of one
    #[arg(long)]
    pub(in crate::cli) full: bool,
    /// Write diagrams of error against wall time into this directory; needs additional
    /// runs
    #[arg(long, value_name = "DIR")]
    pub(in crate::cli) figures: Option<PathBuf>,
    /// Replace the tables between the marks in this Markdown file
    #[arg(long, value_name = "FILE")]
    pub(in crate::cli) markdown: Option<PathBuf>,
    /// Print one JSON document instead of tables
    #[arg(long)]
    pub(in crate::cli) json: bool,
    #[command(flatten)]
    pub(in crate::cli) quiet: Quiet,
}

/// Suites of `scree verify`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum SuiteWord {
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
    pub(in crate::cli) fn takes(self, part: Self) -> bool {
        self == part || self == Self::All
    }

    /// Fields from which the scenarios of the randomised tests are drawn.
    pub(in crate::cli) fn randomised(self) -> &'static [Field] {
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
pub(in crate::cli) enum Measurement {
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
    /// The same scenes, with the remaining wall time that each run told as it went on
    Progress,
}

impl Measurement {
    /// Name on the command line.
    pub(in crate::cli) fn name(self) -> String {
        let value = self.to_possible_value();
        value.map_or_else(String::new, |value| value.get_name().to_owned())
    }
}
