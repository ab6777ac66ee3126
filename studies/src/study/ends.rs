//! Scenarios at the ends of the inputs.

use super::Ensemble;
use crate::design::Design;
use serde_json::Value;

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
    /// Scenarios for validation before the first run: each end of each input's distribution with
    /// all other inputs at their medians. An explicit design has for each input the members with
    /// its smallest and largest number, and the first member with each value that is no number.
    pub fn end_scenarios(&self) -> Vec<EndScenario> {
        match &self.study().design {
            Design::Explicit(explicit) => self.explicit_ends(&explicit.members),
            _ => self.distribution_ends(),
        }
    }

    fn distribution_ends(&self) -> Vec<EndScenario> {
        let medians = self.quantiles(&vec![0.5; self.inputs()]);
        let inputs = self.study().inputs.iter().enumerate();
        let ends = inputs.flat_map(|(input, given)| {
            let ends = given.distribution.iter().flat_map(|one| one.ends());
            ends.map(move |value| (input, value))
        });
        ends.map(|(input, value)| {
            let mut values = medians.clone();
            values[input] = value;
            self.end(input, &values)
        })
        .collect()
    }

    fn explicit_ends(&self, members: &[Vec<Value>]) -> Vec<EndScenario> {
        let inputs = 0..self.inputs();
        let ends = inputs.flat_map(|input| {
            let ends = extreme_members(members, input).into_iter();
            ends.map(move |values| (input, values))
        });
        ends.map(|(input, values)| self.end(input, values))
            .collect()
    }

    fn end(&self, input: usize, values: &[Value]) -> EndScenario {
        EndScenario {
            input,
            value: values[input].clone(),
            scenario: self.scenario_of(values.to_vec()),
        }
    }
}

/// Members with the extreme values of an input.
fn extreme_members(members: &[Vec<Value>], input: usize) -> Vec<&Vec<Value>> {
    let number = |member: &&Vec<Value>| member[input].as_f64();
    let numbers = || members.iter().filter(|member| number(member).is_some());
    let compared = |one: &&Vec<Value>, other: &&Vec<Value>| {
        let (one, other) = (number(one), number(other));
        one.partial_cmp(&other).unwrap_or(std::cmp::Ordering::Equal)
    };
    let ends = [numbers().min_by(compared), numbers().max_by(compared)];
    let mut found: Vec<&Vec<Value>> = Vec::new();
    let others = members.iter().filter(|member| number(member).is_none());
    for member in ends.into_iter().flatten().chain(others) {
        if found.iter().all(|one| one[input] != member[input]) {
            found.push(member);
        }
    }
    found
}
