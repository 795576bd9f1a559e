//! How high trips went by the pressure of the air, and which way is up.
//!
//! Between two pressures lie (R T/g) ln(p₁/p₂) metres of air of temperature T. [^1], eq. (5), has an altitude in the
//! standard atmosphere instead, whose air is colder than that of a building by 5 to 25 K: its heights are too short in
//! proportion, by 2 to 8 %. T is given, or learnt from trips whose distance the accelerometer knows: then the accelerometer
//! fixes the scale and the barometer what drifts.
//!
//! The pressure at either end of a trip is the mean of the nearest seconds of rest, without outliers (3 σ, as in [^1]). Its
//! deviation is that of the readings among each other and of the weather since the trip began.
//!
//! [^1]: The monitor with accelerometer and barometer, in Chinese (楊昱等, 太原理工大學學報).

use super::climb::{Climb, Standing};
use super::filter::Uncertain;
use super::fusion::Barometry;
use super::record::{Track, Tracked};
use super::rested::Rested;
use crate::recording::{Barometer, GRAVITY, Pressure};
use libm::hypot;
use serde::Serialize;
use std::fmt;
use std::ops::Range;

/// The gas constant of dry air, J/(kg K).
const DRY_AIR: f64 = 287.05;

/// 0 °C, K.
const FREEZING: f64 = 273.15;

/// The air of a building where nothing is known of it, and its deviation, K.
const INDOORS: (f64, f64) = (FREEZING + 20.0, 10.0);

/// The error of an accelerometer's gain.
const GAIN: f64 = 0.01;

/// The rest that is looked at on either side of a trip, and what is left out beside the trip, where a barometer lags, s.
const REST: f64 = 10.0;
const LAG: f64 = 1.0;

/// How fast the weather may change the pressure, Pa/s: 0.3 hPa an hour.
const WEATHER: f64 = 30.0 / 3600.0;

/// A barometer and an accelerometer that differ by more, in deviations, do not tell of one trip, or not of one direction.
const UNLIKE: f64 = 4.0;

/// The air between the ends of a trip.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Column {
    /// ln(p₁/p₂): up positive.
    log_ratio: f64,
    deviation: f64,
    /// By eq. (5), m.
    printed: f64,
}

/// The temperature of the air.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Air {
    /// °C
    pub celsius: f64,
    /// Its standard deviation, K; 0 if it is given.
    pub deviation: f64,
    /// The number of trips that it is learnt from.
    pub learnt: usize,
}

impl fmt::Display for Air {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:.1} ± {:.1} °C, ", self.celsius, self.deviation)?;
        match self.learnt {
            0 if self.deviation == 0.0 => f.write_str("as given"),
            0 => f.write_str("not learnt: as usual indoors"),
            1 => f.write_str("learnt from 1 ride and what is usual indoors"),
            rides => write!(f, "learnt from {rides} rides and what is usual indoors"),
        }
    }
}

/// The trips of a record by a barometer.
#[derive(Clone, Debug, PartialEq)]
pub struct Climbs {
    /// The temperature that they are reckoned with.
    pub air: Air,
    /// In the order of the trips.
    pub climbs: Vec<Option<Climb>>,
    /// The height of each reading above the first, m, at its time in the record, s.
    pub readings: Vec<(f64, f64)>,
    /// The deviation of a reading, m.
    pub noise: f64,
    /// The error of the mean of a rest that lies between two steps of the sensor, m.
    pub rounded: f64,
    /// The numbers of trips whose distances are unlike.
    pub unlike: Vec<usize>,
    /// Whether up is down, if the barometer tells.
    pub upside_down: Option<bool>,
}

impl Track {
    /// Gives each trip its height, and the position after it; the car may go `unseen` between these times, s.
    pub fn rise(&mut self, climbs: &Climbs, unseen: &[Range<f64>]) {
        let barometry = Barometry {
            readings: &climbs.readings,
            noise: climbs.noise,
            rounded: climbs.rounded,
        };
        let stays = barometry.stays(&self.trips, unseen, |_| None);
        // An error of the air's temperature is one of all heights.
        let scale = climbs.air.deviation / (climbs.air.celsius + FREEZING);
        let each = stays.windows(2).zip(&climbs.climbs);
        for (trip, (stays, climb)) in self.trips.iter_mut().zip(each) {
            let Uncertain { mean, variance } = stays[1].begin;
            trip.climb = *climb;
            trip.unseen = stays[0].unseen;
            trip.standing = trip.trip.stop.map(|_| Standing {
                position: mean,
                position_deviation: hypot(variance.sqrt(), scale * mean),
            });
        }
    }
}

