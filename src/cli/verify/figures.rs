//! Error against wall time, and a sliding contact, as pictures.

use crate::cli::charts::write_charts;
use crate::cli::failure::Failure;
use scree::pictures::{Axis, Chart, Curve, Scale};
use scree::verify::work::{Diagram, Series};
use std::path::Path;

/// Writes a picture of each diagram into a folder, which is created if it does not
/// exist.
pub(super) fn write(diagrams: &[Diagram], machine: &str, folder: &Path) -> Result<(), Failure> {
    let charts = diagrams.iter();
    write_charts(charts.map(|one| (one.name, chart(one, machine))), folder)
}

/// Writes the picture of a contact that slides over a rim.
pub(super) fn write_slide(way: &[(f64, [f64; 3])], folder: &Path) -> Result<(), Failure> {
    let axis = |title: &str| Axis {
        title: title.to_owned(),
        scale: Scale::Linear,
    };
    let curve = |(which, name): (usize, &str)| Curve {
        name: name.to_owned(),
        points: way.iter().map(|(x, values)| (*x, values[which])).collect(),
    };
    let names = ["energy", "force upwards", "force outwards"];
    let chart = Chart {
        title: "A vertex slides from a face over its rim".to_owned(),
        subtitle: "over energy and force of one contact on the face; the rim is at 1 mm".to_owned(),
        x: axis("way [mm]"),
        y: axis("share of one contact"),
        curves: names.into_iter().enumerate().map(curve).collect(),
    };
    write_charts([("feature-contact", chart)], folder)
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
    let time = diagram.recorded.clone();
    let time = time.unwrap_or_else(|| format!("wall time [s]; {machine}"));
    Chart {
        title: diagram.title.clone(),
        subtitle: diagram.against.clone(),
        x: axis(time),
        y: axis("relative error".to_owned()),
        curves: diagram.series.iter().map(curve).collect(),
    }
}
