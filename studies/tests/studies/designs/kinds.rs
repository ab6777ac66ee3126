//! What each kind of design promises.

use super::{column, counts, design, sobol};
use crate::support::{deviation, mean, points, spearman};
use serde_json::json;

#[test]
fn sobol_points_are_balanced_in_every_dimension_and_every_box() {
    let drawn = points(&sobol(256, 7), 8);
    for input in 0..8 {
        let coordinates = column(&drawn, input);
        assert_eq!(counts(&coordinates, 256), [1; 256]);
    }
    // The first two dimensions are a (0, m, 2)-net: every box of area 1/256 has one point.
    for columns in [2, 16, 64] {
        let cell = |point: &Vec<f64>| {
            let rows = 256 / columns;
            (point[0] * columns as f64) as usize * rows + (point[1] * rows as f64) as usize
        };
        let mut cells: Vec<usize> = drawn.iter().map(cell).collect();
        cells.sort_unstable();
        assert_eq!(cells, (0..256).collect::<Vec<usize>>());
    }
}

#[test]
fn seeds_give_other_points() {
    assert_ne!(points(&sobol(4, 1), 2), points(&sobol(4, 2), 2));
    assert_ne!(points(&sobol(4, 1), 2), points(&sobol(4, 1 + (1 << 32)), 2));
}

#[test]
fn beyond_one_sequence_another_scrambling_follows() {
    let large = sobol(1 << 18, 3);
    let block = |first: u64| -> Vec<f64> {
        let indices = first..first + 1024;
        let point = |index| match large.point(index, 1) {
            scree_studies::Point::Unit(point) => point[0],
            scree_studies::Point::Values(values) => panic!("{values:?}"),
        };
        indices.map(point).collect()
    };
    let (first, second) = (block(0), block(1 << 16));
    assert_ne!(first, second);
    assert_eq!(counts(&second, 1024), [1; 1024]);
}

#[test]
fn a_latin_hypercube_has_one_member_in_each_stratum() {
    for members in [2, 10, 100, 257] {
        let latin = json!({"latin_hypercube": {"members": members, "seed": 11}});
        let drawn = points(&design(latin), 5);
        for input in 0..5 {
            let strata = counts(&column(&drawn, input), members);
            assert!(strata.iter().all(|count| *count == 1));
        }
        assert_ne!(column(&drawn, 0), column(&drawn, 1));
    }
}

#[test]
fn the_strata_of_a_latin_hypercube_do_not_correlate() {
    let correlation = |seed: u64| {
        let latin = json!({"latin_hypercube": {"members": 16, "seed": seed}});
        let drawn = points(&design(latin), 2);
        spearman(&column(&drawn, 0), &column(&drawn, 1))
    };
    let found: Vec<f64> = (0..400).map(correlation).collect();
    // A rank correlation of 16 independent pairs has the variance 1/15.
    assert!(
        mean(&found).abs() < 3.0 / (15.0 * 400_f64).sqrt(),
        "{}",
        mean(&found)
    );
    let spread = deviation(&found) * 15_f64.sqrt();
    assert!((0.9..1.1).contains(&spread), "{spread}");
}

#[test]
fn a_factorial_design_has_every_combination_once() {
    let drawn = points(&design(json!({"full_factorial": {"levels": [2, 1, 3]}})), 3);
    let expected = [
        [0.25, 0.5, 0.5 / 3.0],
        [0.25, 0.5, 0.5],
        [0.25, 0.5, 2.5 / 3.0],
        [0.75, 0.5, 0.5 / 3.0],
        [0.75, 0.5, 0.5],
        [0.75, 0.5, 2.5 / 3.0],
    ];
    assert_eq!(drawn, expected);
    assert_eq!(
        design(json!({"full_factorial": {"levels": 4}})).members(3),
        64
    );
}

#[test]
fn one_at_a_time_moves_one_input_and_repeats_no_median() {
    let drawn = points(&design(json!({"one_at_a_time": {"levels": 3}})), 2);
    let (low, high) = (0.5 / 3.0, 2.5 / 3.0);
    let expected = [[0.5, 0.5], [low, 0.5], [high, 0.5], [0.5, low], [0.5, high]];
    assert_eq!(drawn, expected);
    let even = points(&design(json!({"one_at_a_time": {"levels": 2}})), 1);
    assert_eq!(even, [[0.5], [0.25], [0.75]]);
}

#[test]
fn a_trajectory_moves_every_input_once_by_half_the_levels() {
    let morris = design(json!({"morris": {"trajectories": 40, "levels": 6, "seed": 2}}));
    let drawn = points(&morris, 3);
    for trajectory in drawn.chunks(4) {
        let mut moved = Vec::new();
        for step in trajectory.windows(2) {
            let changed: Vec<usize> = (0..3)
                .filter(|one| step[0][*one] != step[1][*one])
                .collect();
            assert_eq!(changed.len(), 1);
            let change: f64 = step[1][changed[0]] - step[0][changed[0]];
            assert!((change.abs() - 0.5).abs() < 1e-12);
            moved.push(changed[0]);
        }
        moved.sort_unstable();
        assert_eq!(moved, [0, 1, 2]);
    }
    // All levels occur.
    assert!(counts(&column(&drawn, 1), 6).iter().all(|count| *count > 0));
}

#[test]
fn a_saltelli_design_mixes_its_samples() {
    let saltelli = design(json!({"saltelli": {"base_members": 32, "seed": 2}}));
    let drawn = points(&saltelli, 3);
    for row in drawn.chunks(5) {
        let (a, b) = (&row[0], &row[1]);
        for (input, mixture) in row[2..].iter().enumerate() {
            let mut expected = a.clone();
            expected[input] = b[input];
            assert_eq!(mixture, &expected);
            assert_ne!(a[input], b[input]);
        }
    }
    let first: Vec<Vec<f64>> = drawn.chunks(5).map(|row| row[0].clone()).collect();
    let second: Vec<Vec<f64>> = drawn.chunks(5).map(|row| row[1].clone()).collect();
    for input in 0..3 {
        assert_eq!(counts(&column(&first, input), 32), [1; 32]);
        assert_eq!(counts(&column(&second, input), 32), [1; 32]);
    }
    let draws: Vec<u64> = (0..10)
        .filter(|index| saltelli.is_draw(*index, 3))
        .collect();
    assert_eq!(draws, [0, 1, 5, 6]);
}
