//! The keys before the values.

use super::{AsciiError, number};
use std::collections::BTreeMap;
use std::iter::Peekable;

/// Keys in lower case; files have them in any.
const KEYS: [&str; 10] = [
    "ncols",
    "nrows",
    "xllcorner",
    "xllcenter",
    "yllcorner",
    "yllcenter",
    "cellsize",
    "dx",
    "dy",
    "nodata_value",
];

/// Key that a word is.
pub(super) fn key(word: &str) -> Option<&'static str> {
    let same = |key: &&&str| key.eq_ignore_ascii_case(word);
    KEYS.iter().find(same).copied()
}

/// Numbers of the keys, each with its line.
pub(super) struct Header(BTreeMap<&'static str, (usize, f64)>);

impl Header {
    /// Header of a file, up to the first line that begins with a value.
    pub(super) fn read<'a>(
        lines: &mut Peekable<impl Iterator<Item = (usize, &'a str)>>,
    ) -> Result<Self, AsciiError> {
        let mut header = Self(BTreeMap::new());
        while let Some((line, text)) = lines.next_if(|(_, text)| !begins_with_value(text)) {
            let mut words = text.split_whitespace();
            if let Some(word) = words.next() {
                header.insert(line, word, &words.collect::<Vec<_>>())?;
            }
        }
        Ok(header)
    }

    fn insert(&mut self, line: usize, word: &str, numbers: &[&str]) -> Result<(), AsciiError> {
        let key = key(word).ok_or_else(|| AsciiError::UnknownKey {
            line,
            key: word.chars().take(20).collect(),
        })?;
        let &[text] = numbers else {
            let numbers = numbers.len();
            return Err(AsciiError::NumbersOfKey { line, key, numbers });
        };
        let value = number(line, text)?;
        match self.0.insert(key, (line, value)) {
            Some((first, _)) => Err(AsciiError::DuplicateKey { line, key, first }),
            None => Ok(()),
        }
    }

    fn get(&self, key: &str) -> Option<f64> {
        self.0.get(key).map(|(_, value)| *value)
    }

    fn count(&self, key: &'static str) -> Result<u64, AsciiError> {
        let value = self.get(key).ok_or(AsciiError::MissingKey { key })?;
        if value < 0.0 || value.fract() != 0.0 {
            return Err(AsciiError::NotWhole { key, value });
        }
        // Beyond the range it is the greatest number, which is too many.
        Ok(value as u64)
    }

    pub(super) fn columns(&self) -> Result<u64, AsciiError> {
        self.count("ncols")
    }

    pub(super) fn rows(&self) -> Result<u64, AsciiError> {
        self.count("nrows")
    }

    /// Width and height of a cell.
    pub(super) fn cell(&self) -> Result<[f64; 2], AsciiError> {
        match (self.get("cellsize"), self.get("dx"), self.get("dy")) {
            (Some(side), None, None) => Ok([side, side]),
            (None, Some(width), Some(height)) => Ok([width, height]),
            (None, _, _) => Err(AsciiError::MissingKey {
                key: "cellsize, nor dx and dy",
            }),
            (Some(_), _, _) => Err(AsciiError::BothKeys {
                one: "cellsize",
                other: "dx or dy",
            }),
        }
    }

    /// Western and southern edge, from a corner or the centre of the south-western cell.
    pub(super) fn place(&self, cell_size: f64) -> Result<[f64; 2], AsciiError> {
        let west = self.edge(
            ["xllcorner", "xllcenter"],
            "xllcorner or xllcenter",
            cell_size,
        )?;
        let south = self.edge(
            ["yllcorner", "yllcenter"],
            "yllcorner or yllcenter",
            cell_size,
        )?;
        Ok([west, south])
    }

    fn edge(
        &self,
        [corner, centre]: [&'static str; 2],
        key: &'static str,
        cell_size: f64,
    ) -> Result<f64, AsciiError> {
        match (self.get(corner), self.get(centre)) {
            (Some(edge), None) => Ok(edge),
            (None, Some(middle)) => Ok(middle - 0.5 * cell_size),
            (None, None) => Err(AsciiError::MissingKey { key }),
            (Some(_), Some(_)) => Err(AsciiError::BothKeys {
                one: corner,
                other: centre,
            }),
        }
    }

    pub(super) fn nodata(&self) -> Option<f64> {
        self.get("nodata_value")
    }
}

/// True of a line that begins with a value: a number, one written with a comma too.
fn begins_with_value(line: &str) -> bool {
    let Some(word) = line.split_whitespace().next() else {
        return false;
    };
    !word.starts_with(|first: char| first.is_alphabetic()) || word.parse::<f64>().is_ok()
}
