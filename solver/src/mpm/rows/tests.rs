use super::*;
use crate::grid::{TILE_NODES, in_tile};
use crate::mpm::fixture::{Random, levels};
use crate::mpm::lanes::NODE_NUMBERS;
use crate::mpm::stencil::Stencils;
use fearless_simd::dispatch;
use fearless_simd::prelude::*;

/// The four numbers of a node.
fn four<R: Real>(tile: &Tile<R>, place: usize) -> &[R] {
    &tile.0[4 * place..4 * place + 4]
}

/// Sums over 27 nodes of numbers up to 1 with weights that add up to one, levers to at most
/// 0.75: some ten roundings per sum. Measured: 9e-8 gathered, 2.7e-7 scattered, where up to
/// sixteen points add to a node.
fn rounding<R: Real>() -> f64 {
    match R::LANES {
        16 => 1e-6,
        _ => 2e-15,
    }
}

fn random_tile<R: Real>(random: &mut Random) -> Tile<R> {
    let mut tile = Tile::EMPTY;
    for place in 0..TILE_NODES {
        tile.node_mut(place).fill_with(|| R::of(random.single(1.0)));
    }
    tile
}

fn random_quads<R: Real>(random: &mut Random) -> Quads<R> {
    let mut quads = Quads::EMPTY;
    quads.0.fill_with(|| R::of(random.single(1.0)));
    quads
}

/// Positions of sixteen points, the first few in one cell.
fn positions<R: Real>(random: &mut Random, in_one_cell: usize) -> [R::Lanes; 3] {
    let mut position = [R::ZEROS; 3];
    for of in &mut position {
        for (lane, x) in of.as_mut().iter_mut().enumerate() {
            let (low, high) = if lane < in_one_cell {
                (2.5, 3.5)
            } else {
                (0.5, 4.5)
            };
            *x = R::of(random.between(low, high).min(4.499));
        }
    }
    position
}

/// Visits the 27 nodes of a lane: place, weight and weighted distances along x, y, z.
fn for_nodes<R: Real>(
    stencils: &Stencils<R>,
    lane: usize,
    mut visit: impl FnMut(usize, f64, [f64; 3]),
) {
    for a in 0..WIDTH {
        for b in 0..WIDTH {
            for c in 0..WIDTH {
                let weight =
                    stencils.across[a][b][lane].to_f64() * stencils.along[c][lane].to_f64();
                let distances = [(0, a), (1, b), (2, c)].map(|(axis, n)| {
                    weight * (n as f64 - 1.0 - stencils.offset[axis][lane].to_f64())
                });
                let place = stencils.base[lane] as usize + in_tile(a, b, c);
                visit(place, weight, distances);
            }
        }
    }
}

fn quad<R: Real>(quads: &Quads<R>, lane: usize) -> [f64; 4] {
    std::array::from_fn(|k| quads.0[4 * lane + k].to_f64())
}

fn assert_near<R: Real>(got: [f64; 4], exact: [f64; 4], largest: &mut f64) {
    for (got, exact) in got.iter().zip(exact) {
        *largest = largest.max((got - exact).abs());
    }
    assert!(*largest < rounding::<R>(), "{got:?} against {exact:?}");
}

#[test]
fn gathering_is_a_sum_over_27_nodes() {
    gather::<f32>();
    gather::<f64>();
}

fn gather<R: Real>() {
    let mut random = Random(3);
    let mut largest = 0.0;
    for round in 0..200 {
        let position = positions::<R>(&mut random, round % (R::LANES + 1));
        let tile = random_tile::<R>(&mut random);
        let count = 1 + round % R::LANES;
        for level in levels() {
            let stencils = dispatch!(level, simd => Stencils::<R>::of(simd, &position));
            let [mut zeroth, mut mean] = [Quads::<R>::EMPTY; 2];
            let mut first = [Quads::<R>::EMPTY; 3];
            dispatch!(level, simd => {
                let (mut moment_sums, mut mean_sums) = (MomentSums::EMPTY, Quads::EMPTY);
                let moments = moment_sums.gather(simd, &stencils, count, &tile);
                zeroth.set(moments.zeroth);
                for (first, moment) in first.iter_mut().zip(moments.first) {
                    first.set(moment);
                }
                let gathered = gather_mean(simd, &stencils, count, &tile, &mut mean_sums);
                mean.set(gathered);
            });
            for lane in 0..count {
                let mut sums = [[0.0; 4]; 4];
                for_nodes(&stencils, lane, |place, weight, distances| {
                    for (k, q) in four(&tile, place).iter().enumerate() {
                        sums[3][k] += weight * q.to_f64();
                        for (sum, distance) in sums.iter_mut().zip(distances) {
                            sum[k] += distance * q.to_f64();
                        }
                    }
                });
                for (first, sum) in first.iter().zip(sums) {
                    assert_near::<R>(quad(first, lane), sum, &mut largest);
                }
                assert_near::<R>(quad(&zeroth, lane), sums[3], &mut largest);
                assert_near::<R>(quad(&mean, lane), sums[3], &mut largest);
            }
        }
    }
}

