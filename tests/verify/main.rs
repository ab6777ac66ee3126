//! The quick cases of `scree verify`, by their own bars and orders. A case with a
//! known miss is asked for what holds. Figures are in the command's own tables.

use scree::verify::findings::{Finding, Verdict};
use scree::verify::{Case, Effort, Verified, cases, verify};
use std::collections::BTreeSet;

fn verified(name: &str) -> Verified {
    let case = cases::ALL.iter().find(|case: &&Case| case.name == name);
    verify(case.expect("there is such a case"), Effort::Quick)
}

/// Runs a case of which nothing may be missed.
fn holds(name: &str) {
    let found = verified(name).found;
    let missed = |finding: &&Finding| finding.verdict == Verdict::Miss;
    let missed: Vec<&Finding> = found.values.iter().filter(missed).collect();
    assert!(missed.is_empty(), "{missed:#?}");
    for order in &found.orders {
        assert_ne!(order.verdict, Verdict::Miss, "{order:#?}");
    }
    assert!(found.count().passed > 0, "{name} asks for nothing");
}

#[test]
fn every_case_has_a_name_of_its_own() {
    let names: BTreeSet<&str> = cases::ALL.iter().map(|case| case.name).collect();
    assert_eq!(names.len(), cases::ALL.len());
}

#[test]
fn free_fall() {
    holds("free-fall");
}

#[test]
fn rigid_rotation() {
    holds("rigid-rotation");
}

#[test]
fn mass() {
    holds("mass");
}

#[test]
fn hertz_impact() {
    holds("hertz-impact");
}

#[test]
fn torque_free() {
    holds("torque-free");
}

#[test]
fn cube_on_incline() {
    holds("cube-on-incline");
}

#[test]
fn elastic_bar() {
    holds("elastic-bar");
}

#[test]
fn sliding_block() {
    holds("sliding-block");
}

#[test]
fn momentum_audit() {
    holds("momentum-audit");
}

// Known miss: on a face a cube rebounds too low. It never rebounds too high.
#[test]
fn restitution() {
    for finding in verified("restitution").found.values {
        let (got, asked) = (finding.measured.unwrap(), finding.question.oracle);
        if finding.question.quantity.contains("vertex") {
            assert_eq!(finding.verdict, Verdict::Pass, "{finding:#?}");
        } else {
            assert!(got < 1.001 * asked && got > 0.85 * asked, "{finding:#?}");
        }
    }
}

// Known miss: the lowest cell, and with it the profile, converges with order ½.
#[test]
fn hydrostatic() {
    let found = verified("hydrostatic").found;
    for precision in ["double", "single"] {
        for profile in ["σ_zz off, L2", "σ_zz off above two cells, L2"] {
            let quantity = format!("{profile}, {precision}");
            let errors: Vec<f64> = found
                .of(&quantity)
                .map(|finding| finding.measured_error.unwrap())
                .collect();
            assert!(errors.len() >= 3);
            assert!(
                errors.is_sorted_by(|coarse, fine| coarse > fine),
                "{errors:?}"
            );
            assert!(errors[0] < 0.06);
        }
        for finding in found.of(&format!("weight the floor carries, {precision}")) {
            assert_eq!(finding.verdict, Verdict::Pass);
        }
    }
}
