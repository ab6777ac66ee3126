//! Outcome of a member in short: what its study's answers are made of.

use crate::jobs::job::JobStatus;
use crate::jobs::store::EndedMember;
use scree_solver::record::{BodyOutcome, Outcome};
use scree_studies::{Finished, MemberBody, MemberOutcome};
use serde_json::Value;
use std::collections::BTreeMap;

/// Quantity of a run, or of a body of it, by its name; none of what did not happen.
type Quantity<T> = (&'static str, fn(&T) -> Option<f64>);

const OF_RUN: [Quantity<Outcome>; 5] = [
    ("front_m", |run| run.flow.front_m),
    ("runout_m", |run| run.flow.runout_m),
    ("outflow_mass_kg", |run| Some(run.flow.outflow_mass_kg)),
    ("point_steps", |run| Some(run.cost.point_steps as f64)),
    ("wall_s", |run| Some(run.cost.wall_s)),
];

const OF_BODY: [Quantity<BodyOutcome>; 7] = [
    ("displacement_m", |body| Some(body.displacement_m)),
    ("path_length_m", |body| Some(body.path_length_m)),
    ("peak_speed_m_s", |body| Some(body.peak_speed_m_s)),
    ("peak_speed_time_s", |body| body.peak_speed_time_s),
    ("first_contact_time_s", |body| body.first_contact_time_s),
    ("onset_time_s", |body| body.onset_time_s),
    ("stop_time_s", |body| body.stop_time_s),
];

/// Names of the quantities of the flow and of the whole run that a question may ask for.
pub(super) fn names_of_run() -> Vec<&'static str> {
    OF_RUN.iter().map(|(name, _)| *name).collect()
}

/// Names of the quantities of a body that a question may ask for.
pub(super) fn names_of_body() -> Vec<&'static str> {
    let further = OF_BODY.iter().map(|(name, _)| *name);
    further.chain(MemberBody::OWN_QUANTITIES).collect()
}

/// Outcome of a member whose job has ended.
pub(super) fn of_ended(ended: &EndedMember) -> MemberOutcome {
    match ended.status {
        Some(JobStatus::Successful) => ended.outcome.as_deref().map_or_else(unreadable, of_job),
        Some(JobStatus::Failed) => {
            MemberOutcome::failed(kind(ended.problem.as_deref().unwrap_or_default()))
        }
        Some(JobStatus::Dismissed) => MemberOutcome::failed("dismissed"),
        Some(JobStatus::Accepted | JobStatus::Running) => MemberOutcome::Pending,
        None => MemberOutcome::failed("removed"),
    }
}

/// Outcome of a member from that of its run.
pub fn of_run(outcome: &Outcome) -> MemberOutcome {
    MemberOutcome::Finished(Finished {
        quantities: those_there(&OF_RUN, outcome),
        bodies: outcome.bodies.iter().map(of_body).collect(),
    })
}

fn of_body(body: &BodyOutcome) -> MemberBody {
    MemberBody {
        rest_m: body.final_position_m,
        moving: body.onset_time_s.is_some() && body.stop_time_s.is_none(),
        hit: body.first_contact_time_s.is_some(),
        buried_m: body.burial_depth_m,
        quantities: those_there(&OF_BODY, body),
    }
}

fn those_there<T>(quantities: &[Quantity<T>], of: &T) -> BTreeMap<String, f64> {
    let there = quantities
        .iter()
        .filter_map(|(name, value)| Some(((*name).to_owned(), value(of)?)));
    there.collect()
}

fn of_job(outcome: &str) -> MemberOutcome {
    match serde_json::from_str::<Outcome>(outcome) {
        Ok(outcome) => of_run(&outcome),
        Err(_) => unreadable(),
    }
}

/// Kind of a failure: the last part of its type.
fn kind(problem: &str) -> String {
    let problem: Value = serde_json::from_str(problem).unwrap_or_default();
    last_part(problem["type"].as_str().unwrap_or("failed"))
}

/// Last part of the type of a failure, a URN.
pub(super) fn last_part(kind: &str) -> String {
    kind.rsplit(':').next().unwrap_or(kind).to_owned()
}

/// Outcome of a member whose scenario is not allowed.
pub(super) fn not_allowed() -> MemberOutcome {
    MemberOutcome::failed("invalid")
}

fn unreadable() -> MemberOutcome {
    MemberOutcome::failed("unreadable")
}
