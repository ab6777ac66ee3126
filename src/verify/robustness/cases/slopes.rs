//! Flat, nearly flat, very steep and nearly vertical inclines.

use super::strike;
use crate::verify::Effort;
use crate::verify::robustness::{Family, Member, Trial};

pub(super) const FAMILY: Family = Family {
    name: "inclination",
    reason: "at 0° incline and floor are one plane; beyond 63° columns of nodes lie along x \
             instead of standing, and at 89° the release is a wall of its own height over \
             cos 89° that falls on the cube",
    members,
};

fn members(_: Effort) -> Vec<Member> {
    [0.0, 5.0, 63.0, 64.0, 80.0, 89.0].map(slope).into()
}

fn slope(inclination_deg: f64) -> Member {
    let mut scenario = strike(inclination_deg);
    if inclination_deg > 85.0 {
        // The incline is 5.7 m high: a thin release, and not its whole fall.
        scenario["flow"]["release"]["height_m"] = 0.04.into();
        scenario["flow"]["volume_m3"] = 0.001.into();
        scenario["duration_s"] = 0.2.into();
    }
    Member::Scene(Box::new(Trial::new(
        format!("{inclination_deg}°"),
        scenario,
    )))
}
