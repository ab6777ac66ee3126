//! One worker: claims jobs, runs them, and records their ends.

use super::failure::Failure;
use super::job_limits::Excess;
use super::packs::Packs;
use super::pool::Equipment;
use super::recording::{KeepError, StoreSink};
use super::running_jobs::RunningJobGuard;
use super::store::{
    AttemptStart, Claim, Claimant, FailedAttempt, Lease, Pack, ResumePoint, Solver, StoreError,
    StoreErrorKind,
};
use crate::runs::convergence_study::Runs;
use crate::runs::{COMMIT, Run, RunControl, RunEnd, RunError, SavedRunError, Sink};
use crate::terrains::ReadError;
use scree_solver::plan::Cost;
use scree_solver::record::Outcome;
use scree_solver::scenario::Scenario;
use scree_solver::simulation::PreparedScene;
use scree_solver::{Instructions, SetupError};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::time::{Duration, Instant};
use tracing::{error, info, info_span, warn};
use uuid::Uuid;

/// Time between two attempts to record the end of a job.
const RETRY_PAUSE: Duration = Duration::from_secs(1);

/// Result of one run for its job.
enum JobResult {
    Successful(Box<Outcome>, String),
    Failed(Failure),
    /// Failed attempt, through no fault of the scenario.
    AttemptFailed(String),
    /// Stopped by request: the job returns to the queue, unless it was dismissed or lost.
    Released,
    /// Lost to another worker: nothing is left to record.
    Gone,
}

/// Works until the registry is closed.
pub(super) fn work(equipment: &Equipment) {
    let mut claimant = Claimant {
        owner: equipment.name.clone(),
        lease_duration: equipment.queue.lease_duration(),
        solver: Solver {
            version: scree_solver::VERSION,
            commit: COMMIT,
            instructions: instructions(),
        },
        up_for: Duration::ZERO,
        pack: Pack::SINGLE,
        memory_bytes: equipment.job_limits.memory_bytes,
    };
    let mut packs = Packs::default();
    if !equipment.registry.wait_until_open() {
        return;
    }
    while !equipment.registry.is_closing() {
        claimant.up_for = equipment.started.elapsed();
        claimant.pack = packs.next();
        match equipment.runtime.block_on(equipment.store.claim(&claimant)) {
            Ok(claims) if claims.is_empty() => equipment.registry.wait(),
            Ok(claims) => {
                // There may be more for another worker.
                equipment.registry.announce();
                execute_all(equipment, &claims, &mut packs);
            }
            Err(error) => {
                error!(%error, "no job can be claimed");
                equipment.registry.wait();
            }
        }
    }
}

fn instructions() -> &'static str {
    match Instructions::detected() {
        Instructions::Baseline => "baseline",
        Instructions::Avx2 => "AVX2",
        Instructions::Avx512 => "AVX-512",
    }
}

/// Executes claimed jobs one after the other.
fn execute_all(equipment: &Equipment, claims: &[Claim], packs: &mut Packs) {
    // Registered before their scenarios are read: a dismissal before this finds the row changed,
    // one after this finds the entry. The leases of all are renewed from now on.
    let registered = claims
        .iter()
        .map(|claim| equipment.registry.register(claim.lease));
    let registered: Vec<_> = registered.collect();
    for (claim, guard) in claims.iter().zip(registered) {
        let began = Instant::now();
        let result = execute(equipment, claim, &guard);
        // Others took no time, or had a part of their work done before.
        if matches!(result, JobResult::Successful(..)) && claim.lease.attempt == 1 {
            packs.note(claim.planned_work, began.elapsed());
        }
    }
}

fn execute(equipment: &Equipment, claim: &Claim, guard: &RunningJobGuard) -> JobResult {
    let lease = claim.lease;
    let _span = info_span!("job", id = %lease.job, attempt = lease.attempt).entered();
    guard.begin();
    info!("started");
    let result = catching_panics(|| run(equipment, claim, guard));
    while let Err(error) = record_result(equipment, lease, &result) {
        error!(%error, "the job's end can't be written now");
        if !equipment.registry.pause(RETRY_PAUSE) {
            // The row stays as it is, and the next start reclaims the job.
            break;
        }
    }
    result
}

/// Returns a result whatever the run does, even if it panics.
fn catching_panics(run: impl FnOnce() -> JobResult) -> JobResult {
    // After a panic only the database is used of all that the run touches,
    // and its transactions are applied whole or not at all.
    match catch_unwind(AssertUnwindSafe(run)) {
        Ok(result) => result,
        Err(panic) => internal_failure(panic_text(panic.as_ref())),
    }
}