/// Value at the point and slopes of sixteen points.
struct Given<R> {
    value: Quads<R>,
    slope: [Quads<R>; 3],
}

/// Contributions of the first `count` points of `given` to a tile, in f64.
fn exactly_given<R: Real>(given: &Given<R>, stencils: &Stencils<R>, count: usize) -> Vec<[f64; 4]> {
    let mut sums = vec![[0.0; 4]; TILE_NODES];
    for lane in 0..count {
        let slopes = given.slope.each_ref().map(|slope| quad(slope, lane));
        let value = quad(&given.value, lane);
        for_nodes(stencils, lane, |place, weight, distances| {
            for k in 0..4 {
                let sloped: f64 = (0..3).map(|axis| slopes[axis][k] * distances[axis]).sum();
                sums[place][k] += sloped + value[k] * weight;
            }
        });
    }
    sums
}

#[test]
fn scattering_adds_to_27_nodes() {
    scatter::<f32>();
    scatter::<f64>();
}

fn scatter<R: Real>() {
    let mut random = Random(6);
    let mut largest = 0.0;
    for round in 0..200 {
        let position = positions::<R>(&mut random, round % (R::LANES + 1));
        let before = random_tile::<R>(&mut random);
        let given = Given {
            value: random_quads::<R>(&mut random),
            slope: [(); 3].map(|()| random_quads::<R>(&mut random)),
        };
        let mean = Given {
            value: given.value,
            slope: [Quads::EMPTY; 3],
        };
        let count = 1 + round % R::LANES;
        for level in levels() {
            let stencils = dispatch!(level, simd => Stencils::<R>::of(simd, &position));
            let [mut linear, mut constant] = [before; 2];
            dispatch!(level, simd => {
                let mut fields = LinearFields::ZERO;
                let mut slope = [given.value.transposed(simd); 3];
                for (slope, of) in slope.iter_mut().zip(&given.slope) {
                    *slope = of.transposed(simd);
                }
                fields.set(simd, &stencils, &given.value.transposed(simd), &slope);
                fields.scatter(simd, &stencils, count, &mut linear);
                scatter_mean(simd, &stencils, count, &given.value, &mut constant);
            });
            for (tile, given) in [(linear, &given), (constant, &mean)] {
                let sums = exactly_given(given, &stencils, count);
                for (place, sum) in sums.iter().enumerate() {
                    let start = four(&before, place);
                    if *sum == [0.0; 4] {
                        assert_eq!(four(&tile, place), start, "node {place} is not touched");
                    }
                    let got = four(&tile, place);
                    let added = std::array::from_fn(|k| got[k].to_f64() - start[k].to_f64());
                    assert_near::<R>(added, *sum, &mut largest);
                }
            }
        }
    }
}

#[test]
fn quads_are_transposed_without_loss() {
    transpose::<f32>();
    transpose::<f64>();
}

fn transpose<R: Real>() {
    let quads = random_quads::<R>(&mut Random(9));
    for level in levels() {
        let mut again = Quads::<R>::EMPTY;
        let mut parts = [R::ZEROS; 4];
        dispatch!(level, simd => {
            let vectors = quads.transposed(simd);
            again.set(vectors);
            for (part, vector) in parts.iter_mut().zip(vectors) {
                *part = vector.to_array();
            }
        });
        let used = NODE_NUMBERS * R::LANES;
        assert_eq!(again.0[..used], quads.0[..used]);
        for (k, part) in parts.iter().enumerate() {
            for (lane, value) in part.as_ref().iter().enumerate() {
                assert_eq!(*value, quads.0[NODE_NUMBERS * lane + k]);
            }
        }
    }
}
