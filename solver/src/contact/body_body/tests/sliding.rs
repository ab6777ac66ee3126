//! Tests of bodies that slide and fly past each other, and of short edges.

use super::*;
use crate::rigid::approach_bound;

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
                if separation.outlasts(h * approach_bound(&first, &second)) {
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
