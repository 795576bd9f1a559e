//! A config's text as a tree whose keys and values keep their positions, and the merging of trees.

use crate::format::shorten;
use crate::suggest::among;
use std::collections::BTreeMap;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A value and its position in the text.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// The byte range in the text.
    pub span: Range<usize>,
    /// The value.
    pub value: Value,
}

/// A TOML value.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "the words are TOML's own")]
pub enum Value {
    Bool(bool),
    Integer(i64),
    Float(f64),
    Text(String),
    /// As written.
    Date(String),
    List(Vec<Node>),
    Table(Table),
}

/// Keys in alphabetical order, each with its position.
pub type Table = BTreeMap<String, (Range<usize>, Node)>;

impl Node {
    /// Parses a text.
    pub(super) fn parse(text: &str) -> Result<Self, toml::de::Error> {
        let root = DeTable::parse(text)?;
        Ok(Self {
            span: 0..text.len().min(1),
            value: table(root.into_inner())?,
        })
    }

    /// An empty table at `span`.
    pub fn empty(span: Range<usize>) -> Self {
        let value = Value::Table(Table::new());
        Self { span, value }
    }

    /// The entries, if it is a table.
    pub fn table(&self) -> Option<&Table> {
        match &self.value {
            Value::Table(table) => Some(table),
            _ => None,
        }
    }

    /// The number, if it is one.
    pub fn number(&self) -> Option<f64> {
        match self.value {
            Value::Float(number) => Some(number),
            Value::Integer(number) => Some(number as f64),
            _ => None,
        }
    }

    /// The node at a path such as `impulses.nu` or `claim[2].test`.
    pub fn get(&self, path: &str) -> Option<&Self> {
        path.split(['.', '['])
            .filter(|part| !part.is_empty())
            .try_fold(self, |node, part| match &node.value {
                Value::Table(table) => Some(&table.get(part)?.1),
                Value::List(list) => list.get(part.strip_suffix(']')?.parse::<usize>().ok()?),
                _ => None,
            })
    }

    /// A table with only the entries whose keys are selected. Anything but a table stays as it is, so that the
    /// reader refuses it.
    pub fn only(&self, is_wanted: impl Fn(&str) -> bool) -> Self {
        let Some(entries) = self.table() else {
            return self.clone();
        };
        let wanted = entries
            .iter()
            .filter(|(key, _)| is_wanted(key))
            .map(|(key, entry)| (key.clone(), entry.clone()));
        Self {
            span: self.span.clone(),
            value: Value::Table(wanted.collect()),
        }
    }

    /// The first key that is none of `known`: its position, and its name with those it may be.
    pub fn unknown<'a>(
        &self,
        known: impl Iterator<Item = &'a str> + Clone,
    ) -> Option<(Range<usize>, String)> {
        let mut entries = self.table().into_iter().flatten();
        let (key, (span, _)) = entries.find(|(key, _)| !known.clone().any(|name| name == *key))?;
        Some((span.clone(), among(&shorten(key), known)))
    }

    /// Merges this tree over `base`: its values replace those of `base`. The keys within one of `choices` are
    /// alternatives: setting one drops the others of `base`.
    pub fn over(&self, base: &Self, choices: &[&[&str]]) -> Self {
        let mut laid = base.clone();
        laid.lay(self, choices, "");
        laid
    }

    fn lay(&mut self, above: &Self, choices: &[&[&str]], path: &str) {
        let (Value::Table(table), Value::Table(entries)) = (&mut self.value, &above.value) else {
            *self = above.clone();
            return;
        };
        let full = |key: &str| match path {
            "" => key.to_owned(),
            path => format!("{path}.{key}"),
        };
        // Naming one of several alternatives drops the others below, but none that is named beside it.
        for key in entries.keys() {
            let named = full(key);
            let rivals = choices.iter().filter(|choice| choice.contains(&&named[..]));
            for rival in rivals.flat_map(|choice| choice.iter()) {
                table.retain(|key, _| key == &named || full(key) != **rival);
            }
        }
        for (key, (key_span, node)) in entries {
            let path = full(key);
            // A section is merged key by key; a value is replaced, even if it is a table.
            match table.get_mut(key) {
                Some((_, below)) if !path.contains('.') => below.lay(node, choices, &path),
                _ => drop(table.insert(key.clone(), (key_span.clone(), node.clone()))),
            }
        }
    }

    /// Sets the node at a path of at most two keys.
    pub fn set(&mut self, path: &str, node: Self) {
        let Value::Table(table) = &mut self.value else {
            return;
        };
        let span = node.span.clone();
        match path.split_once('.') {
            Some((section, key)) => table
                .entry(section.to_owned())
                .or_insert_with(|| (span.clone(), Self::empty(span)))
                .1
                .set(key, node),
            None => drop(table.insert(path.to_owned(), (span, node))),
        }
    }

    /// The paths of all keys written in the sections, with the positions of their values.
    pub fn written(&self) -> Vec<(String, Range<usize>)> {
        let sections = self.table().into_iter().flatten();
        sections
            .flat_map(|(section, (_, node))| match &node.value {
                Value::Table(keys) => keys
                    .iter()
                    .map(|(key, (_, node))| (format!("{section}.{key}"), node.span.clone()))
                    .collect(),
                _ => vec![(section.clone(), node.span.clone())],
            })
            .collect()
    }
}

