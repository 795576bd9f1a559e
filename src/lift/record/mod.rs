//! Records that are hard to read, each with its truth: random lifts, trips, sensors, and what happens to them.
//!
//! A record is a function of its class, a seed and its index. Its class says what makes it hard ([`Class`]).
//! Everything else is drawn for each record: a lift of 0.4 to 4.5 m/s with its building, 1 to 4 trips, rests with
//! people in them, and a sensor with the density of a phone's noise, 150 to 600 µg/√Hz, vibration in motion
//! in proportion to the speed, with or without gravity, with an offset.
//!
//! ```
//! use liftsim::lift::{Class, Record};
//!
//! let record = Record::new(Class::Creep, 2014, 0);
//! assert!(record.journeys[0].levelling.is_some());
//! assert_eq!(record.times.len(), record.acceleration.len());
//! ```

mod cage;
mod class;
mod disturbance;
mod lift;
mod sensor;
#[cfg(test)]
mod tests;

pub use class::Class;
pub(crate) use class::MOST_TRIPS;

use super::Journey;
use super::draws::Draws;
use crate::rng::{Generator, Stream};
use cage::Cage;
use class::Ranges;
use sensor::Mounted;

/// A record and its truth. Times are in s on the record's clock, accelerations in m/s², up positive.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// Samples per second, where none is missing.
    pub rate: f64,
    /// Of each sample.
    pub times: Vec<f64>,
    /// Of each sample, with or without gravity.
    pub acceleration: Vec<f64>,
    /// The true speed at each sample, m/s, up positive.
    pub speed: Vec<f64>,
    /// The trips; of [`Class::Cut`] the first may begin before the record, the last end after it.
    pub journeys: Vec<Journey>,
    /// From when to when the drum turns.
    pub drum: Vec<(f64, f64)>,
    /// From when to when it turns although the cage stands.
    pub slack: Vec<(f64, f64)>,
}

impl Record {
    /// Record number `index` of a class.
    pub fn new(class: Class, seed: u64, index: u64) -> Self {
        let (cage, sensor) = plan(class, seed, index);
        let readings = sensor.read(&cage, &mut generator("record noise", class, seed, index));
        let mut record = Self {
            rate: sensor.rate,
            times: Vec::new(),
            acceleration: Vec::new(),
            speed: Vec::new(),
            journeys: Vec::new(),
            drum: Vec::new(),
            slack: Vec::new(),
        };
        for (i, reading) in readings.into_iter().enumerate() {
            let time = i as f64 / sensor.rate;
            if sensor.has(time) {
                record.times.push(time);
                record.acceleration.push(reading);
                record.speed.push(cage.speed_at(time));
            }
        }
        Self {
            journeys: cage.journeys,
            drum: cage.drum,
            slack: cage.slack,
            ..record
        }
    }
}

/// What happens in a record, and the sensor that sees it.
fn plan(class: Class, seed: u64, index: u64) -> (Cage, Mounted) {
    let ranges = Ranges::of(class);
    let mut draws = Draws(generator("record plan", class, seed, index));
    let cage = Cage::draw(class, &ranges, &mut draws);
    let sensor = Mounted::draw(class, &ranges, &cage, &mut draws);
    (cage, sensor)
}

fn generator(purpose: &str, class: Class, seed: u64, index: u64) -> Generator {
    Stream::new(seed, purpose, &class.to_string()).at(index)
}
