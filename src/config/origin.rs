//! Hosts and origins in one form each, so that they can be compared (RFC 6454, RFC 9110).

use std::fmt;
use std::net::{IpAddr, Ipv6Addr};

/// Name or address of a host, in lower case, without a final dot and without brackets.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Host(String);

/// A host and perhaps a port, as in the header `Host`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Authority {
    /// The host.
    pub host: Host,
    /// The port, if one is given.
    pub port: Option<u16>,
}

/// An origin: scheme, host, and the port if it is not that of the scheme.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Origin {
    scheme: Scheme,
    authority: Authority,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Scheme {
    Http,
    Https,
}

impl Host {
    /// The host of this address.
    pub fn of_address(address: IpAddr) -> Self {
        Self(address.to_canonical().to_string())
    }

    /// The host with this name or address; an address of IPv6 stands in brackets.
    pub fn parse(text: &str) -> Option<Self> {
        if let Some(address) = text.strip_prefix('[') {
            let address: Ipv6Addr = address.strip_suffix(']')?.parse().ok()?;
            return Some(Self::of_address(address.into()));
        }
        if let Ok(address) = text.parse::<std::net::Ipv4Addr>() {
            return Some(Self::of_address(address.into()));
        }
        let name = text.strip_suffix('.').unwrap_or(text).to_ascii_lowercase();
        let legal = |label: &str| {
            let legal = |byte: u8| byte.is_ascii_alphanumeric() || b"-_".contains(&byte);
            !label.is_empty() && label.bytes().all(legal)
        };
        name.split('.').all(legal).then_some(Self(name))
    }

    /// True for a name or an address of the loopback interface.
    pub fn is_loopback(&self) -> bool {
        let address: Option<IpAddr> = self.0.parse().ok();
        self.0 == "localhost" || address.is_some_and(|address| address.is_loopback())
    }
}

impl Authority {
    /// The host and port of this text.
    pub fn parse(text: &str) -> Option<Self> {
        let (host, port) = match text.rsplit_once(':') {
            // The last colon of an address in brackets stands within them.
            Some((host, port)) if !port.ends_with(']') => (host, Some(port)),
            _ => (text, None),
        };
        let digits = |port: &&str| port.bytes().all(|byte| byte.is_ascii_digit());
        let port = match port {
            None => None,
            Some(port) => Some(port).filter(digits)?.parse().ok().map(Some)?,
        };
        Some(Self {
            host: Host::parse(host)?,
            port,
        })
    }
}

impl Origin {
    /// The origin of this text.
    pub fn parse(text: &str) -> Option<Self> {
        let (scheme, rest) = text.split_once("://")?;
        let scheme = match scheme {
            "http" => Scheme::Http,
            "https" => Scheme::Https,
            _ => return None,
        };
        let authority = Authority::parse(rest)?;
        Some(Self {
            scheme,
            authority: scheme.without_own_port(authority),
        })
    }

    /// True if a page of this origin was served under this host and port.
    pub fn is_of(&self, authority: &Authority) -> bool {
        self.scheme.without_own_port(authority.clone()) == self.authority
    }
}

impl Scheme {
    fn without_own_port(self, authority: Authority) -> Authority {
        let own = match self {
            Self::Http => 80,
            Self::Https => 443,
        };
        Authority {
            port: authority.port.filter(|port| *port != own),
            ..authority
        }
    }
}

impl fmt::Display for Host {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.contains(':') {
            write!(to, "[{}]", self.0)
        } else {
            write!(to, "{}", self.0)
        }
    }
}

/// As browsers write it.
impl fmt::Display for Origin {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        let scheme = match self.scheme {
            Scheme::Http => "http",
            Scheme::Https => "https",
        };
        write!(to, "{scheme}://{}", self.authority.host)?;
        match self.authority.port {
            Some(port) => write!(to, ":{port}"),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_host_has_one_form() {
        for (text, host) in [
            ("LocalHost", "localhost"),
            ("scree.lab.", "scree.lab"),
            ("[0:0:0:0:0:0:0:1]", "[::1]"),
            ("[::ffff:127.0.0.1]", "127.0.0.1"),
            ("127.8.0.1", "127.8.0.1"),
        ] {
            assert_eq!(Host::parse(text).unwrap().to_string(), host);
        }
        for text in [
            "",
            ".",
            "a..b",
            "localhost..",
            "[127.0.0.1]",
            "[[::1]]",
            "::1",
            "a b",
            "a/b",
        ] {
            assert_eq!(Host::parse(text), None, "{text}");
        }
        for (text, port) in [
            ("a:8080", Some(8080)),
            ("[::1]:80", Some(80)),
            ("[::1]", None),
        ] {
            assert_eq!(Authority::parse(text).unwrap().port, port);
        }
        for text in ["a:", "a:99999999", "a:x", "a:+1", ":80"] {
            assert_eq!(Authority::parse(text), None, "{text}");
        }
    }

    #[test]
    fn one_origin_has_one_form() {
        let origin = |text: &str| Origin::parse(text).unwrap();
        assert_eq!(
            origin("https://Lab.example:443").to_string(),
            "https://lab.example"
        );
        assert_eq!(origin("http://[::1]:3000").to_string(), "http://[::1]:3000");
        let host = |text: &str| Authority::parse(text).unwrap();
        assert!(origin("http://localhost").is_of(&host("LOCALHOST:80")));
        assert!(origin("http://localhost:8080").is_of(&host("localhost:8080")));
        assert!(!origin("http://localhost:8080").is_of(&host("localhost:8081")));
        assert!(!origin("http://localhost").is_of(&host("localhost:8080")));
        for text in [
            "",
            "*",
            "null",
            "lab.example",
            "ftp://a",
            "https://",
            "https://a/b",
        ] {
            assert_eq!(Origin::parse(text), None, "{text}");
        }
    }
}
