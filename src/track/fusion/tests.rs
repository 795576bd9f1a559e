//! The filter of the paper is a linear one; what it does at floors; and the slow height.

use super::*;
use crate::rng::{self, Stream};
use crate::signal::white_noise;
use crate::track::{Tracked, Uncertain};
use std::ops::Range;

fn fusion(adapts: Adapts) -> Fusion {
    Fusion {
        adapts,
        ..Fusion::of(0.25)
    }
}

/// Without floors sigma points give what the Kalman filter gives, whatever Q does.
#[test]
fn unscented_is_linear() {
    for adapts in [Adapts::Never, Adapts::Printed, Adapts::Mended] {
        let fusion = fusion(adapts);
        let mut draws = Stream::new(1, "test", "").at(0);
        let mut position = Position::new(fusion, &[]);
        let (mut mean, mut variance) = (0.0f64, 0.0f64);
        for step in 0..10_000 {
            let [by, off] = [(); 2].map(|()| rng::unit(&mut draws) - 0.5);
            // Back to where it began, so that rounding stays small.
            let by = by - 0.5 * mean;
            let q = position.process;
            position.predict(by, 0.01, step % 3 == 0);
            mean += by;
            variance += 0.01 * q;
            assert!((position.mean - mean).abs() < 1e-12, "{step}");
            assert!((position.variance - variance).abs() < 1e-12, "{step}");
            position.measure(mean + off, 0.01);
            let gain = variance / (variance + fusion.noise);
            mean += gain * off;
            variance *= 1.0 - gain;
        }
    }
}

/// As printed Q grows on half of the readings of a filter that is right; with the noise in it on 4.6 % of them.
#[test]
fn adaptive_noise() {
    let growths = |adapts| {
        let mut draws = Stream::new(2, "test", "").at(0);
        let mut position = Position::new(fusion(adapts), &[]);
        let mut grown = 0;
        for _ in 0..40_000 {
            position.predict(0.0, 0.025, false);
            // The filter as it is without: Q is put back after each reading.
            position.process = position.fusion.process;
            let noise: f64 = (0..12).map(|_| rng::unit(&mut draws)).sum::<f64>() - 6.0;
            position.measure(0.25 * noise, 0.025);
            grown += u32::from(position.process > position.fusion.process);
        }
        f64::from(grown) / 40_000.0
    };
    let (printed, mended) = (growths(Adapts::Printed), growths(Adapts::Mended));
    assert!(printed > 0.5, "{printed}");
    assert!((0.035..0.055).contains(&mended), "{mended}");
}

#[test]
fn floors() {
    let mut position = Position::new(fusion(Adapts::Never), &[0.0, 4.0, 8.0]);
    position.predict(3.8, 1.0, false);
    assert_eq!(position.height(), 3.8);
    assert!(!position.is_abnormal());
    position.predict(0.0, 1.0, true);
    assert!((position.height() - 4.0).abs() < 1e-12);
    position.predict(1.9, 1.0, false);
    assert!(position.is_abnormal());
    position.predict(0.0, 1.0, true);
    assert!((position.height() - 5.9).abs() < 1e-12);
}

#[test]
fn the_reference_is_what_is_read_less_the_height() {
    let mut reference = Reference::default();
    assert_eq!(reference.altitude(), None);
    for at in 0..400 {
        let time = f64::from(at) / 40.0;
        reference.rest(time, 120.0 + 0.01 * f64::from(at % 2));
    }
    reference.leave(20.0);
    assert!((reference.altitude().unwrap() - 100.005).abs() < 1e-3);
    // A rest of less than a window says nothing.
    reference.rest(20.0, 500.0);
    reference.leave(20.0);
    assert!((reference.altitude().unwrap() - 100.005).abs() < 1e-3);
}

/// The variance is true whatever the weather, and in steady weather far less than that of the trips. A sum of squares of 200
/// normal variables over their variance is between 115 and 316 but once in a million.
#[test]
fn a_slow_height_knows_how_well_it_knows() {
    let usual = Drift::default();
    let steady = Drift {
        rate: usual.rate / 20.0,
        ..usual
    };
    for drift in [usual, steady] {
        let [squares, of_trips] = errors(drift);
        assert!((115.0..316.0).contains(&squares), "{drift:?}: {squares}");
        let gain = if drift == steady { 3.0 } else { 1.0 };
        assert!(of_trips > gain * squares, "{drift:?}: {of_trips}");
    }
}

