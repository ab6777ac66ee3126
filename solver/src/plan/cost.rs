//! Points, steps and memory of a run.

use crate::fast::chunk::{Chunk, LANES};
use crate::fast::nodes::NodeBlock;
use crate::fast::rows::Tile as FastTile;
use crate::grid::{BLOCK, BLOCK_NODES, Node, Tile};
use crate::points::{Deformation, Point};
use crate::scenario::{Precision, Scenario};
use crate::simulation::{Outline, Timing};
use crate::stability::{self, Limits};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Blocks a flow comes to occupy while it spreads, over those of its release.
const SPREADING: f64 = 2.0;

/// What a run will cost.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Cost {
    /// Material points of the flow at the start.
    pub points: u64,
    /// Acoustic sub-steps to the end of the duration.
    pub substeps: u64,
    /// Transfers between points and grid.
    pub steps: u64,
    /// Sub-steps summed over the points computed, if none leaves.
    pub point_steps: u64,
    /// Memory for points and grid once the flow has spread [bytes].
    pub memory_bytes: u64,
}

impl Cost {
    /// The cost of a scene: equations 25–27 at the expected speed (31).
    pub(super) fn of(scenario: &Scenario, outline: &Outline) -> Self {
        let points = outline.columns.map_or(0, |columns| columns.points());
        let (substeps, steps) = steps(outline, points);
        Self {
            points,
            substeps,
            steps,
            point_steps: points * substeps,
            memory_bytes: memory(scenario, outline, points),
        }
    }
}

/// Sub-steps and steps of the whole duration.
fn steps(outline: &Outline, points: u64) -> (u64, u64) {
    let timing = &outline.given.timing;
    let flow = outline.given.flow.as_ref().filter(|_| points > 0);
    let Some(flow) = flow else {
        let substeps = over_samples(timing, stability::SUBSTEP_WITHOUT_FLOW, 1.0);
        return (substeps.0, substeps.0);
    };
    let longest = longest_substep(&flow.limits).min(flow.contact_substep(&outline.bodies));
    let allowed = flow.limits.substeps_per_step(longest, flow.limits.slow);
    over_samples(timing, longest, allowed)
}

fn longest_substep(limits: &Limits) -> f64 {
    limits.substep(limits.slow)
}

/// Sub-steps and steps from sample to sample, none longer than `longest` [s], so
/// many in a step.
fn over_samples(timing: &Timing, longest: f64, per_step: f64) -> (u64, u64) {
    let between = |interval: f64| {
        let substeps = (interval / longest - 1e-9).ceil().max(0.0);
        (substeps as u64, (substeps / per_step).ceil() as u64)
    };
    let whole = (timing.duration / timing.sample_interval + 1e-9).floor();
    let (substeps, steps) = between(timing.sample_interval);
    let rest = timing.duration - whole * timing.sample_interval;
    let (last_substeps, last_steps) = between(rest.max(0.0));
    let whole = whole as u64;
    (whole * substeps + last_substeps, whole * steps + last_steps)
}

fn memory(scenario: &Scenario, outline: &Outline, points: u64) -> u64 {
    let blocks = Blocks::of_release(scenario, outline);
    let (points, spread) = (points as f64, |blocks: f64| SPREADING * blocks);
    let (of_points, of_grid) = match scenario.numerics.precision {
        Precision::Single => {
            // Every block's last chunk is half full, on average.
            let chunks = points / LANES as f64 + 0.5 * spread(blocks.of_points);
            let tiles = 2.0 * spread(blocks.of_points) * size_of::<FastTile>() as f64;
            let nodes = 3.0 * spread(blocks.of_nodes) * size_of::<NodeBlock>() as f64;
            (chunks * size_of::<Chunk>() as f64, tiles + nodes)
        }
        Precision::Double => {
            let point = size_of::<Point>() + size_of::<Deformation>() + 3 * size_of::<f64>();
            let tiles = spread(blocks.of_points) * size_of::<Tile>() as f64;
            let nodes = spread(blocks.of_nodes) * (BLOCK_NODES * size_of::<Node>()) as f64;
            (points * point as f64, tiles + nodes)
        }
    };
    (of_points + of_grid) as u64
}

/// Blocks at the start.
struct Blocks {
    of_points: f64,
    of_nodes: f64,
}

impl Blocks {
    /// Those that the release lies in, and those its kernels reach.
    fn of_release(scenario: &Scenario, outline: &Outline) -> Self {
        let (Some(release), Some(columns)) = (scenario.release(), outline.columns) else {
            return Self {
                of_points: 0.0,
                of_nodes: 0.0,
            };
        };
        let lattice = &outline.given.lattice;
        // A block's points lie from half a cell on to half a cell beyond it.
        let block = |place: f64, axis: usize| {
            let cells = (place - lattice.origin[axis]) / lattice.spacing[axis];
            ((cells - 0.5) / BLOCK as f64).floor() as i64
        };
        let mut heights: BTreeMap<i64, (i64, i64)> = BTreeMap::new();
        for i in 0..columns.count[0] {
            let x = release.back_m + (f64::from(i) + 0.5) * columns.spacing.x;
            let bed = scenario.channel.bed_elevation_m(x);
            let (low, high) = (block(bed, 2), block(bed + release.vertical_thickness_m, 2));
            let known = heights.entry(block(x, 0)).or_insert((low, high));
            *known = (known.0.min(low), known.1.max(high));
        }
        let across = (f64::from(outline.given.walls.upright.cells_across) - 0.5) / BLOCK as f64;
        let across = across.ceil() + 1.0;
        let rows = |more: i64| {
            let of_column = |(low, high): &(i64, i64)| (high - low + 1 + more) as f64;
            heights.values().map(of_column).sum::<f64>()
        };
        let longer = (heights.len() + 1) as f64 / heights.len().max(1) as f64;
        Self {
            of_points: rows(0) * across,
            of_nodes: rows(1) * longer * (across + 1.0),
        }
    }
}
