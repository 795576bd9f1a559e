//! Faults of the sensor and its clock, and the drum.

use super::*;

#[test]
fn a_gap_makes_the_state_unknown() {
    let record = Record::quiet()
        .rest(8.0)
        .with(2.0, 0.5, 1.0)
        .with(4.0, 0.0, 2.0);
    let mut monitor = standing();
    let before = record.watch(&mut monitor);
    assert_eq!(known(&before), [REST, ACCELERATING, INERTIAL]);
    let time = record.now() + 10.0;
    let sample = Sample {
        time,
        acceleration: 0.0,
    };
    let after = monitor.step(sample, None);
    assert_eq!(faults(after), [Fault::Silent]);
    assert_eq!(states(after), [State::Unknown]);
    assert_eq!(after[1].time, time);
}

/// What each fault is told of, and that the state is unknown while it lasts.
#[test]
fn faults_of_the_sensor_are_told() {
    let rest = || Record::quiet().rest(10.0);
    let told = |record: Record| {
        let mut monitor = standing();
        let events = record.watch(&mut monitor);
        (faults(&events), monitor.state())
    };
    let unknown = State::Unknown;
    assert_eq!(
        told(rest().with(3.0, 0.003, 0.0)),
        (vec![Fault::Stuck], unknown)
    );
    assert_eq!(
        told(rest().with(0.5, 19.6, 0.0)),
        (vec![Fault::Saturated], unknown)
    );
    assert_eq!(told(rest().with(30.0, 0.0, 200.0)).0, [Fault::Noisy]);
}

/// A sensor that has hardly changed may be stuck: nothing is known while it does not, nor what the cage did meanwhile.
#[test]
fn a_sensor_stuck_from_its_first_sample_tells_nothing() {
    for level in [0.0, 0.4, 9.81] {
        for seconds in [1.5, 20.0, 90.0] {
            let stuck = Record::quiet()
                .with(0.0, level, 0.0)
                .with(seconds, level, 0.0);
            for begin in [|_: &mut Monitor| (), Monitor::begin_in_motion] {
                let mut monitor = standing();
                begin(&mut monitor);
                let events = stuck.watch_with(&mut monitor, |time| Some(time > 1.0));
                assert_eq!(faults(&events), [Fault::Stuck], "{level} {seconds}");
                assert_eq!(known(&events), [], "{level} {seconds}");
                let certain =
                    |event: &Event| matches!(event.kind, Kind::Alarm { certain: true, .. });
                assert!(!events.iter().any(certain), "{level} {seconds}: {events:?}");
            }
            // Some samples may have come before, and the sensor may come to life in any steps.
            for (before, step) in [
                (0.0, 0.0),
                (0.01, 0.0),
                (0.09, 0.0),
                (0.0, 0.01),
                (0.01, 0.02),
                (0.0, 0.05),
            ] {
                let mut record = Record::quiet()
                    .with(0.0, level, 0.0)
                    .with(before, level, 1.0)
                    .with(seconds, level, 0.0)
                    .with(20.0, level, 2.0);
                for acceleration in record.samples.iter_mut().filter(|_| step > 0.0) {
                    *acceleration = (*acceleration / step).round() * step;
                }
                let events = record.watch(&mut standing());
                assert_eq!(known(&events), [], "{level} {seconds} {before} {step}");
            }
        }
    }
}

/// Nor does one that is dead but for glitches, the same ones or others, from its first sample on or later.
#[test]
fn glitches_are_no_sign_of_life() {
    let sizes = [9.0, 0.4, 0.05];
    let kinds = sizes.map(|most| [20, 80, 250].map(|every| [1, 2].map(|long| (most, every, long))));
    for (most, every, long) in kinds.into_iter().flatten().flatten() {
        for (alive, is_one) in [(0.0, true), (0.0, false), (12.0, true), (12.0, false)] {
            let lived = Record::quiet().rest(alive);
            let from = lived.samples.len();
            let mut samples = lived.samples;
            samples.resize(from + 6000, 0.003);
            for (place, i) in (from + 40..from + 5990).step_by(every).enumerate() {
                let share = (place * 37 % 100) as f64 / 100.0;
                samples[i..i + long].fill(0.003 + if is_one { most } else { share * most });
            }
            let record = Record { samples, ..lived };
            let mut monitor = standing();
            record.watch(&mut monitor);
            let what = format!("{most} {every} {long} {alive} {is_one}");
            assert_eq!(monitor.state(), State::Unknown, "{what}");
        }
    }
}

