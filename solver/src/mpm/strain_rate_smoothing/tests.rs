use super::*;
use crate::math::{Mat3, Sym3};
use crate::mpm::chunk::Packed;
use crate::mpm::fixture::levels;
use fearless_simd::dispatch;

const OWN: [f64; 6] = [3.0, 0.0, 0.0, 0.0, 10.0, 1.0];
const MEAN: [f64; 6] = [0.0, 0.0, 0.0, 0.0, 9.0, 0.0];

/// Strain rate that smoothing adds to [`OWN`] of a point of this speed [m/s] amid points of
/// [`MEAN`].
fn added(smoothing: &StrainRateSmoothing, speed: f64) -> [f64; 6] {
    let affine: Mat3 = Sym3::from_components(OWN).matrix();
    let point = Packed {
        velocity: [speed, 0.0, 0.0],
        gradient: [0, 1, 2].map(|axis| affine.column(axis).into()),
        mass: 1.0,
        ..Packed::none()
    };
    let mut chunk = Chunk::<f64>::empty();
    chunk.set(0, &point);
    dispatch!(levels()[0], simd => {
        let number = Splat::<_, f64>::new(simd);
        let mut mean = [number.of(0.0); 8];
        for (mean, part) in mean.iter_mut().zip(MEAN) {
            *mean = number.of(part);
        }
        let [xx, yy, zz, xy, xz, yz, ..] = mean;
        let (first, second) = ([xx, yy, zz, xy], [xz, yz, xz, yz]);
        smooth_strain_rates(simd, &mut chunk, &first, &second, smoothing);
    });
    [0, 1, 2, 3, 4, 5].map(|part| chunk.smoothing[part][0])
}

// By hand: of −3 in xx a third is volume and stays, so −2, +1, +1.
#[test]
fn a_moving_point_feels_the_mean_but_keeps_its_change_of_volume() {
    let found = added(&StrainRateSmoothing::at(1.0), 0.3);
    let share = METHOD.smoothing.share;
    let expected = [-2.0, 1.0, 1.0, 0.0, -1.0, -1.0].map(|part| share * part);
    for (part, expected) in found.iter().zip(expected) {
        assert!((part - expected).abs() < 1e-14, "{found:?}");
    }
}

#[test]
fn a_point_that_hardly_moves_is_left_alone() {
    let slow = added(&StrainRateSmoothing::at(1.0), 0.02);
    assert!(
        (slow[4] + METHOD.smoothing.share * 0.01).abs() < 1e-14,
        "{slow:?}"
    );
    assert_eq!(added(&StrainRateSmoothing::at(1.0), 0.0)[4], 0.0);
    assert_eq!(added(&StrainRateSmoothing::NONE, 1.0)[4], 0.0);
}
