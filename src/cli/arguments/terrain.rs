//! Arguments of the commands for terrains.

use super::ServiceOptions;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, Subcommand};
use scree::terrains::FilePurpose;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(in crate::cli) struct TerrainOptions {
    #[command(subcommand)]
    pub(in crate::cli) command: TerrainCommand,
}

#[derive(Debug, Subcommand)]
pub(in crate::cli) enum TerrainCommand {
    /// Check a file here, and print what it is
    Check(CheckOptions),
    /// Upload a file to a service, for scenarios to name
    Put(PutOptions),
}

#[derive(Debug, Args)]
pub(in crate::cli) struct CheckOptions {
    /// GeoTIFF or ESRI ASCII grid; - reads standard input
    #[arg(value_name = "FILE")]
    pub(in crate::cli) file: PathBuf,
    /// What the values are
    #[arg(long, value_name = "PURPOSE", default_value = "height-map", value_parser = purpose())]
    pub(in crate::cli) purpose: FilePurpose,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct PutOptions {
    /// GeoTIFF or ESRI ASCII grid; - reads standard input
    #[arg(value_name = "FILE")]
    pub(in crate::cli) file: PathBuf,
    /// What the values are
    #[arg(long, value_name = "PURPOSE", default_value = "height-map", value_parser = purpose())]
    pub(in crate::cli) purpose: FilePurpose,
    /// Print only the terrain's document, as JSON, on standard output
    #[arg(long)]
    pub(in crate::cli) json: bool,
    #[command(flatten)]
    pub(in crate::cli) service: ServiceOptions,
}

/// Parser of a purpose's word, the same as over HTTP.
fn purpose() -> impl TypedValueParser<Value = FilePurpose> {
    let value = |purpose: FilePurpose| PossibleValue::new(purpose.word()).help(meaning(purpose));
    let words = PossibleValuesParser::new(FilePurpose::ALL.map(value));
    words.try_map(|word| {
        let named = |purpose: &FilePurpose| purpose.word() == word;
        FilePurpose::ALL.into_iter().find(named).ok_or("no purpose")
    })
}

fn meaning(purpose: FilePurpose) -> &'static str {
    match purpose {
        FilePurpose::HeightMap => "Heights of the ground, without holes",
        FilePurpose::Surface => "Heights of a surveyed surface, which may have holes",
        FilePurpose::Thickness => "Thickness of a release",
        FilePurpose::Friction => "Coefficients of friction, without holes",
    }
}
