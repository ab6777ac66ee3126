//! Names under which browsers may reach the service, and pages that may use it.

use super::{ConfigError, Host, Origin, not_allowed};
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
        if let Some(name) = self.hosts.iter().find(|name| Host::parse(name).is_none()) {
            let reason = "allowed are host names or addresses without a port, such as \
                          \"scree.lab.example\" or \"[2001:db8::7]\"";
            return Err(not_allowed("browser.hosts", format!("{name:?}"), reason));
        }
        let mut origins = self.origins.iter();
        if let Some(origin) = origins.find(|origin| Origin::parse(origin).is_none()) {
            let reason = "allowed are origins without a path, such as \"https://lab.example:8443\"";
            let origin = format!("{origin:?}");
            return Err(not_allowed("browser.origins", origin, reason));
        }
        Ok(())
    }
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
        for host in ["", "http://lab", "a b", "lab:8080", "::1"] {
            assert!(browser(host, "https://a").check().is_err(), "{host}");
        }
        for origin in ["", "*", "null", "lab.example", "https://", "https://a/b"] {
            assert!(browser("a", origin).check().is_err(), "{origin}");
        }
    }
}
