//! `[floors]`: what is measured in simulated buildings, along which axis, and for which curves.

use super::keys::Keys;
use super::measure::Measure;
use crate::config::{Conflict, Node};
use crate::experiment::schema::properties;
use crate::fields::names;
use crate::run::Identity;
use crate::study::curves::{Curves, Keyed, Point, read_keys};
use schemars::SchemaGenerator;
use serde_json::{Map, Value};

/// Buildings along an axis.
pub type Table = Curves<Keys>;

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
        read_keys(values, |keys: &Self| keys.check(measure))
    }
}

impl Point<Keys> {
    /// Every parameter that changes what is counted here.
    pub fn identity(&self, measure: Measure) -> Identity {
        Identity::new(self.all(measure, measure.unused()))
    }

    /// What the points that share a building have in common.
    pub fn building(&self, measure: Measure) -> Identity {
        let apart = [measure.unused(), measure.shared()].concat();
        Identity::new(self.all(measure, &apart))
    }

    fn all(&self, measure: Measure, without: &[&str]) -> Vec<(String, String)> {
        let settings = serde_json::to_string(&self.of.settings()).expect("settings are plain data");
        let mut all = self.parameters(measure, without);
        all.insert(1, ("settings".to_owned(), settings));
        all
    }
}
