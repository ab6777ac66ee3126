//! Access tokens and their scopes.

use super::{ConfigError, not_allowed};
use serde::{Deserialize, Serialize};

/// Scope of an access token.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Scope {
    /// Submit jobs; dismiss and remove one's own jobs.
    Submit,
    /// Read jobs and results.
    Read,
    /// Dismiss and remove jobs of any holder.
    Admin,
}

/// An access token, of which only the hash is kept.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Token {
    /// Name of the holder; jobs are stored under this name.
    pub name: String,
    /// BLAKE3 of the token, 64 hexadecimal digits. A token is long and random
    /// (`scree token` makes one), so a fast hash is enough.
    pub blake3: String,
    /// Scopes of the token.
    pub scopes: Vec<Scope>,
    /// Largest number of its jobs that may wait or run at a time; `None`: the limit of
    /// the queue.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub active_jobs: Option<u32>,
}

impl Scope {
    /// Name of the scope in the configuration.
    pub fn word(self) -> &'static str {
        match self {
            Self::Submit => "submit",
            Self::Read => "read",
            Self::Admin => "admin",
        }
    }
}

impl Token {
    /// True if `hash` is the hash of this token; takes the same time for any hash.
    pub fn is(&self, hash: &blake3::Hash) -> bool {
        // Hashes are compared in constant time; parsing our own hash reveals nothing.
        blake3::Hash::from_hex(&self.blake3).is_ok_and(|own| own == *hash)
    }

    /// True if the token has this scope.
    pub fn may(&self, scope: Scope) -> bool {
        self.scopes.contains(&scope)
    }
}

/// Checks the name of a token, under which its jobs are stored and shown.
///
/// # Errors
/// It is empty, longer than 100 characters, or has others than letters, digits and `. _ -`.
pub fn check_name(name: &str) -> Result<(), ConfigError> {
    let legal = |byte: u8| byte.is_ascii_alphanumeric() || b"._-".contains(&byte);
    if (1..=100).contains(&name.len()) && name.bytes().all(legal) {
        return Ok(());
    }
    let reason = "allowed are 1 to 100 letters, digits or any of . _ -";
    Err(not_allowed("tokens.name", format!("{name:?}"), reason))
}

/// Checks names, hashes and scopes.
pub(super) fn check(tokens: &[Token]) -> Result<(), ConfigError> {
    for (place, token) in tokens.iter().enumerate() {
        let repeated = tokens[..place].iter().any(|other| other.name == token.name);
        check_name(&token.name)?;
        if repeated {
            return Err(not_allowed(
                "tokens.name",
                &token.name,
                "each name is allowed once",
            ));
        }
        if blake3::Hash::from_hex(&token.blake3).is_err() {
            let reason = "allowed is a BLAKE3 hash, 64 hexadecimal digits";
            return Err(not_allowed("tokens.blake3", &token.blake3, reason));
        }
        if token.scopes.is_empty() {
            let reason = "a token needs one of \"submit\", \"read\", \"admin\"";
            return Err(not_allowed("tokens.scopes", "[]", reason));
        }
    }
    Ok(())
}
