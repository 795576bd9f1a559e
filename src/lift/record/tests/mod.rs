//! Records against the motion behind them.

mod classes;

use super::disturbance::jump;
use super::sensor::high_pass;
use super::*;
use crate::lift::pulse::{Pulse, Shape};

const ALL: [Class; 31] = [
    Class::Ordinary,
    Class::ShortRests,
    Class::Cut,
    Class::Drift,
    Class::Creep,
    Class::QuietCruise,
    Class::TwoStage,
    Class::SlowZone,
    Class::HighPass,
    Class::Holes,
    Class::Rates,
    Class::Coarse,
    Class::Handled,
    Class::LevelShift,
    Class::LevelStep,
    Class::Shocks,
    Class::Jumps,
    Class::Boarding,
    Class::Frozen,
    Class::Express,
    Class::Slow,
    Class::SoftStarts,
    Class::Relevelling,
    Class::BackToBack,
    Class::Gaps,
    Class::Tilt,
    Class::Turned,
    Class::TurnedAtStart,
    Class::Held,
    Class::WarmUp,
    Class::Drum,
];

fn plans(class: Class) -> impl Iterator<Item = (Cage, Mounted)> {
    (0..40).map(move |index| plan(class, 7, index))
}

fn records(class: Class) -> impl Iterator<Item = Record> {
    (0..20).map(move |index| Record::new(class, 7, index))
}

/// The undisturbed samples add up to the speed at every edge: so each trip's sum is zero. 1e-9 is a thousand
/// roundings of sums of 1e5 samples.
#[test]
fn samples_add_up_to_the_speed() {
    for class in ALL {
        for (cage, sensor) in plans(class) {
            let mut record = vec![0.0; sensor.samples(&cage)];
            for change in &cage.motion {
                change.add_to(&mut record, sensor.rate, sensor.rate);
            }
            let mut speed = 0.0;
            for (i, a) in record.iter().enumerate() {
                speed += a / sensor.rate;
                let expected = cage.speed_at((i as f64 + 0.5) / sensor.rate);
                assert!(
                    (speed - expected).abs() < 2e-9,
                    "{class} {i}: {speed} {expected}"
                );
            }
        }
    }
}

/// The midpoint rule with steps of 1 ms: four changes of slope with at most 90 m/s², each off by at most ah²/4.
#[test]
fn speed_adds_up_to_the_distance() {
    for class in ALL {
        for (cage, _) in plans(class) {
            for of in &cage.journeys {
                let h = 1e-3;
                let steps = ((of.stop - of.start) / h).ceil() as usize;
                let h = (of.stop - of.start) / steps as f64;
                let speeds = (0..steps).map(|i| cage.speed_at(of.start + (i as f64 + 0.5) * h));
                let speeds: Vec<f64> = speeds.collect();
                let way: f64 = speeds.iter().map(|speed| speed * h).sum();
                assert!((way - of.distance).abs() < 1e-4, "{class}: {way} {of:?}");
                let top = speeds
                    .iter()
                    .fold(0.0f64, |top, speed| top.max(speed.abs()));
                assert!((top - of.speed).abs() < 1e-2, "{class}: {top} {of:?}");
                assert_eq!(cage.speed_at(of.start), 0.0, "{class} {of:?}");
                assert_eq!(cage.speed_at(of.stop + 1e-9), 0.0, "{class} {of:?}");
                assert_eq!(of.distance.signum(), f64::from(of.direction));
            }
        }
    }
}

#[test]
fn disturbances_leave_no_speed() {
    let bounce = |damping| Shape::Bounce {
        depth: 0.03,
        frequency: 0.8,
        damping,
    };
    let sine = Shape::Sine {
        peak: 8.0,
        seconds: 0.3,
    };
    let shapes = [bounce(0.03), bounce(0.15), sine].map(|shape| vec![Pulse { from: 2.0, shape }]);
    for pulses in shapes.into_iter().chain([jump(2.0, 0.3, 1.0).into()]) {
        for rate in [25.0, 100.0, 333.0] {
            let mut record = vec![0.0; 80_000];
            pulses
                .iter()
                .for_each(|pulse| pulse.add_to(&mut record, rate, rate));
            let speed = record.iter().sum::<f64>() / rate;
            let strength = record.iter().map(|a| a.abs()).sum::<f64>() / rate;
            assert!(
                strength > 0.1 && speed.abs() < 2e-9,
                "{pulses:?} {rate}: {speed:e}"
            );
        }
    }
}

#[test]
fn a_step_decays_behind_the_high_pass() {
    let (rate, tau) = (50.0, 0.54);
    let mut step = vec![1.0; 200];
    high_pass(&mut step, rate * tau);
    for (i, y) in step.iter().enumerate() {
        let expected = libm::exp(-(i as f64) / rate / tau);
        assert!((y - expected).abs() < 1e-12, "{i}: {y} {expected}");
    }
}

#[test]
fn records_are_their_coordinates() {
    for class in ALL {
        let record = Record::new(class, 3, 5);
        assert_eq!(record, Record::new(class, 3, 5));
        assert_ne!(record, Record::new(class, 3, 6));
        assert_ne!(record, Record::new(class, 4, 5));
        let [times, readings, speeds] = [&record.times, &record.acceleration, &record.speed];
        assert!(times.is_sorted_by(|a, b| a < b), "{class}");
        assert!(
            readings.iter().chain(speeds).all(|x| x.is_finite()),
            "{class}"
        );
        assert_eq!([readings.len(), speeds.len()], [times.len(); 2]);
        assert!(times.len() > 20, "{class}");
    }
}

/// A change of these values changes results: say so in the CHANGELOG.
#[test]
fn golden_draws() {
    let Record {
        acceleration,
        journeys,
        ..
    } = Record::new(Class::Creep, 2014, 3);
    let sum: f64 = acceleration.iter().sum();
    assert_eq!(
        (acceleration.len(), acceleration[700], sum, journeys[0].stop),
        (
            3289,
            -0.30271034065649205,
            -744.8558996141554,
            24.03474395445486
        )
    );
}
