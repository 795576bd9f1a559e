//! What vibration is usual.

use super::guard::{Guard, GuardLine};
use libm::{ceil, sqrt};

/// It has settled with so many windows, the least with which the order statistic has one false alarm in a thousand, ...
const LEAST_WINDOWS: usize = 999;

/// ... so many trips, from which a standard error can be told, ...
const LEAST_TRIPS: usize = 10;

/// ... and a standard error of this share of the mean; ...
const ACCURACY: f64 = 0.05;

/// ... or with so many windows whatever that is.
const MOST_WINDOWS: usize = 100_000;

/// No energy is larger, m²/s⁴, and no rate, Hz.
const MOST: f64 = 1e9;

/// The energies of the windows of several trips, m²/s⁴.
#[derive(Clone, Debug, PartialEq)]
pub struct Baseline {
    rate: f64,
    trips: Vec<Vec<f64>>,
}

/// What a trip did to a baseline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Learning {
    /// It was learnt.
    Learnt,
    /// The very same trip had been learnt before.
    Known,
    /// It has no window.
    Nothing,
}

/// Numbers that are no baseline.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub(super) enum BaselineError {
    #[error(
        "rate: must be positive and at most {MOST}, got {0} (restore it, or remove it and begin anew)"
    )]
    Rate(f64),
    #[error(
        "trips[{trip}]: must hold energies that are positive and at most {MOST}, got {got} (restore it, or remove it and begin anew)"
    )]
    Energy { trip: usize, got: f64 },
    #[error("trips[{0}]: must have a window (restore it, or remove it and begin anew)")]
    Empty(usize),
}

impl Baseline {
    /// Of no trips yet, from records of this rate, Hz.
    pub fn new(rate: f64) -> Self {
        Self {
            rate,
            trips: Vec::new(),
        }
    }

    /// Checks what a file holds.
    pub(super) fn known(rate: f64, trips: Vec<Vec<f64>>) -> Result<Self, BaselineError> {
        let is_good = |it: f64| it > 0.0 && it <= MOST;
        if !is_good(rate) {
            return Err(BaselineError::Rate(rate));
        }
        for (place, trip) in trips.iter().enumerate() {
            if trip.is_empty() {
                return Err(BaselineError::Empty(place));
            }
            if let Some(got) = trip.iter().find(|it| !is_good(**it)) {
                let (trip, got) = (place, *got);
                return Err(BaselineError::Energy { trip, got });
            }
        }
        Ok(Self { rate, trips })
    }

    /// The rate of the records, Hz.
    pub fn rate(&self) -> f64 {
        self.rate
    }

    /// The energies, trip by trip.
    pub fn trips(&self) -> &[Vec<f64>] {
        &self.trips
    }

    /// Takes the energies of a trip. One with the same is the same trip of the same record.
    pub fn learn(&mut self, energies: Vec<f64>) -> Learning {
        if energies.is_empty() {
            Learning::Nothing
        } else if self.trips.contains(&energies) {
            Learning::Known
        } else {
            self.trips.push(energies);
            Learning::Learnt
        }
    }

    /// The number of windows.
    pub fn windows(&self) -> usize {
        self.trips.iter().map(Vec::len).sum()
    }

    /// The mean energy of a window; none of no windows.
    pub fn mean(&self) -> Option<f64> {
        let sum: f64 = self.trips.iter().flatten().sum();
        (!self.trips.is_empty()).then(|| sum / self.windows() as f64)
    }

    /// The standard error of the mean: it is Σ S over Σ n of trips with sums S and n windows, and of such a ratio the variance is
    /// T/(T − 1) Σ (S − mean n)² over (Σ n)², in first order. None of fewer than two trips.
    pub fn standard_error(&self) -> Option<f64> {
        let mean = self.mean().filter(|_| self.trips.len() > 1)?;
        let squares = self.trips.iter().map(|trip| {
            let off = trip.iter().sum::<f64>() - mean * trip.len() as f64;
            off * off
        });
        let trips = self.trips.len() as f64;
        let variance = trips / (trips - 1.0) * squares.sum::<f64>();
        Some(sqrt(variance) / self.windows() as f64)
    }

    /// Whether it has been learnt.
    pub fn has_settled(&self) -> bool {
        let windows = self.windows();
        let error = self.standard_error().zip(self.mean());
        let is_small = error.is_some_and(|(error, mean)| error <= ACCURACY * mean);
        let is_enough = windows >= LEAST_WINDOWS && self.trips.len() >= LEAST_TRIPS;
        is_enough && (is_small || windows >= MOST_WINDOWS)
    }

    /// About how many trips it takes, as far as the trips so far show it; none of no trips.
    pub fn expected_trips(&self) -> Option<usize> {
        if self.trips.is_empty() {
            return None;
        }
        let trips = self.trips.len() as f64;
        let a_trip = self.windows() as f64 / trips;
        let of = |windows: usize| ceil(windows as f64 / a_trip);
        let error = self.standard_error().zip(self.mean());
        // The square of the error falls with the number of trips.
        let known = error.map_or(0.0, |(error, mean)| {
            let over = error / (ACCURACY * mean);
            ceil(trips * over * over)
        });
        let least = of(LEAST_WINDOWS).max(LEAST_TRIPS as f64);
        Some(least.max(known.min(of(MOST_WINDOWS))) as usize)
    }

    /// The guard line for a rate of false alarms, a window; none of too few windows.
    pub fn guard(&self, rate: f64) -> Option<GuardLine> {
        GuardLine::new(Guard::of(self.windows(), rate), &self.trips, rate)
    }
}
