//! Each class against its name.

use super::{ALL, plans, records};
use crate::lift::pulse::{Pulse, Shape};
use crate::lift::record::cage::Cage;
use crate::lift::record::plan;
use crate::lift::{Class, Journey, MOST_TRIPS};

fn rests(cage: &Cage) -> Vec<f64> {
    cage.rests.iter().map(|(from, to)| to - from).collect()
}

#[test]
fn ordinary_records() {
    let (mut ups, mut trips) = (0, 0);
    for (cage, sensor) in plans(Class::Ordinary) {
        assert!((1..=4).contains(&cage.journeys.len()));
        assert!(rests(&cage).iter().all(|rest| (4.0..=15.0).contains(rest)));
        assert!((25.0..=200.0).contains(&sensor.rate));
        for journey in &cage.journeys {
            assert!(journey.speed <= 4.5 && journey.distance.abs() > 1.0);
            assert!(journey.stop - journey.start < 120.0);
            ups += usize::from(journey.direction > 0);
            trips += 1;
        }
        assert_eq!(cage.drum.len(), cage.journeys.len());
        assert!(cage.slack.is_empty());
    }
    println!("{ups} of {trips} trips up");
    assert!(3 * ups > trips && 3 * ups < 2 * trips);
}

#[test]
fn short_rests_and_cut_records() {
    let all: Vec<f64> = plans(Class::ShortRests)
        .flat_map(|(cage, _)| rests(&cage))
        .collect();
    assert!(all.iter().all(|rest| *rest <= 5.0) && all.iter().any(|rest| *rest < 0.5));
    let rests = plans(Class::BackToBack).flat_map(|(cage, _)| rests(&cage)[1..].to_vec());
    assert!({ rests }.all(|rest| (1.5..=3.0).contains(&rest)));
    for of in records(Class::Cut) {
        let (first, last) = (of.times[0], of.times[of.times.len() - 1]);
        let trips = &of.journeys;
        let within = |trip: &Journey, time| (trip.start - 0.1..=trip.stop).contains(&time);
        let begins = within(&trips[0], first);
        let ends = within(&trips[trips.len() - 1], last);
        assert!(begins || ends, "{first} {last} {trips:?}");
    }
}

#[test]
fn levels() {
    for (_, sensor) in plans(Class::Drift) {
        assert!(sensor.slopes.iter().all(|slope| slope.abs() <= 0.1 / 60.0));
        assert!(sensor.slopes.iter().any(|slope| slope.abs() > 1e-4));
    }
    for (class, extra) in [
        (Class::LevelShift, 1),
        (Class::LevelStep, 1),
        (Class::Tilt, 1),
        (Class::Ordinary, 0),
    ] {
        for (cage, _) in plans(class) {
            let levels = cage.disturbances.iter().filter_map(|of| match of.shape {
                Shape::Level { offset, seconds } => Some((of.from, offset, seconds)),
                _ => None,
            });
            let levels: Vec<(f64, f64, f64)> = levels.collect();
            assert_eq!(levels.len(), extra, "{class}");
            for (from, offset, seconds) in levels {
                assert!((0.005..=0.1).contains(&offset.abs()), "{class} {offset}");
                assert_eq!(seconds.is_finite(), class == Class::LevelShift);
                let in_motion = |trip: &Journey| trip.start <= from && from <= trip.stop;
                assert!(class != Class::Tilt || cage.journeys.iter().any(in_motion));
            }
        }
    }
}

