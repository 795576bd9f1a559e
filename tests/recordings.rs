//! Rides in recordings, real and simulated.
//!
//! Real recordings are not part of the project: `LIFTSIM_LIFTS` names a folder of them, with a table of what they hold,
//! `truth.csv`. The times in it were read off by hand, so these tests show agreement, not accuracy. Without the folder
//! they print that they are skipped; the simulated ones always run.

use liftsim::detection::{Detection, Trip};
use liftsim::lift::{Drive, Ending, Journey, Pickup, Ride as Simulation, Trip as SimulatedTrip};
use liftsim::monitor::{Direction, Event, Kind, Knowledge, Monitor, Settings, State};
use liftsim::recording::{Reading, Recording, Sample};
use liftsim::signal::{Digitiser, Law, Noise, Phase, Sensor};
use std::collections::BTreeMap;
use std::env;
use std::path::PathBuf;

/// Largest distance of a start or a stop of a simulated ride from the truth, s.
const TOLERANCE: f64 = 0.5;

/// A trip as stated. Times in s.
#[derive(Clone, Copy, Debug)]
struct Stated {
    start: Option<f64>,
    levelling: Option<f64>,
    stop: Option<f64>,
    direction: Direction,
    tolerance: f64,
    /// How far it goes, m, up positive, and the tolerance.
    distance: Option<(f64, f64)>,
}

/// A recording in memory.
struct Known {
    name: String,
    rate: f64,
    samples: Vec<Sample>,
    trips: Vec<Stated>,
}

impl Known {
    fn detect(&self, settings: &Settings) -> Detection {
        Detection::of(&settings.at(self.rate).unwrap(), &self.samples, None, None)
    }

    /// The largest distance of an end from the stated one, s, or why the trips differ. What a recording holds before
    /// the first stated trip is not stated.
    fn worst(&self, found: &[Trip]) -> Result<f64, String> {
        let first = self.trips.first().and_then(|trip| trip.start);
        let is_stated =
            |trip: &&Trip| first.is_none_or(|first| trip.stop.is_none_or(|stop| stop > first));
        let found: Vec<&Trip> = found.iter().filter(is_stated).collect();
        if found.len() != self.trips.len() {
            return Err(format!(
                "{} rides, {} stated",
                found.len(),
                self.trips.len()
            ));
        }
        let mut worst = 0.0f64;
        for (trip, stated) in found.into_iter().zip(&self.trips) {
            let near = |found: Option<f64>, stated: Option<f64>| match (found, stated) {
                (Some(found), Some(stated)) => (found - stated).abs(),
                (None, None) => 0.0,
                _ => f64::INFINITY,
            };
            let ends = near(trip.start, stated.start).max(near(trip.stop, stated.stop));
            let levels = if stated.levelling.is_some() {
                near(trip.levelling, stated.levelling)
            } else {
                0.0
            };
            if trip.direction != stated.direction || ends.max(levels) > stated.tolerance {
                return Err(format!("{trip:?}, {stated:?} stated"));
            }
            worst = worst.max(ends);
        }
        Ok(worst)
    }

    /// The largest error of a distance, as a share of its tolerance. Of a ride that may have begun before the record
    /// the first speed is not known.
    fn worst_distance(&self, found: &Detection) -> f64 {
        let position = |time: f64| {
            let columns = found.trace.columns();
            let column = columns.partition_point(|column| column.times.1 < time);
            let (low, high) = columns[column.min(columns.len() - 1)].position;
            f64::midpoint(low, high)
        };
        let error = |stated: &Stated| {
            let (distance, tolerance) = stated.distance?;
            let is_whole = stated.start? - stated.tolerance > self.samples[0].time;
            let is_it = |trip: &&Trip| {
                let starts = trip.start.zip(stated.start);
                starts.is_some_and(|(a, b)| (a - b).abs() <= stated.tolerance)
            };
            let trip = found.trips.iter().find(is_it)?;
            let gone = position(trip.stop?) - position(trip.start?);
            println!("{:40} {gone:.2} m, {distance} stated", self.name);
            is_whole.then_some((gone - distance).abs() / tolerance)
        };
        self.trips.iter().filter_map(error).fold(0.0, f64::max)
    }
}

