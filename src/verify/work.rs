//! Error against wall time, by choice of resolution, points or stiffness.

use super::cases::ALL;
use super::columns::{Column, Grains};
use super::findings::Findings;
use super::limit::extrapolated;
use super::run::{Answer, CaseError};
use super::{Effort, before_after, paper, verify};
use serde_json::{Value, json};

/// The runs of one picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagram {
    /// Name of the file.
    pub name: &'static str,
    /// Quantity shown.
    pub title: String,
    /// Reference values of the errors.
    pub against: String,
    /// Label of the time of recorded runs; none: wall time, measured now.
    pub recorded: Option<String>,
    /// One series for every choice.
    pub series: Vec<Series>,
}

/// Runs that differ only in their cells.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Name of the choice they share.
    pub name: String,
    /// Time [s] and size of the relative error, coarse ones first.
    pub places: Vec<(f64, f64)>,
}

/// Makes the runs, which takes minutes; runs that fail are left out.
pub fn diagrams(effort: Effort) -> Vec<Diagram> {
    let mut all = vec![known(effort), collapse(effort)];
    all.extend(cube(effort));
    all.push(before_after::diagram());
    all
}

/// Cases of exact answer.
fn known(effort: Effort) -> Diagram {
    let found = |name: &str| {
        let case = ALL.iter().find(|case| case.name == name);
        case.map_or_else(Findings::default, |case| verify(case, effort).found)
    };
    let series = |findings: &Findings, quantity: &str, name: &str| Series {
        name: name.to_owned(),
        places: findings
            .of(quantity)
            .filter_map(|one| Some((one.cost.wall_s, one.measured_error?.abs())))
            .collect(),
    };
    let (bar, column) = (found("elastic-bar"), found("hydrostatic"));
    Diagram {
        name: "work-known",
        title: "Elastic bar and column at rest".to_owned(),
        against: "frequency and stress off the exact ones; dots: cells twice as fine".to_owned(),
        recorded: None,
        series: vec![
            series(&bar, "angular frequency", "bar, double"),
            series(&column, "σ_zz off, L2, double", "column, double"),
            series(&column, "σ_zz off, L2, single", "column, single"),
        ],
    }
}

/// The plane collapse of sand at a = 1, against the finest run.
fn collapse(effort: Effort) -> Diagram {
    let cells = effort.take(&[4, 8, 16, 32], 3);
    let finest = 2 * cells[cells.len() - 1];
    let runout = |cells: u32, per_cell: u32| {
        let column = Column {
            per_cell,
            ..Column::plane(Grains::SAND, 1.0, cells)
        };
        let Answer { values, cost } = column.answer().ok()?;
        Some((cost.wall_s, values[0]))
    };
    let reference = runout(finest, 8).map_or(f64::NAN, |place| place.1);
    let series = |per_cell: u32| Series {
        name: points_per_cell(per_cell),
        places: cells
            .iter()
            .filter_map(|&cells| runout(cells, per_cell))
            .map(|(wall_s, runout)| (wall_s, off(runout, reference)))
            .collect(),
    };
    Diagram {
        name: "work-collapse",
        title: "Run-out of a plane column of sand, a = 1".to_owned(),
        against: format!(
            "off {finest} cells over L0, 8 points per cell: {reference:.3}; dots: {} cells",
            listed(cells)
        ),
        recorded: None,
        series: [1, 8, 27].map(series).to_vec(),
    }
}

/// The source paper's cube: peak speed and displacement, against their limits.
fn cube(effort: Effort) -> [Diagram; 2] {
    let cells = effort.take(&[1.0, 1.5, 2.0, 3.0, 4.0], 3);
    let runs: Vec<(String, Vec<Motion>)> = CHOICES
        .iter()
        .map(|choice| {
            (
                choice.in_words(),
                cells.iter().map(|&cells| choice.motion(cells)).collect(),
            )
        })
        .collect();
    let diagram = |name, place: usize| {
        let value = |motion: &Motion| {
            Some((
                motion.as_ref().ok()?.cost.wall_s,
                motion.as_ref().ok()?.values[place],
            ))
        };
        let plain = cells.iter().zip(&runs[0].1);
        let plain: Vec<(f64, f64)> = plain
            .filter_map(|(cells, motion)| Some((1.0 / cells, value(motion)?.1)))
            .collect();
        let finest = plain.last().map_or(f64::NAN, |place| place.1);
        let (reference, what) = match extrapolated(&plain) {
            Some(found) => (found.limit, "limit of vanishing cells"),
            None => (finest, "finest run, having no limit"),
        };
        let series = |(name, motions): &(String, Vec<Motion>)| Series {
            name: name.clone(),
            places: motions
                .iter()
                .filter_map(value)
                .map(|(wall_s, value)| (wall_s, off(value, reference)))
                .filter(|place| place.1 > 0.0)
                .collect(),
        };
        let (quantity, unit) = paper::QUANTITIES[place];
        Diagram {
            name,
            title: format!("The source paper's cube: {quantity}"),
            against: format!(
                "off the {what}: {reference:.3} {unit}; dots: {} cells a side",
                listed(cells)
            ),
            recorded: None,
            series: runs.iter().map(series).collect(),
        }
    };
    [diagram("work-peak", 1), diagram("work-displacement", 2)]
}

type Motion = Result<Answer<4>, CaseError>;

/// Settings of the computation of the cube's scene.
#[derive(Debug, Clone, Copy)]
struct Choice {
    /// Sound speed over the solver's choice, which is ten times the flow's speed.
    stiffer: f64,
    per_cell: u32,
}

/// Choices; the first is the solver's own.
const CHOICES: [Choice; 5] = [
    Choice {
        stiffer: 1.0,
        per_cell: 8,
    },
    Choice {
        stiffer: 0.5,
        per_cell: 8,
    },
    Choice {
        stiffer: 2.0,
        per_cell: 8,
    },
    Choice {
        stiffer: 1.0,
        per_cell: 1,
    },
    Choice {
        stiffer: 1.0,
        per_cell: 27,
    },
];

impl Choice {
    fn in_words(self) -> String {
        match (self.stiffer, self.per_cell) {
            (1.0, 8) => "default".to_owned(),
            (1.0, points) => points_per_cell(points),
            (stiffer, _) => format!("sound ×{}", 10.0 * stiffer),
        }
    }

    fn motion(self, cells: f64) -> Motion {
        let mut scene: Value = paper::scene(cells);
        let sound_speed = self.stiffer * paper::limits_of(&scene)?.sound_speed;
        scene["numerics"]["sound_speed_m_s"] = json!(sound_speed);
        scene["numerics"]["points_per_cell"] = json!(self.per_cell);
        paper::motion(&scene)
    }
}

fn points_per_cell(points: u32) -> String {
    match points {
        1 => "1 point a cell".to_owned(),
        more => format!("{more} points a cell"),
    }
}

/// Size of the error, as a share.
pub(super) fn off(value: f64, reference: f64) -> f64 {
    ((value - reference) / reference).abs()
}

/// The numbers, separated by commas.
pub(super) fn listed(numbers: &[impl ToString]) -> String {
    let words: Vec<String> = numbers.iter().map(ToString::to_string).collect();
    words.join(", ")
}
