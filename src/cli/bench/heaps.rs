//! Cost of bodies in contact with each other, without a flow.

use super::Effort;
use super::scenes;
use super::stopwatch::Runner;
use crate::cli::columns::table;
use crate::cli::failure::Failure;
use serde::Serialize;
use std::ops::ControlFlow;
use std::time::Instant;

/// Bodies dropped into a pit.
const COUNTS: [usize; 3] = [1, 10, 100];

/// Time at which all bodies touch each other or the floor, but none sleeps yet, and duration
/// of the measurement, quick and full [s].
const TOUCHING_S: (f64, [f64; 2]) = (0.3, [0.02, 0.05]);

/// Heaps of an increasing number of bodies, on one thread: a heap is one island.
#[derive(Debug, Serialize)]
pub(super) struct Heaps {
    /// Start and end of the measured simulated time [s].
    simulated_s: [f64; 2],
    heaps: Vec<Heap>,
}

#[derive(Debug, Default, Serialize)]
struct Heap {
    bodies: usize,
    /// Mean number of pairs of bodies in contact.
    touching: f64,
    /// Steps of the scene.
    steps: u64,
    /// Sub-steps of bodies, summed over the bodies.
    body_steps: u64,
    wall_s: f64,
    simulated_s: f64,
}

impl Heap {
    fn measured(bodies: usize, lasting_s: f64) -> Result<Self, Failure> {
        let mut runner = Runner::new(&scenes::heap(bodies)?, 1)?.skipped_to(TOUCHING_S.0)?;
        let mut heap = Self {
            bodies,
            simulated_s: lasting_s,
            ..Self::default()
        };
        let until_s = runner.simulation.time_s() + lasting_s;
        let began = Instant::now();
        let ended = runner.simulation.run(until_s, |simulation, _| {
            let reports = (0..bodies).map(|body| simulation.body_report(body));
            heap.body_steps += reports.map(|of| u64::from(of.substeps)).sum::<u64>();
            let contact_pairs = simulation.contact_pairs().iter();
            heap.touching += contact_pairs
                .filter(|contact_pair| contact_pair.touches())
                .count() as f64;
            heap.steps += 1;
            ControlFlow::Continue(())
        });
        heap.wall_s = began.elapsed().as_secs_f64();
        ended.map_err(|error| Failure::Numerical(error.to_string()))?;
        heap.touching /= heap.steps as f64;
        Ok(heap)
    }

    fn row(&self) -> [String; 6] {
        let (steps, body_steps) = (self.steps as f64, self.body_steps as f64);
        [
            self.bodies.to_string(),
            format!("{:.1}", self.touching),
            format!("{:.0}", body_steps / steps / self.bodies as f64),
            format!("{:.3}", 1e3 * self.wall_s / steps),
            format!("{:.3}", 1e6 * self.wall_s / body_steps),
            format!("{:.2}", self.wall_s / self.simulated_s),
        ]
    }
}

/// Times heaps while their bodies touch.
pub(super) fn measure(effort: &Effort) -> Result<Heaps, Failure> {
    let (from_s, [quick_s, full_s]) = TOUCHING_S;
    let lasting_s = if effort.full { full_s } else { quick_s };
    let heaps = COUNTS.map(|count| Heap::measured(count, lasting_s));
    Ok(Heaps {
        simulated_s: [from_s, from_s + lasting_s],
        heaps: heaps.into_iter().collect::<Result<_, _>>()?,
    })
}

impl Heaps {
    /// Table for people.
    pub(super) fn table(&self) -> String {
        let [from_s, to_s] = self.simulated_s;
        let title = format!(
            "heaps: bodies dropped on each other, no flow; t = {from_s:.2} to {to_s:.2} s, one thread"
        );
        let headings = [
            "bodies",
            "pairs in touch",
            "body sub-steps per step",
            "wall ms per step",
            "wall us per body sub-step",
            "wall s / simulated s",
        ];
        table(&title, headings, self.heaps.iter().map(Heap::row))
    }
}