/// The recordings of the table, by their files, if available; those that the program was chosen on.
fn real() -> Vec<Known> {
    let Some(folder) = env::var_os("LIFTSIM_LIFTS").map(PathBuf::from) else {
        println!("skipped: LIFTSIM_LIFTS names no folder of recordings");
        return Vec::new();
    };
    let mut files: BTreeMap<String, Vec<Stated>> = BTreeMap::new();
    let mut table =
        csv::Reader::from_path(folder.join("truth.csv")).expect("the table can be read");
    for row in table.deserialize::<BTreeMap<String, String>>() {
        let row = row.expect("rows have a cell for every column");
        let number = |column: &str| row[column].parse::<f64>().ok();
        let trips = files.entry(row["file"].clone()).or_default();
        trips.extend(number("start").map(|start| Stated {
            start: Some(start),
            levelling: number("levelling"),
            stop: number("stop"),
            direction: if row["direction"] == "up" {
                Direction::Up
            } else {
                Direction::Down
            },
            tolerance: number("tolerance_s").expect("a tolerance"),
            distance: number("distance").zip(number("tolerance_m")),
        }));
    }
    assert!(!files.is_empty(), "the table has rows");
    let read = |(name, trips): (String, Vec<Stated>)| {
        let recording = Recording::open(&folder.join(&name), &Reading::default());
        let recording = recording.unwrap_or_else(|error| panic!("{error}"));
        Known {
            rate: recording.rate(),
            samples: recording.samples().to_vec(),
            name,
            trips,
        }
    };
    files.into_iter().map(read).collect()
}

#[test]
fn real_rides_are_found_where_they_are_stated() {
    for recording in real() {
        let found = recording.detect(&Settings::default());
        let worst = recording.worst(&found.trips);
        let worst = worst.unwrap_or_else(|why| panic!("{}: {why}", recording.name));
        println!(
            "{:40} {} rides, within {worst:.2} s",
            recording.name,
            recording.trips.len()
        );
        let distance = recording.worst_distance(&found);
        assert!(distance <= 1.0, "{}: {distance}", recording.name);
        assert_eq!(
            found.filter.time_constant().is_some(),
            recording.name.contains("highpassed"),
            "{}",
            recording.name
        );
        assert_eq!(found.undecided, [], "{}", recording.name);
    }
}

/// The rate of decisions for motion at rest, at two levels.
#[test]
fn false_alarms_on_real_rest_are_counted() {
    for alpha in [0.01, 0.001] {
        let mut settings = Settings::default();
        settings.detector.alpha = alpha;
        for recording in real() {
            let at_rest = recording.detect(&settings).at_rest;
            println!(
                "alpha {alpha}: {:40} {:4} of {:4} decisions",
                recording.name, at_rest.false_alarms, at_rest.decisions
            );
            assert!(at_rest.false_alarms <= at_rest.decisions);
        }
    }
}

/// A setting with the values tried.
struct Choice {
    name: &'static str,
    values: Vec<f64>,
    set: fn(&mut Settings, f64),
}

/// The settings that decide which trips are found.
fn choices() -> Vec<Choice> {
    vec![
        Choice {
            name: "block",
            values: vec![0.02, 0.03, 0.04, 0.05, 0.06, 0.08, 0.1, 0.15],
            set: |settings, value| settings.monitor.block = value,
        },
        Choice {
            name: "least_speed",
            values: vec![0.1, 0.14, 0.2, 0.25, 0.3, 0.4],
            set: |settings, value| settings.monitor.least_speed = value,
        },
        Choice {
            name: "most_acceleration",
            values: vec![1.5, 2.0, 2.5, 3.0, 4.0],
            set: |settings, value| settings.monitor.most_acceleration = value,
        },
    ]
}

