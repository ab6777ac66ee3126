//! A trajectory as bytes, written while it is read chunk by chunk: JSON by
//! columns ([`json`]), one JSON object per line ([`lines`]), CSV ([`csv`]) or NumPy's
//! NPZ ([`npz`]). None of them holds more than a chunk.
//!
//! A format by columns reads the trajectory once for each column: reading a
//! chunk again is cheaper than keeping it.

mod cells;
mod csv;
mod json;
mod lines;
mod npz;

pub use cells::Field;
pub use json::trajectory_json;

use super::columns::TrajectoryColumns;
use utoipa::ToSchema;

/// Format of a trajectory.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ToSchema)]
#[schema(rename_all = "lowercase")]
pub enum Format {
    /// One JSON document, column by column.
    Json,
    /// One JSON object per sample, each on its own line.
    Ndjson,
    /// One line per sample, with a column for each component of a vector.
    Csv,
    /// A ZIP archive of NumPy arrays, one per column.
    Npz,
}

/// Writes a trajectory: for each pass `begin`, `rows` for every chunk, `end`.
pub trait Writer: Send {
    /// Number of passes over the trajectory.
    fn passes(&self) -> usize;

    /// Begins a pass.
    fn begin(&mut self, pass: usize, out: &mut Vec<u8>);

    /// Writes the next samples.
    fn rows(&mut self, pass: usize, samples: &TrajectoryColumns, out: &mut Vec<u8>);

    /// Ends a pass; the last one ends the document.
    fn end(&mut self, pass: usize, out: &mut Vec<u8>);
}

/// Identification of a trajectory.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Heading {
    /// The job; none for a run without a service.
    pub job_id: Option<String>,
    /// Index of the body.
    pub body: usize,
    /// Number of samples that will be written. Only NPZ needs it beforehand.
    pub rows: usize,
}

impl Format {
    /// All formats.
    pub const ALL: [Self; 4] = [Self::Json, Self::Ndjson, Self::Csv, Self::Npz];

    /// Name in a query.
    pub fn word(self) -> &'static str {
        match self {
            Self::Json => "json",
            Self::Ndjson => "ndjson",
            Self::Csv => "csv",
            Self::Npz => "npz",
        }
    }

    /// Media type.
    pub fn media_type(self) -> &'static str {
        match self {
            Self::Json => "application/json",
            Self::Ndjson => "application/x-ndjson",
            Self::Csv => "text/csv",
            Self::Npz => "application/zip",
        }
    }

    /// Writer of this format.
    pub fn writer(self, heading: &Heading, fields: Vec<Field>) -> Box<dyn Writer> {
        match self {
            Self::Json => Box::new(json::JsonWriter::new(heading, fields)),
            Self::Ndjson => Box::new(lines::LinesWriter::new(fields)),
            Self::Csv => Box::new(csv::CsvWriter::new(fields)),
            Self::Npz => Box::new(npz::NpzWriter::new(heading.rows, fields)),
        }
    }
}

/// A whole trajectory in memory as bytes.
#[cfg(test)]
fn written(format: Format, columns: &[TrajectoryColumns], fields: Vec<Field>) -> Vec<u8> {
    let heading = Heading {
        job_id: Some("abc".to_owned()),
        body: 2,
        rows: columns.iter().map(TrajectoryColumns::len).sum(),
    };
    let mut writer = format.writer(&heading, fields);
    let mut out = Vec::new();
    for pass in 0..writer.passes() {
        writer.begin(pass, &mut out);
        for chunk in columns {
            writer.rows(pass, chunk, &mut out);
        }
        writer.end(pass, &mut out);
    }
    out
}
