//! What leaves a level: pulses as they happen.

use super::noise::Noises;
use super::prices::Known;
use super::recent::Smooth;
use crate::explain::{Pulse, Turned, is_at_once};
use serde::{Deserialize, Serialize};

/// The least and the greatest distance from the level that is a pulse, m/s²: of the smoothed record, and of the
/// mean of a longer time, which shows soft starts; and in standard deviations.
pub(super) const FAST: (f64, f64, f64) = (0.02, 0.25, 2.5);
const SLOW: (f64, f64, f64) = (0.02, 0.12, 3.5);

/// How far a pulse reaches beyond the point where it falls into the noise, s.
pub(super) const FOOT: f64 = 0.3;

/// A pulse begins where the smoothed record leaves this share of that.
const ONSET: f64 = 0.3;

/// A pulse that has lasted so long, s, and is weaker than a usual start times the last, ends where it grows by the
/// factor between: another begins.
const WEAK: (f64, f64, f64) = (1.0, 3.0, 1.2);

/// The smallest change of speed, m/s, and in deviations.
const LEAST_CHANGE: f64 = 0.015;
const LEAST_DEVIATIONS: f64 = 3.0;

/// A pulse ends where it falls to this share of its largest value: what remains is a shift of the level.
const PLATEAU: f64 = 0.15;

/// A shock that comes so long after the beginning of a pulse is another, s.
const BEFORE_SHOCK: f64 = 0.3;

/// What goes on so long after a shock is another pulse, s.
const AFTER_SHOCK: f64 = 0.25;

/// The longest shock, s.
const LONGEST_SHOCK: f64 = 0.8;

/// What a shock adds to the uncertainty of a change of speed, for each m/s² of it, s.
const SHOCK_ERROR: f64 = 0.03;

/// Uncertainty of the level, m/s².
const LEVEL_ERROR: f64 = 0.004;

/// Some of what has left the level.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(super) struct Part {
    pub from: f64,
    to: f64,
    change: f64,
    pub seconds: f64,
    peak: f64,
}

/// A change at once.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(super) struct Jump {
    /// m/s², away from the level.
    pub by: f64,
    /// s
    pub at: f64,
    /// What was before it.
    pub before: Part,
}

/// What has left the level so far.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(super) struct Excursion {
    pub part: Part,
    /// How long ago its shock was, s.
    since_shock: f64,
    /// The largest change at once.
    pub jump: Jump,
    /// The largest towards the level, m/s², and when, s.
    jump_back: (f64, f64),
    /// The largest smoothed value.
    most: f64,
    is_up: bool,
    /// Whether it is a pulse.
    pub is_pulse: bool,
    /// Whether it was ever seen in the smoothed record.
    is_strong: bool,
    /// How long it has been within the noise, s.
    foot: f64,
    /// Another level that has been tried instead of it.
    pub instead: Option<f64>,
}

/// The least distances from a level that are a pulse, m/s²: of the smoothed record, and of the mean of a longer time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Least {
    pub fast: f64,
    pub slow: f64,
}

impl Part {
    fn at(time: f64) -> Self {
        Self {
            from: time,
            to: time,
            ..Self::default()
        }
    }
}

impl Least {
    pub fn of(noise: Noises) -> Self {
        let least =
            |noise: f64, (least, most, times): (f64, f64, f64)| (times * noise).clamp(least, most);
        Self {
            fast: least(noise.fast, FAST),
            slow: least(noise.slow, SLOW),
        }
    }
}

impl Excursion {
    /// The one that follows, at a time, s, with what has just changed at once.
    pub fn next(&self, now: f64) -> Self {
        let (by, at) = self.jump_back;
        let before = Part::at(now);
        let jump = Some(Jump { by, at, before }).filter(|_| at > now - FOOT);
        Self {
            is_up: !self.is_up,
            part: before,
            jump: jump.unwrap_or_default(),
            ..Self::default()
        }
    }

    /// One of which this much has been seen, if anything.
    pub fn of(part: Part) -> Self {
        let is_pulse = part.change.abs() > LEAST_CHANGE;
        Self {
            part,
            is_pulse,
            is_strong: is_pulse,
            ..Self::default()
        }
    }

    /// Adds a block before it can be said whether it goes on.
    pub fn gather(&mut self, known: &Known, off: &Smooth) {
        self.sum(known, off);
        self.part.to = off.to;
        self.is_up = self.part.change > 0.0;
    }

    /// Whether another begins with a block, whose distance from the level this is.
    pub fn is_followed(&self, known: &Known, off: &Smooth, least: Least) -> bool {
        let Part {
            seconds,
            change,
            peak,
            ..
        } = self.part;
        let grows =
            off.fast.abs() > 1.5 * least.fast && off.fast.abs() * seconds > WEAK.1 * change.abs();
        let most = known.prior.most_acceleration;
        let begins_shock = off.mean.abs() > most && peak < most && seconds > BEFORE_SHOCK;
        let is_weak = seconds > WEAK.0 && change.abs() < WEAK.2 * known.soft * seconds;
        let ends_shock = self.since_shock > AFTER_SHOCK;
        self.is_pulse && (begins_shock || ends_shock || is_weak && grows)
    }

