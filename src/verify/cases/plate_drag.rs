//! Case 10c: drag of a dense stream on a fixed cube.
//!
//! A stream of beads that just touch flows onto the cube at constant speed and divides around it.
//! No theory gives the drag exactly; the case finds its limit as cells get finer, with the
//! cube and everything else unchanged. The stream is four sides wide (it is periodic
//! along the channel, and mirrored across), and without gravity: its only
//! stress is that caused by the cube. The force is averaged from two to four and from
//! four to six sides of travel after the first contact, in ρ v² A. No tolerance.

use crate::verify::beads;
use crate::verify::findings::{Findings, Question, Resolution};
use crate::verify::limit::limit_or_finest;
use crate::verify::run::{Answer, CaseError};
use crate::verify::stream::{SIDE, Stream};
use crate::verify::{Case, Effort, How};

pub(super) const CASE: Case = Case {
    name: "plate-drag",
    number: "10c",
    title: "drag of a dense stream on a fixed cube, by cells",
    source: "its own limit of vanishing cells",
    how: How::Runs(run),
};

/// Cells per side of the cube. With one cell, its faces lie between nodes.
const CELLS: [u32; 4] = [1, 2, 4, 8];
/// Sides of travel.
const FROM: u32 = 2;
const WINDOWS: [u32; 2] = [4, 6];
const NAMES: [&str; 2] = ["drag over ρ v² A, 2–4 sides", "drag over ρ v² A, 4–6 sides"];
/// Width of the stream in sides.
const WIDE: u32 = 4;

type Drag = Result<Answer<2>, CaseError>;

fn run(effort: Effort, findings: &mut Findings) {
    let cells = effort.take(&CELLS, 3);
    let drags: Vec<Drag> = cells.iter().map(|&cells| drag(cells)).collect();
    let references = [0, 1].map(|window| limit(cells, &drags, window));
    for (&cells, drag) in cells.iter().zip(drags) {
        let label = format!("{cells} cells a side");
        let resolution = Resolution::sized(label, SIDE / f64::from(cells));
        let questions = [0, 1].map(|window| Question::new(NAMES[window], "", references[window]));
        findings.take(&resolution, questions, drag);
    }
    for name in NAMES {
        findings.take_limit(name);
    }
}

/// Limit of the drag, or its finest value.
fn limit(cells: &[u32], drags: &[Drag], window: usize) -> f64 {
    let place = |(cells, drag): (&u32, &Drag)| {
        let drag = drag.as_ref().ok()?.values[window];
        Some((1.0 / f64::from(*cells), drag))
    };
    let places: Vec<_> = cells.iter().zip(drags).filter_map(place).collect();
    limit_or_finest(&places)
}

/// Drag over ρ v² A.
fn drag(cells: u32) -> Drag {
    let stream = Stream {
        cells,
        wide: WIDE * cells,
        material: beads::with_sound_speed(10.0),
        share: 1.0,
        sphere: 1.0,
        travel: WINDOWS[1] * cells,
    };
    let travelled = |sides: u32| f64::from(sides * cells);
    let answer = stream.forces(travelled(FROM), WINDOWS.map(travelled))?;
    Ok(Answer {
        values: answer.values.map(|force| force / stream.momentum_flux()),
        cost: answer.cost,
    })
}
