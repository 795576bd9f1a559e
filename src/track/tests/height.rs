//! Heights by the pressure of the air, against the standard atmosphere and generated trips whose truth is known.

use crate::recording::{Barometer, Pressure};
use crate::rng::Stream;
use crate::signal::white_noise;
use crate::stats::binomial::lower_tail;
use crate::track::{Air, Climbs, HeightWarning, Tracked, Unseen};

/// How much of the air lies below so many metres of the standard atmosphere, by small steps: dp/dh = −p g/(R T).
fn pressure_by_steps(metres: f64) -> f64 {
    const STEPS: usize = 100_000;
    let step = metres / STEPS as f64;
    let mut pascal = 101_325.0;
    for at in 0..STEPS {
        let kelvin = 288.15 - 0.0065 * step * (at as f64 + 0.5);
        pascal *= 1.0 - step * 9.80665 / (287.05 * kelvin);
    }
    pascal
}

#[test]
fn the_printed_altitude_is_that_of_the_standard_atmosphere() {
    for metres in [100.0, 1000.0, 2500.0] {
        let pascal = pressure_by_steps(metres);
        let printed = Pressure { time: 0.0, pascal }.standard_altitude();
        assert!((printed / metres - 1.0).abs() < 3e-4, "{metres} {printed}");
    }
}

/// A ride of a building: what an accelerometer says of it, and the air around it.
struct Building {
    celsius: f64,
    /// Of a reading, m.
    noise: f64,
    /// How the pressure changes with the weather, Pa/s.
    weather: f64,
    /// Hz
    rate: f64,
    distances: Vec<f64>,
}

/// Rests and trips, s.
const REST: f64 = 12.0;
const TRIP: f64 = 18.0;

impl Building {
    /// 18 m up and down, as often as asked, in air like that of a building, at 1 Hz.
    fn usual(trips: usize) -> Self {
        Self {
            celsius: 24.0,
            noise: 0.08,
            weather: 5.0 / 3600.0,
            rate: 1.0,
            distances: [18.0, -18.0].into_iter().cycle().take(trips).collect(),
        }
    }

    fn start(trip: usize) -> f64 {
        REST + (REST + TRIP) * trip as f64
    }

    fn height(&self, time: f64) -> f64 {
        let gone =
            self.distances.iter().enumerate().map(|(trip, distance)| {
                distance * ((time - Self::start(trip)) / TRIP).clamp(0.0, 1.0)
            });
        gone.sum()
    }

    /// A barometer at 755 hPa.
    fn barometer(&self, seed: u64) -> Barometer {
        let to = Self::start(self.distances.len());
        let count = (to * self.rate) as usize;
        let mut draws = Stream::new(seed, "air", "").at(0);
        let noise = white_noise(count, &mut draws);
        let kelvin = self.celsius + 273.15;
        let readings = noise.iter().enumerate().map(|(at, noise)| {
            let time = at as f64 / self.rate;
            let height = self.height(time) + self.noise * noise;
            let pascal = 75_500.0 * (-height * 9.80665 / (287.05 * kelvin)).exp();
            Pressure {
                time,
                pascal: pascal + self.weather * time,
            }
        });
        Barometer::of_readings(readings.collect())
    }

    /// What an accelerometer says, whose gain is `gain`; −1 hangs upside down.
    fn trips(&self, gain: f64) -> Vec<Tracked> {
        let trips = self.distances.iter().enumerate();
        let trips = trips.map(|(at, distance)| {
            let start = Self::start(at);
            Tracked::told(at + 1, [start, start + TRIP], gain * distance)
        });
        trips.collect()
    }
}

fn heights(climbs: &Climbs) -> Vec<f64> {
    let climbs = climbs.climbs.iter().flatten();
    climbs.map(|it| it.height).collect()
}

