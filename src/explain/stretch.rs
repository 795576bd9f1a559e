//! A stretch without holes in one direction of time, and what a pulse makes of a motion in progress.
//!
//! A motion begins with a pulse; every later one changes its speed, or is something else, or belongs to a disturbance. It
//! may end at a change that brings the speed back to zero. Reversed, braking is a start.

use super::cost::{self, Prior};
use super::pulse::{FARTHEST_SWING, LEAST_IN_SWING, LONGEST_PAUSE, LONGEST_SWING, Pulse};
use std::ops::Range;

/// The share of its top speed to which a motion that crept gains speed again.
const RESTARTED: f64 = 0.3;

/// A pulse in one direction of time.
#[derive(Clone, Copy, Debug)]
pub struct Turned {
    pub from: f64,
    pub to: f64,
    pub change: f64,
    pub variance: f64,
    pub ignored: f64,
    pub violent: f64,
}

/// The pulses of a stretch without holes.
pub struct Stretch<'a> {
    pub prior: &'a Prior,
    pub pulses: Vec<Turned>,
    /// For each pulse the disturbances that begin with it: the pulse after, and the cost.
    disturbances: Vec<Vec<(usize, f64)>>,
    /// Its end, s.
    pub end: f64,
    /// Its beginning, s.
    begin: f64,
    /// Whether time runs backwards.
    pub is_reversed: bool,
}

/// A motion in progress.
#[derive(Clone, Copy, Debug)]
pub struct Progress {
    pub speed: f64,
    pub top: f64,
    pub variance: f64,
    pub cost: f64,
    /// End of the latest change, s.
    pub since: f64,
    pub distance: f64,
    pub creeps: bool,
    /// Whether it does so at hardly any speed.
    pub is_slow: bool,
    /// The latest change, in the list of all.
    pub latest: usize,
}

impl<'a> Stretch<'a> {
    /// In the order of the record; `begin` and `end` in s.
    pub fn new(prior: &'a Prior, pulses: &[Pulse], (begin, end): (f64, f64)) -> Self {
        let turned = pulses.iter().map(|pulse| Turned {
            from: pulse.from,
            to: pulse.to,
            change: pulse.change,
            variance: pulse.deviation * pulse.deviation,
            ignored: prior.ignored(pulse),
            violent: if pulse.is_violent || pulse.is_swing {
                cost::VIOLENT
            } else {
                0.0
            },
        });
        Self::of(prior, turned.collect(), (begin, end), false)
    }

    /// The same with time reversed.
    pub fn reversed(&self) -> Self {
        let turned = self.pulses.iter().rev().map(|pulse| Turned {
            from: -pulse.to,
            to: -pulse.from,
            change: -pulse.change,
            ..*pulse
        });
        let ends = (-self.end, -self.begin);
        Self::of(self.prior, turned.collect(), ends, !self.is_reversed)
    }

    fn of(
        prior: &'a Prior,
        pulses: Vec<Turned>,
        (begin, end): (f64, f64),
        is_reversed: bool,
    ) -> Self {
        let disturbances = (0..pulses.len()).map(|first| disturbances(prior, &pulses, first));
        Self {
            disturbances: disturbances.collect(),
            prior,
            pulses,
            begin,
            end,
            is_reversed,
        }
    }

    /// The cost of a pulse that is not part of any motion.
    pub fn ignored(&self, pulse: usize) -> f64 {
        self.pulses[pulse].ignored
    }

    /// The disturbances that begin with a pulse: the pulse after, and the cost.
    pub fn disturbances(&self, first: usize) -> &[(usize, f64)] {
        &self.disturbances[first]
    }

    /// The motion that begins with a pulse, if that is strong enough.
    pub fn start(&self, first: usize) -> Option<Progress> {
        let pulse = self.pulses[first];
        let is_strong = pulse.change.abs() >= self.prior.least_speed / 8.0;
        is_strong.then(|| Progress {
            speed: pulse.change,
            top: pulse.change.abs(),
            variance: pulse.variance,
            cost: cost::TRIP + pulse.violent,
            since: pulse.to,
            distance: pulse.change * (pulse.to - pulse.from) / 2.0,
            creeps: false,
            is_slow: false,
            latest: 0,
        })
    }

