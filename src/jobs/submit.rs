//! Validation of submitted scenarios.

use super::job::JobId;
use crate::terrains::{ReadError, ScenarioReader, TerrainHash, terrains_of};
use scree_solver::accuracy::ConvergenceStudy;
use scree_solver::plan::Cost;
use scree_solver::record::Role;
use scree_solver::scenario::Scenario;
pub use scree_solver::scenario::{ScenarioError, Violation, excerpt};
use scree_solver::simulation::PreparedScene;
use scree_solver::{Plan, SetupError};
use serde_json::{Value, json};

/// A job that may enter the queue.
#[derive(Debug, Clone, PartialEq)]
pub struct NewJob {
    /// Its identifier.
    pub id: JobId,
    /// The scenario's title.
    pub title: String,
    /// Number of bodies in the scenario.
    pub bodies: usize,
    /// The scenario's JSON with every default filled in.
    pub scenario: String,
    /// BLAKE3 of that JSON, in hexadecimal digits.
    pub scenario_hash: String,
    /// The JSON of its plan: computation, reductions and cost.
    pub plan: String,
    /// Work that the plan foresees, of all runs of the job [point-steps].
    pub planned_work: u64,
    /// Memory that the plan foresees, of the largest run [bytes].
    pub planned_memory_bytes: u64,
    /// Its labels, each once.
    pub labels: Vec<String>,
    /// Terrains that its scenario names.
    pub terrains: Vec<TerrainHash>,
    /// Version of the solver that validated it.
    pub solver_version: &'static str,
}

/// Largest number of labels in a list.
pub const LABELS_AT_MOST: usize = 16;

/// The text as a label: 1 to 64 letters, digits or any of `. _ : = / -`.
pub fn label(text: &str) -> Option<String> {
    let legal = |byte: u8| byte.is_ascii_alphanumeric() || b"._:=/-".contains(&byte);
    let is_legal = (1..=64).contains(&text.len()) && text.bytes().all(legal);
    is_legal.then(|| text.to_owned())
}

/// Resources of a service for a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Means {
    /// Solver threads of a worker.
    pub threads_per_worker: usize,
    /// Largest number of point-steps that a job may be planned to take.
    pub point_steps: Option<u64>,
    /// Largest memory that a job may be planned to need [bytes].
    pub memory_bytes: u64,
}

/// Validates a scenario for a service with these resources, and plans its run. Blocks.
///
/// # Errors
/// All rules that the scenario breaks; or the store's own.
pub fn validate(
    text: &str,
    (means, reader): (&Means, &ScenarioReader),
    mut labels: Vec<String>,
) -> Result<NewJob, ReadError> {
    let AffordableJob { scene, plan, cost } = read_affordable(text, (means, reader))?;
    let scenario = scene.scenario;
    let json = serde_json::to_string(&scenario).map_err(|error| unwritable(&error))?;
    labels.sort();
    labels.dedup();
    Ok(NewJob {
        id: JobId::new(),
        title: scenario.title,
        bodies: scenario.bodies.len(),
        scenario_hash: blake3::hash(json.as_bytes()).to_hex().to_string(),
        terrains: terrains_of(&json),
        scenario: json,
        plan: serde_json::to_string(&plan).map_err(|error| unwritable(&error))?,
        planned_work: cost.point_steps,
        planned_memory_bytes: cost.memory_bytes,
        labels,
        solver_version: scree_solver::VERSION,
    })
}

/// A job that resources allow.
pub struct AffordableJob {
    /// The scene of the answer's run.
    pub scene: PreparedScene,
    /// Plan of that run.
    pub plan: Plan,
    /// Cost of all runs.
    pub cost: JobCost,
}

