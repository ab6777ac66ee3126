//! Scenes drawn at random from a fixed seed: short channels in which a flow
//! meets one or two bodies. They were not selected by hand, so nothing is tuned to them.

use super::dice::Dice;
use serde_json::{Value, json};

/// Duration of every scene [s].
const DURATION: f64 = 1.0;

/// A scene and its resolution.
#[derive(Debug, Clone)]
pub(super) struct Drawn {
    /// Label in words.
    pub(super) label: String,
    /// The scenario, without a cell size.
    pub(super) scenario: Value,
    /// Cell size of the answer [m].
    pub(super) cell_size_m: f64,
}

/// The scene with this number.
pub(super) fn scene(number: u64) -> Drawn {
    let mut dice = Dice::of(number);
    let mut scenario = json!({
        "duration_s": DURATION, "sample_interval_s": 0.02, "flow_snapshots": 0,
    });
    let width = dice.within(0.12, 0.2);
    let inclination = dice.within(28.0, 48.0);
    scenario["channel"] = channel(&mut dice, inclination, width);
    let incline = scenario["channel"]["incline_length_m"].as_f64();
    scenario["flow"] = flow(&mut dice, inclination, width, incline.unwrap_or(0.0));
    let size = dice.within(0.045, 0.065);
    let (what, body) = body(&mut dice, size, width);
    let mut bodies = vec![body];
    let mut label = format!("{number}: {what} at {inclination:.0}°");
    if dice.once_in(4) {
        bodies.push(companion(
            &mut dice,
            size,
            bodies[0]["position"]["downstream_m"].as_f64(),
        ));
        label.push_str(", another behind it");
    }
    scenario["bodies"] = json!(bodies);
    Drawn {
        label,
        scenario,
        cell_size_m: size / dice.within(2.2, 3.0),
    }
}

fn channel(dice: &mut Dice, inclination: f64, width: f64) -> Value {
    let steep = inclination.to_radians().tan();
    json!({
        "inclination_deg": inclination,
        "incline_length_m": dice.within(0.4, 0.55),
        "runout_length_m": 1.2,
        "width_m": width,
        "base_friction": dice.within(0.2, 0.45).min(0.7 * steep),
        "side_friction": if dice.once_in(2) { 0.0 } else { dice.within(0.05, 0.25) },
    })
}

fn flow(dice: &mut Dice, inclination: f64, width: f64, incline: f64) -> Value {
    let height = dice.within(0.06, 0.1);
    let toe = dice.within(0.02, 0.1);
    let length = dice.within(0.14, 0.22).min(0.95 * (incline - toe));
    let friction = dice.within(0.4, 0.65);
    let thickness = height / inclination.to_radians().cos();
    json!({
        "volume_m3": width * length * thickness,
        "release": {"height_m": height, "toe_distance_m": toe},
        "material": {
            "bulk_density_kg_m3": dice.within(1300.0, 1700.0),
            "static_friction": friction,
            "limiting_friction": friction + dice.within(0.1, 0.3),
            "grain_diameter_m": dice.within(0.5, 3.0) / 1000.0,
        },
    })
}

/// A body of this least size [m], and its description.
fn body(dice: &mut Dice, size: f64, width: f64) -> (&'static str, Value) {
    let (what, shape) = match dice.next() % 4 {
        0 => ("a cube", json!({"cube": {"side_m": size}})),
        1 => {
            let sides = [
                size,
                size * dice.within(1.0, 1.6),
                size * dice.within(1.0, 1.4),
            ];
            ("a box", json!({"box": {"sides_m": sides}}))
        }
        // Edge lengths for which the distance of opposite faces equals the size.
        2 => (
            "an octahedron",
            json!({"regular": {"solid": "octahedron", "size_m": size / 0.8165}}),
        ),
        _ => (
            "a dodecahedron",
            json!({"regular": {"solid": "dodecahedron", "size_m": size / 2.227}}),
        ),
    };
    let off = if dice.once_in(2) {
        0.0
    } else {
        dice.within(0.05, 0.2)
    };
    let yaw = if dice.once_in(2) {
        0.0
    } else {
        dice.within(5.0, 80.0)
    };
    let body = json!({
        "shape": shape,
        "density_kg_m3": dice.within(1000.0, 3000.0),
        "position": {"downstream_m": dice.within(0.05, 0.15), "lateral_m": off * width},
        "yaw_deg": yaw,
        "friction": dice.within(0.25, 0.6),
        "restitution": dice.within(0.1, 0.5),
        "flow_friction": dice.within(0.2, 0.5),
    });
    (what, body)
}

/// A second cube downstream, free or fixed.
fn companion(dice: &mut Dice, size: f64, first: Option<f64>) -> Value {
    json!({
        "shape": {"cube": {"side_m": size}},
        "density_kg_m3": dice.within(1000.0, 3000.0),
        "position": {"downstream_m": first.unwrap_or(0.0) + dice.within(0.13, 0.2),
                     "lateral_m": 0.0},
        "fixed": dice.once_in(2),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::run::scenario_of;

    #[test]
    fn every_scene_is_legal_and_no_two_are_alike() {
        let scenes: Vec<Drawn> = (0..60).map(scene).collect();
        for drawn in &scenes {
            let scenario = scenario_of(&drawn.scenario);
            let scenario = scenario.unwrap_or_else(|error| panic!("{}: {error}", drawn.label));
            let thinnest = scenario.shape_of(0).least_width();
            let cells = thinnest / drawn.cell_size_m;
            assert!(
                (2.0..3.2).contains(&cells),
                "{}: {cells} cells",
                drawn.label
            );
        }
        for pair in scenes.windows(2) {
            assert_ne!(pair[0].scenario, pair[1].scenario);
        }
        assert_eq!(scene(7).scenario, scene(7).scenario);
    }
}
