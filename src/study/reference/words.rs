//! The reference in words: chapters of tables of keys, as Markdown.

use super::{generator, schema};
use crate::detection::RecordingTable;
use crate::experiment::schema::properties;
use crate::monitor::Settings;
use crate::scenario::Sections;
use schemars::JsonSchema;
use serde_json::{Map, Value};
use std::fmt;

/// The tables of one kind of file.
#[derive(Clone, Debug)]
pub struct Chapter {
    title: &'static str,
    /// Paragraphs before the tables.
    introduction: &'static str,
    /// The tables.
    pub tables: Vec<Table>,
}

/// A table of a file and its keys.
#[derive(Clone, Debug)]
pub struct Table {
    /// As it is written in a file, `[whitening]`, or what stands in its place.
    pub title: String,
    description: String,
    /// The keys.
    pub keys: Vec<Key>,
}

/// A key, its words ready for a cell of a table.
#[derive(Clone, Debug)]
pub struct Key {
    /// The key.
    pub name: String,
    kind: String,
    /// The default as JSON; empty where there is none.
    pub default: String,
    /// What it is for.
    pub meaning: String,
}

/// The reference of a config.
pub fn config() -> Chapter {
    let schema = schema();
    let empty = Map::new();
    let all = schema["properties"].as_object().unwrap_or(&empty);
    let plain = all.iter().filter(|(_, schema)| !is_table(schema));
    let mut tables = vec![Table::new("the top of the file".to_owned(), "", plain)];
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
        tables.push(Table::new(title, description, entries));
    }
    Chapter::new("Keys of a config", CONFIG, tables)
}

const CONFIG: &str = "Written by `liftsim keys` from the types that read a config; `schema.json` beside this file says the same to an \
    editor. A config does one thing: `[axis]` and `[[curve]]` sweep a parameter, any other table of a study takes \
    their place. An unknown key is refused. Units are those of the whitened noise, σ_ξ, unless a key says otherwise.";

/// The reference of the file of `detect --config` and `monitor --config`.
pub fn monitor_options() -> Chapter {
    let mut tables = vec![table::<RecordingTable>(
        "[recording]",
        "How the recording is read.",
    )];
    for (name, schema) in &properties::<Settings>(&mut generator()) {
        let description = schema["description"].as_str().unwrap_or_default();
        let title = format!("[{name}]");
        tables.push(Table::new(title, description, own_keys(schema).iter()));
    }
    let introduction =
        "Whatever is left out of `[recording]` is found in the file; sizes are in blocks.";
    Chapter::new(
        "Keys of `detect --config` and `monitor --config`",
        introduction,
        tables,
    )
}

/// The keys of a type as a table.
pub fn table<T: JsonSchema>(title: &str, description: &str) -> Table {
    let properties = properties::<T>(&mut generator());
    Table::new(title.to_owned(), description, properties.iter())
}

/// The sections that every curve of a sweep may have.
pub fn sections() -> Vec<Table> {
    let sections = properties::<Sections>(&mut generator());
    let table = |(name, schema): (&String, &Value)| {
        Table::new(format!("[{name}]"), "", own_keys(schema).iter())
    };
    sections.iter().map(table).collect()
}

/// What of the chapters is called `name`: whole tables, or else the keys of that name in any table. Chapters without
/// any are left out.
pub fn matching(chapters: Vec<Chapter>, name: &str) -> Vec<Chapter> {
    let is_whole = (chapters.iter().flat_map(|chapter| &chapter.tables)).any(|it| it.is(name));
    let keep = |mut table: Table| {
        if !table.is(name) {
            table.keys.retain(|key| !is_whole && key.name == name);
        }
        (!table.keys.is_empty()).then_some(table)
    };
    let of_chapter = |chapter: Chapter| Chapter {
        introduction: "",
        tables: chapter.tables.into_iter().filter_map(keep).collect(),
        ..chapter
    };
    let chapters = chapters.into_iter().map(of_chapter);
    chapters
        .filter(|chapter| !chapter.tables.is_empty())
        .collect()
}

impl Chapter {
    /// A chapter with an introduction, which may be empty.
    pub fn new(title: &'static str, introduction: &'static str, tables: Vec<Table>) -> Self {
        Self {
            title,
            introduction,
            tables,
        }
    }

    /// The names by which [`matching`] finds something.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        let tables = self.tables.iter().map(Table::name);
        let keys = self.tables.iter().flat_map(|table| &table.keys);
        tables.chain(keys.map(|key| &*key.name))
    }
}

impl Table {
    fn new<'a>(
        title: String,
        description: &str,
        keys: impl Iterator<Item = (&'a String, &'a Value)>,
    ) -> Self {
        Self {
            title,
            description: one_line(description),
            keys: keys.map(|(name, schema)| Key::new(name, schema)).collect(),
        }
    }

    /// Its name without brackets.
    pub fn name(&self) -> &str {
        self.title.trim_matches(['[', ']'])
    }

    fn is(&self, name: &str) -> bool {
        [self.name(), &self.title].contains(&name)
    }
}

impl Key {
    fn new(name: &str, schema: &Value) -> Self {
        let meaning = one_line(schema["description"].as_str().unwrap_or_default());
        Self {
            name: name.to_owned(),
            kind: kind(schema).replace('|', "\\|"),
            default: match &schema["default"] {
                Value::Null | Value::Object(_) => String::new(),
                value => value.to_string(),
            },
            meaning: format!("{meaning}{}", choices(schema)),
        }
    }
}

impl fmt::Display for Chapter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "# {}\n\n", self.title)?;
        if !self.introduction.is_empty() {
            write!(f, "{}\n\n", self.introduction)?;
        }
        self.tables.iter().try_for_each(|table| table.fmt(f))
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "## {}\n\n", self.title)?;
        if !self.description.is_empty() {
            write!(f, "{}\n\n", self.description)?;
        }
        f.write_str("| key | type | default | meaning |\n|---|---|---|---|\n")?;
        for key in &self.keys {
            let default = match &*key.default {
                "" => String::new(),
                default => format!("`{default}`"),
            };
            let Key {
                name,
                kind,
                meaning,
                ..
            } = key;
            writeln!(f, "| `{name}` | {kind} | {default} | {meaning} |")?;
        }
        f.write_str("\n")
    }
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
