//! Stopping rules.

use scree_studies::{Progress, Stop, Verdict};

fn verdict(areas_m2: Vec<[f64; 2]>, members: u64, point_steps: f64) -> Verdict {
    let stop = Stop {
        region: 0.9,
        area_changes_less_than: 0.05,
        max_members: 1024,
        budget_point_steps: Some(1e12),
    };
    stop.verdict(&Progress {
        areas_m2,
        members,
        point_steps,
    })
}

#[test]
fn a_design_is_doubled_until_all_areas_settle() {
    assert_eq!(verdict(vec![], 256, 1e9), Verdict::Double);
    assert_eq!(verdict(vec![[1.0, 1.2]], 512, 1e9), Verdict::Double);
    assert_eq!(
        verdict(vec![[1.0, 0.97], [2.0, 2.3]], 512, 1e9),
        Verdict::Double
    );
    assert_eq!(
        verdict(vec![[1.0, 0.97], [2.0, 2.05]], 512, 1e9),
        Verdict::Settled
    );
}

#[test]
fn a_limit_ends_the_doubling() {
    assert_eq!(
        verdict(vec![[1.0, 1.2]], 1024, 1e9),
        Verdict::TooManyMembers
    );
    assert_eq!(verdict(vec![[1.0, 1.2]], 512, 6e11), Verdict::TooMuchWork);
    assert_eq!(verdict(vec![[1.0, 1.0]], 1024, 9e11), Verdict::Settled);
}

#[test]
fn without_a_budget_any_work_is_allowed() {
    let stop = Stop {
        region: 0.9,
        area_changes_less_than: 0.05,
        max_members: 1024,
        budget_point_steps: None,
    };
    let progress = Progress {
        areas_m2: vec![[1.0, 2.0]],
        members: 512,
        point_steps: 1e300,
    };
    assert_eq!(stop.verdict(&progress), Verdict::Double);
}
