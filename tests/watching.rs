//! The monitor on constructed cages in difficult cases.

use liftsim::detection::{Detection, End};
use liftsim::monitor::{Alarm, Design, Event, Fault, Kind, Knowledge, Monitor, Settings, State};
use liftsim::recording::Sample;
use std::path::Path;
use std::{env, fs};

/// Seconds, and the acceleration in them, m/s².
type Piece = (f64, f64);

const BLOCK: f64 = 0.05;

/// Blocks of one sample with little noise: a very quiet cage whose motion looks like its rest.
fn samples(pieces: &[Piece]) -> Vec<Sample> {
    let mut samples = Vec::new();
    let mut noise = 1u32;
    for &(seconds, acceleration) in pieces {
        for _ in 0..(seconds / BLOCK).round() as usize {
            noise = noise.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let uniform = f64::from(noise >> 8) / f64::from(1 << 23) - 1.0;
            samples.push(Sample {
                time: samples.len() as f64 * BLOCK,
                acceleration: 9.8 + acceleration + 0.01 * uniform,
            });
        }
    }
    samples
}

fn design() -> Design {
    Settings::default().at(1.0 / BLOCK).unwrap()
}

/// The knowledge of a cage that stands, with the reference from a minute of rest.
fn knowledge(design: &Design) -> Knowledge {
    let mut monitor = Monitor::new(design.clone(), standing());
    for sample in samples(&[(60.0, 0.0)]) {
        monitor.step(sample, None);
    }
    Knowledge {
        reference: monitor.reference().cloned(),
        ..standing()
    }
}

fn standing() -> Knowledge {
    Knowledge {
        begins_at_rest: true,
        ..Knowledge::default()
    }
}

fn events(design: &Design, knowledge: Knowledge, pieces: &[Piece]) -> Vec<Event> {
    let mut monitor = Monitor::new(design.clone(), knowledge);
    let step = |sample| monitor.step(sample, None).to_vec();
    samples(pieces).into_iter().flat_map(step).collect()
}

fn last_state(events: &[Event]) -> Option<State> {
    let state = |event: &Event| match event.kind {
        Kind::Change { state, .. } => Some(state),
        _ => None,
    };
    events.iter().rev().find_map(state)
}

/// The times at which rest was reported.
fn rests(events: &[Event]) -> Vec<f64> {
    let is_rest =
        |event: &&Event| matches!(event.kind, Kind::Change { state, .. } if state == State::REST);
    events
        .iter()
        .filter(is_rest)
        .map(|event| event.reported)
        .collect()
}

/// A cage that is known to stand and starts before a reference is learnt is not reported at rest while it moves.
#[test]
fn a_start_in_the_first_second() {
    let design = design();
    for rest in [0.1, 0.3, 0.6, 1.0, 1.2, 2.0, 3.0, 4.0] {
        let ride = [
            (rest, 0.0),
            (1.5, 0.6),
            (20.0, 0.0),
            (1.5, -0.6),
            (10.0, 0.0),
        ];
        for knowledge in [knowledge(&design), standing()] {
            let events = events(&design, knowledge, &ride);
            let moves = rest + 1.0..rest + 23.0;
            let wrong = rests(&events).into_iter().find(|said| moves.contains(said));
            assert_eq!(wrong, None, "{rest} s: {events:?}");
        }
    }
}

/// A braking that cuts the acceleration short ends the motion, for any length of either: `rest` is not said of the
/// moving cage, and what is said at last is `rest`, or doubt where the pulses are as short as a swing.
#[test]
fn no_uniform_motion() {
    let design = design();
    let knowledge = knowledge(&design);
    let (mut told, mut all) = (0, 0);
    for tenths in (6..20).step_by(2) {
        for acceleration in [0.3, 0.4, 0.55, 0.7, 0.9, 1.1, 1.4] {
            for braking in [0.3, 0.4, 0.6, 0.9, 1.2] {
                let seconds = f64::from(tenths) / 10.0;
                let speed = seconds * acceleration;
                let brakes = speed / braking;
                let distance = speed / 2.0 * (seconds + brakes);
                // What moves less than half a metre is a swing and no ride.
                if speed < 0.3 || distance < 0.55 {
                    continue;
                }
                let ride = [
                    (6.0, 0.0),
                    (seconds, acceleration),
                    (brakes, -braking),
                    (10.0, 0.0),
                ];
                let found = Detection::of(&design, &samples(&ride), None, Some(true));
                let ends: Vec<End> = found.trips.iter().map(|trip| trip.ended).collect();
                assert_eq!(ends, [End::Stop], "{ride:?}: {:?}", found.events);
                let top = seconds * acceleration;
                assert!(
                    (found.trips[0].speed / top - 1.0).abs() < 0.2,
                    "{ride:?}: {:?}",
                    found.events
                );
                let events = events(&design, knowledge.clone(), &ride);
                let moves = 7.0..6.0 + seconds + brakes - 0.3;
                let wrong = rests(&events).into_iter().find(|said| moves.contains(said));
                assert_eq!(wrong, None, "{ride:?}: {events:?}");
                assert!(last_state(&events).is_some_and(|state| !state.moves()));
                told += u32::from(last_state(&events) == Some(State::REST));
                all += 1;
            }
        }
    }
    println!("rest told after {told} of {all}");
    assert!(10 * told > 9 * all, "{told} of {all}");
}

