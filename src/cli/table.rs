//! The outcome as a table for people.

use scree_solver::record::{BodyOutcome, Conservation, Cost, FlowOutcome, Outcome};
use std::fmt::Write as _;

/// Sign for an event that did not happen.
const NEVER: &str = "–";

/// A named value with its unit.
type Entry = (&'static str, String, &'static str);

/// Bodies, flow, conservation and cost of a run.
pub(super) fn outcome(outcome: &Outcome) -> String {
    let mut text = String::new();
    if !outcome.bodies.is_empty() {
        text.push_str(&bodies(&outcome.bodies));
        text.push('\n');
    }
    if outcome.flow.front_m.is_some() {
        text.push_str(&missed(&outcome.bodies));
    }
    text.push_str(&line("flow", &flow(&outcome.flow)));
    let [balances, points] = conservation(&outcome.conservation);
    text.push_str(&line("conservation", &balances));
    text.push_str(&line("", &points));
    let [size, time] = cost(&outcome.cost);
    text.push_str(&line("cost", &size));
    text.push_str(&line("", &time));
    text.trim_end().to_owned()
}

/// A line that names the bodies that the flow did not reach; empty if it reached all.
fn missed(bodies: &[BodyOutcome]) -> String {
    let bodies = bodies.iter().enumerate();
    let missed = bodies.filter(|(_, body)| body.first_contact_time_s.is_none());
    let places: Vec<String> = missed.map(|(place, _)| place.to_string()).collect();
    match &places[..] {
        [] => String::new(),
        [place] => format!("note: the flow did not reach body {place} before the run ended\n"),
        many => format!(
            "note: the flow did not reach bodies {} before the run ended\n",
            many.join(", ")
        ),
    }
}

fn flow(flow: &FlowOutcome) -> [Entry; 3] {
    [
        ("front", optional(flow.front_m, 3), " m"),
        ("run-out", optional(flow.runout_m, 3), " m"),
        ("outflow", format!("{:.3}", flow.outflow_mass_kg), " kg"),
    ]
}

fn conservation(audit: &Conservation) -> [Vec<Entry>; 2] {
    let small = |value: f64| format!("{value:.1e}");
    [
        vec![
            ("mass error", small(audit.mass_error), ""),
            ("momentum residual", small(audit.momentum_residual), ""),
            ("angular", small(audit.angular_momentum_residual), ""),
            ("energy residual", small(audit.energy_residual), ""),
        ],
        vec![
            (
                "largest overlap",
                format!("{:.3}", audit.max_overlap_ratio),
                "",
            ),
            (
                "of bodies",
                format!("{:.3}", audit.max_body_overlap_ratio),
                "",
            ),
            (
                "penetration corrections",
                audit.penetration_corrections.to_string(),
                "",
            ),
            ("outflow", audit.points_outflow.to_string(), ""),
            ("lost", audit.points_lost.to_string(), ""),
        ],
    ]
}

fn cost(cost: &Cost) -> [Vec<Entry>; 2] {
    let size = vec![
        ("points", cost.points.to_string(), ""),
        ("cell", format!("{:.4}", cost.cell_size_m), " m"),
        ("steps", cost.steps.to_string(), ""),
        ("sub-steps", cost.substeps.to_string(), ""),
    ];
    let time = vec![
        ("wall time", format!("{:.1}", cost.wall_s), " s"),
        (
            "point-steps/s",
            format!("{:.2e}", cost.point_steps_per_s),
            "",
        ),
        ("threads", cost.threads.to_string(), ""),
    ];
    [size, time]
}

fn line(title: &str, entries: &[Entry]) -> String {
    let entry = |(name, value, unit): &Entry| format!("{name} {value}{unit}");
    let entries: Vec<String> = entries.iter().map(entry).collect();
    format!("{title:<14}{}\n", entries.join(", "))
}

