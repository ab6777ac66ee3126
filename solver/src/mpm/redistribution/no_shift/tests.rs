use super::*;
use crate::bed::{SplineSurface, TerrainFriction};
use crate::mpm::fixture::levels;
use crate::raster::Raster;
use fearless_simd::dispatch;
use std::sync::Arc;

const SPACING: Vec3 = Vec3::new(0.01, 0.01, 0.01);
const LATTICE: Lattice = Lattice {
    origin: Vec3::new(0.0, 0.0, 0.0),
    spacing: SPACING,
};

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
            let zone = zone.of_chunk(simd, &[0; 3], &position);
            zone.keep_off(simd, &SPACING, &moved, &mut shift, &mut velocity);
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

fn hilly() -> HeightField {
    let raster = Raster::sampled([50, 40], 0.013, |x, y| {
        0.5 * x - 0.2 * y + 0.02 * (20.0 * x).sin() * (15.0 * y).cos()
    });
    let surface = SplineSurface::through(&raster, 0.0);
    HeightField::new(Arc::new(surface), TerrainFriction::Constant(0.4))
}

/// Shifts and velocities of a chunk of points at these positions [cells], which move downwards.
fn after<S: Simd>(simd: S, zone: Option<ChunkZone<S, f64>>) -> Vec<f64> {
    let number = Splat::<S, f64>::new(simd);
    let mut shift = [number.of(0.01), number.of(-0.02), number.of(-0.1)];
    let mut velocity = [number.of(0.3), number.of(0.1), number.of(-1.0)];
    if let Some(zone) = zone {
        let moved = shift;
        zone.keep_off(simd, &SPACING, &moved, &mut shift, &mut velocity);
    }
    let all = shift.into_iter().chain(velocity);
    all.flat_map(|of| of.to_array()).collect()
}

// Only points near the ground are looked at, and none of those is missed.
#[test]
fn every_point_has_the_zone_of_the_ground_under_it() {
    let ground = hilly();
    let terrain = TerrainZone::of(&ground, &LATTICE);
    let mut kept_off = 0;
    for n in 0..4000 {
        let key = [n % 12, n / 12 % 9, n / 108 - 5];
        let zones = terrain.in_block::<f64>(&key);
        dispatch!(levels()[0], simd => {
            let place = |axis: i32| {
                let mut lanes = <f64 as Real>::ZEROS;
                for (lane, place) in lanes.iter_mut().enumerate() {
                    let n = 3 * (8 * n + lane as i32) + axis;
                    *place = -0.5 + 6.0 * f64::from(n.wrapping_mul(7919).rem_euclid(997)) / 997.0;
                }
                load::<_, f64>(simd, &lanes)
            };
            let position = [0, 1, 2].map(place);
            let found = after(simd, zones.and_then(|zones| zones.of_chunk(simd, &position)));
            let lid = ground.lid_over([key[0], key[1]], &LATTICE);
            let block = BlockZone::<f64> {
                ground: &ground,
                lattice: Lattice { origin: LATTICE.position(key.map(|k| 4 * k)), ..LATTICE },
                rise: [0.0; 3],
                origin: 0.0,
                is_at_cliff: lid.steepest > METHOD.boundary.steep,
            };
            let expected = after(simd, block.of_chunk(simd, &position));
            assert_eq!(found, expected, "{key:?}");
            kept_off += usize::from(expected != after(simd, None));
        });
    }
    assert!(kept_off > 100, "{kept_off}");
}
