//! Readers of single fields. They add unacceptable values to the report, and continue.

use super::node::{Node, escaped};
use super::range::{Range, Rule, short};
use super::report::Report;
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::ops::RangeInclusive;

/// Number of entries of a list, and the name of one and of many.
pub(super) struct Several {
    count: RangeInclusive<usize>,
    nouns: [&'static str; 2],
}

impl Several {
    pub(super) const fn new(count: RangeInclusive<usize>, nouns: [&'static str; 2]) -> Self {
        Self { count, nouns }
    }

    /// The number in words: "4 to 32 points".
    fn words(&self) -> String {
        let (least, most) = (*self.count.start(), *self.count.end());
        if least == most {
            self.counted(most)
        } else {
            format!("{least} to {}", self.counted(most))
        }
    }

    /// A number of them, in words.
    fn counted(&self, number: usize) -> String {
        let [one, many] = self.nouns;
        format!("{number} {}", if number == 1 { one } else { many })
    }
}

/// A JSON object that is being read.
pub(super) struct Object<'a> {
    pub(super) pointer: String,
    members: &'a [(String, Node)],
    known: RefCell<Vec<&'static str>>,
    pub(super) report: &'a Report,
}

impl<'a> Object<'a> {
    /// Opens a node as an object; refuses any other type, and repeated keys.
    pub(super) fn open(node: &'a Node, pointer: String, report: &'a Report) -> Option<Self> {
        let Node::Object(members) = node else {
            report.refuse(&pointer, "an object", None, "must be an object");
            return None;
        };
        let mut seen = BTreeSet::new();
        for (key, _) in members {
            if !seen.insert(key) {
                let pointer = format!("{pointer}/{}", escaped(key));
                let why = "is given more than once";
                report.refuse(&pointer, "each key once", None, why);
            }
        }
        Some(Self {
            pointer,
            members,
            known: RefCell::default(),
            report,
        })
    }

    /// Opens a field as an object of its own.
    pub(super) fn object(&self, node: &'a Node, key: &str) -> Option<Object<'a>> {
        Object::open(node, self.pointer_to(key), self.report)
    }

    /// The members in order.
    pub(super) fn members(&self) -> &'a [(String, Node)] {
        self.members
    }

    /// Pointer of one of its fields.
    pub(super) fn pointer_to(&self, key: &str) -> String {
        format!("{}/{}", self.pointer, escaped(key))
    }

    /// Refuses the keys that no reader asked for; call it after all of them.
    pub(super) fn refuse_unknown(&self) {
        let known = self.known.borrow();
        for (key, _) in self.members {
            if !known.contains(&key.as_str()) {
                let allowed = format!("one of: {}", known.join(", "));
                let pointer = self.pointer_to(key);
                let why = "is not a known field";
                self.report.refuse(&pointer, &allowed, None, why);
            }
        }
    }

