//! The reference of all tables and keys, generated from the types that read them: a JSON Schema for editors,
//! and the same reference in words.

use super::STUDIES;
use crate::claim::Narrative;
use crate::detection::RecordingTable;
use crate::experiment::schema::properties;
use crate::experiment::{CurveHeader, Header};
use crate::monitor::Settings;
use crate::scenario::Sections;
use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, SchemaGenerator};
use serde_json::{Map, Value, json};
use std::fmt::Write;

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

/// The reference in words, as Markdown.
pub fn markdown() -> String {
    let schema = schema();
    let empty = Map::new();
    let all = schema["properties"].as_object().unwrap_or(&empty);
    let mut text = HEAD.to_owned();
    let plain: Vec<_> = all.iter().filter(|(_, schema)| !is_table(schema)).collect();
    text += &keys("the top of the file", "", plain.into_iter());
    for (name, schema) in all.iter().filter(|(_, schema)| is_table(schema)) {
        let is_list = schema["items"].is_object();
        let (table, title) = if is_list {
            (&schema["items"], format!("[[{name}]]"))
        } else {
            (schema, format!("[{name}]"))
        };
        let description = schema["description"].as_str().unwrap_or_default();
        // A curve has the same sections as the file.
        let own = own_keys(table);
        let is_own = |key: &String| name != "curve" || !all.contains_key(key);
        let entries = own.iter().filter(|(key, _)| is_own(key));
        text += &keys(&title, description, entries);
    }
    text + &monitor_options()
}

/// A table, a list of them, or a choice between tables.
fn is_table(schema: &Value) -> bool {
    let choices = schema["oneOf"].as_array();
    schema["type"] == "object"
        || schema["items"]["type"] == "object"
        || choices.is_some_and(|choices| choices.iter().all(|choice| choice["type"] == "object"))
}

/// The keys of a table, or of all its alternatives. Each key of a choice has the meaning of the choice.
fn own_keys(table: &Value) -> Map<String, Value> {
    let own = table["properties"].as_object().cloned().unwrap_or_default();
    let choices = table["oneOf"].as_array().into_iter().flatten();
    let of_choices = choices.flat_map(|choice| {
        let keys = own_keys(choice).into_iter();
        keys.map(|(key, mut schema)| {
            schema["description"] = choice["description"].clone();
            (key, schema)
        })
    });
    own.into_iter().chain(of_choices).collect()
}

/// The file of `detect --config` and `monitor --config`.
fn monitor_options() -> String {
    let mut text = "# Keys of `detect --config` and `monitor --config`\n\n\
        Whatever is left out of `[recording]` is found in the file; sizes are in blocks.\n\n"
        .to_owned();
    text += &table::<RecordingTable>("[recording]", "How the recording is read.");
    for (name, schema) in &properties::<Settings>(&mut generator()) {
        let description = schema["description"].as_str().unwrap_or_default();
        text += &keys(&format!("[{name}]"), description, own_keys(schema).iter());
    }
    text
}

/// The keys of a type in words, under a heading of their own.
pub fn table<T: JsonSchema>(title: &str, description: &str) -> String {
    let properties = properties::<T>(&mut generator());
    keys(title, description, properties.iter())
}

fn generator() -> SchemaGenerator {
    SchemaSettings::draft07()
        .with(|settings| settings.inline_subschemas = true)
        .into_generator()
}

const HEAD: &str = "# Keys of a config\n\n\
    Written by `liftsim keys` from the types that read a config; `schema.json` beside this file says the same to an \
    editor. A config does one thing: `[axis]` and `[[curve]]` sweep a parameter, any other table of a study takes \
    their place. An unknown key is refused. Units are those of the whitened noise, σ_ξ, unless a key says otherwise.\n\n";

fn keys<'a>(
    title: &str,
    description: &str,
    entries: impl Iterator<Item = (&'a String, &'a Value)>,
) -> String {
    let mut text = format!("## {title}\n\n");
    if !description.is_empty() {
        text += &format!("{}\n\n", one_line(description));
    }
    text += "| key | type | default | meaning |\n|---|---|---|---|\n";
    for (key, schema) in entries {
        let meaning = one_line(schema["description"].as_str().unwrap_or_default());
        let meaning = format!("{meaning}{}", choices(schema));
        let default = match &schema["default"] {
            Value::Null | Value::Object(_) => String::new(),
            value => format!("`{value}`"),
        };
        let kind = kind(schema).replace('|', "\\|");
        writeln!(text, "| `{key}` | {kind} | {default} | {meaning} |")
            .expect("a string takes every line");
    }
    text + "\n"
}

fn one_line(text: &str) -> String {
    text.split_whitespace()
        .collect::<Vec<_>>()
        .join(" ")
        .replace('|', "\\|")
}

/// The meaning of each of several names, if the schema gives it.
fn choices(schema: &Value) -> String {
    let choices = schema["oneOf"].as_array().into_iter().flatten();
    let said: Vec<String> = choices
        .filter_map(|choice| {
            let key = choice["required"][0].as_str();
            let name = choice["const"].as_str().or(key)?;
            let meaning = one_line(choice["description"].as_str()?);
            Some(format!("`{name}`: {}", meaning.trim_end_matches('.')))
        })
        .collect();
    if said.is_empty() {
        String::new()
    } else {
        format!(" {}.", said.join("; "))
    }
}

/// The form of a value, in words.
fn kind(schema: &Value) -> String {
    // An axis takes one value or several. Its table says so once.
    if let Some(items) = schema["anyOf"][0].get("items") {
        return kind(items);
    }
    for key in ["anyOf", "oneOf"] {
        if let Some(choices) = schema[key].as_array() {
            let choices: Vec<String> = choices
                .iter()
                .map(kind)
                .filter(|kind| kind != "null")
                .collect();
            return choices.join(", ");
        }
    }
    if let Some(value) = schema.get("const") {
        return format!("`{value}`");
    }
    if let Some(names) = schema["enum"].as_array() {
        let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
        return names.join(", ");
    }
    let name = match &schema["type"] {
        Value::Array(types) => types.iter().find(|kind| *kind != "null"),
        name => Some(name),
    };
    match name.and_then(Value::as_str) {
        Some("array") => {
            if schema["items"].is_null() {
                "list".to_owned()
            } else {
                format!("list of: {}", kind(&schema["items"]))
            }
        }
        Some("object") => {
            let keys = schema["properties"].as_object();
            let keys: Vec<&str> = keys
                .into_iter()
                .flat_map(Map::keys)
                .map(String::as_str)
                .collect();
            format!("`{{ {} }}`", keys.join(", "))
        }
        Some("integer") => format!("whole number{}", bounds(schema)),
        Some(name) => format!("{name}{}", bounds(schema)),
        None => "any value".to_owned(),
    }
}

fn bounds(schema: &Value) -> String {
    let bound = |key: &str, sign: &str| match &schema[key] {
        Value::Number(number) => Some(format!("{sign} {number}")),
        _ => None,
    };
    let bounds = [
        bound("minimum", "≥"),
        bound("exclusiveMinimum", ">"),
        bound("maximum", "≤"),
        bound("exclusiveMaximum", "<"),
    ];
    let bounds: Vec<String> = bounds.into_iter().flatten().collect();
    if bounds.is_empty() {
        String::new()
    } else {
        format!(" {}", bounds.join(", "))
    }
}