/// A jam is detected for any sizes of the samples.
#[test]
fn a_jam_at_any_sizes() {
    for (reference, shift, scale, gap) in [
        (24, 12, 12, 0),
        (8, 12, 12, 0),
        (8, 12, 12, 6),
        (12, 24, 24, 0),
        (40, 8, 8, 2),
    ] {
        let mut settings = Settings::default();
        settings.samples.reference = reference;
        settings.samples.shift = shift;
        settings.samples.scale = scale;
        settings.samples.gap = gap;
        settings.detector.alpha = 0.01;
        let design = settings.at(1.0 / BLOCK).unwrap();
        let ride = [
            (8.0, 0.0),
            (1.5, 0.6),
            (12.0, 0.0),
            (0.1, -9.0),
            (20.0, 0.0),
        ];
        let events = events(&design, knowledge(&design), &ride);
        let jams = events
            .iter()
            .filter(|event| event.kind.alarm() == Some(Alarm::Jam));
        assert_eq!(
            jams.count(),
            1,
            "{reference}/{shift}/{scale} + {gap}: {events:?}"
        );
    }
}

/// A gap renumbers the blocks, and everything stored by block number is reset.
#[test]
fn gaps_anywhere() {
    let design = design();
    let ride = [(8.0, 0.0), (1.5, 0.6), (5.0, 0.0), (1.5, -0.6), (8.0, 0.0)];
    let (samples, knowledge) = (samples(&ride), knowledge(&design));
    for gap in 1..samples.len() {
        let mut monitor = Monitor::new(design.clone(), knowledge.clone());
        for (index, sample) in samples.iter().enumerate() {
            let late = if index < gap { 0.0 } else { 100.0 };
            let time = sample.time + late;
            for event in monitor.step(Sample { time, ..*sample }, None) {
                assert!(event.time <= event.reported, "{gap}: {event:?}");
            }
            // The cage moves from 8 to 16 s. A second and a half are allowed for a start.
            let is_moving = (9.5..15.5).contains(&sample.time);
            assert!(
                !(is_moving && monitor.state() == State::REST),
                "{gap}: {time}"
            );
        }
        let late = |(index, sample): (usize, &Sample)| Sample {
            time: sample.time + if index < gap { 0.0 } else { 100.0 },
            ..*sample
        };
        let samples: Vec<Sample> = samples.iter().enumerate().map(late).collect();
        for trip in Detection::of(&design, &samples, None, None).trips {
            let order = [trip.start, trip.inertial, trip.braking, trip.stop];
            let order: Vec<f64> = order.into_iter().flatten().collect();
            assert!(order.is_sorted(), "{gap}: {trip:?}");
        }
    }
}

/// From 1 Hz to 1 MHz, and with clock values so large that they are coarse.
#[test]
fn any_rate_at_any_time() {
    for rate in [2.0, 3.0, 3.7, 10.0, 100.0, 1e4, 1e6] {
        for origin in [0.0, -1e12, 1e12] {
            let design = Settings::default().at(rate).unwrap();
            let mut monitor = Monitor::new(design.clone(), Knowledge::default());
            let mut last = f64::NEG_INFINITY;
            for number in 0..120_000 {
                let time = origin + f64::from(number) / rate;
                if time <= last {
                    continue;
                }
                last = time;
                let acceleration = [0.0, 1.0, -1e4, 1e4][number as usize / 30_000 % 4];
                for event in monitor.step(Sample { time, acceleration }, Some(true)) {
                    assert!(event.time <= event.reported, "{rate} {origin}: {event:?}");
                }
            }
        }
    }
}

