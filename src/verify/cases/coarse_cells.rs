//! Case 19: bodies in coarse cells against their grid-converged limit.
//!
//! Scenes unlike the source paper's, so that the result does not depend on its
//! numbers: an icosahedron that rolls down a flatter slope, a cube in the path of a
//! column that collapses on a flat floor, two cubes of which the first pushes the other.
//! Every scene is computed at two grid phases, half a cell apart: the incline is longer by
//! half a cell while all else stays in place, so the problem is the same. Reference solution: the
//! mean of both phases at six cells across the body, with the difference of the phases as a measure
//! of its uncertainty. Tolerances, of the mean of both phases at 2, 3 and 4 cells: 10, 5 and
//! 2 % of the peak speed, 5, 2 and 1 % of the displacement. The small version has three
//! cells for its reference solution, which is no limit, and so no tolerances.

use crate::verify::findings::{Error, Findings, Question, Resolution};
use crate::verify::on_all_cores::side_by_side;
use crate::verify::run::{Answer, CaseError, Cost};
use crate::verify::with_error_bars::answer;
use crate::verify::{Case, Effort, How};
use serde_json::{Value, json};

pub(super) const CASE: Case = Case {
    name: "coarse-cells",
    number: "19",
    title: "bodies in coarse cells against their own limit",
    source: "the mean over two grid phases of the same scene in the finest cells",
    how: How::Runs(run),
};

/// Quantities measured on a scene's first body, and their units.
const QUANTITIES: [(&str, &str); 2] = [("peak speed", "m/s"), ("displacement", "m")];
/// Cells across a body, and the largest errors of both quantities.
const CELLS: [(f64, [f64; 2]); 3] = [(2.0, [0.1, 0.05]), (3.0, [0.05, 0.02]), (4.0, [0.02, 0.01])];
/// Cells across a body for the reference solution.
const FINEST: f64 = 6.0;
/// Shifts of the slope break against the nodes [cells].
const PHASES: [f64; 2] = [0.0, 0.5];
/// Length of every incline at phase 0 [m].
const INCLINE: f64 = 0.5;

/// A scene, and the length over which cells are counted.
struct Sized {
    name: &'static str,
    /// Smallest extent of its bodies [m].
    size: f64,
    scene: Value,
}

fn run(effort: Effort, findings: &mut Findings) {
    let judged = effort.take(&CELLS, 1);
    let finest = match effort {
        Effort::Quick => CELLS[1].0,
        Effort::Full => FINEST,
    };
    for sized in effort.take(&[icosahedron(), flat(), pushed()], 2) {
        let limit = over_phases(sized, finest);
        let references = limit.as_ref().map_or([f64::NAN; 2], |limit| limit.values.0);
        for &(cells, tolerances) in judged {
            let resolution = Resolution::sized(format!("{cells} cells"), 1.0 / cells);
            let questions = [0, 1].map(|place| {
                let (quantity, unit) = QUANTITIES[place];
                let name = format!("{quantity}, {}", sized.name);
                let question = Question::new(name, unit, references[place]);
                match effort {
                    Effort::Quick => question,
                    Effort::Full => question.within(tolerances[place]),
                }
            });
            let mean = over_phases(sized, cells).map(|both| both.mean());
            findings.take(&resolution, questions, mean);
        }
        apart(sized, finest, limit, findings);
    }
}

/// Difference of the phases of the reference solution.
fn apart(sized: &Sized, finest: f64, limit: Result<Phases, CaseError>, findings: &mut Findings) {
    let questions = QUANTITIES.map(|(quantity, unit)| {
        let name = format!("phases apart, {quantity}, {}", sized.name);
        Question::new(name, unit, 0.0).by(Error::Absolute)
    });
    let resolution = Resolution::named(format!("{finest} cells"));
    findings.take(&resolution, questions, limit.map(|both| both.apart()));
}

/// Both quantities at one number of cells.
struct Phases {
    /// Mean over the phases, and their difference.
    values: ([f64; 2], [f64; 2]),
    cost: Cost,
}

