//! Verification: cases of known answer, computed and compared with it.
//!
//! Structure: [`cases::ALL`] lists the cases, each a module of its own
//! with problem, answer and tolerance; [`verify`] runs them and collects the
//! [`findings::Findings`] of each. Verdicts follow from error and tolerance alone. [`robustness`]
//! has the scenes chosen to break the computation; no answer is
//! known for them, but the result has to be valid.

pub mod cases;
pub mod findings;
pub mod limit;
pub mod order;
pub mod robustness;
pub mod run;
pub mod work;

mod beads;
mod before_after;
mod blocks;
mod columns;
mod dice;
mod drawn;
mod on_all_cores;
mod paper;
mod plates;
mod scenes;
mod slope;
mod stream;
mod with_error_bars;

use findings::{Count, Findings};
use serde::{Serialize, Serializer};

/// Amount of computation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Effort {
    /// Small versions, seconds each.
    Quick,
    /// More resolutions, and finer ones.
    Full,
}

impl Effort {
    /// The first `quick` elements, or all of them: coarse ones come first.
    fn take<T>(self, all: &[T], quick: usize) -> &[T] {
        match self {
            Self::Quick => &all[..quick],
            Self::Full => all,
        }
    }
}

/// A case of known answer.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Case {
    /// Name on the command line.
    pub name: &'static str,
    /// Its number in the list of cases.
    pub number: &'static str,
    /// Title in one line.
    pub title: &'static str,
    /// Source of the answer.
    pub source: &'static str,
    /// Method of computation.
    #[serde(rename = "not_yet_expressible", serialize_with = "reason")]
    pub how: How,
}

/// Method of computation of a case.
#[derive(Debug, Clone, Copy)]
pub enum How {
    /// Computed by this function.
    Runs(fn(Effort, &mut Findings)),
    /// Not possible yet: the capability that the solver lacks.
    NotYet(&'static str),
}

/// In JSON: the missing capability, or null.
fn reason<S: Serializer>(how: &How, serializer: S) -> Result<S::Ok, S::Error> {
    match how {
        How::Runs(_) => serializer.serialize_none(),
        How::NotYet(why) => serializer.serialize_some(why),
    }
}

/// A case and its findings.
#[derive(Debug, Serialize)]
pub struct Verified {
    /// The case.
    pub case: Case,
    /// Findings.
    pub found: Findings,
}

/// Runs a case.
pub fn verify(case: &Case, effort: Effort) -> Verified {
    let mut found = Findings::default();
    if let How::Runs(run) = case.how {
        run(effort, &mut found);
    }
    Verified { case: *case, found }
}

/// Total of all verdicts.
pub fn count(verified: &[Verified]) -> Count {
    let each = verified.iter().map(|one| one.found.count());
    each.fold(Count::default(), Count::plus)
}
