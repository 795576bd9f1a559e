//! Samples from standard input, for `monitor`: at the times of their lines, or one after the other at a rate.

use super::heartbeat::Heartbeat;
use super::monitor_options::check_strength;
use super::{Failure, warn};
use anyhow::{Context, anyhow};
use liftsim::monitor::SET_BACK;
use liftsim::recording::{LineReader, LineReading, Moment, Sample, StreamColumns};
use serde::{Deserialize, Serialize};
use std::io;
use std::time::{SystemTime, UNIX_EPOCH};

/// Readings from which a rate is measured.
const MEASURED: usize = 100;

/// By how much a measured rate may differ from a known one.
pub const UNEVEN: f64 = 0.05;

/// The largest time, s: no clock is later, and doubles still resolve milliseconds.
const LATEST: f64 = 1e12;

/// A sample, and whether the drum turns.
pub type Reading = (Sample, Option<bool>);

/// Samples from standard input.
pub struct Readings<'a, R> {
    lines: LineReader<R>,
    /// What is to know of every reading.
    heartbeat: Option<&'a Heartbeat>,
    /// Hz, where it is known.
    rate: Option<f64>,
    taken: Taken,
    /// The first intervals between samples with a time, s.
    intervals: Vec<f64>,
    keeps_going: bool,
}

/// How far a stream was read.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct Taken {
    /// When the last sample with a time was taken, s.
    last: Option<f64>,
    /// The samples without times so far.
    count: u64,
    /// How many lines were passed over since they came late, and how often the clock was set back.
    late: u64,
    set_back: u64,
    /// Whether it was left within a line.
    pub within_line: bool,
    /// When samples without times were left, by this machine's clock, s since 1970.
    left: Option<f64>,
}

/// How long samples without times are missing, where the clock of this machine has been set back, s.
const UNKNOWN: f64 = 10.0;

/// By the clock of this machine; 0 where that is older.
fn seconds_since_1970() -> f64 {
    let now = SystemTime::now().duration_since(UNIX_EPOCH);
    now.map_or(0.0, |now| now.as_secs_f64())
}

impl<'a, R: io::BufRead> Readings<'a, R> {
    pub fn new(lines: LineReader<R>, keeps_going: bool, heartbeat: Option<&'a Heartbeat>) -> Self {
        Self {
            lines,
            heartbeat,
            rate: None,
            taken: Taken::default(),
            intervals: Vec::new(),
            keeps_going,
        }
    }

    /// Goes on where another reader has stopped.
    pub fn go_on(&mut self, taken: Taken) {
        self.taken = Taken {
            within_line: false,
            ..taken
        };
    }

    /// How far it has read.
    pub fn taken(&self) -> Taken {
        Taken {
            left: (self.taken.count > 0).then(seconds_since_1970),
            ..self.taken
        }
    }

    /// Samples without times are missing for as long as nobody took any.
    fn pass_over(&mut self, rate: f64) {
        let Some(left) = self.taken.left.take() else {
            return;
        };
        let seconds = seconds_since_1970() - left;
        let seconds = if (0.0..LATEST).contains(&seconds) {
            seconds
        } else {
            UNKNOWN
        };
        let missing = (seconds * rate).ceil();
        self.taken.count += missing as u64;
        warn(format_args!(
            "standard input: readings have no times, and none was taken for {seconds:.1} s by this machine's clock: \
             {missing} are missing"
        ));
    }

    /// The columns of the stream, once its first line was read.
    pub fn columns(&self) -> Option<StreamColumns> {
        self.lines.columns()
    }

    /// The first readings, if there is any, and the rate: as known, or measured from as many as that takes.
    pub fn begin(&mut self, known: Option<f64>) -> Result<Option<(Vec<Reading>, f64)>, Failure> {
        self.rate = known;
        if let Some(rate) = known {
            self.pass_over(rate);
        }
        let wanted = if known.is_some() { 1 } else { MEASURED + 1 };
        let mut first: Vec<Reading> = Vec::new();
        while first.len() < wanted {
            match self.next()? {
                Some(reading) => first.push(reading),
                None => break,
            }
        }
        match (known.or(self.measured()), first.len()) {
            (_, 0) => Ok(None),
            (None, readings) => Err(Failure::Input(anyhow!(
                "standard input: {readings} reading, and the rate is measured from two or more (give --rate)"
            ))),
            (Some(rate), _) => Ok(Some((first, rate))),
        }
    }

