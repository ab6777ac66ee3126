//! The document that asks for an execution.

use super::super::field_errors::FieldError;
use super::super::problem::Problem;
use super::super::scenario_body::read_envelope;
use super::outputs::Output;
use crate::jobs::documents::Scenario;
use crate::jobs::submit::excerpt;
use axum::http::StatusCode;
use serde::Deserialize;
use serde_json::Value;
use serde_json::value::RawValue;
use utoipa::ToSchema;

/// Request for an execution.
#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Execute)]
pub(super) struct ExecuteDocument {
    /// The inputs.
    inputs: InputsDocument,
    /// Outputs of a synchronous answer; all unless given.
    #[serde(default)]
    outputs: OutputsDocument,
    /// Form of a synchronous answer. Unless given: `raw` if exactly one output is asked for.
    response: Option<Form>,
}

/// Inputs of the process.
#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Inputs)]
struct InputsDocument {
    /// The scenario.
    scenario: ScenarioInput,
}

/// A scenario as the value of an input.
#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
struct ScenarioInput {
    /// The bare scenario.
    #[schema(value_type = Scenario)]
    value: Box<RawValue>,
    /// Its media type, `application/json`.
    #[serde(rename = "mediaType")]
    media_type: Option<String>,
}

/// Outputs that are asked for; all if none is named.
#[derive(Debug, Default, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = RequestedOutputs)]
struct OutputsDocument {
    /// The answer in short.
    outcome: Option<ByValue>,
    /// Trajectory of the first body.
    trajectory: Option<ByReference>,
    /// Snapshots of the flow.
    flow: Option<ByReference>,
    /// Picture of the bodies' motion.
    motion: Option<ByReference>,
    /// Picture of flow and bodies from above.
    aerial: Option<ByReference>,
}

/// An output that is given by value.
#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
struct ByValue {
    /// Way in which it is given.
    #[serde(rename = "transmissionMode")]
    #[expect(dead_code, reason = "it can have one value only")]
    transmission_mode: Option<ValueOnly>,
    /// Its format.
    format: Option<OutputFormat>,
}

/// An output that is given by reference.
#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
struct ByReference {
    /// Way in which it is given.
    #[serde(rename = "transmissionMode")]
    #[expect(dead_code, reason = "it can have one value only")]
    transmission_mode: Option<ReferenceOnly>,
    /// Its format.
    format: Option<OutputFormat>,
}

#[derive(Debug, Deserialize, ToSchema)]
#[serde(rename_all = "lowercase")]
enum ValueOnly {
    Value,
}

#[derive(Debug, Deserialize, ToSchema)]
#[serde(rename_all = "lowercase")]
enum ReferenceOnly {
    Reference,
}

/// Format of an output.
#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
struct OutputFormat {
    /// Media type, which is that of the process description.
    #[serde(rename = "mediaType")]
    media_type: Option<String>,
}

/// Form of a synchronous answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, ToSchema)]
#[serde(rename_all = "lowercase")]
#[schema(as = ResponseForm)]
enum Form {
    /// The output itself, or links to it.
    Raw,
    /// A document with all outputs by name.
    Document,
}

/// An execution that is asked for.
#[derive(Debug)]
pub(super) struct ExecuteRequest {
    /// JSON of the scenario.
    pub scenario: String,
    /// Form of a synchronous answer.
    pub answer: AnswerForm,
}

/// Form of a synchronous answer, and its outputs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum AnswerForm {
    /// A document of these.
    Document(Vec<Output>),
    /// The bare outcome.
    RawOutcome,
    /// Links to these alone.
    RawReferences(Vec<Output>),
}

/// JSON pointer to the scenario in the request.
pub(super) const SCENARIO: &str = "/inputs/scenario/value";

impl ExecuteRequest {
    /// Reads a request.
    pub(super) fn read(text: &str) -> Result<Self, Problem> {
        const KIND: (&str, &str) = ("invalid-execute-request", "Invalid execute request");
        let document: ExecuteDocument = read_envelope(text, KIND)?;
        let scenario = document.inputs.scenario;
        check_media_type(
            "/inputs/scenario/mediaType",
            scenario.media_type.as_deref(),
            Output::Outcome.media_type(),
        )?;
        let outputs = document.outputs.named()?;
        Ok(Self {
            scenario: scenario.value.get().to_owned(),
            answer: form(document.response, outputs)?,
        })
    }
}

