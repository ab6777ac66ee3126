use super::*;
use crate::grid::in_tile;
use crate::kernel::Lattice;
use crate::math::Vec3;
use crate::mpm::fixture::levels;
use fearless_simd::dispatch;
use proptest::prelude::*;

/// Cells of one metre, in which a stencil of the lattice is that of a position in a block.
const CELLS: Lattice = Lattice {
    origin: Vec3::new(0.0, 0.0, 0.0),
    spacing: Vec3::new(1.0, 1.0, 1.0),
};

/// Positions are f32 on both sides and node distances exact except for the highest node's, so a
/// weight has three roundings of numbers up to 1, and the product of two one more.
const ROUNDING: f64 = 2e-7;

/// Compares the stencils of sixteen points with the plain ones.
fn compare(points: &[[f32; 3]]) {
    let mut position = [[0.0f32; f32::LANES]; 3];
    for (lane, point) in points.iter().enumerate() {
        for axis in 0..3 {
            position[axis][lane] = point[axis];
        }
    }
    for level in levels() {
        let stencils = dispatch!(level, simd => Stencils::<f32>::of(simd, &position));
        for (lane, point) in points.iter().enumerate() {
            let plain = CELLS.stencil(&Vec3::from(point.map(f64::from)));
            let [a, b, c] = plain.base.map(|base| base as usize);
            assert_eq!(stencils.base[lane] as usize, in_tile(a, b, c), "{point:?}");
            let mut sum = 0.0;
            for (x, across) in stencils.across.iter().enumerate() {
                for (y, across) in across.iter().enumerate() {
                    let exact = plain.weight[0][x] * plain.weight[1][y];
                    assert!(
                        (f64::from(across[lane]) - exact).abs() < ROUNDING,
                        "{point:?}"
                    );
                    sum += f64::from(across[lane]);
                }
            }
            assert!((sum - 1.0).abs() < ROUNDING, "{point:?}: {sum}");
            for (along, exact) in stencils.along.iter().zip(plain.weight[2]) {
                assert!(
                    (f64::from(along[lane]) - exact).abs() < ROUNDING,
                    "{point:?}"
                );
            }
            for (offset, plain) in stencils.offset.iter().zip(plain.offset) {
                // The middle node lies so far from the point.
                assert!(
                    (f64::from(offset[lane]) + plain[1]).abs() < ROUNDING,
                    "{point:?}"
                );
            }
        }
    }
}

proptest! {
    #[test]
    fn stencils_are_those_of_the_lattice(
        points in prop::collection::vec(prop::array::uniform3(0.5f32..4.5), f32::LANES),
    ) {
        compare(&points);
    }
}

#[test]
fn stencils_hold_on_the_rims_of_cells() {
    let rims = [0.5f32, 1.5, 2.5, 3.5, 4.5];
    for rim in &rims[..4] {
        compare(&[[*rim; 3], [rim.next_up(); 3], [1.0, *rim, 2.0]]);
    }
    for rim in &rims[1..] {
        compare(&[[rim.next_down(); 3], [2.0, 1.0, rim.next_down()]]);
    }
}

// A non-finite point, or one that left its block, writes inside the tile.
#[test]
fn no_point_reaches_beyond_its_tile() {
    let last = in_tile(BLOCK - 1, BLOCK - 1, BLOCK - 1) as u32;
    for x in [
        f32::NAN,
        f32::INFINITY,
        -f32::INFINITY,
        1e30,
        -1e30,
        4.5,
        0.0,
    ] {
        for level in levels() {
            let stencils =
                dispatch!(level, simd => Stencils::<f32>::of(simd, &[[x; f32::LANES]; 3]));
            assert!(stencils.base.iter().all(|base| *base <= last), "{x}");
        }
    }
}

#[test]
fn a_run_ends_where_the_cell_does() {
    let mut position = [[1.0; f32::LANES]; 3];
    position[2][5..9].fill(3.0);
    for level in levels() {
        let stencils = dispatch!(level, simd => Stencils::<f32>::of(simd, &position));
        assert_eq!(stencils.run(0, f32::LANES), 5);
        assert_eq!(stencils.run(2, 4), 2);
        assert_eq!(stencils.run(5, f32::LANES), 4);
        assert_eq!(stencils.run(9, f32::LANES), f32::LANES - 9);
    }
}
