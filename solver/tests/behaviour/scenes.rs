//! Small scenes as JSON, and measurements on them.

use scree_solver::math::Vec3;
use scree_solver::points::Point;
use scree_solver::scenario::Scenario;
use scree_solver::{Simulation, StepError, SubstepReport};
use serde_json::{Value, json};
use std::ops::ControlFlow;

/// Precisions in which a flow can be computed.
pub(crate) const PRECISIONS: [&str; 2] = ["double", "single"];

/// A scenario under construction.
#[derive(Debug, Clone)]
pub(crate) struct Scene(Value);

impl Scene {
    /// A channel without flow and bodies.
    pub(crate) fn channel(
        inclination_deg: f64,
        incline_m: f64,
        runout_m: f64,
        width_m: f64,
    ) -> Self {
        Self(json!({
            "channel": {"inclination_deg": inclination_deg, "incline_length_m": incline_m,
                        "runout_length_m": runout_m, "width_m": width_m},
            "flow": null, "bodies": []
        }))
    }

    /// The source paper's kind of scene, narrow and coarse: a release of
    /// two litres on 40° strikes a cube of two cells a side at the foot.
    pub(crate) fn impact() -> Self {
        Self::channel(40.0, 1.0, 1.0, 0.12)
            .flow(json!({"volume_m3": 0.002, "release": {"height_m": 0.1, "toe_distance_m": 0.0}}))
            .body(json!({"shape": {"cube": {"side_m": 0.04}},
                         "position": {"downstream_m": 0.04}}))
            .set("numerics", "cell_size_m", 0.02)
            .lasting(0.3)
    }

    /// The minimal scenario of the repository.
    pub(crate) fn minimal() -> Self {
        let text = include_str!("../../../configs/scenarios/minimal.json");
        Self(serde_json::from_str(text).expect("it is JSON"))
    }

    /// Sets `key` of the section (a top-level object, made if missing).
    pub(crate) fn set(mut self, part: &str, key: &str, value: impl Into<Value>) -> Self {
        self.0[part][key] = value.into();
        self
    }

    /// A scenario as it is written.
    pub(crate) fn of(scenario: Value) -> Self {
        Self(scenario)
    }

    /// Sets a field of the first body.
    pub(crate) fn first_body(self, key: &str, value: impl Into<Value>) -> Self {
        self.body_field(0, key, value)
    }

    /// Sets a field of a body.
    pub(crate) fn body_field(mut self, body: usize, key: &str, value: impl Into<Value>) -> Self {
        self.0["bodies"][body][key] = value.into();
        self
    }

    /// The flow, or null.
    pub(crate) fn flow(mut self, flow: Value) -> Self {
        self.0["flow"] = flow;
        self
    }

    /// The scene in single or double precision.
    pub(crate) fn precision(self, word: &str) -> Self {
        self.set("numerics", "precision", word)
    }

    /// The scene with all of the flow computed.
    pub(crate) fn full(self) -> Self {
        self.set("numerics", "symmetry", "full")
            .set("numerics", "approach", "full")
    }

    /// The scene with one more body.
    pub(crate) fn body(mut self, body: Value) -> Self {
        if let Some(bodies) = self.0["bodies"].as_array_mut() {
            bodies.push(body);
        }
        self
    }

    /// The scene without its bodies.
    pub(crate) fn without_bodies(mut self) -> Self {
        self.0["bodies"] = json!([]);
        self
    }

    /// Simulated time [s].
    pub(crate) fn lasting(mut self, duration_s: f64) -> Self {
        self.0["duration_s"] = duration_s.into();
        self
    }

    /// The validated scenario.
    pub(crate) fn scenario(&self) -> Scenario {
        Scenario::from_json(&self.0.to_string()).unwrap_or_else(|error| panic!("{error:?}"))
    }

    /// The simulation, set up on one thread.
    pub(crate) fn start(&self) -> Simulation {
        Simulation::new(&self.scenario(), 1).expect("the scene fits")
    }

    /// The simulation, run to its end on one thread.
    pub(crate) fn finished(&self) -> Simulation {
        let mut simulation = self.start();
        run(&mut simulation, f64::INFINITY);
        simulation
    }
}

/// Continues a run without an observer.
pub(crate) fn run(simulation: &mut Simulation, until_s: f64) {
    watch(simulation, until_s, |_, _| {}).expect("the scene runs");
}

/// Continues a run, with an observer of every sub-step.
pub(crate) fn watch(
    simulation: &mut Simulation,
    until_s: f64,
    mut look: impl FnMut(&Simulation, &SubstepReport) + Send,
) -> Result<(), StepError> {
    simulation.run(until_s, |simulation, report| {
        look(simulation, report);
        ControlFlow::Continue(())
    })?;
    Ok(())
}

/// The points by identity.
pub(crate) fn points_by_id(simulation: &Simulation) -> Vec<Point> {
    let mut points = simulation.points();
    points.sort_unstable_by_key(|point| point.id);
    points
}

/// Velocity of the flow's mass centre [m/s].
pub(crate) fn mean_velocity(simulation: &Simulation) -> Vec3 {
    let points = simulation.points();
    let mass: f64 = points.iter().map(|point| point.mass).sum();
    let momentum: Vec3 = points.iter().map(|point| point.velocity * point.mass).sum();
    momentum / mass
}
