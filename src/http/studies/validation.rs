//! Validation of a study: its own rules, and those of the scenarios at the ends of its inputs.

use crate::http::access::Caller;
use crate::http::field_errors::{FieldError, FieldErrors};
use crate::http::problem::Problem;
use crate::jobs::JobService;
use crate::jobs::store::StoreError;
use crate::jobs::submit::{ScenarioError, Violation, excerpt};
use crate::studies::questions;
use crate::terrains::ReadError;
use axum::http::StatusCode;
use scree_studies::{End, Ensemble, Study};
use serde_json::Value;
use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Type and title of the problem of a study that is not allowed.
pub(super) const INVALID_STUDY: (&str, &str) = ("invalid-study", "Invalid study");

/// Longest time for which scenarios are checked before others have their turn.
const SLICE: Duration = Duration::from_millis(50);

/// Checks a study in the caller's place in the admission pool: nothing is computed unless both
/// ends of every input are allowed.
///
/// # Errors
/// All violations at once, each with a pointer into the study.
pub(super) async fn validated(
    jobs: &JobService,
    caller: &Caller,
    study: Study,
) -> Result<Study, Problem> {
    let place = jobs.enter(&caller.share())?;
    let checker = jobs.clone();
    let mut checking = place.work(move |_| Checking::new(checker, study)).await?;
    while !checking.is_done() {
        checking = place.work(move |_| checking.slice()).await?;
    }
    checking.finish()
}

/// A study whose scenarios are being checked.
struct Checking {
    jobs: JobService,
    study: Arc<Study>,
    left: std::vec::IntoIter<End>,
    /// Pointers and values of the faults so far.
    seen: BTreeSet<(String, String)>,
    wrong: FieldErrors,
    /// Error of the store, by which a scenario could not be read.
    broken: Option<StoreError>,
}

impl Checking {
    fn new(jobs: JobService, study: Study) -> Self {
        let mut wrong = FieldErrors::default();
        let ends = match Ensemble::of(&study) {
            Ok(ensemble) => {
                for violation in questions::violations(&study) {
                    let document = serde_json::to_value(&study).unwrap_or_default();
                    wrong.add(|| of_study(&document, violation));
                }
                ensemble.ends()
            }
            Err(violations) => {
                let document = serde_json::to_value(&study).unwrap_or_default();
                for violation in violations {
                    wrong.add(|| of_study(&document, violation));
                }
                Vec::new()
            }
        };
        Self {
            jobs,
            study: Arc::new(study),
            left: ends.into_iter(),
            seen: BTreeSet::new(),
            wrong,
            broken: None,
        }
    }

    fn is_done(&self) -> bool {
        self.left.len() == 0
    }

    /// Checks some of the scenarios, at least one.
    fn slice(mut self) -> Self {
        let began = Instant::now();
        let study = Arc::clone(&self.study);
        let Ok(ensemble) = Ensemble::of(&study) else {
            return self;
        };
        while let Some(end) = self.left.next() {
            self.check(&ensemble, &end);
            if began.elapsed() >= SLICE {
                break;
            }
        }
        self
    }

    fn check(&mut self, ensemble: &Ensemble, end: &End) {
        let text = ensemble.end_scenario(end).to_string();
        let violations = match self.jobs.validate(&text, Vec::new()) {
            Ok(_) => return,
            Err(ReadError::Scenario(ScenarioError::Invalid(violations))) => violations,
            Err(ReadError::Store(error)) => {
                self.broken = Some(error);
                return;
            }
            Err(ReadError::Scenario(ScenarioError::Malformed { message, .. })) => {
                let fault = || FieldError::of_body("/scenario", Value::Null, &message);
                return self.wrong.add(fault);
            }
        };
        for violation in violations {
            // The same fault shows at each end of the other inputs.
            let fault = (violation.pointer.clone(), violation.value.to_string());
            if self.seen.insert(fault) {
                self.wrong.add(|| of_end(&self.study, end, violation));
            }
        }
    }

    fn finish(self) -> Result<Study, Problem> {
        if let Some(error) = self.broken {
            return Err(error.into());
        }
        if self.wrong.is_empty() {
            return Ok(Arc::unwrap_or_clone(self.study));
        }
        let status = StatusCode::UNPROCESSABLE_ENTITY;
        let detail = self.wrong.summary();
        Err(Problem {
            errors: self.wrong.into_list(),
            ..Problem::new(status, INVALID_STUDY.0, INVALID_STUDY.1, detail)
        })
    }
}

fn of_study(document: &Value, violation: scree_studies::Violation) -> FieldError {
    FieldError {
        value: document
            .pointer(&violation.pointer)
            .cloned()
            .unwrap_or_default(),
        allowed: violation.allowed().to_owned(),
        pointer: Some(violation.pointer),
        parameter: None,
        unit: None,
        detail: violation.message,
    }
}

/// A violation of the scenario at an end of an input: of an input's distribution if it is about
/// that input's place, else of the study's scenario.
fn of_end(study: &Study, end: &End, violation: Violation) -> FieldError {
    let mut inputs = study.inputs.iter();
    let pointer = match inputs.position(|input| input.pointer == violation.pointer) {
        Some(input) => format!("/inputs/{input}/distribution"),
        None => format!("/scenario{}", violation.pointer),
    };
    let place = &study.inputs[end.input].pointer;
    let value = excerpt(&end.value.to_string());
    let detail = format!("with {place} = {value}: {}", violation.detail);
    FieldError {
        pointer: Some(pointer),
        detail,
        ..FieldError::from(violation)
    }
}
