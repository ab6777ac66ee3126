//! Case 18: coverage of the uncertainty intervals.
//!
//! Scenes drawn at random (`drawn.rs`): a channel, a release, one or two bodies of some
//! shape, with all their parameters random. Each is answered with uncertainty intervals,
//! at 2.2 to 3 cells across its body, and computed once more with cells half as large.
//! Reference solution: that finer run. Tolerance: nine in ten of its values lie inside the
//! intervals,
//! quantity by quantity. Forty other scenes were used to choose the estimator's numbers; none
//! of them is judged here. A quantity counts if the event happened in the finer
//! run or in one of those behind the interval, and not for bodies that never moved. The width of
//! the intervals and their cost are reported as well, since wide intervals are easy.

use crate::verify::drawn::{self, Drawn};
use crate::verify::findings::{Error, Findings, Question, Resolution};
use crate::verify::on_all_cores::side_by_side;
use crate::verify::run::{Answer, CaseError, Cost};
use crate::verify::with_error_bars::answer;
use crate::verify::{Case, Effort, How};
use scree_solver::record::{
    BODY_QUANTITIES, Basis, BodyOutcome, BodyQuantity, Outcome, QuantityKind, UncertaintyInterval,
};
use serde_json::{Value, json};

pub(super) const CASE: Case = Case {
    name: "error-bars",
    number: "18",
    title: "values of finer runs lie inside the bands of error bars",
    source: "the same scenes with cells half as large",
    how: How::Runs(run),
};

/// Scenes that are judged; 0 to 19 and 40 to 59 were used to choose the estimator.
const SCENES: [u64; 20] = [
    20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39,
];
/// Number of scenes of the small version, and its cells over the full ones'.
const QUICK: (usize, f64) = (4, 1.6);
/// Cells of the finer run over the answer's.
const FINER: f64 = 0.5;
/// Share of values that may lie outside.
const OUTSIDE: f64 = 0.1;
/// Point-steps of refinement runs over those of the answer.
const EXTRA_COST: f64 = 0.35;
/// Quantile of the normal distribution for an interval of 95 %.
const TWO_SIDED_95: f64 = 1.96;

/// The interval of a quantity of one outcome.
#[derive(Debug, Clone, Copy)]
struct Seen {
    interval: Option<UncertaintyInterval>,
    /// Scale for the width of its interval.
    scale: Option<f64>,
}

/// A quantity of a body; a coordinate is scaled by the displacement.
fn seen(quantity: &BodyQuantity, body: &BodyOutcome) -> Seen {
    let scale = match quantity.kind {
        QuantityKind::Along | QuantityKind::Across | QuantityKind::Up => Some(body.displacement_m),
        _ => (quantity.value)(body),
    };
    Seen {
        interval: body.error_bars.as_ref().map(quantity.interval).copied(),
        scale,
    }
}

fn run(effort: Effort, findings: &mut Findings) {
    let (scenes, coarser) = match effort {
        Effort::Quick => (&SCENES[..QUICK.0], QUICK.1),
        Effort::Full => (&SCENES[..], 1.0),
    };
    let drawn: Vec<Drawn> = scenes.iter().copied().map(drawn::scene).collect();
    let pairs = side_by_side(&drawn, |scene| pair(scene, coarser));
    let mut trials = Vec::new();
    for (scene, pair) in drawn.iter().zip(pairs) {
        match pair {
            Ok(pair) => trials.push(pair),
            Err(error) => {
                let question = Question::new(format!("scene {}", scene.label), "", 1.0);
                let failed: Result<Answer<1>, CaseError> = Err(error);
                findings.take(&Resolution::named("both runs"), [question], failed);
            }
        }
    }
    let mut all = of_flows(&trials);
    judge("runout_m", &all, findings);
    for quantity in &BODY_QUANTITIES {
        let of_bodies = of_bodies(&trials, quantity);
        judge(quantity.name, &of_bodies, findings);
        all.extend(of_bodies);
    }
    judge("all together", &all, findings);
    converging(&all, findings);
    extra_cost(&trials, findings);
}

/// An answer with intervals, and the finer one.
#[derive(Debug)]
struct Pair {
    answer: Outcome,
    finer: Outcome,
}

fn pair(drawn: &Drawn, coarser: f64) -> Result<Pair, CaseError> {
    let with = |cell_size_m: f64, error_bars: bool| {
        let mut scenario: Value = drawn.scenario.clone();
        scenario["numerics"] = json!({"cell_size_m": cell_size_m});
        scenario["accuracy"] = json!({"error_bars": error_bars});
        answer(&scenario)
    };
    let cell_size_m = coarser * drawn.cell_size_m;
    Ok(Pair {
        answer: with(cell_size_m, true)?,
        finer: with(FINER * cell_size_m, false)?,
    })
}

/// One value of a finer run and the interval it should be in.
#[derive(Debug, Clone, Copy)]
struct Trial {
    interval: UncertaintyInterval,
    finer: Option<f64>,
    /// Scale for the width.
    scale: f64,
}

impl Trial {
    fn is_inside(&self) -> bool {
        let Some(finer) = self.finer else {
            return self.interval.high.is_none();
        };
        let Some(low) = self.interval.low else {
            return false;
        };
        finer >= low && self.interval.high.is_none_or(|high| finer <= high)
    }

    /// Half the width over the scale; infinite where an end is open.
    fn half_width(&self) -> f64 {
        let width = self
            .interval
            .high
            .zip(self.interval.low)
            .map(|(high, low)| high - low);
        width.map_or(f64::INFINITY, |width| 0.5 * width / self.scale)
    }
}

