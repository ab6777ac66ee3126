//! Strict reading of a query string: unknown, repeated and illegal parameters are
//! all reported at once.

use super::field_errors::{FieldError, FieldErrors};
use super::problem::Problem;
use crate::jobs::submit::excerpt;
use jiff::Timestamp;
use serde_json::Value;
use std::fmt::Display;
use std::ops::RangeInclusive;
use std::str::FromStr;
use strsim::jaro_winkler;

/// Largest number of parameters in a query.
const MOST_PARAMETERS: usize = 100;

/// A query string being read, parameter by parameter.
#[derive(Debug)]
pub(super) struct Query {
    /// Parameters not read yet.
    pairs: Vec<(String, String)>,
    /// Names of the parameters asked for so far.
    known: Vec<String>,
    errors: FieldErrors,
}

impl Query {
    /// Parses a query string.
    pub(super) fn new(query: Option<&str>) -> Self {
        let query = query.unwrap_or_default();
        let pairs = form_urlencoded::parse(query.as_bytes());
        let mut read = Self {
            pairs: pairs.into_owned().take(MOST_PARAMETERS + 1).collect(),
            known: Vec::new(),
            errors: FieldErrors::default(),
        };
        if read.pairs.len() > MOST_PARAMETERS {
            read.pairs.clear();
            let allowed = format!("at most {MOST_PARAMETERS} parameters");
            read.refuse("query", query, &allowed, None);
        }
        read
    }

    /// A finite number.
    pub(super) fn number(&mut self, name: &str, unit: &str) -> Option<f64> {
        let text = self.take(name)?;
        let number: Option<f64> = text.parse().ok().filter(|number: &f64| number.is_finite());
        if number.is_none() {
            self.refuse(name, &text, "a finite number", Some(unit));
        }
        number
    }

    /// Start and end of a range of simulated time [s]: `from_s` and `to_s`.
    pub(super) fn time_range(&mut self) -> (Option<f64>, Option<f64>) {
        let from_s = self.number("from_s", "s");
        let to_s = self.number("to_s", "s");
        if let (Some(from_s), Some(to_s)) = (from_s, to_s)
            && to_s < from_s
        {
            let rule = format!("x >= from_s = {from_s}");
            self.refuse("to_s", &to_s.to_string(), &rule, Some("s"));
        }
        (from_s, to_s)
    }

    /// A whole number in a range.
    pub(super) fn whole<T: FromStr + PartialOrd + Display>(
        &mut self,
        name: &str,
        allowed: RangeInclusive<T>,
    ) -> Option<T> {
        let text = self.take(name)?;
        self.whole_of(name, &text, &allowed)
    }

    /// A whole number in a range, from a text that is not part of the query.
    pub(super) fn whole_of<T: FromStr + PartialOrd + Display>(
        &mut self,
        name: &str,
        text: &str,
        allowed: &RangeInclusive<T>,
    ) -> Option<T> {
        let number: Option<T> = text.parse().ok().filter(|number| allowed.contains(number));
        if number.is_none() {
            let (least, most) = (allowed.start(), allowed.end());
            let range = format!("a whole number, {least} <= x <= {most}");
            self.refuse(name, text, &range, None);
        }
        number
    }

    /// A time of day.
    pub(super) fn time(&mut self, name: &str) -> Option<Timestamp> {
        let allowed = "a time of RFC 3339, as 2026-01-31T12:00:00Z; the + of an offset is \
                       written %2B";
        self.word(name, allowed, |text| text.parse().ok())
    }

    /// A text that `read` accepts.
    pub(super) fn word<T>(
        &mut self,
        name: &str,
        allowed: &str,
        read: impl FnOnce(&str) -> Option<T>,
    ) -> Option<T> {
        let text = self.take(name)?;
        let word = read(&text);
        if word.is_none() {
            self.refuse(name, &text, allowed, None);
        }
        word
    }

    /// A truth value: `true` or `false`.
    pub(super) fn truth(&mut self, name: &str) -> Option<bool> {
        self.word(name, "true or false", |text| text.parse().ok())
    }

    /// All texts of a parameter that may be repeated.
    pub(super) fn all<T>(
        &mut self,
        name: &str,
        allowed: &str,
        read: impl Fn(&str) -> Option<T>,
    ) -> Vec<T> {
        let mut words = Vec::new();
        for text in self.values(name) {
            match read(&text) {
                Some(word) => words.push(word),
                None => self.refuse(name, &text, allowed, None),
            }
        }
        words
    }

    /// Refuses a parameter for a reason of the caller.
    pub(super) fn refuse(&mut self, name: &str, value: &str, allowed: &str, unit: Option<&str>) {
        let (name, value) = (excerpt(name), excerpt(value));
        self.errors.add(|| FieldError {
            pointer: None,
            parameter: Some(name.clone()),
            value: Value::from(value.as_str()),
            allowed: allowed.to_owned(),
            unit: unit.map(str::to_owned),
            detail: format!("{name} = \"{value}\" is not allowed: {allowed}"),
        });
    }

