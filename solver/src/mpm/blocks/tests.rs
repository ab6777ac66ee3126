use super::block::{cell_of, is_settled};
use super::*;
use crate::grid::BLOCK;
use crate::mpm::fixture::{Random, levels};

const LANES: usize = f32::LANES;
use crate::mpm::totals::end_of;
use fearless_simd::dispatch;
use std::collections::{BTreeMap, BTreeSet};

/// Position of a point, in cells from the origin: exact in f64.
fn absolute(key: &BlockKey, position: &[f32; 3]) -> [f64; 3] {
    [0, 1, 2].map(|axis| f64::from(key[axis]) * BLOCK as f64 + f64::from(position[axis]))
}

/// All points by identity, with their blocks.
fn by_id(blocks: &Blocks<f32>) -> BTreeMap<u32, (BlockKey, Packed<f32>)> {
    let mut found = BTreeMap::new();
    for block in blocks.occupied() {
        for slot in 0..block.count() {
            let point = block.get(slot);
            assert!(
                found.insert(point.id, (block.key, point)).is_none(),
                "doubled"
            );
        }
    }
    found
}

/// Number of runs of points in the same cell, and number of cells in use.
fn runs(block: &Block<f32>) -> (usize, usize) {
    let mut cells = Vec::new();
    for (chunk, count) in block.chunks() {
        cells.extend((0..count).map(|lane| cell_of(chunk, lane)));
    }
    let changes = 1 + cells.windows(2).filter(|pair| pair[0] != pair[1]).count();
    (
        changes,
        cells.iter().copied().collect::<BTreeSet<usize>>().len(),
    )
}

/// Asserts the invariants of blocks after a rebin.
fn assert_in_order(blocks: &Blocks<f32>) {
    let keys: Vec<BlockKey> = blocks.occupied().iter().map(|block| block.key).collect();
    assert!(keys.windows(2).all(|pair| pair[0] < pair[1]), "{keys:?}");
    for block in blocks.occupied() {
        assert!(block.count() > 0, "an empty block");
        let counts: usize = block.chunks().map(|(_, count)| count).sum();
        assert_eq!(counts, block.count());
        assert_eq!(block.chunks.len(), block.count().div_ceil(LANES));
        for (chunk, count) in block.chunks() {
            for lane in 0..count {
                let position = chunk.position.map(|of| of[lane]);
                assert!(position.iter().all(|x| is_settled(*x)), "{position:?}");
            }
            // Lanes without a point have no mass.
            for lane in count..LANES {
                assert_eq!(chunk.get(lane), Packed::none());
            }
        }
    }
}

/// Points over a few blocks round the origin, with random values.
fn random_points(random: &mut Random, count: u32) -> Vec<(BlockKey, Packed<f32>)> {
    let point = |id| {
        let key = [(); 3].map(|()| random.between(-2.0, 1.99).floor() as i32);
        let mut number = || random.single(1.0) as f32;
        let record = Packed {
            velocity: [(); 3].map(|()| number()),
            gradient: [(); 3].map(|()| [(); 3].map(|()| number())),
            deviator: [(); 6].map(|()| number()),
            volumetric_strain: number(),
            mass: 1.5 + number(),
            id,
            position: [(); 3].map(|()| (2.5 + 1.99 * number()).clamp(0.5, 4.499)),
        };
        (key, record)
    };
    (0..count).map(point).collect()
}

/// New coordinate of a point that moves along an axis [cells].
fn moved(random: &mut Random, x: f32) -> f32 {
    let rims = [0.5f32, 4.5, 1.5, 8.5];
    let rim = rims[random.between(0.0, 3.99) as usize];
    match random.between(0.0, 40.0) as u32 {
        0 => x + random.single(1000.0) as f32,
        1 => x + random.single(6.0) as f32,
        2 => rim,
        3 => rim.next_down(),
        4 => rim.next_up(),
        _ => x + random.single(0.2) as f32,
    }
}

