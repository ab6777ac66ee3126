//! `scree token`: generates an access token and its entry for the configuration.

use super::arguments::{ScopeWord, TokenOptions};
use super::console;
use super::failure::Failure;
use scree::config::{Scope, Token, check_token_name};
use serde::Serialize;
use uuid::Uuid;

/// The section of the configuration.
#[derive(Serialize)]
struct Section {
    tokens: [Token; 1],
}

/// Generates a token and prints it, once, with the section
/// to add to the configuration.
///
/// # Errors
/// The name is not allowed, or standard output is closed.
pub(super) fn token(options: &TokenOptions) -> Result<(), Failure> {
    check_token_name(&options.name).map_err(|error| Failure::Input(error.to_string()))?;
    // 244 random bits can't be guessed, so a fast hash is safe to store.
    let text = format!(
        "scree_{}{}",
        Uuid::new_v4().simple(),
        Uuid::new_v4().simple()
    );
    let token = Token {
        name: options.name.clone(),
        blake3: blake3::hash(text.as_bytes()).to_hex().to_string(),
        scopes: options.scope.iter().map(|word| scope(*word)).collect(),
        active_jobs: options.active_jobs,
    };
    let section = toml::to_string(&Section { tokens: [token] })
        .map_err(|error| Failure::other("the token can't be written as TOML", error))?;
    Ok(console::answer(&format!(
        "# The token, shown this once:\n# {text}\n# For the configuration of the service:\n{}",
        section.trim_end()
    ))?)
}

fn scope(word: ScopeWord) -> Scope {
    match word {
        ScopeWord::Submit => Scope::Submit,
        ScopeWord::Read => Scope::Read,
        ScopeWord::Admin => Scope::Admin,
    }
}
