//! Reads a query string strictly: unknown, repeated and illegal parameters are
//! all named at once.

use super::problem::{FieldError, Problem};
use serde_json::Value;
use std::ops::RangeInclusive;

/// A query string being read, parameter by parameter.
#[derive(Debug)]
pub(super) struct Query {
    /// Parameters not asked for yet.
    pairs: Vec<(String, String)>,
    errors: Vec<FieldError>,
}

impl Query {
    /// Takes a query string apart.
    pub(super) fn new(query: Option<&str>) -> Self {
        let pairs = form_urlencoded::parse(query.unwrap_or_default().as_bytes());
        Self {
            pairs: pairs.into_owned().collect(),
            errors: Vec::new(),
        }
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

    /// A whole number in a range.
    pub(super) fn whole(&mut self, name: &str, allowed: RangeInclusive<u32>) -> Option<u32> {
        let text = self.take(name)?;
        let number: Option<u32> = text.parse().ok().filter(|number| allowed.contains(number));
        if number.is_none() {
            let range = match *allowed.end() {
                u32::MAX => format!("a whole number, x >= {}", allowed.start()),
                end => format!("a whole number, {} <= x <= {end}", allowed.start()),
            };
            self.refuse(name, &text, &range, None);
        }
        number
    }

    /// A text that `read` understands.
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

    /// All texts of a parameter that may be given several times.
    pub(super) fn all<T>(
        &mut self,
        name: &str,
        allowed: &str,
        read: impl Fn(&str) -> Option<T>,
    ) -> Vec<T> {
        let texts: Vec<String> = self
            .pairs
            .extract_if(.., |pair| pair.0 == name)
            .map(|pair| pair.1)
            .collect();
        let mut words = Vec::new();
        for text in texts {
            match read(&text) {
                Some(word) => words.push(word),
                None => self.refuse(name, &text, allowed, None),
            }
        }
        words
    }

    /// Refuses a parameter for a reason of the caller's.
    pub(super) fn refuse(&mut self, name: &str, value: &str, allowed: &str, unit: Option<&str>) {
        self.errors.push(FieldError {
            pointer: None,
            parameter: Some(name.to_owned()),
            value: Value::from(value),
            allowed: allowed.to_owned(),
            unit: unit.map(str::to_owned),
            detail: format!("{name} = \"{value}\" is not allowed: {allowed}"),
        });
    }

    /// Ends the reading.
    ///
    /// # Errors
    /// The problem document for all that was wrong, parameters that nobody
    /// asked for included.
    pub(super) fn finish(mut self) -> Result<(), Problem> {
        for (name, value) in std::mem::take(&mut self.pairs) {
            self.refuse(&name, &value, "no such parameter", None);
        }
        if self.errors.is_empty() {
            Ok(())
        } else {
            Err(Problem::invalid_query(self.errors))
        }
    }

    fn take(&mut self, name: &str) -> Option<String> {
        let mut values: Vec<String> = self
            .pairs
            .extract_if(.., |pair| pair.0 == name)
            .map(|pair| pair.1)
            .collect();
        if values.len() > 1 {
            self.refuse(name, &values.join(", "), "given once", None);
            return None;
        }
        values.pop()
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
    fn a_legal_query_is_read() {
        let mut query = Query::new(Some("from_s=0.5&stride=3"));
        assert_eq!(query.number("from_s", "s"), Some(0.5));
        assert_eq!(query.whole("stride", 1..=u32::MAX), Some(3));
        assert_eq!(query.number("to_s", "s"), None);
        assert_eq!(query.finish(), Ok(()));
    }
}
