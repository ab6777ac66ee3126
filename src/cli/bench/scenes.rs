//! The scenes that are timed.

use crate::cli::failure::Failure;
use scree_solver::scenario::Scenario;
use serde_json::{Value, json};

/// The source paper's scene.
const CHANNEL: &str = include_str!("../../../configs/scenarios/source_paper.json");

/// Points of the collapse with cells of [`CELL_M`].
pub(super) const COLLAPSE_POINTS: u32 = 200_000;
const CELL_M: f64 = 0.01;

/// Length of the whole collapse [s].
pub(super) const COLLAPSE_S: f64 = 0.15;

/// Simulated time beyond the end of any measurement [s].
const NEVER_S: f64 = 100.0;

/// A flow Courant number at which the flow is transferred at every sub-step.
const EVERY_SUBSTEP: f64 = 1e-3;

/// Start and duration of the time range in which the channel's flow surrounds the cube [s].
pub(super) const IN_THE_FLOW_S: (f64, f64) = (0.25, 0.1);

/// Distance of the small cubes' centres and their side [m].
const SMALL_CUBES_M: (f64, f64) = (0.03, 0.02);
/// Small cubes side by side in the channel.
const ABREAST: usize = 5;

/// Variant of the computation of a collapse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Collapse {
    /// Approximate number of points.
    pub(super) points: u32,
    /// True if computed in 64 bits instead of 32.
    pub(super) double: bool,
    /// True if the flow is transferred at every sub-step, not after it has moved by a given
    /// distance.
    pub(super) every_substep: bool,
}

impl Collapse {
    /// In single precision, with transfers paced by the flow.
    pub(super) fn of(points: u32) -> Self {
        Self {
            points,
            double: false,
            every_substep: false,
        }
    }

    /// A block of 0.5 × 0.25 × 0.2 m slumps on a floor. With fewer points,
    /// cells and sub-steps are larger in the same ratio.
    pub(super) fn scenario(self) -> Result<Scenario, Failure> {
        let cell = CELL_M * (f64::from(COLLAPSE_POINTS) / f64::from(self.points)).cbrt();
        let mut scene = json!({
            "title": "collapse",
            "channel": {
                "inclination_deg": 0, "incline_length_m": 0.5, "runout_length_m": 1,
                "width_m": 0.25, "base_friction": 0.5, "side_friction": 0
            },
            "flow": {
                "volume_m3": 0.025,
                "release": {"height_m": 0.2, "toe_distance_m": 0},
                "material": {
                    "bulk_density_kg_m3": 1550, "youngs_modulus_pa": 1e6, "poissons_ratio": 0.3,
                    "static_friction": 0.5774, "limiting_friction": 0.5774
                }
            },
            "bodies": [],
            "numerics": {
                "cell_size_m": cell,
                "points_per_cell": 8,
                "precision": if self.double { "double" } else { "single" }
            },
            "duration_s": NEVER_S,
            "sample_interval_s": NEVER_S,
            "flow_snapshots": 0
        });
        if self.every_substep {
            scene["numerics"]["flow_courant"] = json!(EVERY_SUBSTEP);
        }
        read(&scene)
    }
}

/// The source paper's channel, with or without its cube.
pub(super) fn channel(cube: bool, cell_m: f64) -> Result<Scenario, Failure> {
    let mut scene = source_paper(cell_m)?;
    if !cube {
        scene["bodies"] = json!([]);
    }
    read(&scene)
}

/// The source paper's channel with small cubes in rows of five instead of its
/// own cube.
pub(super) fn small_cubes(count: usize, cell_m: f64) -> Result<Scenario, Failure> {
    let mut scene = source_paper(cell_m)?;
    let (distance, side) = SMALL_CUBES_M;
    let cube = |place: usize| {
        // The first stands on the centre line.
        let column = (place + ABREAST / 2) % ABREAST;
        let row = place / ABREAST;
        json!({
            "shape": {"cube": {"side_m": side}},
            "position": {
                "downstream_m": side + row as f64 * distance,
                "lateral_m": (column as f64 - (ABREAST / 2) as f64) * distance
            }
        })
    };
    scene["bodies"] = (0..count).map(cube).collect();
    read(&scene)
}