impl Climbs {
    /// Of trips in order of time, whose clock is so much ahead of the barometer's, s. The air's temperature is given, °C, or
    /// learnt.
    pub fn of(trips: &[Tracked], barometer: &Barometer, ahead: f64, celsius: Option<f64>) -> Self {
        let readings: Vec<Pressure> = (barometer.readings.iter())
            .map(|it| Pressure {
                time: it.time + ahead,
                ..*it
            })
            .collect();
        let logs = readings.iter().map(|it| (it.time, it.pascal.ln()));
        let logs: Vec<(f64, f64)> = logs.collect();
        let rests: Vec<[Rested; 2]> = (0..trips.len())
            .map(|at| rests(trips, at).map(|rest| Rested::of(&logs, &rest.unwrap_or(NONE))))
            .collect();
        let noise = noise(rests.as_flattened());
        let step = Some(step(&readings)).filter(|step| *step > noise);
        // A rest that lies between two steps reads one of them all the time.
        let rounded = step.unwrap_or(0.0) / 6f64.sqrt();
        let columns: Vec<Option<Column>> = rests
            .iter()
            .map(|[before, after]| Column::between(before, after, noise, rounded))
            .collect();
        let known: Vec<(usize, Column)> = columns
            .iter()
            .enumerate()
            .filter_map(|(place, column)| Some((place, (*column)?)))
            .collect();
        let usual = celsius.map_or(INDOORS, |it| (it + FREEZING, GAIN * INDOORS.0));
        let is_like = |column: &Column, distance: f64, deviation: f64| {
            let climb = column.climb(usual);
            (climb.height - distance).abs() <= UNLIKE * hypot(climb.height_deviation, deviation)
        };
        // What the barometer has as far as the accelerometer has it, up or down, says which it is.
        let ways = known.iter().filter_map(|(place, column)| {
            let trip = &trips[*place];
            let size = trip.distance.map(f64::abs).zip(trip.deviation);
            let up = Column {
                log_ratio: column.log_ratio.abs(),
                ..*column
            };
            let is_seen =
                size.is_none_or(|(distance, deviation)| is_like(&up, distance, deviation));
            let is_clear = up.log_ratio > UNLIKE * column.deviation;
            (is_seen && is_clear).then_some(trip.trip.direction.sign() * column.log_ratio < 0.0)
        });
        let ways: Vec<bool> = ways.collect();
        let upside_down = ways.first().copied();
        let upside_down = upside_down.filter(|first| ways.iter().all(|way| way == first));
        let sign = if upside_down == Some(true) { -1.0 } else { 1.0 };
        let pairs = known.iter().filter_map(|(place, column)| {
            let trip = &trips[*place];
            let (distance, deviation) = trip.distance.zip(trip.deviation)?;
            trip.trip.stop?;
            Some((trip.trip.ride, *column, sign * distance, deviation))
        });
        let (like, unlike): (Vec<_>, Vec<_>) = pairs
            .partition(|(_, column, distance, deviation)| is_like(column, *distance, *deviation));
        let air = match celsius {
            Some(celsius) => Air {
                celsius,
                deviation: 0.0,
                learnt: 0,
            },
            None => learn(&like),
        };
        let kelvin = (air.celsius + FREEZING, air.deviation);
        Self {
            air,
            climbs: columns
                .iter()
                .map(|it| Some((*it)?.climb(kelvin)))
                .collect(),
            noise: metres(noise, kelvin.0),
            rounded: metres(rounded, kelvin.0),
            readings: readings
                .iter()
                .map(|it| {
                    (
                        it.time,
                        metres((readings[0].pascal / it.pascal).ln(), kelvin.0),
                    )
                })
                .collect(),
            unlike: unlike.into_iter().map(|(ride, ..)| ride).collect(),
            upside_down,
        }
    }
}

