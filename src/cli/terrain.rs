//! `scree terrain`: rasters of terrains, checked here or uploaded to a service.

use super::arguments::{CheckOptions, TerrainCommand, TerrainOptions};
use super::failure::Failure;
use super::{console, remote, scenario_file};
use scree::terrains::{Description, FilePurpose, TerrainHash, violation};
use std::io::Read;
use std::path::Path;

/// Does what is asked for with a terrain.
///
/// # Errors
/// The file can't be read, is no raster for its purpose, or is refused by the service.
pub(super) fn terrain(options: &TerrainOptions) -> Result<(), Failure> {
    match &options.command {
        TerrainCommand::Check(options) => check(options),
        TerrainCommand::Put(options) => remote::put(options),
    }
}

/// Prints what the file is.
fn check(options: &CheckOptions) -> Result<(), Failure> {
    let file = read_file(&options.file)?;
    let read = Description::of_file(scree_rasters::MOST_CELLS, &file, options.purpose);
    let description = read.map_err(|error| {
        let rules = [violation(&error, options.purpose)];
        let name = scenario_file::name(&options.file);
        Failure::Input(scenario_file::broken_rules(&rules, &name))
    })?;
    let hash = TerrainHash::of(&file).to_string();
    let facts = in_words(&hash, file.len() as u64, &description);
    Ok(console::answer(&facts)?)
}

/// Bytes of a file; `-` is standard input.
///
/// # Errors
/// It can't be read.
pub(super) fn read_file(path: &Path) -> Result<Vec<u8>, Failure> {
    let mut bytes = Vec::new();
    let read = if path == Path::new("-") {
        std::io::stdin().read_to_end(&mut bytes).map(|_| ())
    } else {
        std::fs::read(path).map(|read| bytes = read)
    };
    let name = scenario_file::name(path);
    read.map_err(|error| Failure::path("read", Path::new(&name), &error))?;
    Ok(bytes)
}

/// Description of a terrain, for people.
pub(super) fn in_words(hash: &str, bytes: u64, terrain: &Description) -> String {
    let mut facts = vec![
        ("file", format!("{}, {bytes} bytes", terrain.format.title())),
        ("raster", raster(terrain)),
        ("extent", extent(terrain)),
    ];
    facts.extend(values(terrain).map(|text| (quantity(terrain.purpose), text)));
    facts.extend(slopes(terrain).map(|text| ("slopes", text)));
    if terrain.holes > 0 {
        facts.push(("holes", format!("{} cells without a value", terrain.holes)));
    }
    let line = |(name, text): &(&str, String)| format!("\n  {name:<11}{text}");
    let lines: String = facts.iter().map(line).collect();
    format!("terrain {hash}{lines}")
}

fn raster(terrain: &Description) -> String {
    let Description {
        columns,
        rows,
        cell_size_m,
        ..
    } = terrain;
    format!("{columns} × {rows} cells of {cell_size_m} m")
}

fn extent(terrain: &Description) -> String {
    let side = |cells: usize| cells as f64 * terrain.cell_size_m;
    let (west, south) = (terrain.west_m, terrain.south_m);
    let (east, north) = (west + side(terrain.columns), south + side(terrain.rows));
    let system = match terrain.epsg {
        Some(code) => format!("EPSG:{code}"),
        None => "of an unknown coordinate system".to_owned(),
    };
    format!("easting {west} to {east} m, northing {south} to {north} m, {system}")
}

fn quantity(purpose: FilePurpose) -> &'static str {
    match purpose {
        FilePurpose::HeightMap | FilePurpose::Surface => "heights",
        FilePurpose::Thickness => "thickness",
        FilePurpose::Friction => "friction",
    }
}

fn values(terrain: &Description) -> Option<String> {
    let (lowest_m, highest_m) = (terrain.lowest_m?, terrain.highest_m?);
    Some(format!("{lowest_m:.2} to {highest_m:.2} m"))
}

fn slopes(terrain: &Description) -> Option<String> {
    let (mean_deg, steepest_deg) = (terrain.mean_slope_deg?, terrain.steepest_slope_deg?);
    Some(format!(
        "{mean_deg:.1}° in the mean, {steepest_deg:.1}° at most"
    ))
}
