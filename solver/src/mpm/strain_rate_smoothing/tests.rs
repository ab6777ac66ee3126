use super::*;
use crate::math::{Mat3, Sym3};
use crate::mpm::chunk::Packed;
use crate::mpm::fixture::levels;
use fearless_simd::dispatch;

const OWN: [f64; 6] = [3.0, 0.0, 0.0, 0.0, 10.0, 1.0];
const MEAN: [f64; 6] = [0.0, 0.0, 0.0, 0.0, 9.0, 0.0];

/// Strain rate that smoothing adds to [`OWN`] of a point of this speed [m/s] amid nodes of
/// [`MEAN`].
fn added(smoothing: &StrainRateSmoothing, speed: f64) -> [f64; 6] {
    let affine: Mat3 = Sym3::from_components(OWN).matrix();
    let point = Packed {
        velocity: [speed, 0.0, 0.0],
        gradient: [0, 1, 2].map(|axis| affine.column(axis).into()),
        mass: 1.0,
        ..Packed::none()
    };
    let mut blocks = crate::mpm::blocks::Blocks::of(std::iter::once(([0; 3], point)));
    let mut tiles = TransferTiles::<f64>::EMPTY;
    let [xx, yy, zz, xy, xz, yz] = MEAN;
    for (tile, mean) in tiles
        .strain_rate
        .iter_mut()
        .zip([[xx, yy, zz, xy], [xz, yz, 0.0, 0.0]])
    {
        for place in 0..crate::grid::TILE_NODES {
            tile.node_mut(place).copy_from_slice(&mean);
        }
    }
    let block = &mut blocks.occupied_mut()[0];
    dispatch!(levels()[0], simd => smooth_strain_rates(simd, block, &tiles, smoothing));
    let chunk = block.chunks().next().expect("it has a point").0;
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
