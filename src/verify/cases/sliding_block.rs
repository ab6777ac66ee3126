//! Case 9: a block of flow slides down an incline.
//!
//! A block that does not yield slides at Coulomb's acceleration
//!
//! a = g max(0, sin θ − μ cos θ)
//!
//! (Coulomb 1781). The nodes lie on no plane of the incline, so this is a test
//! of the wall between nodes. Two materials don't yield: the granular law with a
//! friction of 10, in both precisions, and the elastic test law, in double. Tolerance:
//! 1 % of g at every angle. The acceleration is taken between two times after the start,
//! far enough apart to average out the oscillation of the block.

use crate::verify::findings::{Error, Findings, Question, Resolution};
use crate::verify::run::{Answer, CaseError, Run, scene_of};
use crate::verify::scenes::{GRAVITY, PRECISIONS, channel, downhill, mean_velocity};
use crate::verify::{Case, Effort, How};
use scree_solver::Simulation;
use scree_solver::material::Yielding;
use scree_solver::scenario::Precision;
use scree_solver::simulation::Scene;
use serde_json::json;

pub(super) const CASE: Case = Case {
    name: "sliding-block",
    number: "9",
    title: "a block of flow slides down an incline the grid is not aligned with",
    source: "a = g max(0, sin θ − μ cos θ) (Coulomb 1781)",
    how: How::Runs(run),
};

const FRICTION: f64 = 0.2;
const ANGLES_DEG: [f64; 8] = [0.0, 10.0, 20.0, 30.0, 40.0, 45.0, 50.0, 60.0];
const FEWER_ANGLES_DEG: [f64; 3] = [10.0, 30.0, 60.0];

/// Times at which speeds are compared [s].
const FROM: f64 = 0.1;
const TO: f64 = 0.4;

/// A material that doesn't yield.
#[derive(Debug, Clone, Copy)]
enum Law {
    Granular(&'static str),
    Elastic,
}

impl Law {
    /// All angles, without the slow ones at quick effort.
    fn angles(self, effort: Effort) -> &'static [f64] {
        match (self, effort) {
            (Self::Granular("single"), _) | (_, Effort::Full) => &ANGLES_DEG,
            _ => &FEWER_ANGLES_DEG,
        }
    }

    fn in_words(self) -> String {
        match self {
            Self::Granular(precision) => format!("granular, {precision}"),
            Self::Elastic => "elastic, double".to_owned(),
        }
    }
}

fn run(effort: Effort, findings: &mut Findings) {
    let [double, single] = PRECISIONS.map(Law::Granular);
    for law in [double, single, Law::Elastic] {
        for &cells in effort.take(&[4, 6, 8], 1) {
            for &angle in law.angles(effort) {
                let (sin, cos) = angle.to_radians().sin_cos();
                let exact = GRAVITY * (sin - FRICTION * cos).max(0.0);
                let quantity = format!("acceleration at {angle}°, {}", law.in_words());
                let over = Error::Over {
                    of: "g",
                    size: GRAVITY,
                };
                let question = Question::new(quantity, "m/s²", exact).by(over).within(0.01);
                let size = 1.0 / f64::from(cells);
                let resolution = Resolution::sized(format!("{cells} cells thick"), size);
                findings.take(&resolution, [question], acceleration(law, angle, cells));
            }
        }
    }
}

fn acceleration(law: Law, angle: f64, cells: u32) -> Result<Answer<1>, CaseError> {
    let down = downhill(angle);
    let mut run = Run::start(block(law, angle, cells)?)?;
    let along = |simulation: &Simulation| mean_velocity(simulation).dot(&down);
    let acceleration = run.acceleration(FROM, TO, along)?;
    Ok(run.answer([acceleration]))
}

/// The block: 0.06 m thick, 0.3 m long, two cells wide between smooth walls.
fn block(law: Law, angle: f64, cells: u32) -> Result<Scene, CaseError> {
    let cos = angle.to_radians().cos();
    let (height, length) = (0.06, 0.3);
    let cell = height / f64::from(cells);
    let width = 2.0 * cell;
    let mut document = channel(angle, 1.6 * cos, 0.1, width);
    document["channel"]["base_friction"] = json!(FRICTION);
    document["flow"] = json!({
        "volume_m3": width * height * length,
        "release": {"height_m": height, "toe_distance_m": 1.1 * cos},
        "material": {"static_friction": 10.0, "limiting_friction": 10.0}
    });
    document["numerics"] = json!({"cell_size_m": cell});
    if let Law::Granular(precision) = law {
        document["numerics"]["precision"] = json!(precision);
    }
    document["duration_s"] = json!(TO);
    let mut scene = scene_of(&document)?;
    if let Law::Elastic = law {
        scene.precision = Precision::Double;
        if let Some(flow) = &mut scene.given.flow {
            flow.material.yielding = Yielding::Never;
        }
    }
    Ok(scene)
}