fn run(equipment: &Equipment, claim: &Claim, guard: &RunningJobGuard) -> JobResult {
    let scenario = match equipment.reader.read(&claim.scenario) {
        Ok(scenario) => scenario,
        Err(ReadError::Scenario(error)) => return internal_failure(&error.to_string()),
        // The job goes on once the store can be read.
        Err(ReadError::Store(_)) => return JobResult::Released,
    };
    let control = &*guard.run.control;
    let most = scenario.numerics.threads.unwrap_or(equipment.threads);
    control.limit_threads(most.min(equipment.threads));
    let mut sink = StoreSink::new(
        (Arc::clone(&equipment.store), equipment.runtime.clone()),
        guard.run.clone(),
        (equipment.recording.clone(), equipment.job_limits.clone()),
        Arc::clone(&equipment.memory),
    );
    if claim.failed_attempts > 0 {
        sink.save_early();
    }
    if control.is_raised() {
        return JobResult::Released;
    }
    let ended = run_to_end(equipment, claim.lease, &scenario, (control, &mut sink));
    // Records are kept however the run ended.
    let ended = match (ended, sink.finish(|| control.is_raised())) {
        (Ok(_), Err(error)) => Err(RunError::Sink(error)),
        (ended, _) => ended,
    };
    match ended {
        Ok(RunEnd::Completed(outcome)) => JobResult::Successful(outcome, sink.fingerprint().hex()),
        Ok(RunEnd::Stopped) => JobResult::Released,
        Err(error) => result_of_error(&error),
    }
}

/// Executes the run, or the several runs that intervals or a target need.
fn run_to_end(
    equipment: &Equipment,
    lease: Lease,
    scenario: &Scenario,
    (control, sink): (&RunControl, &mut StoreSink),
) -> Result<RunEnd, RunError<KeepError>> {
    let memory_bytes = Cost::of(&PreparedScene::of(scenario)?).memory_bytes;
    sink.before_set_up(memory_bytes).map_err(RunError::Sink)?;
    let what = (scenario, control.threads().unwrap_or(1));
    if scenario.accuracy.takes_several_runs() {
        let ways: Ways<Runs> = (Runs::restored, Runs::afresh);
        return set_up((equipment, control), lease, what, sink, ways)?.go(control, sink);
    }
    let ways: Ways<Run> = (Run::restored, Run::afresh);
    set_up((equipment, control), lease, what, sink, ways)?.go(control, sink)
}

/// Functions that make a run from its saved state, and at its start.
type Ways<T> = (
    fn(&Scenario, usize, &[u8]) -> Result<T, SavedRunError>,
    fn(&Scenario, usize) -> Result<T, SetupError>,
);

/// Result of an operation of the store, which is repeated while the database is away, until the job is
/// to stop: neither its saved state nor the attempt is given up for that.
fn patiently<T, F: Future<Output = Result<T, StoreError>>>(
    (equipment, control): (&Equipment, &RunControl),
    operation: impl Fn() -> F,
) -> Result<T, KeepError> {
    loop {
        let error = match equipment.runtime.block_on(operation()) {
            Ok(result) => return Ok(result),
            Err(error) => error,
        };
        match error.kind() {
            StoreErrorKind::Damaged | StoreErrorKind::Defect => return Err(error.into()),
            StoreErrorKind::Full | StoreErrorKind::Unavailable => {
                warn!(%error, "the job waits for the database");
            }
        }
        if control.is_raised() || !equipment.registry.pause(RETRY_PAUSE) {
            return Err(KeepError::Stopped);
        }
    }
}

/// Records the start of the attempt.
fn begin(
    (equipment, control): (&Equipment, &RunControl),
    lease: Lease,
    beginning: &AttemptStart,
    threads: usize,
) -> Result<(), RunError<KeepError>> {
    let begun = patiently((equipment, control), || {
        equipment.store.begin(lease, beginning, threads)
    });
    match begun {
        Ok(true) => Ok(()),
        Ok(false) => Err(RunError::Sink(KeepError::Lost)),
        Err(error) => Err(RunError::Sink(error)),
    }
}