impl OutputsDocument {
    /// Outputs that are named.
    fn named(&self) -> Result<Vec<Output>, Problem> {
        let by_reference = [
            (Output::Trajectory, &self.trajectory),
            (Output::Flow, &self.flow),
            (Output::Motion, &self.motion),
            (Output::Aerial, &self.aerial),
        ];
        let by_reference = by_reference.into_iter().filter_map(|(output, asked)| {
            let asked = asked.as_ref()?;
            Some((output, asked.format.as_ref()))
        });
        let outcome = self.outcome.iter();
        let by_value = outcome.map(|asked| (Output::Outcome, asked.format.as_ref()));
        let mut outputs = Vec::new();
        for (output, format) in by_value.chain(by_reference) {
            let asked = format.and_then(|format| format.media_type.as_deref());
            let at = format!("/outputs/{}/format/mediaType", output.word());
            check_media_type(&at, asked, output.media_type())?;
            outputs.push(output);
        }
        Ok(outputs)
    }
}

fn form(asked: Option<Form>, outputs: Vec<Output>) -> Result<AnswerForm, Problem> {
    let form = asked.unwrap_or(match outputs.as_slice() {
        [_] => Form::Raw,
        _ => Form::Document,
    });
    match (form, outputs.as_slice()) {
        (Form::Document, []) => Ok(AnswerForm::Document(Output::ALL.to_vec())),
        (Form::Document, _) => Ok(AnswerForm::Document(outputs)),
        (Form::Raw, [Output::Outcome]) => Ok(AnswerForm::RawOutcome),
        (Form::Raw, [_, ..]) if !outputs.contains(&Output::Outcome) => {
            Ok(AnswerForm::RawReferences(outputs))
        }
        (Form::Raw, _) => Err(refused(
            "/response",
            "raw",
            "document, or raw with outputs of which none but the only one is the outcome",
        )),
    }
}

fn check_media_type(at: &str, asked: Option<&str>, own: &str) -> Result<(), Problem> {
    match asked {
        Some(asked) if asked != own => Err(refused(at, asked, own)),
        _ => Ok(()),
    }
}

fn refused(at: &str, value: &str, allowed: &str) -> Problem {
    let fault = FieldError::of_body(at, Value::from(excerpt(value)), allowed);
    Problem {
        detail: fault.detail.clone(),
        errors: vec![fault],
        ..Problem::new(
            StatusCode::UNPROCESSABLE_ENTITY,
            "invalid-execute-request",
            "Invalid execute request",
            "",
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn read(rest: &Value) -> Result<AnswerForm, Problem> {
        let mut request = json!({"inputs": {"scenario": {"value": {"title": "a"}}}});
        let rest = rest.as_object().unwrap().clone();
        request.as_object_mut().unwrap().extend(rest);
        let request = ExecuteRequest::read(&request.to_string())?;
        assert_eq!(request.scenario, r#"{"title":"a"}"#);
        Ok(request.answer)
    }

    #[test]
    fn one_output_comes_raw_and_several_in_a_document() {
        use Output::{Aerial, Flow, Outcome};
        let all = AnswerForm::Document(Output::ALL.to_vec());
        assert_eq!(read(&json!({})), Ok(all.clone()));
        assert_eq!(read(&json!({"outputs": {}})), Ok(all));
        let one = json!({"outputs": {"outcome": {"transmissionMode": "value"}}});
        assert_eq!(read(&one), Ok(AnswerForm::RawOutcome));
        let one = json!({"outputs": {"outcome": {}}, "response": "document"});
        assert_eq!(read(&one), Ok(AnswerForm::Document(vec![Outcome])));
        let links = json!({"outputs": {"flow": {}, "aerial": {}}, "response": "raw"});
        assert_eq!(
            read(&links),
            Ok(AnswerForm::RawReferences(vec![Flow, Aerial]))
        );
    }

    #[test]
    fn what_is_not_offered_is_refused_by_name() {
        let pointer = |rest: Value| read(&rest).unwrap_err().errors[0].pointer.clone().unwrap();
        assert_eq!(pointer(json!({"response": "raw"})), "/response");
        let mixed = json!({"response": "raw", "outputs": {"outcome": {}, "flow": {}}});
        assert_eq!(pointer(mixed), "/response");
        let format = json!({"outputs": {"flow": {"format": {"mediaType": "text/csv"}}}});
        assert_eq!(pointer(format), "/outputs/flow/format/mediaType");
        for (rest, named) in [
            (
                json!({"outputs": {"outcome": {"transmissionMode": "reference"}}}),
                "`reference`",
            ),
            (
                json!({"outputs": {"flow": {"transmissionMode": "value"}}}),
                "`value`",
            ),
            (json!({"outputs": {"spam": {}}}), "`spam`"),
            (json!({"subscriber": {}}), "`subscriber`"),
            (
                json!({"inputs": {"scenario": {"href": "http://a/"}}}),
                "`href`",
            ),
            (json!({"inputs": {}}), "`scenario`"),
        ] {
            let problem = read(&rest).unwrap_err();
            assert_eq!(problem.status, 422, "{rest}");
            assert!(problem.detail.contains(named), "{rest}: {}", problem.detail);
        }
    }
}
