mod sliding;

use super::contact_points::FeaturePair;
use super::*;
use crate::math::Mat3;
use crate::rigid::fixture::{cuboid, of_shape, tetrahedron};
use crate::shape::SpheroPolyhedron;
use nalgebra::UnitQuaternion;

/// Pseudo-random numbers in −1 … 1 (Weyl's sequence).
struct Numbers(f64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = (self.0 + 0.754_877_666_246_692_7).fract();
        (self.0 * 12.345).fract() * 2.0 - 1.0
    }

    fn vector(&mut self) -> Vec3 {
        Vec3::new(self.next(), self.next(), self.next())
    }
}

fn law(pair: [&Body; 2]) -> ContactLaw {
    pair_law(pair[0], pair[1])
}

fn undamped(mut body: Body) -> Body {
    body.wall_law.damping = 0.0;
    body.wall_law.friction = 0.0;
    body
}

fn moved(body: &Body, along: &Vec3, turn: &Vec3) -> Body {
    let mut body = body.clone();
    body.state.position += along;
    body.state.orientation = UnitQuaternion::from_scaled_axis(*turn) * body.state.orientation;
    body
}

/// Contacts of two bodies, searched for without history.
fn touching(first: &Body, second: &Body) -> Contacts {
    let law = law([first, second]);
    let mut found = Contacts::default();
    contacts(
        [first, second],
        &law,
        &mut Separation::default(),
        &mut found,
    );
    found
}

/// Updates contacts and forces after a drift of `dt`.
fn touch(
    contact_pair: &mut ContactPair,
    pair: [&Body; 2],
    law: &ContactLaw,
    dt: f64,
    separation: &mut Separation,
) -> Exchange {
    let mut found = Contacts::default();
    contact_pair.find(pair, law, separation, &mut found);
    contact_pair.touch(pair, law, &mut found, dt);
    contact_pair.exchange(pair)
}

fn potential(first: &Body, second: &Body) -> f64 {
    touching(first, second).energy
}

/// Brings the second body along `direction` until it overlaps by `depth`.
fn brought_together(first: &Body, second: &mut Body, direction: &Vec3, depth: f64) {
    let (mut near, mut far) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (near + far);
        second.state.position = first.state.position + direction * middle;
        if touching(first, second).places.is_empty() {
            far = middle;
        } else {
            near = middle;
        }
    }
    second.state.position = first.state.position + direction * (far - depth);
}

/// Random pairs of many kinds that touch.
fn touching_pairs(count: usize) -> Vec<[Body; 2]> {
    let kinds = [
        cuboid([0.04; 3]),
        tetrahedron(0.05),
        cuboid([0.03, 0.05, 0.07]),
    ];
    touching_pairs_of(&kinds, count)
}

/// Random pairs that touch, balls and capsules and a box among them.
fn round_pairs(count: usize) -> Vec<[Body; 2]> {
    let ball = SpheroPolyhedron::ball(0.02).expect("a ball");
    let capsule = SpheroPolyhedron::capsule(0.01, 0.06).expect("a capsule");
    let kinds = [
        of_shape(ball),
        of_shape(capsule),
        cuboid([0.03, 0.05, 0.07]),
    ];
    let both_boxes = |pair: &[Body; 2]| pair.iter().all(|body| !body.shape.faces().is_empty());
    let mut pairs = touching_pairs_of(&kinds, count);
    pairs.retain(|pair| !both_boxes(pair));
    pairs
}

fn touching_pairs_of(kinds: &[Body; 3], count: usize) -> Vec<[Body; 2]> {
    let mut numbers = Numbers(0.1);
    let mut pair = |n: usize| {
        let first = moved(&kinds[n % 3], &numbers.vector(), &(numbers.vector() * 3.0));
        let mut second = moved(&kinds[n / 3 % 3], &Vec3::zeros(), &(numbers.vector() * 3.0));
        let direction = numbers.vector().normalize();
        brought_together(&first, &mut second, &direction, 4e-4);
        [first, second]
    };
    (0..count).map(&mut pair).collect()
}

// The force is minus the gradient of the potential, against central differences.
#[test]
fn forces_are_the_gradient_of_the_potential() {
    for [first, second] in touching_pairs(60).iter().chain(&round_pairs(90)) {
        let found = touching(first, second);
        assert!(!found.places.is_empty());
        let on_second =
            Exchange::of(&found.push, &(second.state.position - first.state.position)).on_second;
        let step = 1e-8;
        let slope = |along: Vec3, turn: Vec3| {
            let ahead = potential(first, &moved(second, &(along * step), &(turn * step)));
            let behind = potential(first, &moved(second, &(along * -step), &(turn * -step)));
            (ahead - behind) / (2.0 * step)
        };
        let axes = Mat3::identity();
        let force = Vec3::from_fn(|k, _| -slope(axes.column(k).into(), Vec3::zeros()));
        let torque = Vec3::from_fn(|k, _| -slope(Vec3::zeros(), axes.column(k).into()));
        let size = on_second.force.norm();
        // Differences over 1e-8 m of energies known to 1e-16 of themselves.
        assert!(
            (force - on_second.force).norm() < 1e-4 * size,
            "{force} {on_second:?}"
        );
        assert!((torque - on_second.torque).norm() < 1e-4 * size * 0.04);
    }
}

// The order of the bodies does not matter where features are not tiny.
#[test]
fn the_order_of_the_bodies_does_not_matter() {
    for [first, second] in touching_pairs(60).iter().chain(&round_pairs(90)) {
        let (one, other) = (potential(first, second), potential(second, first));
        assert!((one / other - 1.0).abs() < 1e-9, "{one} {other}");
    }
}

