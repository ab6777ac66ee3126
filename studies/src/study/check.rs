//! Check of a study.

use super::pointer::Pointer;
use super::{Study, Violation, levels, sizes};
use crate::correlation;
use crate::design::Design;

/// All violations of a study, in the order of the document.
pub(super) fn violations(study: &Study) -> Vec<Violation> {
    let too_large = sizes::violations(study);
    if !too_large.is_empty() {
        return too_large;
    }
    [
        inputs(study),
        correlations(study),
        Violation::under("/design", study.design.violations(study.inputs.len())),
        levels::violations(study),
        accuracy(study),
        stop(study),
        questions(study),
    ]
    .concat()
}

fn inputs(study: &Study) -> Vec<Violation> {
    if study.inputs.is_empty() {
        let message = "inputs is empty, allowed: at least one input";
        return vec![Violation::new("/inputs", message)];
    }
    let of_one = |place: usize| {
        let mut found: Vec<Violation> = pointer(study, place).into_iter().collect();
        found.extend(distribution(study, place));
        Violation::under(&format!("/inputs/{place}"), found)
    };
    (0..study.inputs.len()).flat_map(of_one).collect()
}

/// What is wrong with the place of an input.
fn pointer(study: &Study, place: usize) -> Option<Violation> {
    let text = &study.inputs[place].pointer;
    let pointer = match Pointer::parse(text) {
        Ok(pointer) => pointer,
        Err(message) => return Some(Violation::new("/pointer", message)),
    };
    if !pointer.fits(&study.scenario) {
        let allowed = "a place in the scenario, or a new key of an object in it";
        return Some(Violation::of("/pointer", format!("{text:?}"), allowed));
    }
    let overlaps = |earlier: &usize| {
        let earlier = Pointer::parse(&study.inputs[*earlier].pointer);
        earlier.is_ok_and(|earlier| earlier.overlaps(&pointer))
    };
    let earlier = (0..place).find(overlaps)?;
    let allowed = format!("a place that does not overlap that of input {earlier}");
    Some(Violation::of("/pointer", format!("{text:?}"), allowed))
}

fn distribution(study: &Study, place: usize) -> Vec<Violation> {
    match (&study.inputs[place].distribution, &study.design) {
        (Some(given), _) => Violation::under("/distribution", given.violations()),
        (None, Design::Explicit(_)) => Vec::new(),
        (None, _) => {
            let message = "distribution is missing, allowed: to leave it out in an explicit design";
            vec![Violation::new("/distribution", message)]
        }
    }
}

fn correlations(study: &Study) -> Vec<Violation> {
    let given = &study.correlations;
    if given.is_empty() {
        return Vec::new();
    }
    let mut found = correlation::violations(given, study.inputs.len());
    for (place, correlation) in given.iter().enumerate() {
        for (end, input) in correlation.inputs.iter().enumerate() {
            let distribution = study.inputs.get(*input).map(|input| &input.distribution);
            if let Some(Some(distribution)) = distribution
                && !distribution.is_numeric()
            {
                let given = format!("{input}, a choice with values that aren't numbers");
                let pointer = format!("/{place}/inputs/{end}");
                found.push(Violation::of(&pointer, given, "an input with numbers"));
            }
        }
    }
    found.extend(uncorrelated_design(&study.design));
    Violation::under("/correlations", found)
}

/// A design that allows no correlations.
fn uncorrelated_design(design: &Design) -> Option<Violation> {
    let message = match design {
        Design::Explicit(_) => {
            "correlations have no effect on an explicit design, allowed: to leave them out"
        }
        _ if design.needs_independence() => {
            "the indices of morris, saltelli and one_at_a_time need independent inputs, allowed: \
             no correlations"
        }
        _ => return None,
    };
    Some(Violation::new("", message))
}

fn accuracy(study: &Study) -> Vec<Violation> {
    let asked = study.accuracy.iter();
    let found = asked.flat_map(|accuracy| accuracy.violations(study));
    Violation::under("/accuracy", found.collect())
}

fn stop(study: &Study) -> Vec<Violation> {
    let found = study.stop.iter().flat_map(|stop| stop.violations(study));
    Violation::under("/stop", found.collect())
}

fn questions(study: &Study) -> Vec<Violation> {
    let questions = study.questions.iter().enumerate();
    let of_one = |(place, question): (usize, &super::Question)| {
        let found = question.violations(&study.design);
        Violation::under(&format!("/questions/{place}"), found)
    };
    questions.flat_map(of_one).collect()
}
