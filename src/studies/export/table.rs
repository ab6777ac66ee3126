//! Members of a study as a table: a row for each, with its inputs and the quantities of its outcome.

use crate::results::numpy;
use crate::results::zip::{Method, ZipWriter};
use scree_studies::{Ensemble, Finished, Member, MemberBody, MemberOutcome};
use serde_json::Value;
use std::cmp::Reverse;
use std::collections::BTreeSet;

/// Members with their inputs and quantities.
#[derive(Debug, Clone, PartialEq)]
pub struct MemberTable {
    /// Levels of the members.
    pub levels: Vec<u32>,
    /// Numbers of the members, those of a level in order.
    pub members: Vec<u64>,
    /// JSON pointers of the inputs.
    pub inputs: Vec<String>,
    /// Values of the inputs, for each member.
    pub values: Vec<Vec<Value>>,
    /// Reason of the failure of each member that failed.
    pub failures: Vec<Option<String>>,
    /// Names of the quantities: those of the run, then of each body, as `body0.displacement_m`.
    pub quantities: Vec<String>,
    /// Values of the quantities, for each member; none of what did not happen.
    pub results: Vec<Vec<Option<f64>>>,
}

impl MemberTable {
    /// Table of the members that have an outcome, on every level that they are on.
    pub fn of(ensemble: &Ensemble, members: &[Member]) -> Self {
        let mut ended = ended(ensemble, members);
        ended.sort_by_key(|member| member.id());
        Self::of_ended(ensemble, &ended)
    }

    /// Table of the members that have an outcome, each on its finest level alone.
    pub fn on_finest(ensemble: &Ensemble, members: &[Member]) -> Self {
        let mut ended = ended(ensemble, members);
        ended.sort_by_key(|member| (member.index, Reverse(member.level)));
        ended.dedup_by_key(|member| member.index);
        Self::of_ended(ensemble, &ended)
    }

    fn of_ended(ensemble: &Ensemble, ended: &[&Member]) -> Self {
        let quantities = names(ended);
        let result = |member: &&Member| {
            let finished = member.finished();
            let value = |name: &String| finished.and_then(|finished| quantity(finished, name));
            quantities.iter().map(value).collect()
        };
        let values = |member: &&Member| ensemble.values(member.index).unwrap_or_default();
        let failure = |member: &&Member| match &member.outcome {
            MemberOutcome::Failed(failed) => Some(failed.reason.clone()),
            MemberOutcome::Finished(_) | MemberOutcome::Pending => None,
        };
        let inputs = ensemble.study().inputs.iter();
        Self {
            levels: ended.iter().map(|member| member.level).collect(),
            members: ended.iter().map(|member| member.index).collect(),
            inputs: inputs.map(|input| input.pointer.clone()).collect(),
            values: ended.iter().map(values).collect(),
            failures: ended.iter().map(failure).collect(),
            results: ended.iter().map(result).collect(),
            quantities,
        }
    }

    /// Values of an input, NaN where it is no number.
    pub fn input(&self, place: usize) -> Vec<f64> {
        let value = |row: &Vec<Value>| row.get(place).and_then(Value::as_f64);
        let values = self.values.iter().map(value);
        values.map(|value| value.unwrap_or(f64::NAN)).collect()
    }

    /// Values of a quantity, NaN where it did not happen.
    pub fn quantity(&self, place: usize) -> Vec<f64> {
        let values = self.results.iter().map(|row| row[place]);
        values.map(|value| value.unwrap_or(f64::NAN)).collect()
    }
}

/// Members of a study that have an outcome.
fn ended<'a>(ensemble: &Ensemble, members: &'a [Member]) -> Vec<&'a Member> {
    let study = ensemble.study();
    let ended = members
        .iter()
        .filter(|member| member.index < study.members_on(member.level))
        .filter(|member| member.outcome != MemberOutcome::Pending);
    ended.collect()
}

/// Names of all quantities that any member has.
fn names(members: &[&Member]) -> Vec<String> {
    let finished = || members.iter().filter_map(|member| member.finished());
    let of_run: BTreeSet<&String> = finished().flat_map(|one| one.quantities.keys()).collect();
    let mut names: Vec<String> = of_run.into_iter().cloned().collect();
    let bodies = finished().map(|one| one.bodies.len()).max().unwrap_or(0);
    for body in 0..bodies {
        let of_body = finished().filter_map(|one| one.bodies.get(body));
        let further: BTreeSet<&String> = of_body.flat_map(|one| one.quantities.keys()).collect();
        let all = MemberBody::OWN_QUANTITIES
            .into_iter()
            .chain(further.into_iter().map(String::as_str));
        names.extend(all.map(|name| format!("body{body}.{name}")));
    }
    names
}

fn quantity(finished: &Finished, name: &str) -> Option<f64> {
    let of_body = name
        .strip_prefix("body")
        .and_then(|rest| rest.split_once('.'));
    let Some((body, name)) = of_body else {
        return finished.quantity(name, None);
    };
    finished
        .bodies
        .get(body.parse::<usize>().ok()?)?
        .quantity(name)
}

/// The table as CSV (RFC 4180): `level`, `member`, the inputs by their pointers, `failure`, the quantities;
/// an empty field for what did not happen.
pub fn members_as_csv(table: &MemberTable) -> String {
    let names = ["level", "member"].into_iter();
    let names = names.chain(table.inputs.iter().map(String::as_str));
    let names = names.chain(["failure"]);
    let names = names.chain(table.quantities.iter().map(String::as_str));
    let mut text = line(names.map(field));
    for (row, member) in table.members.iter().enumerate() {
        let inputs = table.values[row].iter().map(|value| match value {
            Value::String(text) => field(text),
            value => field(&value.to_string()),
        });
        let failure = field(table.failures[row].as_deref().unwrap_or_default());
        let results = table.results[row].iter();
        let results = results.map(|value| value.map_or(String::new(), |value| value.to_string()));
        let name = [table.levels[row].to_string(), member.to_string()];
        let fields = name.into_iter().chain(inputs);
        text.push_str(&line(fields.chain([failure]).chain(results)));
    }
    text
}

fn line(fields: impl Iterator<Item = String>) -> String {
    let mut line = fields.collect::<Vec<_>>().join(",");
    line.push_str("\r\n");
    line
}

/// A field, quoted if it must be.
fn field(text: &str) -> String {
    if text.contains([',', '"', '\r', '\n']) {
        return format!("\"{}\"", text.replace('"', "\"\""));
    }
    text.to_owned()
}

/// The numbers of the table as NPZ: an array of 64-bit floats for each column, NaN where there is
/// no number; slashes of pointers are dots in the names.
pub fn members_as_npz(table: &MemberTable) -> Vec<u8> {
    let levels = table.levels.iter().map(|level| f64::from(*level));
    let numbers = table.members.iter().map(|number| *number as f64);
    let mut columns = vec![
        ("level".to_owned(), levels.collect::<Vec<f64>>()),
        ("member".to_owned(), numbers.collect()),
    ];
    let named = |pointer: &str| pointer.trim_start_matches('/').replace('/', ".");
    for (place, pointer) in table.inputs.iter().enumerate() {
        columns.push((named(pointer), table.input(place)));
    }
    for (place, name) in table.quantities.iter().enumerate() {
        columns.push((name.clone(), table.quantity(place)));
    }
    let (mut archive, mut out) = (ZipWriter::default(), Vec::new());
    for (name, values) in columns {
        let array = numpy::array(&values);
        archive.file(&format!("{name}.npy"), Method::Stored, &array, &mut out);
    }
    archive.finish(&mut out);
    out
}
