//! The guard line above a baseline.

use crate::stats::normal::two_sided_quantile;
use libm::{exp, log, sqrt};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How a guard line follows from energies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Guard {
    /// μ + 3σ, as printed, whatever rate is asked for.
    Printed,
    /// The k-th largest of n, k = ⌊α (n + 1)⌋; where that is 0 there is none.
    #[default]
    OrderStatistic,
    /// The quantile of a log-normal law with the mean and the deviation of the logarithms. Its rate is a guess: by how a lift
    /// shakes it may be a tenth or three times of what is asked for.
    LogNormal,
}

/// Three deviations.
const PRINTED: f64 = 3.0;

impl Guard {
    /// The one to take: the order statistic where so many windows have one at this rate of false alarms, a window.
    pub fn of(windows: usize, rate: f64) -> Self {
        if place(windows, rate) > 0 {
            Self::OrderStatistic
        } else {
            Self::LogNormal
        }
    }

    /// Its name in words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Printed => "μ + 3σ",
            Self::OrderStatistic => "by order statistic",
            Self::LogNormal => {
                "of a log-normal law (a guess: windows are too few for so rare an alarm)"
            }
        }
    }

    /// The line, m²/s⁴, for a rate of false alarms, a window; none of too few energies.
    pub fn line(self, mut energies: Vec<f64>, rate: f64) -> Option<f64> {
        match self {
            Self::Printed => {
                let (mean, deviation) = moments(&energies)?;
                Some(mean + PRINTED * deviation)
            }
            Self::OrderStatistic => {
                let number = energies.len();
                let place = number.checked_sub(Some(place(number, rate)).filter(|it| *it > 0)?)?;
                Some(*energies.select_nth_unstable_by(place, f64::total_cmp).1)
            }
            Self::LogNormal => {
                energies.iter_mut().for_each(|it| *it = log(*it));
                let (mean, deviation) = moments(&energies)?;
                // P(|Z| > z) is twice the rate.
                Some(exp(mean + two_sided_quantile(1.0 - 2.0 * rate) * deviation))
            }
        }
    }

    /// The same where a trip was left out: of windows too few for the rate the largest.
    fn line_of_fewer(self, energies: Vec<f64>, rate: f64) -> Option<f64> {
        let lowest = match self {
            Self::OrderStatistic => 1.0 / (energies.len() + 1) as f64,
            Self::Printed | Self::LogNormal => 0.0,
        };
        self.line(energies, rate.max(lowest))
    }
}

/// k = ⌊α (n + 1)⌋, up to what rounding takes from a whole number.
fn place(number: usize, rate: f64) -> usize {
    (rate * (number + 1) as f64 * (1.0 + 1e-12)).floor() as usize
}

fn moments(values: &[f64]) -> Option<(f64, f64)> {
    let number = values.len() as f64;
    if number < 2.0 {
        return None;
    }
    let mean = values.iter().sum::<f64>() / number;
    let squares: f64 = values.iter().map(|it| (it - mean) * (it - mean)).sum();
    Some((mean, sqrt(squares / (number - 1.0))))
}

/// A guard line and what it does.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GuardLine {
    /// How it follows.
    pub guard: Guard,
    /// m²/s⁴.
    pub energy: f64,
    /// The rate of false alarms that was asked for, a window.
    pub rate: f64,
    /// The share of windows above the line that all other trips give, trip by trip.
    pub per_window: f64,
    /// The share of trips with such a window.
    pub per_trip: f64,
}

impl GuardLine {
    /// Learnt from these trips; none from too few.
    pub fn new(guard: Guard, trips: &[Vec<f64>], rate: f64) -> Option<Self> {
        let energy = guard.line(trips.concat(), rate)?;
        let (mut windows, mut alarmed) = (0, 0);
        for (place, trip) in trips.iter().enumerate() {
            let others = trips.iter().enumerate().filter(|(at, _)| *at != place);
            let others: Vec<f64> = others.flat_map(|(_, it)| it.iter().copied()).collect();
            let line = guard.line_of_fewer(others, rate)?;
            let above = trip.iter().filter(|it| **it > line).count();
            windows += above;
            alarmed += usize::from(above > 0);
        }
        let number = trips.iter().map(Vec::len).sum::<usize>();
        Some(Self {
            guard,
            energy,
            rate,
            per_window: windows as f64 / number as f64,
            per_trip: alarmed as f64 / trips.len() as f64,
        })
    }
}
