//! Violations by designs.

use super::assert_refused;
use serde_json::{Value, json};

/// Asserts that a design gives a violation among others.
fn assert_design(design: Value, pointer: &str, message: &str) {
    let changes = [
        ("/design", design),
        ("/stop", Value::Null),
        ("/questions", json!([])),
        ("/correlations", json!([])),
    ];
    assert_refused(&changes, &format!("/design{pointer}"), message);
}

#[test]
fn designs_that_allow_no_correlations() {
    let independent = "the indices of morris, saltelli and one_at_a_time need independent inputs, \
                       allowed: no correlations";
    let explicit = "correlations have no effect on an explicit design, allowed: to leave them out";
    let designs = [
        (
            json!({"morris": {"trajectories": 4, "levels": 4, "seed": 1}}),
            independent,
        ),
        (
            json!({"saltelli": {"base_members": 64, "seed": 1}}),
            independent,
        ),
        (json!({"one_at_a_time": {"levels": 3}}), independent),
        (
            json!({"explicit": {"members": [[0.4, 0.008, 0]]}}),
            explicit,
        ),
    ];
    for (design, message) in designs {
        let none = [("/stop", Value::Null), ("/questions", json!([]))];
        let changes = [("/design", design), none[0].clone(), none[1].clone()];
        assert_refused(&changes, "/correlations", message);
    }
}

#[test]
fn designs() {
    assert_design(
        json!({"sobol": {"members": 100, "seed": 1}}),
        "/sobol/members",
        "members is 100, allowed: a power of two, 2 <= x <= 1048576",
    );
    assert_design(
        json!({"sobol": {"members": 1, "seed": 1}}),
        "/sobol/members",
        "members is 1, allowed: a power of two, 2 <= x <= 1048576",
    );
    assert_design(
        json!({"saltelli": {"base_members": 3, "seed": 1}}),
        "/saltelli/base_members",
        "base_members is 3, allowed: a power of two, 2 <= x <= 1048576",
    );
    assert_design(
        json!({"saltelli": {"base_members": 524288, "seed": 1}}),
        "/saltelli",
        "the design has 2621440 members, allowed: at most 1048576",
    );
    assert_design(
        json!({"latin_hypercube": {"members": 1, "seed": 1}}),
        "/latin_hypercube/members",
        "members is 1, allowed: 2 <= x <= 1048576",
    );
    assert_design(
        json!({"full_factorial": {"levels": 0}}),
        "/full_factorial/levels",
        "levels is 0, allowed: 1 <= x <= 1048576",
    );
    assert_design(
        json!({"full_factorial": {"levels": [2, 2]}}),
        "/full_factorial/levels",
        "levels has 2 numbers, allowed: 3, one for each input",
    );
    assert_design(
        json!({"full_factorial": {"levels": [2, 0, 2]}}),
        "/full_factorial/levels/1",
        "levels[1] is 0, allowed: 1 <= x <= 1048576",
    );
    assert_design(
        json!({"full_factorial": {"levels": 1000}}),
        "/full_factorial",
        "the design has 1000000000 members, allowed: at most 1048576",
    );
    assert_design(
        json!({"morris": {"trajectories": 1, "levels": 4, "seed": 1}}),
        "/morris/trajectories",
        "trajectories is 1, allowed: 2 <= x <= 1048576",
    );
    assert_design(
        json!({"morris": {"trajectories": 4, "levels": 5, "seed": 1}}),
        "/morris/levels",
        "levels is 5, allowed: an even number, x >= 2",
    );
    assert_design(
        json!({"one_at_a_time": {"levels": 1}}),
        "/one_at_a_time/levels",
        "levels is 1, allowed: 2 <= x <= 1048576",
    );
    assert_design(
        json!({"explicit": {"members": []}}),
        "/explicit/members",
        "members is empty, allowed: at least one member",
    );
    assert_design(
        json!({"explicit": {"members": [[1, 2, 3], [1, 2]]}}),
        "/explicit/members/1",
        "members[1] has 2 values, allowed: 3, one for each input",
    );
}
