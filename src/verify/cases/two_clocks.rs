//! Case 10d: effect of the lengths of step and sub-step on a flowing layer.
//!
//! The layer of case 10 at 24°. Neither the length of a sub-step (`courant`) nor that
//! of a step (`flow_courant`) is part of the problem; each is varied by a factor of
//! four. Tolerance: the surface speed changes by less than 1 % (case 16 requires the same of the
//! source paper's cube).

use crate::verify::blocks::PER_CELL;
use crate::verify::findings::{Findings, Question, Resolution};
use crate::verify::run::{Answer, CaseError, Run};
use crate::verify::slope::Slope;
use crate::verify::{Case, Effort, How};
use scree_solver::stability::Limits;

pub(super) const CASE: Case = Case {
    name: "two-clocks",
    number: "10d",
    title: "a flowing layer at other lengths of sub-step and step",
    source: "the same layer as the solver chooses to compute it",
    how: How::Runs(run),
};

/// A length of step or sub-step: its label, and the function that sets it.
type Clock = (&'static str, fn(&mut Limits));

const CLOCKS: [Clock; 5] = [
    ("courant ×½", |limits| limits.courant *= 0.5),
    ("courant ×¼", |limits| limits.courant *= 0.25),
    ("flow_courant ×2", |limits| limits.flow_courant *= 2.0),
    ("flow_courant ×½", |limits| limits.flow_courant *= 0.5),
    ("flow_courant ×¼", |limits| limits.flow_courant *= 0.25),
];

fn run(effort: Effort, findings: &mut Findings) {
    let (cells, window) = match effort {
        Effort::Quick => (10, [0.3, 0.6]),
        Effort::Full => (20, [2.0, 3.0]),
    };
    let slope = Slope {
        inclination_deg: 24.0,
        cells,
        per_cell: PER_CELL,
        start_deg: 24.0,
        duration: window[1],
    };
    let as_chosen = surface(&slope, window[0], |_| {});
    let reference = as_chosen.map_or(f64::NAN, |answer| answer.values[0]);
    let resolution = Resolution::named(format!("{cells} cells"));
    for (word, set) in CLOCKS {
        let question = Question::new(format!("surface speed, {word}"), "m/s", reference);
        let answer = surface(&slope, window[0], set);
        findings.take(&resolution, [question.within(0.01)], answer);
    }
}

/// Surface speed from `from` to the end of the run [m/s].
fn surface(slope: &Slope, from: f64, set: fn(&mut Limits)) -> Result<Answer<1>, CaseError> {
    let mut scene = slope.scene();
    if let Some(flow) = &mut scene.given.flow {
        set(&mut flow.limits);
    }
    let mut run = Run::start(scene)?;
    run.to(from)?;
    let means = slope.means(&mut run, slope.duration)?;
    Ok(run.answer([means.surface(slope.inclination_deg).0]))
}
