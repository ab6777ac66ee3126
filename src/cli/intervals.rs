//! Uncertainty intervals as a table for people.

use super::columns::table;
use scree_solver::record::{
    AccuracyReport, BODY_QUANTITIES, Basis, FLOW_QUANTITIES, Outcome, Role, UncertaintyInterval,
};
use std::fmt::Write as _;

/// Sign for an open end or a missing order.
const NOTHING: &str = "–";

/// The intervals of an outcome and their basis; none if none were asked for.
pub(super) fn intervals(outcome: &Outcome) -> Option<String> {
    let report = outcome.accuracy.as_ref()?;
    let headings = ["of", "quantity", "value", "low", "high", "order", "basis"];
    let mut text = table("error bars", headings, rows(outcome));
    let _ = write!(text, "\n{}", runs(report));
    if let Some(target) = target(report) {
        let _ = write!(text, "\n{target}");
    }
    Some(text)
}

fn rows(outcome: &Outcome) -> Vec<[String; 7]> {
    let mut rows = Vec::new();
    for (index, body) in outcome.bodies.iter().enumerate() {
        let Some(bars) = &body.error_bars else {
            continue;
        };
        for quantity in &BODY_QUANTITIES {
            let interval = (quantity.interval)(bars);
            rows.push(row(&format!("body {index}"), quantity.heading, interval));
        }
    }
    if let Some(bars) = &outcome.flow.error_bars {
        for quantity in &FLOW_QUANTITIES {
            rows.push(row("flow", quantity.heading, (quantity.interval)(bars)));
        }
    }
    rows
}

fn row(of: &str, name: &str, interval: &UncertaintyInterval) -> [String; 7] {
    let number = |value: Option<f64>, decimals: usize| {
        value.map_or_else(|| NOTHING.to_owned(), |value| format!("{value:.decimals$}"))
    };
    [
        of.to_owned(),
        name.to_owned(),
        number(interval.value, 4),
        number(interval.low, 4),
        number(interval.high, 4),
        number(interval.order, 1),
        basis(interval.basis).to_owned(),
    ]
}

fn basis(basis: Basis) -> &'static str {
    match basis {
        Basis::Converging => "converging",
        Basis::Scattered => "scattered",
        Basis::Same => "the same in all runs",
        Basis::OneRefinementRun => "one refinement run",
        Basis::NeverHappened => "never happened",
        Basis::SometimesHappened => "happened in some runs",
        Basis::Nothing => "nothing to compare with",
    }
}

fn runs(report: &AccuracyReport) -> String {
    let cells: Vec<String> = report
        .runs
        .iter()
        .map(|run| {
            let reduced_stiffness = if run.role == Role::ReducedStiffness {
                " reduced stiffness"
            } else {
                ""
            };
            let failed = if run.failure.is_some() { " failed" } else { "" };
            format!("{:.4} m{reduced_stiffness}{failed}", run.cell_size_m)
        })
        .collect();
    let wall = report.extra_wall_cost.map_or_else(String::new, |extra| {
        format!(", {:.0} % of its wall time", 100.0 * extra)
    });
    format!(
        "runs  cells of {}; {:.0} % on top of the answer's point-steps{wall}",
        cells.join(", "),
        100.0 * report.extra_cost
    )
}

fn target(report: &AccuracyReport) -> Option<String> {
    let target = report.target.as_ref()?;
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    let reached = target.reached.map_or_else(|| NOTHING.to_owned(), percent);
    let reason = target.reason.as_deref();
    Some(format!(
        "target {} within {}: {reached}, {}{}",
        target.quantity.key(),
        percent(target.asked),
        if target.met { "met" } else { "not met" },
        reason.map_or_else(String::new, |reason| format!(": {reason}"))
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_open_end_is_a_dash_and_the_basis_stands_in_words() {
        let interval = UncertaintyInterval {
            value: Some(1.25),
            low: Some(1.0),
            high: None,
            order: None,
            basis: Basis::SometimesHappened,
        };
        let cells = row("body 0", "rest from [s]", &interval);
        assert_eq!(
            cells.join("|"),
            "body 0|rest from [s]|1.2500|1.0000|–|–|happened in some runs"
        );
    }

    #[test]
    fn a_missed_target_tells_why() {
        let report = AccuracyReport {
            runs: Vec::new(),
            extra_cost: 0.0,
            extra_wall_cost: None,
            target: Some(scree_solver::record::TargetReport {
                quantity: scree_solver::scenario::Quantity::Displacement,
                body: Some(0),
                asked: 0.05,
                reached: Some(0.081),
                met: false,
                reason: Some("no money".to_owned()),
            }),
        };
        assert_eq!(
            target(&report).unwrap(),
            "target displacement_m within 5.0 %: 8.1 %, not met: no money"
        );
    }
}
