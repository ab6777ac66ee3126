//! Description of a raster: what clients are told of a terrain without its file.

use super::reading::FilePurpose;
use scree_solver::raster::Raster;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Format of a terrain's file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "kebab-case")]
#[schema(as = TerrainFormat)]
pub enum FileFormat {
    /// GeoTIFF with one band.
    Geotiff,
    /// ESRI ASCII grid.
    EsriAsciiGrid,
}

/// Description of a terrain's raster.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(as = TerrainDescription)]
pub struct Description {
    /// Purpose of the values when the file first came.
    pub purpose: FilePurpose,
    /// Format of the file.
    pub format: FileFormat,
    /// Number of cells towards the east.
    pub columns: usize,
    /// Number of cells towards the north.
    pub rows: usize,
    /// Side of a cell [m].
    pub cell_size_m: f64,
    /// Easting of the western edge [m], in the map's coordinates.
    pub west_m: f64,
    /// Northing of the southern edge [m].
    pub south_m: f64,
    /// EPSG code of the coordinate reference system; null if the file has none.
    #[schema(required = true)]
    pub epsg: Option<u32>,
    /// Number of cells without a value.
    pub holes: usize,
    /// Lowest value [m]; null for coefficients of friction.
    #[schema(required = true)]
    pub lowest_m: Option<f64>,
    /// Highest value [m]; null for coefficients of friction.
    #[schema(required = true)]
    pub highest_m: Option<f64>,
    /// Mean slope [°], by Horn's method; null unless the values are heights.
    #[schema(required = true)]
    pub mean_slope_deg: Option<f64>,
    /// Steepest slope [°]; null unless the values are heights.
    #[schema(required = true)]
    pub steepest_slope_deg: Option<f64>,
}

impl FileFormat {
    /// Format of a file that could be read, by its first bytes.
    pub(super) fn of(file: &[u8]) -> Self {
        match file {
            [b'I', b'I', ..] | [b'M', b'M', ..] => Self::Geotiff,
            _ => Self::EsriAsciiGrid,
        }
    }

    /// Media type of the file.
    pub fn media_type(self) -> &'static str {
        match self {
            Self::Geotiff => "image/tiff",
            Self::EsriAsciiGrid => "text/plain",
        }
    }

    /// Name for people.
    pub fn title(self) -> &'static str {
        match self {
            Self::Geotiff => "GeoTIFF",
            Self::EsriAsciiGrid => "ESRI ASCII grid",
        }
    }

    /// Ending of the file's name.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Geotiff => "tif",
            Self::EsriAsciiGrid => "asc",
        }
    }
}

impl Description {
    /// Description of a raster that was read from a file of this format.
    pub(super) fn of(raster: &Raster, format: FileFormat, purpose: FilePurpose) -> Self {
        let known = || {
            raster
                .values
                .iter()
                .copied()
                .filter(|value| !value.is_nan())
        };
        let is_length = purpose != FilePurpose::Friction;
        let is_height = matches!(purpose, FilePurpose::HeightMap | FilePurpose::Surface);
        let slopes = is_height.then(|| Slopes::of(raster)).flatten();
        Self {
            purpose,
            format,
            columns: raster.columns,
            rows: raster.rows,
            cell_size_m: raster.cell_size,
            west_m: raster.west,
            south_m: raster.south,
            epsg: raster.epsg,
            holes: raster.values.len() - known().count(),
            lowest_m: known().reduce(f64::min).filter(|_| is_length),
            highest_m: known().reduce(f64::max).filter(|_| is_length),
            mean_slope_deg: slopes.as_ref().map(|slopes| slopes.mean_deg),
            steepest_slope_deg: slopes.map(|slopes| slopes.steepest_deg),
        }
    }
}

/// Slopes of a height map.
#[derive(Debug, PartialEq)]
struct Slopes {
    mean_deg: f64,
    steepest_deg: f64,
}

impl Slopes {
    /// Slopes by Horn's method, as maps of slopes have them, of the cells with eight neighbours;
    /// `None` if there is no such cell.
    fn of(raster: &Raster) -> Option<Self> {
        let (mut sum_deg, mut steepest_deg, mut cells) = (0.0, 0.0_f64, 0_u64);
        for row in 1..raster.rows.saturating_sub(1) {
            for column in 1..raster.columns.saturating_sub(1) {
                let slope_deg = horn_deg(raster, column, row);
                if !slope_deg.is_nan() {
                    sum_deg += slope_deg;
                    steepest_deg = steepest_deg.max(slope_deg);
                    cells += 1;
                }
            }
        }
        (cells > 0).then(|| Self {
            mean_deg: sum_deg / cells as f64,
            steepest_deg,
        })
    }
}

/// Slope of an inner cell [°]; NaN beside a hole.
fn horn_deg(raster: &Raster, column: usize, row: usize) -> f64 {
    let below = &raster.values[(row - 1) * raster.columns..];
    let beside = &raster.values[row * raster.columns..];
    let above = &raster.values[(row + 1) * raster.columns..];
    let (west, east) = (column - 1, column + 1);
    let column_sum = |at: usize| below[at] + 2.0 * beside[at] + above[at];
    let row_sum = |row: &[f64]| row[west] + 2.0 * row[column] + row[east];
    let eastwards = column_sum(east) - column_sum(west);
    let northwards = row_sum(above) - row_sum(below);
    let rise = eastwards.hypot(northwards) / (8.0 * raster.cell_size);
    rise.atan().to_degrees()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn raster(values: Vec<f64>) -> Raster {
        Raster {
            columns: 4,
            rows: 3,
            cell_size: 10.0,
            west: 100.0,
            south: 200.0,
            epsg: Some(2056),
            values,
        }
    }

    /// A plane that rises by 10 m a cell to the east, and one cell of it without a height.
    #[test]
    fn a_plane_has_one_slope_and_holes_are_left_out() {
        let row = [0.0, 10.0, 20.0, 30.0];
        let plane = raster([row, row, row].concat());
        let described =
            |raster: &Raster, purpose| Description::of(raster, FileFormat::Geotiff, purpose);
        let whole = described(&plane, FilePurpose::HeightMap);
        assert!((whole.mean_slope_deg.unwrap() - 45.0).abs() < 1e-12);
        assert!((whole.steepest_slope_deg.unwrap() - 45.0).abs() < 1e-12);
        assert_eq!((whole.lowest_m, whole.highest_m), (Some(0.0), Some(30.0)));
        assert_eq!(whole.holes, 0);
        let mut holey = plane;
        holey.values[3] = f64::NAN;
        let holey = described(&holey, FilePurpose::Surface);
        assert_eq!(holey.holes, 1);
        assert!((holey.mean_slope_deg.unwrap() - 45.0).abs() < 1e-12);
    }

    #[test]
    fn lengths_and_slopes_are_told_where_they_have_a_meaning() {
        let flat = raster(vec![0.5; 12]);
        let described = |purpose| Description::of(&flat, FileFormat::EsriAsciiGrid, purpose);
        let thickness = described(FilePurpose::Thickness);
        assert_eq!(
            (thickness.highest_m, thickness.mean_slope_deg),
            (Some(0.5), None)
        );
        assert_eq!(described(FilePurpose::Friction).lowest_m, None);
        assert_eq!(described(FilePurpose::HeightMap).mean_slope_deg, Some(0.0));
    }
}
