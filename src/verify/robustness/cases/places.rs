//! Cubes in corners, between walls, on edges, over the foot of the incline, and on
//! each other.

use super::{cube_at, strike_with};
use crate::verify::Effort;
use crate::verify::robustness::{Family, Member, Trial};
use crate::verify::scenes::on_vertex;
use serde_json::{Value, json};

pub(super) const FAMILY: Family = Family {
    name: "place of the cube",
    reason: "several walls act on one body at once, and points between them have no way out",
    members: places,
};

pub(super) const HEAPS: Family = Family {
    name: "cubes on cubes",
    reason: "what lies above presses on what lies below through contacts chosen beforehand, and \
             points get between them",
    members: heaps,
};

fn scene(name: &str, bodies: &Value) -> Trial {
    strike_with(name, &[("/bodies", bodies.clone())])
}

fn members<const N: usize>(trials: [Trial; N]) -> Vec<Member> {
    trials.map(|trial| Member::Scene(Box::new(trial))).into()
}

fn places(_: Effort) -> Vec<Member> {
    let side = 0.04f64;
    let half_diagonal = side / 2f64.sqrt();
    let on_edge = [0.5f64.sqrt().mul_add(0.5, 0.5).sqrt(), 0.0, 0.0, 0.0];
    // 45° about y, the axis across the channel.
    let (cos, sin) = (on_edge[0], (1.0 - on_edge[0] * on_edge[0]).sqrt());
    let stand = |x: f64, height: f64, orientation: [f64; 4]| {
        json!([{"shape": {"cube": {"side_m": side}}, "orientation": orientation,
                "position": {"downstream_m": x, "elevation_m": height}}])
    };
    let rounded = |height: f64, radius: f64, share: f64| height - radius * (share - 1.0);
    let edge = rounded(half_diagonal, 0.002, 2f64.sqrt());
    let vertex = rounded(0.5 * side * 3f64.sqrt(), 0.002, 3f64.sqrt());
    let steep = 40f64.to_radians().tan();
    let over_foot = 0.5 * side * (1.0 + steep) + 1e-4;
    let corner = json!([{"shape": {"cube": {"side_m": side}},
        "position": {"downstream_m": -0.54, "lateral_m": 0.04, "elevation_m": 0.56}}]);
    let beside = json!([{"shape": {"cube": {"side_m": side}},
        "position": {"downstream_m": 0.04, "lateral_m": 0.04}}]);
    let wedged = json!([{"shape": {"box": {"sides_m": [side, 0.12, side]}},
        "position": {"downstream_m": 0.04}}]);
    let slot = json!([{"shape": {"box": {"sides_m": [side, 0.1, side]}},
        "position": {"downstream_m": 0.04}}]);
    members([
        scene("on a side wall", &beside),
        scene("falling into the corner of back and side wall", &corner),
        scene("wedged between the side walls", &wedged),
        scene("half a cell from both side walls", &slot),
        scene("on an edge", &stand(0.1, edge, [cos, 0.0, sin, 0.0])),
        scene("on a vertex", &stand(0.1, vertex, on_vertex())),
        scene(
            "over the foot of the incline",
            &stand(0.0, over_foot, [1.0, 0.0, 0.0, 0.0]),
        ),
        scene(
            "on an edge in the foot of the incline",
            &stand(0.0, 0.05, [cos, 0.0, sin, 0.0]),
        ),
        scene("next to a fixed one, two cells away", &gap(0.04)),
        scene("next to a fixed one, a quarter of a cell away", &gap(0.005)),
    ])
}

/// A free cube ahead of a fixed one, with this gap.
fn gap(width: f64) -> Value {
    let mut fixed = cube_at(0.1 + 0.04 + width);
    fixed["fixed"] = json!(true);
    json!([cube_at(0.1), fixed])
}

fn heaps(_: Effort) -> Vec<Member> {
    let stacked = |height: f64| {
        let mut cube = cube_at(0.1);
        cube["position"]["elevation_m"] = json!(height);
        cube
    };
    let two = json!([stacked(0.02), stacked(0.06)]);
    let mut heavy_on_light = two.clone();
    heavy_on_light[0]["density_kg_m3"] = json!(100.0);
    heavy_on_light[1]["density_kg_m3"] = json!(10_000.0);
    members([
        scene("two stacked", &two),
        scene("a heavy one on a light one", &heavy_on_light),
        Trial::new("ten falling on each other", ten_cubes()),
    ])
}

/// The striking flow and ten cubes that fall onto each other before it arrives.
pub(super) fn ten_cubes() -> Value {
    let ten: Vec<Value> = (0..10).map(falling).collect();
    scene("", &json!(ten)).scenario
}

/// One of the ten cubes: three layers, each turned a little.
fn falling(which: u32) -> Value {
    let (layer, place) = (which / 4, which % 4);
    let (x, y) = (f64::from(place / 2), f64::from(place % 2));
    let turn = 0.2 * f64::from(which);
    json!({
        "shape": {"cube": {"side_m": 0.03}},
        "orientation": [turn.cos(), 0.6 * turn.sin(), 0.0, 0.8 * turn.sin()],
        "position": {"downstream_m": 0.08 + 0.055 * x, "lateral_m": 0.055 * (y - 0.5),
                     "elevation_m": 0.04 + 0.056 * f64::from(layer)},
    })
}
