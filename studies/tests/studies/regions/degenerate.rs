//! Places that no density fits, and members without a place.

use super::{Map, normal, places, skewed, sobol};
use crate::support::{independent, mean, rested, unit_study, z};
use scree_studies::answers::{RestDistribution, RestingPlaces};
use scree_studies::{Ensemble, Member, MemberOutcome};
use serde_json::json;

#[test]
fn one_place_alone_is_an_atom() {
    let same = places(&sobol(64, 1, 1), |_| [0.3, -0.1]);
    let rest = RestDistribution::of(&same, &[0.5, 0.9]);
    assert_eq!(rest.atoms.len(), 1);
    assert_eq!(
        (rest.atoms[0].place_m, rest.atoms[0].share),
        ([0.3, -0.1], 1.0)
    );
    assert_eq!(rest.density, None);
    let region = &rest.regions[1];
    assert_eq!(
        (region.area_m2, region.level_per_m2, region.atoms),
        (0.0, None, 1)
    );
    assert_eq!(region.members.estimate, Some(1.0));
    assert!(rest.contains(1, [0.3, -0.1]) && !rest.contains(1, [0.3, 0.1]));
}

#[test]
fn a_body_that_often_stays_where_it_is_has_an_atom_and_a_density() {
    let often_still = |u: &[f64]| if u[2] < 0.4 { [0.0, 0.0] } else { skewed(u) };
    let share = |seed: u64, region: usize| {
        let rest = RestDistribution::of(&places(&sobol(256, seed, 3), often_still), &[0.3, 0.9]);
        assert_eq!(rest.atoms.len(), 1);
        assert!((rest.atoms[0].share - 0.4).abs() < 0.01);
        assert_eq!(rest.regions[0].level_per_m2, None);
        assert!(rest.regions[1].area_m2 > 0.05);
        let fresh = independent(1000, 3, 50 + seed);
        let within = fresh
            .iter()
            .filter(|u| rest.contains(region, often_still(u)));
        within.count() as f64 / 1000.0
    };
    let shares: Vec<f64> = (0..6).map(|seed| share(seed, 1)).collect();
    assert!((mean(&shares) - 0.9).abs() < 0.02, "{shares:?}");
    let atom = share(0, 0);
    assert!((atom - 0.4).abs() < 0.05, "{atom}");
}

#[test]
fn places_on_a_line_have_a_narrow_region() {
    let lines: [Map; 3] = [
        |u| [z(u[0]), 0.0],
        |u| [5.0, z(u[0])],
        |u| [z(u[0]), 2.0 * z(u[0])],
    ];
    for line in lines {
        let rest = RestDistribution::of(&places(&sobol(256, 2, 1), line), &[0.9]);
        let fresh = independent(1000, 1, 3);
        let within = fresh.iter().filter(|u| rest.contains(0, line(u))).count();
        assert!((870..=935).contains(&within), "{within}");
        assert!(rest.regions[0].area_m2.is_finite() && rest.regions[0].area_m2 > 0.0);
    }
}

#[test]
fn a_far_place_does_not_widen_the_region() {
    let mut given = places(&sobol(256, 2, 2), normal);
    let near = RestDistribution::of(&given, &[0.9]).regions[0].area_m2;
    given.places_m[100] = [300.0, -40.0];
    let far = RestDistribution::of(&given, &[0.9]).regions[0].area_m2;
    assert!((0.9..1.6).contains(&(far / near)), "{far} {near}");
}

#[test]
fn too_few_members_have_no_region() {
    let few = places(&sobol(16, 1, 2), normal);
    let rest = RestDistribution::of(&few, &[0.5, 0.9, 0.95]);
    assert_eq!(rest.regions.len(), 2);
    assert_eq!(rest.too_few_members_for, [0.95]);
    let fewer = places(&sobol(8, 1, 2), normal);
    assert_eq!(
        RestDistribution::of(&fewer, &[0.5]).too_few_members_for,
        [0.5]
    );
    let none = RestDistribution::of(&RestingPlaces::default(), &[0.5]);
    assert!(none.atoms.is_empty() && none.density.is_none() && none.regions.is_empty());
    assert!(!none.contains(0, [0.0, 0.0]));
}

#[test]
fn moving_and_failed_members_are_unknown_and_widen_the_share() {
    let study = unit_study(2, &json!({"sobol": {"members": 64, "seed": 1}}), &json!([]));
    let ensemble = Ensemble::of(&study).unwrap();
    let member = |(index, u): (usize, &Vec<f64>)| Member {
        level: 0,
        index: index as u64,
        outcome: rested([u[0], u[1]], 0.0),
    };
    let mut members: Vec<Member> = sobol(64, 1, 2).iter().enumerate().map(member).collect();
    if let MemberOutcome::Finished(finished) = &mut members[7].outcome {
        finished.bodies[0].moving = true;
    }
    members[9].outcome = MemberOutcome::failed("diverged");
    let found = RestingPlaces::of(&ensemble, &members, 0);
    assert_eq!(
        (found.places_m.len(), found.moving, found.unknown),
        (62, 1, 2)
    );
    let rest = RestDistribution::of(&found, &[0.5]);
    let known = RestDistribution::of(
        &RestingPlaces {
            unknown: 0,
            ..found
        },
        &[0.5],
    );
    assert_eq!(rest.moving, 1);
    assert!(rest.regions[0].members.upper > known.regions[0].members.upper);
    assert!(rest.regions[0].members.lower < known.regions[0].members.lower);
}
