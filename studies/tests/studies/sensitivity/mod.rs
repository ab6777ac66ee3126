//! Sensitivity to the inputs.

mod given_data;

use crate::support::{members, unit_study};
use scree_studies::answers::{Estimate, Measures, SobolIndices};
use scree_studies::{Ensemble, Member, MemberOutcome, Study};
use serde_json::json;
use std::f64::consts::PI;

/// Ishigami & Homma's function (1990) with a = 7, b = 0.1, of inputs over −π..π.
fn ishigami(u: &[f64]) -> f64 {
    let x: Vec<f64> = u.iter().map(|u| PI * (2.0 * u - 1.0)).collect();
    x[0].sin() + 7.0 * x[1].sin().powi(2) + 0.1 * x[2].powi(4) * x[0].sin()
}

const ISHIGAMI_FIRST: [f64; 3] = [0.3139, 0.4424, 0.0];
const ISHIGAMI_TOTAL: [f64; 3] = [0.5576, 0.4424, 0.2437];

fn measures(ensemble: &Ensemble, members: &[Member]) -> Option<Measures> {
    Measures::of(ensemble, members, "y", None)
}

fn sobol_indices(ensemble: &Ensemble, members: &[Member]) -> SobolIndices {
    match measures(ensemble, members) {
        Some(Measures::Sobol(indices)) => indices,
        other => panic!("{other:?}"),
    }
}

fn saltelli(inputs: usize, base_members: u64) -> Study {
    let design = json!({"saltelli": {"base_members": base_members, "seed": 1}});
    unit_study(inputs, &design, &json!([]))
}

fn assert_holds(found: &Estimate, truth: f64, error: f64) {
    assert!(
        found.lower <= truth && truth <= found.upper,
        "{truth} {found:?}"
    );
    assert!((found.value - truth).abs() < error, "{truth} {found:?}");
    assert!(
        found.lower <= found.value && found.value <= found.upper,
        "{found:?}"
    );
}

#[test]
fn indices_of_the_ishigami_function() {
    let study = saltelli(3, 1024);
    let ensemble = Ensemble::of(&study).unwrap();
    let found = sobol_indices(&ensemble, &members(&ensemble, ishigami));
    for (input, index) in found.inputs.iter().enumerate() {
        let (first, total) = (index.first_order, index.total);
        println!(
            "Ishigami, input {input}: S {:.3} ({:.3}..{:.3}), ST {:.3} ({:.3}..{:.3})",
            first.value, first.lower, first.upper, total.value, total.lower, total.upper
        );
        assert_holds(&first, ISHIGAMI_FIRST[input], 0.03);
        assert_holds(&total, ISHIGAMI_TOTAL[input], 0.03);
    }
    assert_eq!((found.rows, found.rows_left_out), (1024, 0));
}

#[test]
fn rows_with_a_failed_member_are_left_out_whole() {
    let study = saltelli(3, 1024);
    let ensemble = Ensemble::of(&study).unwrap();
    let mut members = members(&ensemble, ishigami);
    for index in [3, 4, 700, 3333] {
        members[index].outcome = MemberOutcome::failed("diverged");
    }
    let found = sobol_indices(&ensemble, &members);
    assert_eq!((found.rows, found.rows_left_out), (1021, 3));
    for (input, index) in found.inputs.iter().enumerate() {
        assert_holds(&index.total, ISHIGAMI_TOTAL[input], 0.03);
    }
}

#[test]
fn a_quantity_that_does_not_vary_has_no_indices() {
    let study = saltelli(2, 16);
    let ensemble = Ensemble::of(&study).unwrap();
    assert_eq!(measures(&ensemble, &members(&ensemble, |_| 4.0)), None);
    assert_eq!(measures(&ensemble, &[]), None);
    let random = unit_study(2, &json!({"sobol": {"members": 64, "seed": 1}}), &json!([]));
    let ensemble = Ensemble::of(&random).unwrap();
    assert_eq!(measures(&ensemble, &members(&ensemble, |_| 4.0)), None);
    assert_eq!(
        measures(&ensemble, &members(&ensemble, |u| u[0])[..19]),
        None
    );
}

fn morris(inputs: usize) -> Study {
    let design = json!({"morris": {"trajectories": 20, "levels": 4, "seed": 3}});
    unit_study(inputs, &design, &json!([]))
}

#[test]
fn elementary_effects_of_a_linear_function_are_exact() {
    let study = morris(3);
    let ensemble = Ensemble::of(&study).unwrap();
    let linear = members(&ensemble, |u| 3.0 * u[0] - 2.0 * u[1] + 7.0);
    let Some(Measures::Elementary(found)) = measures(&ensemble, &linear) else {
        panic!("no effects");
    };
    for (effect, slope) in found.inputs.iter().zip([3.0, -2.0, 0.0_f64]) {
        assert!((effect.mean.value - slope).abs() < 1e-12);
        assert!((effect.mean_size.value - slope.abs()).abs() < 1e-12);
        let rest = [
            effect.deviation.value,
            effect.mean.standard_error,
            effect.mean_size.standard_error,
            effect.deviation.standard_error,
        ];
        assert!(rest.iter().all(|one| one.abs() < 1e-12), "{rest:?}");
        assert_eq!((effect.effects, effect.effects_left_out), (20, 0));
    }
}

#[test]
fn elementary_effects_tell_interaction_from_none() {
    let study = morris(3);
    let ensemble = Ensemble::of(&study).unwrap();
    let product = members(&ensemble, |u| u[0] * (u[1] - 0.5) + 0.1 * u[2]);
    let Some(Measures::Elementary(found)) = measures(&ensemble, &product) else {
        panic!("no effects");
    };
    let [first, second, third] = [0, 1, 2].map(|input| found.inputs[input]);
    // The effect of the first input is u₁ − ½ at the levels 1/8, 3/8, 5/8, 7/8.
    assert!((first.mean_size.value - 0.25).abs() < 3.0 * first.mean_size.standard_error);
    assert!((first.deviation.value - 0.28).abs() < 3.0 * first.deviation.standard_error);
    assert!(first.mean.value.abs() < 3.0 * first.mean.standard_error);
    let error = first.deviation.value / 20_f64.sqrt();
    assert!((first.mean.standard_error - error).abs() < 1e-12);
    assert!((second.mean.value - 0.5).abs() < 3.0 * second.mean.standard_error);
    assert!(third.deviation.value < 1e-12 && (third.mean.value - 0.1).abs() < 1e-12);
}

#[test]
fn effects_without_a_member_are_left_out() {
    let study = morris(2);
    let ensemble = Ensemble::of(&study).unwrap();
    let mut members = members(&ensemble, |u| u[0] + 2.0 * u[1]);
    // The first member of a trajectory has one effect, the middle one has both.
    members[0].outcome = MemberOutcome::Pending;
    members[4].outcome = MemberOutcome::failed("diverged");
    let Some(Measures::Elementary(found)) = measures(&ensemble, &members) else {
        panic!("no effects");
    };
    let left_out: u64 = found
        .inputs
        .iter()
        .map(|effect| effect.effects_left_out)
        .sum();
    assert_eq!(left_out, 3);
    assert!((found.inputs[1].mean.value - 2.0).abs() < 1e-12);
    assert_eq!(measures(&ensemble, &members[..3]), None);
}
