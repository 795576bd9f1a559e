//! Whole records, made by hand: a ride, and what else a sensor may show beside it.

use super::*;
use crate::recording::Sample;
use proptest::prelude::*;
use std::f64::consts::TAU;

/// Jerk, acceleration and speed of the ride, in SI units; its start and stop, s.
const JERK: f64 = 1.0;
const ACCELERATION: f64 = 0.7;
const SPEED: f64 = 1.0;
const RIDE: (f64, f64) = (20.0, 37.1);

/// A pulse of acceleration with limited jerk that changes the speed by [`SPEED`].
fn pulse(time: f64) -> f64 {
    let rise = ACCELERATION / JERK;
    let end = SPEED / ACCELERATION + rise;
    (JERK * time)
        .min(JERK * (end - time))
        .clamp(0.0, ACCELERATION)
}

fn ride(time: f64) -> f64 {
    pulse(time - RIDE.0) - pulse(time - 35.0)
}

/// So many seconds at 50 Hz, with a little noise, that hold the ride and something else.
fn record(seconds: f64, other: impl Fn(f64) -> f64) -> Vec<Sample> {
    let noise = |i: u32| f64::from(i.wrapping_mul(2_654_435_761) >> 16) / 65536.0 - 0.5;
    let sample = |i: u32| {
        let time = f64::from(i) / 50.0;
        let acceleration = 9.81 + ride(time) + other(time) + 0.04 * noise(i);
        Sample { time, acceleration }
    };
    (0..(50.0 * seconds) as u32).map(sample).collect()
}

fn explained(samples: &[Sample], begins_at_rest: Option<bool>) -> Explanation {
    let prior = Prior {
        begins_at_rest,
        ..Prior::default()
    };
    Explanation::of(&Cut::new(samples, 2, 0.04), &prior)
}

fn is_the_ride(trip: &Trip) -> bool {
    let near = |time: Option<f64>, truth: f64| time.is_some_and(|it| (it - truth).abs() < 0.5);
    trip.is_up && near(trip.start, RIDE.0) && near(trip.stop, RIDE.1)
}

/// Whether the cheapest explanation is the ride and nothing else.
fn is_right(explanation: &Explanation) -> bool {
    matches!(&explanation.reading.trips[..], [trip] if is_the_ride(trip))
}

fn within(time: f64, from: f64, to: f64) -> f64 {
    f64::from(u8::from((from..to).contains(&time)))
}

/// However coarse a sensor's steps are, and wherever its level lies between two of them, a ride is not the level.
#[test]
fn steps_hide_no_ride() {
    for step in [0.1, 0.2, 0.3] {
        for offset in [0.1, 0.3, 0.5, 0.7, 0.9] {
            let mut samples = record(60.0, |_| 0.0);
            for sample in &mut samples {
                let steps = (sample.acceleration - 9.81) / step + offset;
                sample.acceleration = 9.81 + step * steps.round();
            }
            let prior = Prior {
                begins_at_rest: Some(true),
                ..Prior::default()
            };
            let explanation = Explanation::of(&Cut::new(&samples, 2, 0.04), &prior);
            let trips = &explanation.reading.trips;
            let is_found = trips.iter().any(|trip| trip.is_up);
            let is_doubted = !explanation.doubts.is_empty();
            assert!(is_found || is_doubted, "{step} {offset}: {trips:?}");
        }
    }
}

/// A phone is turned a little, for a while or for good, while the cage rests, starts, cruises or brakes. Where it is
/// turned back as the cage starts or stops, when it was is not known, so that the ride may be undecided.
#[test]
fn a_level_that_shifts_makes_no_ride() {
    let hides = |time: f64| ride(time - 0.1) != 0.0 || ride(time + 0.1) != 0.0;
    for size in [0.06, -0.06, 0.1, -0.1] {
        for from in [4.0, 10.0, 16.0, 24.0, 27.0, 31.0, 45.0] {
            for to in [from + 4.0, from + 8.0, from + 13.0, f64::INFINITY] {
                let found = explained(&record(60.0, |time| size * within(time, from, to)), None);
                let is_told = is_right(&found) || (hides(to) && !found.doubts.is_empty());
                assert!(is_told, "{size} {from} {to}: {:?}", found.doubts);
            }
        }
    }
}

