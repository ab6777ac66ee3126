//! Figures of the measurements.

use super::Report;
use super::plan::{Saving, Savings};
use super::size::Size;
use crate::cli::charts::write_charts;
use crate::cli::failure::Failure;
use scree::pictures::{Axis, Chart, Curve, Scale};
use scree_solver::mpm::cost::{BYTES, OPERATIONS};
use std::path::Path;

/// Ends of the roofline picture's lower axis [operations/byte].
const INTENSITIES: (f64, f64) = (0.5, 64.0);

/// Writes a picture of each measurement that has one into a folder, which is
/// created if it does not exist.
pub(super) fn write(report: &Report, folder: &Path) -> Result<(), Failure> {
    let machine = report.machine.in_words();
    let size = report
        .size
        .as_ref()
        .map(|sizes| of_size(sizes.each(), &machine));
    let roofline = report
        .roofline
        .as_ref()
        .map(|rooflines| of_roofline(rooflines.each(), &machine));
    let plan = report
        .plan
        .as_ref()
        .map(|savings| of_plan(savings, &machine));
    let charts = [
        ("speed-size", size),
        ("roofline", roofline),
        ("work-plan", plan),
    ];
    let drawn = charts.into_iter();
    write_charts(
        drawn.filter_map(|(name, chart)| Some((name, chart?))),
        folder,
    )
}

fn of_size(sizes: &[Size], machine: &str) -> Chart {
    let mut threads: Vec<usize> = sizes.iter().map(|size| size.threads).collect();
    threads.sort_unstable();
    threads.dedup();
    let curve = |threads: usize| Curve {
        name: in_threads(threads),
        points: sizes
            .iter()
            .filter(|size| size.threads == threads)
            .map(|size| (size.points as f64, size.point_steps_per_s / 1e6))
            .collect(),
    };
    Chart {
        title: "Speed against the number of points".to_owned(),
        subtitle: format!("Collapse of a block, single precision; {machine}"),
        x: axis("material points", Scale::Logarithmic),
        y: axis("million point-steps per second", Scale::Linear),
        curves: threads.into_iter().map(curve).collect(),
    }
}

fn of_roofline(rooflines: &[super::roofline::Roofline], machine: &str) -> Chart {
    let mut curves = Vec::new();
    for roof in rooflines {
        let ridge = roof.peak_operations_per_s / roof.bytes_per_s;
        let bound = |x: f64| {
            (
                x,
                (x * roof.bytes_per_s).min(roof.peak_operations_per_s) / 1e9,
            )
        };
        let (low, high) = INTENSITIES;
        curves.push(Curve {
            name: format!("limit, {}", in_threads(roof.threads)),
            points: [low, ridge, high].map(bound).to_vec(),
        });
        curves.push(Curve {
            name: format!("collapse, {}", in_threads(roof.threads)),
            points: vec![(OPERATIONS / BYTES, roof.collapse * OPERATIONS / 1e9)],
        });
    }
    Chart {
        title: "How close to the machine's limits".to_owned(),
        subtitle: machine.to_owned(),
        x: axis("operations per byte from memory", Scale::Logarithmic),
        y: axis("billion operations per second", Scale::Logarithmic),
        curves,
    }
}

/// Chart of the error of the cube's displacement against the finest full run, over wall time.
fn of_plan(savings: &Savings, machine: &str) -> Chart {
    let ways = ["full", "mirror", "all of them"];
    let of = |way: &'static str| savings.runs.iter().filter(move |run| run.way == way);
    let displaced = |run: &Saving| run.outcome.bodies[0].displacement_m;
    let finest = of("full").next_back().map_or(f64::NAN, displaced);
    let off = |run: &Saving| (displaced(run) / finest - 1.0).abs();
    let curve = |way: &'static str| Curve {
        name: way.to_owned(),
        // Errors are relative to the finest run.
        points: of(way)
            .map(|run| (run.wall_s, off(run)))
            .filter(|place| place.1 > 1e-4)
            .collect(),
    };
    Chart {
        title: "Displacement of the source paper's cube: full model and plan".to_owned(),
        subtitle: format!("off the finest full run, {finest:.4} m; {machine}"),
        x: axis("wall time [s]", Scale::Logarithmic),
        y: axis("relative error", Scale::Logarithmic),
        curves: ways.map(curve).to_vec(),
    }
}

fn axis(title: &str, scale: Scale) -> Axis {
    Axis {
        title: title.to_owned(),
        scale,
    }
}

fn in_threads(threads: usize) -> String {
    match threads {
        1 => "1 thread".to_owned(),
        more => format!("{more} threads"),
    }
}
