//! Agreement of `docs/scenario.md` and of the table of fields with the readers.

use super::{accepted, maps, minimal, minimal_on_terrain, with};
use crate::scenario::duration::WITHOUT_FLOW;
use crate::scenario::fields::{Default, Field, GroundKind, Kind, SECTIONS};
use crate::scenario::rules::*;
use crate::scenario::schema::{SHORTEST, default};
use crate::scenario::shape::{POLYHEDRON_VERTICES, SHAPES};
use crate::scenario::{Scenario, ScenarioError, Violation};
use serde_json::{Value, json};

const DOCUMENT: &str = include_str!("../../../../docs/scenario.md");

/// A scenario with every field on this ground, and a motion by a table.
fn filled(ground: GroundKind) -> Value {
    let shortest = match ground {
        GroundKind::Channel => minimal(),
        GroundKind::Terrain => minimal_on_terrain(),
    };
    let mut filled = serde_json::to_value(accepted(&shortest)).unwrap();
    let velocities = json!([[0.0, 0.0, 0.0], [0.1, 0.0, 0.0]]);
    filled["bodies"][0]["motion"] = json!({
        "times_s": [0.0, 1.0], "velocity_m_s": velocities, "angular_velocity_rad_s": velocities,
    });
    filled
}

/// Every field of the table with its JSON pointer in the filled scenario of a ground that has it.
fn fields() -> impl Iterator<Item = (String, &'static Field, GroundKind)> {
    SECTIONS.iter().flat_map(|section| {
        let path = section.path.replace("[]", ".0").replace('.', "/");
        let pointer = move |field: &Field| format!("/{path}{}", field.key);
        section.fields.iter().map(move |field| {
            let of_section = match section.schema {
                "Terrain" | "TerrainRelease" => GroundKind::Terrain,
                _ => GroundKind::Channel,
            };
            (pointer(field), field, field.ground.unwrap_or(of_section))
        })
    })
}

fn violations(document: &Value) -> Vec<Violation> {
    match Scenario::from_value_with(document, &maps()) {
        Err(ScenarioError::Invalid(violations)) => violations,
        _ => Vec::new(),
    }
}

/// True if a violation is about a field, or an entry of its list.
fn refused(document: &Value, pointer: &str) -> bool {
    let found = violations(document);
    found.iter().any(|one| one.pointer.starts_with(pointer))
}

fn without(pointer: &str, ground: GroundKind) -> Value {
    let mut document = filled(ground);
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    let parent = document.pointer_mut(parent).unwrap();
    parent.as_object_mut().unwrap().remove(key);
    document
}

/// The filled scenario with another number in a field, in a list the first.
fn with_number(pointer: &str, ground: GroundKind, value: f64) -> Value {
    let mut document = filled(ground);
    let mut place = document.pointer_mut(pointer).unwrap();
    if pointer == "/bodies/0/orientation" {
        *place = json!([1.0, 0.0, 0.0, 0.0]);
    }
    while place.is_array() {
        place = &mut place[0];
    }
    *place = json!(value);
    document
}

#[test]
fn every_field_is_in_the_table() {
    fn keys(value: &Value, pointer: &str, found: &mut Vec<String>) {
        let Value::Object(members) = value else {
            return;
        };
        for (key, member) in members {
            let pointer = format!("{pointer}/{key}");
            if key != "shape" {
                keys(member, &pointer, found);
            }
            if let Some(first) = member.as_array().and_then(|items| items.first()) {
                keys(first, &format!("{pointer}/0"), found);
            }
            found.push(pointer);
        }
    }
    let mut found = Vec::new();
    for ground in [GroundKind::Channel, GroundKind::Terrain] {
        keys(&filled(ground), "", &mut found);
    }
    let mut listed: Vec<String> = fields().map(|(pointer, ..)| pointer).collect();
    found.sort();
    found.dedup();
    listed.sort();
    assert_eq!(found, listed);
}

