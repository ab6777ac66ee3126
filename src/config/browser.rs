//! Names under which browsers may reach the service, and pages that may use it.

use super::{ConfigError, not_allowed};
use serde::{Deserialize, Serialize};

/// Permissions of browsers. Programs other than browsers are not concerned, but for `Host`.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Browser {
    /// Names (`Host`, without port) under which the service may be addressed, besides its address
    /// and the names of the loopback interface. Without access tokens others are refused: a page
    /// could make its own name point at the loopback interface (DNS rebinding).
    pub hosts: Vec<String>,
    /// Origins (`https://lab.example`) of pages elsewhere that may use the service (CORS); pages
    /// of the service itself always may.
    pub origins: Vec<String>,
}

impl Browser {
    pub(super) fn check(&self) -> Result<(), ConfigError> {
        let is_name = |name: &&String| {
            !name.is_empty()
                && name
                    .chars()
                    .all(|c| c.is_ascii_alphanumeric() || ".-[]:".contains(c))
        };
        if let Some(name) = self.hosts.iter().find(|name| !is_name(name)) {
            let reason = "allowed are host names or addresses, such as \"scree.lab.example\"";
            return Err(not_allowed("browser.hosts", format!("{name:?}"), reason));
        }
        if let Some(origin) = self.origins.iter().find(|origin| !is_origin(origin)) {
            let reason = "allowed are origins without a path, such as \"https://lab.example:8443\"";
            return Err(not_allowed(
                "browser.origins",
                format!("{origin:?}"),
                reason,
            ));
        }
        Ok(())
    }
}

/// True for `http` or `https`, a host, and perhaps a port, in lower case as browsers send it.
fn is_origin(text: &str) -> bool {
    let rest = text
        .strip_prefix("https://")
        .or_else(|| text.strip_prefix("http://"));
    rest.is_some_and(|host| {
        let legal = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || ".-[]:".contains(c);
        !host.is_empty() && host.chars().all(legal)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hosts_have_no_scheme_and_origins_no_path() {
        let browser = |host: &str, origin: &str| Browser {
            hosts: vec![host.to_owned()],
            origins: vec![origin.to_owned()],
        };
        let good = browser("scree.lab.example", "https://lab.example:8443");
        assert!(good.check().is_ok());
        assert!(browser("[::1]", "http://localhost:3000").check().is_ok());
        for host in ["", "http://lab", "a b"] {
            assert!(browser(host, "https://a").check().is_err(), "{host}");
        }
        for origin in ["", "*", "null", "lab.example", "https://", "https://a/b"] {
            assert!(browser("a", origin).check().is_err(), "{origin}");
        }
    }
}
