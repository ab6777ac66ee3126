//! Case 10e: a bore ahead of a wall that is pushed into a layer at rest.
//!
//! A smooth wall of the full width is moved at v into a layer of depth h at rest on a
//! smooth base; relative to the wall, a flow of the Froude number Fr = v/√(g h) is
//! stopped by it. In a material without friction the pressure is hydrostatic, and
//! the balances of mass and momentum across the bore that runs ahead of the wall (shallow water)
//! give
//! the depth ratio r behind it and the force on the wall,
//!
//! (r − 1)² (r + 1) = 2 r Fr²,   F = r² · ½ ρ g h² w:
//!
//! r = 2.170, 3.494, 4.864 and r² = 4.71, 12.2, 23.7 at Fr = 1, 2, 3. Tolerance: 5 % of
//! both. The theory neglects vertical motion, which a bore has only in its front, and the
//! compression of the layer, which is about a hundredth.
//!
//! The channel is one cell wide and open at its far end, and long enough that waves from
//! there meet the bore only after the time of measurement: from 6 to 9 h/√(g h), after a
//! ramp of 2 h/√(g h). Depth is mass over area within 2 h of the wall. The start of the wall
//! throws the layer up, which falls back later: points in the air count towards the depth.

use crate::verify::blocks::{Block, PER_CELL};
use crate::verify::findings::{Findings, Question, Resolution};
use crate::verify::plates::{DENSITY, Plate, bed_material, mean_force};
use crate::verify::run::{Answer, CaseError, Run};
use crate::verify::scenes::GRAVITY;
use crate::verify::{Case, Effort, How};
use scree_solver::Simulation;
use scree_solver::math::Vec3;
use scree_solver::scenario::Precision;

pub(super) const CASE: Case = Case {
    name: "wall-bore",
    number: "10e",
    title: "bore before a wall pushed into a layer at rest",
    source: "(r − 1)² (r + 1) = 2 r Fr², F = r² · ½ ρ g h² w (shallow-water bore)",
    how: How::Runs(run),
};

/// Depth of the layer [m].
const HEIGHT: f64 = 0.1;
const FROUDE: [f64; 3] = [1.0, 2.0, 3.0];
/// Cells over the depth.
const CELLS: [u32; 2] = [6, 12];
/// Thickness of the wall, and of the space behind it [cells].
const WALL: u32 = 2;
/// Duration of the ramp, in h/√(g h).
const RAMP: f64 = 2.0;
const WINDOW: [f64; 2] = [6.0, 9.0];
/// Number of times in it at which the depth is taken.
const LOOKS: u32 = 20;
/// Distance ahead of the wall within which the depth is taken, over h.
const NEAR: f64 = 2.0;

fn run(effort: Effort, findings: &mut Findings) {
    for &froude in effort.take(&FROUDE, 1) {
        let depth = format!("depth ratio at Fr = {froude}");
        let force = format!("force over ½ ρ g h² w at Fr = {froude}");
        for &cells in effort.take(&CELLS, 1) {
            let label = format!("{cells} cells over h");
            let resolution = Resolution::sized(label, HEIGHT / f64::from(cells));
            let ratio = depth_ratio(froude);
            let questions = [
                Question::new(&depth, "", ratio).within(0.05),
                Question::new(&force, "", ratio * ratio).within(0.05),
            ];
            findings.take(&resolution, questions, bore(froude, cells));
        }
        findings.take_limit(&depth);
        findings.take_limit(&force);
    }
}

/// The root above 1 of (r − 1)² (r + 1) = 2 r Fr², by bisection.
fn depth_ratio(froude: f64) -> f64 {
    let off = |r: f64| (r - 1.0).powi(2) * (r + 1.0) - 2.0 * r * froude * froude;
    let (mut low, mut high) = (1.0, 100.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if off(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// √(g h) [m/s].
fn wave_speed() -> f64 {
    (GRAVITY * HEIGHT).sqrt()
}

fn scene(froude: f64, cells: u32) -> Result<scree_solver::simulation::Scene, CaseError> {
    let ratio = depth_ratio(froude);
    // The bore moves at v r/(r − 1), the wave from the open end at √(g h).
    let meet = WINDOW[1] * (froude * ratio / (ratio - 1.0) + 1.0);
    let cell = HEIGHT / f64::from(cells);
    let speed = froude * wave_speed();
    let fastest = speed.max(2.0 * wave_speed());
    let block = Block {
        cell,
        at: [2 * WALL, 0, 0],
        cells: [(meet * f64::from(cells)).ceil() as u32, 1, cells],
        cells_across: 1,
        per_cell: PER_CELL,
        endless: false,
        material: bed_material(0.0, 10.0 * fastest),
        gravity: GRAVITY,
        expected_speed: fastest,
        precision: Precision::Single,
        duration: WINDOW[1] * HEIGHT / wave_speed(),
    };
    // Beyond both sides, below the base, and higher than the bore.
    let corner = |along: u32, across: f64, up: f64| Vec3::new(f64::from(along), across, up) * cell;
    let top = (2.0 * ratio).ceil() * f64::from(cells);
    let wall = Plate {
        corners: [corner(WALL, -1.5, -1.0), corner(2 * WALL, 1.5, top)],
        friction: 0.0,
        velocity: Vec3::new(speed, 0.0, 0.0),
        ramp: RAMP * HEIGHT / wave_speed(),
    };
    wall.within(&block)
}

/// Depth ratio behind the bore, and force on the wall over ½ ρ g h² w.
fn bore(froude: f64, cells: u32) -> Result<Answer<2>, CaseError> {
    let mut run = Run::start(scene(froude, cells)?)?;
    let unit = HEIGHT / wave_speed();
    let width = HEIGHT / f64::from(cells);
    run.to(WINDOW[0] * unit)?;
    let (mut depth, mut force) = (0.0, 0.0);
    for look in 1..=LOOKS {
        let share = f64::from(look) / f64::from(LOOKS);
        let time = WINDOW[0] + share * (WINDOW[1] - WINDOW[0]);
        force -= mean_force(&mut run, time * unit)?.x / f64::from(LOOKS);
        depth += depth_before(&run.simulation, width) / f64::from(LOOKS);
    }
    let resting = 0.5 * DENSITY * GRAVITY * HEIGHT * HEIGHT * width;
    Ok(run.answer([depth / HEIGHT, force / resting]))
}

/// Mass near the wall over its area and density [m].
fn depth_before(simulation: &Simulation, width: f64) -> f64 {
    let wall = &simulation.bodies()[0];
    let face = wall.state.position.x + wall.shape.extent_along(&Vec3::x());
    let mut mass = 0.0;
    simulation.visit_points(None, |point| {
        if (0.0..NEAR * HEIGHT).contains(&(point.position.x - face)) {
            mass += point.mass;
        }
    });
    mass / (DENSITY * width * NEAR * HEIGHT)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depth_ratios_are_those_of_the_relation() {
        for (froude, ratio) in FROUDE.into_iter().zip([2.170, 3.494, 4.864]) {
            assert!((depth_ratio(froude) - ratio).abs() < 1e-3, "{froude}");
        }
    }
}