#[test]
fn points_travel_and_none_is_lost_or_doubled() {
    let mut random = Random(1);
    let points = random_points(&mut random, 1500);
    let mut blocks = Blocks::of(points.iter().copied());
    assert_in_order(&blocks);
    assert_eq!(blocks.count(), points.len());
    for _ in 0..40 {
        let mut expected = by_id(&blocks);
        for block in blocks.occupied_mut() {
            for slot in 0..block.count() {
                let position = block.position(slot).map(|x| moved(&mut random, x));
                block.shift(slot, &position);
                let id = block.get(slot).id;
                expected.entry(id).and_modify(|of| of.1.position = position);
            }
        }
        blocks.settle();
        assert_in_order(&blocks);
        assert_eq!(blocks.count(), points.len());
        let got = by_id(&blocks);
        assert_eq!(got.len(), expected.len());
        for (id, (key, point)) in &got {
            let (old_key, old) = &expected[id];
            // Half the last place of a position below 4.5 cells, or of the position before the
            // rebin, whichever is larger.
            for ((now, was), from) in absolute(key, &point.position)
                .iter()
                .zip(absolute(old_key, &old.position))
                .zip(old.position)
            {
                let place = f64::from(from.abs().max(4.5)) * f64::from(f32::EPSILON);
                assert!((now - was).abs() <= 0.5 * place, "{now} {was}");
            }
            let carried = Packed {
                position: point.position,
                ..*old
            };
            assert_eq!(*point, carried);
        }
    }
}

#[test]
fn blocks_are_born_and_die() {
    let mut random = Random(3);
    let mut points = random_points(&mut random, 200);
    for (key, _) in &mut points {
        *key = [0; 3];
    }
    let mut blocks = Blocks::of(points.into_iter());
    assert_eq!(blocks.occupied().len(), 1);
    for round in 1..=20 {
        // All of one block's points go to the next one along a diagonal.
        for block in blocks.occupied_mut() {
            for slot in 0..block.count() {
                let [x, y, z] = block.position(slot);
                block.shift(slot, &[x + 4.0, y - 4.0, z]);
            }
        }
        blocks.settle();
        assert_in_order(&blocks);
        let keys: Vec<_> = blocks.occupied().iter().map(|block| block.key).collect();
        assert_eq!(keys, [[round, -round, 0]]);
        assert_eq!(blocks.count(), 200);
    }
}

/// A position inside one of eight cells.
fn in_the_middle(random: &mut Random) -> [f32; 3] {
    [(); 3].map(|()| 2.5 + 0.95 * (random.single(1.0) as f32))
}

/// Stores the number of runs in every block, as a pass does.
fn note_runs(blocks: &mut Blocks<f32>) {
    for block in blocks.occupied_mut() {
        let (changes, _) = runs(block);
        block.note_runs(changes as u32);
    }
}

// A block whose number of runs has grown little is left as it is, and otherwise sorted by
// cell.
#[test]
fn a_block_is_sorted_when_its_order_has_suffered() {
    let mut random = Random(4);
    let mut points = random_points(&mut random, 4000);
    for (_, point) in &mut points {
        point.position = in_the_middle(&mut random);
    }
    let mut blocks = Blocks::of(points.into_iter());
    for block in blocks.occupied_mut() {
        let (changes, occupied) = runs(block);
        assert_eq!(changes, occupied, "sorted from the start");
        for slot in 0..block.count() {
            block.shift(slot, &in_the_middle(&mut random));
        }
    }
    let order: Vec<_> = blocks.occupied().iter().map(runs).collect();
    assert!(
        order
            .iter()
            .all(|(changes, occupied)| *changes > 3 * occupied)
    );
    let before = by_id(&blocks);
    blocks.settle();
    let kept: Vec<_> = blocks.occupied().iter().map(runs).collect();
    assert_eq!(kept, order, "nobody told of the disorder");
    note_runs(&mut blocks);
    blocks.settle();
    for block in blocks.occupied() {
        let (changes, occupied) = runs(block);
        assert_eq!(changes, occupied);
    }
    assert_eq!(by_id(&blocks), before);
}

