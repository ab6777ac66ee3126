//! Members that are given.

use crate::study::Violation;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// Values of every member, given one by one; for probabilities they are equally likely draws.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = ExplicitDesign))]
#[serde(deny_unknown_fields)]
pub struct Explicit {
    /// Members, each with a value for each input in the order of the inputs.
    pub members: Vec<Vec<Value>>,
}

impl Explicit {
    pub(super) fn violations(&self, inputs: usize) -> Vec<Violation> {
        if self.members.is_empty() {
            let message = "members is empty, allowed: at least one member";
            return vec![Violation::new("/members", message)];
        }
        let wrong = |(place, values): (usize, &Vec<Value>)| {
            let message = format!(
                "members[{place}] has {} values, allowed: {inputs}, one for each input",
                values.len()
            );
            let pointer = format!("/members/{place}");
            (values.len() != inputs).then(|| Violation::new(&pointer, message))
        };
        self.members.iter().enumerate().filter_map(wrong).collect()
    }
}
