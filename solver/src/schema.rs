//! JSON Schema of scenario, plan and outcome, as components of an OpenAPI document. The structs
//! describe themselves; what their types can't say is added here.

use crate::scenario;
pub use crate::scenario::schema::tables;
use std::collections::BTreeMap;
use utoipa::openapi::{RefOr, Schema};

/// Structs of answers. Every key is there, since the solver writes them all.
const ANSWERS: [&str; 19] = [
    "Plan",
    "Choice",
    "Hint",
    "PlannedCost",
    "Stage",
    "Outcome",
    "BodyOutcome",
    "BodyEnergy",
    "MassProperties",
    "FlowOutcome",
    "Conservation",
    "Cost",
    "EndedEarly",
    "UncertaintyInterval",
    "BodyErrorBars",
    "FlowErrorBars",
    "AccuracyReport",
    "RunCost",
    "TargetReport",
];

/// Keys that answers of older versions, stored by a service, lack.
const ADDED_LATER: [(&str, &str); 2] = [("Plan", "hints"), ("EndedEarly", "outflow_bound_kg")];

/// Completes the schemas of the solver's documents: ranges, units and defaults of a scenario's
/// fields, and the keys that an answer always has.
pub fn complete(schemas: &mut BTreeMap<String, RefOr<Schema>>) {
    scenario::schema::complete(schemas);
    for name in ANSWERS {
        if let Some(RefOr::T(Schema::Object(answer))) = schemas.get_mut(name) {
            let always = |key: &&String| !ADDED_LATER.contains(&(name, key.as_str()));
            answer.required = answer.properties.keys().filter(always).cloned().collect();
        }
    }
}