/// Reads a scenario whose run these resources allow, and plans it. Blocks.
///
/// # Errors
/// All rules that the scenario breaks; or the store's own.
pub fn read_affordable(
    text: &str,
    (means, reader): (&Means, &ScenarioReader),
) -> Result<AffordableJob, ReadError> {
    let prepared = read(text, reader, means.threads_per_worker)?;
    let plan = Plan::of(&prepared);
    let job = JobCost::of(&prepared.scenario, &plan.cost)?;
    let excesses = [
        too_costly(job.point_steps, means.point_steps),
        too_large(job.memory_bytes, means.memory_bytes),
    ];
    let excesses: Vec<Violation> = excesses.into_iter().flatten().collect();
    if excesses.is_empty() {
        Ok(AffordableJob {
            scene: prepared,
            plan,
            cost: job,
        })
    } else {
        Err(ScenarioError::Invalid(excesses).into())
    }
}

/// Cost of all runs of a job: that of the answer and those behind its uncertainty intervals.
#[derive(Debug, Clone, Copy)]
pub struct JobCost {
    /// Sum over the runs, bodies' sub-steps included.
    pub point_steps: u64,
    /// Largest of a run [bytes].
    pub memory_bytes: u64,
}

impl JobCost {
    fn of(scenario: &Scenario, answer: &Cost) -> Result<Self, ScenarioError> {
        let mut job = Self {
            point_steps: answer.work(),
            memory_bytes: answer.memory_bytes,
        };
        let accuracy = &scenario.accuracy;
        if !accuracy.takes_several_runs() {
            return Ok(job);
        }
        let study = ConvergenceStudy::of(scenario).map_err(|error| refused(&error))?;
        for study_run in study.to_do().filter(|run| run.role != Role::Answer) {
            let scenario = study.scenario_of(study_run);
            let prepared = PreparedScene::of(&scenario).map_err(|error| refused(&error))?;
            let cost = Cost::of(&prepared);
            job.point_steps = job.point_steps.saturating_add(cost.work());
            job.memory_bytes = job.memory_bytes.max(cost.memory_bytes);
        }
        if accuracy.target.is_some() {
            // The cells are not known yet; the budget is.
            job.point_steps = job.point_steps.max(accuracy.budget_point_steps as u64);
        }
        Ok(job)
    }
}

/// A run behind the intervals that can't be set up.
fn refused(error: &SetupError) -> ScenarioError {
    match not_set_up(error) {
        Some(violation) => ScenarioError::Invalid(vec![violation]),
        None => unwritable(error),
    }
}

/// Reads a scenario for a service whose workers have `threads_per_worker` solver
/// threads.
fn read(
    text: &str,
    reader: &ScenarioReader,
    threads_per_worker: usize,
) -> Result<PreparedScene, ReadError> {
    match reader.read(text) {
        Ok(scenario) => {
            let threads = too_many_threads(scenario.numerics.threads, threads_per_worker);
            let prepared = PreparedScene::of(&scenario);
            match (prepared, threads) {
                (Ok(prepared), None) => Ok(prepared),
                (prepared, threads) => {
                    let setup = prepared.err().and_then(|error| not_set_up(&error));
                    let violations = setup.into_iter().chain(threads).collect();
                    Err(ScenarioError::Invalid(violations).into())
                }
            }
        }
        Err(ReadError::Scenario(ScenarioError::Invalid(mut violations))) => {
            violations.extend(too_many_threads(
                threads_asked_for(text),
                threads_per_worker,
            ));
            Err(ScenarioError::Invalid(violations).into())
        }
        Err(other) => Err(other),
    }
}

/// A flow too large for any run, or a reduction that the scene does not allow, is
/// refused at submission, not when the job's turn has come.
fn not_set_up(error: &SetupError) -> Option<Violation> {
    let detail = error.to_string();
    match error {
        SetupError::TooManyPoints {
            limit, cell_size_m, ..
        } => Some(Violation {
            pointer: "/numerics/cell_size_m".to_owned(),
            value: json!(cell_size_m),
            allowed: format!("cells that lead to at most {limit} material points"),
            unit: Some("m".to_owned()),
            detail,
        }),
        SetupError::NotReducible { key, word, .. } => Some(Violation {
            pointer: format!("/numerics/{key}"),
            value: json!(word),
            allowed: "\"auto\" or \"full\" in this scene".to_owned(),
            unit: None,
            detail,
        }),
        SetupError::Threads { .. } => None,
    }
}