/// The rows of a file: numbers, whatever is no row of numbers left out.
fn rows(path: &Path) -> Vec<Vec<f64>> {
    let text = fs::read_to_string(path).unwrap();
    let cells = |line: &str| {
        line.split(',')
            .map_while(|cell| cell.trim().parse().ok())
            .collect()
    };
    let rows = text.lines().map(cells);
    rows.filter(|row: &Vec<f64>| row.len() >= 2).collect()
}

/// The dangerous records of the folder that LIFTSIM_LIFTS names: `rest` is not said of a cage that moves, nor a ride
/// of one that stands; every motion is seen or doubted; and beside a cage that may stand the drum raises `slack`.
#[test]
fn made_records() {
    let Some(folder) = env::var_os("LIFTSIM_LIFTS") else {
        println!("skipped: LIFTSIM_LIFTS names no folder of lifts");
        return;
    };
    let folder = Path::new(&folder).join("made/monitor");
    let names = fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let mut records: Vec<_> = names
        .filter(|path| !path.to_string_lossy().contains(".truth."))
        .collect();
    records.sort();
    assert!(records.len() >= 16);
    for path in records {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let truth = path.with_extension("truth.csv");
        let trips = if truth.exists() {
            rows(&truth)
        } else {
            Vec::new()
        };
        judge(&name, &rows(&path), &trips);
    }
}

fn judge(name: &str, rows: &[Vec<f64>], trips: &[Vec<f64>]) {
    let mut steps: Vec<f64> = rows
        .windows(2)
        .map(|pair| pair[1][0] - pair[0][0])
        .collect();
    steps.sort_by(f64::total_cmp);
    let design = Settings::default()
        .at(1.0 / steps[steps.len() / 2])
        .unwrap();
    let mut monitor = Monitor::new(design, standing());
    let mut events = Vec::new();
    let (mut wrong, mut seen) = (0.0, vec![false; trips.len()]);
    let first = rows[0][0];
    for (index, row) in rows.iter().enumerate() {
        let sample = Sample {
            time: row[0],
            acceleration: row[1],
        };
        let drum = row.get(2).map(|turns| *turns == 1.0);
        events.extend_from_slice(monitor.step(sample, drum));
        // Where the clock is set, the truth counts from the first sample on.
        let time = if name.starts_with("09") || name.starts_with("10") {
            0.01 + 0.02 * index as f64
        } else {
            row[0] - first + 0.01
        };
        // So long after the start, and before the stop, it has 0.2 m/s.
        let is_soft = name.contains("soft_start");
        let (from, to) = if is_soft { (4.0, 4.0) } else { (1.5, 0.3) };
        let is_trip = |trip: &Vec<f64>| trip[0] + from < time && time < trip[1] - to;
        if let Some(trip) = trips.iter().position(is_trip) {
            let is_rest = monitor.state() == State::REST;
            wrong += if is_rest { 0.02 } else { 0.0 };
            seen[trip] |= !is_rest;
        }
    }
    assert!(
        wrong <= 1.0,
        "{name}: rest is said of a moving cage for {wrong:.1} s"
    );
    assert!(seen.iter().all(|seen| *seen), "{name}: {events:?}");
    for event in &events {
        let Kind::Change { state, reason, .. } = event.kind else {
            continue;
        };
        assert_eq!(
            state == State::Unknown,
            reason.is_some(),
            "{name}: {event:?}"
        );
        let near = |trip: &Vec<f64>| trip[0] - 0.5 < event.reported && event.time < trip[1] + 0.5;
        let is_true = !state.moves() || trips.iter().any(near) || name.starts_with("10");
        assert!(is_true, "{name}: {event:?}");
    }
    let turns = rows.iter().find(|row| row.get(2) == Some(&1.0));
    if let Some(turns) = turns {
        let slack = events
            .iter()
            .find(|event| event.kind.alarm() == Some(Alarm::Slack));
        let slack = slack.unwrap_or_else(|| panic!("{name}: no alarm"));
        assert!(slack.reported <= turns[0] + 3.1, "{name}: {slack:?}");
    }
    let stuck = |event: &Event| event.kind == Kind::Sensor(Fault::Stuck);
    assert!(
        !name.starts_with("08") || events.iter().any(stuck),
        "{name}"
    );
}
