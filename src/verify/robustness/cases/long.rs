//! Long runs: a bed at rest, and a layer in steady shear.

use super::strike;
use crate::verify::Effort;
use crate::verify::robustness::trial::{Compared, Ended, Special};
use crate::verify::robustness::{Family, Member};
use crate::verify::run::{CaseError, Run, scenario_of};
use crate::verify::slope::Slope;
use scree_solver::Simulation;
use scree_solver::scenario::Scenario;
use serde_json::{Value, json};
use std::ops::ControlFlow;

pub(super) const FAMILY: Family = Family {
    name: "long runs",
    reason: "what adds up: creep and heating of a bed at rest over 1,000,000 sub-steps (quick: \
             20,000), volume and stress of a layer in 10 s of shear (quick: 3 s)",
    members,
};

const REST: u64 = 1_000_000;
const QUICK_REST: u64 = 20_000;
/// Largest displacement of any point or body at rest, from a tenth of the run to its end [cells].
const CREEP: f64 = 0.01;
/// Duration of the shear [s].
const SHEAR: f64 = 10.0;
const QUICK_SHEAR: f64 = 3.0;
/// Largest change of height and shear stress from the fourth to the last tenth: a
/// layer that starts with its profile takes a second to settle.
const DRIFT: f64 = 0.02;

fn members(effort: Effort) -> Vec<Member> {
    match effort {
        Effort::Quick => vec![
            Member::Other("bed and cube at rest", || rest(QUICK_REST)),
            Member::Other("layer in shear", || shear(QUICK_SHEAR)),
        ],
        Effort::Full => vec![
            Member::Other("bed and cube at rest", || rest(REST)),
            Member::Other("layer in shear", || shear(SHEAR)),
        ],
    }
}

/// A bed from wall to wall on a slope of 10°, with a cube in it: nothing moves.
fn bed() -> Value {
    let mut scenario = strike(0.0);
    scenario["channel"]["incline_length_m"] = json!(0.12);
    scenario["flow"] = json!({"volume_m3": 0.12 * 0.12 * 0.08,
        "release": {"height_m": 0.08, "toe_distance_m": 0.0}});
    scenario["channel"]["runout_length_m"] = json!(0.3);
    scenario["bodies"][0]["position"]["downstream_m"] = json!(0.2);
    scenario["duration_s"] = json!(3600.0);
    scenario["sample_interval_s"] = json!(0.5);
    scenario
}

fn rest(substeps: u64) -> Special {
    match scenario_of(&bed()).and_then(|scenario| at_rest(&scenario, substeps)) {
        Ok(compared) => Special {
            ended: Ended::Finished,
            compared,
        },
        Err(error) => failed(error),
    }
}

fn failed(error: CaseError) -> Special {
    Special {
        ended: match error {
            CaseError::Step(error) => Ended::Failed(error),
            other => Ended::Refused(other.to_string()),
        },
        compared: Vec::new(),
    }
}

fn at_rest(scenario: &Scenario, substeps: u64) -> Result<Vec<Compared>, CaseError> {
    let mut simulation = Simulation::new(scenario, 1)?;
    // The front collapses first: the deposit afterwards is the bed.
    go(&mut simulation, substeps / 10)?;
    let settled = places(&simulation);
    let energy = simulation.audit().energy_rise();
    go(&mut simulation, substeps)?;
    let cell = simulation.cell_size_m();
    let last = places(&simulation);
    let ways = settled.iter().zip(&last).map(|(one, other)| {
        let way = [0, 1, 2].map(|axis| one.1[axis] - other.1[axis]);
        way.iter().map(|part| part * part).sum::<f64>().sqrt()
    });
    let ways: Vec<f64> = ways.collect();
    let farthest = ways.iter().copied().fold(0.0, f64::max);
    let mean = ways.iter().sum::<f64>() / ways.len() as f64;
    let mut fastest = 0.0f64;
    simulation.visit_points(None, |point| fastest = fastest.max(point.velocity.norm()));
    let audit = simulation.audit();
    let tell = |what: &str, found: f64, bound| Compared {
        what: what.to_owned(),
        found,
        bound,
    };
    Ok(vec![
        tell("sub-steps", simulation.counts().1 as f64, None),
        tell("simulated time [s]", simulation.time_s(), None),
        tell("mean creep of a point [cells]", mean / cell, Some(CREEP)),
        tell("largest creep [cells]", farthest / cell, None),
        tell("fastest point at the end [m/s]", fastest, None),
        tell(
            "energy made since [of the scale]",
            (audit.energy_rise() - energy) / audit.energy_scale(),
            Some(1e-3),
        ),
        tell("momentum residual", audit.momentum_residual, Some(1e-6)),
        tell("mass error", audit.mass_error, Some(1e-9)),
    ])
}

fn go(simulation: &mut Simulation, substeps: u64) -> Result<(), CaseError> {
    simulation.run(f64::INFINITY, |_, report| {
        if report.substeps >= substeps && report.step_ended {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    })?;
    Ok(())
}

/// Position of every point and body, by identity [m].
fn places(simulation: &Simulation) -> Vec<(u32, [f64; 3])> {
    let mut places = Vec::with_capacity(simulation.point_count());
    simulation.visit_points(None, |point| places.push((point.id, point.position.into())));
    places.sort_unstable_by_key(|(id, _)| *id);
    let bodies = simulation.bodies().iter();
    places.extend(bodies.map(|body| (u32::MAX, body.state.position.into())));
    places
}

/// Height of the mass centre and mean shear stress over a window.
#[derive(Debug, Clone, Copy, Default)]
struct Window {
    height: f64,
    stress: f64,
    density: f64,
    looks: f64,
}

fn shear(duration: f64) -> Special {
    match sheared(duration) {
        Ok(compared) => Special {
            ended: Ended::Finished,
            compared,
        },
        Err(error) => failed(error),
    }
}

fn sheared(duration: f64) -> Result<Vec<Compared>, CaseError> {
    let slope = Slope {
        inclination_deg: 24.0,
        cells: 8,
        per_cell: 2,
        start_deg: 24.0,
        duration,
    };
    let mut run = Run::start(slope.scene())?;
    run.to(0.3 * duration)?;
    let first = window(&mut run, 0.4 * duration)?;
    run.to(0.9 * duration)?;
    let last = window(&mut run, duration)?;
    let change = |of: fn(&Window) -> f64| of(&last) / of(&first) - 1.0;
    let tell = |what: &str, found: f64, bound| Compared {
        what: what.to_owned(),
        found,
        bound,
    };
    Ok(vec![
        tell("sub-steps", run.simulation.counts().1 as f64, None),
        tell(
            "change of the mass centre's height",
            change(|window| window.height),
            Some(DRIFT),
        ),
        tell(
            "change of the shear stress",
            change(|window| window.stress),
            Some(DRIFT),
        ),
        tell(
            "change of the mean density",
            change(|window| window.density),
            Some(DRIFT),
        ),
    ])
}

fn window(run: &mut Run, to: f64) -> Result<Window, CaseError> {
    let mut sum = Window::default();
    run.watch(to, |simulation, report| {
        if report.step_ended {
            let (mut mass, mut volume) = (0.0, 0.0);
            simulation.visit_points(None, |point| {
                sum.height += point.mass * point.position.z;
                sum.stress += point.volume * point.stress.xz;
                mass += point.mass;
                volume += point.volume;
            });
            sum.density += mass / volume;
            sum.looks += 1.0;
        }
        ControlFlow::Continue(())
    })?;
    for part in [&mut sum.height, &mut sum.stress, &mut sum.density] {
        *part /= sum.looks;
    }
    Ok(sum)
}
