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

use super::air::{Air, FREEZING, INDOORS, above_first, kelvin, metres};
use super::alignment::Alignment;
use super::climb::{Climb, Standing};
use super::filter::Uncertain;
use super::fusion::{Leg, Reading, UNKNOWN, stays};
use super::height_warning::HeightWarning;
use super::record::{Track, Tracked};
use super::rested::noise;
use super::still::{Rest, is_frozen, silence, step, usual_interval};
use super::unseen::Unseen;
use crate::recording::{Barometer, Pressure};
use libm::hypot;
use std::f64::consts::SQRT_2;

/// The error of an accelerometer's gain.
const GAIN: f64 = 0.01;

/// The error of a rest that lies between two steps of the sensor, in steps: 1/√12.
const ROUNDED: f64 = 0.288_675_134_594_813;

/// What is not known better is not said, m.
const VAGUE: f64 = 30.0;

/// How fast the weather may change the pressure, Pa/s: 0.3 hPa an hour; and so many times that, in a storm.
const WEATHER: f64 = 30.0 / 3600.0;
const STORM: f64 = 10.0;

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
    /// That of the mean of a second of them, m.
    pub second: f64,
    /// Its steps, where they are coarser than that, m.
    pub step: Option<f64>,
    /// How the clocks were brought together, where that was needed.
    pub alignment: Option<Alignment>,
    /// What it reads before and after each trip, where it reads anything.
    rests: Vec<[Option<Known>; 2]>,
    /// What is wrong with the barometer.
    pub faults: Vec<HeightWarning>,
    /// The numbers of trips whose distances are unlike.
    pub unlike: Vec<usize>,
    /// Whether up is down, if the barometer tells.
    pub upside_down: Option<bool>,
}

impl Track {
    /// Gives each trip its height, and the position after it, as far as that is known, unless the barometer froze.
    pub fn rise(&mut self, climbs: &Climbs, unseen: &Unseen) {
        for (trip, climb) in self.trips.iter_mut().zip(&climbs.climbs) {
            trip.climb = *climb;
        }
        let is_frozen = |it: &HeightWarning| matches!(it, HeightWarning::Frozen { .. });
        if climbs.faults.iter().any(is_frozen) {
            return;
        }
        let stays = stays(&climbs.legs(&self.trips, unseen), |_| None);
        // An error of the air's temperature is one of all heights.
        let scale = climbs.air.deviation / (climbs.air.celsius + FREEZING);
        for (trip, stays) in self.trips.iter_mut().zip(stays.windows(2)) {
            let Uncertain { mean, variance } = stays[1].begin;
            let is_known = trip.trip.stop.is_some() && variance < VAGUE * VAGUE;
            trip.unseen = stays[0].unseen;
            trip.standing = is_known.then(|| Standing {
                position: mean,
                position_deviation: hypot(variance.sqrt(), scale * mean),
            });
        }
    }
}

impl Climbs {
    /// Of trips in order of time, between which the car may go unseen, and whose clock is so much ahead of the barometer's, s. The
    /// air's temperature is given, °C, or learnt.
    pub fn of(
        trips: &[Tracked],
        unseen: &Unseen,
        barometer: &Barometer,
        ahead: f64,
        celsius: Option<f64>,
    ) -> Self {
        let readings: Vec<Pressure> = (barometer.readings.iter())
            .map(|it| Pressure {
                time: it.time + ahead,
                ..*it
            })
            .collect();
        let finest = step(&readings);
        let rests: Vec<[Rest; 2]> = (0..trips.len())
            .map(|at| Rest::around(trips, at, unseen, &readings, finest))
            .collect();
        let (noise, second) = noise(rests.iter().flatten().map(|it| &it.read));
        let step = Some(finest).filter(|step| *step > noise);
        // A rest that lies between two steps reads one of them all the time.
        let rounded = step.unwrap_or_default() * ROUNDED;
        let columns = trips.iter().zip(&rests).map(|(trip, [before, after])| {
            let column = Column::between(before, after, second, rounded);
            column.filter(|_| !is_frozen(trip, &readings, finest))
        });
        let columns: Vec<Option<Column>> = columns.collect();
        let known: Vec<(usize, Column)> = columns
            .iter()
            .enumerate()
            .filter_map(|(place, column)| Some((place, (*column)?)))
            .collect();
        let usual = (
            kelvin(celsius),
            celsius.map_or(INDOORS.1, |_| GAIN * INDOORS.0),
        );
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
            second: metres(second, kelvin.0),
            step: step.map(|it| metres(it, kelvin.0)),
            alignment: None,
            faults: faults(trips, &rests, &readings, (second, finest, rounded)),
            readings: above_first(&readings, kelvin.0),
            rests: read(&rests, readings.first(), (second, rounded), kelvin.0),
            unlike: unlike.into_iter().map(|(ride, ..)| ride).collect(),
            upside_down,
        }
    }
}

