//! Correlated inputs.

use crate::support::{independent, kolmogorov_distance, points, spearman};
use scree_studies::{Copula, Correlation, Design, Sobol};

fn copula(inputs: usize, correlations: &[([usize; 2], f64)]) -> Copula {
    let correlation = |(inputs, rank): &([usize; 2], f64)| Correlation {
        inputs: *inputs,
        rank: *rank,
    };
    let correlations: Vec<Correlation> = correlations.iter().map(correlation).collect();
    Copula::new(inputs, &correlations).unwrap()
}

fn column(points: &[Vec<f64>], input: usize) -> Vec<f64> {
    points.iter().map(|point| point[input]).collect()
}

#[test]
fn the_ranks_of_the_inputs_correlate_as_asked_for() {
    let asked = [([0, 1], 0.4), ([2, 1], -0.6), ([0, 3], 0.7)];
    let copula = copula(4, &asked);
    let drawn: Vec<Vec<f64>> = independent(4000, 4, 3)
        .iter()
        .map(|u| copula.correlated(u))
        .collect();
    for one in 0..4 {
        for other in one + 1..4 {
            let pair = asked
                .iter()
                .find(|(inputs, _)| inputs.contains(&one) && inputs.contains(&other));
            let rank = pair.map_or(0.0, |(_, rank)| *rank);
            let found = spearman(&column(&drawn, one), &column(&drawn, other));
            // The error of a rank correlation of n draws is at most about 1/√n.
            assert!(
                (found - rank).abs() < 3.0 / 4000_f64.sqrt(),
                "{one} {other}: {found}"
            );
        }
    }
}

#[test]
fn sobol_points_have_the_correlation_more_closely() {
    let copula = copula(2, &[([0, 1], -0.6)]);
    let design = Design::Sobol(Sobol {
        members: 1024,
        seed: 4,
    });
    let drawn: Vec<Vec<f64>> = points(&design, 2)
        .iter()
        .map(|u| copula.correlated(u))
        .collect();
    let found = spearman(&column(&drawn, 0), &column(&drawn, 1));
    assert!((found + 0.6).abs() < 0.004, "{found}");
}

#[test]
fn each_input_stays_uniform_and_one_without_correlation_stays_as_it_is() {
    let copula = copula(3, &[([0, 2], 0.8)]);
    let design = Design::Sobol(Sobol {
        members: 1024,
        seed: 4,
    });
    let given = points(&design, 3);
    let drawn: Vec<Vec<f64>> = given.iter().map(|u| copula.correlated(u)).collect();
    assert_eq!(column(&drawn, 0), column(&given, 0));
    assert_eq!(column(&drawn, 1), column(&given, 1));
    assert_ne!(column(&drawn, 2), column(&given, 2));
    let distance = kolmogorov_distance(&column(&drawn, 2), |u| u);
    assert!(distance < 0.01, "{distance}");
}

#[test]
fn a_contradiction_names_its_pairs_and_no_others() {
    let correlation = |inputs, rank| Correlation { inputs, rank };
    let given = [
        correlation([0, 4], 0.2),
        correlation([1, 2], 0.9),
        correlation([3, 2], 0.9),
        correlation([1, 3], -0.5),
        correlation([3, 4], 0.1),
    ];
    let found = Copula::new(5, &given).unwrap_err();
    assert_eq!(found.0, [[1, 2], [1, 3], [2, 3]]);
}
