//! Case 14: momentum of flow and body against walls and gravity.
//!
//! A flow on 40° strikes a cube at the foot of the incline. The momentum of flow and body equals
//! that at the start plus every impulse of walls and gravity (Newton 1687):
//! nothing is lost between points, nodes, body and walls. The residual is that of
//! the audit, the largest over all steps, relative to all momentum present and all
//! impulses so far, and every step is audited. Tolerances: 1e-6 in
//! single, 1e-12 in double precision, for linear momentum; the residual of
//! angular momentum is shown without a tolerance.

use crate::verify::findings::{Error, Findings, Question, Resolution};
use crate::verify::run::{Answer, CaseError, Run, scene_of};
use crate::verify::scenes::{PRECISIONS, channel};
use crate::verify::{Case, Effort, How};
use serde_json::json;

pub(super) const CASE: Case = Case {
    name: "momentum-audit",
    number: "14",
    title: "momentum of flow, body, walls and gravity",
    source: "conservation of momentum (Newton 1687)",
    how: How::Runs(run),
};

fn run(effort: Effort, findings: &mut Findings) {
    for (precision, tolerance) in PRECISIONS.into_iter().zip([1e-12, 1e-6]) {
        for &cells in effort.take(&[2.0, 4.0], 1) {
            let zero = |what: &str| {
                let quantity = format!("{what} momentum residual, {precision}");
                Question::new(quantity, "", 0.0).by(Error::Absolute)
            };
            let questions = [
                zero("linear").within(tolerance),
                zero("angular"),
                Question::new(format!("steps audited, {precision}"), "", 1.0).within(0.0),
            ];
            let resolution = Resolution::named(format!("{cells} cells a cube"));
            findings.take(&resolution, questions, residuals(precision, cells));
        }
    }
}

/// Linear and angular residual, and the share of steps that ended in an audit.
fn residuals(precision: &str, cells: f64) -> Result<Answer<3>, CaseError> {
    let mut document = channel(40.0, 1.0, 1.0, 0.12);
    document["flow"] = json!({
        "volume_m3": 0.002, "release": {"height_m": 0.1, "toe_distance_m": 0.0}
    });
    document["bodies"] = json!([{
        "shape": {"cube": {"side_m": 0.04}}, "position": {"downstream_m": 0.04}
    }]);
    document["numerics"] = json!({"cell_size_m": 0.04 / cells, "precision": precision});
    document["duration_s"] = json!(0.3);
    let mut scene = scene_of(&document)?;
    scene.given.timing.audit_interval = 1;
    let mut run = Run::start(scene)?;
    let start = run.simulation.bodies()[0].state.position;
    run.to(f64::INFINITY)?;
    let moved = (run.simulation.bodies()[0].state.position - start).norm();
    if moved < 1e-3 {
        return Err(CaseError::Never("the flow never moved the cube"));
    }
    let (steps, ..) = run.simulation.counts();
    let audit = run.simulation.audit();
    let (linear, angular) = (audit.momentum_residual, audit.angular_momentum_residual);
    Ok(run.answer([linear, angular, audit.checks as f64 / steps as f64]))
}
