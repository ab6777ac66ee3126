//! Computes a number of sub-steps of a small collapse on one thread, and prints the number of
//! points and the instructions in use. `.ci/count-instructions` runs it where instructions are
//! counted.

use scree_solver::scenario::Scenario;
use scree_solver::{Instructions, Simulation};
use std::error::Error;
use std::io::Write;
use std::ops::ControlFlow;

/// A block of 0.5 × 0.25 × 0.2 m slumps on a floor. The Courant number is fixed, so that the
/// number of sub-steps per transfer does not follow the default.
const COLLAPSE: &str = r#"{
    "channel": {"inclination_deg": 0, "incline_length_m": 0.5, "runout_length_m": 1,
                "width_m": 0.25, "base_friction": 0.5},
    "flow": {"volume_m3": 0.025, "release": {"height_m": 0.2, "toe_distance_m": 0},
             "material": {"bulk_density_kg_m3": 1550, "youngs_modulus_pa": 1e6,
                          "static_friction": 0.5774, "limiting_friction": 0.5774}},
    "bodies": [], "duration_s": 10, "sample_interval_s": 10, "flow_snapshots": 0,
    "numerics": {"cell_size_m": 0.03, "courant": 0.4, "symmetry": "full", "approach": "full"}
}"#;

fn main() -> Result<(), Box<dyn Error>> {
    let wanted: u64 = std::env::args()
        .nth(1)
        .ok_or("how many sub-steps?")?
        .parse()?;
    let scenario = Scenario::from_json(COLLAPSE).map_err(|error| format!("{error:?}"))?;
    let mut simulation = Simulation::new(&scenario, 1)?;
    let instructions = Instructions::Avx2.min(Instructions::detected());
    simulation.limit_instructions(instructions);
    simulation.run(f64::INFINITY, |_, report| {
        if report.substeps < wanted {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(())
        }
    })?;
    let points = simulation.point_count();
    writeln!(std::io::stdout(), "{points} points, {instructions}")?;
    Ok(())
}
