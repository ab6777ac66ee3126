//! Case 10f: a vertical plate is dragged through a bed.
//!
//! Resistive-force theory in three dimensions (Agarwal, Goldman & Kamrin 2023) gives a
//! stress that grows with depth and does not depend on the speed as long as that is below
//! 0.4 √(g L). For a plate of width w, immersed to h and dragged along its normal,
//!
//! F / (½ ρ g w h²) = 6.0–7.1, 11.5–13.7, 20.6–24.7   at μ = 0.4, 0.5, 0.6
//!
//! of the bed. The reference solution is the middle of the range, the tolerance its half-width. The
//! plate
//! starts in the bed; the force is the mean from 0.5 h to 0.8 h of travel, at 0.35 √(g h) after
//! a ramp. w = h, thickness ½ h; friction with the plate 0.4. The bed is 8 h long with a periodic
//! boundary, 6 h wide and 2 h deep: a plane slip surface before the plate reaches the bed's surface
//! 1.8 h ahead of its foot at μ = 0.6 (tan(45° + φ/2)), and side walls are
//! 2.5 h away.

use crate::verify::findings::{Findings, Question, Resolution};
use crate::verify::plates::{DENSITY, Push, SIDE, bed_material};
use crate::verify::run::{Answer, CaseError};
use crate::verify::scenes::GRAVITY;
use crate::verify::{Case, Effort, How};
use scree_solver::math::Vec3;

pub(super) const CASE: Case = Case {
    name: "dragged-plate",
    number: "10f",
    title: "drag of an upright plate in a bed",
    source: "resistive-force theory in 3D (Agarwal, Goldman & Kamrin 2023)",
    how: How::Runs(run),
};

/// Friction of the bed, and the range of F / (½ ρ g w h²).
const RANGES: [(f64, [f64; 2]); 3] = [(0.4, [6.0, 7.1]), (0.6, [20.6, 24.7]), (0.5, [11.5, 13.7])];
/// Cells over the depth.
const CELLS: [u32; 3] = [4, 6, 8];
/// The bed, in depths of the plate.
const BED: [u32; 3] = [8, 6, 2];
/// Speed over √(g h).
const SPEED: f64 = 0.35;
/// Sound speed over √(g h): the stress on the plate compresses the bed by a few hundredths.
const SOUND: f64 = 20.0;

fn run(effort: Effort, findings: &mut Findings) {
    for (friction, [low, high]) in effort.take(&RANGES, 2) {
        let name = format!("force over ½ ρ g w h² at μ = {friction}");
        for &cells in effort.take(&CELLS, 1) {
            let label = format!("{cells} cells over h");
            let resolution = Resolution::sized(label, SIDE / f64::from(cells));
            let middle = 0.5 * (low + high);
            let question = Question::new(&name, "", middle).within(0.5 * (high - low) / middle);
            findings.take(&resolution, [question], drag(*friction, cells));
        }
        findings.take_limit(&name);
    }
}

/// Force over ½ ρ g w h².
fn drag(friction: f64, cells: u32) -> Result<Answer<1>, CaseError> {
    let wave = (GRAVITY * SIDE).sqrt();
    let speed = SPEED * wave;
    let push = Push {
        cells,
        bed: BED,
        material: bed_material(friction, SOUND * wave),
        speed,
        direction: Vec3::x(),
    };
    let surface = push.surface();
    let back = 2.0 * SIDE;
    let (run, force) = push.force([
        Vec3::new(back, -0.5 * SIDE, surface - SIDE),
        Vec3::new(back + 0.5 * SIDE, 0.5 * SIDE, surface + SIDE),
    ])?;
    let scale = 0.5 * DENSITY * GRAVITY * SIDE.powi(3);
    Ok(run.answer([-force.x / scale]))
}
