use super::*;
use crate::mpm::fixture::levels;
use fearless_simd::dispatch;

const SPACING: Vec3 = Vec3::new(0.01, 0.01, 0.01);
const LATTICE: Lattice = Lattice {
    origin: Vec3::new(0.0, 0.0, 0.0),
    spacing: SPACING,
};

/// Shift [m], volumetric strain and rise of a point in a crowd after so many cells of travel
/// along x: φ = −0.01 as at the transfer, mean −0.02, excess 0.1 with a slope of 20/m along x.
fn in_a_crowd(rates: &RedistributionRates, travel: f64) -> (Vec3, f64, f64) {
    dispatch!(levels()[0], simd => {
        let number = Splat::<_, f64>::new(simd);
        let none = number.of(0.0);
        let seen = PointState {
            volumetric_strain: number.of(-0.01),
            compression_at_transfer: number.of(-0.01),
            mean_compression: number.of(-0.02),
            excess_volume_fraction: number.of(0.1),
            slope: [number.of(20.0 * SPACING.x), none, none],
        };
        let travel = [number.of(travel), none, none];
        let after = redistribute::<_, f64>(simd, rates, &seen, &travel);
        let [x, y, z] = after.shift;
        let shift = Vec3::new(x[0], y[0], z[0]).component_mul(&SPACING);
        (shift, after.volumetric_strain[0], after.rise[0])
    })
}

// By hand, with T = 0.2: shift −0.2 h² · 20/m = −0.4 mm; volumetric strain −0.01
// + 0.4 (−0.02 + 0.01) = −0.014, and more by 0.2 · 5 · 0.1 = a tenth.
#[test]
fn a_point_moves_out_of_a_crowd_and_is_pressed() {
    let (shift, volumetric_strain, _) = in_a_crowd(&RedistributionRates::after(0.2), 0.2);
    assert!((shift - Vec3::new(-4e-4, 0.0, 0.0)).norm() < 1e-12);
    assert!(
        (volumetric_strain + 0.0154).abs() < 1e-12,
        "{volumetric_strain}"
    );
}

#[test]
fn a_point_at_rest_is_left_alone() {
    for rates in [RedistributionRates::after(0.2), RedistributionRates::NONE] {
        assert_eq!(in_a_crowd(&rates, 0.0), (Vec3::zeros(), -0.01, 0.0));
    }
}

fn plane(normal: Vec3) -> Plane {
    Plane {
        name: "a plane",
        normal,
        offset: 0.0,
        flow_friction: 0.4,
    }
}

/// Shift [m] and velocity [m/s] of a point at a position [m], which was moved by so much [m].
fn at_the_bed(bed: &[Plane], position: &Vec3, [moved, shift, velocity]: [Vec3; 3]) -> (Vec3, Vec3) {
    dispatch!(levels()[0], simd => {
        let number = Splat::<_, f64>::new(simd);
        let vectors = |v: &Vec3| [number.of(v.x), number.of(v.y), number.of(v.z)];
        let cells = |v: &Vec3| vectors(&v.component_div(&SPACING));
        let (position, moved) = (cells(position), cells(&moved));
        let (mut shift, mut velocity) = (cells(&shift), vectors(&velocity));
        for plane in bed {
            let zone = NoShiftZone::<f64>::of(plane, &LATTICE);
            let zone = zone.in_block(simd, &[0; 3]);
            zone.keep_off(simd, &position, &moved, &mut shift, &mut velocity);
        }
        (
            Vec3::new(shift[0][0], shift[1][0], shift[2][0]).component_mul(&SPACING),
            Vec3::new(velocity[0][0], velocity[1][0], velocity[2][0]),
        )
    })
}

/// Checks the shift [m] that is left of a point at a height above a floor [m], which was moved by so
/// much [m].
fn check_shift(z: f64, [moved, shift]: [Vec3; 2], expected: Vec3) {
    let floor = [plane(Vec3::z())];
    let position = Vec3::new(0.0, 0.0, z);
    let (found, _) = at_the_bed(&floor, &position, [moved, shift, Vec3::zeros()]);
    assert!((found - expected).norm() < 1e-18, "{z}: {found:?}");
}

#[test]
fn no_point_near_a_wall_is_moved_towards_it() {
    let kept = |z, shift, expected| check_shift(z, [Vec3::zeros(), shift], expected);
    let (down, up) = (Vec3::new(1e-4, 0.0, -1e-4), Vec3::new(0.0, 0.0, 1e-4));
    kept(0.004, down, Vec3::new(1e-4, 0.0, 0.0));
    kept(-0.002, down, Vec3::new(1e-4, 0.0, 0.0));
    kept(-0.004, down, Vec3::new(1e-4, 0.0, 0.0));
    kept(0.006, down, down);
    kept(0.004, up, up);
}

#[test]
fn a_point_deep_behind_two_walls_is_stopped_by_both() {
    let steep = Vec3::new(0.6, 0.0, 0.8);
    let bed = [Vec3::z(), steep].map(plane);
    let still = Vec3::zeros();
    let stopped =
        |position: Vec3, velocity| at_the_bed(&bed, &position, [still, still, velocity]).1;
    let (down, up) = (Vec3::new(0.1, 0.2, -1.0), Vec3::new(0.1, 0.2, 1.0));
    let behind_floor = Vec3::new(0.1, 0.0, -0.0026);
    assert_eq!(stopped(behind_floor, down), Vec3::new(0.1, 0.2, 0.0));
    assert_eq!(stopped(behind_floor, up), up);
    assert_eq!(stopped(behind_floor * 0.9, down), down);
    let behind_both = stopped(Vec3::new(0.0, 0.0, -0.01), Vec3::new(-1.0, 0.2, -1.0));
    assert!(behind_both.z >= 0.0 && behind_both.dot(&steep).abs() < 1e-15);
    assert_eq!(behind_both.y, 0.2);
}

// A quarter of a cell is 2.5 mm.
#[test]
fn no_point_deep_behind_a_wall_goes_deeper() {
    let none = Vec3::zeros();
    let kept = |z, moved, expected| check_shift(z, [moved, none], expected);
    let (down, up) = (Vec3::new(1e-4, 0.0, -1e-4), Vec3::new(0.0, 0.0, 1e-4));
    kept(-0.0026, down, Vec3::new(0.0, 0.0, 1e-4));
    kept(-0.0026, up, none);
    kept(-0.0024, down, none);
}
