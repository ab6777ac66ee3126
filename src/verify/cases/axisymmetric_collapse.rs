//! Case 12: a round column of grains collapses.
//!
//! A column of radius R0 and height H0 = a R0 is let go on a rough floor. Its
//! run-out was measured to be
//!
//! (R∞ − R0)/R0 = 1.24 a for a < 1.7, 1.6 √a above (Lube, Huppert, Sparks &
//! Hallworth 2004),
//!
//! which is quoted from memory: a guide within ±20 %, without a tolerance. A quarter of
//! the column stands in the corner of back wall and one side, the mirrors of the
//! rest; the other side is beyond reach. Rest and front are those of the plane column;
//! so is the sand, since theirs rested at about its angle. Beads are shown beside at
//! full effort.

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
/// Width of the channel over R0: farther than the flow at a = 2 comes.
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
