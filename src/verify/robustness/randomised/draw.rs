//! A scenario drawn from all legal ones, of a size for which a run of a fraction of a
//! second is meaningful.

use crate::verify::dice::Dice;
use serde_json::{Value, json};

/// Largest number of points of a release.
const MOST_POINTS: f64 = 1_500.0;
/// Largest number of bodies.
const MOST_BODIES: u64 = 5;

/// One random scenario; it may be refused, since rules between fields are not taken into account.
pub(super) fn scenario(dice: &mut Dice) -> Value {
    // Most scenes have the size of a flume, some of a matchbox or a mountain.
    let scale = if dice.once_in(3) {
        dice.decades(0.005, 500.0)
    } else {
        dice.decades(0.1, 10.0)
    };
    let gravity = if dice.once_in(8) {
        dice.decades(0.01, 1e3)
    } else {
        9.81
    };
    let channel = channel(dice, scale);
    let flow = if dice.once_in(8) {
        Value::Null
    } else {
        flow(dice, &channel)
    };
    let count = dice.next() % (MOST_BODIES + 1);
    let bodies: Vec<Value> = (0..count).map(|_| body(dice, &channel, scale)).collect();
    let duration = dice.decades(0.01, 10.0) * (scale / gravity).sqrt();
    let numerics = numerics(dice, &channel, &flow, scale);
    json!({
        "channel": channel, "flow": flow, "bodies": bodies, "gravity_m_s2": gravity,
        "duration_s": duration.min(3600.0),
        "sample_interval_s": (duration / dice.decades(1.0, 50.0)).clamp(1e-5, 3600.0),
        "flow_snapshots": 0, "numerics": numerics,
    })
}

/// True if a scenario has few enough points for a short run.
pub(super) fn is_small(scenario: &Value) -> bool {
    let numerics = &scenario["numerics"];
    let per_cell = number(numerics, "points_per_cell");
    let cells = number(&scenario["flow"], "volume_m3") / number(numerics, "cell_size_m").powi(3);
    cells * per_cell <= 2.0 * MOST_POINTS
}

/// A value of the usual range with probability 1/2, of the wide range with 1/4, otherwise one of
/// its ends.
fn field(dice: &mut Dice, usual: (f64, f64), wide: (f64, f64)) -> f64 {
    match dice.next() % 8 {
        0..4 => dice.decades(usual.0, usual.1),
        4..7 => dice.decades(wide.0, wide.1),
        _ => dice.one_of(&[wide.0, wide.1]),
    }
}

/// As [`field`], but sometimes 0.
fn coefficient(dice: &mut Dice, most: f64) -> f64 {
    if dice.once_in(5) {
        0.0
    } else {
        field(dice, (0.1, 0.9), (1e-3, most)).min(most)
    }
}

fn channel(dice: &mut Dice, scale: f64) -> Value {
    let inclination = match dice.next() % 6 {
        0 => dice.one_of(&[0.0, 1e-3, 45.0, 89.0]),
        1 => dice.within(60.0, 89.0),
        _ => dice.within(0.0, 60.0),
    };
    json!({
        "inclination_deg": inclination,
        "incline_length_m": (scale * dice.decades(0.5, 5.0)).clamp(1e-3, 1e3),
        "runout_length_m": (scale * dice.decades(0.05, 5.0)).clamp(1e-3, 1e3),
        "width_m": (scale * dice.decades(0.05, 2.0)).clamp(1e-3, 1e3),
        "base_friction": coefficient(dice, 10.0),
        "side_friction": coefficient(dice, 10.0),
    })
}

fn number(of: &Value, key: &str) -> f64 {
    of[key].as_f64().unwrap_or(0.0)
}

fn flow(dice: &mut Dice, channel: &Value) -> Value {
    let incline = number(channel, "incline_length_m");
    let slope = number(channel, "inclination_deg").to_radians();
    let height = (incline * dice.decades(0.01, 1.0)).clamp(1e-6, 1e2);
    let toe = if dice.once_in(2) {
        0.0
    } else {
        incline * dice.within(0.0, 0.9)
    };
    let length = (incline - toe) * dice.decades(0.02, 0.99);
    let volume = number(channel, "width_m") * height / slope.cos() * length;
    let bulk = field(dice, (1000.0, 2000.0), (1.0, 5e4));
    let friction = coefficient(dice, 10.0);
    let mut flow = json!({
        "volume_m3": volume.min(1e6),
        "release": {"height_m": height, "toe_distance_m": toe},
        "material": {
            "bulk_density_kg_m3": bulk,
            "grain_density_kg_m3": (bulk * dice.within(1.0, 2.5)).min(1e5),
            "grain_diameter_m": field(dice, (1e-4, 1e-2), (1e-9, 1.0)),
            "static_friction": friction,
            "limiting_friction": if dice.once_in(3) { friction } else { friction.max(coefficient(dice, 10.0)) },
            "reference_inertial_number": field(dice, (0.1, 0.5), (1e-9, 1e3)),
            "poissons_ratio": dice.one_of(&[0.3, 0.3, 0.0, 0.2, 0.45, 0.49]),
        },
    });
    if dice.once_in(6) {
        flow["material"]["youngs_modulus_pa"] = json!(dice.decades(1e2, 1e12));
    }
    flow
}