/// Where the temperature is given, no more than 95 % − the least by chance are farther off than 1.96 deviations, and with
/// the printed altitude all are short by the air's temperature.
#[test]
fn heights_are_within_their_deviations() {
    let (mut within, mut all, mut printed) = (0u64, 0u64, 0.0);
    for seed in 0..200 {
        let building = Building::usual(10);
        let trips = building.trips(1.0);
        let climbs = Climbs::of(
            &trips,
            &Unseen::default(),
            &building.barometer(seed),
            0.0,
            Some(24.0),
        );
        assert!(climbs.unlike.is_empty() && climbs.upside_down == Some(false));
        for (climb, distance) in climbs.climbs.iter().flatten().zip(&building.distances) {
            within += u64::from((climb.height - distance).abs() < 1.96 * climb.height_deviation);
            printed += climb.height_printed / distance;
            all += 1;
        }
    }
    println!("{within} of {all} within");
    assert!(lower_tail(within, all, 0.93) > 1e-6);
    // The standard atmosphere is at 272.6 K where the air has 755 hPa.
    let short = printed / all as f64;
    assert!((short - 272.6 / 297.15).abs() < 2e-3, "{short}");
}

#[test]
fn the_temperature_is_learnt_from_distances() {
    let building = Building::usual(20);
    // A hundredth of the gain is 3 K.
    for (seed, gain) in (0..20).zip([0.99, 1.0, 1.01].into_iter().cycle()) {
        let climbs = Climbs::of(
            &building.trips(gain),
            &Unseen::default(),
            &building.barometer(seed),
            0.0,
            None,
        );
        let Air {
            celsius,
            deviation,
            learnt,
        } = climbs.air;
        assert!(
            (celsius - 24.0).abs() < 1.96 * deviation,
            "{:?}",
            climbs.air
        );
        assert!((2.7..3.2).contains(&deviation) && learnt == 20);
    }
    // From nothing nothing is learnt.
    let climbs = Climbs::of(&[], &Unseen::default(), &building.barometer(0), 0.0, None);
    assert_eq!(
        (
            climbs.air.learnt,
            climbs.air.celsius.round(),
            climbs.upside_down
        ),
        (0, 20.0, None)
    );
}

#[test]
fn up_is_where_the_pressure_falls() {
    let building = Building::usual(2);
    let barometer = building.barometer(1);
    let climbs = Climbs::of(
        &building.trips(-1.0),
        &Unseen::default(),
        &barometer,
        0.0,
        None,
    );
    assert!(climbs.upside_down == Some(true));
    assert_eq!(climbs.air.learnt, 2, "distances count as they are");
    // A trip that the barometer cannot see tells nothing.
    let low = Building {
        distances: vec![0.1, -0.1],
        ..Building::usual(2)
    };
    let climbs = Climbs::of(
        &low.trips(-1.0),
        &Unseen::default(),
        &low.barometer(1),
        0.0,
        None,
    );
    assert!(climbs.upside_down.is_none());
}

/// A barometer that freezes, jumps within a rest, or drops out: said, and what is left is right.
#[test]
fn a_faulty_barometer_is_ridden_through() {
    let building = Building::usual(4);
    let trips = building.trips(1.0);
    let sound = building.barometer(3);
    let with = |change: &dyn Fn(&mut Vec<Pressure>)| {
        let mut barometer = sound.clone();
        change(&mut barometer.readings);
        Climbs::of(&trips, &Unseen::default(), &barometer, 0.0, None)
    };
    let second = Building::start(1);
    let frozen = with(&|readings| {
        let held = readings[second as usize - 1].pascal;
        let frozen = readings
            .iter_mut()
            .filter(|it| it.time >= second && it.time < second + TRIP + REST);
        frozen.for_each(|it| it.pascal = held);
    });
    let fault = HeightWarning::Frozen {
        ride: 2,
        distance: Some(-18.0),
    };
    assert_eq!((&frozen.faults, frozen.climbs[1]), (&vec![fault], None));
    // It thaws as the next one starts.
    assert_eq!((frozen.unlike, frozen.upside_down), (vec![3], Some(false)));
    assert!((frozen.air.celsius - 24.0).abs() < 4.0 * frozen.air.deviation);
    // A door that slams.
    let jumping = with(&|readings| readings[(second - 4.0) as usize].pascal += 300.0);
    let off = heights(&jumping)[1] - heights(&with(&|_| {}))[1];
    assert!(jumping.unlike.is_empty() && off.abs() < 0.1, "{off}");
    let dropping = with(&|readings| readings.retain(|it| (it.time - second).abs() > REST));
    assert_eq!(dropping.climbs.iter().flatten().count(), 2, "{dropping:?}");
    let silent = with(&|readings| readings.retain(|it| it.time < 2.0));
    assert!(silent.climbs.iter().all(Option::is_none) && silent.upside_down.is_none());
}

