//! The report of `liftsim detect`: JSON has all of it, CSV and the table have the trips, under the same names.

#![allow(missing_docs, reason = "what a name says is not said again")]

use super::{AtRest, Detection, Event, Trip, Undecided, What, columns};
use crate::explain::SensorFilter;
use crate::monitor::{Knowledge, Settings};
use crate::recording::{GRAVITY, Moment, Recording};
use serde::Serialize;
use serde_json::Value;

/// A recording and its detection.
#[derive(Debug, Serialize)]
pub struct DetectReport<'a> {
    pub recording: Recorded,
    pub warnings: Vec<String>,
    pub settings: &'a Settings,
    /// Length of a block at the rate of the recording, s.
    pub block: f64,
    pub knowledge: &'a Knowledge,
    pub at_rest: &'a AtRest,
    pub rides: &'a [Trip],
    /// Stretches with two explanations that are close.
    pub undecided: &'a [Undecided],
    /// What moved the sensor and is no ride.
    pub events: &'a [Event],
}

/// How a recording was read.
#[derive(Debug, Serialize)]
pub struct Recorded {
    pub file: String,
    pub format: String,
    /// The column.
    pub time: String,
    #[serde(skip)]
    pub time_unit: String,
    /// The columns.
    pub acceleration: Vec<String>,
    pub unit: String,
    pub vertical: String,
    pub samples: u64,
    /// s
    pub start: f64,
    /// s
    pub end: f64,
    /// Hz
    pub rate: f64,
    pub jitter: f64,
    pub quantum: Option<f64>,
    /// Samples that are missing between the first and the last.
    pub missing: u64,
    /// The same, of all that there would be.
    pub missing_share: f64,
    /// Whether more may be: the clock is too uneven to show each.
    pub more_may_be_missing: bool,
    /// Times without samples.
    pub gaps: u64,
    /// The longest time between two samples, s.
    pub longest_interval: f64,
    pub has_gravity: bool,
    /// Whether the record, the user or a barometer says which way is up.
    #[serde(skip)]
    pub is_up_known: bool,
    /// Subtracted from the times of the file, s.
    pub clock_offset: Option<f64>,
    /// The moment of time 0, where the file has dates.
    pub clock_zero: Option<Moment>,
    /// What times count from, where that is not the zero of the file.
    #[serde(skip)]
    pub counts_from: Option<String>,
    /// The time constant of its high-pass filter, s, if it has one: the record was restored.
    pub high_pass: Option<f64>,
    /// Whether that filter was looked for.
    #[serde(skip)]
    pub is_filter_sought: bool,
}

impl Recorded {
    /// A recording called `file`.
    pub fn of(file: String, recording: &Recording, detection: &Detection) -> Self {
        let facts = recording.facts();
        let (time, time_unit) = recording.time_column();
        Self {
            file,
            format: recording.format().to_string(),
            time: time.to_owned(),
            time_unit: time_unit.to_string(),
            acceleration: recording.acceleration_columns().to_vec(),
            unit: recording.unit().to_string(),
            vertical: recording.vertical().to_string(),
            samples: facts.samples,
            start: facts.start,
            end: facts.end,
            rate: facts.rate,
            jitter: facts.jitter,
            quantum: facts.quantum,
            missing: facts.missing,
            missing_share: facts.missing_share(),
            more_may_be_missing: facts.may_lack_more(),
            gaps: facts.gaps,
            longest_interval: facts.longest_gap.length,
            has_gravity: facts.has_gravity,
            is_up_known: recording.vertical().is_sign_known,
            clock_offset: facts.clock_offset,
            clock_zero: facts.clock_zero,
            counts_from: facts.counts_from(),
            high_pass: detection.filter.time_constant(),
            is_filter_sought: detection.filter != SensorFilter::NotSought,
        }
    }
}

