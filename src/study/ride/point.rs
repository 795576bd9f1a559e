//! One point of a study: a drive, a cage with a sensor in it, and a monitor.

use super::keys::{RideKeys, STRENGTH};
use super::measure::Measure;
use super::problem::RideProblem;
use crate::lift::{Drive, Ending, Pickup, Ride, RideError, Trip};
use crate::monitor::{Design, Settings};
use crate::rule::{OutOfRange, Rule};
use crate::run::Identity;
use crate::signal::{Digitiser, Disturbance, Impulses, Sensor};

/// Everything that a trial needs besides its draws.
#[derive(Clone, Debug)]
pub struct RidePoint {
    /// What is measured.
    pub measure: Measure,
    /// The keys as in the config.
    pub keys: RideKeys,
    /// The monitor.
    pub design: Design,
    /// The sensor in the cage.
    pub pickup: Pickup,
    /// Whether the monitor assumes, rightly or wrongly, that the record begins at rest.
    pub begins_at_rest: bool,
}

/// The default deviation of the noise, m/s²: that of a good phone.
const SIGMA: f64 = 0.012;

/// The most trips in a ride.
const MOST_TRIPS: usize = 100;

impl RidePoint {
    /// Makes a point from keys and settings that fit each other.
    ///
    /// # Errors
    /// If they do not fit.
    pub fn new(measure: Measure, keys: RideKeys, settings: &Settings) -> Result<Self, RideProblem> {
        keys.check()?;
        let pickup = keys.pickup()?;
        let in_ride = |path: &str| format!("ride.{}", path.rsplit('.').next().unwrap_or(path));
        let design = settings.at(keys.rate);
        let design = design.map_err(|error| error.called(in_ride))?;
        let point = Self {
            measure,
            pickup,
            design,
            begins_at_rest: keys
                .begins_at_rest
                .unwrap_or(measure != Measure::SwitchedOn),
            keys,
        };
        point.check()?;
        Ok(point)
    }

    /// Every parameter. A value that several keys can express appears once, in one form.
    pub fn identity(&self) -> Identity {
        let keys = serde_json::to_value(&self.keys).expect("keys are plain data");
        let settings =
            serde_json::to_value(&self.design.settings).expect("settings are plain data");
        let tables = settings
            .as_object()
            .into_iter()
            .flat_map(|tables| tables.values());
        let is_said_otherwise = |key: &str| STRENGTH.contains(&key) || key == "begins_at_rest";
        let entries = [&keys]
            .into_iter()
            .chain(tables)
            .filter_map(|table| table.as_object());
        let parameters = entries
            .flatten()
            .filter(|(key, _)| !is_said_otherwise(key))
            .map(|(key, value)| (key.clone(), value.to_string()));
        let said = [
            ("measure", self.measure.to_string()),
            ("sigma", self.pickup.sigma.to_string()),
            ("begins_at_rest", self.begins_at_rest.to_string()),
        ];
        let said = said.map(|(key, value)| (key.to_owned(), value));
        Identity::new(said.into_iter().chain(parameters))
    }

    /// Checks that any trial can run, whatever its draws: the longest trial can.
    fn check(&self) -> Result<(), RideProblem> {
        if self.measure.rests() {
            self.still()?;
        }
        if self.measure.rides() {
            let (from, to) = self.trip(0, Ending::Commanded).course()?.uniform_motion();
            let must_be_uniform = matches!(self.measure, Measure::Jam | Measure::SwitchedOn);
            if must_be_uniform && to - from < 1e-6 {
                return Err(RideProblem::NeverUniform(self.keys.distance.get()));
            }
            self.ride(|| 1.0)?;
        }
        Ok(())
    }

    /// A rest without a ride.
    ///
    /// # Errors
    /// If the ride is too long to be held in memory.
    pub fn still(&self) -> Result<Ride, RideError> {
        Ride::still(self.keys.rate, self.keys.length.get())
    }

    /// A ride. `uniform` gives numbers in [0, 1], which set its rests and the moment of a jam.
    ///
    /// # Errors
    /// If the ride is too long to be held in memory.
    pub fn ride(&self, mut uniform: impl FnMut() -> f64) -> Result<Ride, RideError> {
        let [shortest, longest] = self.keys.rest;
        let rests = (0..=self.keys.trips).map(|_| shortest + (longest - shortest) * uniform());
        let rests = rests.collect();
        let mut trips: Vec<Trip> = (0..self.keys.trips)
            .map(|index| self.trip(index, Ending::Commanded))
            .collect();
        if let (Measure::Jam, Some(last)) = (self.measure, trips.last_mut()) {
            let refused = |reason| RideError::Trip { number: 1, reason };
            let (from, to) = last.course().map_err(refused)?.uniform_motion();
            last.ending = Ending::Jam {
                after: (from + (to - from) * uniform()).min(to),
                within: self.keys.jam_within.get(),
            };
        }
        Ride::new(self.keys.rate, rests, trips)
    }

    fn trip(&self, index: usize, ending: Ending) -> Trip {
        let sign = if index.is_multiple_of(2) { 1.0 } else { -1.0 };
        Trip {
            distance: sign * self.keys.distance.get(),
            drive: self.keys.drive(),
            ending,
        }
    }
}

impl RideKeys {
    fn check(&self) -> Result<(), RideProblem> {
        Rule::Within(1.0, MOST_TRIPS as f64, "").check("ride.trips", &self.trips)?;
        let [shortest, longest] = self.rest;
        if !(0.0 < shortest && shortest <= longest) {
            let rule = "be two lengths in s, [shortest, longest]";
            let got = format_args!("[{shortest}, {longest}]");
            return Err(OutOfRange::new("ride.rest", rule, got).into());
        }
        Ok(())
    }

    /// The limits of a trip's motion.
    pub fn drive(&self) -> Drive {
        Drive {
            speed: self.speed.get(),
            acceleration: self.acceleration.get(),
            jerk: self.jerk.get(),
        }
    }

    fn sigma(&self) -> Result<f64, RideProblem> {
        match (self.sigma, self.density, self.delta_over_sigma) {
            (None, None, None) => Ok(SIGMA),
            (Some(sigma), None, None) => Ok(sigma),
            (None, Some(density), None) => Ok(density.get() * libm::sqrt(self.rate / 2.0)),
            (None, None, Some(ratio)) => Ok(self.acceleration.get() / ratio.get()),
            _ => Err(RideProblem::Strength),
        }
    }

    fn pickup(&self) -> Result<Pickup, RideProblem> {
        Ok(Pickup {
            sensor: Sensor::from_ar(self.ar.clone())?,
            digitiser: Digitiser::from((self.quantum, None)),
            vibration: self.vibration,
            impulses: Impulses {
                nu: self.nu,
                theta: self.theta,
                ..Impulses::default()
            },
            disturbance: Disturbance {
                footfalls: self.footfalls,
                jolt: self.jolt,
                ..Disturbance::default()
            },
            ..Pickup::white(self.sigma()?)
        }
        .checked()?)
    }
}