#[test]
fn settling_what_is_settled_changes_nothing() {
    let mut random = Random(6);
    let mut blocks = Blocks::of(random_points(&mut random, 700).into_iter());
    let before = blocks.clone();
    blocks.settle();
    assert_eq!(blocks.occupied(), before.occupied());
}

#[test]
fn only_what_is_gone_is_taken_out() {
    let mut random = Random(9);
    let mut blocks = Blocks::of(random_points(&mut random, 900).into_iter());
    let before = by_id(&blocks);
    let searched = |key: &BlockKey| key[0] >= 0;
    let gone = |point: &Packed<f32>| point.position[0] > 2.0 || point.id.is_multiple_of(3);
    let mut seen = BTreeSet::new();
    blocks.take_out(searched, |key, point| {
        assert!(searched(key));
        let out = gone(point);
        if out {
            assert!(seen.insert(point.id), "taken out twice");
        }
        out
    });
    let after = by_id(&blocks);
    for (id, (key, point)) in &before {
        let out = searched(key) && gone(point);
        assert_eq!(seen.contains(id), out);
        assert_eq!(after.get(id), (!out).then_some(&(*key, *point)));
    }
    assert!(blocks.occupied().iter().all(|block| block.count() > 0));
    // A block all of whose points are removed is removed, too.
    blocks.take_out(|_| true, |_, _| true);
    assert_eq!(blocks.occupied(), []);
    assert_eq!(blocks.count(), 0);
}

// One rounding moves a place just below the block to its far side.
#[test]
fn a_place_at_the_rim_lies_in_one_block() {
    let settled = |x: f32| {
        let mut position = [x, 1.0, 1.0];
        let [key, ..] = settle(&[0, 7, 7], &mut position);
        assert!(is_settled(position[0]), "{x}: {position:?}");
        (key, position[0])
    };
    assert_eq!(settled(0.5), (0, 0.5));
    assert_eq!(settled(4.5), (1, 0.5));
    assert_eq!(settled(4.5f32.next_down()), (0, 4.5f32.next_down()));
    assert_eq!(settled(0.5f32.next_down()), (0, 0.5));
    assert_eq!(settled(-3.5), (-1, 0.5));
    assert_eq!(settled((-3.5f32).next_up()).0, -1);
    assert_eq!(settled(-1e4).0, -2501);
}

#[test]
fn a_point_that_is_no_number_stays_and_is_found() {
    let mut random = Random(2);
    let mut blocks = Blocks::of(random_points(&mut random, 300).into_iter());
    let finite = |block: &Block<f32>| dispatch!(levels()[0], simd => end_of(simd, block)).finite;
    assert!(blocks.occupied().iter().all(finite));
    let lost = blocks.occupied()[3].get(2).id;
    blocks.occupied_mut()[3].shift(2, &[1.0, f32::NAN, 1.0]);
    blocks.settle();
    assert_eq!(blocks.count(), 300);
    let flawed = |block: &&Block<f32>| !finite(block);
    let flawed: Vec<&Block<f32>> = blocks.occupied().iter().filter(flawed).collect();
    assert_eq!(flawed.len(), 1);
    assert!((0..flawed[0].count()).any(|slot| flawed[0].get(slot).id == lost));
}

#[test]
fn blocks_are_saved_as_they_are() {
    let mut random = Random(5);
    let blocks = Blocks::of(random_points(&mut random, 500).into_iter());
    let bytes = postcard::to_allocvec(&blocks).expect("numbers can be written");
    let again: Blocks<f32> = postcard::from_bytes(&bytes).expect("it was just written");
    assert_eq!(by_id(&again), by_id(&blocks));
    assert_eq!(postcard::to_allocvec(&again), Ok(bytes));
}