impl Choice {
    /// For each value and recording, whether the trips are as stated.
    fn table(&self, known: &[Known]) -> Vec<Vec<bool>> {
        let judged = |value: &f64| {
            let mut settings = Settings::default();
            (self.set)(&mut settings, *value);
            let agrees =
                |recording: &Known| recording.worst(&recording.detect(&settings).trips).is_ok();
            known.iter().map(agrees).collect()
        };
        self.values.iter().map(judged).collect()
    }

    /// The middle of the longest run of values at which all recordings agree but those of the lift left out.
    fn chosen_without(&self, table: &[Vec<bool>], is_left_out: &[bool]) -> Option<usize> {
        let agree = |row: &Vec<bool>| {
            row.iter()
                .zip(is_left_out)
                .all(|(agrees, out)| *agrees || *out)
        };
        let places: Vec<usize> = (0..table.len()).collect();
        let runs = places.chunk_by(|a, b| agree(&table[*a]) == agree(&table[*b]));
        let good = runs.filter(|run| agree(&table[run[0]]));
        let longest = good.max_by_key(|run| run.len())?;
        Some(longest[(longest.len() - 1) / 2])
    }
}

/// The lift of a file: the word before the first `_` of its name, within its folder.
fn lift(name: &str) -> &str {
    name.rsplit('/')
        .next()
        .and_then(|file| file.split('_').next())
        .unwrap_or(name)
}

/// Cross-validation of each setting, with the others at their defaults: the values at which all recordings agree, and
/// whether the middle of those at which all lifts but one agree is right for that one too.
#[test]
fn settings_chosen_on_all_but_one_lift_hold_on_that_one() {
    let known = real();
    let mut lifts: Vec<&str> = known
        .iter()
        .map(|recording| lift(&recording.name))
        .collect();
    lifts.dedup();
    let (mut held, mut tried) = (0, 0);
    for choice in choices().into_iter().filter(|_| !known.is_empty()) {
        let table = choice.table(&known);
        let rows = choice.values.iter().zip(&table);
        let all = rows.filter(|(_, row)| row.iter().all(|agrees| *agrees));
        let all: Vec<f64> = all.map(|(value, _)| *value).collect();
        println!(
            "{:20} of {:?}\n{:20} all agree at {all:?}",
            choice.name, choice.values, ""
        );
        for out in &lifts {
            let is_out: Vec<bool> = known
                .iter()
                .map(|recording| lift(&recording.name) == *out)
                .collect();
            let place = choice.chosen_without(&table, &is_out);
            let is_right = |place: usize| {
                table[place]
                    .iter()
                    .zip(&is_out)
                    .all(|(agrees, out)| *agrees || !out)
            };
            let holds = place.is_some_and(is_right);
            tried += 1;
            held += u32::from(holds);
            if !holds {
                let value = place.map(|place| choice.values[place]);
                println!("{:20} chosen without {out}: {value:?} fails there", "");
            }
        }
    }
    println!("{held} of {tried} choices hold on the lift left out");
    assert_eq!(held, tried);
}

/// A lift, a sensor and a rate.
struct Case {
    name: &'static str,
    rate: f64,
    drive: Drive,
    pickup: Pickup,
}

