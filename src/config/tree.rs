//! A config's text as a tree in which every key and value keeps its place, and trees laid over each other.

use crate::format::shorten;
use crate::suggest::among;
use std::collections::BTreeMap;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A value and where it stands in the text.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Bytes of the text.
    pub span: Range<usize>,
    /// What stands there.
    pub value: Value,
}

/// What a TOML file can hold.
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

/// Keys in alphabetical order, each with its place.
pub type Table = BTreeMap<String, (Range<usize>, Node)>;

impl Node {
    /// Reads a text.
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

    /// What stands under a path such as `impulses.nu` or `claim[2].test`.
    pub fn get(&self, path: &str) -> Option<&Self> {
        path.split(['.', '['])
            .filter(|part| !part.is_empty())
            .try_fold(self, |node, part| match &node.value {
                Value::Table(table) => Some(&table.get(part)?.1),
                Value::List(list) => list.get(part.strip_suffix(']')?.parse::<usize>().ok()?),
                _ => None,
            })
    }

    /// The entries whose keys `is_wanted`, as a table of its own. What is no table stays as it is, for the
    /// reader of a table to refuse.
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

    /// The first key that is none of `known`: where it stands, and its name with those it may be.
    pub fn unknown<'a>(
        &self,
        known: impl Iterator<Item = &'a str> + Clone,
    ) -> Option<(Range<usize>, String)> {
        let mut entries = self.table().into_iter().flatten();
        let (key, (span, _)) = entries.find(|(key, _)| !known.clone().any(|name| name == *key))?;
        Some((span.clone(), among(&shorten(key), known)))
    }

    /// This tree where it says something, `base` where it does not. The keys of one of `choices` are
    /// alternatives: naming any of them drops the others of `base`.
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
        for (key, (key_span, node)) in entries {
            let path = match path {
                "" => key.clone(),
                path => format!("{path}.{key}"),
            };
            for rival in choices
                .iter()
                .filter(|c| c.contains(&&path[..]))
                .flat_map(|c| c.iter())
            {
                let own = path.rsplit_once('.').map_or("", |(own, _)| own);
                if *rival != path
                    && let Some(name) = rival.strip_prefix(own)
                {
                    table.remove(name.trim_start_matches('.'));
                }
            }
            // A section is laid over key by key; a value, be it a table itself, is replaced.
            match table.get_mut(key) {
                Some((_, below)) if !path.contains('.') => below.lay(node, choices, &path),
                _ => drop(table.insert(key.clone(), (key_span.clone(), node.clone()))),
            }
        }
    }

    /// Puts `node` under a path of at most two keys.
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

    /// Every key of every section that is written, as a path, with the place of its value.
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

/// The TOML reader knows how numbers are written.
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
}
