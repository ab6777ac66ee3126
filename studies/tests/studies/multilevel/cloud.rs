//! Resting places corrected by pairs.

use crate::support::{deviation, independent, mean, z};
use scree_studies::multilevel::{PlacePair, corrected_places};

/// Resting place on a level: the coarse one stops short, the more the farther it goes.
fn place(u: &[f64], fine: bool) -> [f64; 2] {
    let (x, y) = (1.0 + u[0] + 0.2 * z(u[1]), 0.3 * z(u[2]));
    if fine {
        let scatter = 0.02 * x;
        return [x + scatter * z(u[3]), y + scatter * z(u[4])];
    }
    [0.85 * x - 0.05, y - 0.1 * x]
}

#[test]
fn a_corrected_cloud_has_the_moments_of_the_fine_level() {
    let (mut coarse_error, mut corrected_error) = (Vec::new(), Vec::new());
    for seed in 0..20 {
        let coarse: Vec<[f64; 2]> = independent(500, 5, 3 * seed)
            .iter()
            .map(|u| place(u, false))
            .collect();
        let pairs: Vec<PlacePair> = independent(60, 5, 3 * seed + 1)
            .iter()
            .map(|u| PlacePair {
                coarse_m: place(u, false),
                fine_m: place(u, true),
            })
            .collect();
        let corrected = corrected_places(&coarse, &pairs, seed).unwrap();
        let moments = |places: &[[f64; 2]]| {
            let along = |axis: usize| places.iter().map(|one| one[axis]).collect::<Vec<f64>>();
            let (x, y) = (along(0), along(1));
            [mean(&x), mean(&y), deviation(&x), deviation(&y)]
        };
        coarse_error.push(moments(&coarse));
        corrected_error.push(moments(&corrected));
    }
    // Of x: uniform of variance 1/12 plus 0.2², and the scatter 0.02² (1.5² + var x).
    let variance: f64 = 1.0 / 12.0 + 0.04;
    let scatter = 0.0004 * (2.25 + variance);
    let truth = [
        1.5,
        0.0,
        (variance + scatter).sqrt(),
        (0.09 + scatter).sqrt(),
    ];
    for (place, truth) in truth.into_iter().enumerate() {
        let of = |moments: &[[f64; 4]]| {
            mean(&moments.iter().map(|one| one[place]).collect::<Vec<f64>>())
        };
        let (coarse, corrected) = (of(&coarse_error), of(&corrected_error));
        assert!(
            (corrected - truth).abs() < 0.012,
            "{place}: {corrected} {truth}"
        );
        assert!(
            (corrected - truth).abs() < (coarse - truth).abs(),
            "{place}: {coarse}"
        );
    }
}

#[test]
fn a_body_at_rest_on_both_levels_stays_there() {
    let still = [0.3, -0.2];
    let on = |u: &[f64], fine: bool| if u[2] < 0.4 { still } else { place(u, fine) };
    let coarse: Vec<[f64; 2]> = independent(300, 5, 1)
        .iter()
        .map(|u| on(u, false))
        .collect();
    let pairs: Vec<PlacePair> = independent(80, 5, 2)
        .iter()
        .map(|u| PlacePair {
            coarse_m: on(u, false),
            fine_m: on(u, true),
        })
        .collect();
    let corrected = corrected_places(&coarse, &pairs, 1).unwrap();
    for (before, after) in coarse.iter().zip(&corrected) {
        if *before == still {
            assert!((after[0] - still[0]).abs() < 1e-12 && (after[1] - still[1]).abs() < 1e-12);
        }
    }
    assert!(coarse.iter().filter(|place| **place == still).count() > 80);
}

#[test]
fn places_on_a_line_are_corrected_along_it() {
    let pairs: Vec<PlacePair> = independent(40, 1, 2)
        .iter()
        .map(|u| PlacePair {
            coarse_m: [u[0], 0.0],
            fine_m: [1.1 * u[0] + 0.2, 0.0],
        })
        .collect();
    let corrected = corrected_places(&[[0.5, 0.0], [3.0, 0.0]], &pairs, 1).unwrap();
    for (found, expected) in corrected.iter().zip([0.75, 3.5]) {
        assert!(
            (found[0] - expected).abs() < 1e-6 && found[1].abs() < 1e-9,
            "{found:?}"
        );
    }
}
