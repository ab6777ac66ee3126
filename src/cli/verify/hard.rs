//! Hard cases and sweeps, for people and as Markdown.

use super::{NOTHING, Report};
use crate::cli::columns::table;
use scree::verify::hard::cases;
use scree::verify::hard::sweep::{Failing, Field, Swept};
use scree::verify::hard::trial::{Compared, Figures, Tried};
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

/// All that is no case with a known answer.
pub(super) fn tables(report: &Report) -> String {
    let mut text = String::new();
    let figured = || report.hard.iter().filter(|tried| tried.figures.is_some());
    if figured().next().is_some() {
        let rows = figured().filter_map(row);
        text.push_str(&table("\nhard cases", HEADINGS, rows));
    }
    for tried in &report.hard {
        for line in notes(tried) {
            let _ = writeln!(text, "  {line}");
        }
    }
    if !report.hard.is_empty() {
        let _ = write!(text, "\n{}", in_all(&report.hard));
    }
    for swept in &report.sweeps {
        let _ = write!(text, "\n{}", sweep_in_words(swept));
    }
    text
}

/// The same in Markdown.
pub(super) fn markdown(report: &Report) -> String {
    let mut text = String::new();
    if !report.hard.is_empty() {
        let _ = writeln!(text, "| {} |", HEADINGS.join(" | "));
        let _ = writeln!(text, "|{}", "---|".repeat(HEADINGS.len()));
        for mut cells in report.hard.iter().filter_map(row) {
            if cells[15] != "sound" {
                cells[15] = format!("**{}**", cells[15]);
            }
            let _ = writeln!(text, "| {} |", cells.join(" | "));
        }
        let lines = report.hard.iter().flat_map(notes);
        for line in lines {
            let _ = write!(text, "\n- {line}");
        }
        let _ = writeln!(text, "\n\n{}", in_all(&report.hard));
        text.push_str("\n| family | why it is hard |\n|---|---|\n");
        let met = |family: &&scree::verify::hard::Family| {
            let of_family = format!("{}: ", family.name);
            let mut all = report.hard.iter();
            all.any(|tried| tried.case.starts_with(&of_family))
        };
        for family in cases::ALL.iter().filter(met) {
            let _ = writeln!(text, "| {} | {} |", family.name, family.reason);
        }
    }
    for swept in &report.sweeps {
        let _ = writeln!(text, "\n{}", sweep_in_words(swept));
    }
    text
}

fn in_all(hard: &[Tried]) -> String {
    let sound = hard.iter().filter(|tried| tried.is_sound()).count();
    let wall: f64 = hard.iter().map(|tried| tried.wall_s).sum();
    let broken = hard.len() - sound;
    format!("hard cases: {sound} sound, {broken} not; {wall:.0} s")
}

fn row(tried: &Tried) -> Option<[String; 16]> {
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

fn verdict(tried: &Tried) -> String {
    if tried.is_sound() {
        "sound".to_owned()
    } else {
        format!("BROKEN: {}", tried.broken.join(", "))
    }
}

/// End of a case that did not just finish, and findings of a comparison.
fn notes(tried: &Tried) -> Vec<String> {
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

/// One failure of a sweep.
pub(super) fn in_words(failing: &Failing) -> String {
    format!(
        "seed {}: {}: {}\n  {}",
        failing.seed, failing.kind, failing.words, failing.scenario
    )
}

fn sweep_in_words(swept: &Swept) -> String {
    let mut kinds: BTreeMap<&str, u64> = BTreeMap::new();
    for failing in &swept.failures {
        *kinds.entry(&failing.kind).or_default() += 1;
    }
    let of = match swept.field {
        Field::Everything => "all that is legal",
        Field::BodiesAlone => "bodies alone",
    };
    let Swept {
        asked,
        run,
        refused,
        finished,
        substeps,
        points,
        longest,
        most_energy,
        ..
    } = swept;
    let failed = swept.failures.len();
    let mut text = format!(
        "sweep of {of}: {run} scenarios run ({refused} draws refused on the way), {finished} finished, \
         {failed} failed; {points} points, {substeps} sub-steps; the longest took {:.1} s (seed {}); \
         most energy made {:.0e} (seed {})",
        longest.0, longest.1, most_energy.0, most_energy.1
    );
    if swept.not_run() > 0 {
        let _ = write!(
            text,
            "\n  {} of {asked} NOT RUN: no draw of these seeds was legal",
            swept.not_run()
        );
    }
    for (kind, count) in kinds {
        let _ = write!(text, "\n  {count} × {kind}");
    }
    text
}
