//! The quick cases of `scree verify`, by their own tolerances and orders. A case with a
//! known failure is tested for the parts that hold. Figures are in the command's own tables.

use scree::verify::findings::{Finding, Verdict};
use scree::verify::robustness::randomised::{self, Field, randomised};
use scree::verify::{Case, Effort, Verified, cases, robustness, verify};
use std::collections::BTreeSet;

fn verified(name: &str) -> Verified {
    let case = cases::ALL.iter().find(|case: &&Case| case.name == name);
    verify(case.expect("there is such a case"), Effort::Quick)
}

/// Runs a case that must have no failures.
fn holds(name: &str) {
    let found = verified(name).found;
    let failed = |finding: &&Finding| finding.verdict == Verdict::Fail;
    let failed: Vec<&Finding> = found.values.iter().filter(failed).collect();
    assert!(failed.is_empty(), "{failed:#?}");
    for order in &found.orders {
        assert_ne!(order.verdict, Verdict::Fail, "{order:#?}");
    }
    assert!(found.count().passed > 0, "{name} asks for nothing");
}

/// Runs families of robustness tests; all must be valid.
fn valid(families: &[&str]) {
    for family in robustness::cases::ALL {
        if families.contains(&family.name) {
            for tried in robustness::try_family(family, Effort::Quick, false) {
                assert!(tried.is_valid(), "{tried:#?}");
            }
        }
    }
}

#[test]
fn hard_slopes_and_sizes() {
    valid(&["inclination", "size of the cube", "density of the cube"]);
}

#[test]
fn hard_places() {
    valid(&["place of the cube", "cubes on cubes"]);
}

#[test]
fn hard_limits_and_restart() {
    valid(&["limits", "restart", "far away", "dust"]);
}

// Some hundred consecutive scenarios, and two runs of the same one.
#[test]
fn a_sweep_is_sound() {
    let field = Field::Everything;
    let report = randomised(field, 1_000_000, 60, &|_| {});
    assert_eq!(report.run, 60);
    assert!(report.failures.is_empty(), "{:#?}", report.failures);
    assert_eq!(
        randomised::scenario(field, 7),
        randomised::scenario(field, 7)
    );
}

// Bodies of all shapes, frictions and restitutions in contact with each other.
#[test]
fn contacts_of_bodies_make_no_energy() {
    let report = randomised(Field::BodiesAlone, 1_000_000, 40, &|_| {});
    assert_eq!(report.run, 40);
    assert!(report.failures.is_empty(), "{:#?}", report.failures);
}

// Scenarios of randomised tests that once failed: a deposit at the slope break was lifted out of it
// (decision
// 18); points a quarter of a cell behind the floor kept their speed (decision 19); a body
// approached a wall in the middle of a step, or touched it before it had any speed.
#[test]
fn what_randomised_tests_found_stays_mended() {
    for seed in [224, 447, 471, 2770, 3040, 2430, 3797, 2735, 3733] {
        let (scenario, _) =
            randomised::scenario(Field::Everything, seed).expect("the seed has a scenario");
        let tried = randomised::run(Field::Everything, &scenario);
        assert!(tried.is_valid(), "seed {seed}: {tried:#?}");
    }
}

