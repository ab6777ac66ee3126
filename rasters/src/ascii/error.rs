//! Errors of ESRI ASCII grids.

use thiserror::Error;

/// An ESRI ASCII grid that can't be read. Lines count from 1.
#[derive(Debug, Error, PartialEq)]
pub enum AsciiError {
    /// Bytes that are no text.
    #[error("the ASCII grid is no text from byte {position} on")]
    NotText {
        /// Number of bytes before it.
        position: usize,
    },
    /// A key that the format doesn't have.
    #[error(
        "line {line} has the key \"{key}\"; keys are ncols, nrows, xllcorner or xllcenter, \
         yllcorner or yllcenter, cellsize or dx and dy, and nodata_value"
    )]
    UnknownKey {
        /// Line.
        line: usize,
        /// Key.
        key: String,
    },
    /// A key a second time.
    #[error("line {line} repeats the key {key} of line {first}")]
    DuplicateKey {
        /// Line.
        line: usize,
        /// Key.
        key: &'static str,
        /// Line that has it first.
        first: usize,
    },
    /// Two keys of which the file may have one.
    #[error("the ASCII grid has both {one} and {other}; one of them is needed")]
    BothKeys {
        /// A key.
        one: &'static str,
        /// Another key.
        other: &'static str,
    },
    /// No such key.
    #[error("the ASCII grid has no {key}")]
    MissingKey {
        /// Keys of which one is needed.
        key: &'static str,
    },
    /// A key without a number or with several.
    #[error("line {line} has {numbers} numbers for the key {key}, which needs 1")]
    NumbersOfKey {
        /// Line.
        line: usize,
        /// Key.
        key: &'static str,
        /// Count of its numbers.
        numbers: usize,
    },
    /// A number of columns or rows that can't be counted.
    #[error("{key} is {value}; it must be a whole number from 0 on")]
    NotWhole {
        /// Key.
        key: &'static str,
        /// Its number.
        value: f64,
    },
    /// A word among the numbers.
    #[error("line {line} has \"{text}\", which is no number")]
    NotANumber {
        /// Line.
        line: usize,
        /// Word, cut after 20 characters.
        text: String,
    },
    /// A comma in a number.
    #[error("line {line} has \"{text}\"; decimals stand after a point, not a comma")]
    Comma {
        /// Line.
        line: usize,
        /// Word, cut after 20 characters.
        text: String,
    },
    /// Fewer values than cells.
    #[error("the ASCII grid has {found} values; its columns and rows need {expected}")]
    TooFewNumbers {
        /// Number of cells.
        expected: usize,
        /// Number of values.
        found: usize,
    },
    /// More values than cells.
    #[error("line {line} has values beyond the {expected} that columns and rows need")]
    TooManyNumbers {
        /// Number of cells.
        expected: usize,
        /// Line of the first value too many.
        line: usize,
    },
}
