//! Froude's law: a scene four times as large that runs twice as long is the same.

use crate::scenes::Scene;
use scree_solver::record::{BodyOutcome, Recorder};
use scree_solver::simulation::PreparedScene;
use scree_solver::{Ending, Simulation};
use serde_json::json;

/// A flow that strikes a cube and passes it, its lengths this many times as large: time of the
/// end, and the cube's outcome.
fn struck(length: f64) -> (f64, BodyOutcome) {
    let metres = |x: f64| json!(x * length);
    let scenario = Scene::channel(40.0, 0.6 * length, 1.0 * length, 0.12 * length)
        .flow(json!({
            "volume_m3": 0.0012 * length.powi(3),
            "release": {"height_m": metres(0.08), "toe_distance_m": metres(0.02)},
            "material": {"grain_diameter_m": metres(0.001)}
        }))
        .body(json!({
            "shape": {"cube": {"side_m": metres(0.04)}}, "sphero_radius_m": metres(0.002),
            "position": {"downstream_m": metres(0.05), "lateral_m": metres(0.01)}
        }))
        .set("numerics", "cell_size_m", metres(0.02))
        .precision("double")
        .set("channel", "base_friction", 0.6)
        .lasting(1.5 * length.sqrt())
        .scenario();
    let prepared = PreparedScene::of(&scenario).expect("the scene fits");
    let mut recorder = Recorder::of(&prepared);
    let mut simulation = Simulation::of(prepared, 1).expect("it starts");
    recorder.start(&simulation);
    let ending = simulation.run(f64::INFINITY, |simulation, report| {
        recorder.watch(simulation, report).1
    });
    assert_eq!(ending, Ok(Ending::Interrupted), "it never rests");
    let mut outcome = recorder.outcome(&simulation, 1.0);
    (simulation.time_s(), outcome.bodies.remove(0))
}

#[test]
fn times_scale_with_the_root_of_lengths() {
    let ((small_end, small), (large_end, large)) = (struck(1.0), struck(4.0));
    let times = [
        (
            "first contact",
            small.first_contact_time_s,
            large.first_contact_time_s,
        ),
        ("onset", small.onset_time_s, large.onset_time_s),
        ("peak", small.peak_speed_time_s, large.peak_speed_time_s),
        ("stop", small.stop_time_s, large.stop_time_s),
        ("end", Some(small_end), Some(large_end)),
    ];
    for (name, small, large) in times {
        let (small, large) = small.zip(large).unwrap_or_else(|| panic!("no {name}"));
        assert!(
            (large / small - 2.0).abs() < 2e-3,
            "{name}: {small} {large}"
        );
    }
    assert!((large.displacement_m / small.displacement_m - 4.0).abs() < 4e-3);
    assert!(small.displacement_m > 0.05, "{}", small.displacement_m);
}
