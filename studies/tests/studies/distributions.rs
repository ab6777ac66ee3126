//! Distributions of the inputs.

use crate::support::{kolmogorov_distance, mean, phi, z};
use scree_studies::{Distribution, SMALLEST_PROBABILITY};
use serde_json::{Value, json};

fn distribution(given: Value) -> Distribution {
    let read: Distribution = serde_json::from_value(given).unwrap();
    assert_eq!(read.violations(), []);
    read
}

/// Numbers at the middles of 4,000 equally likely parts.
fn numbers(distribution: &Distribution) -> Vec<f64> {
    let middles = (0..4000).map(|part| (f64::from(part) + 0.5) / 4000.0);
    middles.map(|u| distribution.number(u).unwrap()).collect()
}

/// Asserts that the quantiles invert a distribution function, and that the mean is theirs.
fn assert_cdf(given: Value, mean_error: f64, cdf: impl Fn(f64) -> f64) {
    let distribution = distribution(given);
    let values = numbers(&distribution);
    assert!(values.is_sorted(), "{distribution:?}");
    let distance = kolmogorov_distance(&values, cdf);
    assert!(distance < 1.3e-4, "{distribution:?}: {distance}");
    let error = distribution.mean().unwrap() - mean(&values);
    assert!(error.abs() < mean_error, "{distribution:?}: {error}");
}

#[test]
fn quantiles_invert_the_distribution_function() {
    assert_cdf(json!({"uniform": {"from": 2.0, "to": 4.0}}), 1e-9, |x| {
        (x - 2.0) / 2.0
    });
    assert_cdf(json!({"normal": {"mean": 1.0, "sd": 0.5}}), 1e-9, |x| {
        phi((x - 1.0) / 0.5)
    });
    assert_cdf(
        json!({"lognormal": {"median": 0.008, "p95": 0.012}}),
        1e-6,
        |x| phi((x / 0.008).ln() * z(0.95) / 1.5_f64.ln()),
    );
    assert_cdf(
        json!({"triangular": {"from": 0.0, "mode": 1.0, "to": 4.0}}),
        1e-4,
        |x| {
            if x < 1.0 {
                x * x / 4.0
            } else {
                1.0 - (4.0 - x).powi(2) / 12.0
            }
        },
    );
}

#[test]
fn a_truncated_normal_distribution_keeps_its_shape_within() {
    for (from, to) in [(-1.0, 0.5), (2.0, 3.0), (-4.0, -3.5)] {
        let kept = phi(to) - phi(from);
        let truncate = json!({"from": from, "to": to});
        let given = json!({"normal": {"mean": 0.0, "sd": 1.0, "truncate": truncate}});
        assert_cdf(given, 1e-4, |x| (phi(x) - phi(from)) / kept);
    }
}

#[test]
fn the_upper_tail_mirrors_the_lower_one() {
    let upper = json!({"normal": {"mean": 0.0, "sd": 1.0, "truncate": {"from": 4.0, "to": 9.0}}});
    let lower = json!({"normal": {"mean": 0.0, "sd": 1.0, "truncate": {"from": -9.0, "to": -4.0}}});
    let (upper, lower) = (distribution(upper), distribution(lower));
    for u in [1e-6, 0.1, 0.5, 0.999] {
        let sum = upper.number(u).unwrap() + lower.number(1.0 - u).unwrap();
        assert!(sum.abs() < 1e-9, "{u}: {sum}");
    }
}

#[test]
fn quantiles_of_a_lognormal_distribution_are_those_given() {
    let given = distribution(json!({"lognormal": {"median": 0.008, "p95": 0.012}}));
    assert!((given.number(0.5).unwrap() - 0.008).abs() < 1e-15);
    assert!((given.number(0.95).unwrap() - 0.012).abs() < 1e-15);
}

#[test]
fn a_choice_takes_its_values_by_weight() {
    let given = distribution(json!({"choice": {"values": [
        {"value": {"shape": "cube"}, "weight": 1.0},
        {"value": "ball", "weight": 2.0},
        {"value": null, "weight": 1.0}
    ]}}));
    let expected = [
        (0.1, json!({"shape": "cube"})),
        (0.26, json!("ball")),
        (0.74, json!("ball")),
        (0.76, json!(null)),
        (1.0 - SMALLEST_PROBABILITY, json!(null)),
    ];
    for (u, value) in expected {
        assert_eq!(given.quantile(u), value, "{u}");
    }
    assert_eq!(given.mean(), None);
    assert_eq!(given.number(0.1), None);
    assert!(!given.is_numeric());
}

#[test]
fn a_choice_of_numbers_has_a_mean() {
    let given =
        json!({"choice": {"values": [{"value": 1, "weight": 3}, {"value": 5.0, "weight": 1}]}});
    let given = distribution(given);
    assert_eq!(given.mean(), Some(2.0));
    assert!(given.is_numeric());
}

#[test]
fn a_list_takes_its_numbers_equally_often_and_keeps_whole_ones_whole() {
    let given = distribution(json!({"list": {"values": [3, 1.5, 9]}}));
    let values: Vec<Value> = [0.33, 0.34, 0.66, 0.67, 0.999]
        .map(|u| given.quantile(u))
        .to_vec();
    assert_eq!(
        values,
        [json!(3), json!(1.5), json!(1.5), json!(9), json!(9)]
    );
    assert_eq!(given.mean(), Some(4.5));
}

#[test]
fn ends_are_all_that_a_member_can_have() {
    let ends = |given: Value| distribution(given).ends();
    assert_eq!(
        ends(json!({"uniform": {"from": 1.0, "to": 2.0}})),
        [json!(1.0), json!(2.0)]
    );
    let triangular = json!({"triangular": {"from": 1.0, "mode": 1.0, "to": 2.0}});
    assert_eq!(ends(triangular), [json!(1.0), json!(2.0)]);
    let truncated =
        json!({"normal": {"mean": 0.0, "sd": 1.0, "truncate": {"from": -1.0, "to": 3.0}}});
    assert_eq!(ends(truncated), [json!(-1.0), json!(3.0)]);
    assert_eq!(
        ends(json!({"list": {"values": [4, 2]}})),
        [json!(4), json!(2)]
    );
    let choice =
        json!({"choice": {"values": [{"value": "a", "weight": 1}, {"value": 1, "weight": 1}]}});
    assert_eq!(ends(choice), [json!("a"), json!(1)]);
    let normal = ends(json!({"normal": {"mean": 0.0, "sd": 1.0}}));
    let [low, high] = [0, 1].map(|end| normal[end].as_f64().unwrap());
    assert!((low - z(SMALLEST_PROBABILITY)).abs() < 1e-9 && low == -high);
}