/// A reason to distrust the trips.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Warning {
    #[error(
        "the sensor is behind a high-pass filter with a time constant of about {0:.2} s: the record was restored, \
         so speeds are rough (record the raw accelerometer, with g)"
    )]
    HighPass(f64),
    #[error(
        "the state was learnt at {learnt:.1} Hz, this recording has {got:.1} Hz (use --resample {learnt:.1})"
    )]
    Rate { learnt: f64, got: f64 },
    #[error(
        "rest reads {level:.3} m/s^2, neither 0 nor the 9.8 of gravity (check the unit: --unit g, mg, or counts \
         with --scale{})",
        perhaps_tilted(*.level)
    )]
    Level { level: f64 },
    #[error(
        "too little rest to learn from: the decisions were not made (record a few seconds of rest before or \
         after the ride)"
    )]
    NoRest,
    #[error(
        "the sensor is shaken for {0:.0} % of the time, which would hide a ride (lay it on the floor of the lift)"
    )]
    Shaken(f64),
    #[error(
        "a motion of {speed:.3} m/s from {from:.1} to {to:.1} s is slower than a ride, {least} m/s ({remedy})"
    )]
    Slow {
        speed: f64,
        from: f64,
        to: f64,
        least: f64,
        remedy: &'static str,
    },
    #[error(
        "ride {ride}: its speed changes for {seconds:.0} s from {from:.1} s on, longer than that of most lifts, as if the \
         sensor had been turned (if it was, leave the ride out with {flag} {time:.1})"
    )]
    Long {
        ride: usize,
        from: f64,
        seconds: f64,
        flag: &'static str,
        time: f64,
    },
    #[error(
        "the record does not look as if it began {0}, as --begins says (leave out --begins to see what it says itself)"
    )]
    Contradicted(&'static str),
    #[error(
        "{count} samples that no shock explains, the first at {first:.2} s, were replaced by what their neighbours \
         read (look at the sensor's cable and supply)"
    )]
    Glitches { count: usize, first: f64 },
    #[error(
        "too much moves the sensor to see whether it removes slow acceleration, as many phones do (choose a part of \
         the record with quiet rides by --from and --to)"
    )]
    Busy,
    #[error("{0} more stretches are undecided (--json lists them)")]
    MoreUndecided(usize),
    #[error("from {from:.1} to {to:.1} s the record does not decide{because} ({advice})")]
    Undecided {
        from: f64,
        to: f64,
        because: &'static str,
        advice: &'static str,
    },
}

impl<'a> DetectReport<'a> {
    /// The report on a recording called `file`.
    pub fn new(file: String, recording: &Recording, detection: &'a Detection) -> Self {
        let of_recording = recording.warnings().iter().map(ToString::to_string);
        let of_detection = detection.warnings(recording.rate());
        Self {
            warnings: of_recording
                .chain(of_detection.iter().map(ToString::to_string))
                .collect(),
            recording: Recorded::of(file, recording, detection),
            settings: &detection.design.settings,
            block: detection.design.block,
            knowledge: &detection.knowledge,
            at_rest: &detection.at_rest,
            rides: &detection.trips,
            undecided: &detection.undecided,
            events: &detection.events,
        }
    }

    pub fn json(&self) -> String {
        let json = serde_json::to_string_pretty(self);
        json.expect("a report is plain data") + "\n"
    }

    /// The names of the columns of [`DetectReport::rows`].
    pub fn columns(&self) -> Vec<String> {
        [columns(), vec!["alpha".to_owned()]].concat()
    }

    /// A row for every trip.
    pub fn rows(&self) -> Vec<Vec<String>> {
        let columns = columns();
        let alpha = self.settings.detector.alpha.to_string();
        let row = |trip: &Trip| {
            let cells = columns.iter().map(|name| cell(&trip.column(name)));
            cells.chain([alpha.clone()]).collect()
        };
        self.rides.iter().map(row).collect()
    }
}

/// A value as a cell of CSV.
pub fn cell(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        value => value.to_string(),
    }
}

impl Detection {
    /// The share of the time in which something that is no ride moves the sensor.
    fn shaken(&self) -> f64 {
        let shakes = self
            .events
            .iter()
            .filter(|event| matches!(event.what, What::Shock | What::Swing));
        let moved: f64 = shakes.map(|event| event.to - event.from).sum();
        let columns = self.trace.columns();
        let ends = columns.first().zip(columns.last());
        ends.map_or(0.0, |(first, last)| moved / (last.times.1 - first.times.0))
    }