/// A phone is turned just after the record begins, or before it ends: with the rest before it, or after, that is as good
/// as a braking, or a start, of which the record shows a part. A braking of a lift is none.
#[test]
fn a_turn_near_an_end_is_no_ride() {
    for size in [0.15, -0.15, 0.3, -0.3, 0.5] {
        for (from, to) in [(0.0, 3.0), (0.0, 8.0), (52.0, 60.0), (56.0, 60.0)] {
            let found = explained(&record(60.0, |time| size * within(time, from, to)), None);
            let others = found.reading.trips.iter().filter(|trip| !is_the_ride(trip));
            let is_told = others.count() == 0 || !found.doubts.is_empty();
            assert!(is_told, "{size} {from} {to}: {:?}", found.reading.trips);
        }
    }
    // The record begins 0.5 s into a braking.
    let braking = |time: f64| -pulse(time + 0.5);
    let found = explained(&record(60.0, braking), None);
    assert_eq!(found.reading.trips.len(), 2, "{:?}", found.reading.trips);
    assert_eq!(found.reading.trips[0].start, None);
}

/// Somebody lifts the sensor, holds it and puts it down. A jump, a ride and an emergency stop are none of that, nor are
/// the hands at both ends of a record.
#[test]
fn hands_are_told_from_lifts() {
    let swing = |time: f64, from: f64| {
        let phase = (time - from) / 0.8;
        2.5 * (TAU * phase).sin() * within(phase, 0.0, 1.0)
    };
    let in_hand = |other: &dyn Fn(f64) -> f64| {
        let samples = record(60.0, other);
        hand::in_hand(&Cut::new(&samples, 2, 0.04))
    };
    for (size, to) in [(-0.2, 11.0), (-0.4, 13.0), (0.1, 12.0)] {
        let tremor = |time: f64| 0.1 * (TAU * 1.3 * time).sin();
        let held = |time: f64| (size + tremor(time)) * within(time, 6.0, to);
        let spans = in_hand(&|time| held(time) + swing(time, 6.0) + swing(time, to - 0.8));
        // It may lie still in the hand for some seconds.
        let (Some(first), Some(last)) = (spans.first(), spans.last()) else {
            panic!("{size} {to}")
        };
        assert!(
            (first.0 - 6.0).abs() < 0.2 && (last.1 - to).abs() < 0.5,
            "{spans:?}"
        );
    }
    let jump = |time: f64| {
        let flight = -4.0 * within(time, 10.0, 10.3);
        flight + 2.4 * within(time, 9.75, 10.0) + 4.0 * within(time, 10.3, 10.45)
    };
    let stop = |time: f64| {
        let bounce = (TAU * 3.0 * (time - 50.4)).cos() * (-(time - 50.4)).exp();
        pulse(time - 42.0) - 2.5 * within(time, 50.0, 50.4) + bounce * within(time, 50.4, 53.0)
    };
    // Somebody jumps, and the lift goes at once.
    let leaves = |time: f64| jump(time - 8.3);
    let ends = |time: f64| swing(time, 1.0) - 0.3 * within(time, 1.4, 4.0) + swing(time, 58.0);
    for other in [
        &|_: f64| 0.0_f64,
        &jump as &dyn Fn(f64) -> f64,
        &leaves,
        &stop,
        &ends,
    ] {
        assert_eq!(in_hand(other), []);
    }
}

