use super::*;
use crate::bed::PlanarBed;

fn lattice() -> Lattice {
    Lattice {
        origin: Vec3::new(0.013, -0.007, 0.002),
        spacing: Vec3::new(0.1, 0.1, 0.1),
    }
}

fn ground(of: impl Fn(f64, f64) -> f64) -> HeightField {
    let raster = Raster::sampled([60, 40], 0.1, of);
    let surface = Arc::new(SplineSurface::through(&raster, 0.0));
    HeightField::new(surface, TerrainFriction::Constant(0.4)).under(&lattice())
}

// A plane as a raster is to nodes what it is as a plane.
#[test]
fn a_plane_raster_is_an_incline_to_nodes() {
    let inclination = 0.5_f64;
    let planar = PlanarBed::incline(inclination, 2.0, 0.4);
    let field = ground(|x, _| 2.0 / inclination.cos() - x * inclination.tan());
    let lattice = lattice();
    for across in [[3, 4], [20, 11], [41, 30]] {
        let one = planar
            .intersection(Way::Vertical, across, &lattice)
            .unwrap();
        let other = field.intersection(Way::Vertical, across, &lattice).unwrap();
        assert_eq!(one.first, other.first);
        assert!((one.gap - other.gap).abs() < 1e-9);
        let [one, other] = [&planar as &dyn Bed, &field]
            .map(|bed| bed.surface_in(Way::Vertical, across, &lattice).unwrap());
        assert!((one.normal - other.normal).norm() < 1e-10);
        assert!((one.friction - other.friction).abs() < 1e-12);
        for up in 0..25 {
            let index = [across[0], across[1], up];
            assert_eq!(
                planar.covers(index, &lattice),
                field.covers(index, &lattice)
            );
            let [one, other] =
                [&planar as &dyn Bed, &field].map(|bed| bed.share_above(index, &lattice));
            assert!((one - other).abs() < 1e-9, "{one} {other}");
        }
    }
}

// Round a break between two planes the average slope is that of the planes' own average
// (docs/method.md, equation 29d).
#[test]
fn a_break_is_averaged_as_between_planes() {
    let (inclination, foot) = (0.6_f64, 3.0);
    let channel = PlanarBed::channel(inclination, 0.4);
    let at_the_foot = Lattice {
        origin: lattice().origin - Vec3::x() * foot,
        ..lattice()
    };
    let field = ground(|x, _| ((foot - x) * inclination.tan()).max(0.0));
    for i in 20..40 {
        let one = channel
            .surface_in(Way::Vertical, [i, 10], &at_the_foot)
            .unwrap();
        let other = field
            .surface_in(Way::Vertical, [i, 10], &lattice())
            .unwrap();
        let [one, other] = [one, other].map(|of| -of.normal.x / of.normal.z);
        assert!((one - other).abs() < 0.06, "{i}: {one} {other}");
    }
}

#[test]
fn the_nearest_plane_touches_where_the_surface_is_nearest() {
    let field = ground(|x, y| 0.1 * ((x - 3.0).powi(2) + (y - 2.0).powi(2)));
    let place = Vec3::new(3.7, 2.2, 0.9);
    let plane = field.nearest_plane(&place);
    let foot = place - plane.normal * plane.height(&place);
    let off = field.elevation(foot.x, foot.y) - foot.z;
    assert!(off.abs() < 2e-3, "{off}");
}

#[test]
fn a_block_is_near_if_the_surface_comes_near_one_of_its_nodes() {
    let field = ground(|x, y| 0.2 * x + 0.3 * (3.0 * y).sin());
    let (lattice, margin) = (lattice(), 0.15);
    let mut near = 0;
    for n in 0..14 * 9 * 6 {
        let block = [n % 14, n / 14 % 9, n / 126 - 1];
        let nodes = (0..64).map(|m| {
            let local = [m % 4, m / 4 % 4, m / 16];
            lattice.position([0, 1, 2].map(|axis| 4 * block[axis] + local[axis]))
        });
        let least = nodes.map(|node| field.tangent(node.x, node.y).height(&node));
        let reached = least.fold(f64::INFINITY, f64::min) <= margin;
        near += usize::from(reached);
        assert!(
            !reached || field.is_near_block(block, &lattice, margin),
            "{block:?}"
        );
    }
    assert!(near > 100, "{near}");
    assert!(!field.is_near_block([2, 2, 9], &lattice, margin));
}

// Nothing on the surface is nearer, also where it is bent more than it is far away.
#[test]
fn the_nearest_place_is_nearer_than_all_others() {
    let field = ground(|x, y| 0.3 * x + 0.4 * (4.0 * x).sin() * (5.0 * y).cos());
    for n in 0..60 {
        let [u, v] = [n % 10, n / 10].map(|n| 0.37 * f64::from(n));
        let (x, y) = (0.9 + u, 0.8 + 0.7 * v);
        for height in [-0.3, 0.02, 0.1, 0.4] {
            let place = Vec3::new(x, y, field.elevation(x, y) + height);
            let found = field.nearest_plane(&place).height(&place);
            let places = (0..101 * 101).map(|m| {
                let [a, b] = [m % 101, m / 101].map(|m| 0.01 * f64::from(m) - 0.5);
                (Vec3::new(x + a, y + b, field.elevation(x + a, y + b)) - place).norm()
            });
            let least = places.fold(f64::INFINITY, f64::min);
            assert!(
                found.abs() <= least + 1e-9,
                "{x} {y} {height}: {found} {least}"
            );
            assert_eq!(found > 0.0, height > 0.0);
        }
    }
}

