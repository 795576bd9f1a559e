//! The monitor on constructed cages in difficult cases.

use liftsim::detection::{Detection, End};
use liftsim::monitor::{Alarm, Design, Event, Kind, Knowledge, Monitor, Settings, State};
use liftsim::recording::Sample;

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

/// The knowledge from a minute of rest.
fn knowledge(design: &Design) -> Knowledge {
    Detection::of(design, &samples(&[(60.0, 0.0)]), None, None).knowledge
}

fn events(design: &Design, knowledge: Knowledge, pieces: &[Piece]) -> Vec<Event> {
    let mut monitor = Monitor::new(design.clone(), knowledge);
    let step = |sample| monitor.step(sample, None).to_vec();
    samples(pieces).into_iter().flat_map(step).collect()
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
        for knowledge in [
            knowledge(&design),
            Knowledge {
                begins_at_rest: true,
                ..Knowledge::default()
            },
        ] {
            let events = events(&design, knowledge, &ride);
            let moves = rest + 1.0..rest + 23.0;
            let wrong = rests(&events).into_iter().find(|said| moves.contains(said));
            assert_eq!(wrong, None, "{rest} s: {events:?}");
        }
    }
}

/// A braking that cuts the acceleration short ends the motion, for any length of either.
#[test]
fn no_uniform_motion() {
    let design = design();
    for tenths in 6..20 {
        for acceleration in [0.3, 0.4, 0.55, 0.7, 0.9, 1.1, 1.4] {
            for braking in [0.3, 0.4, 0.6, 0.9, 1.2] {
                let seconds = f64::from(tenths) / 10.0;
                let speed = seconds * acceleration;
                let distance = speed / 2.0 * (seconds + speed / braking);
                // What moves less than half a metre is a swing and no ride.
                if speed < 0.3 || distance < 0.55 {
                    continue;
                }
                let ride = [
                    (6.0, 0.0),
                    (seconds, acceleration),
                    (seconds * acceleration / braking, -braking),
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
            }
        }
    }
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
            .filter(|event| event.kind == Kind::Alarm(Alarm::Jam));
        assert_eq!(
            jams.count(),
            1,
            "{reference}/{shift}/{scale} + {gap}: {events:?}"
        );
    }
}

/// Learning in the unknown state does not cut off the beginning of the next pulse.
#[test]
fn learning_does_not_cut_a_pulse() {
    let design = design();
    for start in 0..40 {
        let rest = 10.0 + f64::from(start) * BLOCK;
        let ride = [
            (rest, 0.0),
            (1.5, 0.6),
            (3.0, 0.0),
            (1.5, -0.6),
            (4.0, 0.0),
            (1.5, -0.6),
            (6.0, 0.0),
        ];
        let events = events(&design, Knowledge::default(), &ride);
        // + − − : the cage moves down.
        let is_start =
            |event: &&Event| matches!(event.kind, Kind::Change { state, .. } if state.moves());
        let begun = events.iter().find(is_start);
        let begun = begun.unwrap_or_else(|| panic!("{rest} s: {events:?}"));
        assert!(
            (begun.time - (rest + 10.0)).abs() < 0.5,
            "{rest} s: {events:?}"
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
        let late = |(index, sample): (usize, &Sample)| Sample {
            time: sample.time + if index < gap { 0.0 } else { 100.0 },
            ..*sample
        };
        let samples: Vec<Sample> = samples.iter().enumerate().map(late).collect();
        let mut monitor = Monitor::new(design.clone(), knowledge.clone());
        for sample in &samples {
            for event in monitor.step(*sample, None) {
                assert!(event.time <= event.reported, "{gap}: {event:?}");
            }
        }
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
