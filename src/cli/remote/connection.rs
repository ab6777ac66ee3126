//! Choice of the service and of the token for it: flags, environment, client file.

use super::address::Address;
use super::client_file::{self, ClientFile};
use super::secret_file;
use crate::cli::arguments::ServiceOptions;
use crate::cli::console;
use crate::cli::failure::Failure;
use std::path::Path;

/// Address of the service, and the token for it.
pub(super) struct Connection {
    pub(super) address: Address,
    pub(super) token: Option<String>,
}

impl Connection {
    /// Chooses by flags, then environment, then client file.
    ///
    /// # Errors
    /// No address is given, or what is given can't be used.
    pub(super) fn choose(options: &ServiceOptions) -> Result<Self, Failure> {
        let file = ClientFile::read(options.client_file.as_deref())?;
        let of_file = file.url.as_deref().map(read).transpose()?;
        let asked = options.url.clone().or_else(|| environment("SCREE_URL"));
        let asked = asked.as_deref().map(read).transpose()?;
        // A token is meant for the service beside which it stands, and shown to no other.
        let is_meant = match (&asked, &of_file) {
            (Some(asked), Some(of_file)) => asked == of_file,
            _ => true,
        };
        let address = asked.or(of_file).ok_or_else(no_address)?;
        let token = match token(options)? {
            Some(token) => Some(token),
            None => file.token.filter(|_| is_meant),
        };
        let token = token.map(|token| checked(&token)).transpose()?;
        if token.is_some() && address.is_open_to_others() {
            console::note(&format!(
                "warning: the token goes to {address} unencrypted, so that others on the way can read it"
            ));
        }
        Ok(Self { address, token })
    }
}

/// Token of a flag or the environment.
fn token(options: &ServiceOptions) -> Result<Option<String>, Failure> {
    if let Some(path) = &options.token_file {
        return of_file(path).map(Some);
    }
    if let Some(token) = &options.token {
        console::note(
            "warning: other users of this machine can see a token on the command line; SCREE_TOKEN, --token-file or the client file keep it to you",
        );
        return Ok(Some(token.clone()));
    }
    Ok(environment("SCREE_TOKEN"))
}

fn of_file(path: &Path) -> Result<String, Failure> {
    let read = secret_file::read(path);
    let (text, metadata) = read.map_err(|error| Failure::path("read", path, &error))?;
    secret_file::refuse_if_others_can_read(path, &metadata)?;
    Ok(text)
}

/// The token without the space around it, if it can be sent.
fn checked(token: &str) -> Result<String, Failure> {
    let token = token.trim();
    if token.is_empty() || !token.bytes().all(|byte| byte.is_ascii_graphic()) {
        // Not the text: it may be a secret all the same.
        let rule = "the access token is empty or has other than visible ASCII characters";
        return Err(Failure::Input(rule.to_owned()));
    }
    Ok(token.to_owned())
}

fn read(text: &str) -> Result<Address, Failure> {
    Address::read(text).map_err(|error| Failure::Input(error.to_string()))
}

/// Value of a variable of the environment; an empty one is none.
fn environment(name: &str) -> Option<String> {
    std::env::var(name).ok().filter(|value| !value.is_empty())
}

fn no_address() -> Failure {
    Failure::Input(format!(
        "no address of a service is given: --url, SCREE_URL or {} names it",
        in_client_file("url")
    ))
}

/// Keys of a client file, in words.
pub(super) fn in_client_file(key: &str) -> String {
    match client_file::usual_path() {
        Some(path) => format!("`{key}` in {}", path.display()),
        None => format!("`{key}` in the client file"),
    }
}