/// The squares of the errors after 40 trips, in 200 weathers, and of those of the trips alone, in stated variances.
fn errors(drift: Drift) -> [f64; 2] {
    let mut errors = [0.0; 2];
    for trial in 0..200 {
        let mut draws = Stream::new(3, "test", "").at(trial);
        let mut normal = || (0..12).map(|_| rng::unit(&mut draws)).sum::<f64>() - 6.0;
        let rate = drift.rate * normal();
        let error = |deviation: f64, mean: f64| Uncertain {
            mean,
            variance: deviation * deviation,
        };
        let (mut truth, mut sum, mut time) = (0.0, 0.0, 0.0);
        let mut slow = SlowHeight::new(drift);
        slow.read(error(0.1, 0.1 * normal()));
        for trip in 0..40 {
            let distance = if trip % 2 == 0 { 12.0 } else { -12.0 };
            truth += distance;
            time += 60.0;
            let measured = distance + 0.05 * normal();
            sum += measured;
            slow.travel(error(0.05, measured), 60.0);
            slow.read(error(0.1, truth + rate * time + 0.1 * normal()));
        }
        let Uncertain { mean, variance } = slow.position();
        for (error, found) in errors.iter_mut().zip([mean, sum]) {
            *error += (found - truth) * (found - truth) / variance;
        }
    }
    errors
}

/// A lift of ten trips between two rests of a minute each, up 12 m and down, whose trips are off by 5 cm, and the readings of a
/// barometer at 1 Hz that are off by 30 cm, in weather of 1 hPa an hour.
struct Building {
    trips: Vec<Tracked>,
    readings: Vec<(f64, f64)>,
}

impl Building {
    const TRIPS: usize = 11;
    const NOISE: f64 = 0.3;

    fn start(trip: usize) -> f64 {
        60.0 + 80.0 * trip as f64
    }

    fn height(time: f64) -> f64 {
        let gone = (0..Self::TRIPS).map(|trip| {
            let distance = if trip % 2 == 0 { 12.0 } else { -12.0 };
            distance * ((time - Self::start(trip)) / 20.0).clamp(0.0, 1.0)
        });
        gone.sum()
    }

    fn new(seed: u64) -> Self {
        let mut draws = Stream::new(seed, "carried", "").at(0);
        let errors = white_noise(Self::TRIPS, &mut draws);
        let trips = errors.iter().enumerate().map(|(trip, error)| {
            let (start, stop) = (Self::start(trip), Self::start(trip) + 20.0);
            let gone = Self::height(stop) - Self::height(start);
            Tracked::told(trip + 1, [start, stop], gone + 0.05 * error)
        });
        let noise = white_noise(Self::start(Self::TRIPS) as usize, &mut draws);
        let readings = noise.iter().enumerate().map(|(second, noise)| {
            let time = second as f64;
            let weather = 8.3 / 3600.0 * time;
            (time, Self::height(time) + weather + Self::NOISE * noise)
        });
        Self {
            trips: trips.collect(),
            readings: readings.collect(),
        }
    }

    /// How far the last position is off, in stated deviations.
    fn off(&self, unseen: &[Range<f64>]) -> f64 {
        let heights = Barometry {
            readings: &self.readings,
            second: Self::NOISE,
            rounded: 0.0,
        };
        let stays = heights.stays(&self.trips, unseen, |_| None);
        let Uncertain { mean, variance } = stays.last().unwrap().end;
        assert!(variance.sqrt() < 0.8, "{variance}");
        (mean - 12.0) / variance.sqrt()
    }
}

/// The squares of 200 errors in stated deviations: the limits are those of 1 in a million of either side where they are normal,
/// with a third more above for the weather, which is twice what is usual.
fn is_stated(change: impl Fn(&mut Building) -> Vec<Range<f64>>) {
    let off = (0..200).map(|seed| {
        let mut building = Building::new(seed);
        let unseen = change(&mut building);
        building.off(&unseen).powi(2)
    });
    let squares: f64 = off.sum();
    assert!((40.0..420.0).contains(&squares), "{squares}");
}

#[test]
fn a_car_is_where_trips_and_barometer_say() {
    is_stated(|_| Vec::new());
}

/// One that no trip shows, in a stretch that is undecided.
#[test]
fn a_trip_that_was_not_seen_is_by_the_barometer() {
    is_stated(|building| {
        building.trips.remove(4);
        vec![Building::start(4) - 1.0..Building::start(4) + 22.0]
    });
}

#[test]
fn a_trip_that_is_not_measured_is_by_the_barometer() {
    is_stated(|building| {
        building.trips[4].distance = None;
        Vec::new()
    });
}

/// A barometer that jumps while the car stands, or goes, moves no car; nor one that is off for a while.
#[test]
fn a_jump_moves_no_car() {
    for at in [Building::start(4) - 30.0, Building::start(4) + 10.0] {
        is_stated(|building| {
            let late = building.readings.iter_mut().filter(|it| it.0 > at);
            late.for_each(|it| it.1 += 40.0);
            Vec::new()
        });
        is_stated(|building| {
            building.readings.retain(|it| (it.0 - at).abs() > 100.0);
            Vec::new()
        });
    }
}