    /// Whether it is over with a block, if it is a pulse; else that may begin it.
    pub fn is_over(&mut self, off: &Smooth, least: Least) -> bool {
        let is_up = off.fast > 0.0;
        if !self.is_pulse {
            let is_new = self.part.seconds == 0.0;
            if is_new || is_up != self.is_up || off.fast.abs() < ONSET * least.fast {
                let begins = Some(self.jump).filter(|_| is_new && is_up == self.is_up);
                *self = Self {
                    part: Part::at(off.from),
                    jump: begins.unwrap_or_default(),
                    is_up,
                    ..Self::default()
                };
            }
            let is_strong = off.fast.abs() > least.fast;
            self.is_pulse = is_strong || (off.slow.abs() > least.slow && (off.slow > 0.0) == is_up);
        }
        if !self.is_pulse {
            return false;
        }
        let (fast, slow) = (self.sign() * off.fast, self.sign() * off.slow);
        self.is_strong |= fast > 1.5 * least.fast;
        self.most = self.most.max(fast);
        let is_within = if self.is_strong {
            fast <= least.fast.max(PLATEAU * self.most)
        } else {
            // A shock, which the longer mean remembers, may have begun it.
            slow <= 0.5 * least.slow || fast < -least.fast
        };
        self.foot = if is_within {
            self.foot + off.seconds
        } else {
            0.0
        };
        is_within && (fast < 0.0 || self.foot > FOOT)
    }

    /// Adds a block.
    pub fn add(&mut self, known: &Known, off: &Smooth, least: Least) {
        let sign = self.sign();
        let foot = least.fast.min(least.slow).max(PLATEAU / 3.0 * self.most);
        if !self.is_pulse || sign * off.fast > foot {
            self.part.to = off.to;
        }
        if sign * off.jump > self.jump.by {
            self.jump = Jump {
                by: sign * off.jump,
                at: off.to,
                before: self.part,
            };
        }
        if -sign * off.jump > self.jump_back.0 {
            self.jump_back = (-sign * off.jump, off.to);
        }
        self.sum(known, off);
    }

    fn sum(&mut self, known: &Known, off: &Smooth) {
        self.part.change += off.mean * off.seconds;
        self.part.seconds += off.seconds;
        self.part.peak = self.part.peak.max(off.mean.abs());
        if off.mean.abs() > known.prior.most_acceleration {
            self.since_shock = 0.0;
        } else if self.part.peak > known.prior.most_acceleration {
            self.since_shock += off.seconds;
        }
    }

    pub fn sign(&self) -> f64 {
        if self.is_up { 1.0 } else { -1.0 }
    }

    /// Whether it may be another level.
    pub fn begins_at_once(&self) -> bool {
        self.jump.before.seconds < 2.0 * FOOT && is_at_once(self.jump.by, self.most, 0.0)
    }

    /// Whether it changes towards the level at once, as after a knock.
    pub fn ends_at_once(&self) -> bool {
        let (by, at) = self.jump_back;
        is_at_once(by, self.most, 0.0) && at > self.part.to - FOOT
    }

    /// It, or a part of it, as a pulse, if it is more than noise of this deviation over the longer time.
    pub fn pulse(&self, known: &Known, part: &Part, noise: f64) -> Option<Turned> {
        if !self.is_pulse {
            return None;
        }
        // The mean of 1.5 s has 1/√1.5 of the walk of a second.
        let walk = 1.22 * noise;
        let variance = walk * walk * part.seconds + (LEVEL_ERROR * part.seconds).powi(2);
        let deviation = variance.sqrt();
        let is_shock = part.peak > known.prior.most_acceleration;
        let shock = if is_shock {
            SHOCK_ERROR * part.peak
        } else {
            0.0
        };
        let is_pulse =
            part.change.abs() > LEAST_CHANGE.max(LEAST_DEVIATIONS * deviation) || is_shock;
        is_pulse.then(|| {
            let pulse = Pulse {
                is_violent: is_shock,
                ..Pulse::passing(
                    (part.from, part.to),
                    part.change,
                    libm::hypot(deviation, shock),
                )
            };
            // A shock does not excuse the braking that it is part of.
            let is_violent = is_shock && part.seconds < LONGEST_SHOCK;
            Turned {
                ignored: known.prior.ignored(&Pulse {
                    is_violent,
                    ..pulse.clone()
                }),
                ..Turned::new(&known.prior, &pulse)
            }
        })
    }
}