    /// Finishes the reading.
    ///
    /// # Errors
    /// The problem document with all faults, including unknown
    /// parameters.
    pub(super) fn finish(mut self) -> Result<(), Problem> {
        for (name, value) in std::mem::take(&mut self.pairs) {
            let known = self.known.iter().map(String::as_str);
            let allowed = with_nearest("no such parameter", &name, known);
            self.refuse(&name, &value, &allowed, None);
        }
        if self.errors.is_empty() {
            Ok(())
        } else {
            Err(Problem::invalid_query(self.errors))
        }
    }

    /// The value of a parameter that may be given once.
    pub(super) fn take(&mut self, name: &str) -> Option<String> {
        let mut values = self.values(name);
        if values.len() > 1 {
            self.refuse(name, &values.join(", "), "given once", None);
            return None;
        }
        values.pop()
    }

    /// All values of a parameter, which is known from now on.
    pub(super) fn values(&mut self, name: &str) -> Vec<String> {
        self.known.push(name.to_owned());
        let of_name = self.pairs.extract_if(.., |pair| pair.0 == name);
        of_name.map(|pair| pair.1).collect()
    }
}

/// Similarity from which on a word may have been meant for another, by Jaro and Winkler.
const SIMILAR: f64 = 0.8;

/// A rule, with the word that was probably meant.
pub(super) fn with_nearest<'a>(
    rule: &str,
    word: &str,
    allowed: impl Iterator<Item = &'a str>,
) -> String {
    let word = excerpt(word);
    let similarity = |other: &&str| jaro_winkler(&word, other);
    let nearest = allowed.max_by(|a, b| similarity(a).total_cmp(&similarity(b)));
    match nearest {
        Some(nearest) if similarity(&nearest) >= SIMILAR => {
            format!("{rule}; did you mean {nearest}?")
        }
        _ => rule.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_wrong_is_named_at_once() {
        let mut query = Query::new(Some("from_s=NaN&stride=0&to_s=1e999&spam=1&body=0&body=1"));
        assert_eq!(query.number("from_s", "s"), None);
        assert_eq!(query.number("to_s", "s"), None);
        assert_eq!(query.whole("stride", 1..=u32::MAX), None);
        assert_eq!(query.whole("body", 0..=u32::MAX), None);
        let problem = query.finish().unwrap_err();
        let named: Vec<_> = problem
            .errors
            .iter()
            .filter_map(|error| error.parameter.as_deref())
            .collect();
        assert_eq!(named, ["from_s", "to_s", "stride", "body", "spam"]);
    }

    #[test]
    fn what_is_long_is_not_repeated_in_full() {
        let (name, value) = ("n".repeat(5_000), "v".repeat(5_000));
        let query = format!("stride={value}&{name}=1");
        let mut query = Query::new(Some(&query));
        assert_eq!(query.whole("stride", 1..=u32::MAX), None);
        let problem = query.finish().unwrap_err();
        let start = format!("{}… (5000 characters)", "v".repeat(80));
        assert_eq!(problem.errors[0].value, start.as_str());
        let text = serde_json::to_string(&problem).unwrap();
        assert!(text.len() < 2_000, "{} bytes: {text}", text.len());
    }

    #[test]
    fn a_slip_of_the_pen_is_recognised() {
        let mut query = Query::new(Some("stat=1&strid=2&x=3"));
        assert_eq!(query.word("status", "a word", |_| Some(())), None);
        assert_eq!(query.whole("stride", 1..=9), None);
        let errors = query.finish().unwrap_err().errors;
        let allowed: Vec<_> = errors.iter().map(|error| error.allowed.as_str()).collect();
        let rule = "no such parameter";
        let meant = ["status", "stride"].map(|word| format!("{rule}; did you mean {word}?"));
        assert_eq!(allowed, [&meant[0], &meant[1], rule]);
    }

    #[test]
    fn the_range_that_is_told_is_the_range() {
        let mut query = Query::new(Some("stride=4294967296&after=-1"));
        assert_eq!(query.whole("stride", 1..=u32::MAX), None);
        assert_eq!(query.whole("after", 0..=i64::MAX), None);
        let problem = query.finish().unwrap_err();
        let told = problem.errors.iter().map(|error| error.allowed.as_str());
        let wanted = [
            "a whole number, 1 <= x <= 4294967295",
            "a whole number, 0 <= x <= 9223372036854775807",
        ];
        assert_eq!(told.collect::<Vec<_>>(), wanted);
        let mut query = Query::new(Some("after=9223372036854775807"));
        assert_eq!(query.whole("after", 0..=i64::MAX), Some(i64::MAX));
    }

    #[test]
    fn a_legal_query_is_read() {
        let mut query = Query::new(Some("from_s=0.5&stride=3"));
        assert_eq!(query.number("from_s", "s"), Some(0.5));
        assert_eq!(query.whole("stride", 1..=u32::MAX), Some(3));
        assert_eq!(query.number("to_s", "s"), None);
        assert_eq!(query.finish(), Ok(()));
    }
}
