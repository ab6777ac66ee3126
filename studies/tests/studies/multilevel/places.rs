//! Resting places corrected by pairs.

use super::{runs, study};
use crate::support::{deviation, mean, rested, z};
use scree_studies::answers::{RestDistribution, RestingPlaces};
use scree_studies::{Ensemble, Member};
use serde_json::json;

const MEMBERS: [u64; 3] = [512, 128, 32];
const FINEST_M: f64 = 0.015;

/// Resting place with cells of a size: coarse ones stop short, the more the farther it goes, and
/// what they leave out scatters.
fn place(u: &[f64], cell_size_m: f64) -> [f64; 2] {
    let (x, y) = (1.0 + u[0] + 0.1 * z(u[1]), 0.3 * z(u[2]));
    let scatter = 0.02 * x * z(u[3]) * (1.0 - cell_size_m / 0.03);
    [
        x * (1.0 - 5.0 * cell_size_m) + scatter,
        y - 3.0 * cell_size_m * x,
    ]
}

fn places(seed: u64, place: impl Fn(&[f64], f64) -> [f64; 2]) -> RestingPlaces {
    let study = study(MEMBERS, seed, &json!([]));
    let ensemble = Ensemble::of(&study).unwrap();
    let members = runs(&ensemble, |u, cells| rested(place(u, cells), 0.0));
    RestingPlaces::of(&ensemble, &members, 0)
}

fn moments(places: &[[f64; 2]]) -> [f64; 4] {
    let along = |axis: usize| places.iter().map(|one| one[axis]).collect::<Vec<f64>>();
    let (x, y) = (along(0), along(1));
    [mean(&x), mean(&y), deviation(&x), deviation(&y)]
}

/// Places of many members on the finest level.
fn on_finest(count: u64) -> Vec<[f64; 2]> {
    let draws = crate::support::independent(count, 4, 4711);
    draws.iter().map(|u| place(u, FINEST_M)).collect()
}

#[test]
fn corrected_places_have_the_moments_of_the_finest_level() {
    let truth = moments(&on_finest(50_000));
    let found: Vec<[f64; 4]> = (0..20)
        .map(|seed| moments(&places(seed, place).places_m))
        .collect();
    for (axis, truth) in truth.into_iter().enumerate() {
        let found = mean(&found.iter().map(|one| one[axis]).collect::<Vec<f64>>());
        assert!((found - truth).abs() < 0.004, "{axis}: {found} {truth}");
    }
}

#[test]
fn a_region_holds_its_probability_of_places_on_the_finest_level() {
    let fresh = on_finest(4000);
    let held = |seed| {
        let found = RestDistribution::of(&places(seed, place), &[0.9]);
        let within = fresh
            .iter()
            .filter(|place| found.contains(0, **place))
            .count();
        within as f64 / fresh.len() as f64
    };
    let held: Vec<f64> = (0..8).map(held).collect();
    assert!((mean(&held) - 0.9).abs() < 0.015, "{held:?}");
}

#[test]
fn a_body_at_rest_on_all_levels_stays_there() {
    let still = [0.3, -0.2];
    let on = |u: &[f64], cells: f64| if u[2] < 0.4 { still } else { place(u, cells) };
    let found = places(1, on).places_m;
    let there = found.iter().filter(|place| **place == still).count();
    assert!((195..215).contains(&there), "{there} of 512 rest there");
}

#[test]
fn places_on_a_line_are_corrected_along_it() {
    let found = places(1, |u, cells| [(1.0 - 5.0 * cells) * u[0] + 0.2, 0.0]).places_m;
    let exact = moments(&found);
    assert!((exact[0] - (0.5 * 0.925 + 0.2)).abs() < 1e-3, "{exact:?}");
    assert!(found.iter().all(|place| place[1].abs() < 1e-9));
}

#[test]
fn members_that_still_move_on_their_finest_level_are_counted() {
    let study = study(MEMBERS, 1, &json!([]));
    let ensemble = Ensemble::of(&study).unwrap();
    let mut members = runs(&ensemble, |u, cells| rested(place(u, cells), 0.0));
    let moves = |member: &Member| member.index == 5 || member.index == 400;
    for member in members.iter_mut().filter(|member| moves(member)) {
        let scree_studies::MemberOutcome::Finished(finished) = &mut member.outcome else {
            panic!("it failed");
        };
        // The first one only on the coarsest level, which its finer runs correct.
        finished.bodies[0].moving = member.level == 0;
    }
    let found = RestingPlaces::of(&ensemble, &members, 0);
    assert_eq!((found.moving, found.unknown), (1, 1));
}
