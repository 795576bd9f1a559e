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
use super::climb::Climb;
use super::column::{Column, GAIN, Known, UNLIKE, read};
use super::height_faults::faults;
use super::height_warning::HeightWarning;
use super::record::Tracked;
use super::rested::noise;
use super::still::{Rest, is_frozen, step};
use super::unseen::Unseen;
use crate::recording::{Barometer, Pressure};
use libm::hypot;

/// The error of a rest that lies between two steps of the sensor, in steps: 1/√12.
const ROUNDED: f64 = 0.288_675_134_594_813;

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
    /// Its steps, where they are coarser than that, m.
    pub step: Option<f64>,
    /// How the clocks were brought together, where that was needed.
    pub alignment: Option<Alignment>,
    /// What it reads before and after each trip, where it reads anything.
    pub(super) rests: Vec<[Option<Known>; 2]>,
    /// What is wrong with the barometer.
    pub faults: Vec<HeightWarning>,
    /// The numbers of trips whose distances are unlike.
    pub unlike: Vec<usize>,
    /// Whether up is down, if the barometer tells.
    pub upside_down: Option<bool>,
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
        let upside_down = upside_down(trips, &known, is_like);
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
            step: step.map(|it| metres(it, kelvin.0)),
            alignment: None,
            faults: faults(trips, &rests, unseen, &readings, (second, finest, rounded)),
            readings: above_first(&readings, kelvin.0),
            rests: read(&rests, readings.first(), (second, rounded), kelvin.0),
            unlike: unlike.into_iter().map(|(ride, ..)| ride).collect(),
            upside_down,
        }
    }
}

/// Whether up is down: what the barometer has as far as the accelerometer has it, up or down, says which it is.
fn upside_down(
    trips: &[Tracked],
    known: &[(usize, Column)],
    is_like: impl Fn(&Column, f64, f64) -> bool,
) -> Option<bool> {
    let ways = known.iter().filter_map(|(place, column)| {
        let trip = &trips[*place];
        let size = trip.distance.map(f64::abs).zip(trip.deviation);
        let up = Column {
            log_ratio: column.log_ratio.abs(),
            ..*column
        };
        let is_seen = size.is_none_or(|(distance, deviation)| is_like(&up, distance, deviation));
        let is_clear = up.log_ratio > UNLIKE * column.deviation;
        (is_seen && is_clear).then_some(trip.trip.direction.sign() * column.log_ratio < 0.0)
    });
    let ways: Vec<bool> = ways.collect();
    let first = ways.first().copied();
    first.filter(|first| ways.iter().all(|way| way == first))
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
