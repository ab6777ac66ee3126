//! Studies, members and statistics for the tests.

use scree_studies::{
    Design, Ensemble, Finished, Member, MemberBody, MemberOutcome, Point, Sobol, Study,
};
use serde_json::{Value, json};
use statrs::distribution::{ContinuousCDF, Normal};
use std::collections::BTreeMap;

/// The document with everything in it.
pub(crate) fn document() -> Value {
    json!({
        "title": "A cube on an incline",
        "scenario": {
            "channel": {"base_friction": 0.4},
            "flow": {"volume_m3": 0.008},
            "bodies": [{"yaw_deg": 0, "shape": "cube"}]
        },
        "inputs": [
            {"pointer": "/channel/base_friction",
             "distribution": {"uniform": {"from": 0.3, "to": 0.45}}},
            {"pointer": "/flow/volume_m3",
             "distribution": {"lognormal": {"median": 0.008, "p95": 0.012}}},
            {"pointer": "/bodies/0/yaw_deg",
             "distribution": {"uniform": {"from": 0.0, "to": 90.0}}}
        ],
        "correlations": [{"inputs": [0, 1], "rank": 0.5}],
        "design": {"sobol": {"members": 256, "seed": 1}},
        "stop": {"region": 0.9, "area_changes_less_than": 0.05, "max_members": 1024,
                 "budget_point_steps": 1e12},
        "questions": [
            {"rest": {"body": 0, "regions": [0.5, 0.75, 0.9, 0.95]}},
            {"exceeds": {"quantity": "displacement_m", "body": 0, "thresholds": [0.2, 0.4]}},
            {"buried": {"body": 0, "deeper_than_m": 0.02}},
            {"quantiles": {"quantity": "runout_m", "probabilities": [0.5]}},
            {"sensitivity": {"quantity": "displacement_m", "body": 0}}
        ]
    })
}

/// Study of a document.
pub(crate) fn study(document: &Value) -> Study {
    serde_json::from_value(document.clone()).unwrap()
}

/// Study of independent inputs a, b, c, … over 0..1 with a design and questions.
pub(crate) fn unit_study(inputs: usize, design: &Value, questions: &Value) -> Study {
    let input = |place: usize| {
        let distribution = json!({"uniform": {"from": 0.0, "to": 1.0}});
        json!({"pointer": format!("/{place}"), "distribution": distribution})
    };
    study(&json!({
        "scenario": {},
        "inputs": (0..inputs).map(input).collect::<Vec<Value>>(),
        "design": design,
        "questions": questions
    }))
}

/// Members of a study whose only quantity is a function of the inputs' numbers.
pub(crate) fn members(ensemble: &Ensemble, quantity: impl Fn(&[f64]) -> f64) -> Vec<Member> {
    let member = |index| Member {
        level: 0,
        index,
        outcome: MemberOutcome::Finished(Finished {
            quantities: BTreeMap::from([("y".to_owned(), quantity(&numbers(ensemble, index)))]),
            bodies: Vec::new(),
        }),
    };
    (0..ensemble.members()).map(member).collect()
}

/// Inputs of a member as numbers.
pub(crate) fn numbers(ensemble: &Ensemble, index: u64) -> Vec<f64> {
    let values = ensemble.values(index).unwrap();
    values.iter().map(|value| value.as_f64().unwrap()).collect()
}

/// Outcome with one body at rest.
pub(crate) fn rested(place_m: [f64; 2], buried_m: f64) -> MemberOutcome {
    MemberOutcome::Finished(Finished {
        quantities: BTreeMap::new(),
        bodies: vec![MemberBody {
            rest_m: [place_m[0], place_m[1], 0.0],
            moving: false,
            hit: true,
            buried_m,
            quantities: BTreeMap::new(),
        }],
    })
}

/// Points of a design in the unit cube.
pub(crate) fn points(design: &Design, inputs: usize) -> Vec<Vec<f64>> {
    let point = |index| match design.point(index, inputs) {
        Point::Unit(point) => point,
        Point::Values(values) => panic!("{values:?} is no point of the unit cube"),
    };
    (0..design.members(inputs)).map(point).collect()
}

/// Independent points: the first ones of differently scrambled sequences.
pub(crate) fn independent(count: u64, inputs: usize, seed: u64) -> Vec<Vec<f64>> {
    let first = |seed| points(&Design::Sobol(Sobol { members: 1, seed }), inputs).remove(0);
    (0..count)
        .map(|one| first(1_000_003 * seed + one))
        .collect()
}

/// Largest distance of the empirical distribution function from the true one (Kolmogorov 1933).
pub(crate) fn kolmogorov_distance(values: &[f64], cdf: impl Fn(f64) -> f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let count = sorted.len() as f64;
    let distance = |(place, value): (usize, &f64)| {
        let (below, above) = (place as f64 / count, (place + 1) as f64 / count);
        (cdf(*value) - below).abs().max((cdf(*value) - above).abs())
    };
    sorted.iter().enumerate().map(distance).fold(0.0, f64::max)
}

/// Spearman's rank correlation.
pub(crate) fn spearman(one: &[f64], other: &[f64]) -> f64 {
    pearson(&ranks(one), &ranks(other))
}

fn ranks(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|one, other| values[*one].total_cmp(&values[*other]));
    let mut ranks = vec![0.0; values.len()];
    for (rank, place) in order.into_iter().enumerate() {
        ranks[place] = rank as f64;
    }
    ranks
}

fn pearson(one: &[f64], other: &[f64]) -> f64 {
    let products = |a: &[f64], b: &[f64]| {
        let (mean_a, mean_b) = (mean(a), mean(b));
        let both = a.iter().zip(b);
        both.map(|(x, y)| (x - mean_a) * (y - mean_b)).sum::<f64>()
    };
    products(one, other) / (products(one, one) * products(other, other)).sqrt()
}

/// Mean.
pub(crate) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Standard deviation.
pub(crate) fn deviation(values: &[f64]) -> f64 {
    let mean = mean(values);
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    (squares / (values.len() - 1) as f64).sqrt()
}

/// Quantile of the standard normal distribution.
pub(crate) fn z(probability: f64) -> f64 {
    Normal::standard().inverse_cdf(probability)
}

/// Distribution function of the standard normal distribution.
pub(crate) fn phi(z: f64) -> f64 {
    Normal::standard().cdf(z)
}
