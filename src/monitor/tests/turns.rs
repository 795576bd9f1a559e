//! The sensor is turned, or somebody has it in hand.

use super::*;

/// A sensor that is turned at rest reads another level at once. That is no start, and a cage that leaves before the new level
/// has shown itself is not at rest. Only when it is over, a motion is told that comes at once, and later where to.
#[test]
fn what_changes_at_once_may_be_the_level() {
    let turns = [0.1, -0.3, 0.5, -0.5].map(|by| [1.0, 2.0, 4.0, 30.0].map(|seconds| (by, seconds)));
    for (by, seconds) in turns.into_iter().flatten() {
        let turned = Record::quiet().rest(30.0).changing(seconds, by, 0.0, 1.0);
        let start = turned.now();
        let record = turned.trip_on(by, 1.0, 2.0).trip_on(by, -1.0, 2.0);
        let events = record.watch(&mut standing());
        for event in &events {
            let Kind::Change { state, .. } = event.kind else {
                continue;
            };
            let moves = state != REST && state != State::Unknown;
            let is_rest = state == REST;
            assert!(
                !moves || event.reported > start,
                "{by} {seconds}: {event:?}"
            );
            let ride = start + 1.0..start + 12.0;
            assert!(
                !is_rest || !ride.contains(&event.reported),
                "{by} {seconds}: {event:?}"
            );
        }
        let last = states(&events).last().copied();
        let rests = last == Some(REST) || seconds < 30.0 && last == Some(State::Unknown);
        assert!(rests, "{by} {seconds}: {events:?}");
    }
    let record = Record::quiet().rest(30.0).changing(2.0, 0.5, 0.0, 1.0);
    let events = record.changing(8.0, -0.5, 0.0, 2.0).watch(&mut standing());
    assert_eq!(known(&events), [REST, INERTIAL, ACCELERATING, INERTIAL]);
    assert_eq!(
        events[events.len() - 2].reported,
        events[events.len() - 1].reported
    );
}

/// A phone that is turned reads another level for good. That is no motion for long, and after the next trips it is known.
#[test]
fn a_turned_sensor_does_not_move_for_ever() {
    for level in [0.15, 0.2, 0.3, 0.4, 0.5, -0.3, -0.4] {
        let turned = Record::quiet().rest(25.0).with(50.0, level, 1.0);
        let mut monitor = standing();
        turned.watch(&mut monitor);
        assert!(!monitor.state().moves(), "{level}: {:?}", monitor.state());
        let mut monitor = standing();
        let trips = turned.trip_on(level, 1.0, 2.0).trip_on(level, -1.0, 2.0);
        trips.watch(&mut monitor);
        assert_eq!(monitor.state(), REST, "{level}");
    }
}

/// A hand that turns the sensor overshoots, or knocks against it first. The rides after it are no rest.
#[test]
fn a_sensor_turned_roughly_hides_no_ride() {
    let ride = |record: Record, by: f64, ramp: f64| {
        let start = record
            .changing(2.0, by, ramp, 1.0)
            .changing(10.0, -by, ramp, 2.0);
        start
            .changing(2.0, -by, ramp, 1.0)
            .changing(12.0, by, ramp, 1.0)
    };
    let overshoots = [0.6, 1.0, 1.6].map(|over| (over, 0.1));
    let knocks = [(1.0, 0.3), (2.0, 0.1)];
    for (over, seconds) in overshoots.into_iter().chain(knocks) {
        for turn in [0.5, -0.5, 0.3] {
            let past = over * turn;
            let turned = Record::quiet()
                .rest(30.0)
                .changing(seconds, turn + past, 0.0, 1.0)
                .changing(0.2, -turn - past, 0.0, 1.0)
                .changing(3.0, turn, 0.0, 1.0);
            let start = turned.now();
            let record = ride(ride(turned, -0.4, 0.8), 0.4, 0.8);
            let events = record.watch(&mut standing());
            let cruises =
                [3.0, 29.0].map(|from| (0..9).map(move |second| start + from + f64::from(second)));
            for time in cruises.into_iter().flatten() {
                let told: Vec<Event> = events
                    .iter()
                    .filter(|it| it.reported <= time)
                    .copied()
                    .collect();
                let what = format!("{turn}, {over} for {seconds} s, at {time}: {events:?}");
                assert_ne!(states(&told).last(), Some(&REST), "{what}");
            }
        }
    }
}

