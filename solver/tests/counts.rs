//! A steady run must not allocate.

use scree_solver::scenario::Scenario;
use scree_solver::{Ending, Simulation, StepStage};
use serde_json::json;
use std::ops::ControlFlow;
use std::sync::LazyLock;
use std::sync::atomic::{AtomicU64, Ordering};

mod counting {
    //! A counting allocator on top of the system's.
    #![allow(unsafe_code, reason = "an allocator is unsafe by its signature")]

    use std::alloc::{GlobalAlloc, Layout, System};
    use std::sync::atomic::{AtomicU64, Ordering};

    /// Allocations so far, growing ones included.
    pub(super) static ALLOCATIONS: AtomicU64 = AtomicU64::new(0);

    struct Counting;

    #[global_allocator]
    static ALLOCATOR: Counting = Counting;

    // SAFETY: every call goes to the system's allocator unchanged; the counter beside it allocates
    // nothing.
    unsafe impl GlobalAlloc for Counting {
        unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
            ALLOCATIONS.fetch_add(1, Ordering::Relaxed);
            // SAFETY: the caller's guarantees are those required by System.
            unsafe { System.alloc(layout) }
        }

        unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
            ALLOCATIONS.fetch_add(1, Ordering::Relaxed);
            // SAFETY: the caller's guarantees are those required by System.
            unsafe { System.alloc_zeroed(layout) }
        }

        unsafe fn realloc(&self, place: *mut u8, layout: Layout, size: usize) -> *mut u8 {
            ALLOCATIONS.fetch_add(1, Ordering::Relaxed);
            // SAFETY: the caller's guarantees are those required by System.
            unsafe { System.realloc(place, layout, size) }
        }

        unsafe fn dealloc(&self, place: *mut u8, layout: Layout) {
            // SAFETY: the caller's guarantees are those required by System.
            unsafe { System.dealloc(place, layout) }
        }
    }
}

/// A heap on a flat floor that has come to rest round a cube, on cells of 20 mm.
fn heap_round_a_cube() -> Scenario {
    let text = json!({
        "channel": {"inclination_deg": 0.0, "incline_length_m": 0.3,
                    "runout_length_m": 1.0, "width_m": 0.16},
        "flow": {"volume_m3": 0.003, "release": {"height_m": 0.08, "toe_distance_m": 0.0}},
        "bodies": [{"shape": {"cube": {"side_m": 0.06}}, "position": {"downstream_m": -0.1}}],
        "numerics": {"cell_size_m": 0.02, "precision": "single"},
        "duration_s": 5.0
    });
    Scenario::from_json(&text.to_string()).expect("it is valid")
}

/// Sub-steps before counting starts, and counted ones: some sixty transfers.
const WARM_UP: u64 = 2000;
const COUNTED: u64 = 400;

type ByStage = [u64; StepStage::ALL.len()];

static SO_FAR: [AtomicU64; StepStage::ALL.len()] =
    [const { AtomicU64::new(0) }; StepStage::ALL.len()];

fn so_far() -> ByStage {
    SO_FAR.each_ref().map(|of| of.load(Ordering::Relaxed))
}

/// Allocations of a steady run, stage by stage.
fn counted(threads: usize) -> ByStage {
    let mut simulation = Simulation::new(&heap_round_a_cube(), threads).expect("it fits");
    let mut last = 0;
    simulation.time_stages(Box::new(move |stage| {
        let now = counting::ALLOCATIONS.load(Ordering::Relaxed);
        SO_FAR[stage as usize].fetch_add(now - last, Ordering::Relaxed);
        last = now;
    }));
    let (mut before, mut steps, mut touching) = (ByStage::default(), 0, 0);
    let ending = simulation.run(f64::INFINITY, |simulation, report| {
        if report.substeps == WARM_UP {
            (before, steps) = (so_far(), report.steps);
            touching = simulation.flow_load(0).touching_points;
        }
        if report.substeps < WARM_UP + COUNTED {
            return ControlFlow::Continue(());
        }
        steps = report.steps - steps;
        ControlFlow::Break(())
    });
    assert_eq!(ending, Ok(Ending::Interrupted));
    assert!(steps > 20, "{steps} transfers");
    assert!(touching > 10, "the cube stands alone");
    let after = so_far();
    std::array::from_fn(|stage| after[stage] - before[stage])
}

/// Counts on one thread and on two. One count at a time: all threads are counted.
static COUNTS: LazyLock<[ByStage; 2]> = LazyLock::new(|| [1, 2].map(counted));

// Only a flow that grows into new blocks, or bodies in contact with more points than ever
// before, may need memory.
#[test]
fn a_steady_run_allocates_nothing() {
    for counts in &*COUNTS {
        for (stage, count) in StepStage::ALL.into_iter().zip(counts) {
            assert_eq!(*count, 0, "{stage:?}");
        }
    }
}
