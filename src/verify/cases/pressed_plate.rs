//! Case 10g: a flat plate is pressed down into a bed.
//!
//! Resistive-force theory in three dimensions (Agarwal, Goldman & Kamrin 2023) gives the
//! mean stress under a horizontal plate at depth z, moved vertically downward,
//!
//! σ / (ρ g z) = 27.2, 94.2   at μ = 0.4, 0.6
//!
//! of the bed. It gives no width for them; the tolerance of 9 % is half the width of the ranges
//! that it gives for a vertical plate that is dragged (case 10f). The plate starts on the surface
//! and
//! moves down at 0.3 √(g L) after a ramp; σ/(ρ g z) is that of the mean force and the mean
//! depth from 0.5 L to 0.8 L. It is square, of side L, ½ L thick; friction with it 0.4. The bed is
//! 7 L long with a periodic boundary, 7 L wide and 3 L deep: side walls and the
//! plate's next image are 3 L and 6 L away, the floor 2.2 L at the end.

use crate::verify::findings::{Findings, Question, Resolution};
use crate::verify::plates::{DENSITY, Push, SIDE, WINDOW, bed_material};
use crate::verify::run::{Answer, CaseError};
use crate::verify::scenes::GRAVITY;
use crate::verify::{Case, Effort, How};
use scree_solver::math::Vec3;

pub(super) const CASE: Case = Case {
    name: "pressed-plate",
    number: "10g",
    title: "stress under a plate pressed down into a bed",
    source: "resistive-force theory in 3D (Agarwal, Goldman & Kamrin 2023)",
    how: How::Runs(run),
};

/// Friction of the bed, and σ/(ρ g z).
const STRESSES: [(f64, f64); 2] = [(0.4, 27.2), (0.6, 94.2)];
const TOLERANCE: f64 = 0.09;
/// Cells over the side of the plate.
const CELLS: [u32; 3] = [4, 6, 8];
/// The bed, in sides of the plate.
const BED: [u32; 3] = [7, 7, 3];
/// Speed over √(g L).
const SPEED: f64 = 0.3;
/// Sound speed over √(g L) and over √(σ/ρ): the bed is compressed by a few hundredths.
const SOUND: f64 = 20.0;
const STIFF: f64 = 4.0;

fn run(effort: Effort, findings: &mut Findings) {
    for (friction, stress) in STRESSES {
        let name = format!("stress over ρ g z at μ = {friction}");
        for &cells in effort.take(&CELLS, 1) {
            let label = format!("{cells} cells over L");
            let resolution = Resolution::sized(label, SIDE / f64::from(cells));
            let question = Question::new(&name, "", stress).within(TOLERANCE);
            findings.take(&resolution, [question], press(friction, stress, cells));
        }
        findings.take_limit(&name);
    }
}

/// Mean stress over ρ g z; the value `expected` sets the stiffness of the bed.
fn press(friction: f64, expected: f64, cells: u32) -> Result<Answer<1>, CaseError> {
    let wave = (GRAVITY * SIDE).sqrt();
    let speed = SPEED * wave;
    let push = Push {
        cells,
        bed: BED,
        material: bed_material(friction, SOUND.max(STIFF * expected.sqrt()) * wave),
        speed,
        direction: Vec3::new(0.0, 0.0, -1.0),
    };
    let surface = push.surface();
    let middle = push.block().middle();
    let (run, force) = push.force([
        Vec3::new(middle.x - 0.5 * SIDE, -0.5 * SIDE, surface),
        Vec3::new(middle.x + 0.5 * SIDE, 0.5 * SIDE, surface + 0.5 * SIDE),
    ])?;
    let depth = 0.5 * (WINDOW[0] + WINDOW[1]) * SIDE;
    Ok(run.answer([force.z / (DENSITY * GRAVITY * depth * SIDE * SIDE)]))
}
