//! Robustness tests: scenes that are there to break the computation. Nobody knows their
//! answers; a run must end finished, or with an error that says when and who, and in
//! either case keep its books ([`trial`]). [`cases::ALL`] lists the families, one file
//! each; [`randomised`] draws scenarios at random from all that is legal.

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
    /// Why it may break the computation.
    pub reason: &'static str,
    /// Its scenes.
    #[serde(skip)]
    pub members: fn(Effort) -> Vec<Member>,
}

/// One of them.
#[derive(Debug)]
pub enum Member {
    /// A scene to be run and looked at.
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

/// Runs a family; with the safety factor of the step if asked for.
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
