//! Reductions against the full model.

use crate::scenes::{PRECISIONS, Scene, points_by_id, run};
use scree_solver::Audit;
use scree_solver::Simulation;
use scree_solver::points::Point;
use scree_solver::simulation::Share;
use serde_json::json;

/// Largest distance of a reduced run from the full one: rounding, and its growth.
#[derive(Clone, Copy)]
struct Bounds {
    precision: &'static str,
    /// Difference of a body's position [m].
    body: f64,
    /// Mean difference of the points' positions [m].
    points: f64,
}

/// Measured in double precision, after 0.3 s: a slab that became the whole 4e-15 m (cube) and
/// 5e-16 m (points). The bounds in single precision are a tenth of a percent of the path.
const EACH: [Bounds; 2] = [
    Bounds {
        precision: PRECISIONS[0],
        body: 1e-9,
        points: 1e-9,
    },
    Bounds {
        precision: PRECISIONS[1],
        body: 1e-3,
        points: 1e-3,
    },
];

/// A cube struck after 0.1 s, with so many cells across the channel.
fn struck(cells_across: u32) -> Scene {
    Scene::channel(45.0, 1.0, 1.0, 0.2)
        .flow(json!({"volume_m3": 0.003, "release": {"height_m": 0.1, "toe_distance_m": 0.1}}))
        .body(json!({"shape": {"cube": {"side_m": 0.04}}, "position": {"downstream_m": 0.04}}))
        .set("numerics", "cell_size_m", 0.2 / f64::from(cells_across))
        .lasting(0.4)
}

/// Mean distance of the points of two runs, by identity [m].
fn mean_distance(one: &[Point], other: &[Point]) -> f64 {
    assert_eq!(one.len(), other.len());
    let pairs = one.iter().zip(other);
    let distances = pairs.map(|(a, b)| {
        assert_eq!(a.id, b.id);
        (a.position - b.position).norm()
    });
    distances.sum::<f64>() / one.len() as f64
}

/// Compares two runs of the same scene, every tenth of a second.
fn compare(reduced: &mut Simulation, full: &mut Simulation, bounds: &Bounds) {
    for tenths in 1..=4 {
        let until_s = f64::from(tenths) / 10.0;
        run(reduced, until_s);
        run(full, until_s);
        let places = [&*reduced, full].map(|run| run.bodies()[0].state.position);
        let body = (places[0] - places[1]).norm();
        let points = mean_distance(&points_by_id(reduced), &points_by_id(full));
        println!(
            "{}, {until_s} s, {:?}: cube {body:.1e} m, points {points:.1e} m",
            bounds.precision,
            reduced.share()
        );
        assert!(body < bounds.body && points < bounds.points);
        assert_eq!(reduced.point_count(), full.point_count());
        same_books(reduced, full);
    }
}

/// Checks that mass and balances are those of the whole flow.
fn same_books(reduced: &Simulation, full: &Simulation) {
    let (ours, theirs) = (reduced.audit(), full.audit());
    assert!((ours.released_mass / theirs.released_mass - 1.0).abs() < 1e-12);
    assert!(ours.mass_error < 1e-6, "{}", ours.mass_error);
    let residuals = |audit: &Audit| [audit.momentum_residual, audit.angular_momentum_residual];
    for (our, their) in residuals(ours).into_iter().zip(residuals(theirs)) {
        println!("residual {our:.1e}, of the full run {their:.1e}");
        // Except for penetration corrections, which differ by little.
        assert!(our <= 1.5 * their + 1e-6);
    }
}

#[test]
fn a_half_moves_as_the_whole() {
    // With nodes in the centre plane, and without.
    for (bounds, cells_across) in EACH.into_iter().flat_map(|of| [(of, 10), (of, 9)]) {
        let scene = struck(cells_across).precision(bounds.precision);
        let mut half = scene.clone().set("numerics", "symmetry", "mirror");
        half = half.set("numerics", "approach", "full");
        let (mut half, mut full) = (half.start(), scene.full().start());
        assert_eq!(half.share(), Share::Half);
        assert_eq!(half.released_points(), full.released_points());
        compare(&mut half, &mut full, &bounds);
        assert!(
            half.bodies()[0].state.position.x > 0.06,
            "the cube was not struck"
        );
        assert_eq!(half.bodies()[0].state.position.y, 0.0);
        let computed = half.counts().2 as f64 / full.counts().2 as f64;
        assert!((0.49..=0.51).contains(&computed), "{computed}");
    }
}

// An odd number of points across a cell would leave one of nine rows in the centre plane: the channel
// has eight or ten cells then.
#[test]
fn a_half_moves_as_the_whole_with_any_number_of_points_in_a_cell() {
    let bounds = &EACH[0];
    for per_cell in [1, 2, 16] {
        let scene = struck(9).precision(bounds.precision);
        let scene = scene.set("numerics", "points_per_cell", per_cell);
        let half = scene.clone().set("numerics", "symmetry", "mirror");
        let half = half.set("numerics", "approach", "full");
        let (mut half, mut full) = (half.start(), scene.full().start());
        assert_eq!(half.share(), Share::Half);
        compare(&mut half, &mut full, bounds);
    }
}

#[test]
fn a_slab_becomes_a_half_between_nodes() {
    for bounds in EACH {
        let scene = struck(9).precision(bounds.precision);
        let (mut slab, mut full) = (scene.start(), scene.full().start());
        assert_eq!(slab.share(), Share::Slab);
        compare(&mut slab, &mut full, &bounds);
        assert_eq!(slab.share(), Share::Half);
    }
}

#[test]
fn a_slab_becomes_the_whole() {
    for bounds in EACH {
        let scene = struck(10)
            .first_body("yaw_deg", 20.0)
            .precision(bounds.precision);
        let slab = scene.clone().set("numerics", "approach", "slab");
        let (mut slab, mut full) = (slab.start(), scene.full().start());
        assert_eq!(slab.share(), Share::Slab);
        compare(&mut slab, &mut full, &bounds);
        assert_eq!(slab.share(), Share::Whole);
    }
}
