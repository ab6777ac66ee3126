//! Benchmarks of the stages of a sub-step, on one block of 512 points or one body: `cargo bench
//! -p scree-solver`.

use criterion::{BatchSize, Bencher, Criterion, Throughput};
use fearless_simd::dispatch;
use nalgebra::UnitQuaternion;
use scree_solver::Instructions;
use scree_solver::bed::NearGround;
use scree_solver::contact::body_body::ContactPair;
use scree_solver::contact::island::{self, BodyReport, Surroundings};
use scree_solver::contact::law::ContactLaw;
use scree_solver::grid::BLOCK;
use scree_solver::kernel::Lattice;
use scree_solver::material::{Material, Yielding};
use scree_solver::math::{Mat3, Sym3, Vec3};
use scree_solver::mpm::blocks::{Block, Blocks};
use scree_solver::mpm::constitutive::Law;
use scree_solver::mpm::deformation::strain;
use scree_solver::mpm::lanes::{Real, Splat};
use scree_solver::mpm::p2g::{TransferTiles, residual_transfer, scatter_momentum};
use scree_solver::mpm::packing::Packing;
use scree_solver::mpm::rows::Tile;
use scree_solver::mpm::strain_rate_smoothing::StrainRateSmoothing;
use scree_solver::mpm::stress_update::update_stress;
use scree_solver::points::Point;
use scree_solver::rigid::{Body, BodyState, Freedom, InverseInertia, Load, TurnedCore};
use scree_solver::shape::{RegularSolid, SharpPolyhedron, SpheroPolyhedron};
use scree_solver::walls::{Plane, RigidWalls};
use std::hint::black_box;

/// Distance of nodes [m].
const CELL: f64 = 0.01;
/// Points along each side of a block, two per cell.
const SIDE: usize = 2 * BLOCK;
/// Length of a sub-step [s].
const DT: f64 = 1e-4;
const GRAVITY: f64 = 9.81;

const LATTICE: Lattice = Lattice {
    origin: Vec3::new(0.0, 0.0, 0.0),
    spacing: Vec3::new(CELL, CELL, CELL),
};

/// E = 1 MPa, ν = 0.3, μ(I).
const MATERIAL: Material = Material {
    bulk_density: 1550.0,
    bulk_modulus: 1e6 / 1.2,
    shear_modulus: 1e6 / 2.6,
    yielding: Yielding::Granular {
        static_friction: 0.6,
        limiting_friction: 0.86,
        reference_inertial_number: 0.279,
        grain_diameter: 1e-3,
        grain_density: 2600.0,
    },
};

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    block::<f32>(&mut criterion, "single");
    block::<f64>(&mut criterion, "double");
    closest_feature(&mut criterion);
    bodies_substep(&mut criterion);
    criterion.final_summary();
}

