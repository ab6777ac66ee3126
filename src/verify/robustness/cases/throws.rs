//! Impacts at 20 m/s.

use super::{strike, strike_with};
use crate::verify::Effort;
use crate::verify::robustness::{Family, Member, Trial};
use serde_json::json;

pub(super) const FAMILY: Family = Family {
    name: "20 m/s",
    reason: "an impact a hundred times as fast as √(g h): the step, the contacts and the \
             search for points near the cube have to follow",
    members,
};

fn members(_: Effort) -> Vec<Member> {
    let thrown = |name, velocity: [f64; 3]| {
        let mut trial = strike_with(
            name,
            &[
                ("/bodies/0/velocity_m_s", json!(velocity)),
                ("/bodies/0/position/downstream_m", json!(0.3)),
                ("/bodies/0/position/elevation_m", json!(0.08)),
            ],
        );
        trial.scenario["duration_s"] = 0.06.into();
        trial
    };
    let mut spun = thrown("cube thrown and spinning at 2,000 rad/s", [-20.0, 0.0, 0.0]);
    spun.scenario["bodies"][0]["angular_velocity_rad_s"] = json!([300.0, 2000.0, 0.0]);
    let heavy = {
        let mut trial = thrown("heavy cube thrown down at the floor", [-2.0, 0.0, -20.0]);
        trial.scenario["bodies"][0]["density_kg_m3"] = 20_000.into();
        trial
    };
    let scenes = [
        thrown("cube thrown at the flow", [-20.0, 0.0, 0.0]),
        thrown("cube thrown at a side wall", [-3.0, 20.0, 0.0]),
        heavy,
        spun,
        flow_at_speed(),
    ];
    scenes.map(|trial| Member::Scene(Box::new(trial))).into()
}

/// A smooth slope long enough for the flow to strike the cube at 20 m/s: 24 m of fall.
fn flow_at_speed() -> Trial {
    let mut scenario = strike(60.0);
    scenario["channel"]["base_friction"] = 0.0.into();
    scenario["channel"]["incline_length_m"] = 13.0.into();
    scenario["channel"]["runout_length_m"] = 3.0.into();
    scenario["flow"]["volume_m3"] = 0.001.into();
    scenario["flow"]["release"]["toe_distance_m"] = 12.0.into();
    scenario["duration_s"] = 2.6.into();
    Trial::new("flow that has fallen 21 m", scenario)
}
