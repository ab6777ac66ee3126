//! Memory of a run.

use crate::grid::{BLOCK, BLOCK_NODES, BlockKey};
use crate::kernel::Lattice;
use crate::mpm::blocks::ARRIVING;
use crate::mpm::chunk::{Chunk, Packed};
use crate::mpm::lanes::Real;
use crate::mpm::nodes::NodeBlock;
use crate::mpm::rows::Tile;
use crate::points::Point;
use crate::scenario::{Ending, Precision};
use crate::simulation::{CANDIDATE_BYTES, Division, PreparedScene, TerrainColumns};
use crate::walls::BoundaryCounts;
use std::collections::{BTreeMap, BTreeSet};

/// Memory of a run without points: threads, bodies, and the program's code, most of which a
/// process first reads when it runs one [bytes].
const BASE: f64 = 4e6;
/// Largest number of blocks occupied as the flow spreads, over those of its release. Lists that
/// grow by less than that take as much, since they double.
const SPREADING: f64 = 2.0;
/// Nodes of a column on which the bed acts: two in the channel, and two behind the bed in reach of
/// kernels. Likewise across, of both sides: one on the wall and one next to it.
const DEEP: f64 = 4.0;

/// Bytes per computed point while the recorder finds the front: a place and two ends, each with a
/// mass.
const FRONT_BYTES: usize = 3 * size_of::<(f64, f64)>();
/// Bytes per computed point of what the recorder looks at for an early end: the reach of each with
/// its mass and, while it moves, its place, way and energy.
const REMAINING_BYTES: usize = size_of::<(f64, f64)>() + size_of::<[f64; 3]>();

/// Memory of a run of so many points, of which so many are computed [bytes].
pub(super) fn memory(prepared: &PreparedScene, points: u64, computed: u64) -> u64 {
    let scenario = &prepared.scenario;
    let cells = 0.5 * f64::from(prepared.given.walls.halves_across());
    let share = computed as f64 / points.max(1) as f64;
    let flow = Flow {
        computed: computed as f64,
        blocks: Blocks::of_release(prepared, share * cells),
        boundary: boundary(prepared, share * cells),
        candidates: candidates(prepared).min(computed as f64 * prepared.bodies.len() as f64),
    };
    let [set_up, steps] = match scenario.numerics.precision {
        Precision::Single => [flow.set_up::<f32>(), flow.steps::<f32>()],
        Precision::Double => [flow.set_up::<f64>(), flow.steps::<f64>()],
    };
    let ground = prepared.given.walls.bed.height_field();
    let surface = ground.map_or(0, |ground| ground.surface().bytes());
    let run = set_up.max(steps + computed as f64 * looked_at(prepared));
    // A height map is held as it was read, too.
    (BASE + 2.0 * surface as f64 + run) as u64
}

/// Bytes per computed point while the front is found: at the end and, with all that still moves,
/// whenever an early end is looked for.
fn looked_at(prepared: &PreparedScene) -> f64 {
    let bytes = match prepared.scenario.numerics.ending {
        Ending::Auto => FRONT_BYTES + REMAINING_BYTES,
        Ending::Full => FRONT_BYTES,
    };
    bytes as f64
}

/// Numbers that determine the memory of a flow.
struct Flow {
    /// Computed points.
    computed: f64,
    /// Blocks at the start.
    blocks: Blocks,
    /// Nodes on which walls act, at the start.
    boundary: BoundaryCounts,
    /// Points that may touch a body within a step.
    candidates: f64,
}

impl Flow {
    /// Bytes while points of the release become packed ones, some at a time: most at the start or
    /// at the end.
    fn set_up<R: Real>(&self) -> f64 {
        let arriving = self.computed.min(ARRIVING as f64);
        let of_arriving = size_of::<Point>() + size_of::<(BlockKey, Packed<R>)>();
        let released = self.computed * size_of::<Point>() as f64;
        released.max(self.packed::<R>(self.blocks.of_points)) + arriving * of_arriving as f64
    }

    /// Bytes of points and grid once the flow has spread.
    fn steps<R: Real>(&self) -> f64 {
        let of_points = SPREADING * self.blocks.of_points;
        let of_nodes = SPREADING * self.blocks.of_nodes;
        // Besides its five values, a node has a compliance for contacts.
        let node_block = 5 * size_of::<NodeBlock<R>>() + BLOCK_NODES * size_of::<f64>();
        self.packed::<R>(of_points)
            + 3.0 * of_points * size_of::<Tile<R>>() as f64
            + of_nodes * node_block as f64
            + SPREADING * self.boundary.bytes()
            + self.candidates * CANDIDATE_BYTES as f64
    }

    /// Bytes of the packed points in so many blocks, each of whose last chunks is half full on
    /// average. An allocation loses as much as it is aligned to.
    fn packed<R: Real>(&self, blocks: f64) -> f64 {
        let chunk = size_of::<Chunk<R>>() + align_of::<Chunk<R>>() + size_of::<Box<Chunk<R>>>();
        (self.computed / R::LANES as f64 + 0.5 * blocks) * chunk as f64
    }
}