/// Cubes, boxes and tetrahedra dropped obliquely into a pit, in layers of at most 4 x 4.
pub(super) fn heap(count: usize) -> Result<Scenario, Failure> {
    let shapes = [
        json!({"cube": {"side_m": 0.04}}),
        json!({"box": {"sides_m": [0.03, 0.04, 0.05]}}),
        json!({"regular": {"solid": "tetrahedron", "size_m": 0.05}}),
    ];
    let abreast = if count > 10 { 4 } else { 2 };
    let distance = 0.08;
    let side = abreast as f64 * distance;
    let along = |place: usize| (place as f64 + 0.5) * distance - 0.5 * side;
    let body = |place: usize| {
        let (layer, spot) = (place / (abreast * abreast), place % (abreast * abreast));
        let (sin, cos) = (0.3 + 0.4 * place as f64).sin_cos();
        json!({
            "shape": shapes[place % shapes.len()],
            "position": {
                "downstream_m": along(spot % abreast),
                "lateral_m": along(spot / abreast),
                "elevation_m": 0.04 + distance * layer as f64
            },
            "orientation": [cos, 0.48 * sin, 0.6 * sin, 0.64 * sin]
        })
    };
    // A channel has three walls; a barrier is the fourth.
    let barrier = json!({
        "shape": {"box": {"sides_m": [0.02, side - 1e-3, 1.0]}},
        "position": {"downstream_m": 0.5 * side + 0.01, "elevation_m": 0.5},
        "fixed": true
    });
    let bodies: Vec<Value> = (0..count).map(body).chain([barrier]).collect();
    read(&json!({
        "channel": {"inclination_deg": 0, "incline_length_m": 0.5 * side,
                    "runout_length_m": 1, "width_m": side},
        "flow": null,
        "bodies": bodies,
        "duration_s": NEVER_S,
        "sample_interval_s": 1e-3 * NEVER_S
    }))
}

fn source_paper(cell_m: f64) -> Result<Value, Failure> {
    let mut scene: Value = serde_json::from_str(CHANNEL)?;
    scene["numerics"]["cell_size_m"] = json!(cell_m);
    scene["flow_snapshots"] = json!(0);
    Ok(scene)
}

fn read(scene: &Value) -> Result<Scenario, Failure> {
    Scenario::from_json(&scene.to_string())
        .map_err(|error| Failure::Other(format!("a scene of the bench is refused: {error:?}")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use scree_solver::Simulation;
    use scree_solver::simulation::PreparedScene;

    #[test]
    fn every_scene_is_legal() {
        for points in [1_000, 10_000, COLLAPSE_POINTS, 10_000_000] {
            let scenario = Collapse::of(points).scenario().unwrap();
            assert!(PreparedScene::of(&scenario).is_ok(), "{points}");
        }
        for cubes in [0, 1, 10, 100] {
            let scenario = small_cubes(cubes, 0.0125).unwrap();
            assert_eq!(scenario.bodies.len(), cubes);
        }
        for bodies in [1, 10, 100] {
            assert_eq!(heap(bodies).unwrap().bodies.len(), bodies + 1);
        }
        assert_eq!(channel(true, 0.01).unwrap().bodies.len(), 1);
        assert_eq!(channel(false, 0.01).unwrap().bodies.len(), 0);
    }

    #[test]
    fn the_collapse_has_about_the_points_asked_for() {
        for points in [4_000, 50_000] {
            let scenario = Collapse::of(points).scenario().unwrap();
            let simulation = Simulation::new(&scenario, 1).unwrap();
            let ratio = simulation.point_count() as f64 / f64::from(points);
            assert!((0.8..1.25).contains(&ratio), "{points}: {ratio}");
        }
    }
}
