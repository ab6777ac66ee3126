//! Check of the questions of a study: that the bodies and quantities they ask for exist.

use super::outcome::{names_of_body, names_of_run};
use scree_studies::{Question, Study, Violation};

/// Questions, and an accuracy, about bodies and quantities that no outcome has.
pub fn violations(study: &Study) -> Vec<Violation> {
    let questions = study.questions.iter().enumerate();
    let asked = questions.map(|(place, question)| {
        let (key, body, quantity) = asked(question);
        (format!("/questions/{place}/{key}"), body, quantity)
    });
    let accuracy = study.accuracy.iter().map(|accuracy| {
        let quantity = Some(accuracy.quantity.as_str());
        ("/accuracy".to_owned(), accuracy.body, quantity)
    });
    let found = asked.chain(accuracy).filter_map(|(at, body, quantity)| {
        let body_there = body.and_then(|body| no_body(study, &at, body));
        body_there.or_else(|| no_quantity(&at, body, quantity?))
    });
    found.collect()
}

/// Name of the question, and the body and quantity that it asks for.
fn asked(question: &Question) -> (&'static str, Option<usize>, Option<&str>) {
    match question {
        Question::Rest(rest) => ("rest", Some(rest.body), None),
        Question::Buried(buried) => ("buried", Some(buried.body), None),
        Question::Exceeds(asked) => ("exceeds", asked.body, Some(&asked.quantity)),
        Question::Mean(asked) => ("mean", asked.body, Some(&asked.quantity)),
        Question::Quantiles(asked) => ("quantiles", asked.body, Some(&asked.quantity)),
        Question::Sensitivity(asked) => ("sensitivity", asked.body, Some(&asked.quantity)),
    }
}

fn no_body(study: &Study, at: &str, body: usize) -> Option<Violation> {
    // An input that makes the list of bodies decides how many there are.
    if study.inputs.iter().any(|input| input.pointer == "/bodies") {
        return None;
    }
    let bodies = study.scenario["bodies"].as_array().map_or(0, Vec::len);
    let allowed = match bodies {
        0 => "no body, as the scenario has none".to_owned(),
        bodies => format!("0 <= x < {bodies}, the bodies of the scenario"),
    };
    (body >= bodies).then(|| Violation::of(&format!("{at}/body"), body, allowed))
}

fn no_quantity(at: &str, body: Option<usize>, quantity: &str) -> Option<Violation> {
    let (of, known) = match body {
        Some(_) => ("a body", names_of_body()),
        None => ("the flow (others need body)", names_of_run()),
    };
    let allowed = format!("one of {of}: {}", known.join(", "));
    let pointer = format!("{at}/quantity");
    (!known.contains(&quantity)).then(|| Violation::of(&pointer, format!("{quantity:?}"), allowed))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Value, json};

    fn pointers(questions: &Value) -> Vec<String> {
        let study: Study = serde_json::from_value(json!({
            "scenario": {"bodies": [{}]},
            "inputs": [{"pointer": "/x", "distribution": {"uniform": {"from": 0.0, "to": 1.0}}}],
            "design": {"sobol": {"members": 2, "seed": 1}},
            "questions": questions,
        }))
        .unwrap();
        let found = violations(&study);
        found
            .into_iter()
            .map(|violation| violation.pointer)
            .collect()
    }

    #[test]
    fn what_no_outcome_has_is_told_by_its_pointer() {
        let wrong = json!([
            {"rest": {"body": 1, "regions": [0.5]}},
            {"quantiles": {"quantity": "displacement_m", "probabilities": [0.5]}},
            {"sensitivity": {"quantity": "displacment_m", "body": 0}},
        ]);
        let expected = [
            "/questions/0/rest/body",
            "/questions/1/quantiles/quantity",
            "/questions/2/sensitivity/quantity",
        ];
        assert_eq!(pointers(&wrong), expected);
        let right = json!([
            {"buried": {"body": 0, "deeper_than_m": 0.0}},
            {"quantiles": {"quantity": "runout_m", "probabilities": [0.5]}},
            {"exceeds": {"quantity": "rest_x_m", "body": 0, "thresholds": [0.5]}},
        ]);
        assert!(pointers(&right).is_empty());
    }
}
