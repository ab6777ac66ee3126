//! Releases on and around bodies, and thinner than a cell.

use super::{CELL, cube_at, strike, strike_with};
use crate::verify::Effort;
use crate::verify::robustness::{Family, Member, Trial};
use serde_json::{Value, json};

pub(super) const FAMILY: Family = Family {
    name: "release",
    reason: "points without neighbours, points pressed between cube and bed from the first \
             step, and a cube that has to carry what lies on it",
    members,
};

fn members(_: Effort) -> Vec<Member> {
    let scenes = [
        strike_with(
            "one point thick",
            &[
                ("/flow/release/height_m", json!(0.5 * CELL)),
                ("/flow/volume_m3", json!(0.0003)),
            ],
        ),
        strike_with(
            "a thousandth of a cell thick",
            &[
                ("/flow/release/height_m", json!(0.001 * CELL)),
                ("/flow/volume_m3", json!(1e-6)),
            ],
        ),
        strike_with("of one point", &[("/flow/volume_m3", json!(1e-6))]),
        on(40.0, "cube buried on the incline", &cube_on_incline(-0.1)),
        on(0.0, "cube buried on the flat", &cube_at(-0.1)),
        on_top(),
    ];
    scenes.map(|trial| Member::Scene(Box::new(trial))).into()
}

fn on(inclination_deg: f64, name: &str, body: &Value) -> Trial {
    let mut scenario = strike(inclination_deg);
    scenario["bodies"] = json!([body]);
    Trial::new(name, scenario)
}

fn cube_on_incline(downstream_m: f64) -> Value {
    json!({"shape": {"cube": {"side_m": 0.04}}, "position": {"downstream_m": downstream_m}})
}

/// A column of 0.3 m on a cube that is as wide as the column is long.
fn on_top() -> Trial {
    let mut scenario = strike(0.0);
    scenario["flow"] = json!({
        "volume_m3": 0.12 * 0.1 * 0.3, "release": {"height_m": 0.3, "toe_distance_m": 0.05}
    });
    scenario["bodies"] = json!([{
        "shape": {"box": {"sides_m": [0.1, 0.1, 0.04]}}, "position": {"downstream_m": -0.1}
    }]);
    Trial::new("column on top of a box", scenario)
}
