//! Tables for people.

use std::fmt::Write as _;

/// A title, headings and rows under them; every column is aligned to the right end of its heading.
pub(super) fn table<const N: usize>(
    title: &str,
    headings: [&str; N],
    rows: impl IntoIterator<Item = [String; N]>,
) -> String {
    let mut lines = vec![headings.map(str::to_owned)];
    lines.extend(rows);
    let mut text = format!("{title}\n");
    for line in &lines {
        for (column, value) in line.iter().enumerate() {
            let widths = lines.iter().map(|line| line[column].chars().count());
            let width = widths.max().unwrap_or(0);
            let _ = write!(text, "  {value:>width$}");
        }
        text.push('\n');
    }
    text
}

/// Formats a number in millions, with about three digits.
pub(super) fn millions(value: f64) -> String {
    format!("{:.2}", value / 1e6)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_end_under_their_headings() {
        let rows = [["1".to_owned(), "22.5".to_owned()]];
        let text = table("title", ["n", "x"], rows);
        assert_eq!(text, "title\n  n     x\n  1  22.5\n");
    }
}
