//! Regions of resting places.

mod coverage;
mod degenerate;

use crate::support::{points, z};
use scree_studies::answers::{RestDistribution, RestingPlaces};
use scree_studies::{Design, Sobol};

type Map = fn(&[f64]) -> [f64; 2];

/// One peak with a long tail: a run-out that falls with friction and grows with volume.
fn skewed(u: &[f64]) -> [f64; 2] {
    let (friction, volume) = (0.3 + 0.15 * u[0], (0.25 * z(u[1])).exp());
    let runout = 0.2 * volume / (friction - 0.2);
    let yaw = 0.5 * std::f64::consts::PI * u[2];
    [runout, 0.2 * runout * (2.0 * yaw).sin() * (u[0] - 0.3)]
}

/// Two peaks: stopped at the foot of the incline, or carried on.
fn two_peaked(u: &[f64]) -> [f64; 2] {
    if u[2] + 0.3 * u[1] > 0.75 {
        let across = 0.05 * (u[1] - 0.5) + 0.02 * z(0.98 * u[2] + 0.01);
        return [0.3 + 0.04 * z(u[0]), across];
    }
    let [x, y] = skewed(u);
    [1.0 + 0.4 * x, 0.2 + y]
}

/// Two peaks of unlike widths: caught along a barrier, or carried on through the gap beside it.
fn caught_or_carried(u: &[f64]) -> [f64; 2] {
    let across = 0.14 * (u[0] - 0.5);
    if across > 0.0 {
        return [0.115, across];
    }
    [0.3 + 0.05 * z(u[1]), across + 0.04 + 0.02 * z(u[2])]
}

fn normal(u: &[f64]) -> [f64; 2] {
    [z(u[0]), 2.0 * z(u[1])]
}

fn places(points: &[Vec<f64>], map: Map) -> RestingPlaces {
    RestingPlaces {
        places_m: points.iter().map(|u| map(u)).collect(),
        moving: 0,
        unknown: 0,
        levels: None,
    }
}

fn sobol(members: u64, seed: u64, inputs: usize) -> Vec<Vec<f64>> {
    points(&Design::Sobol(Sobol { members, seed }), inputs)
}

#[test]
fn regions_grow_with_their_probability_and_the_outline_holds_the_members_counted() {
    let places = places(&sobol(256, 1, 3), two_peaked);
    let rest = RestDistribution::of(&places, &[0.5, 0.75, 0.9, 0.95]);
    assert!(
        rest.regions
            .windows(2)
            .all(|pair| pair[0].area_m2 < pair[1].area_m2)
    );
    assert!(
        rest.regions
            .windows(2)
            .all(|pair| pair[0].level_per_m2 > pair[1].level_per_m2)
    );
    assert!(rest.regions[0].polygons.len() >= 2);
    for (place, region) in rest.regions.iter().enumerate() {
        let within = places
            .places_m
            .iter()
            .filter(|one| rest.contains(place, **one))
            .count();
        // A member's own kernel holds some at the edge that are counted as outside.
        let counted = region.members.happened as usize;
        assert!(
            (counted..=counted + 15).contains(&within),
            "{within} {counted}"
        );
        let share = region.members.estimate.unwrap();
        assert!((share - region.probability).abs() < 0.01);
        assert!((region.smoothed_probability - region.probability).abs() < 0.12);
        for polygon in &region.polygons {
            assert_eq!(polygon.outer_m.first(), polygon.outer_m.last());
        }
    }
    let grid = rest.density.unwrap();
    assert_eq!(grid.density_per_m2.len(), grid.nodes[0] * grid.nodes[1]);
    let sum: f64 = grid.density_per_m2.iter().sum();
    let total = sum * grid.spacing_m[0] * grid.spacing_m[1];
    assert!((total - 1.0).abs() < 1e-3, "{total}");
}

#[test]
fn a_ring_has_a_hole() {
    let ring = |u: &[f64]| {
        let (radius, angle) = (1.0 + 0.08 * z(u[0]), 2.0 * std::f64::consts::PI * u[1]);
        [radius * angle.cos(), radius * angle.sin()]
    };
    let rest = RestDistribution::of(&places(&sobol(512, 1, 2), ring), &[0.9]);
    assert_eq!(rest.regions[0].polygons.len(), 1);
    assert_eq!(rest.regions[0].polygons[0].holes_m.len(), 1);
    assert!(!rest.contains(0, [0.0, 0.0]) && rest.contains(0, [1.0, 0.0]));
    let outer = &rest.regions[0].polygons[0];
    assert!(outer.area_m2() < 3.0, "{}", outer.area_m2());
}