/// A cage creeps to its landing at 0.09 m/s. In a calm record the pulse that ends it can hardly be anything else; among
/// footsteps it can.
#[test]
fn a_calm_record_shows_where_the_cage_stands() {
    let creep = |time: f64| 0.09 * (pulse(time - 35.0) - pulse(time - 42.0));
    let step = |time: f64| {
        let phase = time % 3.0;
        0.1 * within(time, 45.0, 80.0) * (within(phase, 1.0, 1.5) - within(phase, 1.7, 2.2))
    };
    let calm = explained(&record(100.0, creep), None);
    let [trip] = &calm.reading.trips[..] else {
        panic!("{:?}", calm.reading.trips)
    };
    assert!(trip.stop.is_some_and(|stop| (stop - 44.0).abs() < 1.0));
    assert_eq!(calm.doubts, []);
    let busy = explained(&record(100.0, |time| creep(time) + step(time)), None);
    assert!(!busy.doubts.is_empty());
}

/// A trip of 1 m/s that begins at a time: of a cage that creeps out of its floor and into the next, and of one that slows
/// down half-way.
fn creeps_out(time: f64) -> f64 {
    0.3 * (pulse(time) - pulse(time - 26.0)) + 0.7 * (pulse(time - 6.0) - pulse(time - 18.0))
}

fn slows_down(time: f64) -> f64 {
    pulse(time) - 0.5 * (pulse(time - 6.0) - pulse(time - 14.0)) - pulse(time - 20.0)
}

/// A lift that speeds up in stages does so on every trip. Three there and back show it; one, or some in the same direction,
/// may be read backwards as well, and are not told otherwise without a word.
#[test]
fn a_lift_has_a_habit() {
    for (trip, lasts) in [(creeps_out as fn(f64) -> f64, 28.1), (slows_down, 22.1)] {
        let trips = |times: &[(f64, f64)]| {
            let other = |time: f64| {
                let at = |(start, sign): &(f64, f64)| sign * trip(time - start);
                times.iter().map(at).sum::<f64>() - ride(time)
            };
            explained(&record(150.0, other), None)
        };
        let is_told = |found: &Explanation, times: &[(f64, f64)]| {
            let told = &found.reading.trips;
            let is_right = |(trip, (start, sign)): (&Trip, &(f64, f64))| {
                let near = |time: Option<f64>, truth: f64| {
                    time.is_some_and(|time| (time - truth).abs() < 0.5)
                };
                trip.is_up == (*sign > 0.0)
                    && near(trip.start, *start)
                    && near(trip.stop, start + lasts)
            };
            told.len() == times.len() && told.iter().zip(times).all(is_right)
        };
        let there_and_back = [(12.0, 1.0), (55.0, -1.0), (100.0, 1.0)];
        let found = trips(&there_and_back);
        assert!(
            is_told(&found, &there_and_back),
            "{:?}",
            found.reading.trips
        );
        assert_eq!(found.doubts, []);
        for times in [
            &[(12.0, 1.0)][..],
            &[(12.0, -1.0), (55.0, -1.0), (100.0, -1.0)],
        ] {
            let found = trips(times);
            assert!(is_told(&found, times) || !found.doubts.is_empty());
        }
    }
}

/// The cage turns at a landing at once: it is as far from where it began as it went, however near it ends.
#[test]
fn there_and_back_without_a_rest_are_two_rides() {
    let back = |time: f64| -pulse(time - 37.2) + pulse(time - 52.2);
    let found = explained(&record(80.0, back), Some(true));
    let ups: Vec<bool> = found.reading.trips.iter().map(|trip| trip.is_up).collect();
    assert_eq!(ups, [true, false]);
    assert_eq!(found.doubts, []);
}

/// A hole leaves only a piece of the braking, too slow for a ride: it may still be one.
#[test]
fn a_piece_of_a_change_may_be_one() {
    let samples = record(70.0, |_| 0.0).into_iter();
    let kept = samples.filter(|it| !(18.0..36.4).contains(&it.time));
    let found = explained(&kept.collect::<Vec<_>>(), None);
    let doubted = found.doubts.iter().flat_map(|doubt| &doubt.instead);
    let mut all = found.reading.trips.iter().chain(doubted);
    let stop = |trip: &Trip| trip.stop.is_some_and(|stop| (stop - RIDE.1).abs() < 0.5);
    assert!(all.any(|trip| trip.is_up && stop(trip)));
}