    /// The motion after pulses that together change its speed.
    pub fn changed(&self, motion: &Progress, pulses: Range<usize>) -> Progress {
        let pause = self.pulses[pulses.start].from - motion.since;
        let mut changed = *motion;
        let mut total = 0.0;
        for pulse in &self.pulses[pulses.clone()] {
            let coast = pulse.from - changed.since;
            changed.distance += changed.speed * coast
                + (changed.speed + pulse.change / 2.0) * (pulse.to - pulse.from);
            changed.speed += pulse.change;
            changed.variance += pulse.variance;
            changed.cost += pulse.violent;
            changed.since = pulse.to;
            total += pulse.change;
        }
        changed.top = changed.top.max(changed.speed.abs());
        changed.cost += motion.creeping(self.pulses[pulses.start].from);
        if motion.is_slow && changed.speed.abs() > RESTARTED * changed.top {
            changed.cost += cost::RESTART;
        } else if total * motion.speed > 0.0 {
            changed.cost += cost::acceleration_stage(pause);
        }
        if self.is_half(pulses.end) {
            changed.cost += cost::HALF;
        }
        changed
    }

    /// Whether the pulse before this one and it are a swing to and fro.
    fn is_half(&self, next: usize) -> bool {
        let Some(after) = self.pulses.get(next) else {
            return false;
        };
        let before = self.pulses[next - 1];
        let is_swing = self.disturbances[next - 1]
            .iter()
            .any(|it| it.0 == next + 1);
        is_swing
            && after.change * before.change < 0.0
            && after.change.abs() > 0.3 * before.change.abs()
    }

    /// A motion that goes on after a change.
    pub fn going_on(&self, changed: Progress, before: &Progress, first: usize) -> Progress {
        let tolerance = self.prior.tolerance(changed.top, changed.variance);
        let is_slow = changed.speed.abs() < 2.0 * tolerance;
        let is_braking = changed.speed.abs() < before.speed.abs();
        let cost = if is_slow {
            cost::CREEP
        } else if changed.speed * self.pulses[first].change < 0.0 {
            cost::TURN
        } else if is_braking && before.speed.abs() - changed.speed.abs() < 0.2 * before.top {
            cost::RIPPLE
        } else if is_braking {
            if self.is_reversed {
                cost::acceleration_stage(f64::INFINITY) / 2.0
            } else {
                cost::STAGE
            }
        } else {
            0.0
        };
        Progress {
            cost: changed.cost + cost,
            creeps: is_slow || (is_braking && cost > cost::RIPPLE),
            is_slow,
            ..changed
        }
    }

    /// A motion that ends with a pulse.
    pub fn closed(&self, motion: &Progress, first: usize, last: usize) -> Progress {
        let seconds = self.pulses[last].to - self.pulses[first].from;
        let tolerance = self.prior.tolerance(motion.top, motion.variance);
        let cost = motion.cost
            + cost::closing(motion.speed, tolerance)
            + self.prior.implausible(motion.top, motion.distance, seconds);
        Progress { cost, ..*motion }
    }
}

impl Progress {
    /// The cost of creeping until a time.
    pub fn creeping(&self, until: f64) -> f64 {
        if self.creeps {
            (cost::CREEP_SECOND * (until - self.since)).min(cost::MOST_CREEP)
        } else {
            0.0
        }
    }
}

fn disturbances(prior: &Prior, pulses: &[Turned], first: usize) -> Vec<(usize, f64)> {
    let (mut speed, mut way, mut found) = (0.0f64, 0.0f64, Vec::new());
    // Longer ones are one pulse already.
    let last = pulses.len().min(first + LEAST_IN_SWING - 1);
    for index in first..last {
        let pulse = pulses[index];
        let pause = if index > first {
            pulse.from - pulses[index - 1].to
        } else {
            0.0
        };
        let length = pulse.to - pulse.from;
        way += speed * pause + (speed + pulse.change / 2.0) * length;
        speed += pulse.change;
        if pause > LONGEST_PAUSE || length > LONGEST_SWING || way.abs() > FARTHEST_SWING {
            break;
        }
        if index > first {
            found.push((index + 1, prior.disturbance(speed)));
        }
    }
    found
}
