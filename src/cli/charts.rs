//! Charts into a folder.

use super::failure::Failure;
use super::files;
use scree::pictures::Chart;
use std::fs;
use std::path::Path;

/// Writes charts, each under its name, into a folder, which is created if it does not
/// exist. A former chart stays until the new one is whole.
pub(super) fn write_charts<'a>(
    charts: impl IntoIterator<Item = (&'a str, Chart)>,
    folder: &Path,
) -> Result<(), Failure> {
    let failed = |error: &dyn std::fmt::Display| {
        Failure::Other(format!(
            "cannot write pictures into {}: {error}",
            folder.display()
        ))
    };
    fs::create_dir_all(folder).map_err(|error| failed(&error))?;
    for (name, chart) in charts {
        let svg = chart.draw().map_err(|error| failed(&error))?;
        files::replace(&folder.join(format!("{name}.svg")), svg.as_bytes())?;
    }
    Ok(())
}