/// A ride of a lift that starts and stops at 0.06 m/s² is found, or said to be possible.
#[test]
fn a_soft_start_is_a_start() {
    let soft = |time| 0.06 * (within(time, 50.0, 60.0) - within(time, 70.0, 80.0));
    let found = explained(&record(90.0, soft), None);
    let doubted = found.doubts.iter().flat_map(|doubt| &doubt.instead);
    let mut all = found.reading.trips.iter().chain(doubted);
    let near = |time: Option<f64>, truth: f64| time.is_some_and(|it| (it - truth).abs() < 1.0);
    assert!(all.any(|trip| near(trip.start, 50.0) && near(trip.stop, 80.0)));
}

/// A cage bounces on its rope, slower than any step of a person, until that has decayed, or for a period: then that
/// may be undecided.
#[test]
fn a_slow_swing_is_no_ride() {
    for frequency in [0.15, 0.2, 0.25, 0.3, 0.35, 0.45] {
        for speed in [0.2, 0.3, 0.6] {
            for (periods, decay) in [(1.0, 0.0), (1.5, 0.0), (50.0, 0.05)] {
                let bounce = |time: f64| {
                    let phase = TAU * frequency * (time - 45.0);
                    let is_on = within(phase, 0.0, TAU * periods);
                    // The derivative of speed · sin φ · e^(−decay φ).
                    let slope = phase.cos() - decay * phase.sin();
                    is_on * speed * TAU * frequency * slope * (-decay * phase).exp()
                };
                let found = explained(&record(100.0, bounce), None);
                let trips = &found.reading.trips;
                let is_told = is_right(&found) || (periods < 2.0 && !found.doubts.is_empty());
                assert!(is_told, "{frequency} {speed} {periods}: {trips:?}");
            }
        }
    }
}

/// Rides of one floor in a row turn as often as a swing, with hardly a rest in between.
#[test]
fn short_rides_in_a_row_are_no_swing() {
    let hops = |time: f64| {
        let starts = [45.0, 50.2, 55.4, 60.6];
        starts
            .map(|start| pulse(time - start) - pulse(time - start - 2.13))
            .iter()
            .sum()
    };
    let found = explained(&record(80.0, hops), None);
    assert_eq!(found.reading.trips.len(), 5, "{:?}", found.reading.trips);
}

/// Behind a high pass a ride is restored, or nothing is said of it that is not doubted: no hop of its start or its stop
/// is taken for a ride.
#[test]
fn no_ride_behind_a_filter_is_two_without_a_word() {
    for time_constant in [0.3, 0.5, 0.7, 1.0, 2.0, 5.0] {
        for (slower, faster) in [(1.0, 1.0), (2.0, 1.0), (3.0, 1.0), (3.0, 0.5), (4.0, 0.7)] {
            let mut low = 0.0;
            let share = 1.0 - (-1.0 / (50.0f64 * time_constant)).exp();
            let other =
                |time: f64| faster * ride(20.0 + (time - 20.0) / slower) - ride(time) - 9.81;
            let behind = record(130.0, other).into_iter().map(|it| {
                let acceleration = it.acceleration - low;
                low += share * acceleration;
                Sample { acceleration, ..it }
            });
            let found = explained(&behind.collect::<Vec<_>>(), None);
            let is_doubted =
                |trip: &Trip| found.doubts.iter().any(|doubt| doubt.trips.contains(trip));
            let mut decided = found.reading.trips.iter().filter(|trip| !is_doubted(trip));
            let stop = 20.0 + slower * (RIDE.1 - 20.0);
            let is_it = |trip: &Trip| {
                let near =
                    |time: Option<f64>, truth: f64| time.is_some_and(|it| (it - truth).abs() < 3.0);
                trip.is_up && near(trip.start, 20.0) && near(trip.stop, stop)
            };
            assert!(
                decided.all(is_it),
                "{time_constant} {slower} {faster}: {:?}",
                found.reading.trips
            );
        }
    }
}