    /// The moment of time 0, where the lines have dates.
    pub fn zero(&self) -> Option<Moment> {
        self.lines.zero()
    }

    /// Hz, by the median of the first intervals.
    fn measured(&self) -> Option<f64> {
        let mut intervals = self.intervals.clone();
        intervals.sort_by(f64::total_cmp);
        intervals
            .get(intervals.len() / 2)
            .map(|median| 1.0 / median)
    }

    /// Takes the time of a sample. Once there are enough, they must agree with the known rate.
    fn take_time(&mut self, time: f64) -> Result<(), Failure> {
        if let Some(last) = self.taken.last.replace(time)
            && time > last
            && self.intervals.len() < MEASURED
        {
            self.intervals.push(time - last);
            if self.intervals.len() == MEASURED
                && let (Some(rate), Some(measured)) = (self.rate, self.measured())
                && (measured / rate - 1.0).abs() > UNEVEN
            {
                return Err(Failure::Input(anyhow!(
                    "standard input: samples come at {measured:.1} Hz, and not at {rate:.1} Hz as --rate or the saved \
                     state says (leave --rate out where samples have times, or learn a state at this rate)"
                )));
            }
        }
        Ok(())
    }

    /// Says how often it happened what was warned of only once.
    pub fn say_counts(&self) {
        for (count, what) in [
            (
                self.taken.late,
                "lines whose time does not increase, passed over",
            ),
            (self.taken.set_back, "times that the clock was set back"),
        ] {
            if count > 1 {
                warn(format_args!("standard input: {what}: {count}"));
            }
        }
    }

    pub fn next(&mut self) -> Result<Option<Reading>, Failure> {
        loop {
            let late = self.taken.late;
            let refusal = match self.lines.next() {
                Ok(None) => return Ok(None),
                Ok(Some(reading)) => match self.timed(&reading)? {
                    Ok(sample) => {
                        if let Some(heartbeat) = self.heartbeat {
                            heartbeat.read(sample.time);
                        }
                        return Ok(Some((sample, reading.drum_turns)));
                    }
                    Err(refusal) => refusal,
                },
                Err(error) if error.is_io() => {
                    self.taken.within_line = true;
                    return Err(Failure::run(error));
                }
                Err(error) => anyhow::Error::from(error),
            };
            if !self.keeps_going {
                return Err(refusal)
                    .context("standard input")
                    .map_err(Failure::Input);
            }
            if late == 0 || self.taken.late == late {
                warn(format_args!("{refusal:#} (passed over)"));
            }
        }
    }

    /// A reading at its time, which must be later than that of the one before; or why it is skipped.
    #[inline]
    fn timed(&mut self, reading: &LineReading) -> Result<anyhow::Result<Sample>, Failure> {
        let acceleration = reading.acceleration;
        let line = self.lines.number();
        if let Err(refusal) = check_strength(acceleration) {
            return Ok(Err(refusal.context(format!("line {line}"))));
        }
        let Some(time) = reading.time else {
            let Some(rate) = self.rate else {
                return Err(Failure::Input(anyhow!(
                    "standard input: samples without times need a rate (give --rate)"
                )));
            };
            self.taken.count += 1;
            let time = (self.taken.count - 1) as f64 / rate;
            return Ok(Ok(Sample { time, acceleration }));
        };
        match self.taken.last {
            _ if time.abs() > LATEST => Ok(Err(anyhow!(
                "line {line}: times must lie within {LATEST:e} s, got {time:e} (give them in s)"
            ))),
            Some(last) if self.keeps_going && time < last - SET_BACK => {
                self.taken.set_back += 1;
                if self.taken.set_back == 1 {
                    warn(format_args!(
                        "standard input: line {line}: the clock was set back from {last} s to {time} s"
                    ));
                }
                self.take_time(time)?;
                Ok(Ok(Sample { time, acceleration }))
            }
            Some(last) if time <= last => {
                self.taken.late += 1;
                Ok(Err(anyhow!(
                    "line {line}: time must increase, got {time} s after {last} s (put lines in order, drop repeated \
                     ones, and write decimals with a point)"
                )))
            }
            _ => {
                self.take_time(time)?;
                Ok(Ok(Sample { time, acceleration }))
            }
        }
    }
}
