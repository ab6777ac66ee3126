//! First-order indices from random members.

use super::{ISHIGAMI_FIRST, assert_holds, ishigami, measures};
use crate::support::{members, unit_study};
use scree_studies::answers::{FirstOrderIndices, Measures};
use scree_studies::{Ensemble, Finished, Member, MemberOutcome, Study};
use serde_json::{Value, json};

fn first_order(ensemble: &Ensemble, members: &[Member]) -> FirstOrderIndices {
    match measures(ensemble, members) {
        Some(Measures::FirstOrder(indices)) => indices,
        other => panic!("{other:?}"),
    }
}

#[test]
fn first_order_indices_from_random_members() {
    for design in [
        json!({"sobol": {"members": 1024, "seed": 1}}),
        json!({"latin_hypercube": {"members": 1000, "seed": 1}}),
    ] {
        let study = unit_study(3, &design, &json!([]));
        let ensemble = Ensemble::of(&study).unwrap();
        let found = first_order(&ensemble, &members(&ensemble, ishigami));
        for (input, index) in found.inputs.iter().enumerate() {
            assert_holds(&index.first_order, ISHIGAMI_FIRST[input], 0.03);
        }
        assert_eq!(found.members_left_out, 0);
    }
}

#[test]
fn first_order_indices_have_no_bias() {
    let mut sums = [0.0; 3];
    for seed in 0..20 {
        let design = json!({"latin_hypercube": {"members": 200, "seed": seed}});
        let study = unit_study(3, &design, &json!([]));
        let ensemble = Ensemble::of(&study).unwrap();
        let found = first_order(&ensemble, &members(&ensemble, ishigami));
        for (sum, index) in sums.iter_mut().zip(&found.inputs) {
            *sum += index.first_order.value / 20.0;
        }
    }
    for (sum, truth) in sums.iter().zip(ISHIGAMI_FIRST) {
        assert!((sum - truth).abs() < 0.04, "{sums:?}");
    }
}

#[test]
fn a_choice_of_words_has_an_index() {
    let words: Vec<Value> = ["cube", "ball", "plate"]
        .map(|word| json!({"value": word, "weight": 1}))
        .to_vec();
    let study: Study = serde_json::from_value(json!({
        "scenario": {"shape": "cube"},
        "inputs": [
            {"pointer": "/shape", "distribution": {"choice": {"values": words}}},
            {"pointer": "/friction", "distribution": {"uniform": {"from": 0.0, "to": 1.0}}}
        ],
        "design": {"sobol": {"members": 512, "seed": 1}}
    }))
    .unwrap();
    let ensemble = Ensemble::of(&study).unwrap();
    let members: Vec<Member> = (0..512)
        .map(|index| {
            let values = ensemble.values(index).unwrap();
            let shape = match values[0].as_str().unwrap() {
                "cube" => -1.0,
                "ball" => 1.0,
                _ => 0.0,
            };
            let y = shape + 2.0 * values[1].as_f64().unwrap();
            let quantities = [("y".to_owned(), y)].into();
            let finished = Finished {
                quantities,
                bodies: Vec::new(),
            };
            Member {
                level: 0,
                index,
                outcome: MemberOutcome::Finished(finished),
            }
        })
        .collect();
    let found = first_order(&ensemble, &members);
    // Variances 2/3 and 4/12.
    assert!(
        (found.inputs[0].first_order.value - 2.0 / 3.0).abs() < 0.02,
        "{found:?}"
    );
    assert!(
        (found.inputs[1].first_order.value - 1.0 / 3.0).abs() < 0.05,
        "{found:?}"
    );
    assert_eq!(found.inputs[0].classes, 3);
}
