//! Robustness tests: scenes chosen to break the computation. Their answers are
//! unknown; a run must finish, or end with an error that gives time and offender, and in
//! either case satisfy the conservation audits ([`trial`]). [`cases::ALL`] lists the families, one
//! file
//! each; [`randomised`] draws scenarios at random from all legal ones.

pub mod cases;
pub mod randomised;
pub mod safety;
pub mod trial;

use super::Effort;
use serde::Serialize;
use trial::{Trial, TrialReport};

/// Scenes of one kind.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Family {
    /// Name on the command line.
    pub name: &'static str,
    /// Reason why it may break the computation.
    pub reason: &'static str,
    /// Scenes of the family.
    #[serde(skip)]
    pub members: fn(Effort) -> Vec<Member>,
}

/// One scene of a family.
#[derive(Debug)]
pub enum Member {
    /// A scene to be run and checked.
    Scene(Box<Trial>),
    /// A comparison of its own.
    Other(&'static str, fn() -> trial::Special),
}

impl Member {
    /// Name within its family.
    pub fn name(&self) -> &str {
        match self {
            Self::Scene(trial) => &trial.name,
            Self::Other(name, _) => name,
        }
    }
}

/// Runs a family, with the safety factor of the step if asked for.
pub fn try_family(family: &Family, effort: Effort, with_safety: bool) -> Vec<TrialReport> {
    let members = (family.members)(effort).into_iter();
    members
        .map(|member| match member {
            Member::Scene(trial) => {
                let mut tried = trial::run(family.name, &trial);
                if with_safety && tried.ended.is_finished() {
                    tried.safety = safety::factor(&trial);
                }
                tried
            }
            Member::Other(name, compare) => trial::compared(family.name, name, compare),
        })
        .collect()
}
