//! Address of a service.

use std::fmt;
use std::net::IpAddr;
use thiserror::Error;
use ureq::http::Uri;

/// Address of a service, with the path under which a proxy has it, without a slash at the end.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Address {
    text: String,
    is_encrypted: bool,
    is_loopback: bool,
}

/// A text that is no address of a service.
#[derive(Debug, Error, PartialEq, Eq)]
#[error(
    "{text:?} is no address of a service: {reason}; allowed is for example https://scree.example.org or http://127.0.0.1:8080"
)]
pub(super) struct NoAddress {
    text: String,
    reason: &'static str,
}

impl Address {
    /// Reads an address.
    ///
    /// # Errors
    /// Another scheme than http and https, no host, or parts that an address has not.
    pub(super) fn read(text: &str) -> Result<Self, NoAddress> {
        let no = |reason| NoAddress {
            text: without_user(text),
            reason,
        };
        let uri: Uri = text.parse().map_err(|_| no("it is no URL"))?;
        let is_encrypted = match uri.scheme_str() {
            Some("https") => true,
            Some("http") => false,
            Some(_) => return Err(no("its scheme is neither http nor https")),
            None => return Err(no("it has no scheme")),
        };
        let host = uri.host().filter(|host| !host.is_empty());
        let host = host.ok_or_else(|| no("it names no host"))?;
        if uri
            .authority()
            .is_some_and(|all| all.as_str().contains('@'))
        {
            return Err(no("users and passwords have no place in it"));
        }
        if uri.query().is_some() || text.contains('#') {
            return Err(no("it has a query or fragment"));
        }
        Ok(Self {
            text: text.trim_end_matches('/').to_owned(),
            is_encrypted,
            is_loopback: is_loopback(host),
        })
    }

    /// True if it leads to this machine alone.
    pub(super) fn is_loopback(&self) -> bool {
        self.is_loopback
    }

    /// True if others on the way can read what is sent.
    pub(super) fn is_open_to_others(&self) -> bool {
        !self.is_encrypted && !self.is_loopback
    }
}

impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

fn is_loopback(host: &str) -> bool {
    let plain = host.trim_start_matches('[').trim_end_matches(']');
    let address: Option<IpAddr> = plain.parse().ok();
    address.map_or(host == "localhost", |address| address.is_loopback())
}

/// The text without what may be a password.
fn without_user(text: &str) -> String {
    match (text.find("://"), text.rfind('@')) {
        (Some(scheme), Some(at)) if scheme < at => {
            format!("{}://…{}", &text[..scheme], &text[at..])
        }
        _ => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_keep_their_path_and_lose_the_slash() {
        for (text, read, open) in [
            ("http://127.0.0.1:8080/", "http://127.0.0.1:8080", false),
            ("http://[::1]:8080", "http://[::1]:8080", false),
            ("http://localhost", "http://localhost", false),
            ("https://a.org/scree/", "https://a.org/scree", false),
            ("http://a.org", "http://a.org", true),
        ] {
            let address = Address::read(text).unwrap();
            assert_eq!(address.to_string(), read);
            assert_eq!(address.is_open_to_others(), open, "{text}");
        }
    }

    #[test]
    fn what_is_no_address_is_told_without_passwords() {
        for text in [
            "",
            "127.0.0.1:8080",
            "a.org",
            "ftp://a.org",
            "http://",
            "http://a.org/?x=1",
            "http://a.org/#x",
            "http://me:secret@a.org",
        ] {
            let told = Address::read(text).unwrap_err().to_string();
            assert!(told.contains("is no address"), "{told}");
            assert!(!told.contains("secret"), "{told}");
        }
    }
}