fn cases() -> Vec<Case> {
    let quiet = Pickup {
        vibration: 2.0,
        ..Pickup::white(0.012)
    };
    let fast = Drive {
        speed: 4.0,
        acceleration: 1.0,
        jerk: 1.0,
    };
    let case = |name, rate, drive, pickup| Case {
        name,
        rate,
        drive,
        pickup,
    };
    let with_step = |sigma: f64, step: f64| Pickup {
        digitiser: Digitiser::new(Some(step / sigma), None).unwrap(),
        ..Pickup::white(sigma)
    };
    vec![
        case("a phone at 100 Hz", 100.0, Drive::slow(), quiet.clone()),
        case("at 25 Hz", 25.0, Drive::slow(), quiet.clone()),
        case("at 400 Hz", 400.0, Drive::slow(), quiet.clone()),
        case("a fast lift", 100.0, fast, quiet.clone()),
        case(
            "smooth motion",
            100.0,
            Drive::slow(),
            Pickup {
                vibration: 0.0,
                ..quiet.clone()
            },
        ),
        case(
            "rough motion",
            100.0,
            Drive::slow(),
            Pickup {
                vibration: 6.0,
                ..quiet.clone()
            },
        ),
        case(
            "gravity in it",
            100.0,
            fast,
            Pickup {
                bias: 9.81,
                ..quiet.clone()
            },
        ),
        case("steps of 0.1 m/s^2", 100.0, fast, with_step(0.03, 0.1)),
        case(
            "the paper's sensor",
            200.0,
            Drive::slow(),
            Pickup {
                sensor: Sensor::adxl105(),
                ..Pickup::white(0.02)
            },
        ),
        case(
            "heavy tails",
            100.0,
            Drive::slow(),
            Pickup {
                noise: Noise::new(Law::Laplace).unwrap(),
                ..quiet
            },
        ),
    ]
}

/// An up ride and a down ride.
fn simulated(case: &Case) -> Known {
    let trip = |distance| SimulatedTrip {
        distance,
        drive: case.drive,
        ending: Ending::Commanded,
    };
    let height = 8.0 * case.drive.speed;
    let ride = Simulation::new(
        case.rate,
        vec![8.0, 6.0, 5.0],
        vec![trip(height), trip(-height)],
    );
    let simulated = ride.unwrap().simulate(&case.pickup, 2014, 0);
    let time = |i: usize| i as f64 / case.rate;
    let stated = |journey: &Journey| Stated {
        start: Some(journey.start),
        levelling: None,
        stop: Some(journey.stop),
        direction: if journey.direction > 0 {
            Direction::Up
        } else {
            Direction::Down
        },
        tolerance: TOLERANCE,
        distance: None,
    };
    Known {
        name: case.name.to_owned(),
        rate: case.rate,
        samples: (simulated.record.iter().enumerate())
            .map(|(i, acceleration)| Sample {
                time: time(i),
                acceleration: *acceleration,
            })
            .collect(),
        trips: simulated.journeys.iter().map(stated).collect(),
    }
}

#[test]
fn simulated_rides_are_found_where_they_are() {
    for case in cases() {
        let known = simulated(&case);
        let found = known.detect(&Settings::default());
        let worst = known
            .worst(&found.trips)
            .unwrap_or_else(|why| panic!("{}: {why}", case.name));
        println!("{:25} within {worst:.2} s", case.name);
        assert_eq!(found.filter.time_constant(), None, "{}", case.name);
    }
}

/// A phone that removes gravity by a high-pass filter with a time constant of 1 s: the record is restored.
#[test]
fn high_passed_rides_are_restored() {
    let mut known = simulated(&cases()[0]);
    let keep = 1.0 - 1.0 / known.rate;
    let (mut before, mut passed) = (0.0, 0.0);
    for sample in &mut known.samples {
        passed = keep * (passed + sample.acceleration - before);
        before = sample.acceleration;
        sample.acceleration = passed;
    }
    let found = known.detect(&Settings::default());
    let time_constant = found.filter.time_constant().expect("it is noticed");
    assert!((0.6..1.6).contains(&time_constant), "{time_constant}");
    known.worst(&found.trips).unwrap();
}

