//! The study document.

use crate::support::{document, study};
use scree_studies::{Member, Study};
use serde_json::{Value, json};

#[test]
fn a_document_comes_back_as_it_went_in() {
    let given = document();
    let study = study(&given);
    assert_eq!(study.violations(), []);
    assert_eq!(serde_json::to_value(&study).unwrap(), given);
    let text = serde_json::to_string(&study).unwrap();
    assert_eq!(serde_json::from_str::<Study>(&text).unwrap(), study);
}

#[test]
fn every_distribution_and_design_comes_back_as_it_went_in() {
    let distributions = json!([
        {"uniform": {"from": 0.1, "to": 0.2}},
        {"normal": {"mean": 1.0, "sd": 0.1}},
        {"normal": {"mean": 1.0, "sd": 0.1, "truncate": {"from": 0.9, "to": 1.3}}},
        {"lognormal": {"median": 1.0, "p95": 2.0}},
        {"triangular": {"from": 0.0, "mode": 0.5, "to": 1.0}},
        {"choice": {"values": [{"value": {"shape": "cube"}, "weight": 1.0},
                               {"value": null, "weight": 2.5}]}},
        {"list": {"values": [1, 2.5, -3]}}
    ]);
    for given in distributions.as_array().unwrap() {
        let read: scree_studies::Distribution = serde_json::from_value(given.clone()).unwrap();
        assert_eq!(&serde_json::to_value(&read).unwrap(), given);
    }
    let designs = json!([
        {"sobol": {"members": 256, "seed": 1}},
        {"latin_hypercube": {"members": 100, "seed": 1}},
        {"full_factorial": {"levels": 3}},
        {"full_factorial": {"levels": [3, 2]}},
        {"morris": {"trajectories": 10, "levels": 4, "seed": 1}},
        {"saltelli": {"base_members": 64, "seed": 18446744073709551615_u64}},
        {"one_at_a_time": {"levels": 5}},
        {"explicit": {"members": [[0.1, "cube"], [0.2, {"shape": "ball"}]]}}
    ]);
    for given in designs.as_array().unwrap() {
        let read: scree_studies::Design = serde_json::from_value(given.clone()).unwrap();
        assert_eq!(&serde_json::to_value(&read).unwrap(), given);
    }
}

#[test]
fn an_unknown_key_is_refused_at_every_object_but_the_scenario() {
    let mut seen = 0;
    for pointer in objects(&document(), "") {
        let mut given = document();
        let object = given.pointer_mut(&pointer).unwrap();
        object["sort_of"] = json!(1);
        let read = serde_json::from_value::<Study>(given);
        if pointer.starts_with("/scenario") {
            assert!(read.is_ok(), "{pointer}");
        } else {
            assert!(read.is_err(), "{pointer}");
            seen += 1;
        }
    }
    assert!(seen > 20, "{seen}");
}

/// Pointers of all objects within a value.
fn objects(value: &Value, pointer: &str) -> Vec<String> {
    let children: Vec<(String, &Value)> = match value {
        Value::Object(object) => object.iter().map(|(key, one)| (key.clone(), one)).collect(),
        Value::Array(array) => {
            let indexed = array.iter().enumerate();
            indexed
                .map(|(index, one)| (index.to_string(), one))
                .collect()
        }
        _ => return Vec::new(),
    };
    let below = children.into_iter();
    let below = below.flat_map(|(key, child)| objects(child, &format!("{pointer}/{key}")));
    let own = value.is_object().then(|| pointer.to_owned());
    own.into_iter().chain(below).collect()
}

#[test]
fn what_may_be_left_out_has_its_default() {
    let short = json!({
        "scenario": {},
        "inputs": [{"pointer": "/a"}],
        "design": {"explicit": {"members": [[1]]}}
    });
    let study = study(&short);
    assert_eq!(study.violations(), []);
    assert!(study.correlations.is_empty() && study.questions.is_empty());
    assert!(study.stop.is_none() && study.title.is_empty());
}

#[test]
fn a_member_comes_back_as_it_went_in() {
    let given = json!([
        {"index": 0, "outcome": {"finished": {
            "quantities": {"runout_m": 1.5},
            "bodies": [{"rest_m": [1.0, 0.1, 0.02], "moving": false, "hit": true,
                        "buried_m": 0.0, "quantities": {"displacement_m": 0.3}}]}}},
        {"index": 1, "outcome": {"failed": {"reason": "diverged"}}},
        {"index": 2, "outcome": "pending"}
    ]);
    let read: Vec<Member> = serde_json::from_value(given.clone()).unwrap();
    assert_eq!(serde_json::to_value(&read).unwrap(), given);
}

#[cfg(feature = "schema")]
#[test]
fn the_schema_names_every_part_of_a_study_and_its_answers() {
    use utoipa::ToSchema;
    let mut schemas = Vec::new();
    Study::schemas(&mut schemas);
    scree_studies::Answers::schemas(&mut schemas);
    let mut names: Vec<String> = schemas.into_iter().map(|(name, _)| name).collect();
    names.sort();
    names.dedup();
    for name in [
        "Distribution",
        "StudyQuestion",
        "SobolDesign",
        "StudyAnswer",
        "Region",
    ] {
        assert!(
            names.iter().any(|one| one == name),
            "{name} is not in {names:?}"
        );
    }
}