/// The threads that an otherwise illegal scenario asks for, so that all faults
/// are reported at once.
fn threads_asked_for(text: &str) -> Option<usize> {
    let document: Value = serde_json::from_str(text).ok()?;
    let threads = document.pointer(THREADS)?.as_u64()?;
    usize::try_from(threads).ok()
}

/// A legal scenario that can't be serialised or planned.
fn unwritable(error: &impl ToString) -> ScenarioError {
    ScenarioError::Malformed {
        message: error.to_string(),
        line: 0,
        column: 0,
    }
}

/// A run that would take longer than this service allows for a job.
fn too_costly(planned: u64, most: Option<u64>) -> Option<Violation> {
    let most = most.filter(|&most| planned > most)?;
    Some(Violation {
        pointer: String::new(),
        value: json!(planned),
        allowed: format!("runs of at most {most} planned point-steps"),
        unit: Some("point-steps".to_owned()),
        detail: format!(
            "the job is planned to take {planned} point-steps (points times sub-steps of all its \
             runs; a sub-step of a body in contact counts as 40), and limits.job_point_steps of \
             this service is {most}: coarser cells (numerics.cell_size_m), softer bodies \
             (contact_modulus_pa) or a shorter duration_s take fewer"
        ),
    })
}

/// A run that would need more memory than this service allows for a job.
fn too_large(planned: u64, most: u64) -> Option<Violation> {
    (planned > most).then(|| Violation {
        pointer: "/numerics/cell_size_m".to_owned(),
        value: json!(planned),
        allowed: format!("cells with which a run is planned to need at most {most} bytes"),
        unit: Some("bytes".to_owned()),
        detail: format!(
            "a run of the job is planned to need {planned} bytes of memory, and \
             limits.job_memory_bytes of this service is {most}: larger cells \
             (numerics.cell_size_m) need less"
        ),
    })
}

const THREADS: &str = "/numerics/threads";

fn too_many_threads(asked: Option<usize>, threads_per_worker: usize) -> Option<Violation> {
    let asked = asked.filter(|&asked| asked > threads_per_worker)?;
    Some(Violation {
        pointer: THREADS.to_owned(),
        value: json!(asked),
        allowed: format!("1 <= x <= {threads_per_worker}"),
        unit: None,
        detail: format!(
            "the scenario asks for {asked} threads, but a worker of this service has \
             {threads_per_worker}"
        ),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_are_short_and_plain() {
        for legal in ["a", "study:alps/2024-05=b_1.2", &"x".repeat(64)] {
            assert_eq!(label(legal).as_deref(), Some(legal));
        }
        for illegal in ["", " ", "a b", "é", "a,b", &"x".repeat(65)] {
            assert_eq!(label(illegal), None, "{illegal}");
        }
    }

    #[test]
    fn a_run_beyond_the_cost_limit_is_refused_with_its_numbers() {
        let violation = too_costly(11, Some(10)).unwrap();
        assert_eq!(violation.value, json!(11));
        assert!(violation.allowed.contains("10") && violation.detail.contains("job_point_steps"));
        assert_eq!(violation.unit.as_deref(), Some("point-steps"));
        assert_eq!(too_costly(10, Some(10)), None);
        assert_eq!(too_costly(u64::MAX, None), None);
    }

    #[test]
    fn threads_beyond_a_worker_are_refused_by_their_pointer() {
        let violation = too_many_threads(Some(3), 2).unwrap();
        assert_eq!(violation.pointer, "/numerics/threads");
        assert_eq!(violation.value, json!(3));
        assert_eq!(violation.allowed, "1 <= x <= 2");
        assert_eq!(too_many_threads(Some(2), 2), None);
        assert_eq!(too_many_threads(None, 2), None);
    }
}
