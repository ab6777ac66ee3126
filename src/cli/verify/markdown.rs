//! Findings as a part of a document in Markdown.

use super::{NOTHING, Report, limit_in_words, order_in_words, row};
use crate::cli::failure::Failure;
use crate::cli::files;
use scree::verify::{How, Verified};
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

/// Lines that enclose the tables.
const BEGIN: &str = "<!-- tables of scree verify: begin -->";
const END: &str = "<!-- tables of scree verify: end -->";

/// A page whose tables are to be replaced: opened before the cases run, since an
/// invalid page should not cost their time.
pub(super) struct Page<'a> {
    file: &'a Path,
    before: String,
    after: String,
}

impl<'a> Page<'a> {
    /// Reads a file, which must have the marks.
    pub(super) fn open(file: &'a Path) -> Result<Self, Failure> {
        let text = fs::read_to_string(file).map_err(|error| failed(file, &error))?;
        let parts = parted(&text);
        let (before, after) =
            parts.ok_or_else(|| failed(file, &format!("no lines {BEGIN} and {END}")))?;
        Ok(Self {
            file,
            before: before.to_owned(),
            after: after.to_owned(),
        })
    }

    /// Rewrites the file with these tables between the marks.
    pub(super) fn write(&self, report: &Report) -> Result<(), Failure> {
        Ok(files::replace(
            self.file,
            self.with(&tables(report)).as_bytes(),
        )?)
    }

    fn with(&self, tables: &str) -> String {
        format!("{}{BEGIN}\n{tables}\n{END}{}", self.before, self.after)
    }
}

fn failed(file: &Path, why: &dyn std::fmt::Display) -> Failure {
    Failure::Other(format!("{}: {why}", file.display()))
}

/// Text before and after the marks.
fn parted(text: &str) -> Option<(&str, &str)> {
    let (before, rest) = text.split_once(BEGIN)?;
    let (_, after) = rest.split_once(END)?;
    Some((before, after))
}

fn tables(report: &Report) -> String {
    let mut text = report.heading();
    if !report.robustness.is_empty() || !report.randomised.is_empty() {
        text.push_str("\n\n");
        text.push_str(&super::robustness_tables::markdown(report));
    }
    if report.cases.is_empty() {
        return text;
    }
    text.push_str("\n\n| case | | passed | failed | reported |\n|---|---|---|---|---|\n");
    for Verified { case, found } in &report.cases {
        let count = found.count();
        let counts = match case.how {
            How::Runs(_) => [count.passed, count.failed, count.reported].map(|n| n.to_string()),
            How::NotYet(_) => [NOTHING; 3].map(str::to_owned),
        };
        let cells = counts.join(" | ");
        let _ = writeln!(
            text,
            "| {} `{}` | {} | {cells} |",
            case.number, case.name, case.title
        );
    }
    let _ = writeln!(text, "\n{}", report.ending());
    for verified in &report.cases {
        text.push_str(&section(verified));
    }
    text
}

fn section(Verified { case, found }: &Verified) -> String {
    let mut text = format!("\n### {} `{}`\n\n{}. ", case.number, case.name, case.title);
    let _ = writeln!(text, "Reference: {}.", case.source);
    if let How::NotYet(why) = case.how {
        let _ = writeln!(text, "\nNot yet expressible: {why}.");
        return text;
    }
    text.push_str(
        "\n| quantity | resolution | measured | reference | unit | error | tolerance | wall [s] | M point-steps/s | verdict |\n\
         |---|---|---|---|---|---|---|---|---|---|\n",
    );
    for finding in &found.values {
        let mut cells = row(finding);
        if cells[9] == "FAIL" {
            cells[9] = "**FAIL**".to_owned();
        }
        let cells = cells.map(|cell| cell.replace('|', "\\|"));
        let _ = writeln!(text, "| {} |", cells.join(" | "));
    }
    let failures = found.values.iter().filter_map(|one| one.failure.as_ref());
    let notes = failures.map(|failure| format!("failed: {failure}"));
    let orders = found.orders.iter().map(order_in_words);
    let limits = found.limits.iter().map(limit_in_words);
    let mut notes: Vec<String> = notes.chain(orders).chain(limits).collect();
    notes.dedup();
    if !notes.is_empty() {
        let _ = writeln!(text, "\n- {}", notes.join("\n- "));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_stands_between_the_marks_is_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("page.md");
        let text = |tables: &str| format!("a\n{BEGIN}\n{tables}\n{END}\nb\n");
        for old in ["old", "new"] {
            fs::write(&file, text(old)).unwrap();
            assert_eq!(Page::open(&file).unwrap().with("new"), text("new"));
        }
        fs::write(&file, "a").unwrap();
        assert!(Page::open(&file).is_err());
    }
}
