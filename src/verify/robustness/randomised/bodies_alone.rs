//! Bodies without a flow, thrown onto each other: all shapes, from compact to twenty times as
//! long as thick, with any friction and restitution.

use crate::verify::dice::Dice;
use serde_json::{Value, json};

/// Largest number of bodies.
const MOST_BODIES: u64 = 5;
/// Range of their initial positions, up the incline or on the floor [m].
const ON_THE_INCLINE: f64 = -0.5;
const ON_THE_FLOOR: f64 = 0.3;
/// Gap under the first body, and between bodies [m].
const GAP: f64 = 0.03;

/// One random scenario.
pub(super) fn scenario(dice: &mut Dice) -> Value {
    let (inclination, downstream) = if dice.once_in(2) {
        (0.0, ON_THE_FLOOR)
    } else {
        (dice.within(5.0, 45.0), ON_THE_INCLINE)
    };
    let bed = f64::max(0.0, -downstream) * f64::to_radians(inclination).tan();
    let count = 1 + dice.next() % MOST_BODIES;
    let mut bodies = Vec::new();
    let mut height = bed;
    for place in 0..count {
        let (shape, size) = shape(dice);
        height += size;
        let centre = json!({
            "downstream_m": downstream + size * dice.within(-0.1, 0.1),
            "lateral_m": size * dice.within(-0.1, 0.1),
            "elevation_m": height + GAP * dice.share(),
        });
        let mut body = json!({
            "shape": shape, "position": centre, "orientation": orientation(dice),
            "density_kg_m3": dice.within(500.0, 8000.0),
            "restitution": if dice.once_in(4) { 0.0 } else { dice.within(0.0, 1.0) },
            "friction": if dice.once_in(3) { dice.within(0.0, 10.0) } else { dice.within(0.0, 1.0) },
        });
        if dice.once_in(4) {
            body["rolling_friction"] = json!(dice.within(0.0, 0.5));
        }
        if place == 0 && dice.once_in(8) {
            body["fixed"] = json!(true);
        } else {
            throw(dice, &mut body);
        }
        bodies.push(body);
        height += size + GAP;
    }
    json!({
        "channel": {
            "inclination_deg": inclination, "incline_length_m": 1.0, "runout_length_m": 5.0,
            "width_m": 2.0,
        },
        "flow": null, "bodies": bodies, "duration_s": 0.2, "flow_snapshots": 0,
        "sample_interval_s": dice.one_of(&[0.0005, 0.002, 0.01]),
        "numerics": {"ending": "full"},
    })
}

/// A shape, and a length of its order of magnitude [m].
fn shape(dice: &mut Dice) -> (Value, f64) {
    let size = dice.decades(0.03, 0.2);
    let shape = match dice.next() % 5 {
        0 => json!({"cube": {"side_m": size}}),
        1 => {
            let mut side = || size * dice.decades(0.05, 1.0);
            json!({"box": {"sides_m": [size, side(), side()]}})
        }
        2 | 3 => {
            let (solid, edge) = dice.one_of(&[
                ("tetrahedron", 0.8),
                ("octahedron", 0.8),
                ("dodecahedron", 0.4),
                ("icosahedron", 0.6),
            ]);
            json!({"regular": {"solid": solid, "size_m": edge * size}})
        }
        _ => {
            let corners = 5 + dice.next() % 10;
            let mut along = || size * (dice.share() - 0.5);
            let corners: Vec<[f64; 3]> =
                (0..corners).map(|_| [along(), along(), along()]).collect();
            json!({"polyhedron": {"vertices_m": corners}})
        }
    };
    (shape, size)
}

/// A quaternion of length 1, not uniformly distributed.
fn orientation(dice: &mut Dice) -> Vec<f64> {
    let parts: Vec<f64> = (0..4).map(|_| dice.share() - 0.5).collect();
    let length = parts.iter().map(|part| part * part).sum::<f64>().sqrt();
    parts.iter().map(|part| part / length).collect()
}

/// Gives some bodies speed or spin.
fn throw(dice: &mut Dice, body: &mut Value) {
    let vector = |dice: &mut Dice, most: f64| json!([(); 3].map(|()| dice.within(-most, most)));
    if dice.once_in(3) {
        body["angular_velocity_rad_s"] = vector(dice, 30.0);
    }
    if dice.once_in(3) {
        body["velocity_m_s"] = vector(dice, 1.0);
    }
}
