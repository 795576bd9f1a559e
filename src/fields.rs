//! The fields of a struct by their names, so that no list of them is written by hand.

use serde::Serialize;
use serde::de::value::Error;
use serde::de::{DeserializeOwned, Deserializer, Error as _, Visitor};
use serde_json::{Map, Value};

/// The field names in order, as the derived `Deserialize` asks for them.
pub fn names<T: DeserializeOwned>() -> &'static [&'static str] {
    let mut names = Names(&[]);
    // The deserializer records the names and then always fails.
    let _ = T::deserialize(&mut names);
    names.0
}

/// The fields of a section that are not among `named` and not at their defaults, as text: what a field that is
/// added later changes in a text that was written before it.
pub fn further<T: Serialize + Default>(section: &T, named: &[&str]) -> String {
    let usual = fields(&T::default());
    let own = fields(section).into_iter();
    own.filter(|(name, value)| !named.contains(&&name[..]) && usual.get(name) != Some(value))
        .map(|(name, value)| format!(" {name} {value}"))
        .collect()
}

fn fields(section: &impl Serialize) -> Map<String, Value> {
    match serde_json::to_value(section) {
        Ok(Value::Object(fields)) => fields,
        _ => Map::new(),
    }
}

struct Names(&'static [&'static str]);

impl<'de> Deserializer<'de> for &mut Names {
    type Error = Error;

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        fields: &'static [&'static str],
        _: V,
    ) -> Result<V::Value, Error> {
        self.0 = fields;
        Err(Error::custom("only names are wanted"))
    }

    fn deserialize_any<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Error> {
        Err(Error::custom("not a struct"))
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option unit
        unit_struct newtype_struct seq tuple tuple_struct map enum identifier ignored_any
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Default, Serialize)]
    struct Section {
        old: u8,
        new: u8,
    }

    #[test]
    fn a_later_field_is_named_where_it_says_something() {
        assert_eq!(further(&Section { old: 3, new: 0 }, &["old"]), "");
        assert_eq!(further(&Section { old: 3, new: 4 }, &["old"]), " new 4");
    }
}