/// The longer a hole in the cruise, the likelier the cage stopped in it; within a hole of a day it surely did.
#[test]
fn a_hole_may_hide_a_stop() {
    let across = |seconds: f64| {
        let samples = record(60.0, |_| 0.0).into_iter();
        let kept = samples.filter(|it| !(26.0..29.0).contains(&it.time));
        let later = kept.map(|it| Sample {
            time: it.time + if it.time < 29.0 { 0.0 } else { seconds - 3.0 },
            ..it
        });
        explained(&later.collect::<Vec<_>>(), None)
    };
    for seconds in [3.0, 5.0] {
        let found = across(seconds);
        assert_eq!(found.reading.trips.len(), 1, "{seconds}");
        assert_eq!(found.doubts, [], "{seconds}");
    }
    let found = across(20.0);
    assert!(
        found
            .doubts
            .iter()
            .any(|doubt| doubt.trips.len() != doubt.instead.len())
    );
    for seconds in [200.0, 86_400.0, 1e7] {
        let trips = across(seconds).reading.trips;
        let ends: Vec<_> = trips.iter().map(|trip| trip.start.is_some()).collect();
        assert_eq!(ends, [true, false], "{seconds}: {trips:?}");
    }
}

/// A beginning that is said and wrong is seen to be.
#[test]
fn a_wrong_beginning_is_seen() {
    let whole = record(120.0, |time| -ride(time - 30.0) + ride(time - 60.0));
    let cut: Vec<Sample> = whole.iter().copied().filter(|it| it.time > 28.0).collect();
    for (samples, rests) in [(whole, true), (cut, false)] {
        for said in [None, Some(rests), Some(!rests)] {
            let found = explained(&samples, said);
            assert_eq!(
                found.begins_otherwise,
                said == Some(!rests),
                "{rests} {said:?}"
            );
        }
    }
}

/// Stretches at 5 Hz: how long, s, and the acceleration in each. Weak and long ones may be shifts of the level.
fn stretches() -> impl Strategy<Value = Vec<(f64, f64)>> {
    let acceleration = prop::sample::select(vec![
        0.0, 0.0, 0.0, 0.03, -0.03, 0.06, -0.06, 0.12, -0.12, 0.3, -0.3, 1.0, -1.0, 3.0, -3.0,
    ]);
    prop::collection::vec((0.2..8.0f64, acceleration), 1..40)
}

proptest! {
    #![proptest_config(ProptestConfig { rng_seed: prop::test_runner::RngSeed::Fixed(2014), cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    /// Whatever a record holds, the phases of a trip are in order, and no trip begins before the one before it ends.
    #[test]
    fn a_trip_follows_another(stretches in stretches(), noise in prop::sample::select(vec![0.0, 0.02])) {
        let mut samples: Vec<Sample> = Vec::new();
        for (seconds, acceleration) in stretches {
            for _ in 0..(5.0 * seconds) as u32 {
                let number = samples.len() as u32;
                let draw = f64::from(number.wrapping_mul(2_654_435_761) >> 16) / 65536.0 - 0.5;
                let acceleration = acceleration + noise * draw;
                samples.push(Sample { time: f64::from(number) / 5.0, acceleration });
            }
        }
        let found = Explanation::of(&Cut::new(&samples, 1, 0.2), &Prior::default());
        let times = found.reading.trips.iter().flat_map(|trip| {
            [trip.start, trip.inertial, trip.braking, trip.levelling, trip.stop]
        });
        let times: Vec<f64> = times.flatten().collect();
        prop_assert!(times.is_sorted(), "{:?}", found.reading.trips);
    }
}
