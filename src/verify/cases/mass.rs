//! Case 2: mass properties of rounded cubes.
//!
//! A cube of side L rounded with r is a cube of side a = L − 2r swept by a ball
//! of r. It falls apart into the core, six slabs on its faces, twelve quarter
//! cylinders along its edges and eight octants of a ball (Steiner 1840):
//!
//! V = a³ + 6 a² r + 3π a r² + 4/3 π r³
//!
//! and ∫ x² dV is, part by part,
//!
//! core a⁵/12, slabs across x ⅔ a² [(a/2 + r)³ − (a/2)³], slabs along x a⁴ r/3,
//! edges along x π r² a³/12, edges across x 2a [π r² a²/4 + 4/3 a r³ + π r⁴/4],
//! octants π a² r³/3 + π a r⁴/2 + 4/15 π r⁵;
//!
//! the moment of inertia is ρ times twice that. The solver integrates any convex
//! core instead, over its faces, edges and vertices. Bars: 1e-4 against the
//! design's table, whose figures have five digits; rounding, 1e-12, against the
//! closed form.

use crate::verify::findings::{Findings, Question, Resolution};
use crate::verify::run::{Answer, Cost, Trouble};
use crate::verify::{Case, Effort, How};
use scree_solver::shape::SpheroPolyhedron;
use std::f64::consts::PI;
use std::time::Instant;

pub(super) const CASE: Case = Case {
    name: "mass",
    number: "2",
    title: "volume and inertia of cubes with rounded edges",
    source: "Steiner's decomposition: the design's table, and summed in closed form",
    how: How::Runs(run),
};

const SIDE: f64 = 0.04;

/// Radius [m], V/L³ and I/(ρ L⁵/6).
const TABLE: [(f64, [f64; 2]); 3] = [
    (0.004, [0.97559, 0.94807]),
    (0.002, [0.99373, 0.98603]),
    (0.001, [0.99841, 0.99638]),
];

fn run(_: Effort, findings: &mut Findings) {
    for (radius, table) in TABLE {
        let resolution = Resolution::named(format!("r {:.0} mm", radius * 1e3));
        let sources = [
            ("table", table, 1e-4),
            ("closed form", closed(radius), 1e-12),
        ];
        for (source, [volume, inertia], bar) in sources {
            let questions = [
                Question::new(format!("V/L³, {source}"), "", volume).within(bar),
                Question::new(format!("I/(ρL⁵/6), {source}"), "", inertia).within(bar),
            ];
            findings.take(&resolution, questions, measured(radius));
        }
    }
}

fn measured(radius: f64) -> Result<Answer<2>, Trouble> {
    let start = Instant::now();
    let cube =
        SpheroPolyhedron::cube(SIDE, radius).map_err(|error| Trouble::Scene(error.to_string()))?;
    let inertia = cube.unit_inertia().m11;
    let values = [cube.volume() / SIDE.powi(3), inertia * 6.0 / SIDE.powi(5)];
    let cost = Cost {
        wall_s: start.elapsed().as_secs_f64(),
        point_steps_per_s: None,
    };
    Ok(Answer { values, cost })
}

/// V/L³ and I/(ρ L⁵/6) of the head comment.
fn closed(r: f64) -> [f64; 2] {
    let a = SIDE - 2.0 * r;
    let volume = a.powi(3) + 6.0 * a * a * r + 3.0 * PI * a * r * r + 4.0 / 3.0 * PI * r.powi(3);
    let slabs_across = 2.0 / 3.0 * a * a * ((0.5 * a + r).powi(3) - (0.5 * a).powi(3));
    let slabs_along = a.powi(4) * r / 3.0;
    let edges_along = PI * r * r * a.powi(3) / 12.0;
    let edges_across =
        2.0 * a * (PI * r * r * a * a / 4.0 + 4.0 / 3.0 * a * r.powi(3) + PI * r.powi(4) / 4.0);
    let octants =
        PI * a * a * r.powi(3) / 3.0 + PI * a * r.powi(4) / 2.0 + 4.0 / 15.0 * PI * r.powi(5);
    let second =
        a.powi(5) / 12.0 + slabs_across + slabs_along + edges_along + edges_across + octants;
    [volume / SIDE.powi(3), 2.0 * second * 6.0 / SIDE.powi(5)]
}
