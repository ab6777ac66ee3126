//! Formats of the trajectories in a folder.

use scree::results::TrajectoryColumns;
use scree::results::table::{Field, Format, Heading};
use scree_solver::record::Sample;

/// Formats in which trajectories are written: at least one, each once.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(in crate::cli) struct Formats(Vec<Format>);

impl Default for Formats {
    fn default() -> Self {
        Self(vec![Format::Json])
    }
}

impl Formats {
    /// The formats asked for; none if none is.
    pub(in crate::cli) fn asked(formats: &[Format]) -> Option<Self> {
        let chosen = Format::ALL.into_iter().filter(|one| formats.contains(one));
        let chosen: Vec<Format> = chosen.collect();
        (!chosen.is_empty()).then_some(Self(chosen))
    }

    /// Each of them.
    pub(in crate::cli) fn each(&self) -> impl Iterator<Item = Format> {
        self.0.iter().copied()
    }

    /// The trajectory of a body, with the name of its file, in each format.
    pub(in crate::cli) fn files_of(
        &self,
        samples: &[Sample],
        body: usize,
    ) -> impl Iterator<Item = (String, Vec<u8>)> {
        let columns = TrajectoryColumns::of_body(samples, body);
        let formats = self.0.iter();
        formats.map(move |format| (file_name(body, *format), written(*format, body, &columns)))
    }

    /// Their words, parted by commas.
    pub(super) fn words(&self) -> String {
        let words: Vec<_> = self.0.iter().map(|format| format.word()).collect();
        words.join(",")
    }

    /// The formats with these words; none if there is none among them.
    pub(super) fn from_words(words: &str) -> Option<Self> {
        let words: Vec<_> = words.split(',').collect();
        let named = |format: &Format| words.contains(&format.word());
        let formats: Vec<_> = Format::ALL.into_iter().filter(named).collect();
        Self::asked(&formats)
    }
}

/// Name of the file of a body's trajectory.
pub(in crate::cli) fn file_name(body: usize, format: Format) -> String {
    format!("trajectory-{body}.{}", format.word())
}

/// True for the name of a trajectory's file, of any body and format.
pub(super) fn is_trajectory(name: &str) -> bool {
    let parts = name
        .strip_prefix("trajectory-")
        .and_then(|rest| rest.split_once('.'));
    parts.is_some_and(|(body, word)| {
        let known = Format::ALL.iter().any(|format| format.word() == word);
        known && body.parse::<usize>().is_ok()
    })
}

fn written(format: Format, body: usize, columns: &TrajectoryColumns) -> Vec<u8> {
    let heading = Heading {
        job_id: None,
        body,
        rows: columns.len(),
    };
    let mut writer = format.writer(&heading, Field::all());
    let mut bytes = Vec::new();
    for pass in 0..writer.passes() {
        writer.begin(pass, &mut bytes);
        writer.rows(pass, columns, &mut bytes);
        writer.end(pass, &mut bytes);
    }
    bytes
}
