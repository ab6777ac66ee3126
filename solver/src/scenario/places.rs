//! Places of nodes in a document, by their JSON pointers.

use super::node::{Node, unescaped};
use std::collections::HashMap;

/// Index of the child at every level, the end of its parent for a missing one. Comparing places
/// sorts pointers into document order.
pub(super) type Place = Vec<usize>;

/// A document with the keys of every object that has been searched: a thousand violations in an
/// object of a thousand members take no million comparisons.
#[derive(Debug)]
pub(super) struct Places<'a> {
    document: &'a Node,
    keys: HashMap<Place, HashMap<&'a str, usize>>,
}

impl<'a> Places<'a> {
    pub(super) fn of(document: &'a Node) -> Self {
        Self {
            document,
            keys: HashMap::new(),
        }
    }

    /// Node at a JSON pointer, if it is there, and its place. Of a repeated key it is the first.
    pub(super) fn find(&mut self, pointer: &str) -> (Place, Option<&'a Node>) {
        let mut place = Place::new();
        let mut here = Some(self.document);
        for token in pointer.split('/').skip(1) {
            let child = here.and_then(|node| self.child(node, &place, &unescaped(token)));
            place.push(child.map_or(usize::MAX, |(index, _)| index));
            here = child.map(|(_, node)| node);
        }
        (place, here)
    }

    /// The child of the node at a place, and its index.
    fn child(&mut self, node: &'a Node, place: &Place, token: &str) -> Option<(usize, &'a Node)> {
        match node {
            Node::Object(members) => {
                if !self.keys.contains_key(place) {
                    // Collected from the end, so that the first of a repeated key is kept.
                    let keys = members.iter().enumerate().rev();
                    let keys = keys
                        .map(|(index, (key, _))| (key.as_str(), index))
                        .collect();
                    self.keys.insert(place.clone(), keys);
                }
                let index = *self.keys[place].get(token)?;
                Some((index, &members[index].1))
            }
            Node::List(items) => {
                let index = token.parse().ok()?;
                Some((index, items.get(index)?))
            }
            _ => None,
        }
    }
}
