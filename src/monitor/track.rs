//! One level of the sensor, the pulses that leave it, and the hypotheses on them.

use super::hypotheses::Hypotheses;
use super::hypothesis::Hypothesis;
use super::noise::Noises;
use super::prices::Known;
use crate::explain::{Pulse, Turned};

/// How fast the level is followed: the time constant, and for how long no pulse may have been seen, s.
const FOLLOWS: f64 = 4.0;
pub(super) const SETTLED: f64 = 2.5;

/// It drifts no faster than this, m/s² a second: what moves faster may be a soft start.
const DRIFTS: f64 = 0.004;

/// How fast the noise of the longer time is.
const NOISE_FOLLOWS: f64 = 6.0;

/// The least and the greatest distance from the level that is a pulse, m/s²: of the smoothed record, and of the
/// mean of a longer time, which shows soft starts; and in standard deviations.
const FAST: (f64, f64, f64) = (0.02, 0.25, 2.5);
const SLOW: (f64, f64, f64) = (0.02, 0.12, 3.5);

/// How far a pulse reaches beyond the point where it falls into the noise, s.
const FOOT: f64 = 0.3;

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

/// What begins so soon after a swing, s, may be due to the hand that made it; what lasts longer than this is no part of it.
const AFTER_SWING: f64 = 1.0;
const OFF: f64 = 1.0;

/// Uncertainty of the level, m/s².
const LEVEL_ERROR: f64 = 0.004;

/// A block, smoothed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Smooth {
    pub from: f64,
    pub to: f64,
    pub seconds: f64,
    pub mean: f64,
    /// The mean around it, and of the time before.
    pub fast: f64,
    pub slow: f64,
}

/// What has left the level so far.
#[derive(Clone, Copy, Debug, Default)]
struct Excursion {
    from: f64,
    to: f64,
    change: f64,
    seconds: f64,
    peak: f64,
    /// How long ago its shock was, s.
    since_shock: f64,
    /// The largest smoothed value.
    most: f64,
    is_up: bool,
    /// Whether it is a pulse.
    is_pulse: bool,
    /// Whether it was ever seen in the smoothed record.
    is_strong: bool,
    /// How long it has been within the noise, s.
    foot: f64,
    /// Whether another level has been tried instead of it.
    is_doubted: bool,
}

/// Somebody who may have the sensor in hand.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hand {
    /// s
    pub since: f64,
    /// Whether there was another swing.
    pub swings_again: bool,
}

/// A level and what it implies.
#[derive(Clone, Debug)]
pub(super) struct Track {
    pub level: f64,
    pub hypotheses: Hypotheses,
    excursion: Excursion,
    noise: Noises,
    /// For how long there has been no pulse, s.
    pub quiet: f64,
}

impl Track {
    pub fn new(level: f64, noise: Noises, hypotheses: &[Hypothesis]) -> Self {
        Self {
            level,
            hypotheses: Hypotheses::new(hypotheses),
            excursion: Excursion::default(),
            noise,
            quiet: 0.0,
        }
    }

    pub fn noise(&self) -> Noises {
        self.noise
    }

    fn least(&self) -> (f64, f64) {
        let least =
            |noise: f64, (least, most, times): (f64, f64, f64)| (times * noise).clamp(least, most);
        (least(self.noise.fast, FAST), least(self.noise.slow, SLOW))
    }

    /// How far a level may be from this one and be the same.
    pub fn nearness(&self) -> f64 {
        0.75 * self.least().1
    }

    /// Takes a block, and the least noise that there is; `settled` is the mean of one so much earlier that no pulse can
    /// have begun in it.
    pub fn step(&mut self, known: &Known, block: &Smooth, white: Noises, settled: Option<f64>) {
        self.noise.fast = white.fast;
        self.noise.slow = self.noise.slow.max(white.slow);
        let (fast, slow) = (block.fast - self.level, block.slow - self.level);
        let least = self.least();
        let it = &self.excursion;
        let grows =
            fast.abs() > 1.5 * least.0 && fast.abs() * it.seconds > WEAK.1 * it.change.abs();
        let is_shock = (block.mean - self.level).abs() > known.prior.most_acceleration;
        let begins_shock =
            is_shock && it.peak < known.prior.most_acceleration && it.seconds > BEFORE_SHOCK;
        let is_weak = it.seconds > WEAK.0 && it.change.abs() < WEAK.2 * known.soft * it.seconds;
        let ends_shock = it.since_shock > AFTER_SHOCK;
        if it.is_pulse && (begins_shock || ends_shock || is_weak && grows) {
            self.end(known, block.from);
        }
        let it = &mut self.excursion;
        let is_up = fast > 0.0;
        if !it.is_pulse {
            let is_new = it.seconds == 0.0;
            if is_new || is_up != it.is_up || fast.abs() < ONSET * least.0 {
                *it = Excursion {
                    from: block.from,
                    to: block.from,
                    is_up,
                    ..Excursion::default()
                };
            }
            let is_strong = fast.abs() > least.0;
            it.is_pulse = is_strong || (slow.abs() > least.1 && (slow > 0.0) == is_up);
        }
        let off = block.mean - self.level;
        let sign = if it.is_up { 1.0 } else { -1.0 };
        it.is_strong |= it.is_pulse && sign * fast > 1.5 * least.0;
        let is_over = it.is_pulse && {
            it.most = it.most.max(sign * fast);
            let is_within = if it.is_strong {
                sign * fast <= least.0.max(PLATEAU * it.most)
            } else {
                // A shock, which the longer mean remembers, may have begun it.
                sign * slow <= 0.5 * least.1 || sign * fast < -least.0
            };
            it.foot = if is_within {
                it.foot + block.seconds
            } else {
                0.0
            };
            is_within && (sign * fast < 0.0 || it.foot > FOOT)
        };
        if is_over {
            self.end(known, block.from);
        }
        let it = &mut self.excursion;
        if !it.is_pulse || sign * fast > least.0.min(least.1).max(PLATEAU / 3.0 * it.most) {
            it.to = block.to;
        }
        it.change += off * block.seconds;
        it.seconds += block.seconds;
        it.peak = it.peak.max(off.abs());
        if it.peak > known.prior.most_acceleration {
            it.since_shock = if is_shock {
                0.0
            } else {
                it.since_shock + block.seconds
            };
        }
        self.follow(block.seconds, slow, settled);
    }

