//! The reference of keys and the schema match the types that read a config.

use super::bad_input::{CONFIGS, GOOD, RIDES};
use super::{liftsim, outcome, project};
use std::fs;

fn printed(arguments: &[&str]) -> String {
    let (code, text, _) = outcome(liftsim().arg("keys").args(arguments));
    assert_eq!(code, 0);
    text
}

fn committed(name: &str) -> String {
    fs::read_to_string(project().join("configs").join(name)).unwrap()
}

#[test]
fn reference_and_schema_are_in_step() {
    let remedy = "liftsim keys > configs/README.md; liftsim keys --schema > configs/schema.json";
    assert_eq!(committed("README.md"), printed(&[]), "{remedy}");
    assert_eq!(committed("schema.json"), printed(&["--schema"]), "{remedy}");
}

fn validator() -> jsonschema::Validator {
    let schema = serde_json::from_str(&committed("schema.json")).unwrap();
    jsonschema::validator_for(&schema).unwrap()
}

fn json(text: &str) -> Option<serde_json::Value> {
    let table: toml::Table = text.parse().ok()?;
    serde_json::to_value(table).ok()
}

#[test]
fn every_shipped_config_names_the_schema_and_keeps_it() {
    let validator = validator();
    let mut configs = 0;
    for entry in fs::read_dir(project().join("configs")).unwrap() {
        let path = entry.unwrap().path();
        if path
            .extension()
            .is_some_and(|extension| extension == "toml")
        {
            let text = fs::read_to_string(&path).unwrap();
            let first = text.lines().next();
            assert_eq!(first, Some("#:schema ./schema.json"), "{}", path.display());
            let errors = validator
                .iter_errors(&json(&text).unwrap())
                .map(|e| e.to_string())
                .collect::<Vec<_>>();
            assert!(errors.is_empty(), "{}: {errors:?}", path.display());
            configs += 1;
        }
    }
    assert!(configs > 30);
}

/// Configs that the schema accepts and the program refuses: they break rules between values, which a schema
/// cannot express.
#[test]
fn broken_configs_are_refused_where_a_schema_can() {
    let validator = validator();
    let passes = |body: &str| json(body).is_some_and(|json| validator.is_valid(&json));
    let ride = |body: &&str| passes(&format!("{GOOD}[ride]\n{body}"));
    let mut passed = String::new();
    for (name, body) in CONFIGS
        .iter()
        .filter(|(_, body)| passes(&format!("{GOOD}{body}")))
    {
        assert!(!body.is_empty());
        passed += &format!("{name}\n");
    }
    for (name, _) in RIDES.iter().filter(|(_, body)| ride(body)) {
        passed += &format!("ride: {name}\n");
    }
    insta::assert_snapshot!(passed);
}
