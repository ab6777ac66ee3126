//! No friction and high friction; perfectly plastic and perfectly elastic impacts.

use super::strike_with;
use crate::verify::Effort;
use crate::verify::robustness::{Family, Member};
use serde_json::{Value, json};

pub(super) const FRICTION: Family = Family {
    name: "friction 0 and 5",
    reason: "without friction nothing takes energy out; at 5 the tangential forces are larger \
             than the normal ones and must not throw anything",
    members: frictions,
};

pub(super) const RESTITUTION: Family = Family {
    name: "restitution 0 and 1",
    reason: "at 0 the contacts are damped twelvefold critically, at 1 only the integration \
             changes the energy",
    members: restitutions,
};

fn everywhere(name: String, keys: &[&str], value: f64) -> Member {
    let changes: Vec<(&str, Value)> = keys.iter().map(|key| (*key, json!(value))).collect();
    Member::Scene(Box::new(strike_with(name, &changes)))
}

fn frictions(_: Effort) -> Vec<Member> {
    let keys = [
        "/channel/base_friction",
        "/channel/side_friction",
        "/flow/material/static_friction",
        "/flow/material/limiting_friction",
        "/bodies/0/friction",
        "/bodies/0/flow_friction",
    ];
    let of = |value: f64| everywhere(format!("{value} everywhere"), &keys, value);
    [0.0, 5.0].map(of).into()
}

fn restitutions(_: Effort) -> Vec<Member> {
    let keys = ["/bodies/0/restitution", "/bodies/0/flow_restitution"];
    let of = |value: f64| everywhere(value.to_string(), &keys, value);
    [0.0, 1.0].map(of).into()
}