/// The run restored from its saved state, or else at its start.
fn set_up<T>(
    (equipment, control): (&Equipment, &RunControl),
    lease: Lease,
    (scenario, threads): (&Scenario, usize),
    sink: &mut StoreSink,
    (restore, afresh): Ways<T>,
) -> Result<T, RunError<KeepError>> {
    let from = |state: &[u8]| restore(scenario, threads, state);
    let restored = restored((equipment, control), lease, from).map_err(RunError::Sink)?;
    let equipment = (equipment, control);
    if let Some((run, resume_point)) = restored {
        begin(equipment, lease, &AttemptStart::At(resume_point), threads)?;
        match sink.go_on_from(&resume_point, scenario.bodies.len()) {
            Ok(()) => {
                info!(time_s = resume_point.time_s, "goes on from its saved state");
                return Ok(run);
            }
            Err(KeepError::Missing) => warn!("the saved state lacks its samples"),
            Err(error) => return Err(RunError::Sink(error)),
        }
    }
    begin(equipment, lease, &AttemptStart::Afresh, threads)?;
    sink.start_afresh();
    Ok(afresh(scenario, threads)?)
}

/// The run restored from its saved state. If the state can't be used, the reason
/// is logged and the run starts over.
fn restored<T>(
    (equipment, control): (&Equipment, &RunControl),
    lease: Lease,
    from: impl Fn(&[u8]) -> Result<T, SavedRunError>,
) -> Result<Option<(T, ResumePoint)>, KeepError> {
    let stored = match patiently((equipment, control), || equipment.store.state(lease.job)) {
        Ok(Some(stored)) => stored,
        Ok(None) => return Ok(None),
        Err(KeepError::Store(error)) => {
            warn!(%error, "the saved state can't be read");
            return Ok(None);
        }
        Err(error) => return Err(error),
    };
    let run = match stored.unpack() {
        Ok(state) => from(&state).map_err(|error| error.to_string()),
        Err(error) => Err(error.to_string()),
    };
    Ok(match run {
        Ok(run) => Some((run, stored.resume_point)),
        Err(reason) => {
            warn!(reason, "the saved state can't be used");
            None
        }
    })
}

fn result_of_error(error: &RunError<KeepError>) -> JobResult {
    match error {
        RunError::Step(error) => JobResult::Failed(Failure::numerical(error)),
        RunError::Setup(
            error @ (SetupError::TooManyPoints { .. } | SetupError::NotReducible { .. }),
        ) => JobResult::Failed(Failure::setup(error)),
        RunError::Setup(error @ SetupError::Threads { .. }) => {
            JobResult::AttemptFailed(error.to_string())
        }
        RunError::Sink(KeepError::Lost) => JobResult::Gone,
        RunError::Sink(KeepError::Stopped) => JobResult::Released,
        // Of the machine at this moment, not of the scenario.
        RunError::Sink(KeepError::Excess(excess @ Excess::NoMemory { .. })) => {
            JobResult::AttemptFailed(excess.to_string())
        }
        RunError::Sink(KeepError::Excess(excess)) => JobResult::Failed(Failure::excess(excess)),
        RunError::Sink(error) => JobResult::AttemptFailed(error.to_string()),
    }
}

/// Records the result. A job dismissed meanwhile stays dismissed: each
/// of these calls changes only a running job.
fn record_result(
    equipment: &Equipment,
    lease: Lease,
    result: &JobResult,
) -> Result<(), StoreError> {
    let store = &equipment.store;
    let runtime = &equipment.runtime;
    match result {
        JobResult::Successful(outcome, fingerprint) => match serde_json::to_string(outcome) {
            Ok(outcome) => {
                runtime.block_on(store.succeed(lease, &outcome, fingerprint))?;
                info!("successful");
            }
            Err(error) => {
                let failure = failure_under_an_id(&error.to_string());
                runtime.block_on(store.fail(lease, &failure))?;
            }
        },
        JobResult::Failed(failure) => {
            runtime.block_on(store.fail(lease, failure))?;
            info!(detail = failure.detail, "failed");
        }
        JobResult::AttemptFailed(reason) => {
            let failed_attempt = FailedAttempt::Infrastructure(reason.clone());
            let returned = runtime.block_on(store.fail_attempt(lease, &failed_attempt))?;
            warn!(reason, ?returned, "set back");
        }
        JobResult::Released => {
            let released = runtime.block_on(store.release(lease))?;
            info!(released, "stopped");
        }
        JobResult::Gone => info!("stopped"),
    }
    Ok(())
}

fn internal_failure(reason: &str) -> JobResult {
    JobResult::Failed(failure_under_an_id(reason))
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
        let result = catching_panics(|| panic!("the grid is on fire"));
        let JobResult::Failed(failure) = result else {
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
