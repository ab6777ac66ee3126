use super::*;

/// Front of ten points a centimetre apart, the foremost at 0, each spread over that.
fn front_beyond(share: f64) -> f64 {
    let places: Vec<(f64, f64)> = (0..10).map(|k| (-0.01 * f64::from(k), 2.0)).collect();
    beyond(&places, 0.01, 20.0 * share).expect("there is as much")
}

#[test]
fn the_front_may_lie_within_a_point() {
    for share in [1e-3, 0.05, 0.1, 0.25, 0.999] {
        let found = front_beyond(share);
        assert!(
            (found - (0.005 - 0.1 * share)).abs() < 1e-12,
            "{share}: {found}"
        );
    }
    assert_eq!(beyond(&[(0.0, 1.0)], 0.01, 1.1), None);
    let overlapping = [(0.0, 1.0), (0.002, 1.0)];
    let found = beyond(&overlapping, 0.01, 0.4).expect("there is as much");
    // 0.2 kg in the first 2 mm, then twice as dense.
    assert!((found - 0.004).abs() < 1e-12, "{found}");
}
