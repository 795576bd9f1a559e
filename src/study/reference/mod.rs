//! The reference of all tables and keys, generated from the types that read them: a JSON Schema for editors,
//! and the same reference in words.

mod words;

pub use words::{Chapter, Key, Table, config, matching, monitor_options, sections, table};

use super::STUDIES;
use crate::claim::Narrative;
use crate::experiment::schema::properties;
use crate::experiment::{CurveHeader, Header};
use crate::scenario::Sections;
use schemars::SchemaGenerator;
use schemars::generate::SchemaSettings;
use serde_json::{Value, json};

/// The JSON Schema of a config.
pub fn schema() -> Value {
    let mut generator = generator();
    let sections = properties::<Sections>(&mut generator);
    let mut all = properties::<Header>(&mut generator);
    all.extend(properties::<Narrative>(&mut generator));
    let mut curve = properties::<CurveHeader>(&mut generator);
    curve.extend(sections.clone());
    let description = "One curve of a sweep; each may change any of the sections.";
    let curve = json!({
        "type": "object",
        "properties": curve,
        "additionalProperties": false,
    });
    all.insert(
        "curve".to_owned(),
        json!({ "description": description, "type": "array", "items": curve }),
    );
    for study in STUDIES {
        all.insert(study.name.to_owned(), (study.schema)(&mut generator));
    }
    let one_thing = STUDIES.iter();
    let one_thing = one_thing.map(|study| json!({ "required": [study.name] }));
    let one_thing: Vec<Value> = one_thing.collect();
    all.extend(sections);
    let mut all = Value::Object(all);
    allow_bare_names(&mut all);
    json!({
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "A liftsim config",
        "type": "object",
        "properties": all,
        "required": ["question", "seed"],
        "oneOf": one_thing,
        "additionalProperties": false,
    })
}

/// A choice with only optional parameters may be written as its name alone.
fn allow_bare_names(schema: &mut Value) {
    if let Some(Value::Array(choices)) = schema.get_mut("oneOf") {
        let bare: Vec<Value> = choices.iter().filter_map(bare_name).collect();
        choices.extend(bare);
    }
    match schema {
        Value::Object(entries) => entries.values_mut().for_each(allow_bare_names),
        Value::Array(entries) => entries.iter_mut().for_each(allow_bare_names),
        _ => (),
    }
}

fn bare_name(choice: &Value) -> Option<Value> {
    let name = choice["required"][0].as_str()?;
    let parameters = &choice["properties"][name];
    let none_is_required = parameters["required"].is_null();
    (parameters["type"] == "object" && none_is_required).then(|| json!({ "const": name }))
}

fn generator() -> SchemaGenerator {
    SchemaSettings::draft07()
        .with(|settings| settings.inline_subschemas = true)
        .into_generator()
}