/// What detection says of a record backwards is what it says of it forwards, backwards: it sees both sides of every
/// moment alike.
#[test]
fn a_record_reversed_has_its_trips_reversed() {
    for case in cases() {
        let mut known = simulated(&case);
        let forwards = known.detect(&Settings::default()).trips;
        let end = known.samples.last().unwrap().time;
        known.samples.reverse();
        known
            .samples
            .iter_mut()
            .for_each(|sample| sample.time = end - sample.time);
        let backwards = known.detect(&Settings::default()).trips;
        assert_eq!(forwards.len(), backwards.len(), "{}", case.name);
        for (one, other) in forwards.iter().zip(backwards.iter().rev()) {
            // Reversed in time, a cage that goes up goes down, and its acceleration has the same sign.
            assert_ne!(one.direction, other.direction, "{}", case.name);
            for (a, b) in [(one.start, other.stop), (one.stop, other.start)] {
                let distance = (a.unwrap() - (end - b.unwrap())).abs();
                assert!(distance < 0.15, "{}: {distance}", case.name);
            }
        }
    }
}

/// A monitor that knows that the cage stands at first reports the trips that detection finds in the whole record, each
/// where it is.
#[test]
fn the_monitor_and_detection_agree() {
    for case in cases() {
        let known = simulated(&case);
        let found = known.detect(&Settings::default());
        let knowledge = Knowledge {
            begins_at_rest: true,
            ..found.knowledge.clone()
        };
        let mut monitor = Monitor::new(found.design.clone(), knowledge);
        let said: Vec<Event> = (known.samples.iter())
            .flat_map(|sample| monitor.step(*sample, None).to_vec())
            .collect();
        assert!(said.iter().all(|event| event.time <= event.reported));
        let starts = said.iter().filter_map(|event| match event.kind {
            Kind::Change {
                state: State::Known(Phase::Accelerating),
                direction,
                ..
            } => Some((event.time, direction)),
            _ => None,
        });
        let starts: Vec<_> = starts.collect();
        assert_eq!(starts.len(), found.trips.len(), "{}: {starts:?}", case.name);
        let stated = known.trips.iter().filter_map(|trip| trip.start);
        for ((trip, stated), (start, direction)) in found.trips.iter().zip(stated).zip(starts) {
            let distance = start - stated;
            let is_near = distance.abs() < TOLERANCE;
            assert!(is_near, "{}: {distance} s", case.name);
            assert_eq!(Some(trip.direction), direction, "{}", case.name);
        }
    }
}

/// The seconds in which a monitor reported rest while the cage moved, later than `grace` s after a start.
fn misled(ride: &Simulation, record: &[f64], mut monitor: Monitor, grace: f64) -> f64 {
    let journeys = ride.journeys();
    let moves = |time: f64| {
        let inside = |journey: &Journey| journey.start + grace < time && time < journey.stop - 0.1;
        journeys.iter().any(inside)
    };
    let rest = State::REST;
    let wrong = record.iter().enumerate().filter(|(i, acceleration)| {
        let time = *i as f64 / ride.rate();
        monitor.step(
            Sample {
                time,
                acceleration: **acceleration,
            },
            None,
        );
        monitor.state() == rest && moves(time)
    });
    wrong.count() as f64 / ride.rate()
}

/// A sign, ±1, from a draw.
type Directions = fn(u64) -> f64;

/// Ten trips in given directions, with given lengths and rests.
fn journey(index: u64, direction: Directions) -> Simulation {
    let part =
        |i: u64, salt: u64| (index * 131 + i * 17 + salt).wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 40;
    let share = |i: u64, salt: u64| part(i, salt) as f64 / (1u64 << 24) as f64;
    let trips = (0..10).map(|i| SimulatedTrip {
        distance: direction(part(i, 1)) * (4.0 + 20.0 * share(i, 2)),
        drive: Drive {
            speed: 1.0,
            acceleration: 0.7,
            jerk: 1.0,
        },
        ending: Ending::Commanded,
    });
    let rests = (0..=10).map(|i| 4.0 + 12.0 * share(i, 3));
    Simulation::new(100.0, rests.collect(), trips.collect()).unwrap()
}

