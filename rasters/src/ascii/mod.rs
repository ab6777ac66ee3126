//! ESRI ASCII grid: lines of a key and its number, then the values row by row from the north.

mod error;
mod header;
mod write;

pub use error::AsciiError;
pub use write::write_ascii;

use crate::error::RasterError;
use crate::file::RasterFile;
use crate::limits;
use header::Header;
use scree_solver::raster::Raster;

/// True of a file whose first word is a key.
pub(crate) fn begins(bytes: &[u8]) -> bool {
    let bytes = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
    let mut words = bytes
        .split(u8::is_ascii_whitespace)
        .filter(|word| !word.is_empty());
    let first = words.next().and_then(|word| str::from_utf8(word).ok());
    first.and_then(header::key).is_some()
}

/// Mark that some editors put before text.
const BYTE_ORDER_MARK: &[u8] = "\u{feff}".as_bytes();

pub(crate) fn read(bytes: &[u8], most_cells: u64) -> Result<RasterFile, RasterError> {
    let bytes = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
    let text = str::from_utf8(bytes).map_err(|error| AsciiError::NotText {
        position: error.valid_up_to(),
    })?;
    let mut lines = (1..).zip(text.lines()).peekable();
    let header = Header::read(&mut lines)?;
    let [columns, rows] = limits::shape([header.columns()?, header.rows()?], most_cells)?;
    let [width, height] = header.cell()?;
    let cell_size = limits::cell_size(width, height)?;
    let [west, south] = header.place(cell_size)?;
    let [west, south] = limits::place(west, south)?;
    let from_the_north = numbers(lines, columns * rows, text.len())?;
    let values = from_the_north.chunks(columns).rev().flatten();
    Ok(RasterFile {
        raster: Raster {
            columns,
            rows,
            cell_size,
            west,
            south,
            epsg: None,
            values: values.copied().collect(),
        },
        nodata: header.nodata(),
    })
}

/// As many numbers as expected, wherever lines end.
fn numbers<'a>(
    lines: impl Iterator<Item = (usize, &'a str)>,
    expected: usize,
    bytes: usize,
) -> Result<Vec<f64>, AsciiError> {
    // A number takes two bytes at least, so a header alone can't claim memory.
    let mut numbers = Vec::with_capacity(expected.min(bytes / 2 + 1));
    for (line, text) in lines {
        for word in text.split_whitespace() {
            if numbers.len() == expected {
                return Err(AsciiError::TooManyNumbers { expected, line });
            }
            numbers.push(number(line, word)?);
        }
    }
    if numbers.len() < expected {
        let found = numbers.len();
        return Err(AsciiError::TooFewNumbers { expected, found });
    }
    Ok(numbers)
}

/// A number with a point, or NaN for a hole.
fn number(line: usize, word: &str) -> Result<f64, AsciiError> {
    // So that a message stays short whatever the file has.
    let text = || word.chars().take(20).collect();
    if word.contains(',') {
        return Err(AsciiError::Comma { line, text: text() });
    }
    let number = word.parse();
    number.map_err(|_| AsciiError::NotANumber { line, text: text() })
}
