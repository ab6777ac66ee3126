use super::*;
use crate::rigid::fixture::cuboid;

/// The cube at (x, 0, 0), moving along x.
fn at(x: f64, speed: f64) -> Body {
    let mut body = cuboid([0.04; 3]);
    body.state.position.x = x;
    body.state.momentum.x = body.mass * speed;
    body
}

fn history(seen: &[(f64, f64, f64)]) -> BodyOutcome {
    let mut history = BodyHistory::start(&at(0.0, 0.0), 9.81);
    for &(time_s, x, speed) in seen {
        let body = at(x, speed);
        history.take_in(&body, &Motion::of(&body), time_s);
    }
    history.outcome(&at(0.0, 0.0))
}

#[test]
fn what_never_moved_has_no_times() {
    let outcome = history(&[(0.1, 0.0, 0.0), (0.2, 5e-5, 5e-4)]);
    assert_eq!(outcome.onset_time_s, None);
    assert_eq!(outcome.stop_time_s, None);
    assert_eq!(outcome.displacement_m, 5e-5);
    let outcome = BodyHistory::start(&at(0.0, 0.0), 9.81).outcome(&at(0.0, 0.0));
    assert_eq!(
        (outcome.peak_speed_m_s, outcome.peak_speed_time_s),
        (0.0, None)
    );
}

// Onset is where the path crosses a millimetre between 0.5 and 2.
#[test]
fn onset_peak_and_stop_are_where_they_were_seen() {
    let outcome = history(&[
        (0.01, 5e-4, 0.1),
        (0.02, 2e-3, 0.5),
        (0.03, 0.05, 0.4),
        (0.04, 0.06, 5e-4),
        (0.05, 0.055, 0.1),
        (0.06, 0.05, 0.0),
        (0.3, 0.05, 0.0),
    ]);
    let onset = outcome.onset_time_s.expect("it set off");
    assert!((onset - 0.01333).abs() < 1e-4, "{onset}");
    assert!((outcome.peak_speed_m_s - 0.5).abs() < 1e-15);
    assert_eq!(outcome.peak_speed_time_s, Some(0.02));
    assert_eq!(outcome.stop_time_s, Some(0.06), "a pause is no stop");
    assert!((outcome.displacement_m - 0.05).abs() < 1e-15);
    assert!((outcome.path_length_m - 0.07).abs() < 1e-15);
}

#[test]
fn what_still_moves_has_not_stopped() {
    let outcome = history(&[(0.1, 0.01, 0.1), (0.2, 0.02, 2e-3)]);
    assert_eq!(outcome.stop_time_s, None);
}

// Displacement is horizontal; the path is not.
#[test]
fn a_fall_is_no_displacement() {
    let mut history = BodyHistory::start(&at(0.0, 0.0), 9.81);
    let mut fallen = at(0.0, 0.0);
    fallen.state.position.z = -2.0;
    history.take_in(&fallen, &Motion::of(&fallen), 0.5);
    let outcome = history.outcome(&at(0.0, 0.0));
    assert_eq!((outcome.displacement_m, outcome.path_length_m), (0.0, 2.0));
    assert!(outcome.onset_time_s.is_some_and(|onset| onset < 3e-4));
}

// Its longest side is along z, about which it resists turning least.
#[test]
fn mass_properties_are_those_of_the_body() {
    let body = cuboid([0.02, 0.04, 0.06]);
    let properties = BodyHistory::start(&body, 9.81)
        .outcome(&body)
        .mass_properties;
    assert_eq!(properties.mass_kg, body.mass);
    assert_eq!(properties.volume_m3, body.shape.volume());
    let moments = [2, 1, 0].map(|axis| body.inertia[(axis, axis)]);
    for (got, wanted) in properties.principal_moments_kg_m2.iter().zip(moments) {
        assert!((got / wanted - 1.0).abs() < 1e-12, "{got} {wanted}");
    }
    let [least, ..] = properties.principal_axes;
    assert!((Vec3::from(least) - Vec3::z()).norm() < 1e-12, "{least:?}");
}