// The height is the gradient's potential: a contact makes no energy.
#[test]
fn the_height_changes_along_its_normal() {
    let field = ground(|x, y| 0.3 * x + 0.2 * (4.0 * x).sin() * (5.0 * y).cos());
    let step = 1e-6;
    for n in 0..40 {
        let [u, v] = [n % 8, n / 8].map(|n| 0.37 * f64::from(n));
        let place = Vec3::new(
            1.1 + u,
            1.2 + 0.3 * v,
            field.elevation(1.1 + u, 1.2 + 0.3 * v) + 0.06,
        );
        let normal = field.nearest_plane(&place).normal;
        for axis in 0..3 {
            let mut aside = Vec3::zeros();
            aside[axis] = step;
            let height = |at: Vec3| field.nearest_plane(&at).height(&at);
            let slope = (height(place + aside) - height(place - aside)) / (2.0 * step);
            assert!(
                (slope - normal[axis]).abs() < 1e-5,
                "{place} {axis}: {slope} {normal}"
            );
        }
    }
}

// On flat ground with a pole a body stands on the pole, and beside it on the ground.
#[test]
fn a_body_is_lowered_to_what_it_touches_first() {
    let field = ground(|x, y| {
        if (x - 3.05).hypot(y - 2.05) < 0.01 {
            3.0
        } else {
            0.0
        }
    });
    let cube = crate::shape::SpheroPolyhedron::cube(0.5, 0.05).expect("a cube");
    let lowest = |x: f64| field.lowest_centre(&cube, UnitQuaternion::identity(), x, 2.05);
    assert!((lowest(1.5) - 0.25).abs() < 1e-9, "{}", lowest(1.5));
    let on_top = lowest(3.05) - 0.25 - field.elevation(3.05, 2.05);
    assert!(on_top.abs() < 0.02, "{on_top}");
    assert!(lowest(2.9) > 0.3 && lowest(2.9) < 3.3, "{}", lowest(2.9));
}

/// A cliff of 4 m at x = 3 that faces east, in map cells of 0.1 m.
fn cliff() -> HeightField {
    ground(|x, _| if x < 3.0 { 4.0 } else { 0.0 })
}

/// Index of the node nearest to a place.
fn node_at(x: f64, y: f64, z: f64) -> [i32; 3] {
    let lattice = lattice();
    [0, 1, 2].map(|axis| {
        ((Vec3::new(x, y, z) - lattice.origin)[axis] / lattice.spacing[axis]).round() as i32
    })
}

fn surfaces(x: f64, z: f64) -> Vec<Vec3> {
    let index = node_at(x, 2.0, z);
    let surfaces = cliff().surfaces_over(index, &lattice());
    let normals = surfaces.into_iter().flatten().map(|surface| surface.normal);
    normals.collect()
}

// A node in the cliff has mass from in front of it only: the plateau above does not act.
#[test]
fn the_face_of_a_cliff_acts_on_the_nodes_behind_it() {
    let [face] = surfaces(2.8, 2.0)[..] else {
        panic!("one surface");
    };
    assert!(face.x > 0.99, "{face}");
    let [plateau] = surfaces(2.0, 3.9)[..] else {
        panic!("one surface");
    };
    assert!(plateau.z > 0.99, "{plateau}");
    let intersection = |x| {
        let [i, j, _] = node_at(x, 2.0, 0.0);
        cliff().intersection(Way::Vertical, [i, j], &lattice())
    };
    assert_eq!(intersection(3.0), None, "no column in the face");
    let beside = intersection(2.0).expect("a column");
    assert!((2..5).contains(&beside.deepest), "{}", beside.deepest);
}

// At its foot a node is behind both, and neither lets anything through.
#[test]
fn ground_and_cliff_act_in_the_corner_between_them() {
    let corner = surfaces(3.0, -0.1);
    let upwards = corner.iter().any(|normal| normal.z > 0.99);
    let eastwards = corner.iter().any(|normal| normal.x > 0.9);
    assert!(upwards && eastwards, "{corner:?}");
}

// From under the plateau the way straight up is long, the face is near.
#[test]
fn the_face_of_a_cliff_is_nearest_to_a_place_behind_it() {
    let place = Vec3::new(2.8, 2.0, 2.0);
    let plane = cliff().nearest_plane(&place);
    let depth = -plane.height(&place);
    assert!((0.1..0.25).contains(&depth), "{depth}");
    assert!(plane.normal.x > 0.99, "{}", plane.normal);
}

// Wherever a place is before or behind a cliff, nothing on plateau, face or ground is nearer.
#[test]
fn no_place_of_a_cliff_is_nearer_than_the_nearest() {
    let field = cliff();
    for n in 0..104 * 60 {
        let [i, k] = [n % 104, n / 104].map(f64::from);
        let place = Vec3::new(2.0 + 0.025 * i, 2.013, -0.401 + 0.1 * k);
        let found = field.nearest_plane(&place).height(&place).abs();
        let places = (0..9000).map(|m| {
            let x = 1.0 + 0.0005 * f64::from(m);
            (Vec3::new(x, place.y, field.elevation(x, place.y)) - place).norm()
        });
        let least = places.fold(f64::INFINITY, f64::min);
        assert!(found <= least + 1e-6, "{place}: {found} {least}");
    }
}
