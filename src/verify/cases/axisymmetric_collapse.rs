//! Case 12: a round column of grains collapses.
//!
//! A column of radius R0 and height H0 = a R0 is released on a rough floor. Its
//! measured run-out is
//!
//! (R∞ − R0)/R0 = 1.24 a for a < 1.7, 1.6 √a above (Lube, Huppert, Sparks &
//! Hallworth 2004),
//!
//! which is quoted from memory: a guide within ±20 %, without a tolerance. A quarter of
//! the column stands in the corner of back wall and one side, which are the symmetry planes of
//! the rest; the flow does not reach the other side. Rest and front are defined as for the plane
//! column; the sand is the same, since theirs rested at about its angle. At full effort beads are
//! shown as well.

use crate::verify::columns::{Column, Grains, runout};
use crate::verify::findings::{Findings, Resolution};
use crate::verify::{Case, Effort, How};

pub(super) const CASE: Case = Case {
    name: "axisymmetric-collapse",
    number: "12",
    title: "run-out of a round column of grains",
    source: "1.24 a, above a = 1.7 1.6 √a (Lube et al. 2004, quoted from memory)",
    how: How::Runs(run),
};

const ASPECTS: [f64; 3] = [0.5, 1.0, 2.0];
/// Cells over R0.
const CELLS: [u32; 3] = [8, 12, 16];
/// Width of the channel over R0: wider than the spread of the flow at a = 2.
const WIDTH: f64 = 4.5;

fn run(effort: Effort, findings: &mut Findings) {
    for &grains in effort.take(&[Grains::SAND, Grains::BEADS], 1) {
        for aspect in ASPECTS {
            for &cells in effort.take(&CELLS, 1) {
                at(grains, aspect, cells, findings);
            }
            findings.take_limit(&runout(grains, aspect));
        }
    }
}

fn at(grains: Grains, aspect: f64, cells: u32, findings: &mut Findings) {
    let column = Column {
        round: Some(WIDTH),
        ..Column::plane(grains, aspect, cells)
    };
    let measured = if aspect < 1.7 {
        1.24 * aspect
    } else {
        1.6 * aspect.sqrt()
    };
    let resolution = Resolution::sized(format!("{cells} cells over R0"), 1.0 / f64::from(cells));
    findings.take(&resolution, column.questions(measured), column.answer());
}
