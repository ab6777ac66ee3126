//! The client file: where the service is, and the token for it.

use super::secret_file;
use crate::cli::failure::Failure;
use serde::Deserialize;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Contents of a client file.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ClientFile {
    /// Address of the service.
    pub(super) url: Option<String>,
    /// Access token.
    pub(super) token: Option<String>,
}

impl ClientFile {
    /// Reads the file that is named, or else the usual one if it exists.
    ///
    /// # Errors
    /// It can't be read, holds something else, or a token that others can read.
    pub(super) fn read(named: Option<&Path>) -> Result<Self, Failure> {
        let usual = usual_path();
        let Some(path) = named.or(usual.as_deref()) else {
            return Ok(Self::default());
        };
        let (text, metadata) = match secret_file::read(path) {
            Err(error) if error.kind() == ErrorKind::NotFound && named.is_none() => {
                return Ok(Self::default());
            }
            read => read.map_err(|error| Failure::path("read", path, &error))?,
        };
        let file: Self = toml::from_str(&text)
            .map_err(|error| Failure::Input(not_understood(path, &text, &error)))?;
        if file.token.is_some() {
            secret_file::refuse_if_others_can_read(path, &metadata)?;
        }
        Ok(file)
    }
}

/// Message about a file that is not understood. The parser's own would show the line, which may
/// be that of the token.
fn not_understood(path: &Path, text: &str, error: &toml::de::Error) -> String {
    let before = error.span().and_then(|span| text.get(..span.start));
    let line = before.map_or(1, |before| before.matches('\n').count() + 1);
    let path = path.display();
    format!("{path}, line {line}: {}", error.message())
}

/// Path of the file that is read if none is named; none without a home.
pub(super) fn usual_path() -> Option<PathBuf> {
    let given = std::env::var_os("XDG_CONFIG_HOME").map(PathBuf::from);
    // A relative path is to be ignored, by the XDG Base Directory Specification.
    let folder = given.filter(|path| path.is_absolute());
    let folder = folder.or_else(|| std::env::home_dir().map(|home| home.join(".config")))?;
    Some(folder.join("scree").join("client.toml"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_is_not_understood_is_told_without_its_token() {
        let text = "url = \"http://127.0.0.1:8080\"\ntoken = \"scree_secret\" x\n";
        let error = toml::from_str::<ClientFile>(text).err().unwrap();
        let told = not_understood(Path::new("client.toml"), text, &error);
        assert!(told.starts_with("client.toml, line 2: "), "{told}");
        assert!(!told.contains("secret"), "{told}");
    }
}
