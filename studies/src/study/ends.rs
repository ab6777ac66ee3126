//! Scenarios at the ends of the inputs.

use super::Ensemble;
use crate::design::Design;
use serde_json::Value;

/// Extreme value of an input.
#[derive(Debug, Clone, PartialEq)]
pub struct End {
    /// Index of the input.
    pub input: usize,
    /// Its value.
    pub value: Value,
    /// Member of an explicit design that has it.
    member: Option<usize>,
    /// Level of the scenario.
    level: u32,
}

/// Scenario with one input at an extreme value.
#[derive(Debug, Clone, PartialEq)]
pub struct EndScenario {
    /// Index of the input.
    pub input: usize,
    /// Its value.
    pub value: Value,
    /// The scenario.
    pub scenario: Value,
}

impl Ensemble<'_> {
    /// Ends of the inputs, for validation before the first run: those of each input's distribution.
    /// An explicit design has for each input the members with its smallest and largest number, and
    /// the first member with each value that is no number. Ends come on the coarsest level and on the
    /// finest.
    pub fn ends(&self) -> Vec<End> {
        let ends = match &self.study().design {
            Design::Explicit(explicit) => explicit_ends(&explicit.members, self.inputs()),
            _ => self.distribution_ends(),
        };
        let level = self.study().levels() - 1;
        let on_finest = ends.iter().filter(|_| level > 0).map(|end| End {
            level,
            ..end.clone()
        });
        let on_finest: Vec<End> = on_finest.collect();
        ends.into_iter().chain(on_finest).collect()
    }

    /// Scenario at an end of an input: with all other inputs at their medians, or as the member of
    /// an explicit design has it.
    pub fn end_scenario(&self, end: &End) -> Value {
        let values = match (&self.study().design, end.member) {
            (Design::Explicit(explicit), Some(member)) => explicit.members[member].clone(),
            _ => {
                let mut values = self.quantiles(&vec![0.5; self.inputs()]);
                values[end.input] = end.value.clone();
                values
            }
        };
        self.on_level(end.level, self.scenario_of(values))
    }

    /// Scenarios at all ends, one at a time.
    pub fn end_scenarios(&self) -> impl Iterator<Item = EndScenario> {
        self.ends().into_iter().map(|end| EndScenario {
            scenario: self.end_scenario(&end),
            input: end.input,
            value: end.value,
        })
    }

    fn distribution_ends(&self) -> Vec<End> {
        let inputs = self.study().inputs.iter().enumerate();
        let ends = inputs.flat_map(|(input, given)| {
            let ends = given.distribution.iter().flat_map(|one| one.ends());
            ends.map(move |value| End {
                input,
                value,
                member: None,
                level: 0,
            })
        });
        ends.collect()
    }
}

fn explicit_ends(members: &[Vec<Value>], inputs: usize) -> Vec<End> {
    let ends = (0..inputs).flat_map(|input| {
        let members = extreme_members(members, input).into_iter();
        members.map(move |(place, member)| End {
            input,
            value: member[input].clone(),
            member: Some(place),
            level: 0,
        })
    });
    ends.collect()
}

/// Members with the extreme values of an input, with their places.
fn extreme_members(members: &[Vec<Value>], input: usize) -> Vec<(usize, &Vec<Value>)> {
    let all = || members.iter().enumerate();
    let number = |member: &(usize, &Vec<Value>)| member.1[input].as_f64();
    let numbers = || all().filter(|member| number(member).is_some());
    let compared = |one: &(usize, &Vec<Value>), other: &(usize, &Vec<Value>)| {
        let (one, other) = (number(one), number(other));
        one.partial_cmp(&other).unwrap_or(std::cmp::Ordering::Equal)
    };
    let ends = [numbers().min_by(compared), numbers().max_by(compared)];
    let mut found: Vec<(usize, &Vec<Value>)> = Vec::new();
    let others = all().filter(|member| number(member).is_none());
    for member in ends.into_iter().flatten().chain(others) {
        if found.iter().all(|one| one.1[input] != member.1[input]) {
            found.push(member);
        }
    }
    found
}
