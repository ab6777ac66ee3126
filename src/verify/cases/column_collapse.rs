//! Case 11: a plane column of grains collapses.
//!
//! A column, half as wide as L0 and as high as H0 = a L0, is let go on a rough
//! floor; how much farther than L0 it comes to rest was measured to be
//!
//! (L∞ − L0)/L0 = 1.2 a for small a, 1.9 a^⅔ for large (turning at a = 1.8 … 2.8)
//!                (Lube, Huppert, Sparks & Freundt 2005),
//!              = 1.8 a for a < 3, 2.3 a^⅔ above
//!                (Lajeunesse, Monnerie & Homsy 2005).
//!
//! Bar: between the smallest and the largest of these laws at each a. That wide
//! because channels, grains and the place taken for the front differ. A material
//! with a friction of 2 has to fall outside, or the band would say nothing.
//!
//! The material is fixed beforehand: glass beads as the second experiment's, with
//! the friction of Jop, Forterre & Pouliquen 2006, on a floor they don't slip on.
//! The column stands at the back wall, the mirror of its other half, between
//! smooth sides one cell apart, until nothing is faster than a hundredth of
//! √(g H0). The front leaves 0.1 % of the mass beyond it; the same with 1 %, and
//! out to where the deposit is one grain thick, shows what that choice makes. At
//! a = 2 the published solution of μ(I) (Lagrée, Staron & Popinet 2011: 4.40) is
//! shown too; its material is another.

use crate::verify::columns::{Column, runout};
use crate::verify::findings::{Error, Findings, Question, Resolution};
use crate::verify::run::Answer;
use crate::verify::{Case, Effort, How};

pub(super) const CASE: Case = Case {
    name: "column-collapse",
    number: "11",
    title: "run-out of a plane column of glass beads",
    source: "run-outs measured by Lube et al. 2005 and Lajeunesse et al. 2005",
    how: How::Runs(run),
};

const ASPECTS: [f64; 4] = [0.5, 1.0, 2.0, 4.0];
/// Cells over L0.
const CELLS: [u32; 3] = [8, 16, 32];
/// Friction of the material that has to fall outside.
const CONTROL: (f64, f64) = (2.0, 2.0);

fn run(effort: Effort, findings: &mut Findings) {
    for aspect in ASPECTS {
        for &cells in effort.take(&CELLS, 1) {
            at(aspect, cells, findings);
        }
        findings.take_limit(&runout(aspect));
    }
    for &cells in effort.take(&CELLS, 1) {
        control(cells, findings);
    }
}

fn resolution(cells: u32) -> Resolution {
    Resolution::sized(format!("{cells} cells over L0"), 1.0 / f64::from(cells))
}

fn at(aspect: f64, cells: u32, findings: &mut Findings) {
    let column = Column::plane(aspect, cells);
    let (low, high) = band(aspect);
    let [at_the_front, at_a_hundredth, one_grain, moving] = column.questions(0.5 * (low + high));
    let at_the_front = at_the_front.by(Error::Absolute).within(0.5 * (high - low));
    let questions = [at_the_front, at_a_hundredth, one_grain, moving];
    let answer = column.answer();
    if let (2.0, Ok(Answer { values, cost })) = (aspect, &answer) {
        let question = Question::new("run-out, a = 2, against the published μ(I)", "", 4.4);
        let answer = Answer {
            values: [values[0]],
            cost: *cost,
        };
        findings.take(&resolution(cells), [question], Ok(answer));
    }
    findings.take(&resolution(cells), questions, answer);
}

fn control(cells: u32, findings: &mut Findings) {
    let column = Column {
        friction: CONTROL,
        ..Column::plane(2.0, cells)
    };
    let (low, high) = band(2.0);
    let questions = [
        Question::new("control, μ_s = 2, a = 2: run-out", "", 0.5 * (low + high)),
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
    findings.take(&resolution(cells), questions, answer);
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
