//! The process: a simulation, described by the contract's own schemas.

use super::links::{Base, Link, relation};
use super::oas30;
use super::outputs::Output;
use serde::Serialize;
use serde_json::value::{RawValue, to_raw_value};
use serde_json::{Value, json};
use std::sync::Arc;
use utoipa::ToSchema;
use utoipa::openapi::OpenApi;

/// Name of the process.
pub(super) const ID: &str = "simulation";

/// Descriptions of the process's inputs and outputs, made once.
#[derive(Debug, Clone)]
pub(in crate::http) struct Process {
    inputs: Arc<RawValue>,
    outputs: Arc<RawValue>,
}

impl Process {
    /// The process as this contract describes its documents.
    pub(in crate::http) fn of(contract: &OpenApi) -> Self {
        let contract = serde_json::to_value(contract).unwrap_or_default();
        let components = &contract["components"]["schemas"];
        let inputs = json!({"scenario": {
            "title": "Scenario",
            "description": "Channel, flow, bodies and numerical choices. SI units; x downstream, \
                            y across, z up.",
            "minOccurs": 1,
            "maxOccurs": 1,
            "schema": oas30::component(components, "Scenario"),
        }});
        let outputs = Output::ALL.map(|output| (output.word(), described(output, components)));
        let outputs: serde_json::Map<_, _> = outputs
            .map(|(id, description)| (id.to_owned(), description))
            .into_iter()
            .collect();
        Self {
            inputs: raw(&inputs),
            outputs: raw(&outputs.into()),
        }
    }

    /// Its full description.
    pub(super) fn description(&self, base: &Base) -> DescriptionDocument {
        DescriptionDocument {
            summary: summary(base),
            inputs: (*self.inputs).to_owned(),
            outputs: (*self.outputs).to_owned(),
        }
    }
}

fn described(output: Output, components: &Value) -> Value {
    let schema = match output {
        Output::Outcome => oas30::component(components, "Outcome"),
        Output::Flow => json!({
            "type": "string",
            "format": "binary",
            "contentMediaType": output.media_type(),
        }),
        Output::Trajectory | Output::Motion | Output::Aerial => {
            json!({"type": "string", "contentMediaType": output.media_type()})
        }
    };
    json!({"title": output.title(), "description": output.about(), "schema": schema})
}

fn raw(value: &Value) -> Arc<RawValue> {
    // JSON can always be written as text.
    to_raw_value(value).unwrap_or_default().into()
}

/// Description of a process, in short.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = ProcessSummary)]
pub(super) struct SummaryDocument {
    /// Name of the process.
    id: &'static str,
    /// Version of the process, which is that of the service.
    version: &'static str,
    /// Name for people.
    title: &'static str,
    /// Purpose.
    description: &'static str,
    /// Words to find it by.
    keywords: [&'static str; 4],
    /// Modes in which it may be executed.
    #[serde(rename = "jobControlOptions")]
    job_control_options: [&'static str; 2],
    /// Ways in which outputs are given.
    #[serde(rename = "outputTransmission")]
    output_transmission: [&'static str; 2],
    /// Links to its description and its execution.
    links: Vec<Link>,
}

/// Description of a process.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = ProcessDescription)]
pub(super) struct DescriptionDocument {
    #[serde(flatten)]
    summary: SummaryDocument,
    /// Its inputs by name, each with the schema of its value (OpenAPI 3.0).
    #[schema(value_type = Object)]
    inputs: Box<RawValue>,
    /// Its outputs by name, each with the schema of its value (OpenAPI 3.0).
    #[schema(value_type = Object)]
    outputs: Box<RawValue>,
}

/// The process in short.
pub(super) fn summary(base: &Base) -> SummaryDocument {
    let at = format!("/ogc/processes/{ID}");
    SummaryDocument {
        id: ID,
        version: env!("CARGO_PKG_VERSION"),
        title: "Granular flow and rigid bodies",
        description: "Simulates a granular flow down a channel and the rigid bodies in its way: \
                      when each is hit, how fast it moves, and where it comes to rest.",
        keywords: [
            "granular flow",
            "rigid body",
            "impact",
            "material point method",
        ],
        job_control_options: ["async-execute", "sync-execute"],
        output_transmission: ["value", "reference"],
        links: vec![
            base.json(&at, "self", "Description of the process"),
            base.json(
                format!("{at}/execution"),
                relation::EXECUTE,
                "Execution of the process",
            ),
        ],
    }
}
