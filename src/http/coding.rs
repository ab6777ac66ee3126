//! Codings of an answer's content, and the one that a client prefers.

use axum::http::{HeaderMap, HeaderValue, header};

/// Coding of an answer's content, the preferred one last.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Coding {
    Gzip,
    Zstd,
}

impl Coding {
    const ALL: [Self; 2] = [Self::Gzip, Self::Zstd];

    /// Its name in headers.
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Gzip => "gzip",
            Self::Zstd => "zstd",
        }
    }

    /// Its name as a header.
    pub(super) fn value(self) -> HeaderValue {
        HeaderValue::from_static(self.word())
    }

    /// The coding of the answer to a request that has passed `compress`.
    pub(super) fn chosen(headers: &HeaderMap) -> Option<Self> {
        let word = headers.get(header::ACCEPT_ENCODING)?;
        Self::ALL.into_iter().find(|coding| word == coding.word())
    }

    /// The coding that `Accept-Encoding` prefers; none if it has none of these, or prefers the
    /// content as it is. That is also the answer to a client that refuses it as it is, and
    /// accepts none of these.
    pub(super) fn preferred(headers: &HeaderMap) -> Option<Self> {
        let lists = headers.get_all(header::ACCEPT_ENCODING).into_iter();
        let lists = lists.filter_map(|list| list.to_str().ok());
        let accepted: Vec<(&str, f32)> = lists
            .flat_map(|list| list.split(','))
            .map(weighted)
            .collect();
        let weight = |name: &str| {
            let mut named = accepted
                .iter()
                .filter(|(other, _)| other.eq_ignore_ascii_case(name));
            named.next().map(|(_, weight)| *weight)
        };
        let rest = weight("*").unwrap_or(0.0);
        let codings = Self::ALL.map(|coding| (weight(coding.word()).unwrap_or(rest), coding));
        let best = codings.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
        let least = weight("identity").unwrap_or(0.0);
        let best = best.filter(|(weight, _)| *weight > 0.0 && *weight >= least);
        best.map(|(_, coding)| coding)
    }
}

/// One entry of `Accept-Encoding`: a name and its weight.
fn weighted(entry: &str) -> (&str, f32) {
    let mut parts = entry.split(';').map(str::trim);
    let name = parts.next().unwrap_or_default();
    let weight = parts.find_map(|part| part.strip_prefix("q=").or(part.strip_prefix("Q=")));
    let weight = weight.map_or(Some(1.0), |weight| weight.parse().ok());
    (name, weight.unwrap_or(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn preferred(accepted: &[&'static str]) -> Option<&'static str> {
        let mut headers = HeaderMap::new();
        for list in accepted {
            headers.append(header::ACCEPT_ENCODING, HeaderValue::from_static(list));
        }
        Coding::preferred(&headers).map(Coding::word)
    }

    #[test]
    fn a_client_gets_what_it_prefers_and_never_what_it_refuses() {
        for (accepted, coding) in [
            (&[][..], None),
            (&[""], None),
            (&["br, deflate"], None),
            (&["gzip"], Some("gzip")),
            (&["GZIP;Q=0.5"], Some("gzip")),
            (&["gzip, deflate, br, zstd"], Some("zstd")),
            (&["gzip", "zstd"], Some("zstd")),
            (&["gzip;q=1.0, zstd;q=0.9"], Some("gzip")),
            (&["gzip;q=0"], None),
            (&["*"], Some("zstd")),
            (&["*;q=0.5, zstd;q=0"], Some("gzip")),
            (&["identity, gzip;q=0.5"], None),
            (&["identity;q=0.5, gzip"], Some("gzip")),
            (&["identity;q=0, *;q=0"], None),
            (&["gzip;q=much"], None),
        ] {
            assert_eq!(preferred(accepted), coding, "{accepted:?}");
        }
    }
}
