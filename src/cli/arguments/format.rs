//! Formats of trajectories on the command line.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use scree::results::table::Format;

/// Parser of a format's word, the same as over HTTP.
pub(super) fn parser() -> impl TypedValueParser<Value = Format> {
    let value = |format: Format| PossibleValue::new(format.word()).help(meaning(format));
    let words = PossibleValuesParser::new(Format::ALL.map(value));
    words.try_map(|word| {
        let named = |format: &Format| format.word() == word;
        Format::ALL.into_iter().find(named).ok_or("no format")
    })
}

fn meaning(format: Format) -> &'static str {
    match format {
        Format::Json => "One JSON document, column by column",
        Format::Ndjson => "One JSON object per sample, each on its own line",
        Format::Csv => "One line per sample, with a column for each component of a vector",
        Format::Npz => "NumPy arrays, one per column",
    }
}