#[test]
fn ways_of_driving() {
    for (class, speeds, levelling) in [
        (Class::Creep, 0.4..=4.5, Some((0.03..=0.3, 1.0..=9.5))),
        (Class::Express, 2.0..=6.0, Some((0.2..=0.5, 2.0..=11.0))),
        (Class::Slow, 0.1..=0.2, None),
        (Class::SoftStarts, 0.2..=1.2, None),
    ] {
        for (cage, _) in plans(class) {
            for of in &cage.journeys {
                assert!(speeds.contains(&of.speed), "{class} {of:?}");
                assert_eq!(of.levelling.is_some(), levelling.is_some());
                if let (Some(from), Some((slow, times))) = (of.levelling, &levelling) {
                    let speed = cage.speed_at(from + 0.01).abs();
                    assert!(slow.contains(&speed), "{class}: {speed}");
                    assert!(times.contains(&(of.stop - from)), "{class} {of:?}");
                }
                let mean = of.speed / (of.uniform - of.start);
                assert!(class != Class::SoftStarts || (0.03..=0.08).contains(&mean));
            }
        }
    }
    for (class, share) in [(Class::TwoStage, 0.05..=0.5), (Class::SlowZone, 0.3..=0.6)] {
        let (mut stages, mut trips) = (0, 0);
        for (cage, _) in plans(class) {
            for of in &cage.journeys {
                let within = |change: &&Pulse| (of.start..of.uniform).contains(&change.from);
                let last = cage.motion.iter().rfind(within).unwrap();
                let before = cage.speed_at(last.from).abs() / of.speed;
                assert!(
                    before == 0.0 || share.contains(&before),
                    "{class}: {before}"
                );
                stages += usize::from(before > 0.0);
                trips += 1;
            }
        }
        assert!(2 * stages > trips, "{class}: {stages} of {trips}");
    }
    for (cage, _) in plans(Class::Relevelling) {
        let moves = cage.drum.len() - cage.journeys.len();
        assert!(moves > 0);
        for (from, to) in &cage.drum[cage.journeys.len()..] {
            let middle = cage.speed_at((from + to) / 2.0).abs();
            assert!((middle - 0.05).abs() < 1e-9, "{middle}");
            assert!(cage.rests.iter().any(|rest| rest.0 < *from && *to < rest.1));
        }
    }
}

fn deviation(samples: impl Iterator<Item = f64>) -> f64 {
    let samples: Vec<f64> = samples.collect();
    let differences = samples.windows(2).map(|pair| pair[1] - pair[0]);
    let squares: f64 = differences.map(|d| d * d).sum();
    (squares / samples.len() as f64).sqrt()
}

#[test]
fn cruises_are_quiet() {
    let mut quieter = 0;
    for of in records(Class::QuietCruise) {
        let pairs = || of.speed.iter().zip(&of.acceleration);
        let moving = deviation(pairs().filter(|(v, _)| **v != 0.0).map(|(_, a)| *a));
        let resting = deviation(pairs().filter(|(v, _)| **v == 0.0).map(|(_, a)| *a));
        quieter += usize::from(moving < resting);
    }
    assert_eq!(quieter, 20);
}

#[test]
fn sensors() {
    for of in records(Class::HighPass) {
        let mean = of.acceleration.iter().sum::<f64>() / of.acceleration.len() as f64;
        assert!(mean.abs() < 0.1, "{mean}");
    }
    let taus: Vec<f64> = plans(Class::HighPass)
        .filter_map(|(_, sensor)| sensor.tau)
        .collect();
    assert!(taus.len() == 40 && taus.iter().all(|tau| (0.5..=16.0).contains(tau)));
    let rates: Vec<f64> = plans(Class::Rates).map(|(_, sensor)| sensor.rate).collect();
    assert!(rates.iter().any(|rate| *rate < 10.0) && rates.iter().any(|rate| *rate > 250.0));
    for of in records(Class::Coarse) {
        let steps = of.acceleration.iter().map(|a| a / 0.1);
        assert!({ steps }.all(|steps| (steps - steps.round()).abs() < 1e-9));
    }
    for (index, of) in records(Class::Frozen).enumerate() {
        let (_, sensor) = plan(Class::Frozen, 7, index as u64);
        let after = of.times.iter().position(|time| *time >= sensor.frozen);
        let after = &of.acceleration[after.unwrap()..];
        assert!(after.iter().all(|a| *a == after[0]));
    }
    for (class, shortest, most) in [(Class::Holes, 0.3, 3), (Class::Gaps, 0.5, 2)] {
        let mut missing = 0;
        for (_, sensor) in plans(class) {
            assert!((1..=most).contains(&sensor.holes.len()));
            assert!(sensor.holes.iter().all(|(from, to)| to - from >= shortest));
        }
        for of in records(class) {
            let gaps = of.times.windows(2).map(|pair| pair[1] - pair[0]);
            missing += usize::from({ gaps }.any(|gap| gap >= shortest));
        }
        assert!(missing >= 18, "{class}: {missing}");
    }
}

