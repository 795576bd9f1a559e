//! A serde deserializer over the tree, so that every error has the path and position of its value.

use super::refusal::Refusal;
use super::tree::{Node, Table, Value};
use serde::de::value::StrDeserializer;
use serde::de::{
    DeserializeSeed, Deserializer, EnumAccess, Error, Expected, IntoDeserializer, MapAccess,
    SeqAccess, Unexpected, VariantAccess, Visitor,
};
use serde::forward_to_deserialize_any;
use std::ops::Range;

impl Value {
    fn unexpected(&self) -> Unexpected<'_> {
        match self {
            Self::Bool(flag) => Unexpected::Bool(*flag),
            Self::Integer(number) => Unexpected::Signed(*number),
            Self::Float(number) => Unexpected::Float(*number),
            Self::Text(text) => Unexpected::Str(text),
            Self::Date(_) => Unexpected::Other("a date"),
            Self::List(_) => Unexpected::Seq,
            Self::Table(_) => Unexpected::Map,
        }
    }
}

impl<'de> IntoDeserializer<'de, Refusal> for &'de Node {
    type Deserializer = Self;

    fn into_deserializer(self) -> Self {
        self
    }
}

macro_rules! whole_numbers {
    ($($method:ident)*) => {
        $(fn $method<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Refusal> {
            match self.value {
                Value::Integer(number) if number >= 0 => visitor.visit_u64(number as u64),
                Value::Float(number) if number.is_finite() => Err(Refusal::custom(format_args!(
                    "must be a whole number, written without point or exponent, got {number}"
                ))),
                _ => Err(self.refused(&"a whole number, 0 or more")),
            }
            .map_err(|refusal: Refusal| refusal.at(&self.span))
        })*
    };
}

impl Node {
    fn refused(&self, expected: &dyn Expected) -> Refusal {
        Refusal::invalid_type(self.value.unexpected(), expected).at(&self.span)
    }
}

impl<'de> Deserializer<'de> for &'de Node {
    type Error = Refusal;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Refusal> {
        match &self.value {
            Value::Bool(flag) => visitor.visit_bool(*flag),
            Value::Integer(number) => visitor.visit_i64(*number),
            Value::Float(number) => visitor.visit_f64(*number),
            Value::Text(text) => visitor.visit_borrowed_str(text),
            Value::Date(_) => Err(self.refused(&visitor)),
            Value::List(list) => every_item(list, visitor),
            Value::Table(table) => visitor.visit_map(Entries::new(table)),
        }
        .map_err(|refusal: Refusal| refusal.at(&self.span))
    }

    whole_numbers! { deserialize_u8 deserialize_u16 deserialize_u32 deserialize_u64 }

    fn deserialize_f64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Refusal> {
        match self.number().filter(|number| number.is_finite()) {
            Some(number) => visitor
                .visit_f64(number)
                .map_err(|refusal: Refusal| refusal.at(&self.span)),
            None => Err(self.refused(&"a finite number")),
        }
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Refusal> {
        visitor.visit_some(self)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> Result<V::Value, Refusal> {
        visitor
            .visit_newtype_struct(self)
            .map_err(|refusal: Refusal| refusal.at(&self.span))
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Refusal> {
        match self.value {
            Value::List(_) => self.deserialize_any(visitor),
            Value::Table(_) => Err(self.refused(&"a list (write [[name]] for [name])")),
            _ => Err(self.refused(&"a list")),
        }
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        known: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Refusal> {
        let choice = match &self.value {
            Value::Table(table) if table.len() != 1 => {
                let second = table
                    .values()
                    .map(|(span, _)| span.clone())
                    .max_by_key(|s| s.start);
                let refusal = Refusal::custom(format_args!(
                    "must have exactly one of {}, got {} (leave one)",
                    known.join(", "),
                    table.len()
                ));
                return Err(refusal.at(&second.unwrap_or(self.span.clone())));
            }
            Value::Text(name) => Choice {
                name,
                span: &self.span,
                content: None,
            },
            Value::Table(table) => {
                let (name, (span, node)) = table.iter().next().expect("there is one");
                Choice {
                    name,
                    span,
                    content: Some(node),
                }
            }
            _ => return Err(self.refused(&"a name, or a table with one key")),
        };
        if choice.content.is_some() && !known.contains(&choice.name) {
            return Err(Refusal::unknown_field(choice.name, known).at(choice.span));
        }
        visitor
            .visit_enum(choice)
            .map_err(|refusal: Refusal| refusal.at(&self.span))
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u128 f32 char str string bytes byte_buf unit unit_struct tuple
        tuple_struct map struct identifier ignored_any
    }
}

/// A list of fixed length takes no more than it has names for.
fn every_item<'de, V: Visitor<'de>>(list: &'de [Node], visitor: V) -> Result<V::Value, Refusal> {
    let mut items = Items { list, next: 0 };
    let value = visitor.visit_seq(&mut items)?;
    match list.get(items.next) {
        None => Ok(value),
        Some(node) => Err(Refusal::custom(format_args!(
            "must be a list of {}, got {} of them",
            items.next,
            list.len()
        ))
        .at(&node.span)),
    }
}

struct Items<'a> {
    list: &'a [Node],
    next: usize,
}

impl<'de> SeqAccess<'de> for Items<'de> {
    type Error = Refusal;

    fn next_element_seed<T: DeserializeSeed<'de>>(
        &mut self,
        seed: T,
    ) -> Result<Option<T::Value>, Refusal> {
        let Some(node) = self.list.get(self.next) else {
            return Ok(None);
        };
        self.next += 1;
        seed.deserialize(node)
            .map(Some)
            .map_err(|refusal| refusal.under(&format!("[{}]", self.next - 1)))
    }
}