#[test]
fn every_case_has_a_name_of_its_own() {
    let names = cases::ALL.iter().map(|case| case.name);
    let names = names.chain(robustness::cases::ALL.iter().map(|family| family.name));
    let names: BTreeSet<&str> = names.collect();
    assert_eq!(names.len(), cases::ALL.len() + robustness::cases::ALL.len());
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

// The more sides, the smaller the loss; over this distance six sides have not yet lost as much as
// eight.
#[test]
fn rolling_prisms() {
    holds("rolling-prisms");
    let found = verified("rolling-prisms").found;
    let taken: Vec<f64> = found
        .of("taken by contacts, over what gravity gave")
        .map(|finding| finding.measured.expect("it was measured"))
        .collect();
    assert!(
        taken.len() == 4 && taken[1..].is_sorted_by(|few, many| few > many),
        "{taken:?}"
    );
}

#[test]
fn elastic_bar() {
    holds("elastic-bar");
}

// Known failure: close to its angle of friction, 11.3°, the block creeps.
#[test]
fn sliding_block() {
    let found = verified("sliding-block").found;
    for finding in found.values {
        if finding
            .question
            .quantity
            .starts_with("acceleration at 10°, granular")
        {
            let error = finding.measured_error.expect("it was measured");
            assert!(error.abs() < 0.03, "{finding:#?}");
        } else {
            assert_ne!(finding.verdict, Verdict::Fail, "{finding:#?}");
        }
    }
}

#[test]
fn momentum_audit() {
    holds("momentum-audit");
}

#[test]
fn restitution() {
    holds("restitution");
}

#[test]
fn feature_contacts() {
    holds("feature-contacts");
}

// Known failure: the uppermost cell reduces the order of the whole profile.
#[test]
fn hydrostatic() {
    let found = verified("hydrostatic").found;
    for precision in ["double", "single"] {
        for profile in ["σ_zz off, L2", "σ_zz off by whole cells, L2"] {
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
            assert!(errors[0] < 0.01);
        }
        for finding in found.of(&format!("weight the floor carries, {precision}")) {
            assert_eq!(finding.verdict, Verdict::Pass);
        }
    }
}

// Sand comes to rest at the measured run-out. Beads flow farther, from a = 1 on beyond the
// measured range, like the published μ(I) continuum (4.40 at a = 2). Taller columns
// run farther, and a column with a friction of 2 stays short.
#[test]
fn column_collapse() {
    let found = verified("column-collapse").found;
    for grains in ["sand", "beads"] {
        let runouts = [0.5, 1.0, 2.0, 4.0].map(|a| {
            let quantity = format!("run-out, {grains}, a = {a}");
            let last = found.of(&quantity).last().unwrap();
            if grains == "sand" {
                assert_ne!(last.verdict, Verdict::Fail, "{last:#?}");
            }
            last.measured.unwrap()
        });
        assert!(runouts.is_sorted(), "{runouts:?}");
        if grains == "beads" {
            assert!((0.6..0.9).contains(&runouts[0]), "{runouts:?}");
            assert!((runouts[2] / 4.4 - 1.0).abs() < 0.15, "{runouts:?}");
        }
    }
    let control = found.of("control is outside the band (1: yes)").next();
    assert_eq!(control.unwrap().measured, Some(1.0));
}

// Without tolerances: at eight cells within a third, below the law because the thin end needs
// more cells.
#[test]
fn axisymmetric_collapse() {
    let found = verified("axisymmetric-collapse").found;
    for a in [1.0, 2.0] {
        for finding in found.of(&format!("run-out, sand, a = {a}")) {
            assert!(finding.measured_error.unwrap().abs() < 0.33, "{finding:#?}");
        }
    }
}

// Known failure: the speed of the undisturbed part, a small difference between slope
// and friction.
#[test]
fn dam_break() {
    let found = verified("dam-break").found;
    for finding in found.of("speed of the undisturbed part") {
        assert!(finding.measured_error.unwrap().abs() < 0.15, "{finding:#?}");
    }
    for finding in found.of("profile off, root mean square") {
        assert!(finding.measured_error.unwrap() < 0.15, "{finding:#?}");
    }
}

// Known failure: at four cells per diameter a light sphere stays too high.
#[test]
fn sphere_into_bed() {
    for finding in verified("sphere-into-bed").found.values {
        let error = finding.measured_error.unwrap();
        assert!(error.abs() < 0.6, "{finding:#?}");
        if finding.question.quantity == "exponent of diameter" {
            assert_eq!(finding.verdict, Verdict::Pass, "{finding:#?}");
        }
    }
}

// All six cubes are moved.
#[test]
fn cubes_and_column() {
    let found = verified("cubes-and-column").found;
    let failed = |finding: &Finding| finding.verdict == Verdict::Fail;
    assert!(!found.values.iter().any(failed), "{:#?}", found.values);
    let driven: Vec<_> = found
        .of("cubes driven on by a tenth of a side")
        .map(|finding| finding.measured)
        .collect();
    assert_eq!(driven, [Some(6.0); 2]);
}

// Known failures: effect of the step of the flow on the peak.
#[test]
fn source_paper() {
    let found = verified("source-paper").found;
    let near = |quantity: &str, tolerance: f64| {
        for finding in found.of(quantity) {
            let error = finding.measured_error.expect("it was measured");
            assert!(error.abs() < tolerance, "{finding:#?}");
        }
    };
    near("onset, against the paper", 0.1);
    near("peak speed, against the paper", 0.5);
    near("peak speed, courant ×½", 0.05);
}

// Known failure: at ten cells the layer is 3 % too thick.
#[test]
fn bagnold() {
    for finding in verified("bagnold").found.values {
        let thickness = finding.question.quantity.contains("mass centre");
        if thickness && finding.resolution.label == "10 cells" {
            let error = finding.measured_error.expect("it was measured");
            assert!(error.abs() < 0.04, "{finding:#?}");
        } else {
            assert_ne!(finding.verdict, Verdict::Fail, "{finding:#?}");
        }
    }
}

// Known failure: at ten cells a longer step of the flow makes it faster.
#[test]
fn two_clocks() {
    for finding in verified("two-clocks").found.values {
        let error = finding.measured_error.expect("it was measured");
        let tolerance = if finding.question.quantity.contains("flow_courant ×2") {
            0.2
        } else {
            0.03
        };
        assert!(error.abs() < tolerance, "{finding:#?}");
    }
}

// Without tolerances: the apparent enlargement of a cube stays within a cell.
#[test]
fn cube_in_dust_and_in_a_liquid() {
    for name in ["dust-stream", "buried-body"] {
        for finding in verified(name).found.values {
            let value = finding.measured.expect("it was measured");
            if finding.question.quantity.starts_with("s") {
                assert!(value.abs() < 1.0, "{finding:#?}");
            }
        }
    }
}

// Without tolerances: a drag, which decreases with finer cells.
#[test]
fn plate_drag() {
    let found = verified("plate-drag").found;
    let drags: Vec<f64> = found
        .of("drag over ρ v² A, 2–4 sides")
        .map(|finding| finding.measured.expect("it was measured"))
        .collect();
    assert!(
        drags.is_sorted_by(|coarse, fine| coarse > fine),
        "{drags:?}"
    );
    assert!(drags.iter().all(|drag| *drag > 0.5), "{drags:?}");
}

#[test]
fn wall_bore() {
    holds("wall-bore");
}

// Known failures: in a bed of higher friction a plate meets more resistance, but too little.
#[test]
fn plates_moved_through_a_bed() {
    for (name, grows_by) in [("dragged-plate", 1.4), ("pressed-plate", 2.5)] {
        let found = verified(name).found;
        let measured = found.values.iter().map(|finding| {
            let error = finding.measured_error.expect("it was measured");
            assert!((-0.65..0.1).contains(&error), "{finding:#?}");
            finding.measured.expect("it was measured")
        });
        let forces: Vec<f64> = measured.collect();
        assert!(forces[1] > grows_by * forces[0], "{name}: {forces:?}");
    }
}

// Its tolerances are those of the full version; the small one has to answer every question.
#[test]
fn coarse_cells() {
    let found = verified("coarse-cells").found;
    assert!(!found.values.is_empty());
    for finding in &found.values {
        let measured = finding.measured.expect("both phases were computed");
        assert!(measured.is_finite(), "{finding:#?}");
    }
}