fn shape(dice: &mut Dice, size: f64) -> Value {
    match dice.next() % 5 {
        0 | 1 => json!({"cube": {"side_m": size}}),
        2 => {
            let sides = [
                size,
                size * dice.decades(0.1, 3.0),
                size * dice.decades(0.1, 3.0),
            ];
            json!({"box": {"sides_m": sides.map(|side| side.clamp(1e-4, 1e2))}})
        }
        3 => {
            let solids = [
                "tetrahedron",
                "cube",
                "octahedron",
                "dodecahedron",
                "icosahedron",
            ];
            json!({"regular": {"solid": dice.one_of(&solids), "size_m": size}})
        }
        _ => {
            let points = 4 + dice.next() % 12;
            let mut place = || (dice.share() - 0.5) * size;
            let points: Vec<[f64; 3]> = (0..points).map(|_| [place(), place(), place()]).collect();
            json!({"polyhedron": {"vertices_m": points}})
        }
    }
}

fn body(dice: &mut Dice, channel: &Value, scale: f64) -> Value {
    let width = number(channel, "width_m");
    let size = (width.min(scale) * dice.decades(0.02, 0.9)).clamp(2e-4, 50.0);
    let (low, high) = (
        -number(channel, "incline_length_m"),
        number(channel, "runout_length_m"),
    );
    let x = low + (high - low) * dice.share();
    let mut body = json!({
        "shape": shape(dice, size),
        "density_kg_m3": field(dice, (500.0, 5000.0), (0.1, 1e6)),
        "position": {"downstream_m": x, "lateral_m": (width - size) * (dice.share() - 0.5)},
        "friction": coefficient(dice, 10.0),
        "restitution": dice.one_of(&[0.0, 0.1, 0.3, 0.3, 0.6, 1.0]),
        "rolling_friction": dice.one_of(&[0.0, 0.0, 0.1, 10.0]),
        "flow_friction": coefficient(dice, 10.0),
        "flow_restitution": dice.one_of(&[0.0, 0.0, 0.5, 1.0]),
    });
    if dice.once_in(3) {
        let bed = (-x).max(0.0) * number(channel, "inclination_deg").to_radians().tan();
        body["position"]["elevation_m"] = json!(bed + size * dice.decades(0.8, 20.0));
    }
    if dice.once_in(3) {
        let turn: [f64; 4] = std::array::from_fn(|_| dice.share() - 0.5);
        let norm = turn.iter().map(|part| part * part).sum::<f64>().sqrt();
        body["orientation"] = json!(turn.map(|part| part / norm));
    } else {
        body["yaw_deg"] = json!(dice.one_of(&[0.0, 0.0, 45.0, 17.0]));
    }
    if dice.once_in(5) {
        body["fixed"] = json!(true);
    } else {
        set_in_motion(dice, &mut body, size);
    }
    if dice.once_in(6) {
        body["contact_modulus_pa"] = json!(dice.decades(1e2, 1e12));
    }
    if dice.once_in(6) {
        body["sphero_radius_m"] = json!((size * dice.decades(0.001, 0.4)).max(1e-6));
    }
    body
}

fn set_in_motion(dice: &mut Dice, body: &mut Value, size: f64) {
    if dice.once_in(3) {
        let speed = field(dice, (0.1, 10.0), (1e-3, 1e3));
        let way: [f64; 3] = std::array::from_fn(|_| (2.0 * dice.share() - 1.0) * speed);
        body["velocity_m_s"] = json!(way);
    }
    if dice.once_in(5) {
        let rim = field(dice, (0.1, 10.0), (1e-3, 1e3));
        let turn = |dice: &mut Dice| ((2.0 * dice.share() - 1.0) * rim / size).clamp(-1e5, 1e5);
        body["angular_velocity_rad_s"] = json!([turn(dice), turn(dice), turn(dice)]);
    }
}

fn numerics(dice: &mut Dice, channel: &Value, flow: &Value, scale: f64) -> Value {
    let width = number(channel, "width_m");
    let per_cell = dice.one_of(&[8, 8, 8, 4, 1, 27, 64]);
    // Cells for the number of points drawn, and no wider than the channel.
    let volume = if flow.is_null() {
        scale.powi(3)
    } else {
        number(flow, "volume_m3")
    };
    let points = dice.decades(5.0, MOST_POINTS);
    let cell = (volume * f64::from(per_cell) / points).cbrt();
    let mut numerics = json!({
        "cell_size_m": cell.clamp(1e-5, 10.0).min(width),
        "points_per_cell": per_cell,
        "precision": dice.one_of(&["single", "single", "single", "double"]),
    });
    if dice.once_in(6) {
        numerics["courant"] = json!(dice.within(0.05, 0.9));
    }
    if dice.once_in(6) {
        numerics["flow_courant"] = json!(dice.within(0.02, 1.0));
    }
    let stiff = flow["material"].get("youngs_modulus_pa").is_some();
    if !stiff && dice.once_in(6) {
        numerics["sound_speed_m_s"] = json!(dice.decades(0.1, 1e4));
    }
    numerics
}
