//! What is wrong with the sensor itself, judged by its samples.

use super::event::Fault;
use crate::recording::Sample;
use serde::{Deserialize, Serialize};

/// A repeated value is suspicious for at least this long, s, and this many times as long as any run before.
const STUCK: f64 = 1.0;
const LONGER: f64 = 4.0;
/// Fewer equal samples say nothing.
const FEW: u32 = 8;

/// How a sensor repeats itself is known after so many changes of its value.
const PROVEN: u32 = 10;

/// As many samples between equal ones that differ by more than this many steps of the sensor are a glitch. A dead sensor
/// has them, too: they are no change of its value. One step up or down is how a coarse sensor shows noise.
const GLITCH: usize = 2;
const STEPS_OF_GLITCH: f64 = 1.5;

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
    /// The samples that are equal to the last, and those that are so but for glitches.
    equal: Run,
    held: Run,
    /// The latest samples, if they are off the value, and no more than a glitch has.
    strays: Vec<Sample>,
    /// How many were equal since the last stray.
    in_a_row: u32,
    /// The smallest change from a sample to the next, m/s².
    step: f64,
    /// How often the value that is held has changed.
    changes: u32,
    /// A slow mean, m/s².
    middle: f64,
    fault: Option<Fault>,
}

/// Equal samples.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
struct Run {
    /// m/s²
    value: f64,
    /// The first and the last, s.
    since: f64,
    until: f64,
    count: u32,
    /// How long the longest before was, s.
    longest: f64,
}

impl Run {
    /// Goes on with a sample, or begins anew: at the first sample, or if it differs; whether the one that ends counts.
    fn take(&mut self, sample: Sample, is_first: bool, counts: bool) {
        if is_first || sample.acceleration != self.value {
            if counts && !is_first {
                self.longest = self.longest.max(self.until - self.since);
            }
            (self.value, self.since, self.count) = (sample.acceleration, sample.time, 0);
        }
        self.until = sample.time;
        self.count += 1;
    }

    /// Whether it is too long for a live sensor.
    fn is_dead(&self, now: f64) -> bool {
        self.count >= FEW && now - self.since > STUCK.max(LONGER * self.longest)
    }
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
            equal: Run::default(),
            held: Run::default(),
            strays: Vec::with_capacity(GLITCH + 1),
            in_a_row: 0,
            step: f64::INFINITY,
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
        if let Some(last) = self.last {
            let times = ((sample.time - last.time) / self.period).clamp(0.0, SLOW.3);
            self.slowness += (times - self.slowness) / SLOW.2;
            let change = (sample.acceleration - last.acceleration).abs();
            if change > 0.0 {
                self.step = self.step.min(change);
            }
        }
        self.equal
            .take(sample, self.last.is_none(), self.is_trusted());
        self.compare(sample);
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
                    Fault::Stuck if self.held.is_dead(sample.time) => (fault, self.held.since),
                    _ => (fault, self.equal.since),
                }),
            ends: was.is_some() && self.fault.is_none(),
            is_proven: self.is_proven(),
        }
    }

    /// Compares a sample with the value that is repeated.
    fn compare(&mut self, sample: Sample) {
        if self.last.is_none() {
            return self.held.take(sample, true, false);
        }
        let is_back = sample.acceleration == self.held.value;
        if !is_back {
            self.strays.push(sample);
            if self.strays.len() <= GLITCH {
                return;
            }
        }
        if !(is_back && self.are_glitches()) {
            // Where the value is soon back after it was repeated for long, it shows no life: a glitch may be a step, too.
            let lives = !is_back || self.in_a_row < FEW;
            for at in 0..self.strays.len() {
                self.take(self.strays[at], lives);
            }
        }
        let goes_on = is_back && self.strays.is_empty();
        self.in_a_row = if goes_on { self.in_a_row + 1 } else { 1 };
        self.strays.clear();
        if is_back {
            self.take(sample, false);
        }
    }

    /// Whether the samples off the value are nothing else, now that it is back.
    fn are_glitches(&self) -> bool {
        let least = STEPS_OF_GLITCH * self.step;
        let is_far = |it: &Sample| (it.acceleration - self.held.value).abs() > least;
        self.strays.iter().all(is_far)
    }

    /// Takes a sample that is no glitch, and may show that the sensor lives.
    fn take(&mut self, sample: Sample, lives: bool) {
        if lives && sample.acceleration != self.held.value {
            self.changes = self.changes.saturating_add(1);
            self.middle += (self.held.value - self.middle) / f64::from(self.changes.min(1000));
        }
        self.held.take(sample, false, self.is_trusted());
    }

    /// Whether a run counts that ends now. One that was called stuck may as well be that of a coarse sensor at rest for as
    /// long as not much is known of it.
    fn is_trusted(&self) -> bool {
        self.fault.is_none() || !self.is_proven()
    }

    fn judge(&self, sample: Sample) -> Option<Fault> {
        let far = (sample.acceleration - self.middle).abs();
        if self.equal.count >= SATURATED.0 && far > SATURATED.1 && self.changes > 0 {
            return Some(Fault::Saturated);
        }
        if [self.equal, self.held]
            .iter()
            .any(|run| run.is_dead(sample.time))
        {
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
        self.strays.clear();
        self.in_a_row = 0;
        (self.equal.count, self.held.count) = (0, 0);
        self.fault = None;
    }
}
