//! JSON pointers (RFC 6901).

use serde_json::Value;

/// JSON pointer below the root.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Pointer {
    /// Unescaped tokens of the path to the parent.
    parents: Vec<String>,
    /// Unescaped last token.
    last: String,
}

impl Pointer {
    /// Pointer of its text, or what is wrong with that.
    pub(super) fn parse(text: &str) -> Result<Self, String> {
        let Some(path) = text.strip_prefix('/') else {
            return Err(format!(
                "pointer is {text:?}, allowed: a path that begins with /"
            ));
        };
        let tokens = path.split('/').map(unescaped).collect::<Option<Vec<_>>>();
        let mut parents = tokens.ok_or_else(|| {
            format!("pointer is {text:?}, allowed: ~ only as ~0 (for ~) and ~1 (for /)")
        })?;
        let last = parents.pop().unwrap_or_default();
        Ok(Self { parents, last })
    }

    /// True if this is the other's place or a place around it.
    fn holds(&self, other: &Self) -> bool {
        let own: Vec<&String> = self.tokens().collect();
        let others: Vec<&String> = other.tokens().collect();
        others.starts_with(&own)
    }

    /// True if one of the two places is the other or lies in it.
    pub(super) fn overlaps(&self, other: &Self) -> bool {
        self.holds(other) || other.holds(self)
    }

    fn tokens(&self) -> impl Iterator<Item = &String> {
        self.parents.iter().chain([&self.last])
    }

    /// True if a value can be set there: the place is in the document, or is a new key of an
    /// object in it.
    pub(super) fn fits(&self, document: &Value) -> bool {
        let mut at = document;
        for token in &self.parents {
            let Some(child) = child(at, token) else {
                return false;
            };
            at = child;
        }
        at.is_object() || child(at, &self.last).is_some()
    }

    /// Sets the value there; a document that the pointer does not fit stays as it is.
    pub(super) fn set(&self, document: &mut Value, value: Value) {
        let mut at = document;
        for token in &self.parents {
            let Some(child) = child_mut(at, token) else {
                return;
            };
            at = child;
        }
        if let Value::Object(object) = at {
            object.insert(self.last.clone(), value);
        } else if let Some(place) = child_mut(at, &self.last) {
            *place = value;
        }
    }
}

/// Value of a key of an object or an index of an array.
fn child<'a>(value: &'a Value, token: &str) -> Option<&'a Value> {
    match value {
        Value::Object(object) => object.get(token),
        Value::Array(array) => array.get(index(token)?),
        _ => None,
    }
}

fn child_mut<'a>(value: &'a mut Value, token: &str) -> Option<&'a mut Value> {
    match value {
        Value::Object(object) => object.get_mut(token),
        Value::Array(array) => array.get_mut(index(token)?),
        _ => None,
    }
}

/// Index of an array: digits without a leading zero.
fn index(token: &str) -> Option<usize> {
    let digits = token.bytes().all(|byte| byte.is_ascii_digit());
    let padded = token.len() > 1 && token.starts_with('0');
    (digits && !padded).then(|| token.parse().ok()).flatten()
}

/// Token with its escapes resolved, or none if a ~ is no escape.
fn unescaped(token: &str) -> Option<String> {
    let mut parts = token.split('~');
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let escaped = match part.as_bytes().first() {
            Some(b'0') => '~',
            Some(b'1') => '/',
            _ => return None,
        };
        text.push(escaped);
        text.push_str(&part[1..]);
    }
    Some(text)
}
