//! Lists of which clients read a page at a time, newest first.

use super::query::Query;

/// Default number of entries per page.
const DEFAULT_LIMIT: u32 = 20;

/// Largest number of entries per page.
const LARGEST_LIMIT: u32 = 100;

/// List with pages, named by the letter that its cursors begin with: a cursor of one list is none
/// of another.
#[derive(Debug, Clone, Copy)]
pub(super) struct PagedList(char);

impl PagedList {
    pub(super) const JOBS: Self = Self('j');
    pub(super) const STUDIES: Self = Self('s');
    pub(super) const TERRAINS: Self = Self('t');

    /// Position in the list after which the page begins that a query asks for.
    pub(super) fn read_cursor(self, query: &mut Query) -> Option<i64> {
        query.word("cursor", "the next_cursor of another page", |text| {
            i64::from_str_radix(text.strip_prefix(self.0)?, 16).ok()
        })
    }

    /// Cursor of the page after an entry; opaque to clients.
    pub(super) fn cursor(self, sequence: i64) -> String {
        format!("{}{sequence:x}", self.0)
    }
}

/// Largest number of entries of the page that a query asks for.
pub(super) fn read_limit(query: &mut Query) -> u32 {
    let limit = query.whole("limit", 1..=LARGEST_LIMIT);
    limit.unwrap_or(DEFAULT_LIMIT)
}

/// Last entry of a page if there is another page; `found` has one entry more than the page then,
/// which is taken off.
pub(super) fn cut_to_page<T>(found: &mut Vec<T>, limit: u32) -> Option<&T> {
    let is_more = found.len() > limit as usize;
    found.truncate(limit as usize);
    found.last().filter(|_| is_more)
}
