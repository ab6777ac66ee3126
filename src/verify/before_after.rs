//! Error against computing time of the source paper's cube, before and after decisions 20
//! to 23. The earlier version no longer exists, so both are drawn from recorded runs.

use super::work::{Diagram, Series, listed, off};
use serde::Deserialize;

/// Runs of both versions, in turns on one machine, on one thread each.
const RECORDED: &str = include_str!("before_after.json");

#[derive(Debug, Deserialize)]
struct Recorded {
    machine: String,
    /// Reference values of the errors: peak speed [m/s] and displacement [m].
    limit: [f64; 2],
    versions: Vec<Version>,
}

#[derive(Debug, Deserialize)]
struct Version {
    name: String,
    runs: Vec<Runs>,
}

/// Runs of one number of cells, which differ in the position of the slope break between the
/// nodes: 0, ¼, ½ and ¾ of a cell.
#[derive(Debug, Deserialize)]
struct Runs {
    /// Cells per side of the cube.
    cells: f64,
    /// Mean processor time per simulated second [s].
    processor_s_per_s: f64,
    peak_m_s: [f64; 4],
    displacement_m: [f64; 4],
}

/// A quantity's values, one for each phase.
type Values = fn(&Runs) -> [f64; 4];

/// Largest error of all phases, for both quantities and versions.
pub(super) fn diagram() -> Diagram {
    let recorded: Recorded = serde_json::from_str(RECORDED).expect("the record is JSON");
    let [peak, way] = recorded.limit;
    let quantities: [(&str, f64, Values); 2] = [
        ("peak", peak, |runs| runs.peak_m_s),
        ("displacement", way, |runs| runs.displacement_m),
    ];
    let series = |version: &Version| {
        quantities.map(|(quantity, limit, values)| Series {
            name: format!("{quantity}, {}", version.name),
            places: version
                .runs
                .iter()
                .map(|runs| place(runs, limit, values))
                .collect(),
        })
    };
    let cells = recorded
        .versions
        .first()
        .map_or(&[][..], |first| &first.runs);
    let cells: Vec<f64> = cells.iter().map(|runs| runs.cells).collect();
    Diagram {
        name: "work-before-after",
        title: "The source paper's cube, worst of four grid phases".to_owned(),
        against: format!(
            "off the limits {peak} m/s and {way} m; dots: {} cells a side",
            listed(&cells)
        ),
        recorded: Some(format!(
            "processor time per simulated second [s]; {}, one thread",
            recorded.machine
        )),
        series: recorded.versions.iter().flat_map(series).collect(),
    }
}

fn place(runs: &Runs, limit: f64, values: Values) -> (f64, f64) {
    let errors = values(runs).map(|value| off(value, limit));
    (
        runs.processor_s_per_s,
        errors.into_iter().fold(0.0, f64::max),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_phase_counts() {
        let runs = Runs {
            cells: 2.0,
            processor_s_per_s: 3.0,
            peak_m_s: [1.0, 1.1, 0.8, 1.0],
            displacement_m: [0.5; 4],
        };
        let (time_s, error) = place(&runs, 1.0, |runs| runs.peak_m_s);
        assert!((time_s - 3.0).abs() < 1e-12 && (error - 0.2).abs() < 1e-12);
    }

    #[test]
    fn the_record_has_both_quantities_of_both_versions() {
        let diagram = diagram();
        assert_eq!(diagram.series.len(), 4);
        for series in &diagram.series {
            assert!(series.places.len() > 3, "{series:?}");
            let is_valid = |place: &(f64, f64)| place.0 > 0.0 && place.1 > 0.0 && place.1 < 1.0;
            assert!(series.places.iter().all(is_valid), "{series:?}");
        }
    }
}
