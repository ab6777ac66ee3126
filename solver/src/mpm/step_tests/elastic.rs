//! Steps of the elastic test law: linear fields, free flight, and a spinning cube.

use super::*;

/// A step without gravity, smoothing and redistribution.
fn elastic(lattice: Lattice, bulk_modulus: f64) -> ReferenceStep<'static> {
    ReferenceStep {
        lattice,
        material: Material {
            bulk_density: 1500.0,
            bulk_modulus,
            shear_modulus: 0.5 * bulk_modulus,
            yielding: Yielding::Never,
        },
        gravity: Vec3::zeros(),
        dt: DT,
        substeps: 1,
        smoothing: StrainRateSmoothing::NONE,
        redistribution: RedistributionRates::NONE,
        bed: &[],
    }
}

// A velocity field v = a + B x whose points carry C = B comes back exactly, up to rounding of
// velocities of order 3.
#[test]
fn linear_fields_come_back() {
    let step = ReferenceStep {
        dt: 0.0,
        ..elastic(lattice(), 1.0)
    };
    let a = Vec3::new(0.3, -0.7, 0.5);
    let b = Mat3::new(5.0, -20.0, 7.0, 13.0, -4.0, 9.0, -11.0, 3.0, 17.0);
    let mut points = cloud(300);
    for point in &mut points {
        (point.velocity, point.affine) = (a + b * point.position, b);
    }
    let (after, _) = stepped(&step, packed::<f64>(&step, &points), levels()[0]);
    for (point, old) in unpacked(&step, &after).iter().zip(&points) {
        assert!((point.velocity - old.velocity).norm() < 1e-13);
        assert!((point.affine - b).norm() < 1e-11);
        assert!((point.position - old.position).norm() < 1e-15);
    }
}

#[test]
fn dust_flies_straight() {
    let step = ReferenceStep {
        substeps: 4,
        ..elastic(lattice(), 0.0)
    };
    let flight = Vec3::new(1.0, -0.5, 2.0);
    let mut points = cloud(300);
    for point in &mut points {
        (point.velocity, point.affine) = (flight, Mat3::zeros());
        point.stress = Sym3::default();
    }
    let (after, _) = stepped(&step, packed::<f64>(&step, &points), levels()[0]);
    for (point, old) in unpacked(&step, &after).iter().zip(&points) {
        assert!((point.velocity - flight).norm() < 1e-14);
        assert!((point.position - old.position - flight * 4e-4).norm() < 1e-15);
        assert!((point.volume / old.volume - 1.0).abs() < 1e-14);
    }
}

/// An elastic cube of 4³ cells and 8³ points that turns about z at 10 rad/s.
fn spinning_cube(lattice: &Lattice) -> Vec<Point> {
    let spin = Mat3::new(0.0, -10.0, 0.0, 10.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    let spacing = 0.5 * lattice.spacing.x;
    let place = |n: u32| (f64::from(n) - 3.5) * spacing;
    let point = |id: u32| {
        let position = Vec3::new(place(id % 8), place(id / 8 % 8), place(id / 64));
        Point {
            id,
            mass: 1500.0 * spacing.powi(3),
            volume: spacing.powi(3),
            position,
            velocity: spin * position,
            affine: spin,
            stress: Sym3::default(),
        }
    };
    (0..512).map(point).collect()
}

// Five steps of 0.2 rad, 200 sub-steps each. The cube is stretched by the centrifugal strain ρ
// (ω R)²/K = 1e-4 and its ringing (measured: 2e-5); without F̂ each step would lose 1 − 1/(1 +
// 0.2²) = 3.9 % of the volume.
#[test]
fn a_spinning_cube_keeps_its_volume() {
    let cells = Lattice {
        origin: Vec3::zeros(),
        spacing: Vec3::repeat(0.01),
    };
    let step = ReferenceStep {
        substeps: 200,
        ..elastic(cells, 6e5)
    };
    let points = spinning_cube(&cells);
    let (before, ..) = momentum(&points, &cells);
    let mut blocks = packed::<f64>(&step, &points);
    for _ in 0..5 {
        (blocks, _) = stepped(&step, blocks, levels()[1]);
    }
    let points = unpacked(&step, &blocks);
    let (after, ..) = momentum(&points, &cells);
    let lost = (after.angular - before.angular).norm() / before.angular.norm();
    assert!(lost < 1e-12, "{lost:e}");
    let tracked: f64 = points.iter().map(|point| point.volume).sum();
    let off = tracked / (512.0 * 0.005f64.powi(3)) - 1.0;
    assert!(off.abs() < 3e-4, "{off:e}");
    // The hull agrees with the tracked volume: the corners keep their distance.
    let diagonal = points[511].position - points[0].position;
    let stretched = diagonal.norm() / (0.035 * 3f64.sqrt()) - 1.0;
    let turned = diagonal.y.atan2(diagonal.x) - std::f64::consts::FRAC_PI_4;
    assert!(stretched.abs() < 1e-3, "{stretched:e}");
    assert!((turned - 1.0).abs() < 2e-3, "{turned}");
}
