//! Clocks brought together, of generated lifts whose offset is known.

use super::{sensor, typical};
use crate::detection::Detection;
use crate::lift::{Ending, Ride, Trip};
use crate::monitor::Settings;
use crate::recording::{Barometer, Pressure, Sample};
use crate::rng::{self, Generator, Stream};
use crate::signal::{Law, Noise};
use crate::track::{AlignmentError, Track};
use std::collections::BTreeMap;

const RATE: f64 = 50.0;

/// A lift and what both sensors record of it.
struct Recorded {
    detection: Detection,
    track: Track,
    barometer: Barometer,
    /// How far the accelerometer's clock is ahead, with the barometer's lag, s.
    ahead: f64,
}

/// What differs from case to case.
#[derive(Clone, Copy, Debug)]
struct Case {
    trips: usize,
    floors: f64,
    /// Hz
    rate: f64,
    /// Of a reading, m.
    noise: f64,
    /// The time constant of the barometer, s.
    lag: f64,
    /// m/s
    weather: f64,
    /// The share of time that both record.
    shared: f64,
    /// Rests are equal, and trips between two floors.
    is_regular: bool,
    /// The accelerometer records two fifths only.
    is_part: bool,
    is_upside_down: bool,
}

fn pick<T: Copy>(draws: &mut Generator, among: &[T]) -> T {
    among[(rng::unit(draws) * among.len() as f64) as usize]
}

fn within(draws: &mut Generator, from: f64, to: f64) -> f64 {
    from + (to - from) * rng::unit(draws)
}

impl Case {
    fn new(draws: &mut Generator) -> Self {
        Self {
            trips: pick(draws, &[1, 2, 3, 4, 6, 8]),
            floors: pick(draws, &[2.0, 4.0, 9.0]),
            rate: pick(draws, &[1.0, 5.0, 10.0, 25.0, 40.0]),
            noise: within(draws, 0.05, 0.4),
            lag: within(draws, 0.0, 1.0),
            // 1 hPa an hour.
            weather: within(draws, -8.3, 8.3) / 3600.0,
            shared: pick(draws, &[1.0, 1.0, 0.8, 0.6]),
            is_regular: rng::unit(draws) < 0.15,
            is_part: rng::unit(draws) < 0.2,
            is_upside_down: rng::unit(draws) < 0.3,
        }
    }

    fn ride(&self, draws: &mut Generator) -> Ride {
        let mut floor = 0.0;
        let trips = (0..self.trips).map(|trip| {
            let to = if self.is_regular {
                [5.0, 0.0][trip % 2]
            } else {
                (floor + 1.0 + (rng::unit(draws) * (self.floors - 1.0)).floor()) % self.floors
            };
            let distance = 3.6 * (to - floor);
            floor = to;
            Trip {
                distance,
                drive: typical(),
                ending: Ending::Commanded,
            }
        });
        let trips: Vec<Trip> = trips.collect();
        let rest = |_| {
            if self.is_regular {
                15.0
            } else {
                within(draws, 8.0, 40.0)
            }
        };
        let rests = (0..=self.trips).map(rest).collect();
        Ride::new(RATE, rests, trips).unwrap()
    }

    fn recorded(&self, seed: u64, draws: &mut Generator) -> Recorded {
        let ride = self.ride(draws);
        let (whole, offset) = (ride.duration(), within(draws, -1000.0, 1000.0));
        // Each record leaves out an end.
        let cut = (1.0 - self.shared) / 2.0 * whole;
        let mut spans = [(cut, whole), (0.0, whole - cut)];
        if rng::unit(draws) < 0.5 {
            spans.reverse();
        }
        if self.is_part {
            let from = within(draws, 0.0, 0.6 * whole);
            spans = [(from, from + 0.4 * whole), (0.0, whole)];
        }
        let [moved, read] = spans;
        let sign = if self.is_upside_down { -1.0 } else { 1.0 };
        let record = ride.simulate(&sensor(), seed, 0).record;
        let samples = record.iter().enumerate().map(|(place, it)| Sample {
            time: place as f64 / RATE,
            acceleration: sign * it,
        });
        let samples = samples.filter(|it| (moved.0..moved.1).contains(&it.time));
        let samples: Vec<Sample> = samples.collect();
        let count = ((read.1 - read.0) * self.rate) as usize;
        let mut noise = vec![0.0; count];
        Noise::new(Law::Normal).unwrap().fill(draws, &mut noise);
        // A first-order lag, sample by sample of the ride.
        let share = 1.0 - (-1.0 / (RATE * self.lag.max(1e-3))).exp();
        let lagged = heights(&ride).into_iter().scan(0.0, |lagged, height| {
            *lagged += share * (height - *lagged);
            Some(*lagged)
        });
        let lagged: Vec<f64> = lagged.collect();
        let readings = noise.iter().enumerate().map(|(at, noise)| {
            let time = read.0 + at as f64 / self.rate;
            let height = lagged[((time * RATE) as usize).min(lagged.len() - 1)];
            let height = height + self.noise * noise + self.weather * time;
            Pressure {
                time: time - offset,
                pascal: 98_000.0 * (-height * 9.80665 / (287.05 * 296.0)).exp(),
            }
        });
        let (detection, track) =
            Track::found(&Settings::default().at(RATE).unwrap(), &samples, None);
        Recorded {
            detection,
            track,
            barometer: barometer(readings.collect()),
            ahead: offset - self.lag,
        }
    }
}