#[test]
fn numbers_are_read_by_their_ranges() {
    for (pointer, field, ground) in fields() {
        let Some(rule) = field.rule() else {
            continue;
        };
        let beyond = rule.range.high.abs() * 2.0 + 1.0;
        let mut values = vec![beyond, -beyond];
        if rule.range.low_is_open {
            values.push(rule.range.low);
        }
        if matches!(field.kind, Kind::Whole(_)) {
            values.push(rule.range.low + 0.5);
        }
        for value in values {
            let document = with_number(&pointer, ground, value);
            assert!(refused(&document, &pointer), "{pointer}: {value}");
        }
        // Other rules than those of the number may still refuse its ends.
        for value in [rule.range.high, rule.range.low] {
            let outside = format!("outside {}", rule.range.words());
            let found = violations(&with_number(&pointer, ground, value));
            let of_range = found.iter().find(|one| one.detail.contains(&outside));
            let end_is_open = rule.range.low_is_open && value == rule.range.low;
            assert_eq!(of_range.is_some(), end_is_open, "{pointer}: {value}");
        }
    }
}

#[test]
fn fields_left_out_have_their_defaults() {
    let mut constants = 0;
    for (pointer, field, ground) in fields() {
        let document = without(&pointer, ground);
        let missing = refused(&document, &pointer);
        // Without its times a table is none.
        let needed = matches!(field.kind, Kind::List(..)) || field.default == Default::Required;
        assert_eq!(missing, needed, "{pointer}");
        if let Some(value) = default(field) {
            let read = serde_json::to_value(accepted(&document)).unwrap();
            let read = read.pointer(&pointer).unwrap();
            assert_eq!(read, &value, "{pointer}");
            constants += 1;
        }
    }
    assert!(constants > 25, "{constants}");
    assert!(DOCUMENT.contains(&format!("; {WITHOUT_FLOW} without a flow |")));
}

/// Cells of the document's row about a field.
fn row(field: &str) -> [&'static str; 5] {
    let start = format!("| `{field}` |");
    let mut lines = DOCUMENT.lines().filter(|line| line.starts_with(&start));
    let line = lines
        .next()
        .unwrap_or_else(|| panic!("no row about {field}"));
    assert_eq!(lines.next(), None, "two rows about {field}");
    let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
    cells
        .try_into()
        .unwrap_or_else(|_| panic!("five cells about {field}"))
}

#[test]
fn counts_are_those_of_the_code() {
    assert!(row("title")[4].contains(&TITLE_LENGTH.to_string()));
    assert!(row("bodies")[4].contains(&BODIES.to_string()));
    assert!(row("sample_interval_s")[4].contains("500,000") && BODY_SAMPLES == 500_000.0);
    assert!(DOCUMENT.contains("more than 80,000 JSON values") && VALUES == 80_000);
    assert!(DOCUMENT.contains("Of more than 500,") && VIOLATIONS == 500);
    assert!(row("bodies[].orientation")[4].contains(&format!("within {QUATERNION_SLACK}")));
    assert!(DOCUMENT.contains("a thousandth of the sphero radius") && TOUCHING == 1e-3);
    let (least, most) = (POLYHEDRON_VERTICES.start(), POLYHEDRON_VERTICES.end());
    let points = format!("{least} to {most} points");
    assert!(row("bodies[].shape.polyhedron.vertices_m")[4].contains(&points));
    let times = format!("{} to {} times", MOTION_TIMES.start(), MOTION_TIMES.end());
    assert!(row("bodies[].motion.times_s")[4].contains(&times));
    assert!(row("bodies[].sphero_radius_m")[3].contains("1/20") && SIZE_PER_SPHERO_RADIUS == 20.0);
}

#[test]
fn every_shape_is_described() {
    for kind in &SHAPES {
        let name = format!("**{}**", kind.name);
        assert!(DOCUMENT.contains(&name), "{name}");
    }
}

#[test]
fn the_example_is_legal() {
    let start = DOCUMENT.find("```json").expect("an example") + "```json".len();
    let length = DOCUMENT[start..].find("```").expect("its end");
    let example = Scenario::from_json(&DOCUMENT[start..start + length]);
    assert_eq!(example, Ok(accepted(&minimal())));
    assert!(DOCUMENT.contains(SHORTEST), "the contract has another one");
}

#[test]
fn the_polyhedron_of_the_example_is_legal() {
    let start = DOCUMENT.rfind("```json").expect("an example") + "```json".len();
    let length = DOCUMENT[start..].find("```").expect("its end");
    let body: Value = serde_json::from_str(&DOCUMENT[start..start + length]).unwrap();
    accepted(&with("/bodies/0", body));
}