/// An end that the record does not hold has no rest, whatever was read at zero.
#[test]
fn a_trip_that_is_cut_off_has_no_height() {
    let building = Building::usual(3);
    let mut trips = building.trips(1.0);
    trips[0].trip.start = None;
    trips[2].trip.stop = None;
    let climbs = Climbs::of(
        &trips,
        &Unseen::default(),
        &building.barometer(1),
        0.0,
        None,
    );
    let known: Vec<bool> = climbs.climbs.iter().map(Option::is_some).collect();
    assert_eq!(known, [false, true, false]);
    // Nor does a rest reach into such a trip.
    let mut trips = building.trips(1.0);
    trips[0].trip.stop = None;
    let climbs = Climbs::of(
        &trips,
        &Unseen::default(),
        &building.barometer(1),
        0.0,
        None,
    );
    let known: Vec<bool> = climbs.climbs.iter().map(Option::is_some).collect();
    assert_eq!(known, [false, false, true]);
}

/// The pressure of another room for good, in a trip: it is said, and turns nothing upside down.
#[test]
fn a_jump_is_no_direction() {
    let building = Building::usual(2);
    let mut barometer = building.barometer(1);
    let second = Building::start(1);
    for jump in [-800.0, 300.0, -1500.0, 1500.0] {
        let late = barometer
            .readings
            .iter_mut()
            .filter(|it| it.time > second + 5.0);
        late.for_each(|it| it.pascal += jump);
        for gain in [1.0, -1.0] {
            let climbs = Climbs::of(
                &building.trips(gain),
                &Unseen::default(),
                &barometer,
                0.0,
                None,
            );
            assert_eq!(climbs.upside_down, Some(gain < 0.0), "{jump}");
            assert_eq!(climbs.unlike, [2], "{jump}");
        }
        barometer = building.barometer(1);
    }
    // One that makes the way down look like one up leaves it open.
    let late = barometer
        .readings
        .iter_mut()
        .filter(|it| it.time > second + 5.0);
    late.for_each(|it| it.pascal -= 300.0);
    let climbs = Climbs::of(
        &building.trips(1.0),
        &Unseen::default(),
        &barometer,
        0.0,
        None,
    );
    assert_eq!(climbs.upside_down, None);
    let sound = building.barometer(1);
    let hot = Climbs::of(
        &building.trips(1.0),
        &Unseen::default(),
        &sound,
        0.0,
        Some(-60.0),
    );
    assert_eq!(hot.unlike, [1, 2]);
}

/// Steps of 1 hPa, 11 m: heights are off by metres, and their deviations say so.
#[test]
fn coarse_steps_are_in_the_deviation() {
    let building = Building {
        noise: 0.0,
        ..Building::usual(6)
    };
    let mut barometer = building.barometer(1);
    let readings = barometer.readings.iter_mut();
    readings.for_each(|it| it.pascal = 100.0 * (it.pascal / 100.0).round());
    let climbs = Climbs::of(
        &building.trips(1.0),
        &Unseen::default(),
        &barometer,
        0.0,
        Some(24.0),
    );
    for (climb, distance) in climbs.climbs.iter().flatten().zip(&building.distances) {
        let off = (climb.height - distance).abs() / climb.height_deviation;
        assert!(off < 2.5 && climb.height_deviation > 3.0, "{climb:?}");
    }
}

/// A barometer whose clock is behind.
#[test]
fn clocks_are_brought_together() {
    let building = Building::usual(4);
    let mut barometer = building.barometer(3);
    let trips = building.trips(1.0);
    let there = heights(&Climbs::of(
        &trips,
        &Unseen::default(),
        &barometer,
        0.0,
        None,
    ));
    barometer
        .readings
        .iter_mut()
        .for_each(|it| it.time -= 1000.0);
    assert_eq!(
        heights(&Climbs::of(
            &trips,
            &Unseen::default(),
            &barometer,
            1000.0,
            None
        )),
        there
    );
}
