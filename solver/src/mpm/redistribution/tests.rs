use super::*;
use crate::mpm::fixture::levels;
use fearless_simd::dispatch;

const SPACING: Vec3 = Vec3::new(0.01, 0.01, 0.01);
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