/// A full block under a little pressure, sheared.
fn points_of_a_block() -> Vec<Point> {
    let distance = CELL / 2.0;
    let volume = distance.powi(3) / 1.001;
    let shear = Mat3::new(0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    let pressure = MATERIAL.pressure(1.001 * MATERIAL.bulk_density);
    let place = |index: usize, along: usize| {
        let step = index / SIDE.pow(along as u32) % SIDE;
        0.5 * CELL + (step as f64 + 0.5) * distance
    };
    let point = |index: usize| {
        let position = Vec3::new(place(index, 2), place(index, 1), place(index, 0));
        Point {
            id: index as u32,
            mass: MATERIAL.bulk_density * distance.powi(3),
            volume,
            position,
            velocity: shear * position,
            affine: shear,
            stress: Sym3::isotropic(-pressure),
        }
    };
    (0..SIDE.pow(3)).map(point).collect()
}

/// A full block, with the motion of the nodes that it causes.
fn block_and_motion<R: Real>(law: &Law<R>) -> (Block<R>, Tile<R>) {
    let packing = Packing {
        lattice: LATTICE,
        material: MATERIAL,
    };
    let points = points_of_a_block();
    let mut blocks = Blocks::of(points.iter().map(|point| packing.pack(point)));
    let block = &mut blocks.occupied_mut()[0];
    assert_eq!(block.count(), points.len(), "one block holds them all");
    let mut motion = Tile::EMPTY;
    let level = Instructions::detected().level();
    let [mut first, mut second] = [Tile::EMPTY; 2];
    let strain_rate = [&mut first, &mut second];
    dispatch!(level, simd => scatter_momentum(simd, block, law, &mut motion, strain_rate));
    for place in 0..motion.0.len() / 4 {
        let node = motion.node_mut(place);
        if node[0] > R::ZERO {
            for k in 1..4 {
                let mass = node[0];
                node[k] /= mass;
            }
        }
    }
    (block.clone(), motion)
}

/// Times a closure that changes a copy.
fn on_a_copy<T: Clone, O>(bencher: &mut Bencher, of: &T, work: impl FnMut(&mut T) -> O) {
    bencher.iter_batched_ref(|| of.clone(), work, BatchSize::SmallInput);
}

fn block<R: Real>(criterion: &mut Criterion, precision: &str) {
    let law = Law::<R>::of(&MATERIAL, &LATTICE.spacing);
    let (block, motion) = block_and_motion(&law);
    let sets = [
        Instructions::Baseline,
        Instructions::Avx2,
        Instructions::Avx512,
    ];
    let best = Instructions::detected();
    for set in sets.into_iter().filter(|set| *set <= best) {
        let level = set.level();
        let mut group = criterion.benchmark_group(format!("block, {precision}, {set}"));
        group.throughput(Throughput::Elements(block.count() as u64));
        group.bench_function("stress", |bencher| {
            on_a_copy(bencher, &block, |block| {
                dispatch!(level, simd => stress_of_block(simd, block, &law));
            });
        });
        group.bench_function("gather, stress, scatter", |bencher| {
            let mut force = Tile::EMPTY;
            on_a_copy(bencher, &block, |block| {
                let (dt, force) = (R::of(DT), &mut force);
                dispatch!(level, simd => update_stress(simd, block, &law, dt, &motion, force));
            });
        });
        group.bench_function("transfer", |bencher| {
            let [mut momentum, mut force, mut shear] = [Tile::EMPTY; 3];
            let mut nodes = TransferTiles::EMPTY;
            nodes.motion = motion;
            let smoothing = StrainRateSmoothing::at(1.0);
            on_a_copy(bencher, &block, |block| {
                let (momentum, force, shear) = (&mut momentum, &mut force, &mut shear);
                dispatch!(level, simd => {
                    scatter_momentum(simd, block, &law, momentum, [&mut *force, shear]);
                    let tiles = [momentum, force];
                    residual_transfer(simd, block, &law, &nodes, &smoothing, tiles);
                });
            });
        });
        group.finish();
    }
}

#[inline(always)]
fn stress_of_block<S: fearless_simd::Simd, R: Real>(simd: S, block: &mut Block<R>, law: &Law<R>) {
    let number = Splat::<S, R>::new(simd);
    let mut gradient = [[number.of(0.0); 3]; 3];
    gradient[0][2] = number.of(2.0);
    for (chunk, _) in block.chunks_mut() {
        black_box(strain(simd, chunk, &gradient, law, R::of(DT)).volumetric_strain);
    }
}

fn cube() -> SpheroPolyhedron {
    SpheroPolyhedron::cube(0.04, 0.002).expect("a cube")
}

/// Bodies of about 4 cm, from the simplest core to one with many features.
fn shapes() -> Vec<(String, SpheroPolyhedron)> {
    let rounded = |sharp: SharpPolyhedron| sharp.rounded(0.002).expect("it is thick enough");
    let regular = |solid, size| rounded(SharpPolyhedron::regular(solid, size).expect("a solid"));
    // Places spread over an ellipsoid by the golden angle.
    let on_boulder = |k: i32| {
        let (z, angle) = ((f64::from(k) + 0.5) / 12.0 - 1.0, f64::from(k) * 2.399_963);
        let across = (1.0 - z * z).sqrt();
        Vec3::new(
            0.026 * across * angle.cos(),
            0.02 * across * angle.sin(),
            0.015 * z,
        )
    };
    let boulder: Vec<Vec3> = (0..24).map(on_boulder).collect();
    let boulder = rounded(SharpPolyhedron::hull_of(&boulder).expect("a boulder"));
    vec![
        ("cube".to_owned(), cube()),
        (
            "tetrahedron".to_owned(),
            regular(RegularSolid::Tetrahedron, 0.06),
        ),
        (
            "octahedron".to_owned(),
            regular(RegularSolid::Octahedron, 0.045),
        ),
        (
            "dodecahedron".to_owned(),
            regular(RegularSolid::Dodecahedron, 0.018),
        ),
        (
            "icosahedron".to_owned(),
            regular(RegularSolid::Icosahedron, 0.025),
        ),
        (
            format!("boulder of {} faces", boulder.faces().len()),
            boulder,
        ),
    ]
}

/// Closest-feature search for places all round a body, each once.
fn closest_feature(criterion: &mut Criterion) {
    let along = |k: i32| f64::from(k) * 0.003;
    let places: Vec<Vec3> = (-8..=8)
        .flat_map(|i| (-8..=8).map(move |j| (i, j)))
        .flat_map(|(i, j)| (-8..=8).map(move |k| Vec3::new(along(i), along(j), along(k))))
        .collect();
    let mut group = criterion.benchmark_group("body");
    group.throughput(Throughput::Elements(places.len() as u64));
    for (name, shape) in shapes() {
        group.bench_function(format!("closest feature of a {name}"), |bencher| {
            bencher.iter(|| {
                let distances = places
                    .iter()
                    .map(|x| shape.closest_feature(black_box(x)).distance);
                distances.sum::<f64>()
            });
        });
    }
    group.finish();
}

/// A cube of 40 mm at a place, at rest.
fn resting_cube(place: Vec3) -> Body {
    let shape = cube();
    let law = ContactLaw {
        stiffness: 1e7 * 4.0 / 3.0 * shape.sphero_radius().sqrt(),
        damping: 0.7,
        friction: 0.4,
    };
    let inertia = shape.unit_inertia() * 2000.0;
    Body {
        mass: 2000.0 * shape.volume(),
        inertia,
        inverse_inertia: InverseInertia::of(&inertia).expect("a solid has inertia"),
        wall_law: law,
        flow_law: law,
        rolling_friction: 0.0,
        freedom: Freedom::Free,
        wall_touches: Vec::new(),
        near_ground: NearGround::default(),
        turned_core: TurnedCore::default(),
        state: BodyState {
            position: place,
            orientation: UnitQuaternion::identity(),
            momentum: Vec3::zeros(),
            angular_momentum: Vec3::zeros(),
            springs: Vec::new(),
            ground_nodes: Vec::new(),
            rolling: Vec::new(),
            wall_load: Load::default(),
            wall_energy: 0.0,
            wall_overlap: 0.0,
            body_load: Load::default(),
            barrier_load: Load::default(),
            touching_bodies: 0,
            still_for: 0.0,
        },
        shape,
    }
}

/// Bodies, the histories of their contacts, and their reports.
type Crowd = (Vec<Body>, Vec<ContactPair>, Vec<BodyReport>);

/// Cubes on the floor under their weight, per body sub-step of one of them: scattered,
/// so that none is near another, and walled up, so that each touches its neighbours.
fn bodies_substep(criterion: &mut Criterion) {
    let planes = [Plane {
        name: "floor",
        normal: Vec3::z(),
        offset: 0.0,
        flow_friction: 0.4,
    }];
    let around = Surroundings {
        cancellation: None,
        walls: RigidWalls::planar(&planes),
        gravity: Vec3::new(0.0, 0.0, -GRAVITY),
        time: 0.0,
    };
    let mut group = criterion.benchmark_group("bodies");
    for (word, distance) in [("scattered", 0.08), ("walled up", 0.039_99)] {
        for [columns, rows, layers] in [[1, 1, 1], [5, 2, 1], [5, 5, 4]] {
            let place = |n: usize| {
                let (column, row, layer) = (n % columns, n / columns % rows, n / columns / rows);
                let across = Vec3::new(column as f64, row as f64, 0.0) * distance;
                across + Vec3::z() * (0.019_99 + distance * layer as f64)
            };
            let count = columns * rows * layers;
            let mut bodies: Vec<Body> = (0..count).map(|n| resting_cube(place(n))).collect();
            let contact_pairs = island::meet(&mut bodies);
            let advance = |(bodies, contact_pairs, reports): &mut Crowd| {
                island::advance(
                    bodies,
                    contact_pairs,
                    reports,
                    |_| Load::default(),
                    &around,
                    DT,
                );
            };
            let mut start: Crowd = (bodies, contact_pairs, vec![BodyReport::default(); count]);
            advance(&mut start);
            let substeps = start
                .2
                .iter()
                .map(|report| u64::from(report.substeps))
                .sum();
            group.throughput(Throughput::Elements(substeps));
            group.bench_function(format!("sub-steps of {count}, {word}"), |bencher| {
                on_a_copy(bencher, &start, advance);
            });
        }
    }
    group.finish();
}