/// A sensor whose steps hide its noise does not scatter at rest either. Its first trip shows that it is not stuck.
#[test]
fn a_coarse_sensor_shows_the_trips() {
    for step in [0.05, 0.1, 0.2, 0.3] {
        let mut record = Record::quiet().rest(15.0);
        for sign in [1.0, -1.0, 1.0] {
            record = record.trip(sign).rest(15.0);
        }
        for acceleration in &mut record.samples {
            *acceleration = (*acceleration / step).round() * step;
        }
        let mut monitor = standing();
        let events = record.watch(&mut monitor);
        let known = known(&events);
        let stops = known
            .windows(2)
            .filter(|two| two[0].moves() && two[1] == REST);
        assert!(stops.count() >= 2, "{step}: {known:?}");
        assert_eq!(monitor.state(), REST, "{step}");
    }
}

/// A phone whose screen goes off sends a tenth of its samples: what is read at another rate than it was is not believed.
#[test]
fn rare_samples_are_not_read_as_before() {
    let record = Record::quiet().rest(10.0).trip(1.0).rest(6.0).trip(-1.0);
    let mut monitor = standing();
    let mut events = Vec::new();
    for (i, acceleration) in record.samples.iter().enumerate() {
        if i > 500 && i % 10 != 0 {
            continue;
        }
        let sample = Sample {
            time: i as f64 / RATE,
            acceleration: *acceleration,
        };
        events.extend_from_slice(monitor.step(sample, None));
    }
    assert_eq!(faults(&events), [Fault::Slow]);
    assert_eq!(known(&events), [REST], "{events:?}");
    assert_eq!(monitor.state(), State::Unknown);
}

/// Somebody jumps, and the lift leaves at once: the ride is told, and its stop.
#[test]
fn a_jump_before_a_ride_hides_no_ride() {
    for pause in [0.3, 0.6, 0.9] {
        let jump = Record::quiet()
            .rest(12.0)
            .with(0.26, 2.4, 1.0)
            .with(0.3, -4.0, 1.0)
            .with(0.14, 4.0, 1.0);
        let record = jump.rest(pause).trip(1.0).rest(12.0);
        let mut monitor = standing();
        let events = record.watch(&mut monitor);
        assert!(known(&events).contains(&INERTIAL), "{pause}: {events:?}");
        assert_eq!(monitor.state(), REST, "{pause}");
    }
}

