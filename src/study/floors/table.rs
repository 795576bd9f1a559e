//! `[floors]`: what is measured in simulated buildings, along which axis, and for which curves.

use super::keys::Keys;
use super::measure::Measure;
use crate::config::{Conflict, Node, Refusal};
use crate::experiment::schema::properties;
use crate::fields::names;
use crate::rule::OutOfRange;
use crate::run::Identity;
use crate::study::curves::{Curves, Keyed, Point};
use schemars::SchemaGenerator;
use serde::Deserialize;
use serde_json::{Map, Value};

/// Buildings along an axis.
pub type Table = Curves<Keys>;

#[derive(Clone, Debug, PartialEq, thiserror::Error)]
enum Problem {
    #[error(transparent)]
    Read(#[from] Refusal),
    #[error("floors.{0}")]
    Value(OutOfRange),
}

impl Keyed for Keys {
    const PREFIX: &'static str = "floors.";
    const ABOUT: &'static str = "Floor maps of simulated buildings, counted along `axis` for each `curve`. Trips are drawn from \
        the law of their errors, without accelerometer records. Lengths in m.";
    type Measure = Measure;

    fn names() -> impl Iterator<Item = &'static str> + Clone {
        names::<Self>().iter().copied()
    }

    fn properties(generator: &mut SchemaGenerator) -> Map<String, Value> {
        properties::<Self>(generator)
    }

    fn unused(measure: Measure) -> &'static [&'static str] {
        measure.unused()
    }

    fn read(measure: Measure, values: &Node) -> Result<Self, Conflict> {
        let keys = Self::deserialize(values).map_err(|refusal| {
            let span = refusal.span.clone();
            let conflict = Conflict::of([""; 0], Problem::from(refusal.within("floors")));
            Conflict { span, ..conflict }
        })?;
        keys.check(measure).map_err(|error| {
            let span = values.get(&error.key).map(|node| node.span.clone());
            let conflict = Conflict::of([""; 0], Problem::Value(error));
            Conflict { span, ..conflict }
        })?;
        Ok(keys)
    }
}

impl Point<Keys> {
    /// Every parameter that changes what is counted here.
    pub fn identity(&self, measure: Measure) -> Identity {
        Identity::new(self.parameters(measure, measure.unused()))
    }

    /// What the points that share a building have in common.
    pub fn building(&self, measure: Measure) -> Identity {
        let apart = [measure.unused(), measure.shared()].concat();
        Identity::new(self.parameters(measure, &apart))
    }

    fn parameters(&self, measure: Measure, without: &[&str]) -> Vec<(String, String)> {
        let keys = serde_json::to_value(&self.of).expect("keys are plain data");
        let keys = keys.as_object().into_iter().flatten();
        let keys = keys.filter(|(key, _)| !without.contains(&&key[..]));
        let keys = keys.map(|(key, value)| (key.clone(), value.to_string()));
        let settings = serde_json::to_string(&self.of.settings()).expect("settings are plain data");
        let said = [
            ("measure".to_owned(), measure.to_string()),
            ("settings".to_owned(), settings),
        ];
        said.into_iter().chain(keys).collect()
    }
}
