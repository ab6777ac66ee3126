//! The outcome as a table for people.

use scree_solver::record::{BodyOutcome, Outcome};
use std::fmt::Write as _;

/// What stands for something that did not happen.
const NEVER: &str = "–";

/// Bodies, flow, audit and cost of a run.
pub(super) fn outcome(outcome: &Outcome) -> String {
    let mut text = String::new();
    if !outcome.bodies.is_empty() {
        text.push_str(&bodies(&outcome.bodies));
        text.push('\n');
    }
    let flow = &outcome.flow;
    let audit = &outcome.audit;
    let cost = &outcome.cost;
    let lines = [
        line(
            "flow",
            &[
                ("front", optional(flow.front_m, 3), " m"),
                ("run-out", optional(flow.runout_m, 3), " m"),
                (
                    "left by the open end",
                    format!("{:.3}", flow.mass_left_kg),
                    " kg",
                ),
            ],
        ),
        line(
            "audit",
            &[
                ("mass error", format!("{:.1e}", audit.mass_error), ""),
                (
                    "momentum residual",
                    format!("{:.1e}", audit.momentum_residual),
                    "",
                ),
                (
                    "angular",
                    format!("{:.1e}", audit.angular_momentum_residual),
                    "",
                ),
                (
                    "energy residual",
                    format!("{:.1e}", audit.energy_residual),
                    "",
                ),
            ],
        ),
        line(
            "",
            &[
                (
                    "largest overlap",
                    format!("{:.3}", audit.max_overlap_ratio),
                    "",
                ),
                ("points put back", audit.points_put_back.to_string(), ""),
                ("left", audit.points_left.to_string(), ""),
                ("lost", audit.points_lost.to_string(), ""),
            ],
        ),
        line(
            "cost",
            &[
                ("points", cost.points.to_string(), ""),
                ("cell", format!("{:.4}", cost.cell_size_m), " m"),
                ("steps", cost.steps.to_string(), ""),
                ("sub-steps", cost.substeps.to_string(), ""),
            ],
        ),
        line(
            "",
            &[
                ("wall time", format!("{:.1}", cost.wall_s), " s"),
                (
                    "point-steps/s",
                    format!("{:.2e}", cost.point_steps_per_s),
                    "",
                ),
                ("threads", cost.threads.to_string(), ""),
            ],
        ),
    ];
    text.push_str(&lines.join("\n"));
    text
}

fn line(title: &str, entries: &[(&str, String, &str)]) -> String {
    let entry = |(name, value, unit): &(&str, String, &str)| format!("{name} {value}{unit}");
    let entries: Vec<String> = entries.iter().map(entry).collect();
    format!("{title:<6}{}", entries.join(", "))
}

/// One line a body under two lines of headings.
fn bodies(bodies: &[BodyOutcome]) -> String {
    let mut text = String::new();
    let columns = [
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
    let headings: String = columns.iter().map(|(name, _)| cell(name)).collect();
    let units: String = columns.iter().map(|(_, unit)| cell(unit)).collect();
    let _ = writeln!(text, "{}\n{}", headings.trim_end(), units.trim_end());
    for (index, body) in bodies.iter().enumerate() {
        let [x, y, z] = body
            .final_position_m
            .map(|coordinate| format!("{coordinate:.4}"));
        let row: String = [
            index.to_string(),
            optional(body.onset_time_s, 3),
            format!("{:.3}", body.peak_speed_m_s),
            optional(body.peak_speed_time_s, 3),
            optional(body.stop_time_s, 3),
            format!("{:.4}", body.displacement_m),
            format!("{:.4}", body.path_length_m),
            x,
            y,
            z,
        ]
        .iter()
        .map(|value| cell(value))
        .collect();
        let _ = writeln!(text, "{}", row.trim_end());
    }
    text
}

fn cell(text: &str) -> String {
    format!("{text:>10}")
}

fn optional(value: Option<f64>, decimals: usize) -> String {
    value.map_or_else(|| NEVER.to_owned(), |value| format!("{value:.decimals$}"))
}
