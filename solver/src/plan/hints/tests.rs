//! One test per hint, and one that there are none without cause.

use super::*;
use serde_json::{Value, json};

fn scene() -> Value {
    json!({
        "channel": {"inclination_deg": 40, "incline_length_m": 1, "runout_length_m": 2},
        "flow": {"volume_m3": 0.01},
        "bodies": [{"shape": {"cube": {"side_m": 0.04}}}]
    })
}

/// Fields and details of all hints for a scene with other values at some pointers.
fn hints(changes: &[(&str, Value)]) -> Vec<(String, String)> {
    let mut scene = scene();
    for (pointer, value) in changes {
        let (parent, key) = pointer.rsplit_once('/').expect("a pointer");
        scene.pointer_mut(parent).expect("such a parent")[key] = value.clone();
    }
    let scenario = Scenario::from_value(&scene).unwrap_or_else(|error| panic!("{error:?}"));
    let prepared = PreparedScene::of(&scenario).expect("it fits");
    let found = of(&prepared);
    found
        .into_iter()
        .map(|hint| (hint.field, hint.detail))
        .collect()
}

fn only_hint(changes: &[(&str, Value)], field: &str) -> String {
    let found = hints(changes);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].0, field);
    found[0].1.clone()
}

#[test]
fn without_cause_there_is_none() {
    assert_eq!(hints(&[]), []);
    assert_eq!(hints(&[("/channel/inclination_deg", json!(0))]), []);
    assert_eq!(hints(&[("/bodies", json!([]))]), []);
    assert_eq!(hints(&[("/flow", Value::Null)]), []);
}

#[test]
fn an_inclination_like_one_in_radians_is_asked_about() {
    let field = "/channel/inclination_deg";
    let detail = only_hint(&[(field, json!(0.698))], field);
    assert!(
        detail.contains("in degrees? 0.698 rad are 40.0°"),
        "{detail}"
    );
}

#[test]
fn a_body_thinner_than_a_cell_is_told() {
    let plate = json!({"box": {"sides_m": [0.04, 0.04, 0.019]}});
    let thin = [
        ("/bodies/0/shape", plate),
        ("/numerics", json!({"cell_size_m": 0.02})),
    ];
    let detail = only_hint(&thin, "/numerics/cell_size_m");
    assert!(
        detail.starts_with("body 0 is thinner than a cell (0.0190 m, "),
        "{detail}"
    );
    let bare = [thin.as_slice(), &[("/flow", Value::Null)]].concat();
    assert_eq!(hints(&bare), [], "without a flow there are no cells");
}

#[test]
fn a_body_beyond_the_flow_s_reach_is_told() {
    let at = |place: f64| {
        [
            ("/channel/runout_length_m", json!(120)),
            ("/bodies/0/position", json!({"downstream_m": place})),
        ]
    };
    assert_eq!(hints(&at(0.5)), []);
    let field = "/bodies/0/position/downstream_m";
    let detail = only_hint(&at(100.0), field);
    assert!(
        detail.contains("probably does not come as far as body 0"),
        "{detail}"
    );
    let thrown = [("/bodies/0/velocity_m_s", json!([-1, 0, 0]))];
    assert_eq!(hints(&[at(100.0).as_slice(), &thrown].concat()), []);
    let smooth = [("/channel/base_friction", json!(0))];
    assert_eq!(hints(&[at(100.0).as_slice(), &smooth].concat()), []);
}

#[test]
fn a_body_so_light_that_it_takes_more_sub_steps_is_told() {
    let field = "/bodies/0/density_kg_m3";
    let detail = only_hint(&[(field, json!(2))], field);
    assert!(
        detail.contains("a density of 2 kg/m³, where the bulk has"),
        "{detail}"
    );
    let scenario = |density: f64| {
        let mut scene = scene();
        scene["bodies"][0]["density_kg_m3"] = json!(density);
        crate::Plan::new(&Scenario::from_value(&scene).expect("legal"))
            .expect("it fits")
            .cost
    };
    let (light, heavy) = (scenario(2.0).substeps, scenario(2500.0).substeps);
    let told = format!("{light} sub-steps instead of {heavy}");
    assert!(detail.contains(&told), "{told}; {detail}");
}

#[test]
fn cells_that_a_target_chooses_are_told() {
    let goal = json!({"target": 0.1, "quantity": "displacement_m"});
    let detail = only_hint(&[("/accuracy", goal)], "/accuracy/target");
    assert!(
        detail.contains("the target of 0.1 for displacement_m"),
        "{detail}"
    );
}

#[test]
fn many_bodies_are_not_all_named() {
    let named = |count: usize| names(&(0..count).collect::<Vec<_>>());
    assert_eq!(named(1), "body 0");
    assert_eq!(named(2), "bodies 0 and 1");
    assert_eq!(named(3), "bodies 0, 1 and 2");
    assert_eq!(named(9), "bodies 0, 1, 2 and 6 more");
}
