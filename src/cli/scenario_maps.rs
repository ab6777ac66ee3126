//! Maps of a scenario as files: on the command line a scenario names them by their paths, beside the
//! hashes of what a service has.

use super::failure::Failure;
use super::scenario_file::{broken_rules, name};
use super::terrain::read_file;
use scree::terrains::{TerrainHash, purpose, violation};
use scree_solver::raster::Raster;
use scree_solver::scenario::{Maps, NamedMap, Scenario, ScenarioError, Violation};
use serde_json::{Value, json};
use std::path::Path;
use std::sync::Arc;

/// The text of a scenario from a file, whose maps have absolute paths: it means the same in any
/// folder. A text without maps is left as it is.
pub(super) fn with_absolute_paths(text: String, file: &Path) -> String {
    if !Scenario::maps_named(&text).is_ok_and(|named| !named.is_empty()) {
        return text;
    }
    // A text with maps is JSON.
    let document = serde_json::from_str(&text).map(|document| absolute(document, file));
    document.map_or(text, |document: Value| document.to_string())
}

/// The scenario of a file, whose maps have absolute paths.
pub(super) fn absolute(mut scenario: Value, file: &Path) -> Value {
    let folder = file.parent().filter(|folder| *folder != Path::new(""));
    if let Ok(folder) = std::path::absolute(folder.unwrap_or(Path::new("."))) {
        for map in files(&scenario) {
            let path = folder.join(&map.name).display().to_string();
            rename(&mut scenario, &map, path);
        }
    }
    scenario
}

/// Maps that a scenario names by paths.
pub(super) fn files(scenario: &Value) -> Vec<NamedMap> {
    files_in(&scenario.to_string())
}

/// Maps that the text of a scenario names by paths.
pub(super) fn files_in(text: &str) -> Vec<NamedMap> {
    let mut named = Scenario::maps_named(text).unwrap_or_default();
    named.retain(|map| !is_hash(&map.name));
    named
}

/// The text of a scenario that names these maps by their paths, not by their hashes. Its fields stay
/// in their order, which a document would not keep.
pub(super) fn with_paths(text: String, maps: &[NamedMap]) -> String {
    let document: Value = serde_json::from_str(&text).unwrap_or_default();
    let renamed = maps.iter().filter_map(|map| {
        let hash = document.pointer(&map.pointer)?;
        Some((hash.to_string(), json!(map.name).to_string()))
    });
    renamed.fold(text, |text, (hash, path)| text.replace(&hash, &path))
}

/// Gives a map of a scenario another name.
pub(super) fn rename(scenario: &mut Value, map: &NamedMap, name: String) {
    if let Some(field) = scenario.pointer_mut(&map.pointer) {
        *field = name.into();
    }
}

fn is_hash(name: &str) -> bool {
    name.parse::<TerrainHash>().is_ok()
}

/// Reads a scenario whose maps are files.
///
/// # Errors
/// A file can't be read or is no map of its use; or as for a scenario without maps.
pub(super) fn read(text: &str) -> Result<Result<Scenario, ScenarioError>, Failure> {
    match Scenario::maps_named(text) {
        Ok(named) if named.is_empty() => return Ok(Scenario::from_json(text)),
        Ok(_) => {}
        Err(error) => return Ok(Err(error)),
    }
    // A text with maps is JSON.
    let document = serde_json::from_str(text).unwrap_or(Value::Null);
    let (document, maps) = load(document)?;
    Ok(Scenario::from_json_with(&document.to_string(), &maps))
}

/// A scenario whose maps are named by hashes, and its maps from their files.
///
/// # Errors
/// A file can't be read or is no map of its use, or a map is not named by a path.
pub(super) fn load(mut scenario: Value) -> Result<(Value, Maps), Failure> {
    let named = Scenario::maps_named(&scenario.to_string()).unwrap_or_default();
    let mut maps = Maps::default();
    for map in &named {
        let (hash, raster) = read_map(map)?;
        maps.insert(&hash, Arc::new(raster));
        rename(&mut scenario, map, hash);
    }
    Ok((scenario, maps))
}

fn read_map(map: &NamedMap) -> Result<(String, Raster), Failure> {
    let path = Path::new(&map.name);
    if is_hash(&map.name) && !path.exists() {
        let rule = Violation {
            pointer: map.pointer.clone(),
            value: json!(map.name),
            allowed: "the path of a file".to_owned(),
            unit: None,
            detail: "it is the hash of a terrain of a service, which is not here".to_owned(),
        };
        return Err(Failure::Input(broken_rules(&[rule], "the scenario")));
    }
    let file = read_file(path)?;
    let purpose = purpose(map.of);
    let raster = scree_rasters::read(&file, purpose.into()).map_err(|error| {
        let rule = Violation {
            pointer: map.pointer.clone(),
            ..violation(&error, purpose)
        };
        Failure::Input(broken_rules(&[rule], &name(path)))
    })?;
    Ok((TerrainHash::of(&file).to_string(), raster))
}