/// The height of the air between pressures of which this is the logarithm of the ratio, m.
fn metres(log_ratio: f64, kelvin: f64) -> f64 {
    DRY_AIR * kelvin / GRAVITY * log_ratio
}

impl Column {
    /// Between two rests of a barometer with this noise of a reading and this error of a difference by its steps.
    fn between(one: &Rested, other: &Rested, noise: f64, rounded: f64) -> Option<Self> {
        let seconds = other.time - one.time;
        let weather = WEATHER * seconds / one.mean.exp();
        let readings = noise * (one.of_mean() + other.of_mean()).sqrt();
        let deviation = hypot(hypot(readings, weather), rounded);
        let [start, stop] = [one, other].map(standard_altitude);
        let log_ratio = one.mean - other.mean;
        (one.count > 0.0 && other.count > 0.0).then_some(Self {
            log_ratio,
            deviation,
            printed: stop - start,
        })
    }

    fn climb(&self, (kelvin, deviation): (f64, f64)) -> Climb {
        let of_air = metres(self.log_ratio, deviation);
        Climb {
            height: metres(self.log_ratio, kelvin),
            height_deviation: hypot(metres(self.deviation, kelvin), of_air),
            height_printed: self.printed,
        }
    }
}

/// The temperature that makes heights of distances, with what air indoors is like. The accelerometer's gain is an error of all
/// distances alike.
fn learn(trips: &[(usize, Column, f64, f64)]) -> Air {
    let (usual, spread) = INDOORS;
    let (mut weight, mut sum) = (0.0, 0.0);
    for (_, column, distance, deviation) in trips {
        // Metres for each kelvin.
        let slope = metres(column.log_ratio, 1.0);
        let variance = deviation * deviation + metres(column.deviation, usual).powi(2);
        weight += slope * slope / variance;
        sum += slope * distance / variance;
    }
    let of_trips = hypot((1.0 / weight).sqrt(), GAIN * usual);
    let [trips_weigh, usual_weighs] = [of_trips, spread].map(|it| 1.0 / (it * it));
    let all = trips_weigh + usual_weighs;
    let learnt = if weight > 0.0 { sum / weight } else { usual };
    Air {
        celsius: (trips_weigh * learnt + usual_weighs * usual) / all - FREEZING,
        deviation: (1.0 / all).sqrt(),
        learnt: trips.len(),
    }
}

/// In the standard atmosphere, m.
fn standard_altitude(rest: &Rested) -> f64 {
    let (time, pascal) = (rest.time, rest.mean.exp());
    Pressure { time, pascal }.standard_altitude()
}

/// No time at all.
const NONE: Range<f64> = f64::INFINITY..f64::NEG_INFINITY;

/// The rest before a trip and that after it, as far as they are looked at; none where that end is not recorded, nor that of
/// the trip on its other side.
fn rests(trips: &[Tracked], at: usize) -> [Option<Range<f64>>; 2] {
    let trip = &trips[at].trip;
    let begin = trips[..at]
        .last()
        .map_or(Some(f64::NEG_INFINITY), |it| it.trip.stop);
    let end = trips
        .get(at + 1)
        .map_or(Some(f64::INFINITY), |it| it.trip.start);
    let before = begin.zip(trip.start);
    let after = trip.stop.zip(end);
    [
        before.map(|(begin, start)| (begin + LAG).max(start - REST)..start),
        after.map(|(stop, end)| stop + LAG..end.min(stop + LAG + REST)),
    ]
}

/// The smallest change from one reading to the next, as a logarithm.
fn step(readings: &[Pressure]) -> f64 {
    let changes = readings
        .windows(2)
        .map(|pair| (pair[1].pascal / pair[0].pascal).ln().abs());
    let step = changes
        .filter(|change| *change > 0.0)
        .fold(f64::INFINITY, f64::min);
    if step.is_finite() { step } else { 0.0 }
}

/// The deviation of readings among each other, as logarithms.
fn noise(rests: &[Rested]) -> f64 {
    let squares = rests.iter().flat_map(|rest| &rest.off).map(|off| off * off);
    let spare: f64 = rests.iter().map(|rest| (rest.count - 1.0).max(0.0)).sum();
    (squares.fold(0.0, |sum, square| sum + square) / spare.max(1.0)).sqrt()
}