/// The worst error: rest reported while the cage moves. With smooth motion, as quiet as rest; for a monitor
/// without knowledge, and one that knows correctly that the cage stands at first.
#[test]
fn no_moving_cage_is_called_still() {
    let directions: [(&str, Directions); 3] = [
        ("up, always", |_| 1.0),
        ("either way", |draw| if draw % 2 == 0 { 1.0 } else { -1.0 }),
        ("down, always", |_| -1.0),
    ];
    for (name, direction) in directions {
        for begins_at_rest in [false, true] {
            let seconds: Vec<f64> = (0..60)
                .map(|index| {
                    let ride = journey(index, direction);
                    let record = ride.simulate(&Pickup::white(0.012), 2014, index).record;
                    let knowledge = Knowledge {
                        begins_at_rest,
                        ..Knowledge::default()
                    };
                    let monitor = Monitor::new(Settings::default().at(100.0).unwrap(), knowledge);
                    misled(&ride, &record, monitor, 2.0)
                })
                .collect();
            let worst = seconds.iter().copied().fold(0.0, f64::max);
            println!(
                "{name}, begins at rest {begins_at_rest}: at most {worst} s in one of 60 records of ten trips"
            );
            assert!(worst < 0.5, "{seconds:?}");
        }
    }
}

/// A record that begins in motion: what is told of it is true, or told to be undecided.
#[test]
fn a_record_that_begins_in_motion_is_not_read_upside_down() {
    let known = simulated(&cases()[0]);
    for cut in [10.0, 12.0, 14.0] {
        let samples = known.samples.iter().filter(|sample| sample.time > cut);
        let first = known.trips[0];
        assert!(first.start.unwrap() < cut && cut < first.stop.unwrap());
        let record = Known {
            name: String::new(),
            samples: samples.copied().collect(),
            trips: Vec::new(),
            rate: known.rate,
        };
        let found = record.detect(&Settings::default());
        assert!(!found.knowledge.begins_at_rest, "{cut}");
        for trip in &found.trips {
            let fits = |stated: &Stated| {
                let stop = (stated.stop.unwrap() - trip.stop.unwrap()).abs();
                stop < TOLERANCE && stated.direction == trip.direction
            };
            assert!(known.trips.iter().any(fits), "{trip:?}");
        }
    }
}

/// 1.6 m/s, then 0.3 m/s for the last 4 s: the trip ends when the cage stands, not when it creeps.
#[test]
fn a_levelling_lift_has_not_stopped() {
    let rate = 100.0;
    let pieces = [
        (8.0, 0.0),
        (2.0, 0.8),
        (6.0, 0.0),
        (1.625, -0.8),
        (4.0, 0.0),
        (0.6, -0.5),
        (8.0, 0.0),
    ];
    let stop: f64 = pieces[..6].iter().map(|piece| piece.0).sum();
    let still = Simulation::still(rate, stop + 8.0).unwrap();
    let mut record = still.simulate(&Pickup::white(0.012), 2014, 0).record;
    let mut from = 0.0;
    for (seconds, acceleration) in pieces {
        let range = (from * rate) as usize..((from + seconds) * rate) as usize;
        record[range].iter_mut().for_each(|a| *a += acceleration);
        from += seconds;
    }
    let samples = (0..).zip(record).map(|(i, acceleration)| Sample {
        time: f64::from(i) / rate,
        acceleration,
    });
    let known = Known {
        name: "levelling".to_owned(),
        rate,
        samples: samples.collect(),
        trips: vec![Stated {
            start: Some(8.0),
            levelling: Some(stop - 4.6),
            stop: Some(stop),
            direction: Direction::Up,
            tolerance: 0.3,
            distance: None,
        }],
    };
    let found = known.detect(&Settings::default());
    known.worst(&found.trips).unwrap();
}