/// Columns of the bodies' table, with their units.
const COLUMNS: [(&str, &str); 10] = [
    ("body", ""),
    ("onset", "s"),
    ("peak", "m/s"),
    ("peak at", "s"),
    ("rest from", "s"),
    ("displaced", "m"),
    ("path", "m"),
    ("final x", "m"),
    ("y", "m"),
    ("z", "m"),
];

/// One line per body under two lines of headings.
fn bodies(bodies: &[BodyOutcome]) -> String {
    let mut text = String::new();
    let headings: String = COLUMNS.iter().map(|(name, _)| cell(name)).collect();
    let units: String = COLUMNS.iter().map(|(_, unit)| cell(unit)).collect();
    let _ = writeln!(text, "{}\n{}", headings.trim_end(), units.trim_end());
    for (index, body) in bodies.iter().enumerate() {
        let cells: String = row(index, body).iter().map(|value| cell(value)).collect();
        let _ = writeln!(text, "{cells}");
    }
    text
}

fn row(index: usize, body: &BodyOutcome) -> [String; COLUMNS.len()] {
    let [x, y, z] = body.final_position_m.map(metres);
    [
        index.to_string(),
        optional(body.onset_time_s, 3),
        format!("{:.3}", body.peak_speed_m_s),
        optional(body.peak_speed_time_s, 3),
        optional(body.stop_time_s, 3),
        metres(body.displacement_m),
        metres(body.path_length_m),
        x,
        y,
        z,
    ]
}

/// A length [m] to a tenth of a millimetre; zero has no sign.
fn metres(length: f64) -> String {
    let text = format!("{length:.4}");
    if text == "-0.0000" {
        "0.0000".to_owned()
    } else {
        text
    }
}

fn cell(text: &str) -> String {
    format!("{text:>10}")
}

fn optional(value: Option<f64>, decimals: usize) -> String {
    value.map_or_else(|| NEVER.to_owned(), |value| format!("{value:.decimals$}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use scree_solver::record::MassProperties;

    fn body(onset_time_s: Option<f64>) -> BodyOutcome {
        BodyOutcome {
            first_contact_time_s: onset_time_s,
            onset_time_s,
            peak_speed_m_s: 1.0796,
            peak_speed_time_s: onset_time_s.map(|onset| onset + 0.1),
            stop_time_s: None,
            displacement_m: 0.41234,
            path_length_m: 0.5,
            final_position_m: [0.45, -1e-9, 0.02],
            burial_depth_m: 0.0,
            final_orientation: [1.0, 0.0, 0.0, 0.0],
            error_bars: None,
            mass_properties: MassProperties {
                mass_kg: 0.1,
                volume_m3: 5e-5,
                principal_moments_kg_m2: [1e-5; 3],
                principal_axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            },
            energy: None,
        }
    }

    #[test]
    fn bodies_that_the_flow_missed_are_named() {
        assert_eq!(missed(&[body(Some(0.17))]), "");
        let one = missed(&[body(Some(0.17)), body(None)]);
        assert!(one.contains("did not reach body 1 before"), "{one}");
        let both = missed(&[body(None), body(None)]);
        assert!(both.contains("bodies 0, 1 before"), "{both}");
    }

    #[test]
    fn bodies_stand_under_their_headings_and_nothing_is_a_dash() {
        let text = bodies(&[body(Some(0.17)), body(None)]);
        let lines: Vec<Vec<&str>> = text
            .lines()
            .map(|l| l.split_whitespace().collect())
            .collect();
        let first = "0 0.170 1.080 0.270 – 0.4123 0.5000 0.4500 0.0000 0.0200";
        assert_eq!(lines[2].join(" "), first);
        assert_eq!(lines[3][..5].join(" "), "1 – 1.080 – –");
        // Every heading ends in the column in which its values end.
        let ends = |line: &str| line.chars().count();
        assert!(
            text.lines()
                .all(|line| ends(line) == ends("          ") * COLUMNS.len())
        );
    }
}
