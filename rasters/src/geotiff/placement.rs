//! Position and size of the cells of a GeoTIFF.

use super::{GeoTiffError, Tiff, doubles};
use tiff::tags::Tag;

/// Affine map from columns and rows of the file to easting and northing.
#[derive(Debug, Clone, Copy)]
pub(super) struct Placement {
    /// North-western corner [m].
    origin: [f64; 2],
    /// Step from a cell to the next of its row [m].
    column: [f64; 2],
    /// Step from a cell to the next of its column [m].
    row: [f64; 2],
}

impl Placement {
    /// Placement of cells in rows that run due east, the first in the north.
    pub(super) fn of(tiff: &mut Tiff<'_>, is_point: bool) -> Result<Self, GeoTiffError> {
        let mut placement = Self::by_tags(tiff)?;
        let Self { column, row, .. } = placement;
        let is_turned = column[1] != 0.0 || row[0] != 0.0;
        let is_mirrored = column[0] < 0.0 || row[1] > 0.0;
        if is_turned || is_mirrored {
            return Err(GeoTiffError::Rotated { column, row });
        }
        if is_point {
            placement.origin[0] -= 0.5 * column[0];
            placement.origin[1] -= 0.5 * row[1];
        }
        Ok(placement)
    }

    fn by_tags(tiff: &mut Tiff<'_>) -> Result<Self, GeoTiffError> {
        let scale = doubles(tiff, Tag::ModelPixelScaleTag)?;
        let tie_points = doubles(tiff, Tag::ModelTiepointTag)?;
        let transformation = doubles(tiff, Tag::ModelTransformationTag)?;
        match (scale, tie_points, transformation) {
            (Some(scale), Some(tie_points), _) => by_tie_point(&scale, &tie_points),
            (_, _, Some(numbers)) => by_transformation(&numbers),
            (None, Some(tie_points), None) => Err(GeoTiffError::ControlPoints {
                points: tie_points.len() / 6,
            }),
            _ => Err(GeoTiffError::NoGeoreference),
        }
    }

    /// Width and height of a cell [m].
    pub(super) fn cell(&self) -> [f64; 2] {
        [self.column[0], -self.row[1]]
    }

    /// North-western corner [m].
    pub(super) fn north_west(&self) -> [f64; 2] {
        self.origin
    }
}

/// By the size of a cell and the place of one point of the grid.
fn by_tie_point(scale: &[f64], tie_points: &[f64]) -> Result<Placement, GeoTiffError> {
    let &[width, height, vertical] = scale else {
        return Err(GeoTiffError::TagLength {
            tag: "ModelPixelScale",
            numbers: scale.len(),
        });
    };
    let &[column, row, level, x, y, z, ..] = tie_points else {
        return Err(GeoTiffError::TagLength {
            tag: "ModelTiepoint",
            numbers: tie_points.len(),
        });
    };
    require_heights(vertical, z - level * vertical)?;
    Ok(Placement {
        origin: [x - column * width, y + row * height],
        column: [width, 0.0],
        row: [0.0, -height],
    })
}

/// By a matrix of 4 × 4 numbers, row by row.
fn by_transformation(numbers: &[f64]) -> Result<Placement, GeoTiffError> {
    let &[a, b, _, x, d, e, _, y, _, _, vertical, z, ..] = numbers else {
        return Err(GeoTiffError::TagLength {
            tag: "ModelTransformation",
            numbers: numbers.len(),
        });
    };
    require_heights(vertical, z)?;
    Ok(Placement {
        origin: [x, y],
        column: [a, d],
        row: [b, e],
    })
}

/// Refuses heights in another scale; a scale of 0 says that there is none.
fn require_heights(scale: f64, offset: f64) -> Result<(), GeoTiffError> {
    if scale == 0.0 || (scale == 1.0 && offset == 0.0) {
        Ok(())
    } else {
        Err(GeoTiffError::HeightScale { scale, offset })
    }
}
