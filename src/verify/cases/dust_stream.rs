//! Case 10a: dust streams onto a fixed cube.
//!
//! The stream is so thin that its points interact only with the cube: they
//! have a quarter of the mass that would fill their volume, and no stress.
//! Points that hit the cube lose their momentum, and the force is that of a plastic impact,
//!
//! F = ρ v² A.
//!
//! Dust that was stopped stays there, since no scene can remove it, and the
//! pile bears load once it is four times as dense. So the force is taken between
//! two and six cells of travel after the first contact, when the kernel has filled
//! and at most a cell and a half of beads is there; the force from six to ten is shown
//! as well. A thinner stream would pile up less, but at a tenth of the density and
//! below runs break off with a non-finite point, even with sub-steps shorter
//! by as much, in single and double precision; the cause is not known yet. No gravity,
//! no friction, restitution 0; the stream is eight cells wider than the cube, whose
//! faces lie on nodes.
//!
//! The grid also slows points that pass beside the cube. If all of the stream within a
//! distance s of the cube were stopped, F = ρ v² (L + 2 s)²: s is given in cells. The spheres of
//! the points (R_p = 0.31 cells at eight points per cell) cause part of it; with a tenth
//! of their radius the rest is seen. No tolerance.

use crate::verify::beads;
use crate::verify::findings::{Error, Findings, Question, Resolution};
use crate::verify::run::Answer;
use crate::verify::stream::{SIDE, Stream};
use crate::verify::{Case, Effort, How};

pub(super) const CASE: Case = Case {
    name: "dust-stream",
    number: "10a",
    title: "force of a stream of dust on a fixed cube",
    source: "F = ρ v² A (momentum of a plastic impact)",
    how: How::Runs(run),
};

/// Cells per side of the cube.
const CELLS: [u32; 5] = [1, 2, 4, 8, 16];
/// Density over that of beads in touch.
const SHARE: f64 = 0.25;
/// Travels between which forces are averaged [cells].
const FROM: f64 = 2.0;
const WINDOWS: [f64; 2] = [6.0, 10.0];
/// Radius of the points' spheres over R_p, in words and as a number.
const SPHERES: [(&str, f64); 2] = [("R_p", 1.0), ("R_p/10", 0.1)];

fn run(effort: Effort, findings: &mut Findings) {
    for (word, sphere) in SPHERES {
        let force = format!("force over ρ v² A, 2–6 cells, {word}");
        for &cells in effort.take(&CELLS, 2) {
            let label = format!("{cells} cells a side");
            let resolution = Resolution::sized(label, SIDE / f64::from(cells));
            let stand_off = |window: &str| {
                Question::new(format!("s, {window} cells, {word}"), "cells", 0.0)
                    .by(Error::Absolute)
            };
            let questions = [
                Question::new(&force, "", 1.0),
                Question::new(format!("force over ρ v² A, 6–10 cells, {word}"), "", 1.0),
                stand_off("2–6"),
                stand_off("6–10"),
            ];
            let stream = stream(cells, sphere);
            let answer = stream.forces(FROM, WINDOWS);
            let answer = answer.map(|Answer { values, cost }| {
                let over = values.map(|force| force / stream.momentum_flux());
                let [early, late] = values.map(|force| stream.stand_off(force));
                Answer {
                    values: [over[0], over[1], early, late],
                    cost,
                }
            });
            findings.take(&resolution, questions, answer);
        }
        findings.take_order(&force, 1e-3, None);
        findings.take_limit(&force);
    }
}

fn stream(cells: u32, sphere: f64) -> Stream {
    Stream {
        cells,
        wide: cells + 8,
        material: beads::with_sound_speed(10.0),
        share: SHARE,
        sphere,
        travel: 10,
    }
}