/// A reading of a rest, and when the first and the last of its parts were taken, s.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Known {
    reading: Reading,
    times: (f64, f64),
}

/// The heights of rests above the first reading, of a barometer with this noise of a second and this error by its steps.
fn read(
    rests: &[[Rest; 2]],
    first: Option<&Pressure>,
    (second, rounded): (f64, f64),
    kelvin: f64,
) -> Vec<[Option<Known>; 2]> {
    let zero = first.map_or(0.0, |it| it.pascal.ln());
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

impl Climbs {
    /// The trips with what the barometer reads around them. Where two rests are one it is read once.
    pub fn legs(&self, trips: &[Tracked], unseen: &Unseen) -> Vec<Leg> {
        // A temperature that is learnt of trips has the gain of the accelerometer.
        let gain = if self.air.learnt > 0 { 0.0 } else { GAIN };
        let mut read = f64::NEG_INFINITY;
        let mut stood = f64::NEG_INFINITY;
        let legs = trips.iter().zip(&self.rests).map(|(it, [before, after])| {
            let start = it.trip.start.unwrap_or(stood);
            let distance = it.distance.zip(it.deviation);
            let is_known = it.trip.stop.is_some() && unseen.is_decided(&it.trip);
            let distance = distance
                .filter(|_| is_known)
                .map(|(mean, deviation)| Uncertain {
                    mean,
                    variance: deviation.powi(2) + (gain * mean).powi(2),
                });
            let before = before.filter(|it| it.times.0 > read);
            read = after.map_or(read, |it| it.times.1);
            let around = unseen.around(start, it.trip.stop.unwrap_or(f64::INFINITY));
            let is_unseen = unseen.within(stood, around.start).next().is_some();
            stood = around.end;
            Leg {
                distance: distance.unwrap_or(UNKNOWN),
                before: before.map(|it| it.reading),
                after: after.map(|it| it.reading),
                is_unseen,
            }
        });
        legs.collect()
    }
}

/// What is wrong with a barometer with this noise of a second, these steps, and this error of a difference by them.
fn faults(
    trips: &[Tracked],
    rests: &[[Rest; 2]],
    readings: &[Pressure],
    (second, step, rounded): (f64, f64, f64),
) -> Vec<HeightWarning> {
    let usual = usual_interval(readings);
    let jumps = |log: f64| log.abs() > Rest::jump(step);
    let of_trips = trips
        .iter()
        .zip(rests)
        .zip(1..)
        .flat_map(|((trip, [before, after]), next)| {
            let ride = trip.trip.ride;
            let frozen = is_frozen(trip, readings, step);
            let frozen = frozen.then_some(HeightWarning::Frozen {
                ride,
                distance: trip.distance,
            });
            let silent = silence(trip, readings, usual)
                .map(|seconds| HeightWarning::Silent { ride, seconds });
            let within = [before, after].map(|it| it.jump);
            // The rest after it, which may be too long to be looked at as a whole.
            let across = rests.get(next).and_then(|[other, _]| {
                let column = Column::between(after, other, second, rounded)?;
                let is_clear = column.log_ratio.abs() > UNLIKE * column.deviation;
                let is_within = after.jump.or(other.jump).is_some();
                // A barometer that drifts does not jump.
                let seconds = other.read.time - after.read.time;
                let storm = STORM * WEATHER * seconds / after.read.mean.exp();
                let is_jump = jumps(column.log_ratio) && column.log_ratio.abs() > storm;
                (is_clear && !is_within && is_jump).then_some(column.log_ratio)
            });
            let jumped = within.into_iter().chain([across]).flatten();
            let jumped = jumped.map(move |log| HeightWarning::Jump {
                ride,
                metres: metres(log, INDOORS.0),
            });
            frozen
                .into_iter()
                .chain(silent)
                .chain(jumped)
                .collect::<Vec<_>>()
        });
    of_trips.collect()
}

impl Column {
    /// Between two rests of a barometer with this noise of the mean of a second and this error of a rest by its steps.
    fn between(one: &Rest, other: &Rest, second: f64, rounded: f64) -> Option<Self> {
        let printed = other.standard_altitude() - one.standard_altitude();
        let [one, other] = [one, other].map(|it| &it.read);
        let seconds = other.time - one.time;
        let weather = WEATHER * seconds / one.mean.exp();
        let readings = second * (one.of_mean() + other.of_mean()).sqrt();
        let deviation = hypot(hypot(readings, weather), SQRT_2 * rounded);
        let log_ratio = one.mean - other.mean;
        (one.count > 0.0 && other.count > 0.0).then_some(Self {
            log_ratio,
            deviation,
            printed,
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
