use super::*;
use crate::fast::chunk::Lanes;
use crate::fast::fixture::{Shifting, levels};
use fearless_simd::dispatch;

/// The four numbers of a node.
fn four(tile: &Tile, place: usize) -> &[f32] {
    &tile.0[4 * place..4 * place + 4]
}

/// Sums over 27 nodes of numbers up to 1 with weights that add up to one, levers to at most
/// 0.75: some ten roundings per sum. Measured: 9e-8 gathered, 2.7e-7 scattered, where up to
/// sixteen points add to a node.
const ROUNDING: f64 = 1e-6;

fn random_tile(spread: &mut Shifting) -> Tile {
    let mut tile = Tile::EMPTY;
    for place in 0..TILE_NODES {
        tile.node_mut(place).fill_with(|| spread.single(1.0));
    }
    tile
}

fn random_quads(spread: &mut Shifting) -> Quads {
    let mut quads = Quads::EMPTY;
    quads.0.fill_with(|| spread.single(1.0));
    quads
}

/// Positions of sixteen points, the first few in one cell.
fn positions(spread: &mut Shifting, in_one_cell: usize) -> [Lanes; 3] {
    let mut position = [[0.0; LANES]; 3];
    for of in &mut position {
        for (lane, x) in of.iter_mut().enumerate() {
            let (low, high) = if lane < in_one_cell {
                (2.5, 3.5)
            } else {
                (0.5, 4.5)
            };
            *x = spread.between(low, high).min(4.499) as f32;
        }
    }
    position
}

/// Visits the 27 nodes of a lane: place, weight and levers along x, y, z.
fn for_nodes(stencils: &Stencils, lane: usize, mut visit: impl FnMut(usize, f64, [f64; 3])) {
    for a in 0..WIDTH {
        for b in 0..WIDTH {
            for c in 0..WIDTH {
                let w = |axis: usize, n: usize| f64::from(stencils.weight[axis][n][lane]);
                let l = |axis: usize, n: usize| f64::from(stencils.lever[axis][n][lane]);
                let (wx, wy, wz) = (w(0, a), w(1, b), w(2, c));
                let levers = [l(0, a) * wy * wz, wx * l(1, b) * wz, wx * wy * l(2, c)];
                let place = stencils.base[lane] as usize + in_tile(a, b, c);
                visit(place, wx * wy * wz, levers);
            }
        }
    }
}

fn quad(quads: &Quads, lane: usize) -> [f64; 4] {
    std::array::from_fn(|k| f64::from(quads.0[4 * lane + k]))
}

fn assert_near(got: [f64; 4], exact: [f64; 4], largest: &mut f64) {
    for (got, exact) in got.iter().zip(exact) {
        *largest = largest.max((got - exact).abs());
    }
    assert!(*largest < ROUNDING, "{got:?} against {exact:?}");
}

#[test]
fn gathering_is_a_sum_over_27_nodes() {
    let mut spread = Shifting(3);
    let mut largest = 0.0;
    for round in 0..200 {
        let position = positions(&mut spread, round % 17);
        let tile = random_tile(&mut spread);
        let count = 1 + round % LANES;
        for level in levels() {
            let stencils = dispatch!(level, simd => Stencils::of(simd, &position));
            let (mut moments, mut mean) = (Moments::EMPTY, Quads::EMPTY);
            dispatch!(level, simd => moments.gather::<_, true>(simd, &stencils, count, &tile));
            dispatch!(level, simd => gather_mean(simd, &stencils, count, &tile, &mut mean));
            for lane in 0..count {
                let mut sums = [[0.0; 4]; 4];
                for_nodes(&stencils, lane, |place, weight, levers| {
                    for (k, q) in four(&tile, place).iter().enumerate() {
                        sums[3][k] += weight * f64::from(*q);
                        for (sum, lever) in sums.iter_mut().zip(levers) {
                            sum[k] += lever * f64::from(*q);
                        }
                    }
                });
                for (first, sum) in moments.first.iter().zip(sums) {
                    assert_near(quad(first, lane), sum, &mut largest);
                }
                assert_near(quad(&moments.zeroth, lane), sums[3], &mut largest);
                assert_near(quad(&mean, lane), sums[3], &mut largest);
            }
        }
    }
}

/// Contributions of the first `count` points of `given` to a tile, in f64.
fn exactly_given(
    given: &Given,
    stencils: &Stencils,
    count: usize,
    constant: bool,
) -> Vec<[f64; 4]> {
    let mut sums = vec![[0.0; 4]; TILE_NODES];
    for lane in 0..count {
        let slopes = given.slope.each_ref().map(|slope| quad(slope, lane));
        let fixed = quad(&given.constant, lane);
        for_nodes(stencils, lane, |place, weight, levers| {
            for k in 0..4 {
                let sloped: f64 = (0..3).map(|axis| slopes[axis][k] * levers[axis]).sum();
                sums[place][k] += sloped + if constant { fixed[k] * weight } else { 0.0 };
            }
        });
    }
    sums
}

#[test]
fn scattering_adds_to_27_nodes() {
    let mut spread = Shifting(6);
    let mut largest = 0.0;
    for round in 0..200 {
        let position = positions(&mut spread, round % 17);
        let before = random_tile(&mut spread);
        let given = Given {
            constant: random_quads(&mut spread),
            slope: [(); 3].map(|()| random_quads(&mut spread)),
        };
        let count = 1 + round % LANES;
        for (level, constant) in levels().into_iter().flat_map(|l| [(l, false), (l, true)]) {
            let stencils = dispatch!(level, simd => Stencils::of(simd, &position));
            let mut tile = before;
            if constant {
                dispatch!(level, simd => given.scatter::<_, true>(simd, &stencils, count, &mut tile));
            } else {
                dispatch!(level, simd => given.scatter::<_, false>(simd, &stencils, count, &mut tile));
            }
            let sums = exactly_given(&given, &stencils, count, constant);
            for (place, sum) in sums.iter().enumerate() {
                let start = four(&before, place);
                if *sum == [0.0; 4] {
                    assert_eq!(four(&tile, place), start, "node {place} is not touched");
                }
                let got = four(&tile, place);
                let added = std::array::from_fn(|k| f64::from(got[k]) - f64::from(start[k]));
                assert_near(added, *sum, &mut largest);
            }
        }
    }
}

#[test]
fn quads_are_spread_and_gathered_without_loss() {
    let quads = random_quads(&mut Shifting(9));
    for level in levels() {
        let mut again = Quads::EMPTY;
        let parts: [Lanes; 4] = dispatch!(level, simd => {
            let parts = quads.spread(simd);
            again.gathered(parts);
            parts.map(Into::into)
        });
        assert_eq!(again.0, quads.0);
        for (k, part) in parts.iter().enumerate() {
            for (lane, value) in part.iter().enumerate() {
                assert_eq!(*value, quads.0[4 * lane + k]);
            }
        }
    }
}
