//! Fields of a scenario in the contract: what may be left out says what it is then, and every number
//! has its range.

use serde_json::Value;
use std::collections::BTreeSet;

#[test]
fn every_scenario_field_states_its_default_and_its_range() {
    let contract: Value = serde_json::from_str(&scree::http::openapi().to_json().unwrap()).unwrap();
    let schemas = &contract["components"]["schemas"];
    let (mut seen, mut ahead) = (BTreeSet::new(), vec!["Scenario".to_owned()]);
    while let Some(name) = ahead.pop() {
        let schema = &schemas[&name];
        check(&name, schema);
        seen.insert(name);
        let new = references(schema)
            .into_iter()
            .filter(|name| !seen.contains(name));
        ahead.extend(new);
    }
    assert!(
        seen.contains("Numerics") && seen.contains("Motion"),
        "{seen:?}"
    );
}

/// Checks the properties of an object, or of all that a schema lets choose from.
fn check(name: &str, schema: &Value) {
    for choice in schema["oneOf"].as_array().into_iter().flatten() {
        check(name, choice);
    }
    let required = schema["required"].as_array();
    for (key, property) in schema["properties"].as_object().into_iter().flatten() {
        let is_required = required.is_some_and(|keys| keys.iter().any(|of| of == key));
        let about = property["description"].as_str().unwrap_or_default();
        let has_default = property.get("default").is_some() || about.contains("Default: ");
        assert!(is_required || has_default, "{name}.{key} has no default");
        if is_number(property) {
            let low = ["minimum", "exclusiveMinimum"];
            let is_bounded = low.iter().any(|low| property.get(low).is_some());
            assert!(
                is_bounded && property.get("maximum").is_some(),
                "{name}.{key}"
            );
        }
    }
}

fn is_number(property: &Value) -> bool {
    let kinds = property["type"].as_array();
    let mut kinds = kinds.map_or(vec![&property["type"]], |kinds| kinds.iter().collect());
    kinds.retain(|kind| *kind == "number" || *kind == "integer");
    !kinds.is_empty()
}

/// Names of the schemas that a schema refers to.
fn references(schema: &Value) -> Vec<String> {
    let text = schema.to_string();
    let names = text.split("\"#/components/schemas/").skip(1);
    let names = names.filter_map(|rest| rest.split('"').next());
    names.map(ToOwned::to_owned).collect()
}
