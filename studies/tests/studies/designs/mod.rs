//! Designs.

mod kinds;

use crate::support::{numbers, points, unit_study};
use scree_studies::{Design, Ensemble, SMALLEST_PROBABILITY, Study};
use serde_json::{Value, json};

fn design(given: Value) -> Design {
    let read: Design = serde_json::from_value(given).unwrap();
    assert_eq!(read.violations(3), []);
    read
}

fn sobol(members: u64, seed: u64) -> Design {
    design(json!({"sobol": {"members": members, "seed": seed}}))
}

fn column(points: &[Vec<f64>], input: usize) -> Vec<f64> {
    points.iter().map(|point| point[input]).collect()
}

/// Counts of the coordinates in so many equal parts of 0..1.
fn counts(coordinates: &[f64], parts: usize) -> Vec<usize> {
    let mut counts = vec![0; parts];
    for coordinate in coordinates {
        counts[(coordinate * parts as f64) as usize] += 1;
    }
    counts
}

#[test]
fn a_design_enlarged_has_its_earlier_members_first() {
    let pairs = [
        (sobol(256, 1), sobol(1024, 1)),
        (
            design(json!({"saltelli": {"base_members": 16, "seed": 5}})),
            design(json!({"saltelli": {"base_members": 64, "seed": 5}})),
        ),
        (
            design(json!({"morris": {"trajectories": 3, "levels": 6, "seed": 5}})),
            design(json!({"morris": {"trajectories": 9, "levels": 6, "seed": 5}})),
        ),
    ];
    for (small, large) in pairs {
        assert!(small.can_be_enlarged_to(&large) && !large.can_be_enlarged_to(&small));
        let (few, many) = (points(&small, 3), points(&large, 3));
        assert_eq!(few, many[..few.len()]);
        let doubled = small.doubled().unwrap();
        assert!(small.can_be_enlarged_to(&doubled));
        assert_eq!(doubled.members(3), 2 * small.members(3));
    }
}

#[test]
fn a_design_with_other_members_is_no_enlargement() {
    let latin = |members| design(json!({"latin_hypercube": {"members": members, "seed": 1}}));
    let morris =
        |levels| design(json!({"morris": {"trajectories": 3, "levels": levels, "seed": 5}}));
    let explicit = |members: Value| design(json!({"explicit": {"members": members}}));
    let few = explicit(json!([[1, 2, 3]]));
    assert!(!sobol(256, 1).can_be_enlarged_to(&sobol(512, 2)));
    assert!(!sobol(256, 1).can_be_enlarged_to(&latin(512)));
    assert!(!latin(10).can_be_enlarged_to(&latin(20)));
    assert!(latin(10).can_be_enlarged_to(&latin(10)));
    assert!(latin(10).doubled().is_none());
    assert!(!morris(4).can_be_enlarged_to(&morris(6)));
    assert!(few.can_be_enlarged_to(&explicit(json!([[1, 2, 3], [4, 5, 6]]))));
    assert!(!few.can_be_enlarged_to(&explicit(json!([[4, 5, 6], [1, 2, 3]]))));
}

#[test]
fn points_never_change() {
    // Written down once; a change would change the members of every stored study.
    let sobol = points(&sobol(2, 1), 2).concat();
    let expected = [
        0.14002901315689087,
        0.29987233877182007,
        0.9892552495002747,
        0.6181719899177551,
    ];
    assert_eq!(sobol, expected);
    let latin = json!({"latin_hypercube": {"members": 3, "seed": 1}});
    assert_eq!(
        points(&design(latin), 1).concat(),
        [0.1883432712510522, 0.7111208136674639, 0.46981619954063386]
    );
    let morris = json!({"morris": {"trajectories": 2, "levels": 4, "seed": 1}});
    assert_eq!(
        points(&design(morris), 2).concat(),
        [
            0.875, 0.125, 0.875, 0.625, 0.375, 0.625, 0.625, 0.375, 0.125, 0.375, 0.125, 0.875
        ]
    );
}

#[test]
fn all_coordinates_have_quantiles() {
    let designs = [
        sobol(1 << 14, 1),
        design(json!({"latin_hypercube": {"members": 5000, "seed": 1}})),
        design(json!({"saltelli": {"base_members": 1024, "seed": 1}})),
        design(json!({"full_factorial": {"levels": 9}})),
        design(json!({"morris": {"trajectories": 50, "levels": 8, "seed": 1}})),
        design(json!({"one_at_a_time": {"levels": 7}})),
    ];
    let range = SMALLEST_PROBABILITY..=1.0 - SMALLEST_PROBABILITY;
    for design in designs {
        let drawn = points(&design, 3);
        assert_eq!(drawn.len() as u64, design.members(3));
        assert!(
            drawn.concat().iter().all(|u| range.contains(u)),
            "{design:?}"
        );
    }
}

#[test]
fn an_explicit_design_has_the_values_given() {
    let design = json!({"explicit": {"members": [[0.1, 0.2], [0.3, 0.4]]}});
    let mut study: Study = unit_study(2, &design, &json!([]));
    study.inputs[0].distribution = None;
    let ensemble = Ensemble::of(&study).unwrap();
    assert_eq!(numbers(&ensemble, 1), [0.3, 0.4]);
    assert_eq!(ensemble.members(), 2);
}
