//! `[ride]`: what is measured on rides, along which axis, and for which curves.
//!
//! Accelerations are in m/s², times in s. One of three keys gives the strength of the noise. `sigma` is the
//! deviation of a sample. `density` is the one-sided root density of the noise in m/s²/√Hz: it belongs to the
//! sensor and does not depend on the sampling rate, so sigma = density √(rate/2). `delta_over_sigma` is the
//! drive's acceleration in units of sigma. Vibration, θ, quantum and jolt are in units of sigma.

use super::keys::{self, RideKeys, STRENGTH};
use super::measure::Measure;
use super::point::RidePoint;
use crate::config::{Conflict, Node};
use crate::experiment::schema::properties;
use crate::fields::names;
use crate::monitor::Settings;
use crate::study::curves::{Curves, Keyed};
use schemars::SchemaGenerator;
use serde_json::{Map, Value};
use std::ops::Range;

/// Rides along an axis.
pub type Table = Curves<RidePoint>;

impl Keyed for RidePoint {
    const PREFIX: &'static str = "ride.";
    const ABOUT: &'static str = "Whole simulated rides before the monitor, counted along `axis` for each `curve`. \
        Lengths in m, times in s; vibration, theta, quantum and jolt in units of sigma.";
    const CHOICES: &'static [&'static [&'static str]] = &[&STRENGTH];
    type Measure = Measure;

    fn names() -> impl Iterator<Item = &'static str> + Clone {
        let own = names::<RideKeys>().iter().copied();
        own.chain(Settings::names())
    }

    fn properties(generator: &mut SchemaGenerator) -> Map<String, Value> {
        let mut keys = properties::<RideKeys>(generator);
        for table in properties::<Settings>(generator).values() {
            keys.extend(table["properties"].as_object().cloned().unwrap_or_default());
        }
        keys
    }

    fn unused(measure: Measure) -> &'static [&'static str] {
        measure.unused()
    }

    fn read(measure: Measure, values: &Node) -> Result<Self, Conflict> {
        let (keys, settings) = keys::read(values)?;
        Self::new(measure, keys, &settings).map_err(|problem| {
            let span = problem.key().and_then(|key| place(values, key));
            Conflict {
                span,
                ..Conflict::of([""; 0], problem)
            }
        })
    }
}

/// The place of a key's value in the file, or of the value of a key that expresses the same in another way.
fn place(values: &Node, key: &str) -> Option<Range<usize>> {
    let rivals = STRENGTH.iter().filter(|_| STRENGTH.contains(&key));
    let mut found = [&key]
        .into_iter()
        .chain(rivals)
        .filter_map(|key| values.get(key));
    found.next().map(|node| node.span.clone())
}