fn of_bodies(pairs: &[Pair], quantity: &BodyQuantity) -> Vec<Trial> {
    let bodies = pairs.iter().flat_map(|Pair { answer, finer }| {
        let both = answer.bodies.iter().zip(&finer.bodies);
        both.filter(|both| both.0.onset_time_s.is_some() || both.1.onset_time_s.is_some())
    });
    let trial = |(body, finer): (&BodyOutcome, &BodyOutcome)| {
        trial(seen(quantity, body), (quantity.value)(finer))
    };
    bodies.filter_map(trial).collect()
}

fn of_flows(pairs: &[Pair]) -> Vec<Trial> {
    let of_flow = |pair: &Pair| {
        let flow = &pair.answer.flow;
        let seen = Seen {
            interval: flow.error_bars.as_ref().map(|bars| bars.runout_m),
            scale: flow.runout_m,
        };
        trial(seen, pair.finer.flow.runout_m)
    };
    pairs.iter().filter_map(of_flow).collect()
}

/// A trial; none if the event happened in none of the runs.
fn trial(seen: Seen, finer: Option<f64>) -> Option<Trial> {
    let interval = seen.interval?;
    let happened = finer.is_some() || interval.basis != Basis::NeverHappened;
    happened.then(|| Trial {
        interval,
        finer,
        scale: seen.scale.map_or(f64::NAN, f64::abs),
    })
}

/// Judges the share of values inside the intervals, and reports their width.
fn judge(name: &str, trials: &[Trial], findings: &mut Findings) {
    let count = trials.len();
    let inside = trials.iter().filter(|trial| trial.is_inside()).count();
    let (low, high) = interval(inside, count);
    let coverage = Question::new(format!("inside, {name}"), "", 1.0);
    let width = Question::new(format!("median half width, {name}"), "of it", 0.0);
    let resolution = Resolution::named(format!("{inside} of {count}; 95 %: {low:.2} to {high:.2}"));
    let share = inside as f64 / count as f64;
    let questions = [
        coverage.by(Error::Absolute).within(OUTSIDE),
        width.by(Error::Absolute),
    ];
    let answer = Answer {
        values: [share, median(trials.iter().map(Trial::half_width))],
        cost: Cost::default(),
    };
    findings.take(&resolution, questions, Ok(answer));
}

/// Reports the share of intervals that rest on converging values.
fn converging(trials: &[Trial], findings: &mut Findings) {
    let converge = trials
        .iter()
        .filter(|trial| trial.interval.basis == Basis::Converging);
    let answer = Answer {
        values: [converge.count() as f64 / trials.len() as f64],
        cost: Cost::default(),
    };
    let question = Question::new("share of converging values", "", 1.0);
    let resolution = Resolution::named(format!("{} intervals", trials.len()));
    findings.take(&resolution, [question.by(Error::Absolute)], Ok(answer));
}

fn extra_cost(pairs: &[Pair], findings: &mut Findings) {
    let of = |pair: &Pair| {
        let report = pair.answer.accuracy.as_ref();
        report.map_or([f64::NAN; 2], |all| {
            [all.extra_cost, all.extra_wall_cost.unwrap_or(f64::NAN)]
        })
    };
    let point_steps = Question::new("extra point-steps, median", "of the answer's", 0.0);
    let wall = Question::new("extra wall time, median", "of the answer's", 0.0);
    let answer = Answer {
        values: [0, 1].map(|place| median(pairs.iter().map(|pair| of(pair)[place]))),
        cost: Cost::default(),
    };
    let resolution = Resolution::named(format!("{} scenes", pairs.len()));
    let questions = [
        point_steps.by(Error::Absolute).within(EXTRA_COST),
        wall.by(Error::Absolute),
    ];
    findings.take(&resolution, questions, Ok(answer));
}

/// Wilson's interval of 95 % for a share, from `inside` of `count` observations.
fn interval(inside: usize, count: usize) -> (f64, f64) {
    let (n, z) = (count as f64, TWO_SIDED_95);
    let share = inside as f64 / n;
    let middle = share + z * z / (2.0 * n);
    let half = z * (share * (1.0 - share) / n + z * z / (4.0 * n * n)).sqrt();
    let whole = 1.0 + z * z / n;
    ((middle - half) / whole, (middle + half) / whole)
}

/// The middle value, the upper of two; NaN if there is none.
fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interval_is_wilsons() {
        // Wilson 1927, as tabulated for 18 of 20 and 20 of 20.
        for (inside, low, high) in [(18, 0.699, 0.972), (20, 0.839, 1.0)] {
            let found = interval(inside, 20);
            assert!((found.0 - low).abs() < 5e-4, "{found:?}");
            assert!((found.1 - high).abs() < 5e-4, "{found:?}");
        }
    }

    #[test]
    fn what_did_not_happen_is_inside_only_where_the_band_says_so() {
        let interval = |low, high| UncertaintyInterval {
            value: Some(1.0),
            low,
            high,
            order: None,
            basis: Basis::Scattered,
        };
        let inside = |low, high, finer| {
            let trial = Trial {
                interval: interval(low, high),
                finer,
                scale: 1.0,
            };
            trial.is_inside()
        };
        assert!(inside(Some(0.9), Some(1.1), Some(1.1)));
        assert!(!inside(Some(0.9), Some(1.1), Some(1.2)));
        assert!(!inside(Some(0.9), Some(1.1), None));
        assert!(inside(Some(0.9), None, None));
        assert!(inside(Some(0.9), None, Some(7.0)));
        assert!(!inside(Some(0.9), None, Some(0.8)));
        assert!(!inside(None, None, Some(1.0)), "no interval holds nothing");
    }
}