#[test]
fn people_and_hands() {
    for (cage, _) in plans(Class::Handled) {
        let strong = cage.disturbances.iter().filter(|of| match of.shape {
            Shape::Sine { peak, .. } => peak.abs() >= 2.0,
            _ => false,
        });
        let times: Vec<f64> = strong.map(|of| of.from).collect();
        let (first, last) = (cage.rests[0].0, cage.rests[cage.rests.len() - 1].1);
        assert!(first >= 1.0 && cage.until() - last >= 1.0);
        assert!(times.iter().all(|time| *time < first || *time >= last));
        assert!(times.contains(&0.0) && times.contains(&last));
    }
    for (class, wanted) in [(Class::Shocks, 1), (Class::Jumps, 3), (Class::Boarding, 1)] {
        for (cage, _) in plans(class) {
            let is_one = |of: &&Pulse| match of.shape {
                Shape::HalfSine { .. } => class != Class::Boarding,
                Shape::Bounce { .. } => class == Class::Boarding,
                Shape::Level { seconds, .. } => class == Class::Jumps && seconds == 0.3,
                _ => false,
            };
            let found = cage.disturbances.iter().filter(is_one).count();
            assert!(found >= wanted && found <= 3 * wanted, "{class}: {found}");
        }
    }
}

/// Counts of records are checked by it.
#[test]
fn no_class_has_more_trips_than_the_most() {
    let trips = |class: &Class| plans(*class).map(|(cage, _)| cage.journeys.len() as u64);
    let most = ALL.iter().flat_map(trips).max();
    assert_eq!(most, Some(MOST_TRIPS));
}

/// A sensor is turned and held at rest, and reads another level afterwards; one that warms up settles.
#[test]
fn levels_of_sensors() {
    let levels = |cage: &Cage| -> Vec<(f64, f64, f64)> {
        let of = |pulse: &Pulse| match pulse.shape {
            Shape::Level { offset, seconds } => Some((pulse.from, offset, seconds)),
            _ => None,
        };
        cage.disturbances.iter().filter_map(of).collect()
    };
    for (cage, _) in plans(Class::Turned) {
        let [(from, offset, seconds)] = levels(&cage)[..] else {
            panic!("{:?}", cage.disturbances)
        };
        assert!((0.1..=0.5).contains(&offset.abs()) && seconds.is_infinite());
        assert_eq!(cage.speed_at(from), 0.0);
    }
    for (cage, _) in plans(Class::TurnedAtStart) {
        let [(from, offset, seconds)] = levels(&cage)[..] else {
            panic!("{:?}", cage.disturbances)
        };
        assert!((0.1..=0.5).contains(&offset.abs()) && seconds.is_infinite());
        let is_at_start = |trip: &Journey| (trip.start - from).abs() <= 0.5;
        assert!(cage.journeys.iter().any(is_at_start), "{from}");
    }
    for (cage, _) in plans(Class::Held) {
        for pair in levels(&cage).chunks(2) {
            let [(from, held, seconds), (until, left, _)] = pair else {
                panic!("{pair:?}")
            };
            assert!((-0.5..=-0.1).contains(held) && left.abs() <= 0.05);
            assert!((3.0..=8.0).contains(seconds) && (until - from - seconds).abs() < 1e-9);
        }
    }
    for of in records(Class::WarmUp) {
        let mean = |from: f64, to: f64| {
            let within = |time: &f64| (from..to).contains(time);
            let both = of.times.iter().zip(&of.acceleration);
            let some: Vec<f64> = both.filter(|it| within(it.0)).map(|it| *it.1).collect();
            some.iter().sum::<f64>() / some.len() as f64
        };
        let last = of.times[of.times.len() - 1];
        assert!((mean(0.0, 1.0) - mean(last - 2.0, last)).abs() > 0.03);
    }
}

/// The drum turns while the cage stands, in each of the three ways.
#[test]
fn slack_is_paid_out() {
    let mut ways = [0; 3];
    for (cage, _) in plans(Class::Drum) {
        assert_eq!(cage.slack.len(), 1);
        let (from, to) = cage.slack[0];
        assert!((4.0..=15.0).contains(&(to - from)));
        assert!(cage.drum.contains(&(from, to)));
        for i in 1..100 {
            let time = from + (to - from) * f64::from(i) / 100.0;
            assert_eq!(cage.speed_at(time), 0.0);
        }
        let last = cage.journeys[cage.journeys.len() - 1];
        ways[match () {
            () if last.jammed => 2,
            () if from > last.stop => 1,
            () => 0,
        }] += 1;
    }
    println!("{ways:?}");
    assert!(ways.iter().all(|count| *count > 3));
}
