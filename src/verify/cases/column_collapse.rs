//! Case 11: a plane column of grains collapses.
//!
//! A column, half as wide as L0 and as high as H0 = a L0, is released on a rough
//! floor; its measured run-out beyond L0 is
//!
//! (L∞ − L0)/L0 = 1.2 a for small a, 1.9 a^⅔ for large (turning at a = 1.8 … 2.8)
//!                (Lube, Huppert, Sparks & Freundt 2005),
//!              = 1.8 a for a < 3, 2.3 a^⅔ above
//!                (Lajeunesse, Monnerie & Homsy 2005).
//!
//! Tolerance: between the smallest and the largest of these laws at each a. It is that wide
//! because channels, grains and definitions of the front differ. A material
//! with a friction of 2 must fall outside, or the range would be meaningless.
//!
//! Materials are fixed beforehand, one for each experiment: for the first, sand that
//! rests at 32°, independent of its rate (theirs rested at about that, and their law holds
//! for all of it); for the second, glass beads with the friction of Jop, Forterre &
//! Pouliquen 2006. Neither slips on the floor. The column stands at the back wall,
//! the symmetry plane of its other half, between smooth sides one cell apart, until nothing
//! is faster than a hundredth of √(g H0). The front leaves 0.1 % of the mass beyond
//! it; the run-outs with 1 %, and to the place where the deposit is one grain thick, show the
//! effect
//! of that choice. The thin end needs fine cells: the tolerance holds from 16 over the
//! column's shorter side on, coarser ones are only shown. At a = 2 the published solution
//! of μ(I) (Lagrée, Staron & Popinet 2011: 4.40) is shown too; its material
//! differs, and is closer to the beads.

use crate::verify::columns::{Column, Grains, runout};
use crate::verify::findings::{Error, Findings, Question, Resolution};
use crate::verify::run::Answer;
use crate::verify::{Case, Effort, How};

pub(super) const CASE: Case = Case {
    name: "column-collapse",
    number: "11",
    title: "run-out of plane columns of sand and of glass beads",
    source: "run-outs measured by Lube et al. 2005 and Lajeunesse et al. 2005",
    how: How::Runs(run),
};

const ASPECTS: [f64; 4] = [0.5, 1.0, 2.0, 4.0];
/// Cells over the column's shorter side, and the number from which on the tolerance holds.
const CELLS: [u32; 3] = [8, 16, 32];
const JUDGED: u32 = 16;
/// A material that must fall outside.
const CONTROL: Grains = Grains {
    name: "control, μ_s = 2",
    friction: (2.0, 2.0),
};

fn run(effort: Effort, findings: &mut Findings) {
    for aspect in ASPECTS {
        // The tallest column takes longest.
        let quick = if aspect > 2.0 { 1 } else { 2 };
        for (grains, quick) in [(Grains::SAND, quick), (Grains::BEADS, 1)] {
            for &cells in effort.take(&CELLS, quick) {
                at(grains, aspect, cells, findings);
            }
            findings.take_limit(&runout(grains, aspect));
        }
    }
    for &cells in effort.take(&CELLS, 1) {
        control(cells, findings);
    }
}

/// The column with this number of cells over its shorter side, and its label.
fn column(grains: Grains, aspect: f64, cells: u32) -> (Column, Resolution) {
    let over_base = (f64::from(cells) / aspect.min(1.0)).round() as u32;
    let name = format!("{over_base} cells over L0");
    let resolution = Resolution::sized(name, 1.0 / f64::from(over_base));
    (Column::plane(grains, aspect, over_base), resolution)
}

fn at(grains: Grains, aspect: f64, cells: u32, findings: &mut Findings) {
    let (column, resolution) = column(grains, aspect, cells);
    let (low, high) = band(aspect);
    let mut questions = column.questions(0.5 * (low + high));
    questions[0].error = Error::Absolute;
    if cells >= JUDGED {
        questions[0].tolerance = Some(0.5 * (high - low));
    }
    let answer = column.answer();
    let published = grains.name == Grains::BEADS.name && aspect == 2.0;
    if let (true, Ok(Answer { values, cost })) = (published, &answer) {
        let quantity = format!("{}, against the published μ(I)", runout(grains, aspect));
        let answer = Answer {
            values: [values[0]],
            cost: *cost,
        };
        findings.take(&resolution, [Question::new(quantity, "", 4.4)], Ok(answer));
    }
    findings.take(&resolution, questions, answer);
}

fn control(cells: u32, findings: &mut Findings) {
    let (column, resolution) = column(CONTROL, 2.0, cells);
    let (low, high) = band(2.0);
    let questions = [
        Question::new(runout(CONTROL, 2.0), "", 0.5 * (low + high)),
        Question::new("control is outside the band (1: yes)", "", 1.0).within(0.0),
    ];
    let answer = column.answer().map(|answer| {
        let runout = answer.values[0];
        let outside = f64::from(u8::from(!(low..=high).contains(&runout)));
        Answer {
            values: [runout, outside],
            cost: answer.cost,
        }
    });
    findings.take(&resolution, questions, answer);
}

/// Smallest and largest run-out of the laws that hold at this aspect.
fn band(aspect: f64) -> (f64, f64) {
    let power = aspect.powf(2.0 / 3.0);
    let mut laws = Vec::new();
    if aspect <= 2.8 {
        laws.push(1.2 * aspect);
    }
    if aspect >= 1.8 {
        laws.push(1.9 * power);
    }
    laws.push(if aspect < 3.0 {
        1.8 * aspect
    } else {
        2.3 * power
    });
    let low = laws.iter().copied().fold(f64::INFINITY, f64::min);
    let high = laws.iter().copied().fold(0.0, f64::max);
    (low, high)
}

#[cfg(test)]
mod tests {
    use super::band;

    #[test]
    fn at_a_of_two_both_laws_of_lube_count() {
        let (low, high) = band(2.0);
        assert!((low - 2.4).abs() < 1e-12 && (high - 3.6).abs() < 1e-12);
    }
}