// Bodies that meet in a random orientation touch in one place, the nearest: the potential is
// that of one contact there, whatever its features. Where a second place is almost as near, it
// is more, never less.
#[test]
fn bodies_that_meet_at_random_touch_once() {
    let pairs = touching_pairs(90);
    let pose = |body: &Body| {
        let translation = nalgebra::Translation3::from(body.state.position);
        nalgebra::Isometry3::from_parts(translation, body.state.orientation)
    };
    let mut once = [0; 3];
    for [first, second] in &pairs {
        let found = touching(first, second);
        let (a, b) = (&first.shape, &second.shape);
        let distance = crate::shape::separation(a, &pose(first), b, &pose(second));
        let overlap = a.sphero_radius() + b.sphero_radius() - distance;
        let count = found.energy / of_one(first, second, overlap);
        assert!(count > 1.0 - 1e-9 && count < 2.5, "{count}");
        if count < 1.0 + 1e-9 {
            let kind = found
                .places
                .iter()
                .max_by(|a, b| a.share.total_cmp(&b.share));
            match kind.expect("they touch").between {
                FeaturePair::VertexOfFirst(_) => once[0] += 1,
                FeaturePair::VertexOfSecond(_) => once[1] += 1,
                FeaturePair::Edges(..) => once[2] += 1,
            }
        }
    }
    assert!(once.iter().all(|kind| *kind >= 8), "{once:?}");
    assert!(once.iter().sum::<i32>() > 70, "{once:?}");
}

// A ball touches in one place, whatever it meets; so does a capsule that is not nearly parallel to
// what it touches, and its known gap changes nothing.
#[test]
fn round_bodies_touch_once() {
    let pairs = round_pairs(180);
    let mut once = 0;
    for [first, second] in &pairs {
        let found = touching(first, second);
        let pose = |body: &Body| {
            let translation = nalgebra::Translation3::from(body.state.position);
            nalgebra::Isometry3::from_parts(translation, body.state.orientation)
        };
        let (a, b) = (&first.shape, &second.shape);
        let distance = crate::shape::separation(a, &pose(first), b, &pose(second));
        let overlap = a.sphero_radius() + b.sphero_radius() - distance;
        let count = found.energy / of_one(first, second, overlap);
        let has_ball = [a, b].iter().any(|shape| shape.core_vertices().len() == 1);
        assert!(count > 1.0 - 1e-9 && count < 2.5, "{count}");
        assert!(!has_ball || count < 1.0 + 1e-9, "{count}");
        once += i32::from(count < 1.0 + 1e-9);
        assert!(
            (least_gap(first, second) + overlap).abs() < 1e-12
                || !a.faces().is_empty()
                || !b.faces().is_empty()
        );
    }
    assert!(once > 150, "{once} of {}", pairs.len());
}

// Side by side two capsules carry each other at the ends of their common length, each once.
#[test]
fn parallel_capsules_touch_at_the_ends_of_their_common_length() {
    let capsule = || of_shape(SpheroPolyhedron::capsule(0.01, 0.06).expect("a capsule"));
    let (first, mut second) = (capsule(), capsule());
    second.state.position = Vec3::new(0.015, 0.0, 0.02 - 1e-4);
    let found = touching(&first, &second);
    let mut places: Vec<f64> = found
        .places
        .iter()
        .map(|contact| contact.near.place.x)
        .collect();
    places.sort_by(f64::total_cmp);
    assert_eq!(places.len(), 2);
    assert!(
        (places[0] + 0.005).abs() < 1e-12 && (places[1] - 0.02).abs() < 1e-12,
        "{places:?}"
    );
    let count = found.energy / of_one(&first, &second, 1e-4);
    assert!((count - 2.0).abs() < 1e-9, "{count}");
    assert!((found.push.force.normalize() - Vec3::z()).norm() < 1e-12);
}

/// Energy of one contact with this overlap [J].
fn of_one(first: &Body, second: &Body, overlap: f64) -> f64 {
    law([first, second]).elastic_energy(overlap)
}

/// The second cube on top of the first, overlapping by `overlap`, shifted and yawed.
fn stacked(sides: [f64; 2], shift: [f64; 2], yaw: f64, overlap: f64) -> [Body; 2] {
    let [below, mut above] = sides.map(|side| cuboid([side; 3]));
    let height = 0.5 * (sides[0] + sides[1]) - overlap;
    above.state.position = Vec3::new(shift[0], shift[1], height);
    above.state.orientation = UnitQuaternion::from_scaled_axis(Vec3::z() * yaw);
    [below, above]
}

// Every corner of the common area once: four for a small cube on a large one, for
// equal cubes in line, for equal cubes shifted along one side or both; eight where
// the sides cross at 45°.
#[test]
fn faces_on_each_other_are_carried_at_the_corners_of_their_common_area() {
    let overlap = 1e-5;
    let count = |sides, shift, yaw| {
        let [below, above] = stacked(sides, shift, yaw, overlap);
        potential(&below, &above) / of_one(&below, &above, overlap)
    };
    for (sides, shift, yaw, corners) in [
        ([0.08, 0.04], [0.01, 0.005], 0.3, 4.0),
        ([0.04, 0.04], [0.0, 0.0], 0.0, 4.0),
        ([0.04, 0.04], [0.013, 0.0], 0.0, 4.0),
        ([0.04, 0.04], [0.013, 0.021], 0.0, 4.0),
        ([0.04, 0.04], [0.0, 0.0], std::f64::consts::FRAC_PI_4, 8.0),
    ] {
        let got = count(sides, shift, yaw);
        assert!(
            (got - corners).abs() < 1e-9,
            "{sides:?} {shift:?} {yaw}: {got}"
        );
    }
}
