//! Same scenario, same bits, in either precision: for any number of threads, any division of a
//! run, and across saved states.

use crate::scenes::{PRECISIONS, Scene, points_by_id, run};
use scree_solver::record::{Record, Recorder};
use scree_solver::scenario::{Approach, Scenario};
use scree_solver::simulation::{PreparedScene, Share};
use scree_solver::{Ending, SaveError, Simulation};
use serde_json::json;
use std::ops::ControlFlow;
use std::sync::LazyLock;

/// A run with its records.
struct Recorded {
    simulation: Simulation,
    recorder: Recorder,
    records: Vec<Record>,
}

impl Recorded {
    fn start(scenario: &Scenario, threads: usize) -> Self {
        let prepared = PreparedScene::of(scenario).expect("the scene fits");
        let mut recorder = Recorder::of(&prepared);
        let simulation = Simulation::of(prepared, threads).expect("it starts");
        let records = recorder.start(&simulation);
        Self {
            simulation,
            recorder,
            records,
        }
    }

    fn run(&mut self, until_s: f64) {
        let (recorder, records) = (&mut self.recorder, &mut self.records);
        let ending = self.simulation.run(until_s, |simulation, report| {
            records.extend(recorder.observe(simulation, report));
            ControlFlow::Continue(())
        });
        assert_eq!(ending, Ok(Ending::Reached));
    }

    /// The run saved to bytes and restored on other threads.
    fn moved(self, scenario: &Scenario, threads: usize) -> Self {
        let bytes = self.simulation.save().expect("a step ended");
        let recorder = serde_json::to_string(&self.recorder).expect("a recorder is JSON");
        drop((self.simulation, self.recorder));
        Self {
            simulation: Simulation::restore(scenario, threads, &bytes).expect("it was just saved"),
            recorder: serde_json::from_str(&recorder).expect("it was just written"),
            records: self.records,
        }
    }
}

/// Equal bits of all results of a run. `==` on floats would take −0 for 0 and is false for NaN;
/// the saved state is compared by its bytes.
fn assert_same(one: &Recorded, other: &Recorded) {
    assert!(
        one.simulation.save().expect("it ended") == other.simulation.save().expect("it ended"),
        "states differ"
    );
    assert_eq!(
        points_by_id(&one.simulation),
        points_by_id(&other.simulation)
    );
    let bytes = |run: &Recorded| serde_json::to_string(&run.records).expect("records are JSON");
    assert!(bytes(one) == bytes(other), "records differ");
    assert_eq!(one.recorder, other.recorder);
    let outcome = |run: &Recorded| {
        let mut outcome = run.recorder.outcome(&run.simulation, 1.0);
        outcome.cost.threads = 0;
        outcome
    };
    assert_eq!(outcome(one), outcome(other));
}

/// Two scenes in every precision: one with a second cube on the first, and one that
/// is computed in a slab and then by halves.
fn scenarios() -> [Scenario; 4] {
    let pile = Scene::impact()
        .set("channel", "runout_length_m", 0.2)
        .body(json!({"shape": {"cube": {"side_m": 0.04}},
            "position": {"downstream_m": 0.045, "lateral_m": 0.01, "elevation_m": 0.0601}}));
    let release = json!({"height_m": 0.1, "toe_distance_m": 0.06});
    let reduced = Scene::impact()
        .flow(json!({"volume_m3": 0.002, "release": release}))
        .first_body("position", json!({"downstream_m": 0.06}))
        .set("numerics", "symmetry", "mirror")
        .set("numerics", "approach", "slab");
    let [double, single] = PRECISIONS;
    [
        pile.clone().precision(double).scenario(),
        pile.precision(single).scenario(),
        reduced.clone().precision(double).scenario(),
        reduced.precision(single).scenario(),
    ]
}

/// The runs of these scenarios without interruption.
static UNINTERRUPTED: LazyLock<[Recorded; 4]> = LazyLock::new(|| {
    scenarios().map(|scenario| {
        let mut whole = Recorded::start(&scenario, 1);
        whole.run(0.3);
        whole
    })
});

fn each() -> impl Iterator<Item = (Scenario, &'static Recorded)> {
    scenarios().into_iter().zip(UNINTERRUPTED.iter())
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    for (scenario, one) in each() {
        assert!(one.records.len() > 30, "{}", one.records.len());
        for threads in [2, 3, 7] {
            let mut other = Recorded::start(&scenario, threads);
            assert_eq!(other.simulation.threads(), threads);
            other.run(0.3);
            assert_same(one, &other);
        }
    }
}

// The times lie at, between and off the samples every 0.01 s.
#[test]
fn a_run_in_parts_gives_the_same_bits() {
    for (scenario, whole) in each() {
        let mut parts = Recorded::start(&scenario, 2);
        for until_s in [0.0, 0.013, 0.05, 0.050_001, 0.217, 0.3] {
            parts.run(until_s);
        }
        assert_same(whole, &parts);
    }
}

#[test]
fn a_saved_run_goes_on_with_the_same_bits() {
    for (scenario, whole) in each() {
        let mut moved = Recorded::start(&scenario, 1);
        let mut shares = Vec::new();
        for (until_s, threads) in [(0.0, 2), (0.037, 3), (0.12, 1), (0.2, 2), (0.281, 1)] {
            moved.run(until_s);
            moved = moved.moved(&scenario, threads);
            shares.push(moved.simulation.share());
        }
        if scenario.numerics.approach == Approach::Slab {
            shares.dedup();
            assert_eq!(shares, [Share::Slab, Share::Half]);
        }
        moved.run(0.3);
        assert_same(whole, &moved);
    }
}

/// Continues for so many sub-steps and interrupts the run, mostly within a step.
fn break_off(run: &mut Recorded, substeps: u32) {
    let mut seen = 0;
    let (recorder, records) = (&mut run.recorder, &mut run.records);
    let ending = run.simulation.run(0.3, |simulation, report| {
        records.extend(recorder.observe(simulation, report));
        seen += 1;
        if seen < substeps {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(())
        }
    });
    assert_eq!(ending, Ok(Ending::Interrupted));
}

#[test]
fn a_run_broken_off_amid_steps_goes_on_with_the_same_bits() {
    for (scenario, whole) in each() {
        let mut parts = Recorded::start(&scenario, 1);
        let mut amid = 0;
        for substeps in [1, 1, 7, 100, 334] {
            break_off(&mut parts, substeps);
            if let Err(SaveError::AmidStep { time_s }) = parts.simulation.save() {
                assert_eq!(time_s, parts.simulation.time_s());
                amid += 1;
            }
        }
        assert!(amid > 0, "never amid a step");
        parts.run(0.3);
        assert_same(whole, &parts);
    }
}

#[test]
fn only_its_own_saved_state_is_taken_up() {
    let [scenario, in_single, ..] = scenarios();
    let mut simulation = Simulation::new(&scenario, 1).expect("the scene fits");
    run(&mut simulation, 0.01);
    let saved = simulation.save().expect("a step ended");
    let other = Scene::impact().scenario();
    assert!(Simulation::restore(&other, 1, &saved).is_err());
    assert!(Simulation::restore(&in_single, 1, &saved).is_err());
    assert!(Simulation::restore(&scenario, 1, &saved[..saved.len() / 2]).is_err());
    assert!(Simulation::restore(&scenario, 1, b"").is_err());
}
