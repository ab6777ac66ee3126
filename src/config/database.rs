//! Database of a service: a file, or a server that services and workers share.

use super::{ConfigError, not_allowed};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::convert::Infallible;
use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;

/// Database of a service.
#[derive(Clone, PartialEq, Eq)]
pub enum Database {
    /// SQLite file; created if it does not exist.
    File(PathBuf),
    /// URL of a PostgreSQL database, which may hold a password.
    Postgres(String),
}

/// Beginnings of the URL of a PostgreSQL database.
const SCHEMES: [&str; 2] = ["postgres://", "postgresql://"];

impl Database {
    /// True if several processes can use it at once.
    pub fn is_shared(&self) -> bool {
        matches!(self, Self::Postgres(_))
    }

    /// SQLite gives some names a meaning of their own, and the lock file would be beside
    /// something that is no file.
    pub(super) fn check(&self) -> Result<(), ConfigError> {
        let Self::File(path) = self else {
            return Ok(());
        };
        let name = path.to_string_lossy();
        let is_url = name.starts_with("file:") || name.contains("://");
        if !name.is_empty() && name != ":memory:" && !is_url {
            return Ok(());
        }
        let reason = "allowed are the path of a file and the URL of a PostgreSQL database \
                      (postgres://user@host/name); a database in memory would lose every job, \
                      and a path is not written as a URI";
        // A URL of another kind may hold a password, too.
        let shown = without_secrets(&name);
        Err(not_allowed("database", format!("{shown:?}"), reason))
    }
}

impl From<PathBuf> for Database {
    fn from(path: PathBuf) -> Self {
        Self::File(path)
    }
}

impl From<&str> for Database {
    fn from(text: &str) -> Self {
        let begins = text.to_ascii_lowercase();
        match SCHEMES.iter().any(|scheme| begins.starts_with(scheme)) {
            true => Self::Postgres(text.to_owned()),
            false => Self::File(text.into()),
        }
    }
}

impl FromStr for Database {
    type Err = Infallible;

    fn from_str(text: &str) -> Result<Self, Infallible> {
        Ok(text.into())
    }
}

impl fmt::Display for Database {
    /// Without the password, and without parameters, which may hold one.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(path) => write!(f, "{}", path.display()),
            Self::Postgres(url) => f.write_str(&without_secrets(url)),
        }
    }
}

impl fmt::Debug for Database {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl Serialize for Database {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::File(path) => path.serialize(serializer),
            Self::Postgres(url) => url.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for Database {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Ok(String::deserialize(deserializer)?.as_str().into())
    }
}

fn without_secrets(url: &str) -> String {
    let Some((scheme, rest)) = url.split_once("://") else {
        return url.to_owned();
    };
    let rest = rest.split('?').next().unwrap_or_default();
    let Some((login, place)) = rest.rsplit_once('@') else {
        return format!("{scheme}://{rest}");
    };
    let user = login.split(':').next().unwrap_or_default();
    format!("{scheme}://{user}@{place}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_password_is_shown() {
        for (text, shown) in [
            ("postgres://a:s@cret@db/scree", "postgres://a@db/scree"),
            (
                "postgresql://db:5433/scree?password=secret",
                "postgresql://db:5433/scree",
            ),
            ("some/scree.db", "some/scree.db"),
        ] {
            let database = Database::from(text);
            assert_eq!(database.to_string(), shown);
            assert_eq!(format!("{database:?}"), shown);
        }
    }

    #[test]
    fn a_url_of_another_database_is_refused() {
        let refused = Database::from("mysql://a:secret@db/scree")
            .check()
            .unwrap_err();
        let text = refused.to_string();
        assert!(
            text.contains("mysql://a@db/scree") && !text.contains("secret"),
            "{text}"
        );
        assert!(Database::from("postgres://db/scree").check().is_ok());
        assert!(Database::from("scree.db").check().is_ok());
    }
}
