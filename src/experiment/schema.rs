//! Parts of the JSON Schema of a config that several tables share.

use schemars::{JsonSchema, SchemaGenerator};
use serde_json::{Map, Value, json};

/// The keys of a type, each with its schema.
pub fn properties<T: JsonSchema>(generator: &mut SchemaGenerator) -> Map<String, Value> {
    let schema = T::json_schema(generator).to_value();
    match schema.get("properties") {
        Some(Value::Object(properties)) => properties.clone(),
        _ => Map::new(),
    }
}

/// The schema of an axis that sweeps one of these keys. Each key is given with the schema of its values.
pub fn axis<'a>(keys: impl Iterator<Item = (&'a str, Value)>) -> Value {
    let values = |value: Value| {
        json!({
            "description": value["description"],
            "anyOf": [
                { "type": "array", "minItems": 1, "items": value },
                {
                    "type": "object",
                    "properties": {
                        "from": { "type": "number" },
                        "to": { "type": "number" },
                        "step": { "type": "number", "exclusiveMinimum": 0 },
                    },
                    "required": ["from", "to", "step"],
                    "additionalProperties": false,
                },
                value,
            ],
        })
    };
    let keys: Map<String, Value> = keys
        .map(|(name, value)| (name.to_owned(), values(value)))
        .collect();
    json!({
        "description": "What the x axis sweeps, exactly one key: a list of values, or { from, to, step }.",
        "type": "object",
        "properties": keys,
        "minProperties": 1,
        "maxProperties": 1,
        "additionalProperties": false,
    })
}