    /// What shows slower motions as rides.
    fn remedy_for_slow(&self) -> &'static str {
        if self.has_state {
            "leave out --state and use --lift slow, or save another state with it"
        } else if self.design.settings.monitor.least_speed > SLOW {
            "use --lift slow, or a lower --least-speed"
        } else {
            "use a lower --least-speed"
        }
    }

    /// The warnings for a recording with this rate, Hz.
    pub fn warnings(&self, rate: f64) -> Vec<Warning> {
        let (learnt, shaken) = (self.design.rate, self.shaken());
        let level = self.knowledge.reference.as_ref().map(|rest| rest.level);
        let slow = self
            .events
            .iter()
            .filter(|event| event.what == What::SlowMotion);
        let slow = slow.map(|event| Warning::Slow {
            speed: event.speed.abs(),
            from: event.from,
            to: event.to,
            least: self.design.settings.monitor.least_speed,
            remedy: self.remedy_for_slow(),
        });
        let long = self.trips.iter().flat_map(Trip::long_changes);
        let more = self.undecided.len().saturating_sub(MOST_SAID);
        let undecided = self
            .undecided
            .iter()
            .take(MOST_SAID)
            .map(|it| Warning::Undecided {
                from: it.from,
                to: it.to,
                because: it.because(),
                advice: it.advice(),
            });
        [
            self.filter.time_constant().map(Warning::HighPass),
            (self.filter == SensorFilter::NotSought).then_some(Warning::Busy),
            ((rate / learnt - 1.0).abs() > 0.05).then_some(Warning::Rate { learnt, got: rate }),
            level
                .filter(|level| !is_level_of_rest(*level))
                .map(|level| Warning::Level { level }),
            level.is_none().then_some(Warning::NoRest),
            self.contradicted.map(|at_rest| {
                Warning::Contradicted(if at_rest { "at rest" } else { "in motion" })
            }),
            self.glitches.first().map(|&first| Warning::Glitches {
                count: self.glitches.len(),
                first,
            }),
            (shaken > MOST_SHAKEN).then_some(Warning::Shaken(100.0 * shaken)),
        ]
        .into_iter()
        .flatten()
        .chain(slow)
        .chain(long)
        .chain(undecided)
        .chain((more > 0).then_some(Warning::MoreUndecided(more)))
        .collect()
    }
}

impl Trip {
    /// Warnings about its changes of speed that last as if the sensor had been turned.
    fn long_changes(&self) -> impl Iterator<Item = Warning> {
        let changes = [
            (self.start, self.inertial),
            (self.braking, self.levelling.or(self.stop)),
        ];
        let changes = changes.into_iter().filter_map(|(from, to)| from.zip(to));
        changes.filter_map(|(from, to)| {
            let seconds = to - from;
            let is_long = seconds > LONG.0 && self.speed > LONG.1 * seconds;
            let (flag, time) = self.stop.map_or(("--to", from), |stop| ("--from", stop));
            is_long.then_some(Warning::Long {
                ride: self.ride,
                from,
                seconds,
                flag,
                time,
            })
        })
    }
}

/// A change of speed is long from so many seconds on, where it is no softer than this, m/s².
const LONG: (f64, f64) = (9.0, 0.1);

/// The slowest motion of a slow lift, m/s: `--lift slow`.
pub const SLOW: f64 = 0.06;

/// The most undecided stretches that are warned of one by one.
const MOST_SAID: usize = 8;

/// A record shaken for a larger share of the time shows little.
const MOST_SHAKEN: f64 = 0.5;

/// Tilted, a sensor reads less than gravity along an axis, and never more.
fn perhaps_tilted(level: f64) -> &'static str {
    if level.abs() < GRAVITY {
        "; or the sensor is tilted: lay it flat, or let all three axes be read"
    } else {
        ""
    }
}

/// Whether a level of rest, m/s², is near 0 or gravity, up to the sensor's offset.
fn is_level_of_rest(level: f64) -> bool {
    const OFFSET: f64 = 1.5;
    level.abs() < OFFSET || (level.abs() - 9.81).abs() < OFFSET
}
