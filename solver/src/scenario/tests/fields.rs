//! Refusals of single fields, and their pointers.

use super::{check, minimal, refused};
use serde_json::{Value, json};

#[test]
fn single_fields() {
    check(&[
        (
            "unknown key",
            "/colour",
            json!("red"),
            "/colour",
            "one of: title, channel",
        ),
        (
            "unknown nested key",
            "/channel/lenght_m",
            json!(1),
            "/channel/lenght_m",
            "width_m",
        ),
        (
            "unknown in an optional part",
            "/numerics/gpu",
            json!(true),
            "/numerics/gpu",
            "threads",
        ),
        (
            "text for a number",
            "/gravity_m_s2",
            json!("9.81"),
            "/gravity_m_s2",
            "0.01 <= x",
        ),
        (
            "null for a number",
            "/duration_s",
            Value::Null,
            "/duration_s",
            "0 <= x <= 3600",
        ),
        (
            "number for a text",
            "/title",
            json!(7),
            "/title",
            "200 characters",
        ),
        (
            "title too long",
            "/title",
            json!("x".repeat(201)),
            "/title",
            "200 characters",
        ),
        (
            "number for an object",
            "/channel",
            json!(3),
            "/channel",
            "an object",
        ),
        (
            "null for an object",
            "/numerics",
            Value::Null,
            "/numerics",
            "an object",
        ),
        (
            "object for a list",
            "/bodies",
            json!({}),
            "/bodies",
            "a list",
        ),
        (
            "list item no object",
            "/bodies/0",
            json!(4),
            "/bodies/0",
            "an object",
        ),
        (
            "number for a truth value",
            "/bodies/0/fixed",
            json!(1),
            "/bodies/0/fixed",
            "true or false",
        ),
        (
            "below",
            "/channel/inclination_deg",
            json!(-1),
            "/channel/inclination_deg",
            "0 <= x <= 89",
        ),
        (
            "above",
            "/channel/inclination_deg",
            json!(90),
            "/channel/inclination_deg",
            "0 <= x <= 89",
        ),
        (
            "no width",
            "/channel/width_m",
            json!(0),
            "/channel/width_m",
            "0.001 <= x",
        ),
        (
            "negative volume",
            "/flow/volume_m3",
            json!(-0.01),
            "/flow/volume_m3",
            "0 <= x",
        ),
        (
            "negative friction",
            "/bodies/0/friction",
            json!(-0.1),
            "/bodies/0/friction",
            "0 <= x <= 10",
        ),
        (
            "restitution",
            "/bodies/0/restitution",
            json!(1.1),
            "/bodies/0/restitution",
            "0 <= x <= 1",
        ),
        (
            "incompressible",
            "/flow/material/poissons_ratio",
            json!(0.5),
            "/flow/material/poissons_ratio",
            "0.49",
        ),
        (
            "no courant",
            "/numerics/courant",
            json!(0),
            "/numerics/courant",
            "0 < x <= 0.9",
        ),
        (
            "half a point",
            "/numerics/points_per_cell",
            json!(7.5),
            "/numerics/points_per_cell",
            "whole",
        ),
        (
            "unknown precision",
            "/numerics/precision",
            json!("half"),
            "/numerics/precision",
            "\"single\" or \"double\"",
        ),
        (
            "precision in capitals",
            "/numerics/precision",
            json!("Double"),
            "/numerics/precision",
            "\"single\" or \"double\"",
        ),
        (
            "precision in bits",
            "/numerics/precision",
            json!(64),
            "/numerics/precision",
            "\"single\" or \"double\"",
        ),
        (
            "no precision",
            "/numerics/precision",
            Value::Null,
            "/numerics/precision",
            "\"single\" or \"double\"",
        ),
        (
            "no thread",
            "/numerics/threads",
            json!(0),
            "/numerics/threads",
            "1 <= x",
        ),
        (
            "negative count",
            "/flow_snapshots",
            json!(-2),
            "/flow_snapshots",
            "0 <= x",
        ),
        (
            "short vector",
            "/bodies/0/velocity_m_s",
            json!([1, 2]),
            "/bodies/0/velocity_m_s",
            "a list of 3 numbers",
        ),
        (
            "vector of texts",
            "/bodies/0/velocity_m_s",
            json!([0, "a", 0]),
            "/bodies/0/velocity_m_s/1",
            "-1000 <= x",
        ),
        (
            "light is slower",
            "/bodies/0/velocity_m_s",
            json!([0, 0, 1e9]),
            "/bodies/0/velocity_m_s/2",
            "x <= 1000",
        ),
        (
            "zero quaternion",
            "/bodies/0/orientation",
            json!([0, 0, 0, 0]),
            "/bodies/0/orientation",
            "length 1",
        ),
        (
            "long quaternion",
            "/bodies/0/orientation",
            json!([1, 0, 0.1, 0]),
            "/bodies/0/orientation",
            "length 1",
        ),
        (
            "no shape",
            "/bodies/0/shape",
            json!({}),
            "/bodies/0/shape",
            "exactly one of: cube",
        ),
        (
            "two shapes",
            "/bodies/0/shape/sphere",
            json!({}),
            "/bodies/0/shape",
            "exactly one of: cube",
        ),
        (
            "unknown shape",
            "/bodies/0/shape",
            json!({"sphere": {}}),
            "/bodies/0/shape/sphere",
            "one of: cube",
        ),
        (
            "shape by name",
            "/bodies/0/shape",
            json!("cube"),
            "/bodies/0/shape",
            "an object",
        ),
        (
            "box without sides",
            "/bodies/0/shape",
            json!({"box": {}}),
            "/bodies/0/shape/box/sides_m",
            "a list of 3 numbers, each 0.0001 <= x",
        ),
        (
            "flat box",
            "/bodies/0/shape",
            json!({"box": {"sides_m": [0.1, 0, 0.1]}}),
            "/bodies/0/shape/box/sides_m/1",
            "0.0001 <= x",
        ),
        (
            "not so regular",
            "/bodies/0/shape",
            json!({"regular": {"solid": "prism", "size_m": 0.04}}),
            "/bodies/0/shape/regular/solid",
            "\"tetrahedron\" or \"cube\"",
        ),
        (
            "regular without solid",
            "/bodies/0/shape",
            json!({"regular": {"size_m": 0.04}}),
            "/bodies/0/shape/regular/solid",
            "\"icosahedron\"",
        ),
        (
            "regular without size",
            "/bodies/0/shape",
            json!({"regular": {"solid": "cube"}}),
            "/bodies/0/shape/regular/size_m",
            "0.0001 <= x",
        ),
        (
            "polyhedron without vertices",
            "/bodies/0/shape",
            json!({"polyhedron": {}}),
            "/bodies/0/shape/polyhedron/vertices_m",
            "4 to 32 points",
        ),
        (
            "triangle",
            "/bodies/0/shape",
            json!({"polyhedron": {"vertices_m": [[0, 0, 0], [1, 0, 0], [0, 1, 0]]}}),
            "/bodies/0/shape/polyhedron/vertices_m",
            "4 to 32 points",
        ),
        (
            "too many vertices",
            "/bodies/0/shape",
            json!({"polyhedron": {"vertices_m": vec![[0.0; 3]; 33]}}),
            "/bodies/0/shape/polyhedron/vertices_m",
            "4 to 32 points",
        ),
        (
            "vertex in a plane",
            "/bodies/0/shape",
            json!({"polyhedron": {"vertices_m": [[0, 0, 0], [1, 0, 0], [0, 1], [0, 0, 1]]}}),
            "/bodies/0/shape/polyhedron/vertices_m/2",
            "a list of 3 numbers",
        ),
        (
            "vertex far off",
            "/bodies/0/shape",
            json!({"polyhedron": {"vertices_m": [[0, 0, 0], [1, 0, 0], [0, 101, 0], [0, 0, 1]]}}),
            "/bodies/0/shape/polyhedron/vertices_m/2/1",
            "x <= 100",
        ),
        (
            "flat polyhedron",
            "/bodies/0/shape",
            json!({"polyhedron": {"vertices_m": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]}}),
            "/bodies/0/shape/polyhedron/vertices_m",
            "holds a ball",
        ),
        (
            "polyhedron of a micrometre",
            "/bodies/0/shape",
            json!({"polyhedron": {"vertices_m": [[0, 0, 0], [0.01, 0, 0], [0, 0.01, 0], [0, 0, 1e-6]]}}),
            "/bodies/0/shape/polyhedron/vertices_m",
            "holds a ball of 2e-5 m",
        ),
        (
            "tetrahedron rounded away",
            "/bodies/0",
            json!({"shape": {"regular": {"solid": "tetrahedron", "size_m": 0.04}}, "sphero_radius_m": 0.01}),
            "/bodies/0/sphero_radius_m",
            "0 < x < 0.0081",
        ),
        (
            "ball without radius",
            "/bodies/0/shape",
            json!({"ball": {}}),
            "/bodies/0/shape/ball/radius_m",
            "5e-5 <= x <= 50",
        ),
        (
            "ball with a diameter",
            "/bodies/0/shape",
            json!({"ball": {"radius_m": 0.02, "diameter_m": 0.04}}),
            "/bodies/0/shape/ball/diameter_m",
            "one of: radius_m",
        ),
        (
            "ball rounded by another radius",
            "/bodies/0",
            json!({"shape": {"ball": {"radius_m": 0.02}}, "sphero_radius_m": 0.002}),
            "/bodies/0/sphero_radius_m",
            "0.02, or left out",
        ),
        (
            "capsule without length",
            "/bodies/0/shape",
            json!({"capsule": {"radius_m": 0.02}}),
            "/bodies/0/shape/capsule/length_m",
            "0.0001 <= x <= 100",
        ),
        (
            "capsule no longer than a ball",
            "/bodies/0/shape",
            json!({"capsule": {"radius_m": 0.02, "length_m": 0.04}}),
            "/bodies/0/shape/capsule/length_m",
            "0.04 < x <= 100",
        ),
        (
            "capsule rounded by another radius",
            "/bodies/0",
            json!({"shape": {"capsule": {"radius_m": 0.01, "length_m": 0.04}}, "sphero_radius_m": 0.02}),
            "/bodies/0/sphero_radius_m",
            "0.01, or left out",
        ),
        (
            "cube without side",
            "/bodies/0/shape/cube",
            json!({}),
            "/bodies/0/shape/cube/side_m",
            "0.0001 <= x",
        ),
    ]);
}

#[test]
fn required_fields() {
    let required = [
        "/channel",
        "/channel/inclination_deg",
        "/channel/incline_length_m",
        "/channel/runout_length_m",
        "/flow",
        "/flow/volume_m3",
        "/bodies",
        "/bodies/0/shape",
    ];
    for pointer in required {
        let mut scenario = minimal();
        let (parent, key) = pointer.rsplit_once('/').unwrap();
        scenario
            .pointer_mut(parent)
            .unwrap()
            .as_object_mut()
            .unwrap()
            .remove(key);
        let found = refused(&scenario);
        assert_eq!(found.len(), 1, "{found:#?}");
        assert_eq!(
            (found[0].pointer.as_str(), &found[0].value),
            (pointer, &Value::Null)
        );
        assert!(found[0].detail.contains("missing"));
    }
    assert_eq!(refused(&json!({})).len(), 3);
    assert_eq!(refused(&json!([]))[0].pointer, "");
}