fn node(value: Spanned<DeValue<'_>>) -> Result<Node, toml::de::Error> {
    let span = value.span();
    let value = match value.into_inner() {
        DeValue::String(text) => Value::Text(text.into_owned()),
        DeValue::Boolean(flag) => Value::Bool(flag),
        DeValue::Datetime(date) => Value::Date(date.to_string()),
        DeValue::Array(list) => Value::List(list.into_iter().map(node).collect::<Result<_, _>>()?),
        DeValue::Table(entries) => table(entries)?,
        number @ (DeValue::Integer(_) | DeValue::Float(_)) => number_of(span.clone(), number)?,
    };
    Ok(Node { span, value })
}

fn table(entries: DeTable<'_>) -> Result<Value, toml::de::Error> {
    let entries = entries
        .into_iter()
        .map(|(key, value)| Ok((key.get_ref().to_string(), (key.span(), node(value)?))));
    Ok(Value::Table(
        entries.collect::<Result<_, toml::de::Error>>()?,
    ))
}

/// Leaves the syntax of numbers to the TOML reader.
fn number_of(span: Range<usize>, number: DeValue<'_>) -> Result<Value, toml::de::Error> {
    use serde::Deserialize;
    let reader = toml::de::ValueDeserializer::from(Spanned::new(span, number));
    Ok(match toml::Value::deserialize(reader)? {
        toml::Value::Integer(number) => Value::Integer(number),
        toml::Value::Float(number) => Value::Float(number),
        other => Value::Text(other.to_string()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "[impulses]\nnu = 0.1\ntheta = 2.0\n[sensor]\nar = [0.5]\n\
        [[curve]]\nimpulses = { theta = 5 }\nsensor = { model = \"adxl105\" }\n";

    #[test]
    fn a_curve_is_laid_over_the_file() {
        let root = Node::parse(TEXT).unwrap();
        let choices: &[&[&str]] = &[&["sensor.ar", "sensor.model"]];
        let laid = root.get("curve[0]").unwrap().over(&root, choices);
        let at = |path: &str| laid.get(path).map(|node| &TEXT[node.span.clone()]);
        assert_eq!(at("impulses.nu"), Some("0.1"));
        assert_eq!(at("impulses.theta"), Some("5"));
        assert_eq!(
            (at("sensor.ar"), at("sensor.model")),
            (None, Some("\"adxl105\""))
        );
    }

    /// Alternatives that one table names together are all there, for whoever reads it to refuse.
    #[test]
    fn alternatives_of_one_table_stay() {
        let text = "[sensor]\nar = [0.5]\n[curve]\nsensor = { ar = [0.1], model = \"adxl105\" }\n";
        let root = Node::parse(text).unwrap();
        for choice in [["sensor.ar", "sensor.model"], ["sensor.model", "sensor.ar"]] {
            let laid = root.get("curve").unwrap().over(&root, &[&choice]);
            assert_eq!(laid.get("sensor").unwrap().table().unwrap().len(), 2);
        }
    }
}
