//! Case 6: a cube on an incline.
//!
//! It slides at a = g (sin θ − μ cos θ) if tan θ > μ, sticks if tan θ < μ
//! (Coulomb 1781), and tips if the line of its weight passes the lowest line on which it
//! stands, the end of its rounded lower edge: tan θ = (L/2 − r)/(L/2), which
//! is 43.53 / 41.99 / 38.66° for r = 1 / 2 / 4 mm and L = 40 mm. Tolerances: 0.1 % of the
//! acceleration, once the contacts have settled; 1e-6 m of creep in the 5 s after
//! the oscillation of the springs has decayed; 0.3°, with the angle found by bisection.

use crate::verify::findings::{Error, Findings, Question, Resolution};
use crate::verify::run::{Answer, CaseError, Cost, Run, scene_of};
use crate::verify::scenes::{GRAVITY, channel, downhill};
use crate::verify::{Case, Effort, How};
use scree_solver::Simulation;
use serde_json::json;

pub(super) const CASE: Case = Case {
    name: "cube-on-incline",
    number: "6",
    title: "a cube on an incline slides, sticks, tips",
    source: "a = g (sin θ − μ cos θ) (Coulomb 1781); tipping at tan θ = 1 − 2r/L (statics)",
    how: How::Runs(run),
};

const SIDE: f64 = 0.04;
/// Time in which the oscillation of the springs decays [s].
const SETTLED: f64 = 0.2;

fn run(effort: Effort, findings: &mut Findings) {
    let own = Resolution::named("own steps");
    for &(angle, friction) in effort.take(&[(35.0, 0.25), (20.0, 0.25), (60.0, 0.5)], 2) {
        let (sin, cos) = f64::to_radians(angle).sin_cos();
        let exact = GRAVITY * (sin - friction * cos);
        let quantity = format!("acceleration at {angle}°, μ {friction}");
        let question = Question::new(quantity, "m/s²", exact).within(1e-3);
        findings.take(&own, [question], acceleration(angle, friction));
    }
    for &(angle, friction) in effort.take(&[(25.0, 0.6), (25.0, 0.48), (35.0, 0.8)], 1) {
        let quantity = format!("creep in 5 s at {angle}°, μ {friction}");
        let question = Question::new(quantity, "m", 0.0);
        let question = question.by(Error::Absolute).within(1e-6);
        findings.take(&own, [question], creep(angle, friction));
    }
    for radius in [0.001, 0.002, 0.004] {
        let exact = ((0.5 * SIDE - radius) / (0.5 * SIDE)).atan().to_degrees();
        let quantity = format!("tips past, r {:.0} mm", radius * 1e3);
        let question = Question::new(quantity, "°", exact);
        let question = question.by(Error::Absolute).within(0.3);
        findings.take(&own, [question], tipping_angle(radius, exact));
    }
}

/// A cube resting flat on a slope 4 m long, 0.3 m below its top.
fn on_slope(angle: f64, friction: f64, radius: f64, duration: f64) -> Result<Run, CaseError> {
    let mut document = channel(angle, 4.0, 1.0, 0.2);
    document["bodies"] = json!([{
        "shape": {"cube": {"side_m": SIDE}}, "sphero_radius_m": radius,
        "position": {"downstream_m": -3.7}, "friction": friction
    }]);
    document["duration_s"] = json!(duration);
    Run::start(scene_of(&document)?)
}

fn acceleration(angle: f64, friction: f64) -> Result<Answer<1>, CaseError> {
    let mut run = on_slope(angle, friction, 0.002, 0.8)?;
    let along = |simulation: &Simulation| simulation.bodies()[0].velocity().dot(&downhill(angle));
    let acceleration = run.acceleration(SETTLED, f64::INFINITY, along)?;
    Ok(run.answer([acceleration]))
}

fn creep(angle: f64, friction: f64) -> Result<Answer<1>, CaseError> {
    let mut run = on_slope(angle, friction, 0.002, 5.0 + SETTLED)?;
    run.to(SETTLED)?;
    let start = run.simulation.bodies()[0].state.position;
    run.to(f64::INFINITY)?;
    let way = run.simulation.bodies()[0].state.position - start;
    Ok(run.answer([way.norm()]))
}

/// Angle between staying and tipping [°], to 1/32 of a degree.
fn tipping_angle(radius: f64, guess: f64) -> Result<Answer<1>, CaseError> {
    let (mut stays, mut tips) = (guess - 1.0, guess + 1.0);
    let mut wall_s = 0.0;
    for _ in 0..6 {
        let middle = 0.5 * (stays + tips);
        let turned = turned(middle, radius)?;
        wall_s += turned.cost.wall_s;
        if turned.values[0] > 0.1 {
            tips = middle;
        } else {
            stays = middle;
        }
    }
    let cost = Cost {
        wall_s,
        point_steps_per_s: None,
    };
    let values = [0.5 * (stays + tips)];
    Ok(Answer { values, cost })
}

/// Rotation of the cube within a second, held by high friction [rad].
fn turned(angle: f64, radius: f64) -> Result<Answer<1>, CaseError> {
    let mut run = on_slope(angle, 5.0, radius, 1.0)?;
    let start = run.simulation.bodies()[0].state.orientation;
    run.to(f64::INFINITY)?;
    let end = run.simulation.bodies()[0].state.orientation;
    Ok(run.answer([end.angle_to(&start)]))
}
