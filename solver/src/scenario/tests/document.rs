//! Agreement of `docs/scenario.md` with the code.

use super::{accepted, minimal, with};
use crate::scenario::accuracy::QUANTITIES;
use crate::scenario::duration::LEAST;
use crate::scenario::range::Rule;
use crate::scenario::reader::choice_words;
use crate::scenario::rules::*;
use crate::scenario::sections::{APPROACHES, ENDINGS, PRECISIONS, SYMMETRIES};
use crate::scenario::shape::{POLYHEDRON_VERTICES, REGULAR_SOLIDS, SHAPES, ShapeField};
use serde_json::Value;

const DOCUMENT: &str = include_str!("../../../../docs/scenario.md");

/// Every rule and its object.
const RULES: [(&str, &[Rule]); 10] = [
    ("", &[GRAVITY, DURATION, SAMPLE_INTERVAL, FLOW_SNAPSHOTS]),
    (
        "channel.",
        &[
            INCLINATION,
            INCLINE_LENGTH,
            RUNOUT_LENGTH,
            WIDTH,
            BASE_FRICTION,
            SIDE_FRICTION,
        ],
    ),
    ("flow.", &[VOLUME]),
    ("flow.release.", &[RELEASE_HEIGHT, TOE_DISTANCE]),
    (
        "flow.material.",
        &[
            BULK_DENSITY,
            GRAIN_DENSITY,
            GRAIN_DIAMETER,
            STATIC_FRICTION,
            LIMITING_FRICTION,
            INERTIAL_NUMBER,
            POISSONS_RATIO,
            YOUNGS_MODULUS,
        ],
    ),
    (
        "bodies[].",
        &[
            SPHERO_RADIUS,
            BODY_DENSITY,
            YAW,
            ORIENTATION,
            VELOCITY,
            ANGULAR_VELOCITY,
            FRICTION,
            RESTITUTION,
            ROLLING_FRICTION,
            FLOW_FRICTION,
            FLOW_RESTITUTION,
            CONTACT_MODULUS,
        ],
    ),
    ("bodies[].position.", &[DOWNSTREAM, LATERAL, ELEVATION]),
    (
        "bodies[].motion.",
        &[MOTION_TIME, VELOCITY, ANGULAR_VELOCITY],
    ),
    (
        "numerics.",
        &[
            CELL_SIZE,
            POINTS_PER_CELL,
            SOUND_SPEED,
            COURANT,
            FLOW_COURANT,
            THREADS,
        ],
    ),
    ("accuracy.", &[TARGET, TARGET_BODY, BUDGET]),
];

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
fn ranges_and_units_are_those_of_the_code() {
    let rules_of = RULES
        .iter()
        .map(|(object, rules)| (String::from(*object), rules.to_vec()));
    let of_shapes = SHAPES.iter().map(|kind| {
        let rules = kind.fields.iter().filter_map(ShapeField::rule);
        (format!("bodies[].shape.{}.", kind.name), rules.collect())
    });
    for (object, rules) in rules_of.chain(of_shapes) {
        for rule in &rules {
            let [_, _, unit, _, allowed] = row(&format!("{object}{}", rule.key));
            assert_eq!(unit, rule.unit.unwrap_or("–"), "{object}{}", rule.key);
            let words = rule.range.words();
            let rest = allowed.strip_prefix(&words);
            let ends = rest
                .is_some_and(|rest| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '.'));
            assert!(ends, "{object}{}: {allowed} is not {words}", rule.key);
        }
    }
}

/// Every leaf of the filled scenario, by the name the document gives it.
fn leaves(value: &Value, name: &str, found: &mut Vec<(String, Value)>) {
    match value {
        Value::Object(members) => {
            for (key, member) in members {
                let dot = if name.is_empty() { "" } else { "." };
                leaves(member, &format!("{name}{dot}{key}"), found);
            }
        }
        Value::Array(items) if items.iter().any(Value::is_object) => {
            leaves(&items[0], &format!("{name}[]"), found);
        }
        leaf => found.push((name.to_owned(), leaf.clone())),
    }
}

#[test]
fn every_field_is_described_with_its_default() {
    let filled = serde_json::to_value(accepted(&minimal())).unwrap();
    let mut fields = Vec::new();
    leaves(&filled, "", &mut fields);
    let mut constants = 0;
    for (field, value) in &fields {
        let [_, meaning, _, default, _] = row(field);
        assert!(!meaning.is_empty());
        if let Some(json) = default.strip_prefix('`') {
            let documented: Value = serde_json::from_str(json.trim_end_matches('`')).unwrap();
            assert_eq!(&documented, value, "{field}");
            constants += 1;
        }
    }
    // All but the five required numbers, the two that follow the side, and the
    // duration.
    assert_eq!(constants, fields.len() - 8);
    assert!(row("duration_s")[3].starts_with(&format!("{LEAST}, or")));
}

#[test]
fn counts_are_those_of_the_code() {
    assert!(row("title")[4].contains(&TITLE_LENGTH.to_string()));
    assert!(row("bodies")[4].contains(&BODIES.to_string()));
    assert!(row("sample_interval_s")[4].contains("500,000") && BODY_SAMPLES == 500_000.0);
    assert!(DOCUMENT.contains("more than 20,000 JSON values") && VALUES == 20_000);
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
fn every_shape_is_documented() {
    let names: Vec<&str> = SHAPES.iter().map(|kind| kind.name).collect();
    let words = format!("exactly one of: {}", names.join(", "));
    assert_eq!(row("bodies[].shape")[4], words);
    for kind in &SHAPES {
        for field in kind.fields {
            let [_, meaning, ..] = row(&format!("bodies[].shape.{}.{}", kind.name, field.key()));
            assert!(!meaning.is_empty());
        }
        assert!(
            DOCUMENT.contains(&format!("**{}**", kind.name)),
            "{}",
            kind.name
        );
    }
}

#[test]
fn words_are_those_of_the_code() {
    let [_, _, unit, _, allowed] = row("numerics.precision");
    assert_eq!(unit, "–");
    assert_eq!(allowed.replace('`', ""), choice_words(&PRECISIONS));
    let allowed = |field| row(field)[4].replace('`', "");
    assert_eq!(allowed("numerics.symmetry"), choice_words(&SYMMETRIES));
    assert_eq!(allowed("numerics.approach"), choice_words(&APPROACHES));
    assert_eq!(allowed("numerics.ending"), choice_words(&ENDINGS));
    let [_, _, unit, _, allowed] = row("bodies[].shape.regular.solid");
    assert_eq!(unit, "–");
    assert_eq!(allowed.replace('`', ""), choice_words(&REGULAR_SOLIDS));
    let [_, _, unit, _, allowed] = row("accuracy.quantity");
    assert_eq!(unit, "–");
    assert_eq!(allowed.replace('`', ""), choice_words(&QUANTITIES));
}

#[test]
fn the_example_is_legal() {
    let start = DOCUMENT.find("```json").expect("an example") + "```json".len();
    let length = DOCUMENT[start..].find("```").expect("its end");
    let example = crate::scenario::Scenario::from_json(&DOCUMENT[start..start + length]);
    assert_eq!(example, Ok(accepted(&minimal())));
}

#[test]
fn the_polyhedron_of_the_example_is_legal() {
    let start = DOCUMENT.rfind("```json").expect("an example") + "```json".len();
    let length = DOCUMENT[start..].find("```").expect("its end");
    let body: Value = serde_json::from_str(&DOCUMENT[start..start + length]).unwrap();
    accepted(&with("/bodies/0", body));
}
