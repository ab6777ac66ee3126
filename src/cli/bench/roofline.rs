//! Limits of the machine, and the share of them that the solver reaches.
//!
//! A sub-step of a point takes a known number of operations and of bytes. The rate of
//! multiply-adds of the processor and the bandwidth of the memory are measured here;
//! the lower of the two bounds is the roof.

use super::Effort;
use super::scenes::Collapse;
use super::stopwatch::{Length, Runner, StageLap, median, take_turns};
use crate::cli::columns::table;
use crate::cli::failure::Failure;
use crate::cli::machine::one_and_all;
use fearless_simd::{Level, dispatch, f32x16, prelude::*};
use scree_solver::Instructions;
use scree_solver::mpm::cost::{BYTES, OPERATIONS};
use serde::Serialize;
use std::hint::black_box;
use std::sync::Barrier;
use std::time::Instant;

/// Multiply-adds of sixteen numbers per sum and measurement.
const ROUNDS: u32 = 4_000_000;
/// Length of each of the three arrays of the stream benchmark: half a
/// gigabyte each, more than the caches hold.
const STREAMED: usize = 1 << 27;
/// Sub-steps of a lap.
const LAP: u64 = 64;

/// Limits, and the rates of the collapse within them.
#[derive(Debug, Serialize)]
pub(super) struct Rooflines {
    operations_per_point_step: f64,
    bytes_per_point_step: f64,
    rooflines: Vec<Roofline>,
}

/// Limits of a number of threads.
#[derive(Debug, Serialize)]
pub(super) struct Roofline {
    pub(super) threads: usize,
    /// Multiply-adds on registers, two operations each [1/s].
    pub(super) peak_operations_per_s: f64,
    /// Bytes read and written by a stream a = b + s c [B/s].
    pub(super) bytes_per_s: f64,
    /// Point-steps per second allowed by the operations.
    operations_allow: f64,
    /// Point-steps per second allowed by the memory.
    memory_allows: f64,
    /// Point-steps per second of the collapse.
    pub(super) collapse: f64,
    /// Collapse over the lower of the two.
    of_the_roof: f64,
}

/// Measures limits and collapse in turns.
pub(super) fn measure(effort: &Effort) -> Result<Rooflines, Failure> {
    let mut runners = Vec::new();
    for threads in one_and_all() {
        let collapse = Collapse::of(effort.points).scenario()?;
        runners.push(Runner::new(&collapse, threads)?.warmed_up()?);
    }
    let mut limits: Vec<(Vec<f64>, Vec<f64>)> = vec![Default::default(); runners.len()];
    for _ in 0..effort.repeats {
        take_turns(&mut runners, 1, |_| Length::Substeps(LAP))?;
        for (threads, (peaks, streams)) in one_and_all().into_iter().zip(&mut limits) {
            peaks.push(on(threads, peak_operations));
            let together = Barrier::new(threads);
            streams.push(on(threads, || streamed_bytes(threads, &together)));
        }
    }
    let rooflines = one_and_all().into_iter().zip(&runners).zip(limits);
    let rooflines = rooflines.map(|((threads, runner), (peaks, streams))| {
        let (peak, stream) = (median(peaks), median(streams));
        let (by_operations, by_bytes) = (peak / OPERATIONS, stream / BYTES);
        let collapse = runner.median(StageLap::rate);
        Roofline {
            threads,
            peak_operations_per_s: peak,
            bytes_per_s: stream,
            operations_allow: by_operations,
            memory_allows: by_bytes,
            collapse,
            of_the_roof: collapse / by_operations.min(by_bytes),
        }
    });
    Ok(Rooflines {
        operations_per_point_step: OPERATIONS,
        bytes_per_point_step: BYTES,
        rooflines: rooflines.collect(),
    })
}

/// Work per second of a number of threads together: `work` returns that of one of them.
fn on(threads: usize, work: impl Fn() -> f64 + Sync) -> f64 {
    std::thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(&work)).collect();
        let done = workers
            .into_iter()
            .map(|worker| worker.join().unwrap_or(f64::NAN));
        done.sum()
    })
}

/// Runs as many sums at once as the registers hold and as the latency of a multiply-add on
/// two units requires.
fn peak_operations() -> f64 {
    if Instructions::detected() == Instructions::Avx512 {
        peak_with::<12>()
    } else {
        peak_with::<6>()
    }
}

fn peak_with<const SUMS: usize>() -> f64 {
    let start = Instant::now();
    black_box(dispatch!(Level::new(), simd => {
        multiply_and_add::<_, SUMS>(simd, black_box(0.999_9))
    }));
    let operations = 2.0 * 16.0 * SUMS as f64 * f64::from(ROUNDS);
    operations / start.elapsed().as_secs_f64()
}

#[inline(always)]
fn multiply_and_add<S: Simd, const SUMS: usize>(simd: S, factor: f32) -> f32 {
    let factor = f32x16::splat(simd, factor);
    let mut sums = [factor; SUMS];
    for _ in 0..ROUNDS {
        for sum in &mut sums {
            *sum = sum.mul_add(factor, factor);
        }
    }
    let mut all = factor;
    for sum in sums {
        all += sum;
    }
    all.reduce_sum()
}

fn streamed_bytes(threads: usize, together: &Barrier) -> f64 {
    let share = STREAMED / threads;
    let (b, c) = (vec![1.0f32; share], vec![2.0f32; share]);
    let mut a = vec![0.0f32; share];
    // The first pass makes the system allocate the memory.
    dispatch!(Level::new(), _simd => stream(&mut a, &b, &c, black_box(0.25)));
    together.wait();
    let start = Instant::now();
    dispatch!(Level::new(), _simd => stream(&mut a, &b, &c, black_box(0.5)));
    let taken = start.elapsed().as_secs_f64();
    black_box(&a);
    (3 * share * size_of::<f32>()) as f64 / taken
}

#[inline(always)]
fn stream(a: &mut [f32], b: &[f32], c: &[f32], factor: f32) {
    for ((a, b), c) in a.iter_mut().zip(b).zip(c) {
        *a = b + factor * c;
    }
}

impl Rooflines {
    /// Table for people.
    pub(super) fn table(&self) -> String {
        let title = format!(
            "roofline: {:.0} operations and {:.0} bytes per point-step; what the machine allows [M point-steps/s]",
            self.operations_per_point_step, self.bytes_per_point_step
        );
        let headings = [
            "threads",
            "peak G operations/s",
            "stream GB/s",
            "operations allow",
            "memory allows",
            "s200k",
            "of the roof",
        ];
        table(&title, headings, self.rooflines.iter().map(Roofline::row))
    }

    /// Limits by number of threads.
    pub(super) fn each(&self) -> &[Roofline] {
        &self.rooflines
    }
}

impl Roofline {
    fn row(&self) -> [String; 7] {
        [
            self.threads.to_string(),
            format!("{:.0}", self.peak_operations_per_s / 1e9),
            format!("{:.1}", self.bytes_per_s / 1e9),
            format!("{:.1}", self.operations_allow / 1e6),
            format!("{:.1}", self.memory_allows / 1e6),
            format!("{:.1}", self.collapse / 1e6),
            format!("{:.0} %", 100.0 * self.of_the_roof),
        ]
    }
}
