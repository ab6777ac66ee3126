//! Parameters whose value is one of a few words.

use super::query::{Query, with_nearest};
use crate::jobs::job::JobStatus;
use crate::results::table::{Field, Format};
use crate::studies::study::StudyStatus;
use crate::terrains::FilePurpose;
use utoipa::ToSchema;

/// A value that is one of a few words.
pub(super) trait Choice: Copy + PartialEq {
    /// All values.
    fn all() -> Vec<Self>;

    /// The word for it.
    fn word(self) -> &'static str;

    /// The value with this word.
    fn from_word(word: &str) -> Option<Self> {
        Self::all().into_iter().find(|value| value.word() == word)
    }
}

/// Value of `reuse`: which job is as good as a new one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ToSchema)]
#[schema(rename_all = "lowercase")]
pub(super) enum Reuse {
    /// A successful one with the same scenario, run by this very program.
    Finished,
}

/// Value of `remove`: which job may be removed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ToSchema)]
#[schema(rename_all = "lowercase")]
pub(super) enum Remove {
    /// One that has ended.
    Ended,
}

/// Value of `include`: a part of each job that a list has beside its summary.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ToSchema)]
#[schema(rename_all = "lowercase")]
pub(super) enum Include {
    /// The outcome; null unless the job is successful.
    Outcome,
}

impl Choice for Include {
    fn all() -> Vec<Self> {
        vec![Self::Outcome]
    }

    fn word(self) -> &'static str {
        "outcome"
    }
}

impl Choice for Reuse {
    fn all() -> Vec<Self> {
        vec![Self::Finished]
    }

    fn word(self) -> &'static str {
        "finished"
    }
}

impl Choice for Remove {
    fn all() -> Vec<Self> {
        vec![Self::Ended]
    }

    fn word(self) -> &'static str {
        "ended"
    }
}

impl Choice for StudyStatus {
    fn all() -> Vec<Self> {
        Self::ALL.to_vec()
    }

    fn word(self) -> &'static str {
        Self::word(self)
    }
}

impl Choice for FilePurpose {
    fn all() -> Vec<Self> {
        Self::ALL.to_vec()
    }

    fn word(self) -> &'static str {
        Self::word(self)
    }
}

impl Choice for JobStatus {
    fn all() -> Vec<Self> {
        Self::ALL.to_vec()
    }

    fn word(self) -> &'static str {
        Self::word(self)
    }
}

impl Choice for Format {
    fn all() -> Vec<Self> {
        Self::ALL.to_vec()
    }

    fn word(self) -> &'static str {
        Self::word(self)
    }
}

impl Choice for Field {
    fn all() -> Vec<Self> {
        Self::all()
    }

    fn word(self) -> &'static str {
        self.name()
    }
}

impl Query {
    /// One of a few words.
    pub(super) fn choice<T: Choice>(&mut self, name: &str) -> Option<T> {
        let text = self.take(name)?;
        let value = T::from_word(&text);
        if value.is_none() {
            let words = T::all().into_iter().map(T::word);
            let allowed = with_nearest(&one_of::<T>(), &text.to_lowercase(), words);
            self.refuse(name, &text, &allowed, None);
        }
        value
    }

    /// Several words, each once: with commas between them, or the parameter repeated.
    pub(super) fn choices<T: Choice>(&mut self, name: &str) -> Option<Vec<T>> {
        let allowed = format!("each once, of {}", words::<T>());
        let lists = self.values(name);
        if lists.is_empty() {
            return None;
        }
        let mut chosen = Vec::new();
        for list in &lists {
            for word in list.split(',') {
                match T::from_word(word) {
                    Some(value) if chosen.contains(&value) => {
                        self.refuse(name, word, &allowed, None);
                    }
                    Some(value) => chosen.push(value),
                    None => {
                        let words = T::all().into_iter().map(T::word);
                        let allowed = with_nearest(&allowed, &word.to_lowercase(), words);
                        self.refuse(name, list, &allowed, None);
                    }
                }
            }
        }
        Some(chosen)
    }
}

fn words<T: Choice>() -> String {
    let words: Vec<&str> = T::all().into_iter().map(T::word).collect();
    words.join(", ")
}

fn one_of<T: Choice>() -> String {
    match T::all().as_slice() {
        [only] => only.word().to_owned(),
        _ => format!("one of {}", words::<T>()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fields(query: &str) -> Result<Vec<&'static str>, Vec<String>> {
        let mut query = Query::new(Some(query));
        let fields = query.choices::<Field>("fields").unwrap_or_default();
        match query.finish() {
            Ok(()) => Ok(fields.into_iter().map(Field::name).collect()),
            Err(problem) => Err(problem
                .errors
                .into_iter()
                .map(|error| error.value.to_string())
                .collect()),
        }
    }

    #[test]
    fn several_words_come_with_commas_or_one_by_one() {
        assert_eq!(fields(""), Ok(vec![]));
        assert_eq!(fields("fields=mode,time_s"), Ok(vec!["mode", "time_s"]));
        assert_eq!(
            fields("fields=mode&fields=time_s"),
            Ok(vec!["mode", "time_s"])
        );
        assert_eq!(
            fields("fields=mode,spam"),
            Err(vec!["\"mode,spam\"".to_owned()])
        );
        assert_eq!(
            fields("fields=mode&fields=mode"),
            Err(vec!["\"mode\"".to_owned()])
        );
        assert_eq!(fields("fields="), Err(vec!["\"\"".to_owned()]));
    }
}
