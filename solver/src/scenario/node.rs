//! JSON with members in the order of the document and with duplicates.

use super::ScenarioError;
use serde::de::{Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use serde_json::{Number, Value};
use std::fmt;

/// Texts longer than this are cut in an error [characters].
const LONG_TEXT: usize = 80;
/// Lists and objects of more values than this are not repeated in a violation.
const MANY_VALUES: usize = 100;

/// A JSON value. Unlike [`Value`] it keeps order and repetition of keys.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Node {
    Null,
    Bool(bool),
    Number(Number),
    Text(String),
    List(Vec<Node>),
    Object(Vec<(String, Node)>),
}

impl Node {
    /// The member of an object with this key, the first of several.
    pub(super) fn get(&self, key: &str) -> Option<&Node> {
        let Self::Object(members) = self else {
            return None;
        };
        let mut members = members.iter();
        members.find(|(name, _)| name == key).map(|(_, node)| node)
    }

    /// Reads a text.
    pub(super) fn parse(text: &str) -> Result<Self, ScenarioError> {
        serde_json::from_str(text).map_err(|error| {
            let (line, column) = (error.line(), error.column());
            let position = format!(" at line {line} column {column}");
            ScenarioError::Malformed {
                message: error.to_string().replace(&position, ""),
                line,
                column,
            }
        })
    }

    /// The value as shown in a violation: long texts cut, and of large lists and objects only the
    /// size, so that an answer is not larger than the request.
    pub(super) fn excerpt(&self) -> Value {
        match self {
            Self::List(_) | Self::Object(_) if self.count() > MANY_VALUES => {
                Value::String(format!("… ({} values)", self.count()))
            }
            _ => self.short_value(),
        }
    }

    /// The value with long texts cut; of repeated keys the last counts.
    fn short_value(&self) -> Value {
        match self {
            Self::Null => Value::Null,
            Self::Bool(flag) => Value::Bool(*flag),
            Self::Number(number) => Value::Number(number.clone()),
            Self::Text(text) => Value::String(excerpt(text)),
            Self::List(items) => items.iter().map(Self::short_value).collect(),
            Self::Object(members) => members
                .iter()
                .map(|(key, node)| (excerpt(key), node.short_value()))
                .collect(),
        }
    }

    /// Number of values in it, itself included.
    pub(super) fn count(&self) -> usize {
        match self {
            Self::List(items) => 1 + items.iter().map(Self::count).sum::<usize>(),
            Self::Object(members) => {
                1 + members.iter().map(|(_, node)| node.count()).sum::<usize>()
            }
            _ => 1,
        }
    }
}

/// A text as shown in an error: of a long one the beginning and the length, so that an answer
/// is not larger than the request.
pub fn excerpt(text: &str) -> String {
    let length = text.chars().count();
    if length <= LONG_TEXT {
        return text.to_owned();
    }
    let start: String = text.chars().take(LONG_TEXT).collect();
    format!("{start}… ({length} characters)")
}

/// A key as one token of a JSON pointer (RFC 6901).
pub(super) fn escaped(key: &str) -> String {
    key.replace('~', "~0").replace('/', "~1")
}

/// A token of a JSON pointer as a key.
pub(super) fn unescaped(token: &str) -> String {
    token.replace("~1", "/").replace("~0", "~")
}

impl From<&Value> for Node {
    fn from(value: &Value) -> Self {
        match value {
            Value::Null => Self::Null,
            Value::Bool(flag) => Self::Bool(*flag),
            Value::Number(number) => Self::Number(number.clone()),
            Value::String(text) => Self::Text(text.clone()),
            Value::Array(items) => Self::List(items.iter().map(Self::from).collect()),
            Value::Object(members) => Self::Object(
                members
                    .iter()
                    .map(|(key, value)| (key.clone(), Self::from(value)))
                    .collect(),
            ),
        }
    }
}

impl<'de> Deserialize<'de> for Node {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NodeVisitor)
    }
}

struct NodeVisitor;

impl<'de> Visitor<'de> for NodeVisitor {
    type Value = Node;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a JSON value")
    }

    fn visit_unit<E>(self) -> Result<Node, E> {
        Ok(Node::Null)
    }

    fn visit_bool<E>(self, flag: bool) -> Result<Node, E> {
        Ok(Node::Bool(flag))
    }

    fn visit_u64<E>(self, number: u64) -> Result<Node, E> {
        Ok(Node::Number(number.into()))
    }

    fn visit_i64<E>(self, number: i64) -> Result<Node, E> {
        Ok(Node::Number(number.into()))
    }

    fn visit_f64<E>(self, number: f64) -> Result<Node, E> {
        Ok(Number::from_f64(number).map_or(Node::Null, Node::Number))
    }

    fn visit_str<E>(self, text: &str) -> Result<Node, E> {
        Ok(Node::Text(text.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Node, A::Error> {
        let mut list = Vec::new();
        while let Some(item) = items.next_element()? {
            list.push(item);
        }
        Ok(Node::List(list))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut members: A) -> Result<Node, A::Error> {
        let mut object = Vec::new();
        while let Some(member) = members.next_entry()? {
            object.push(member);
        }
        Ok(Node::Object(object))
    }
}