impl Phases {
    fn mean(&self) -> Answer<2> {
        Answer {
            values: self.values.0,
            cost: self.cost,
        }
    }

    fn apart(&self) -> Answer<2> {
        Answer {
            values: self.values.1,
            cost: self.cost,
        }
    }
}

fn over_phases(sized: &Sized, cells: f64) -> Result<Phases, CaseError> {
    let cell_size_m = sized.size / cells;
    let motions = side_by_side(&PHASES, |phase| {
        let mut scene = sized.scene.clone();
        scene["channel"]["incline_length_m"] = json!(INCLINE + phase * cell_size_m);
        scene["numerics"] = json!({"cell_size_m": cell_size_m});
        let outcome = answer(&scene)?;
        let body = &outcome.bodies[0];
        let values = [body.peak_speed_m_s, body.displacement_m];
        Ok((values, outcome.cost.wall_s))
    });
    let motions: Result<Vec<_>, CaseError> = motions.into_iter().collect();
    let [(one, first_s), (other, second_s)] = motions?[..] else {
        return Err(CaseError::Never("there are not two phases"));
    };
    Ok(Phases {
        values: (
            [0, 1].map(|place: usize| 0.5 * (one[place] + other[place])),
            [0, 1].map(|place: usize| (one[place] - other[place]).abs()),
        ),
        cost: Cost {
            wall_s: first_s + second_s,
            point_steps_per_s: None,
        },
    })
}

/// A solid that rolls and slides down; cells are counted between opposite faces.
fn icosahedron() -> Sized {
    let mut solid = body(0.06);
    solid["shape"] = json!({"regular": {"solid": "icosahedron", "size_m": 0.0331}});
    solid["rolling_friction"] = json!(0.1);
    Sized {
        name: "icosahedron at 40°",
        size: 0.05,
        scene: scene(40.0, 0.35, &json!({"height_m": 0.1}), &[solid]),
    }
}

/// A column that may spread both ways; the cube is as dense as the flow.
fn flat() -> Sized {
    let mut cube = body(0.04);
    cube["density_kg_m3"] = json!(1500);
    let release = json!({"height_m": 0.16, "toe_distance_m": 0.0});
    Sized {
        name: "cube on the flat",
        size: 0.04,
        scene: scene(0.0, 0.4, &release, &[cube]),
    }
}

/// Two cubes, the second two centimetres behind the first.
fn pushed() -> Sized {
    Sized {
        name: "first of two cubes at 40°",
        size: 0.04,
        scene: scene(
            40.0,
            0.35,
            &json!({"height_m": 0.1}),
            &[body(0.05), body(0.11)],
        ),
    }
}

fn scene(inclination_deg: f64, base_friction: f64, release: &Value, bodies: &[Value]) -> Value {
    json!({
        "channel": {
            "inclination_deg": inclination_deg, "incline_length_m": INCLINE,
            "runout_length_m": 1.5, "width_m": 0.2,
            "base_friction": base_friction, "side_friction": 0.0
        },
        "flow": {
            "volume_m3": 0.004, "release": release,
            "material": {
                "bulk_density_kg_m3": 1500, "grain_density_kg_m3": 2600,
                "grain_diameter_m": 0.001, "static_friction": 0.6, "limiting_friction": 0.86,
                "reference_inertial_number": 0.279, "poissons_ratio": 0.3
            }
        },
        "bodies": bodies, "duration_s": 1.2, "sample_interval_s": 0.01
    })
}

/// A cube of 4 cm on the centre line.
fn body(downstream_m: f64) -> Value {
    json!({
        "shape": {"cube": {"side_m": 0.04}}, "sphero_radius_m": 0.002, "density_kg_m3": 2000,
        "position": {"downstream_m": downstream_m, "lateral_m": 0.0},
        "friction": 0.4, "restitution": 0.3, "flow_friction": 0.4, "flow_restitution": 0.0
    })
}
