//! The robustness tests, by families. To add one: a file, its `mod` line and its place in
//! [`ALL`].

mod contacts;
mod far;
mod limits;
mod long;
mod materials;
mod places;
mod releases;
mod restart;
mod sizes;
mod slopes;
mod throws;

use super::Family;
use super::trial::Trial;
use serde_json::{Value, json};

/// Every family.
pub const ALL: &[Family] = &[
    slopes::FAMILY,
    sizes::SIZES,
    sizes::DENSITIES,
    throws::FAMILY,
    releases::FAMILY,
    places::FAMILY,
    places::HEAPS,
    contacts::FRICTION,
    contacts::RESTITUTION,
    materials::STIFFNESS,
    materials::GRAINS,
    materials::DUST,
    limits::FAMILY,
    far::FAMILY,
    restart::FAMILY,
    long::FAMILY,
];

/// Cells of the small scenes [m].
const CELL: f64 = 0.02;
/// Duration [s]: until the flow has struck the cube and passed it.
const DURATION: f64 = 0.4;

/// Two litres on a slope and a cube of 40 mm at its foot, coarse and narrow; computed
/// in full, since the symmetric half saves only time.
fn strike(inclination_deg: f64) -> Value {
    json!({
        "channel": {"inclination_deg": inclination_deg, "incline_length_m": 0.6,
                    "runout_length_m": 0.6, "width_m": 0.12},
        "flow": {"volume_m3": 0.002, "release": {"height_m": 0.1, "toe_distance_m": 0.0}},
        "bodies": [cube_at(0.04)],
        "duration_s": DURATION, "sample_interval_s": 0.01, "flow_snapshots": 0,
        "numerics": {"cell_size_m": CELL, "ending": "full"},
    })
}

/// A cube of 40 mm, its centre this far downstream [m].
fn cube_at(downstream_m: f64) -> Value {
    json!({"shape": {"cube": {"side_m": 0.04}}, "position": {"downstream_m": downstream_m}})
}

/// The striking flow on 40° with changed fields.
fn strike_with(name: impl Into<String>, changes: &[(&str, Value)]) -> Trial {
    let mut scenario = strike(40.0);
    for (pointer, value) in changes {
        set(&mut scenario, pointer, value.clone());
    }
    Trial::new(name, scenario)
}

/// Sets the field at a JSON pointer, and creates the objects on its path.
fn set(document: &mut Value, pointer: &str, value: Value) {
    let mut here = document;
    for key in pointer.split('/').skip(1) {
        here = match key.parse::<usize>() {
            Ok(index) => &mut here[index],
            Err(_) => &mut here[key],
        };
    }
    *here = value;
}
