//! Labels: nothing crosses them, and bodies have the same numbers and colours in both pictures.

use super::drawn::Drawn;
use crate::pictures::fixtures::{
    cube, never_moved, outcome, scenario, slab, slid, sliding_samples, tangled_samples,
};
use crate::pictures::{aerial_view, motion};
use scree_solver::record::FlowSnapshot;
use scree_solver::scenario::{Body, Scenario};
use std::collections::BTreeMap;

fn cubes(count: usize) -> Scenario {
    scenario(
        (0..count)
            .map(|_| cube(0.028, 0.001))
            .collect::<Vec<Body>>(),
    )
}

fn flow() -> Vec<FlowSnapshot> {
    (0..6u8)
        .map(|k| slab(0.6 * f64::from(k), 0.1 * f32::from(k), 1.0))
        .collect()
}

/// Both pictures of many bodies: motion, aerial view.
fn pictures_of(bodies: usize) -> [String; 2] {
    let (scene, samples) = (cubes(bodies), tangled_samples(bodies));
    let result = outcome((0..bodies).map(|_| slid()).collect());
    [
        motion(&scene, &samples, &result).unwrap(),
        aerial_view(&scene, &samples, &flow()).unwrap(),
    ]
}

#[test]
fn nothing_crosses_a_label() {
    for bodies in [1, 2, 5, 10, 12, 13, 40] {
        let [motion, aerial] = pictures_of(bodies);
        let none: [String; 0] = [];
        assert_eq!(Drawn::of(&motion).spoilt(false), none, "{bodies} bodies");
        assert_eq!(Drawn::of(&aerial).spoilt(true), none, "{bodies} bodies");
    }
}

/// The texts of one body alone: wherever its onset, peak and rest are, all of them stand clear.
#[test]
fn nothing_crosses_the_notes_of_one_body() {
    for moving_s in [0.05, 0.3, 1.0, 2.0, 2.9] {
        let mut result = slid();
        result.onset_time_s = Some(0.1 * moving_s);
        result.peak_speed_m_s = 0.6 / moving_s;
        result.peak_speed_time_s = Some(0.5 * moving_s);
        result.stop_time_s = Some(moving_s);
        let samples = sliding_samples(moving_s, 3.0);
        let svg = motion(&cubes(1), &samples, &outcome(vec![result])).unwrap();
        assert_eq!(Drawn::of(&svg).spoilt(false), [""; 0], "{moving_s} s");
        for words in ["onset", "peak", "at rest from", "from where it started"] {
            assert!(svg.contains(words), "{words}, {moving_s} s");
        }
    }
}

/// The colours of the numbers in a picture, and how often each is there.
fn colors(svg: &str) -> BTreeMap<usize, (String, usize)> {
    let mut colors = BTreeMap::new();
    for (number, color) in Drawn::of(svg).numbers() {
        let (known, count) = colors.entry(number).or_insert((color.clone(), 0));
        assert_eq!(*known, color, "number {number}");
        *count += 1;
    }
    colors
}

#[test]
fn every_body_has_one_number_and_one_colour_in_both_pictures() {
    for bodies in [2, 10, 12] {
        let [motion, aerial] = pictures_of(bodies).map(|svg| colors(&svg));
        // Once in the table and in each of three panels; once in each of six panels.
        let expect = |times| move |body| (body, times);
        let counts = |colors: &BTreeMap<usize, (String, usize)>| -> Vec<_> {
            colors
                .iter()
                .map(|(body, (_, times))| (*body, *times))
                .collect()
        };
        assert_eq!(
            counts(&motion),
            (0..bodies).map(expect(4)).collect::<Vec<_>>()
        );
        assert_eq!(
            counts(&aerial),
            (0..bodies).map(expect(6)).collect::<Vec<_>>()
        );
        for (body, (color, _)) in &motion {
            assert_eq!(*color, aerial[body].0, "body {body}");
        }
    }
}

/// Colours and numbers of forty bodies: six have colours, the same in both pictures, and all have
/// numbers in the view from above.
#[test]
fn of_too_many_bodies_those_that_went_farthest_have_colours() {
    let [motion, aerial] = pictures_of(40).map(|svg| colors(&svg));
    assert_eq!(motion.len(), 6);
    assert_eq!(aerial.len(), 40);
    let grey = aerial
        .iter()
        .filter(|(body, _)| !motion.contains_key(*body));
    assert!(grey.clone().all(|(_, (color, _))| color == "#ACB1B8"));
    assert_eq!(grey.count(), 34);
    for (body, (color, _)) in &motion {
        assert_eq!(*color, aerial[body].0, "body {body}");
    }
}

/// Curves that are one and the same: the numbers stand beside their common end.
#[test]
fn bodies_that_never_move_have_numbers_too() {
    let (scene, mut samples) = (cubes(3), tangled_samples(3));
    let first = samples[0].clone();
    for sample in &mut samples {
        sample.bodies.clone_from(&first.bodies);
    }
    let result = outcome((0..3).map(|_| never_moved()).collect());
    let svg = motion(&scene, &samples, &result).unwrap();
    assert!(colors(&svg).values().all(|(_, times)| *times == 4));
    assert_eq!(Drawn::of(&svg).spoilt(false), [""; 0]);
}

/// A body alone is not numbered, and a fixed one is grey.
#[test]
fn a_body_alone_has_no_number_and_a_fixed_one_no_colour() {
    let [motion, aerial] = pictures_of(1).map(|svg| colors(&svg));
    assert!(motion.is_empty() && aerial.is_empty());

    let mut scene = cubes(2);
    scene.bodies[0].fixed = true;
    let aerial = aerial_view(&scene, &tangled_samples(2), &flow()).unwrap();
    assert!(aerial.contains("grey: fixed"));
    let colors = colors(&aerial);
    assert_eq!(colors[&0].0, "#ACB1B8");
    assert_eq!(colors[&1].0, "#C81010");
}
