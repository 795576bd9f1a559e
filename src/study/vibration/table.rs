//! `[vibration]`: what is measured in simulated lifts, along which axis, and for which curves.

use super::keys::Keys;
use super::measure::Measure;
use crate::config::{Conflict, Node};
use crate::experiment::schema::properties;
use crate::fields::names;
use crate::run::Identity;
use crate::study::curves::{Curves, Keyed, Point, read_keys};
use schemars::SchemaGenerator;
use serde_json::{Map, Value};

/// Lifts along an axis.
pub type Table = Curves<Keys>;

impl Keyed for Keys {
    const PREFIX: &'static str = "vibration.";
    const ABOUT: &'static str = "Horizontal vibration of simulated lifts beside a baseline that is learnt from them, along \
        `axis` for each `curve`.";
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

    fn read(_: Measure, values: &Node) -> Result<Self, Conflict> {
        read_keys(values, Self::check)
    }
}

impl Point<Keys> {
    /// Every parameter that changes what is counted here.
    pub fn identity(&self, measure: Measure) -> Identity {
        Identity::new(self.parameters(measure, measure.unused()))
    }

    /// What the points that share a lift have in common.
    pub fn lift(&self, measure: Measure) -> Identity {
        Identity::new(self.parameters(measure, &Measure::SHARED))
    }
}
