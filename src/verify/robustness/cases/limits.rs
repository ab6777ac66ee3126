//! Nothing, no time, too long a step, and the open end.

use super::{strike, strike_with};
use crate::verify::Effort;
use crate::verify::robustness::trial::Asked;
use crate::verify::robustness::{Family, Member, Trial};
use scree_solver::simulation::Scene;
use serde_json::{Value, json};

pub(super) const FAMILY: Family = Family {
    name: "limits",
    reason: "nothing to compute, no time to do it in, steps at and above the stable one, \
             stiffnesses that carry nothing, and bodies that go away",
    members,
};

fn members(_: Effort) -> Vec<Member> {
    let scenes = [
        strike_with("no volume", &[("/flow/volume_m3", json!(0.0))]),
        strike_with("no time", &[("/duration_s", json!(0.0))]),
        strike_with(
            "nothing at all",
            &[("/flow", Value::Null), ("/bodies", json!([]))],
        ),
        leaving(),
        strike_with("Courant 0.9", &[("/numerics/courant", json!(0.9))]),
        strike_with("Courant 1", &[("/numerics/courant", json!(1.0))]).asking(Asked::Refusal),
        strike_with("flow Courant 1", &[("/numerics/flow_courant", json!(1.0))]),
        strike_with("four times the stable step", &[])
            .altered(four_times)
            .asking(Asked::Orderly),
        strike_with(
            "sound of 0.1 m/s",
            &[("/numerics/sound_speed_m_s", json!(0.1))],
        )
        .asking(Asked::Refusal),
        strike_with(
            "cube on contacts of 100 Pa",
            &[("/bodies/0/contact_modulus_pa", json!(100.0))],
        )
        .asking(Asked::Refusal),
        strike_with(
            "contacts of 1e12 Pa",
            &[("/bodies/0/contact_modulus_pa", json!(1e12))],
        )
        .asking(Asked::Orderly),
    ];
    scenes.map(|trial| Member::Scene(Box::new(trial))).into()
}

/// Sets a sub-step of four times the limit of (25) and (26).
fn four_times(scene: &mut Scene) {
    if let Some(flow) = &mut scene.given.flow {
        flow.limits.courant *= 4.0;
        flow.limits.body_contact_share *= 4.0;
    }
}

/// A scene whose floor ends behind the cube, so that the flow leaves.
fn leaving() -> Trial {
    let mut scenario = strike(60.0);
    scenario["channel"]["runout_length_m"] = 0.1.into();
    scenario["channel"]["base_friction"] = 0.1.into();
    scenario["bodies"][0]["friction"] = 0.05.into();
    scenario["duration_s"] = 1.0.into();
    Trial::new("cube and flow leave by the open end", scenario)
}
