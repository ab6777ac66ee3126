//! A cube that slides to rest on an incline: x = v² / (2 g (μ cos θ − sin θ)), μ uniform.

use crate::support::{kolmogorov_distance, members, study};
use scree_studies::answers::{Measures, Quantile, Sample};
use scree_studies::{Ensemble, Study};
use serde_json::{Value, json};

const FROM: f64 = 0.4;
const TO: f64 = 0.6;
const SPEED: f64 = 2.0;
const GRAVITY: f64 = 9.81;
/// sin θ and cos θ of 20°.
const SINE: f64 = 0.342_020_143_325_668_7;
const COSINE: f64 = 0.939_692_620_785_908_4;

fn distance(friction: f64) -> f64 {
    SPEED * SPEED / (2.0 * GRAVITY * (friction * COSINE - SINE))
}

/// Probability of a shorter distance: that of more friction.
fn cdf(distance: f64) -> f64 {
    let friction = (SPEED * SPEED / (2.0 * GRAVITY * distance) + SINE) / COSINE;
    ((TO - friction) / (TO - FROM)).clamp(0.0, 1.0)
}

fn incline(design: &Value) -> Study {
    study(&json!({
        "scenario": {"channel": {"base_friction": 0.5}, "title": "incline"},
        "inputs": [
            {"pointer": "/channel/base_friction",
             "distribution": {"uniform": {"from": FROM, "to": TO}}},
            {"pointer": "/unused", "distribution": {"normal": {"mean": 0.0, "sd": 1.0}}}
        ],
        "design": design
    }))
}

#[test]
fn the_distribution_of_the_distance_is_the_analytic_one() {
    for (design, largest) in [
        (json!({"sobol": {"members": 1024, "seed": 5}}), 0.0011),
        (
            json!({"latin_hypercube": {"members": 1000, "seed": 5}}),
            0.0011,
        ),
        // Independent draws of 95 in 100 samples come within 1.36/√n.
        (
            json!({"saltelli": {"base_members": 512, "seed": 5}}),
            1.36 / 32.0,
        ),
    ] {
        let study = incline(&design);
        let ensemble = Ensemble::of(&study).unwrap();
        let members = members(&ensemble, |values| distance(values[0]));
        let sample = Sample::of(&ensemble, &members, "y", None);
        let found = kolmogorov_distance(&sample.values, cdf);
        assert!(found < largest, "{design}: {found}");
    }
}

#[test]
fn quantiles_of_the_distance_lie_in_their_bounds() {
    let study = incline(&json!({"sobol": {"members": 256, "seed": 5}}));
    let ensemble = Ensemble::of(&study).unwrap();
    let members = members(&ensemble, |values| distance(values[0]));
    let sample = Sample::of(&ensemble, &members, "y", None);
    for probability in [0.05, 0.5, 0.95] {
        let truth = distance(TO - probability * (TO - FROM));
        let found = Quantile::of(&sample, probability);
        assert!((found.estimate.unwrap() / truth - 1.0).abs() < 0.02);
        assert!(found.lower.unwrap() < truth && truth < found.upper.unwrap());
    }
}

#[test]
fn friction_explains_all_of_the_variance() {
    let study = incline(&json!({"saltelli": {"base_members": 1024, "seed": 5}}));
    let ensemble = Ensemble::of(&study).unwrap();
    let members = members(&ensemble, |values| distance(values[0]));
    let Some(Measures::Sobol(found)) = Measures::of(&ensemble, &members, "y", None) else {
        panic!("no indices");
    };
    let [friction, unused] = [found.inputs[0], found.inputs[1]];
    for (index, truth) in [(friction.first_order, 1.0), (friction.total, 1.0)] {
        assert!((index.value - truth).abs() < 0.01, "{index:?}");
        assert!(index.lower < truth && truth < index.upper, "{index:?}");
    }
    assert_eq!((unused.first_order.value, unused.total.value), (0.0, 0.0));
}

#[test]
fn friction_explains_all_of_the_variance_of_random_members_too() {
    let study = incline(&json!({"sobol": {"members": 1024, "seed": 5}}));
    let ensemble = Ensemble::of(&study).unwrap();
    let members = members(&ensemble, |values| distance(values[0]));
    let Some(Measures::FirstOrder(found)) = Measures::of(&ensemble, &members, "y", None) else {
        panic!("no indices");
    };
    let [friction, unused] = [0, 1].map(|input| found.inputs[input].first_order);
    assert!((friction.value - 1.0).abs() < 0.01, "{friction:?}");
    assert!(unused.value.abs() < 0.05, "{unused:?}");
    assert!(unused.lower < 0.0 && 0.0 < unused.upper, "{unused:?}");
}
