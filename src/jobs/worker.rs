//! One worker: claims jobs, runs them, and says how they ended.

use super::campaign;
use super::failure::Failure;
use super::pool::Equipment;
use super::recording::{KeepError, StoreSink};
use super::runner::{RunEnd, RunError, StopFlag};
use super::store::{Claim, Hold, StoreError};
use scree_solver::record::Outcome;
use scree_solver::scenario::Scenario;
use std::panic::{AssertUnwindSafe, catch_unwind};
use tracing::{error, info, info_span};
use uuid::Uuid;

/// How one run ended, as far as the job is concerned.
enum Verdict {
    Successful(Box<Outcome>),
    Failed(Failure),
    /// Stopped from outside: dismissed, or the service stops.
    Stopped,
}

/// Works until the bench is closed.
pub(super) fn work(equipment: &Equipment) {
    while let Some(seen) = equipment.bench.submissions() {
        match equipment
            .runtime
            .block_on(equipment.store.claim(scree_solver::VERSION))
        {
            Ok(Some(claim)) => carry_out(equipment, &claim),
            Ok(None) => equipment.bench.wait(seen),
            Err(error) => {
                error!(%error, "no job can be claimed");
                equipment.bench.wait(seen);
            }
        }
    }
}

fn carry_out(equipment: &Equipment, claim: &Claim) {
    let hold = claim.hold;
    let _span = info_span!("job", id = %hold.job, attempt = hold.attempt).entered();
    // First seated, then looked at: a dismissal that came before finds the row
    // changed below, one that comes after finds the place.
    let place = equipment.bench.seat(hold.job);
    match equipment.runtime.block_on(equipment.store.is_running(hold)) {
        Ok(true) => {}
        Ok(false) => return,
        Err(error) => {
            error!(%error, "the job can't be looked at");
            return;
        }
    }
    info!("started");
    let verdict = shielded(|| run(equipment, claim, &place.stop));
    if let Err(error) = pronounce(equipment, hold, verdict) {
        // The row stays as it is, and the next start of the service finds it.
        error!(%error, "the job's end can't be written");
    }
}

/// Whatever the run does, a panic included, there is a verdict.
fn shielded(run: impl FnOnce() -> Verdict) -> Verdict {
    // Nothing that the run touches is used after a panic but the database,
    // whose transactions are whole or not at all.
    match catch_unwind(AssertUnwindSafe(run)) {
        Ok(verdict) => verdict,
        Err(panic) => broken_off(panic_text(panic.as_ref())),
    }
}

fn run(equipment: &Equipment, claim: &Claim, stop: &StopFlag) -> Verdict {
    let scenario = match Scenario::from_json(&claim.scenario) {
        Ok(scenario) => scenario,
        Err(error) => return broken_off(&error.to_string()),
    };
    let threads = scenario
        .numerics
        .threads
        .unwrap_or(equipment.threads)
        .min(equipment.threads);
    let mut sink = StoreSink::new(
        equipment.store.clone(),
        equipment.runtime.clone(),
        claim.hold,
        equipment.flush_interval,
    );
    let ended = campaign::run(&scenario, threads, stop, &mut sink);
    // What was recorded is kept however the run ended.
    let ended = match (ended, sink.flush()) {
        (Ok(_), Err(error)) => Err(RunError::Sink(error)),
        (ended, _) => ended,
    };
    match ended {
        Ok(RunEnd::Completed(outcome)) => Verdict::Successful(outcome),
        Ok(RunEnd::Stopped) | Err(RunError::Sink(KeepError::Lost)) => Verdict::Stopped,
        Err(RunError::Step(error)) => Verdict::Failed(Failure::numerical(&error)),
        Err(RunError::Setup(error)) => Verdict::Failed(Failure::setup(&error)),
        Err(RunError::Sink(error)) => broken_off(&error.to_string()),
    }
}

/// Writes the verdict. A job that was dismissed meanwhile stays dismissed: each
/// of these changes a running job only.
fn pronounce(equipment: &Equipment, hold: Hold, verdict: Verdict) -> Result<(), StoreError> {
    let store = &equipment.store;
    let runtime = &equipment.runtime;
    match verdict {
        Verdict::Successful(outcome) => match serde_json::to_string(&outcome) {
            Ok(outcome) => {
                info!("successful");
                runtime.block_on(store.succeed(hold, &outcome))?;
            }
            Err(error) => {
                let failure = failure_under_an_id(&error.to_string());
                runtime.block_on(store.fail(hold, &failure))?;
            }
        },
        Verdict::Failed(failure) => {
            info!(detail = failure.detail, "failed");
            runtime.block_on(store.fail(hold, &failure))?;
        }
        Verdict::Stopped => {
            let put_back = runtime.block_on(store.put_back(hold))?;
            info!(put_back, "stopped");
        }
    }
    Ok(())
}

fn broken_off(reason: &str) -> Verdict {
    Verdict::Failed(failure_under_an_id(reason))
}

fn failure_under_an_id(reason: &str) -> Failure {
    let error_id = Uuid::now_v7().to_string();
    error!(error_id, reason, "the run broke off");
    Failure::internal(&error_id)
}

fn panic_text(panic: &(dyn std::any::Any + Send)) -> &str {
    let text = panic.downcast_ref::<&str>().copied();
    text.or_else(|| panic.downcast_ref::<String>().map(String::as_str))
        .unwrap_or("a panic")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_in_a_run_fails_the_job_under_an_id_and_spares_the_worker() {
        let verdict = shielded(|| panic!("the grid is on fire"));
        let Verdict::Failed(failure) = verdict else {
            panic!("not a failure")
        };
        assert_eq!(failure.kind, "urn:scree:failure:internal");
        assert!(failure.numbers["error_id"].is_string());
        assert!(
            !failure.detail.contains("fire"),
            "the details are for the log"
        );
    }

    #[test]
    fn the_text_of_a_panic_is_found() {
        for panic in [
            catch_unwind(|| panic!("plain")).unwrap_err(),
            catch_unwind(|| panic!("{}{}", "pl", "ain")).unwrap_err(),
        ] {
            assert_eq!(panic_text(panic.as_ref()), "plain");
        }
    }
}
