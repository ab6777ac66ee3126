use super::*;
use crate::mpm::blocks::Blocks;
use crate::mpm::fixture::{Random, beads, cloud, lattice};

fn packing() -> Packing {
    Packing {
        lattice: lattice(),
        material: beads(),
    }
}

fn pressure(stress: &Sym3) -> f64 {
    -stress.trace() / 3.0
}

/// A position in a block is below 4.5 cells, so its last place is 2.4e-7 of a cell above 2 and
/// the rounding error half of it; the bound leaves room for one over the rim.
const POSITION: f64 = 3e-7;
/// Half the last place of f32.
const HALF_PLACE: f64 = 6e-8;

#[test]
fn a_point_comes_back_from_its_block() {
    let packing = packing();
    let mut far = cloud(2000);
    for (point, shift) in far.iter_mut().zip([-9.0, 0.0, 9.0].into_iter().cycle()) {
        point.position.x += shift;
    }
    for point in &far {
        let (key, record) = packing.pack::<f32>(point);
        assert!(record.position.iter().all(|x| (0.5..4.5).contains(x)));
        let again = packing.unpack(&key, &record);
        let off = (again.position - point.position).component_div(&packing.lattice.spacing);
        assert!(off.amax() < POSITION, "{off:?}");
        assert!((again.velocity - point.velocity).amax() < HALF_PLACE);
        assert!((again.affine - point.affine).amax() < HALF_PLACE * 20.0);
        assert!((again.mass / point.mass - 1.0).abs() < HALF_PLACE);
        // Mass and volumetric strain, which is below 0.005.
        assert!((again.volume / point.volume - 1.0).abs() < 1.01 * HALF_PLACE);
        // The volumetric strain keeps all digits, so the pressure does.
        let (got, exact) = (pressure(&again.stress), pressure(&point.stress));
        assert!(
            (got - exact).abs() <= 2.0 * HALF_PLACE * exact,
            "{got} {exact}"
        );
        let deviator = again.stress.deviator().matrix() - point.stress.deviator().matrix();
        assert!(deviator.amax() <= 2.0 * HALF_PLACE * exact);
        assert_eq!(again.id, point.id);
    }
}

// A packed value stays as it is: a saved state must not drift.
#[test]
fn packing_again_changes_no_bit() {
    let packing = packing();
    for point in cloud(500) {
        let (key, record) = packing.pack::<f32>(&point);
        let (again_key, again) = packing.pack::<f32>(&packing.unpack(&key, &record));
        assert_eq!((key, record.position), (again_key, again.position));
        assert_eq!(
            (record.velocity, record.gradient, record.mass, record.id),
            (again.velocity, again.gradient, again.mass, again.id)
        );
    }
}

#[test]
fn points_on_the_rim_of_blocks_are_settled() {
    let packing = packing();
    let mut random = Random(4);
    let mut point = cloud(1)[0];
    for _ in 0..2000 {
        for axis in 0..3 {
            // The lowest node changes at half cells; a few units of the last place to either side.
            let cell = (random.number() * 20.0).round() + 0.5;
            let nudge = (random.number() * 4.0).round() * 1e-16;
            point.position[axis] =
                packing.lattice.origin[axis] + packing.lattice.spacing[axis] * cell + nudge;
        }
        let (key, record) = packing.pack::<f32>(&point);
        assert!(record.position.iter().all(|x| (0.5..4.5).contains(x)));
        let off = (packing.position(&key, &record.position) - point.position)
            .component_div(&packing.lattice.spacing);
        assert!(off.amax() < POSITION, "{off:?}");
    }
}

#[test]
fn blocks_of_points_hold_them_all() {
    let packing = packing();
    let points = cloud(777);
    let blocks = Blocks::of(points.iter().map(|point| packing.pack::<f32>(point)));
    assert_eq!(blocks.count(), points.len());
    let mut ids: Vec<u32> = Vec::new();
    for block in blocks.occupied() {
        ids.extend((0..block.count()).map(|slot| block.get(slot).id));
    }
    ids.sort_unstable();
    assert!(ids.into_iter().eq(0..777));
}