/// Points that may touch bodies within a step: layers from where they touch on, as far as points
/// come within a step, on one side of every body.
fn candidates(prepared: &PreparedScene) -> f64 {
    let Some(flow) = &prepared.given.flow else {
        return 0.0;
    };
    let limits = &flow.limits;
    let duration = prepared.given.timing.duration;
    let pace = limits.pace(limits.substep(limits.slow), limits.slow, duration);
    let reach = prepared.given.contact_reach(&prepared.bodies, &pace);
    let layers = 1.0 + reach.travel / flow.sphere.spacing;
    let bodies = prepared.bodies.iter();
    let of_bodies = bodies.map(|body| flow.sphere.most_touching(body) * layers);
    of_bodies.sum()
}

/// Nodes on which walls act at the start, for so many cells across.
fn boundary(prepared: &PreparedScene, cells_across: f64) -> BoundaryCounts {
    let lattice = &prepared.given.lattice;
    let Some(release) = prepared.scenario.release() else {
        return boundary_on_terrain(prepared);
    };
    // Kernels reach one and a half cells beyond the points.
    let along = (release.front_m - release.back_m) / lattice.spacing.x + 3.0;
    let up = release.vertical_thickness_m / lattice.spacing.z + 2.0;
    let across = cells_across + 1.0;
    let free = (up - DEEP).max(0.0) * (across - DEEP).max(0.0);
    BoundaryCounts {
        nodes: along * (up * across - free),
        images: along * up * 2.0,
        columns: along * across,
        column_nodes: along * across * DEEP.min(up),
    }
}

/// Nodes on which a terrain acts at the start: a column for every cell of the release, none with
/// images.
fn boundary_on_terrain(prepared: &PreparedScene) -> BoundaryCounts {
    let columns = prepared.division.as_ref().and_then(Division::on_terrain);
    let cells = columns.map_or(0.0, |columns| {
        let share = columns.spacing() / prepared.given.lattice.spacing.x;
        columns.columns() as f64 * share * share
    });
    BoundaryCounts {
        nodes: cells * DEEP,
        images: 0.0,
        columns: cells,
        column_nodes: cells * DEEP,
    }
}

/// Numbers of blocks at the start.
struct Blocks {
    of_points: f64,
    of_nodes: f64,
}

impl Blocks {
    /// Blocks occupied by so many cells across of the release, and blocks in reach of its kernels.
    fn of_release(prepared: &PreparedScene, cells_across: f64) -> Self {
        let scenario = &prepared.scenario;
        let columns = match &prepared.division {
            Some(Division::Channel(columns)) => columns,
            Some(Division::Terrain(columns)) => return Self::on_terrain(prepared, columns),
            None => {
                return Self {
                    of_points: 0.0,
                    of_nodes: 0.0,
                };
            }
        };
        let Some(release) = scenario.release() else {
            return Self {
                of_points: 0.0,
                of_nodes: 0.0,
            };
        };
        let lattice = &prepared.given.lattice;
        let block = |place: f64, axis: usize| block_of(lattice, place, axis);
        let mut heights: BTreeMap<i64, (i64, i64)> = BTreeMap::new();
        for i in 0..columns.count[0] {
            let x = release.back_m + (f64::from(i) + 0.5) * columns.spacing.x;
            let bed = prepared.given.walls.bed.elevation(x, 0.0);
            let (low, high) = (block(bed, 2), block(bed + release.vertical_thickness_m, 2));
            let known = heights.entry(block(x, 0)).or_insert((low, high));
            *known = (known.0.min(low), known.1.max(high));
        }
        let across = ((cells_across - 0.5) / BLOCK as f64).ceil() + 1.0;
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

    /// Blocks occupied by releases on a terrain, and all beside them.
    fn on_terrain(prepared: &PreparedScene, columns: &TerrainColumns) -> Self {
        let lattice = &prepared.given.lattice;
        let bed = &prepared.given.walls.bed;
        let (mut of_points, mut of_nodes) = (BTreeSet::new(), BTreeSet::new());
        for ([x, y], thickness) in columns.places() {
            let foot = bed.elevation(x, y);
            let [i, j] = [block_of(lattice, x, 0), block_of(lattice, y, 1)];
            for k in block_of(lattice, foot, 2)..=block_of(lattice, foot + thickness, 2) {
                if of_points.insert([i, j, k]) {
                    let beside = (0..8).map(|n| [i + n % 2, j + n / 2 % 2, k + n / 4]);
                    of_nodes.extend(beside);
                }
            }
        }
        Self {
            of_points: of_points.len() as f64,
            of_nodes: of_nodes.len() as f64,
        }
    }
}

/// Index of the block of a place along an axis: a block's points lie from half a cell on to half a
/// cell beyond it.
fn block_of(lattice: &Lattice, place: f64, axis: usize) -> i64 {
    let cells = (place - lattice.origin[axis]) / lattice.spacing[axis];
    ((cells - 0.5) / BLOCK as f64).floor() as i64
}