/// Wherever a hole lies in a ride, what comes after it is never told the wrong way round: a braking may as well be a start.
#[test]
fn after_a_hole_no_direction_is_guessed() {
    for [sign, next] in [[1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [-1.0, -1.0]] {
        let record = Record::quiet().rest(10.0).trip(sign).rest(10.0);
        let record = record.trip(next).rest(10.0);
        for hole in (0..40).flat_map(|i| [0.6, 1.5, 3.0, 6.0, 12.0, 20.0].map(|it| (i, it))) {
            let from = 8.0 + f64::from(hole.0) / 2.0;
            let [first, after] = [from, from + hole.1].map(|it| (it * RATE) as usize);
            let mut monitor = standing();
            let readings = record.samples.iter().enumerate();
            for (i, acceleration) in readings.filter(|(i, _)| !(first..after).contains(i)) {
                let time = i as f64 / RATE;
                let sample = Sample {
                    time,
                    acceleration: *acceleration,
                };
                for event in monitor.step(sample, None) {
                    let Some(told) = event.kind.direction() else {
                        continue;
                    };
                    let goes = if (10.0..23.0).contains(&time) {
                        sign
                    } else if (32.0..45.0).contains(&time) {
                        next
                    } else {
                        told.sign()
                    };
                    assert_eq!(told.sign(), goes, "{from} for {}: {event:?}", hole.1);
                }
            }
        }
    }
}

/// One stamp far ahead, and the way back: two holes, and the next trips are seen.
#[test]
fn a_clock_that_is_set_back_costs_a_gap() {
    let record = Record::quiet()
        .rest(8.0)
        .trip(1.0)
        .rest(6.0)
        .trip(-1.0)
        .rest(6.0);
    let mut monitor = standing();
    let mut events = Vec::new();
    for (i, acceleration) in record.samples.iter().enumerate() {
        let time = if i == 600 { 1e6 } else { i as f64 / RATE };
        let sample = Sample {
            time,
            acceleration: *acceleration,
        };
        events.extend_from_slice(monitor.step(sample, None));
    }
    assert_eq!(faults(&events), [Fault::Silent, Fault::Clock]);
    assert_eq!(known(&events).last(), Some(&REST), "{events:?}");
}

/// Somebody knocks against a standing car, its sensor later reads another level, and the drum turns: what is told of that is
/// what it were without the knock, and the alarm comes.
#[test]
fn a_knock_hides_no_slack() {
    let knocks = [
        (0.5, 0.3),
        (-0.5, 0.3),
        (0.2, 0.3),
        (0.16, 0.2),
        (0.9, 0.15),
    ];
    let kinds = [1.0, 1.5, 2.0, 3.0, 5.0, 10.0, 15.0, 50.0]
        .into_iter()
        .flat_map(|before| knocks.map(|knock| (before, knock)))
        .flat_map(|(before, knock)| [0.15, -0.15, 0.3].map(|level| (before, knock, level)));
    for (before, (by, seconds), level) in kinds {
        let told = |by: f64| {
            let knocked = Record::quiet()
                .rest(90.0 - before)
                .changing(seconds, by, 0.0, 1.0)
                .changing(seconds, -2.0 * by, 0.0, 1.0)
                .changing(before, by, 0.0, 1.0);
            let start = knocked.now();
            let record = knocked.changing(30.0, level, 1.0, 1.0);
            let drum = |time| Some(time > start + 10.0);
            let mut events = record.watch_with(&mut standing(), drum);
            events.retain(|event| event.reported > start);
            (states(&events), alarms(&events))
        };
        let (knocked, quiet) = (told(by), told(0.0));
        let what = format!("{by} for {seconds} s, {before} s before {level}");
        assert_eq!(knocked, quiet, "{what}");
        assert_eq!(knocked.1, [Alarm::Slack], "{what}");
    }
}

/// The level shifts soon after the beginning, and the drum turns: the alarm comes.
#[test]
fn a_level_that_shifts_early_hides_no_slack() {
    for (rest, level) in [5.0, 8.0, 12.0, 16.0]
        .into_iter()
        .flat_map(|it| [0.15, 0.2, -0.3].map(|by| (it, by)))
    {
        let record = Record::quiet().rest(rest).changing(45.0, level, 1.0, 1.0);
        let drum = |time| Some(time > rest + 10.0);
        let events = record.watch_with(&mut standing(), drum);
        assert_eq!(alarms(&events), [Alarm::Slack], "{level} at {rest} s");
    }
}

#[test]
fn a_drum_that_turns_without_the_cage_is_an_alarm() {
    let record = Record::quiet().rest(8.0).trip(-1.0).rest(20.0);
    let mut monitor = standing();
    let turns = |time: f64| (8.0..20.2).contains(&time) || (30.0..36.0).contains(&time);
    let mut events = Vec::new();
    for (i, a) in record.samples.iter().enumerate() {
        let time = i as f64 / RATE;
        let sample = Sample {
            time,
            acceleration: *a,
        };
        events.extend_from_slice(monitor.step(sample, Some(turns(time))));
    }
    assert_eq!(alarms(&events), [Alarm::Slack]);
    let alarm = events
        .iter()
        .find(|event| event.kind.alarm().is_some())
        .unwrap();
    assert!(
        (alarm.time - 30.0).abs() < 0.1 && (alarm.reported - 33.0).abs() < 0.1,
        "{alarm:?}"
    );
}

/// A shock while the cage starts or brakes, of any strength and at any moment, never makes it rest in motion.
#[test]
fn a_shock_on_a_start_or_a_braking_hides_neither() {
    let strengths = [-60.0, -30.0, -12.0, -6.0, 6.0, 12.0, 30.0];
    let times = [8.1, 8.5, 8.9, 9.3, 9.7, 18.1, 18.5, 18.9, 19.3, 19.7];
    for (strength, shock) in strengths.iter().flat_map(|it| times.map(|time| (it, time))) {
        let record = Record::quiet()
            .rest(8.0)
            .trip(1.0)
            .rest(8.0)
            .trip(-1.0)
            .rest(8.0);
        let mut monitor = standing();
        for (i, acceleration) in record.samples.iter().enumerate() {
            let time = i as f64 / RATE;
            let hit = if (shock..shock + 0.035).contains(&time) {
                *strength
            } else {
                0.0
            };
            monitor.step(
                Sample {
                    time,
                    acceleration: acceleration + hit,
                },
                None,
            );
            let moves = [9.5..19.4, 29.5..39.4]
                .iter()
                .any(|trip| trip.contains(&time));
            assert!(
                !(moves && monitor.state() == REST),
                "a shock of {strength} m/s² at {shock} s: rest at {time} s"
            );
        }
    }
}