    /// A field as a node, if it is there.
    pub(super) fn member(&self, key: &'static str) -> Option<&'a Node> {
        let mut known = self.known.borrow_mut();
        if !known.contains(&key) {
            known.push(key);
        }
        let found = self.members.iter().find(|(name, _)| name == key);
        found.map(|(_, node)| node)
    }

    /// True if a field is there.
    pub(super) fn has(&self, key: &str) -> bool {
        self.members.iter().any(|(name, _)| name == key)
    }

    /// A field that must be there.
    pub(super) fn required(&self, key: &'static str, allowed: &str) -> Option<&'a Node> {
        let found = self.member(key);
        if found.is_none() {
            self.missing(key, allowed, None);
        }
        found
    }

    fn missing(&self, key: &str, allowed: &str, unit: Option<&str>) {
        let why = "is missing, and has no default";
        self.report
            .refuse(&self.pointer_to(key), allowed, unit, why);
    }

    /// An object whose fields all have defaults, so that it may be left out.
    pub(super) fn defaulted(&self, key: &'static str) -> Option<Object<'a>> {
        const NOTHING: &Node = &Node::Object(Vec::new());
        let node = self.member(key).unwrap_or(NOTHING);
        self.object(node, key)
    }

    /// A number, by its rule's default or required.
    pub(super) fn number(&self, rule: &Rule) -> Option<f64> {
        match (self.member(rule.key), rule.default) {
            (Some(node), _) => self.check(node, &self.pointer_to(rule.key), rule),
            (None, Some(default)) => Some(default),
            (None, None) => {
                self.missing(rule.key, &rule.range.words(), rule.unit);
                None
            }
        }
    }

    /// A number whose default comes from other fields (`None`: from fields that
    /// were refused themselves).
    pub(super) fn number_or(&self, rule: &Rule, default: Option<f64>) -> Option<f64> {
        match self.member(rule.key) {
            Some(node) => self.check(node, &self.pointer_to(rule.key), rule),
            None => default,
        }
    }

    /// A number, or null (also if left out) for "automatic".
    pub(super) fn automatic(&self, rule: &Rule) -> Option<Option<f64>> {
        match self.member(rule.key) {
            None | Some(Node::Null) => Some(None),
            Some(node) => self.check(node, &self.pointer_to(rule.key), rule).map(Some),
        }
    }

    /// A whole number.
    pub(super) fn count(&self, rule: &Rule) -> Option<u32> {
        let number = self.number(rule)?;
        self.whole(number, rule)
    }

    /// A whole number, or null for "automatic".
    pub(super) fn automatic_count(&self, rule: &Rule) -> Option<Option<u32>> {
        match self.automatic(rule)? {
            None => Some(None),
            Some(number) => self.whole(number, rule).map(Some),
        }
    }

    fn whole(&self, number: f64, rule: &Rule) -> Option<u32> {
        if number.fract() == 0.0 {
            // The rules of whole numbers end far below 2^32.
            return Some(number as u32);
        }
        let allowed = format!("{}, whole", rule.range.words());
        let pointer = self.pointer_to(rule.key);
        let why = format!("is {}, not a whole number", short(number));
        self.report.refuse(&pointer, &allowed, rule.unit, &why);
        None
    }

    /// A truth value.
    pub(super) fn flag(&self, key: &'static str, default: bool) -> Option<bool> {
        match self.member(key) {
            None => Some(default),
            Some(Node::Bool(flag)) => Some(*flag),
            Some(_) => {
                let why = "must be true or false";
                let pointer = self.pointer_to(key);
                self.report.refuse(&pointer, "true or false", None, why);
                None
            }
        }
    }

    /// One of a few words, each with its value.
    pub(super) fn choice<T: Copy>(
        &self,
        key: &'static str,
        choices: &[(&str, T)],
        default: Option<T>,
    ) -> Option<T> {
        let Some(node) = self.member(key) else {
            if default.is_none() {
                self.missing(key, &choice_words(choices), None);
            }
            return default;
        };
        self.chosen(node, key, choices)
    }

    /// One of a few words, or null (also if left out).
    pub(super) fn choice_or_null<T: Copy>(
        &self,
        key: &'static str,
        choices: &[(&str, T)],
    ) -> Option<Option<T>> {
        match self.member(key) {
            None | Some(Node::Null) => Some(None),
            Some(node) => self.chosen(node, key, choices).map(Some),
        }
    }

    fn chosen<T: Copy>(&self, node: &Node, key: &str, choices: &[(&str, T)]) -> Option<T> {
        let allowed = choice_words(choices);
        let why = match node {
            Node::Text(text) => match choices.iter().find(|(word, _)| word == text) {
                Some((_, meaning)) => return Some(*meaning),
                None => format!("is {}, not {allowed}", node.excerpt()),
            },
            _ => format!("must be {allowed}"),
        };
        self.report
            .refuse(&self.pointer_to(key), &allowed, None, &why);
        None
    }

    /// A list of N numbers, each under the rule.
    pub(super) fn vector<const N: usize>(&self, rule: &Rule) -> Option<[f64; N]> {
        match (self.member(rule.key), rule.default) {
            (Some(node), _) => self.elements(node, &self.pointer_to(rule.key), rule),
            (None, Some(default)) => Some([default; N]),
            (None, None) => {
                self.missing(rule.key, &list_words::<N>(&rule.range), rule.unit);
                None
            }
        }
    }

    /// A list of N numbers, or null (also if left out).
    pub(super) fn automatic_vector<const N: usize>(&self, rule: &Rule) -> Option<Option<[f64; N]>> {
        match self.member(rule.key) {
            None | Some(Node::Null) => Some(None),
            Some(node) => {
                let pointer = self.pointer_to(rule.key);
                self.elements(node, &pointer, rule).map(Some)
            }
        }
    }

    /// A list of so many lists of N numbers, each under the rule.
    pub(super) fn vectors<const N: usize>(
        &self,
        rule: &Rule,
        several: &Several,
    ) -> Option<Vec<[f64; N]>> {
        let words = list_words::<N>(&rule.range);
        if let Some(Node::List(items)) = self.member(rule.key)
            && !items.is_empty()
            && items.iter().all(|item| matches!(item, Node::Number(_)))
        {
            let (one, numbers) = (several.nouns[0], items.len());
            let s = if numbers == 1 { "" } else { "s" };
            let why = format!("is a list of {numbers} number{s}, not of lists, one a {one}");
            let allowed = format!("{}, each {words}", several.words());
            let pointer = self.pointer_to(rule.key);
            self.report.refuse(&pointer, &allowed, rule.unit, &why);
            return None;
        }
        let read = |item: &Node, pointer: &str| self.elements(item, pointer, rule);
        self.list(rule, several, &words, read)
    }

    /// A list of so many numbers, each under the rule.
    pub(super) fn numbers(&self, rule: &Rule, several: &Several) -> Option<Vec<f64>> {
        let read = |item: &Node, pointer: &str| self.check(item, pointer, rule);
        self.list(rule, several, &rule.range.words(), read)
    }

    /// A list of so many entries; `each` describes a valid one.
    fn list<T>(
        &self,
        rule: &Rule,
        several: &Several,
        each: &str,
        read: impl Fn(&Node, &str) -> Option<T>,
    ) -> Option<Vec<T>> {
        let allowed = format!("{}, each {each}", several.words());
        let pointer = self.pointer_to(rule.key);
        let why = match self.member(rule.key) {
            Some(Node::List(items)) if several.count.contains(&items.len()) => {
                let entry =
                    |(index, item): (usize, &Node)| read(item, &format!("{pointer}/{index}"));
                let entries: Vec<_> = items.iter().enumerate().map(entry).collect();
                return entries.into_iter().collect();
            }
            Some(Node::List(items)) => {
                format!(
                    "has {}, not {}",
                    several.counted(items.len()),
                    several.words()
                )
            }
            Some(_) => format!("must be a list of {}", several.nouns[1]),
            None => "is missing, and has no default".to_owned(),
        };
        self.report.refuse(&pointer, &allowed, rule.unit, &why);
        None
    }

    fn elements<const N: usize>(
        &self,
        node: &Node,
        pointer: &str,
        rule: &Rule,
    ) -> Option<[f64; N]> {
        let items = match node {
            Node::List(items) if items.len() == N => items,
            _ => {
                let allowed = list_words::<N>(&rule.range);
                let why = format!("must be a list of {N} numbers");
                self.report.refuse(pointer, &allowed, rule.unit, &why);
                return None;
            }
        };
        let numbers: Vec<Option<f64>> = items
            .iter()
            .enumerate()
            .map(|(index, item)| self.check(item, &format!("{pointer}/{index}"), rule))
            .collect();
        let numbers: Vec<f64> = numbers.into_iter().collect::<Option<_>>()?;
        numbers.try_into().ok()
    }

    fn check(&self, node: &Node, pointer: &str, rule: &Rule) -> Option<f64> {
        let words = rule.range.words();
        let number = match node {
            Node::Number(number) => number.as_f64(),
            _ => None,
        };
        let why = match number {
            // Adding zero turns −0 into 0.
            Some(number) if rule.range.contains(number) => return Some(number + 0.0),
            Some(number) => format!("is {}, outside {words}", short(number)),
            None => format!("must be a number with {words}"),
        };
        self.report.refuse(pointer, &words, rule.unit, &why);
        None
    }
}

/// `"this" or "that"`.
pub(super) fn choice_words<T>(choices: &[(&str, T)]) -> String {
    let words: Vec<String> = choices
        .iter()
        .map(|(word, _)| format!("\"{word}\""))
        .collect();
    words.join(" or ")
}

fn list_words<const N: usize>(range: &Range) -> String {
    format!("a list of {N} numbers, each {}", range.words())
}
