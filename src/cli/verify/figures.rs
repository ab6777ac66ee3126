//! Error against wall time, as pictures.

use crate::cli::charts::write_charts;
use crate::cli::failure::Failure;
use scree::pictures::{Axis, Chart, Curve, Scale};
use scree::verify::work::{Diagram, Series};
use std::path::Path;

/// Writes a picture of each diagram into a folder, which is made if it is not
/// there.
pub(super) fn write(diagrams: &[Diagram], machine: &str, folder: &Path) -> Result<(), Failure> {
    let charts = diagrams.iter();
    write_charts(charts.map(|one| (one.name, chart(one, machine))), folder)
}

fn chart(diagram: &Diagram, machine: &str) -> Chart {
    let axis = |title: String| Axis {
        title,
        scale: Scale::Logarithmic,
    };
    let curve = |series: &Series| Curve {
        name: series.name.clone(),
        points: series.places.clone(),
    };
    Chart {
        title: diagram.title.clone(),
        subtitle: diagram.against.clone(),
        x: axis(format!("wall time [s]; {machine}")),
        y: axis("relative error".to_owned()),
        curves: diagram.series.iter().map(curve).collect(),
    }
}
