//! Limits on the sizes of a study: its check and its answers take a bounded time.

use super::{Input, Question, Study, Violation};
use crate::design::Design;
use crate::distribution::Distribution;

/// Most inputs; Saltelli takes two of 256 dimensions for each.
const INPUTS: usize = 100;
const _: () = assert!(2 * INPUTS <= sobol_burley::NUM_DIMENSIONS as usize);
/// Most values of a choice or a list.
const VALUES: usize = 1_000;
/// Most members of an explicit design.
const EXPLICIT_MEMBERS: usize = 10_000;
/// Most questions.
const QUESTIONS: usize = 32;
/// Most probabilities or thresholds of a question.
const NUMBERS: usize = 100;

/// What is too large in a study; nothing else is looked at then.
pub(super) fn violations(study: &Study) -> Vec<Violation> {
    let mut found = Vec::new();
    found.extend(too_many("/inputs", study.inputs.len(), INPUTS));
    found.extend(too_many("/questions", study.questions.len(), QUESTIONS));
    if let Design::Explicit(explicit) = &study.design {
        let (place, count) = ("/design/explicit/members", explicit.members.len());
        found.extend(too_many(place, count, EXPLICIT_MEMBERS));
    }
    if found.is_empty() {
        let inputs = study.inputs.iter().enumerate();
        found.extend(inputs.filter_map(|(place, input)| values(place, input)));
        let questions = study.questions.iter().enumerate();
        found.extend(questions.filter_map(|(place, question)| numbers(place, question)));
    }
    found
}

fn values(place: usize, input: &Input) -> Option<Violation> {
    let (kind, count) = match input.distribution.as_ref()? {
        Distribution::Choice(choice) => ("choice", choice.values.len()),
        Distribution::List(list) => ("list", list.values.len()),
        _ => return None,
    };
    let pointer = format!("/inputs/{place}/distribution/{kind}/values");
    too_many(&pointer, count, VALUES)
}

fn numbers(place: usize, question: &Question) -> Option<Violation> {
    let (pointer, count) = match question {
        Question::Rest(rest) => ("rest/regions", rest.regions.len()),
        Question::Exceeds(exceeds) => ("exceeds/thresholds", exceeds.thresholds.len()),
        Question::Quantiles(asked) => ("quantiles/probabilities", asked.probabilities.len()),
        Question::Buried(_) | Question::Mean(_) | Question::Sensitivity(_) => return None,
    };
    too_many(&format!("/questions/{place}/{pointer}"), count, NUMBERS)
}

fn too_many(pointer: &str, count: usize, most: usize) -> Option<Violation> {
    let allowed = format!("at most {most} entries");
    (count > most).then(|| Violation::of(pointer, format!("a list of {count}"), allowed))
}
