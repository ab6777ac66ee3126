//! Arbitrary bytes as a scenario: it is read and written back the same, or every violation
//! has a message.

#![no_main]

use libfuzzer_sys::fuzz_target;
use scree_solver::scenario::{Scenario, ScenarioError};

fuzz_target!(|bytes: &[u8]| {
    let Ok(text) = std::str::from_utf8(bytes) else {
        return;
    };
    match Scenario::from_json(text) {
        Ok(scenario) => {
            let again = Scenario::from_json(&scenario.to_json());
            assert_eq!(again, Ok(scenario));
        }
        Err(ScenarioError::Invalid(violations)) => {
            assert!(!violations.is_empty());
            for violation in violations {
                assert!(!violation.allowed.is_empty() && !violation.detail.is_empty());
            }
        }
        Err(ScenarioError::Malformed { .. }) => {}
    }
});
