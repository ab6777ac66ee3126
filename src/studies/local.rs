//! Members of a study computed in this process, without the service.

use super::members::scenario;
use super::outcome;
use crate::jobs::failure::Failure;
use crate::runs::convergence_study::Runs;
use crate::runs::{NoSink, RunControl, RunEnd, RunError};
use scree_solver::scenario::{Maps, Scenario};
use scree_studies::{Ensemble, Member, MemberId, MemberOutcome};
use serde_json::Value;
use std::convert::Infallible;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;

/// Computes these members on these maps, several at a time on one thread each, and hands over each as
/// it ends, in any order; `control` can stop it, and members that had not ended by then are not handed over.
/// A member and its outcome depend on the study, its level and its number alone.
pub fn compute(
    (ensemble, maps): (&Ensemble, &Maps),
    ids: &[MemberId],
    (at_once, control): (usize, &RunControl),
    mut ended: impl FnMut(Member),
) {
    let next = AtomicUsize::new(0);
    let (sender, receiver) = mpsc::channel();
    std::thread::scope(|scope| {
        for _ in 0..at_once.clamp(1, ids.len().max(1)) {
            let sender = sender.clone();
            scope.spawn(|| {
                let sender = sender;
                work((ensemble, maps), ids, (&next, control), &sender);
            });
        }
        drop(sender);
        for member in receiver {
            ended(member);
        }
    });
}

fn work(
    (ensemble, maps): (&Ensemble, &Maps),
    ids: &[MemberId],
    (next, control): (&AtomicUsize, &RunControl),
    sender: &mpsc::Sender<Member>,
) {
    while let Some(&id) = ids.get(next.fetch_add(1, Ordering::Relaxed)) {
        let outcome = scenario(ensemble, id).map_or_else(
            |error| MemberOutcome::failed(error.to_string()),
            |one| run(&one, maps, control),
        );
        // A member without an outcome was stopped; without a receiver nobody asks any more.
        if outcome == MemberOutcome::Pending || sender.send(Member::new(id, outcome)).is_err() {
            return;
        }
    }
}

/// Outcome of the run of a scenario; pending if it was stopped.
fn run(scenario: &Value, maps: &Maps, control: &RunControl) -> MemberOutcome {
    let Ok(scenario) = Scenario::from_value_with(scenario, maps) else {
        return outcome::not_allowed();
    };
    let ended = Runs::afresh(&scenario, 1)
        .map_err(RunError::Setup)
        .and_then(|runs| runs.go(control, &mut NoSink));
    match ended {
        Ok(RunEnd::Completed(outcome)) => outcome::of_run(&outcome),
        Ok(RunEnd::Stopped) => MemberOutcome::Pending,
        Err(error) => MemberOutcome::failed(kind(&error)),
    }
}

/// Kind of failure, as a job of the service has it.
fn kind(error: &RunError<Infallible>) -> String {
    let failure = match error {
        RunError::Setup(error) => Failure::setup(error),
        RunError::Step(error) => Failure::numerical(error),
        RunError::Sink(never) => match *never {},
    };
    outcome::last_part(&failure.kind)
}