struct Entries<'a> {
    rest: std::collections::btree_map::Iter<'a, String, (Range<usize>, Node)>,
    value: Option<(&'a str, &'a Node)>,
}

impl<'a> Entries<'a> {
    fn new(table: &'a Table) -> Self {
        Self {
            rest: table.iter(),
            value: None,
        }
    }
}

impl<'de> MapAccess<'de> for Entries<'de> {
    type Error = Refusal;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, Refusal> {
        let Some((key, (span, node))) = self.rest.next() else {
            return Ok(None);
        };
        self.value = Some((key, node));
        let key: StrDeserializer<Refusal> = key.as_str().into_deserializer();
        seed.deserialize(key)
            .map(Some)
            .map_err(|refusal| refusal.at(span))
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, Refusal> {
        let (key, node) = self.value.take().expect("a value follows its key");
        seed.deserialize(node)
            .map_err(|refusal| refusal.at(&node.span).under(key))
    }
}

struct Choice<'a> {
    name: &'a str,
    span: &'a Range<usize>,
    content: Option<&'a Node>,
}

impl<'de> EnumAccess<'de> for Choice<'de> {
    type Error = Refusal;
    type Variant = Self;

    fn variant_seed<V: DeserializeSeed<'de>>(self, seed: V) -> Result<(V::Value, Self), Refusal> {
        let name: StrDeserializer<Refusal> = self.name.into_deserializer();
        let variant = seed
            .deserialize(name)
            .map_err(|refusal| refusal.at(self.span))?;
        Ok((variant, self))
    }
}

impl<'de> Choice<'de> {
    fn content(&self) -> Result<&'de Node, Refusal> {
        self.content.ok_or_else(|| self.needs_parameters())
    }

    fn needs_parameters(&self) -> Refusal {
        let name = self.name;
        Refusal::custom(format_args!(
            "needs its parameters (write {{ {name} = ... }})"
        ))
    }
}

impl<'de> VariantAccess<'de> for Choice<'de> {
    type Error = Refusal;

    fn unit_variant(self) -> Result<(), Refusal> {
        match self.content {
            None => Ok(()),
            Some(node) if node.table().is_some_and(Table::is_empty) => Ok(()),
            Some(node) => Err(Refusal::custom(format_args!(
                "takes no parameters (write \"{}\")",
                self.name
            ))
            .at(&node.span)),
        }
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, Refusal> {
        let node = self.content()?;
        seed.deserialize(node)
            .map_err(|refusal| refusal.at(&node.span).under(self.name))
    }

    fn tuple_variant<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value, Refusal> {
        let name = self.name;
        let content = self.content()?;
        content
            .deserialize_seq(visitor)
            .map_err(|refusal| refusal.under(name))
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Refusal> {
        // A name alone is a table in which every key has its default.
        let Some(content) = self.content else {
            let nothing = Entries::new(&NOTHING);
            return visitor
                .visit_map(nothing)
                .map_err(|_: Refusal| self.needs_parameters());
        };
        content
            .deserialize_any(visitor)
            .map_err(|refusal| refusal.under(self.name))
    }
}

static NOTHING: Table = Table::new();

#[cfg(test)]
mod tests {
    use super::*;
    use serde::Deserialize;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields, rename_all = "snake_case")]
    #[allow(dead_code, reason = "it is only read")]
    enum Law {
        Normal,
        StudentT(f64),
        Contaminated { share: f64 },
    }

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    #[allow(dead_code, reason = "they are only read")]
    struct File {
        size: usize,
        #[serde(default)]
        law: Vec<Law>,
        ratio: Option<f64>,
    }

    /// The error for `text`, and the text it points at.
    fn refused(text: &str) -> (String, &str) {
        let root = Node::parse(text).unwrap();
        let refusal = File::deserialize(&root).unwrap_err();
        let span = refusal.span.clone().unwrap();
        (refusal.to_string(), &text[span])
    }

    #[test]
    fn refusals_have_a_path_and_a_place() {
        for (text, message, place) in [
            ("ratio = 1", "required key `size` is missing (add it)", "r"),
            (
                "sise = 1",
                "unknown key `sise`, did you mean `size`? (one of size, law, ratio)",
                "sise",
            ),
            (
                "size = -1",
                "size: must be a whole number, 0 or more, got -1",
                "-1",
            ),
            (
                "size = 1.5",
                "size: must be a whole number, written without point or exponent, got 1.5",
                "1.5",
            ),
            (
                "size = 1\nratio = nan",
                "ratio: must be a finite number, got NaN",
                "nan",
            ),
            (
                "size = 1\nlaw = [\"normel\"]",
                "law[0]: unknown value `normel`, did you mean `normal`? (one of normal, student_t, contaminated)",
                "\"normel\"",
            ),
            (
                "size = 1\nlaw = [\"normal\", \"student_t\"]",
                "law[1]: needs its parameters (write { student_t = ... })",
                "\"student_t\"",
            ),
            (
                "size = 1\nlaw = [{ quantum = 3 }]",
                "law[0]: unknown key `quantum` (one of normal, student_t, contaminated)",
                "quantum",
            ),
            (
                "size = 1\nlaw = [{ student_t = \"3\" }]",
                "law[0].student_t: must be a finite number, got \"3\"",
                "\"3\"",
            ),
            (
                "size = 1\nlaw = [{ contaminated = { chare = 1 } }]",
                "law[0].contaminated: unknown key `chare`, did you mean `share`? (one of share)",
                "chare",
            ),
            (
                "size = 1\n[law]\n",
                "law: must be a list (write [[name]] for [name]), got a table",
                "[law]",
            ),
        ] {
            assert_eq!(refused(text), (message.to_owned(), place), "{text}");
        }
    }
}
