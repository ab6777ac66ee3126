//! Mathematics of studies: a scenario run many times with uncertain inputs.
//!
//! A [`Study`] names the inputs, their distributions and the design of the members. Its
//! [`Ensemble`] gives each member's inputs and scenario. From the members' outcomes,
//! [`Answers`] says where a body comes to rest and with what probability, and which inputs
//! matter. With several levels of cell size, members of coarse cells are corrected by those that are
//! computed with finer ones, too, and [`NextStep`] says what an accuracy asked for still needs.
//!
//! ```
//! use scree_studies::{Answers, Ensemble, Finished, Member, MemberOutcome, Study};
//!
//! let study: Study = serde_json::from_value(serde_json::json!({
//!     "scenario": {"channel": {"base_friction": 0.4}},
//!     "inputs": [{"pointer": "/channel/base_friction",
//!                 "distribution": {"uniform": {"from": 0.3, "to": 0.45}}}],
//!     "design": {"sobol": {"members": 64, "seed": 1}},
//!     "questions": [{"exceeds": {"quantity": "runout_m", "thresholds": [1.0]}}]
//! }))?;
//! let ensemble = Ensemble::of(&study).expect("a study without violations");
//! let run = |index| {
//!     let scenario = ensemble.scenario(index)?;
//!     let friction = scenario["channel"]["base_friction"].as_f64().unwrap_or(0.0);
//!     let quantities = [("runout_m".to_owned(), 0.4 / friction)].into();
//!     let outcome = MemberOutcome::Finished(Finished { quantities, bodies: Vec::new() });
//!     Ok(Member::coarsest(index, outcome))
//! };
//! let members = (0..ensemble.members()).map(run).collect::<Result<Vec<_>, Box<dyn std::error::Error>>>()?;
//! let answers = Answers::of(&ensemble, &members);
//! assert_eq!(answers.members.finished, 64);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Nothing here reads a file, a clock or a random device. Elementary functions are those of
//! `libm`, so equal studies have equal bits on any machine.

pub mod answers;
mod correlation;
mod design;
mod distribution;
mod moments;
mod multilevel;
mod normal;
mod outcome;
mod random;
mod study;

pub use answers::Answers;
pub use correlation::{Copula, Correlation, NotPositiveDefinite};
pub use design::{
    Design, Explicit, FullFactorial, LatinHypercube, LevelCounts, Morris, OneAtATime, Point,
    Saltelli, Sobol,
};
pub use distribution::{
    Choice, Distribution, Interval, List, Lognormal, Normal, SMALLEST_PROBABILITY, Triangular,
    Uniform, WeightedValue,
};
pub use multilevel::{Forecast, ForecastLevel, Needed, NextStep};
pub use outcome::{FailedMember, Finished, Member, MemberBody, MemberOutcome};
pub use study::{
    Accuracy, Buried, End, EndScenario, Ensemble, Exceeds, FinerLevel, Input, Mean, MemberId,
    NoSuchMember, Progress, Quantiles, Question, Rest, Sensitivity, Stop, Study, Verdict,
    Violation,
};

/// Confidence of every interval in the answers.
pub const CONFIDENCE: f64 = 0.95;
