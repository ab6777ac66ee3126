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
    contacts(first, second, &law, &mut Separation::default())
}

/// Updates contacts and forces after a drift of `dt`.
fn touch(
    contact_pair: &mut ContactPair,
    pair: [&Body; 2],
    law: &ContactLaw,
    dt: f64,
    separation: &mut Separation,
) -> Exchange {
    let found = contact_pair.find(pair, law, separation);
    contact_pair.touch(pair, law, &found, dt);
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

// A cube that stands on a vertex is slid off another at a constant height above its top: over
// the face, past the edge and the vertex. The energy is that of one contact all the way,
// falling only as the vertex goes over the rim. Force and energy change by no more than their
// slope allows; with steps halved they change by half.
#[test]
fn a_vertex_slides_from_face_to_edge_to_vertex_without_a_jump() {
    let diagonal = UnitQuaternion::rotation_between(&Vec3::new(1.0, 1.0, 1.0), &-Vec3::z());
    let overlap = 2e-4;
    let below = undamped(cuboid([0.04; 3]));
    let mut standing = below.clone();
    standing.state.orientation = diagonal.expect("not opposite");
    let at = |x: f64, y: f64| {
        let mut above = standing.clone();
        let reach = above.shape.extent_along(&above.to_body(&-Vec3::z()));
        above.state.position = Vec3::new(x, y, 0.02 + reach - overlap);
        let found = touching(&below, &above);
        (found.energy, found.push.force)
    };
    let one = of_one(&below, &standing, overlap);
    let largest = law([&below, &standing]).elastic_force(overlap);
    // Along a line that meets the rim, and along the rim past its end.
    for way in [
        [[0.0, 0.005], [0.022, 0.005]],
        [[0.0, 0.016], [0.022, 0.016]],
        [[0.0, 0.0], [0.022, 0.022]],
    ] {
        let jump = |steps: usize| {
            let place = |n: usize| {
                let share = n as f64 / steps as f64;
                let along = |axis: usize| way[0][axis] + share * (way[1][axis] - way[0][axis]);
                at(along(0), along(1))
            };
            let mut jump: (f64, f64) = (0.0, 0.0);
            let mut last = place(0);
            assert!(
                (last.0 / one - 1.0).abs() < 1e-9,
                "it starts on the face, once"
            );
            for n in 1..=steps {
                let now = place(n);
                assert!(now.0 < one * (1.0 + 1e-9), "counted twice: {}", now.0 / one);
                jump.0 = jump.0.max((now.0 - last.0).abs() / one);
                jump.1 = jump.1.max((now.1 - last.1).norm() / largest);
                last = now;
            }
            assert_eq!(last.0, 0.0, "it ends beside");
            jump
        };
        let (coarse, fine) = (jump(2_000), jump(8_000));
        assert!(
            fine.0 < 0.3 * coarse.0 && fine.1 < 0.35 * coarse.1,
            "{coarse:?} {fine:?}"
        );
    }
}

// The lower edge of a cube is dragged over a rim, one end first: the contact at that end hands
// its place and its spring over to the crossing of the two edges. Normal force and friction
// continue without a jump, and friction stays at μ F_n.
#[test]
fn friction_goes_on_while_a_contact_changes_its_features() {
    let below = undamped(cuboid([0.04; 3]));
    let mut above = undamped(cuboid([0.04; 3]));
    let law = ContactLaw {
        friction: 0.5,
        ..law([&below, &above])
    };
    let about_x = UnitQuaternion::from_scaled_axis(Vec3::x() * 0.7);
    // The leading end a little lower.
    let about_y = UnitQuaternion::from_scaled_axis(Vec3::y() * 0.01);
    above.state.orientation = about_y * about_x;
    let reach = above.shape.extent_along(&above.to_body(&-Vec3::z()));
    above.state.momentum = Vec3::x() * above.mass;
    let mut contact_pair = ContactPair::new([0, 1]);
    let mut forces: Vec<Vec3> = Vec::new();
    let mut kinds = Vec::new();
    let (steps, step) = (8_000, 1e-6);
    for n in 0..steps {
        let x = -0.004 + step * f64::from(n);
        above.state.position = Vec3::new(x, 0.0, 0.02 + reach - 2e-4);
        let exchange = touch(
            &mut contact_pair,
            [&below, &above],
            &law,
            step,
            &mut Separation::default(),
        );
        forces.push(exchange.on_second.force);
        kinds.push(
            contact_pair
                .springs
                .iter()
                .map(|s| s.between)
                .collect::<Vec<_>>(),
        );
    }
    let has_crossing = |kinds: &Vec<FeaturePair>| {
        kinds
            .iter()
            .any(|kind| matches!(kind, FeaturePair::Edges(..)))
    };
    assert!(!has_crossing(&kinds[0]) && has_crossing(&kinds[steps as usize - 1]));
    let size = forces[0].norm();
    for pair in forces.windows(2).skip(200) {
        let jump = (pair[1] - pair[0]).norm() / size;
        assert!(jump < 5e-3, "{jump}: {pair:?}");
    }
    // The rounded rim tilts the normal, by far less than this.
    for force in &forces[200..] {
        assert!((-force.x / force.z / 0.5 - 1.0).abs() < 0.2, "{force}");
    }
}

// The bound kept from the last evaluation only saves work: bodies that fly past each other,
// turning, give the same bits as with the bound discarded at every step.
#[test]
fn what_is_known_of_the_gap_changes_no_bit() {
    let (mut numbers, mut touched, mut spared) = (Numbers(0.3), 0, 0);
    let h = 1e-4;
    for kinds in [
        [cuboid([0.04; 3]), tetrahedron(0.05)],
        [cuboid([0.03, 0.04, 0.05]), cuboid([0.01, 0.05, 0.02])],
    ] {
        let [first, mut second] = kinds.map(undamped);
        for _ in 0..20 {
            let from = numbers.vector().normalize() * 0.09;
            second.state.position = first.state.position + from;
            let aim = 0.02 * numbers.vector() - from;
            second.state.momentum = aim.normalize() * second.mass;
            second.state.angular_momentum = second.inertia * numbers.vector() * 30.0;
            let law = law([&first, &second]);
            let (mut knowing, mut forgetting) =
                (ContactPair::new([0, 1]), ContactPair::new([0, 1]));
            let mut separation = Separation::default();
            for _ in 0..1000 {
                second.drift(h);
                let pair = [&first, &second];
                let afresh = touch(&mut forgetting, pair, &law, h, &mut Separation::default());
                if separation.outlasts(h * (first.speed_bound() + second.speed_bound())) {
                    assert_eq!(afresh, Exchange::default());
                    spared += 1;
                } else {
                    assert_eq!(touch(&mut knowing, pair, &law, h, &mut separation), afresh);
                }
                assert_eq!(knowing, forgetting);
                touched += usize::from(knowing.touches());
                if knowing.deepest > 1e-3 {
                    break;
                }
            }
        }
    }
    assert!(touched > 100 && spared > 10_000, "{touched} {spared}");
}

/// Force over that of one contact as deep, for a plate of this thickness that stands on its
/// short edge, across an edge of a cube below, overlapping by `depth`.
fn counted(thickness: f64, depth: f64) -> f64 {
    let eighth = std::f64::consts::FRAC_PI_4;
    let below = moved(
        &undamped(cuboid([0.04; 3])),
        &Vec3::zeros(),
        &(Vec3::y() * eighth),
    );
    let radius = below.shape.sphero_radius();
    let sides = [thickness, 0.02, 0.02].map(|side| side + 2.0 * radius);
    let mut above = below.clone();
    above.shape = SpheroPolyhedron::cuboid(sides, radius).expect("a rounded plate");
    above.state.orientation = UnitQuaternion::from_scaled_axis(Vec3::x() * eighth);
    let half_diagonal = |half_side: f64| half_side * 2f64.sqrt();
    let height = half_diagonal(0.02 - radius) + half_diagonal(0.01) + 2.0 * radius - depth;
    above.state.position = below.state.position + Vec3::z() * height;
    let found = touching(&below, &above);
    found.push.force.z / law([&below, &above]).elastic_force(depth)
}

#[expect(clippy::print_stdout, reason = "the table of docs/method.md")]
fn tell(row: &str) {
    println!("{row}");
}

// Where one edge crosses another, both ends of a short one touch as well: the force is doubled
// for an edge of no length, single beyond 2 sqrt(2 R delta), R the sum of the radii; the table
// is that of docs/method.md.
#[test]
fn a_short_edge_counts_up_to_twice() {
    let radii = 2.0 * cuboid([0.04; 3]).shape.sphero_radius();
    let depth = 0.05 * radii;
    let reach = (2.0 * radii * depth).sqrt();
    let mut before = 2.0 + 1e-9;
    for over_reach in [0.05, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0, 3.0] {
        let times = counted(over_reach * reach, depth);
        tell(&format!(
            "edge / sqrt(2 R delta) = {over_reach}: counted {times:.3} times"
        ));
        assert!(times <= before && times > 1.0 - 1e-9, "{times}");
        before = times;
    }
    assert!(counted(0.05 * reach, depth) > 1.95);
    assert!((before - 1.0).abs() < 1e-12, "{before}");
}
