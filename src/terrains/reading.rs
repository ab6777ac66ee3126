//! Reading of terrains' files, and their faults.

use super::description::{Description, FileFormat};
use crate::jobs::submit::Violation;
use scree_rasters::{Purpose, RasterError, SizeError, ValueError};
use scree_solver::raster::Raster;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use utoipa::ToSchema;

/// Purpose of a file's values.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "kebab-case")]
#[schema(as = TerrainPurpose)]
pub enum FilePurpose {
    /// Heights of the ground, without holes.
    #[default]
    HeightMap,
    /// Heights of a surveyed surface, which may have holes.
    Surface,
    /// Thickness of a release.
    Thickness,
    /// Coefficients of friction.
    Friction,
}

impl FilePurpose {
    /// All of them.
    pub const ALL: [Self; 4] = [
        Self::HeightMap,
        Self::Surface,
        Self::Thickness,
        Self::Friction,
    ];

    /// Name over HTTP.
    pub fn word(self) -> &'static str {
        match self {
            Self::HeightMap => "height-map",
            Self::Surface => "surface",
            Self::Thickness => "thickness",
            Self::Friction => "friction",
        }
    }

    /// The rule for a file, for people.
    fn rule(self) -> &'static str {
        match self {
            Self::HeightMap => {
                "a GeoTIFF or ESRI ASCII grid of heights of the ground, without holes"
            }
            Self::Surface => "a GeoTIFF or ESRI ASCII grid of heights",
            Self::Thickness => "a GeoTIFF or ESRI ASCII grid of thicknesses",
            Self::Friction => {
                "a GeoTIFF or ESRI ASCII grid of coefficients of friction, without holes"
            }
        }
    }
}

impl From<FilePurpose> for Purpose {
    fn from(purpose: FilePurpose) -> Self {
        match purpose {
            FilePurpose::HeightMap => Self::HeightMap,
            FilePurpose::Surface => Self::Surface,
            FilePurpose::Thickness => Self::Thickness,
            FilePurpose::Friction => Self::Friction,
        }
    }
}

impl Description {
    /// Reads a file whose raster has so many cells at most, and describes it.
    ///
    /// # Errors
    /// It has more, or is no raster for its purpose.
    pub fn of_file(cells: u64, file: &[u8], purpose: FilePurpose) -> Result<Self, RasterError> {
        let raster = scree_rasters::read_at_most(cells, file, purpose.into())?;
        Ok(Self::of(&raster, FileFormat::of(file), purpose))
    }
}

/// Raster of a file.
pub(super) fn raster(file: &[u8], purpose: FilePurpose) -> Result<Raster, RasterError> {
    scree_rasters::read(file, purpose.into())
}

/// The rule that a file breaks, with the cell and its value where one is at fault.
pub fn violation(error: &RasterError, purpose: FilePurpose) -> Violation {
    let detail = error.to_string();
    let (value, allowed, unit) = match error {
        RasterError::Value(error) => of_value(error, purpose),
        RasterError::Size(error) => of_size(error, purpose),
        _ => (Value::Null, purpose.rule().to_owned(), None),
    };
    Violation {
        pointer: String::new(),
        value,
        allowed,
        unit,
        detail,
    }
}

fn of_value(error: &ValueError, purpose: FilePurpose) -> (Value, String, Option<String>) {
    let unit = (purpose != FilePurpose::Friction).then(|| "m".to_owned());
    let rule = purpose.rule().to_owned();
    match error {
        ValueError::OutOfRange {
            value,
            least,
            greatest,
            ..
        } => (json!(value), format!("{least} <= x <= {greatest}"), unit),
        ValueError::Step {
            value,
            neighbour_value,
            most,
            ..
        } => (
            json!(neighbour_value),
            format!("{} <= x <= {}", value - most, value + most),
            unit,
        ),
        // What is no number in JSON is null.
        ValueError::Hole { value, .. } | ValueError::Infinite { value, .. } => {
            (json!(value), rule, unit)
        }
    }
}

fn of_size(error: &SizeError, purpose: FilePurpose) -> (Value, String, Option<String>) {
    let metres = Some("m".to_owned());
    match error {
        SizeError::Degrees { cell_size } | SizeError::CellSize { cell_size } => (
            json!(cell_size),
            "cells of 0.01 m to 1000 m".to_owned(),
            metres,
        ),
        SizeError::TooManyCells {
            columns,
            rows,
            most,
        } => (
            json!(columns.saturating_mul(*rows)),
            format!("x <= {most}"),
            Some("cells".to_owned()),
        ),
        SizeError::NotSquare { width, height } => {
            (json!([width, height]), "square cells".to_owned(), metres)
        }
        _ => (Value::Null, purpose.rule().to_owned(), None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scree_rasters::MOST_CELLS;

    const GRID: &str = "ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 10\n";

    #[test]
    fn a_fault_names_the_cell_its_value_and_the_range() {
        let refused = |values: &str| {
            let file = format!("{GRID}{values}");
            let error = Description::of_file(MOST_CELLS, file.as_bytes(), FilePurpose::HeightMap);
            violation(&error.unwrap_err(), FilePurpose::HeightMap)
        };
        let high = refused("1 2 3\n4 9500 6\n7 8 9\n");
        assert_eq!((high.pointer.as_str(), &high.value), ("", &json!(9500.0)));
        assert_eq!(high.allowed, "-500 <= x <= 9000");
        assert_eq!(high.unit.as_deref(), Some("m"));
        assert!(
            high.detail.contains("row 1 and column 1"),
            "{}",
            high.detail
        );
        let steep = refused("1 2 3\n4 5 2006\n7 8 9\n");
        assert!(steep.detail.contains("2006"), "{}", steep.detail);
        let other = violation(&RasterError::Empty, FilePurpose::Surface);
        assert_eq!(other.allowed, "a GeoTIFF or ESRI ASCII grid of heights");
    }

    #[test]
    fn a_purpose_has_one_name() {
        for purpose in FilePurpose::ALL {
            assert_eq!(json!(purpose), purpose.word());
        }
    }
}
