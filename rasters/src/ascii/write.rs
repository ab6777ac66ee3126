//! Writing ESRI ASCII grids.

use scree_solver::raster::Raster;
use std::fmt::Write;

/// Number that stands for a hole: the one that programs assume if none is declared.
const NODATA: i32 = -9999;

/// ESRI ASCII grid of a raster: values as the shortest numbers that are the same 32-bit floats,
/// holes as -9999. The format has no place for the coordinate reference system.
pub fn write_ascii(raster: &Raster) -> String {
    let mut text = String::new();
    let header = format_args!(
        "ncols {}\nnrows {}\nxllcorner {}\nyllcorner {}\ncellsize {}\nNODATA_value {NODATA}\n",
        raster.columns, raster.rows, raster.west, raster.south, raster.cell_size
    );
    write!(text, "{header}").expect("writing to a string can't fail");
    for row in raster.values.chunks_exact(raster.columns).rev() {
        for (column, value) in row.iter().enumerate() {
            let space = if column == 0 { "" } else { " " };
            let written = if value.is_nan() {
                write!(text, "{space}{NODATA}")
            } else {
                write!(text, "{space}{}", *value as f32)
            };
            written.expect("writing to a string can't fail");
        }
        text.push('\n');
    }
    text
}
