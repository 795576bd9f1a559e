//! What is wrong with the sensor itself, judged by its samples.

use super::event::Fault;
use crate::recording::Sample;
use serde::{Deserialize, Serialize};

/// A repeated value is suspicious for at least this long, s, and this many times as long as any run before.
const STUCK: f64 = 1.0;
const LONGER: f64 = 4.0;

/// How a sensor repeats itself is known after so many changes of its value.
const PROVEN: u32 = 10;

/// A value far from the median that comes so often in a row is the end of the range, m/s².
const SATURATED: (u32, f64) = (3, 12.0);

/// Times further back than this are those of a clock that was set back, s.
pub const SET_BACK: f64 = 1.0;

/// Samples are too rare to be read as before where the time between them is longer by this, and no longer where by this;
/// it is a running mean over so many samples, of which none counts for more than the last.
const SLOW: (f64, f64, f64, f64) = (6.0, 5.0, 10.0, 20.0);

/// What the samples have shown.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Sensor {
    /// The time between samples as it should be, s, and the mean of it as it is, in that.
    period: f64,
    slowness: f64,
    last: Option<Sample>,
    /// Since when the value is repeated, s, and how often.
    since: f64,
    repeats: u32,
    /// The longest run before, s, and how many changes there were.
    longest: f64,
    changes: u32,
    /// A slow mean, m/s².
    middle: f64,
    fault: Option<Fault>,
}

/// What a sample says of its sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Health {
    /// What is wrong now.
    pub fault: Option<Fault>,
    /// What has begun to be wrong, and since when, s.
    pub begins: Option<(Fault, f64)>,
    /// Whether something wrong has just ended that had begun at a time, s.
    pub ends: bool,
    /// Whether it has changed often enough to be told from one that is stuck from its first sample.
    pub is_proven: bool,
}

impl Sensor {
    /// One that sends a sample every so many seconds.
    pub fn new(period: f64) -> Self {
        Self {
            period,
            slowness: 1.0,
            last: None,
            since: 0.0,
            repeats: 0,
            longest: 0.0,
            changes: 0,
            middle: 0.0,
            fault: None,
        }
    }

    /// Whether a time is earlier than one before: by a lot, so that the clock was set back.
    pub fn is_set_back(&self, time: f64) -> bool {
        self.last.is_some_and(|last| time < last.time - SET_BACK)
    }

    /// Takes a sample.
    #[inline]
    pub fn step(&mut self, sample: Sample) -> Health {
        let is_repeated = self
            .last
            .is_some_and(|last| last.acceleration == sample.acceleration);
        if let Some(last) = self.last {
            let times = ((sample.time - last.time) / self.period).clamp(0.0, SLOW.3);
            self.slowness += (times - self.slowness) / SLOW.2;
        }
        if !is_repeated {
            if let Some(last) = self.last {
                // Until then a long run may as well be that of a coarse sensor at rest.
                if self.fault.is_none() || !self.is_proven() {
                    self.longest = self.longest.max(last.time - self.since);
                }
                self.changes = self.changes.saturating_add(1);
                self.middle +=
                    (last.acceleration - self.middle) / f64::from(self.changes.min(1000));
            }
            self.since = sample.time;
            self.repeats = 0;
        }
        self.repeats += 1;
        self.last = Some(sample);
        let was = self.fault;
        self.fault = self.judge(sample);
        Health {
            fault: self.fault,
            begins: self
                .fault
                .filter(|_| self.fault != was)
                .map(|fault| match fault {
                    Fault::Slow => (fault, sample.time),
                    _ => (fault, self.since),
                }),
            ends: was.is_some() && self.fault.is_none(),
            is_proven: self.is_proven(),
        }
    }

    fn judge(&self, sample: Sample) -> Option<Fault> {
        let lasts = sample.time - self.since;
        let far = (sample.acceleration - self.middle).abs();
        if self.repeats >= SATURATED.0 && far > SATURATED.1 && self.changes > 0 {
            return Some(Fault::Saturated);
        }
        if self.repeats >= 8 && lasts > STUCK.max(LONGER * self.longest) {
            return Some(Fault::Stuck);
        }
        let most = if self.fault == Some(Fault::Slow) {
            SLOW.1
        } else {
            SLOW.0
        };
        (self.slowness > most).then_some(Fault::Slow)
    }

    fn is_proven(&self) -> bool {
        self.changes >= PROVEN
    }

    /// Forgets the time, not the scatter.
    pub fn cross(&mut self) {
        self.last = None;
        self.repeats = 0;
        self.fault = None;
    }
}
