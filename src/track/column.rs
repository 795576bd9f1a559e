//! The air at rest and between the ends of a trip, as a barometer reads it.

use super::air::metres;
use super::climb::Climb;
use super::filter::Uncertain;
use super::fusion::Reading;
use super::still::Rest;
use crate::recording::Pressure;
use libm::{exp, hypot, log};
use std::f64::consts::SQRT_2;

/// The error of an accelerometer's gain.
pub(super) const GAIN: f64 = 0.01;

/// How fast the weather may change the pressure, Pa/s: 0.3 hPa an hour.
pub(super) const WEATHER: f64 = 30.0 / 3600.0;

/// A barometer and an accelerometer that differ by more, in deviations, do not tell of one trip, or not of one direction.
pub(super) const UNLIKE: f64 = 4.0;

/// Such air.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Column {
    /// ln(p₁/p₂): up positive.
    pub log_ratio: f64,
    /// Of that.
    pub deviation: f64,
    /// By eq. (5), m.
    pub printed: f64,
}

impl Column {
    /// Between two rests of a barometer with this noise of the mean of a second and this error of a rest by its steps.
    pub fn between(one: &Rest, other: &Rest, second: f64, rounded: f64) -> Option<Self> {
        let printed = other.standard_altitude() - one.standard_altitude();
        let [one, other] = [one, other].map(|it| &it.read);
        let seconds = other.time - one.time;
        let weather = WEATHER * seconds / exp(one.mean);
        let readings = second * (one.of_mean() + other.of_mean()).sqrt();
        let deviation = hypot(hypot(readings, weather), SQRT_2 * rounded);
        let log_ratio = one.mean - other.mean;
        (one.count > 0.0 && other.count > 0.0).then_some(Self {
            log_ratio,
            deviation,
            printed,
        })
    }

    /// Its height in air of this temperature, K, and its deviation.
    pub fn climb(&self, (kelvin, deviation): (f64, f64)) -> Climb {
        let of_air = metres(self.log_ratio, deviation);
        Climb {
            height: metres(self.log_ratio, kelvin),
            height_deviation: hypot(metres(self.deviation, kelvin), of_air),
            height_printed: self.printed,
        }
    }
}

/// A reading of a rest, and when the first and the last of its parts were taken, s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Known {
    pub reading: Reading,
    pub times: (f64, f64),
}

/// The heights of rests above the first reading, of a barometer with this noise of a second and this error by its steps.
pub(super) fn read(
    rests: &[[Rest; 2]],
    first: Option<&Pressure>,
    (second, rounded): (f64, f64),
    kelvin: f64,
) -> Vec<[Option<Known>; 2]> {
    let zero = first.map_or(0.0, |it| log(it.pascal));
    let known = |of: &Rest| {
        let read = &of.read;
        let variance = second * second * read.of_mean() + rounded * rounded;
        let reading = Reading {
            time: read.time,
            height: Uncertain {
                mean: metres(zero - read.mean, kelvin),
                variance: metres(variance.sqrt(), kelvin).powi(2),
            },
        };
        let times = read.times()?;
        Some(Known { reading, times })
    };
    rests.iter().map(|it| it.each_ref().map(known)).collect()
}