fn heights(ride: &Ride) -> Vec<f64> {
    let mut heights = vec![0.0; ride.samples()];
    for (start, course) in ride.started() {
        let first = (start * RATE) as usize;
        for (place, height) in heights.iter_mut().enumerate().skip(first) {
            let moved = (place as f64 / RATE - start).clamp(0.0, course.duration());
            *height += course.position_at(moved);
        }
    }
    heights
}

fn barometer(readings: Vec<Pressure>) -> Barometer {
    Barometer::of_readings(readings)
}

/// Of 1500 such cases 940 were right, none wrong, and 915 within two deviations, which is 97 %; 208 of the others had no whole
/// ride; of the 127 regular ones among them 102 were ambiguous.
#[test]
fn offsets_are_found_or_refused() {
    let (mut right, mut near, mut refused) = (0, 0, BTreeMap::new());
    for index in 0..240 {
        let draws = &mut Stream::new(7, "alignment", "").at(index);
        let case = Case::new(draws);
        let it = case.recorded(index, draws);
        let is_up_known = !case.is_upside_down;
        let found = (it.track).align(&it.detection, &it.barometer, None, None, is_up_known);
        match found {
            Ok(found) => {
                let found = found.expect("nothing is said");
                let off = (found.ahead - it.ahead).abs();
                assert!(off < 0.3, "{index}: {off} s, {found:?} {case:?}");
                right += 1;
                near += u64::from(off < 2.0 * found.deviation);
            }
            Err(error) => {
                *refused
                    .entry(error.to_string().split(' ').take(3).collect::<String>())
                    .or_insert(0) += 1
            }
        }
    }
    println!("{right} right, {near} within two deviations, refused: {refused:?}");
    // Fewer than 90 % by chance, where it is 95 %: 1e-4 of 150.
    assert!(right > 120 && near * 10 > right * 9, "{right} {near}");
}

/// Six equal trips with equal rests: the clocks are not aligned, and the reason names both offsets. What the clocks say is kept.
#[test]
fn equal_trips_a_constant_headway_apart() {
    let case = Case {
        trips: 6,
        floors: 2.0,
        rate: 1.0,
        noise: 0.1,
        lag: 0.3,
        weather: 0.0,
        shared: 1.0,
        is_regular: true,
        is_part: false,
        is_upside_down: false,
    };
    let draws = &mut Stream::new(7, "alignment", "").at(0);
    let it = case.recorded(0, draws);
    let align = |said| (it.track).align(&it.detection, &it.barometer, said, None, true);
    let refused = align(None).expect_err("they are alike");
    assert!(
        matches!(refused, AlignmentError::Ambiguous(..)),
        "{refused}"
    );
    assert_eq!(align(Some(it.ahead)), Ok(None));
    // Without a ride there is nothing to go by.
    let mut still = it.track.clone();
    still.trips.clear();
    let refused = still.align(&it.detection, &it.barometer, None, None, true);
    assert_eq!(refused, Err(AlignmentError::NoRide));
}

/// A barometer that falls silent for a minute tells of no motion then, and of its clock all the same.
#[test]
fn a_silence_is_no_motion() {
    let case = Case {
        trips: 8,
        floors: 6.0,
        rate: 10.0,
        noise: 0.1,
        lag: 0.0,
        weather: 0.0,
        shared: 1.0,
        is_regular: false,
        is_part: false,
        is_upside_down: false,
    };
    for index in 0..5 {
        let draws = &mut Stream::new(9, "alignment", "").at(index);
        let mut it = case.recorded(index, draws);
        let middle = it.barometer.readings[it.barometer.readings.len() / 2].time;
        let readings = &mut it.barometer.readings;
        readings.retain(|it| (it.time - middle).abs() > 30.0);
        let align = |said| (it.track).align(&it.detection, &it.barometer, said, None, true);
        let found = align(None).unwrap().expect("nothing is said");
        assert!((found.ahead - it.ahead).abs() < 0.3, "{index}: {found:?}");
        assert_eq!(align(Some(it.ahead)), Ok(None), "{index}");
    }
}
