//! Bytes after a header: length of the header (u32, little-endian), the header, the rest.

use serde::Serialize;
use serde::de::DeserializeOwned;

/// Joins a header of plain data and the bytes after it.
pub(super) fn joined(head: &impl Serialize, rest: &[u8]) -> Vec<u8> {
    let head = postcard::to_allocvec(head).expect("plain data always serialises");
    let length = u32::try_from(head.len()).expect("a head is shorter than 4 GiB");
    let mut bytes = Vec::with_capacity(4 + head.len() + rest.len());
    bytes.extend(length.to_le_bytes());
    bytes.extend(head);
    bytes.extend(rest);
    bytes
}

/// The header and the rest; none if the bytes have no such header.
pub(super) fn parted<Head: DeserializeOwned>(bytes: &[u8]) -> Option<(Head, &[u8])> {
    let (length, rest) = bytes.split_first_chunk::<4>()?;
    let length = u32::from_le_bytes(*length) as usize;
    let (head, rest) = rest.split_at_checked(length)?;
    Some((postcard::from_bytes(head).ok()?, rest))
}