/// A sensor that is turned within half a second of a start hides no ride, and tells no direction against it.
#[test]
fn a_sensor_turned_at_a_start_hides_no_ride() {
    const START: f64 = 20.0;
    // The acceleration, how long it takes to come about, and how long it lasts, s.
    for (by, ramp, seconds) in [(0.12, 1.2, 14.0), (0.15, 0.5, 10.0), (0.3, 0.4, 5.0)] {
        let start = Record::quiet().rest(START);
        let start = start.changing(seconds, by, ramp, 1.0);
        let stop = start.changing(12.0, -by, ramp, 2.0);
        let stop = stop.changing(seconds, -by, ramp, 1.0);
        let until = stop.now();
        let ride = stop.changing(10.0, by, ramp, 1.0);
        let turns = [-0.4, -0.1, 0.2, 0.5].map(|at| [0.5, -0.5, 0.4].map(|turn| (turn, at)));
        for (turn, at) in turns.into_iter().flatten() {
            let mut record = ride.clone();
            let from = ((START + at) * RATE) as usize;
            record.samples[from..].iter_mut().for_each(|a| *a += turn);
            let events = record.watch(&mut standing());
            // For so long it is slower than 0.2 m/s.
            let slow = 0.2 / by + ramp + 1.0;
            let ends = events[1..].iter().map(|event| event.reported);
            for (event, end) in events.iter().zip(ends.chain([record.now()])) {
                let Kind::Change {
                    state, direction, ..
                } = event.kind
                else {
                    continue;
                };
                let is_fast = end > START + slow && event.reported < until - slow;
                let is_wrong = state == REST || direction == Some(Direction::Down);
                let what = format!("{by} for {seconds} s, {turn} at {at}: {events:?}");
                assert!(!(is_fast && is_wrong), "{what}");
            }
        }
    }
}

/// When a sensor was turned is a moment of the clock before.
#[test]
fn a_clock_that_is_set_back_after_a_turn_hides_no_ride() {
    let turned = Record::quiet().rest(10.0).changing(8.0, 0.5, 0.0, 1.0);
    let record = (turned.trip_on(0.5, 1.0, 2.0)).trip_on(0.5, -1.0, 2.0);
    let mut monitor = standing();
    let mut events = Vec::new();
    for (i, &acceleration) in record.samples.iter().enumerate() {
        let before = if i < 1600 { 1e5 } else { 0.0 };
        let time = before + i as f64 / RATE;
        events.extend_from_slice(monitor.step(Sample { time, acceleration }, None));
    }
    assert_eq!(faults(&events), [Fault::Clock]);
    let moving = |from: f64| {
        let within = |event: &&Event| (from..from + 12.0).contains(&event.reported);
        let told: Vec<Event> = events.iter().filter(within).copied().collect();
        states(&told).contains(&INERTIAL)
    };
    assert!(moving(18.0) && moving(40.0), "{events:?}");
}

/// The sensor is turned in a hole while the cage moves: that it stood when the record began says nothing after it.
#[test]
fn a_level_after_a_hole_is_tried_from_the_hole_on() {
    let after = [(6.0, 0.2), (2.0, -0.3), (12.0, 0.2)];
    let mut monitor = standing();
    let started = Record::quiet().rest(10.0).with(2.0, 0.5, 1.0);
    started.watch(&mut monitor);
    let mut time = started.now() + 6.0;
    for (seconds, acceleration) in after {
        for _ in 0..(seconds * RATE) as usize {
            monitor.step(Sample { time, acceleration }, None);
            time += 1.0 / RATE;
        }
    }
    assert!(!monitor.state().moves(), "{:?}", monitor.state());
}

/// A phone that is lifted, held and put down on another level may cost a trip or two, not all that follow.
#[test]
fn handling_is_got_over() {
    for level in [0.02, -0.02, 0.04] {
        let held = Record::quiet()
            .rest(10.0)
            .with(0.8, 1.5, 1.0)
            .with(0.8, -1.5, 1.0)
            .with(5.0, -0.3, 6.0)
            .with(0.8, -1.5, 1.0)
            .with(0.8, 1.5, 1.0)
            .with(8.0, level, 1.0);
        let record = [1.0, 1.0, -1.0, 1.0, -1.0, -1.0]
            .into_iter()
            .fold(held, |record, sign| record.trip_on(level, sign, 1.0));
        let mut monitor = standing();
        record.watch(&mut monitor);
        assert_eq!(monitor.state(), REST, "{level}");
    }
}

/// Somebody picks the sensor up and puts it down just before a ride: until it lies still, nothing is known, nor is the
/// cruise after that taken for rest.
#[test]
fn a_sensor_in_hand_tells_nothing() {
    for level in [-0.15, -0.3, -0.45] {
        let before = Record::quiet().rest(10.0);
        let held = before
            .with(0.4, 2.0, 1.0)
            .with(0.4, -2.0, 1.0)
            .with(4.0, level, 1.0)
            .with(0.4, 2.0, 1.0)
            .with(0.4, -2.0, 1.0)
            .with(1.0, 0.02, 1.0)
            .trip_on(0.02, 1.0, 1.0);
        let mut monitor = standing();
        let events = held.watch(&mut monitor);
        assert!(faults(&events).contains(&Fault::Moved), "{events:?}");
        // It cruises from 18.6 to 26.6 s.
        let is_rest = |event: &&Event| states(&[**event]) == [REST];
        let wrong = events
            .iter()
            .filter(|it| (11.5..27.0).contains(&it.reported))
            .find(is_rest);
        assert_eq!(wrong, None, "{level}");
    }
}