    fn follow(&mut self, seconds: f64, slow: f64, settled: Option<f64>) {
        if self.excursion.is_pulse {
            return;
        }
        self.quiet += seconds;
        if self.quiet > 1.5 {
            let share = (seconds / NOISE_FOLLOWS).min(1.0);
            self.noise.slow += share * (1.25 * slow.abs() - self.noise.slow);
        }
        if let Some(settled) = settled.filter(|_| self.quiet > SETTLED + 1.0) {
            // What is as far away as a shock is not of the level.
            let away = (settled - self.level).clamp(-FAST.1, FAST.1);
            let step = (seconds / FOLLOWS).min(1.0) * away;
            self.level += step.clamp(-DRIFTS * seconds, DRIFTS * seconds);
        }
    }

    fn end(&mut self, known: &Known, now: f64) {
        if let Some(pulse) = self.pulse(known) {
            self.quiet = 0.0;
            self.hypotheses.take(known, &pulse);
        }
        self.excursion = Excursion {
            is_up: !self.excursion.is_up,
            from: now,
            to: now,
            ..Excursion::default()
        };
    }

    /// The current pulse so far, if it is more than noise.
    pub fn pulse(&self, known: &Known) -> Option<Turned> {
        let it = &self.excursion;
        if !it.is_pulse {
            return None;
        }
        // The mean of 1.5 s has 1/√1.5 of the walk of a second.
        let walk = 1.22 * self.noise.slow;
        let variance = walk * walk * it.seconds + (LEVEL_ERROR * it.seconds).powi(2);
        let deviation = variance.sqrt();
        let is_shock = it.peak > known.prior.most_acceleration;
        let shock = if is_shock { SHOCK_ERROR * it.peak } else { 0.0 };
        let is_pulse = it.change.abs() > LEAST_CHANGE.max(LEAST_DEVIATIONS * deviation) || is_shock;
        is_pulse.then(|| {
            let pulse = Pulse {
                is_violent: is_shock,
                ..Pulse::passing((it.from, it.to), it.change, libm::hypot(deviation, shock))
            };
            // A shock does not excuse the braking that it is part of.
            let is_violent = is_shock && it.seconds < LONGEST_SHOCK;
            Turned {
                ignored: known.prior.ignored(&Pulse {
                    is_violent,
                    ..pulse.clone()
                }),
                ..Turned::new(&known.prior, &pulse)
            }
        })
    }

    /// Whether no pulse is going on, nor was lately.
    pub fn is_settled(&self) -> bool {
        !self.excursion.is_pulse && self.quiet > 1.0
    }

    /// Whether a pulse has been going on since a time.
    pub fn is_in_pulse_since(&self, time: f64) -> bool {
        self.excursion.is_pulse && self.excursion.from <= time
    }

    /// Whether its pulse is longer than that and was not doubted before, which it is from now on.
    pub fn doubts(&mut self, time: f64) -> bool {
        let doubts = self.is_in_pulse_since(time) && !self.excursion.is_doubted;
        self.excursion.is_doubted |= doubts;
        doubts
    }

    /// Somebody may have the sensor in hand: after a swing it has not come back to the level for some time.
    pub fn hand(&self) -> Option<Hand> {
        let it = &self.excursion;
        let is_off = it.is_pulse && it.seconds > OFF;
        let mut swings = self.hypotheses.swings();
        let swing = swings.find(|swing| it.from - swing.1 < AFTER_SWING);
        swing.filter(|_| is_off).map(|(_, since)| Hand {
            since,
            swings_again: false,
        })
    }

    /// Whether a hand may have put the sensor down, or lifted it again, after a time, s.
    pub fn swings_after(&self, time: f64) -> bool {
        self.hypotheses.swings().any(|swing| swing.0 > time)
    }

    /// Loses its pulse to a hole in the record.
    pub fn cross(&mut self, now: f64, is_brief: bool) {
        self.hypotheses
            .cross(now, is_brief, self.excursion.is_pulse);
        self.excursion = Excursion::default();
        self.quiet = 0.0;
    }
}
