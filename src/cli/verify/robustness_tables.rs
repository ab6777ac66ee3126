//! Robustness and randomised tests, for people and as Markdown.

use super::{NOTHING, Report};
use crate::cli::columns::table;
use scree::verify::robustness::cases;
use scree::verify::robustness::randomised::{FailingScenario, Field, RandomisedReport};
use scree::verify::robustness::trial::{Compared, Figures, TrialReport};
use std::collections::BTreeMap;
use std::fmt::Write as _;

const HEADINGS: [&str; 16] = [
    "case",
    "points",
    "sub-steps",
    "mass",
    "momentum",
    "angular",
    "energy",
    "inside",
    "put back",
    "left",
    "lost",
    "overlap",
    "of bodies",
    "speed",
    "step",
    "verdict",
];

/// All results other than those of cases of known answer.
pub(super) fn tables(report: &Report) -> String {
    let mut text = String::new();
    let figured = || {
        report
            .robustness
            .iter()
            .filter(|tried| tried.figures.is_some())
    };
    if figured().next().is_some() {
        let rows = figured().filter_map(row);
        text.push_str(&table("\nhard cases", HEADINGS, rows));
    }
    for tried in &report.robustness {
        for line in notes(tried) {
            let _ = writeln!(text, "  {line}");
        }
    }
    if !report.robustness.is_empty() {
        let _ = write!(text, "\n{}", in_all(&report.robustness));
    }
    for randomised in &report.randomised {
        let _ = write!(text, "\n{}", randomised_in_words(randomised));
    }
    text
}

/// The same tables in Markdown.
pub(super) fn markdown(report: &Report) -> String {
    let mut text = String::new();
    if !report.robustness.is_empty() {
        let _ = writeln!(text, "| {} |", HEADINGS.join(" | "));
        let _ = writeln!(text, "|{}", "---|".repeat(HEADINGS.len()));
        for mut cells in report.robustness.iter().filter_map(row) {
            if cells[15] != "valid" {
                cells[15] = format!("**{}**", cells[15]);
            }
            let _ = writeln!(text, "| {} |", cells.join(" | "));
        }
        let lines = report.robustness.iter().flat_map(notes);
        for line in lines {
            let _ = write!(text, "\n- {line}");
        }
        let _ = writeln!(text, "\n\n{}", in_all(&report.robustness));
        text.push_str("\n| family | why it may break |\n|---|---|\n");
        let met = |family: &&scree::verify::robustness::Family| {
            let of_family = format!("{}: ", family.name);
            let mut all = report.robustness.iter();
            all.any(|tried| tried.case.starts_with(&of_family))
        };
        for family in cases::ALL.iter().filter(met) {
            let _ = writeln!(text, "| {} | {} |", family.name, family.reason);
        }
    }
    for randomised in &report.randomised {
        let _ = writeln!(text, "\n{}", randomised_in_words(randomised));
    }
    text
}

fn in_all(robustness: &[TrialReport]) -> String {
    let valid = robustness.iter().filter(|tried| tried.is_valid()).count();
    let wall: f64 = robustness.iter().map(|tried| tried.wall_s).sum();
    let broken = robustness.len() - valid;
    format!("robustness tests: {valid} valid, {broken} not; {wall:.0} s")
}

fn row(tried: &TrialReport) -> Option<[String; 16]> {
    let found: Figures = tried.figures?;
    let small = |value: f64| {
        if value == 0.0 {
            "0".to_owned()
        } else {
            format!("{value:.0e}")
        }
    };
    Some([
        tried.case.clone(),
        found.points.to_string(),
        found.substeps.to_string(),
        small(found.mass),
        small(found.momentum),
        small(found.angular_momentum),
        small(found.energy),
        found.inside.to_string(),
        found.penetration_correction.to_string(),
        found.left.to_string(),
        found.lost.to_string(),
        format!("{:.2}", found.overlap),
        format!("{:.2}", found.body_overlap),
        format!("{:.2}", found.speed),
        tried
            .safety
            .map_or_else(|| NOTHING.to_owned(), |factor| format!("{factor:.2}")),
        verdict(tried),
    ])
}

fn verdict(tried: &TrialReport) -> String {
    if tried.is_valid() {
        "valid".to_owned()
    } else {
        format!("BROKEN: {}", tried.broken.join(", "))
    }
}

/// End of a trial other than an ordinary finish, and findings of a comparison.
fn notes(tried: &TrialReport) -> Vec<String> {
    let mut lines = Vec::new();
    if !tried.ended.is_finished() {
        lines.push(format!(
            "{} ({}): {}",
            tried.case,
            verdict(tried),
            tried.ended
        ));
    }
    if !tried.compared.is_empty() {
        let found: Vec<String> = tried.compared.iter().map(compared).collect();
        let found = found.join("; ");
        lines.push(format!("{} ({}): {found}", tried.case, verdict(tried)));
    }
    lines
}

fn compared(one: &Compared) -> String {
    let found = if one.found.fract() == 0.0 && one.found.abs() < 1e9 {
        format!("{}", one.found)
    } else {
        format!("{:.3e}", one.found)
    };
    match one.bound {
        None => format!("{} {found}", one.what),
        Some(bound) => format!("{} {found} (at most {bound:e})", one.what),
    }
}

/// One failure of a randomised test.
pub(super) fn in_words(failing: &FailingScenario) -> String {
    format!(
        "seed {}: {}: {}\n  {}",
        failing.seed, failing.kind, failing.words, failing.scenario
    )
}

fn randomised_in_words(report: &RandomisedReport) -> String {
    let mut kinds: BTreeMap<&str, u64> = BTreeMap::new();
    for failing in &report.failures {
        *kinds.entry(&failing.kind).or_default() += 1;
    }
    let of = match report.field {
        Field::Everything => "all that is legal",
        Field::BodiesAlone => "bodies alone",
    };
    let RandomisedReport {
        asked,
        run,
        refused,
        finished,
        substeps,
        points,
        longest,
        most_energy,
        ..
    } = report;
    let failed = report.failures.len();
    let mut text = format!(
        "sweep of {of}: {run} scenarios run ({refused} draws refused on the way), {finished} finished, \
         {failed} failed; {points} points, {substeps} sub-steps; the longest took {:.1} s (seed {}); \
         most energy made {:.0e} (seed {})",
        longest.0, longest.1, most_energy.0, most_energy.1
    );
    if report.not_run() > 0 {
        let _ = write!(
            text,
            "\n  {} of {asked} NOT RUN: no draw of these seeds was legal",
            report.not_run()
        );
    }
    for (kind, count) in kinds {
        let _ = write!(text, "\n  {count} × {kind}");
    }
    text
}
