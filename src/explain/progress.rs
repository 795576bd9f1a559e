//! A motion in progress: what it costs to begin it, to change its speed, and to end it.
//!
//! It is what the motions of a record and the hypotheses of a monitor have in common.

use super::cost::{self, Prior};
use super::pulse::Pulse;
use serde::{Deserialize, Serialize};

/// The share of its top speed to which a motion that crept gains speed again.
const RESTARTED: f64 = 0.3;

/// A pulse in one direction of time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Turned {
    pub from: f64,
    pub to: f64,
    pub change: f64,
    pub variance: f64,
    /// The cost of taking it for something else than a change of speed.
    pub ignored: f64,
    /// What its violence adds to the cost of a change of speed.
    pub violent: f64,
}

impl Turned {
    /// In the order of the record.
    pub fn new(prior: &Prior, pulse: &Pulse) -> Self {
        Self {
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
        }
    }

    /// Whether it is stronger than any acceleration of a lift.
    pub fn is_shock(&self) -> bool {
        self.violent > 0.0
    }

    /// With time reversed.
    pub fn reversed(&self) -> Self {
        Self {
            from: -self.to,
            to: -self.from,
            change: -self.change,
            ..*self
        }
    }
}

/// A motion in progress.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Progress {
    pub speed: f64,
    pub top: f64,
    pub variance: f64,
    pub cost: f64,
    /// End of the latest change, s.
    pub since: f64,
    pub distance: f64,
    /// How far it has been from where it began, m.
    pub farthest: f64,
    pub creeps: bool,
    /// Whether it does so at hardly any speed.
    pub is_slow: bool,
    /// Whether it began upwards.
    pub is_up: bool,
}

impl Progress {
    /// The motion that begins with a pulse.
    pub fn start(pulse: &Turned) -> Self {
        Self {
            speed: pulse.change,
            top: pulse.change.abs(),
            variance: pulse.variance,
            cost: cost::TRIP + pulse.violent,
            since: pulse.to,
            distance: pulse.change * (pulse.to - pulse.from) / 2.0,
            farthest: 0.0,
            creeps: false,
            is_slow: false,
            is_up: pulse.change > 0.0,
        }
    }

    /// The motion after pulses that together change its speed.
    pub fn changed(&self, prior: &Prior, pulses: &[Turned]) -> Self {
        let pause = pulses[0].from - self.since;
        let mut changed = *self;
        let mut total = 0.0;
        for pulse in pulses {
            let coast = pulse.from - changed.since;
            changed.distance += changed.speed * coast;
            let turn = changed.turn(pulse);
            changed.distance += (changed.speed + pulse.change / 2.0) * (pulse.to - pulse.from);
            changed.farthest = turn.max(changed.distance.abs()).max(changed.farthest);
            changed.speed += pulse.change;
            changed.variance += pulse.variance;
            changed.cost += pulse.violent;
            changed.since = pulse.to;
            total += pulse.change;
        }
        changed.top = changed.top.max(changed.speed.abs());
        changed.cost += self.creeping(prior, pulses[0].from);
        if self.is_slow && changed.restarts(prior) {
            changed.cost += cost::RESTART;
        } else if total * self.speed > 0.0 {
            changed.cost += self.stage(prior, changed.top, total.abs(), pause);
        }
        changed
    }

    /// Whether it moves on from a stand. A lift may level faster than it braked to, unless it is known to speed up in stages.
    fn restarts(&self, prior: &Prior) -> bool {
        if prior.in_stages {
            !self.crawls(prior)
        } else {
            self.speed.abs() > RESTARTED * self.top
        }
    }

    /// Whether it moves at hardly any speed.
    fn crawls(&self, prior: &Prior) -> bool {
        self.speed.abs() < 2.0 * prior.tolerance(self.top, self.variance)
    }

    /// The cost of a stage of acceleration to this top speed, by so much, after a pause.
    fn stage(&self, prior: &Prior, top: f64, change: f64, pause: f64) -> f64 {
        let usual = cost::acceleration_stage(pause);
        let (creep, times, most) = cost::CREPT_OUT;
        if prior.in_stages && change > cost::LEAST_STAGE * top {
            cost::STAGE
        } else if self.top <= creep && change > times * self.top {
            usual.min(most)
        } else {
            usual
        }
    }

    /// How far from its beginning it turns during a pulse of even acceleration, m; 0 if it does not.
    fn turn(&self, pulse: &Turned) -> f64 {
        let part = -self.speed / pulse.change;
        if (0.0..1.0).contains(&part) {
            (self.distance + self.speed * part * (pulse.to - pulse.from) / 2.0).abs()
        } else {
            0.0
        }
    }

    /// The motion that goes on after it has changed from `before`; `stage` is the cost of a stage of braking.
    pub fn going_on(self, prior: &Prior, before: &Self, stage: f64) -> Self {
        let is_slow = self.crawls(prior);
        let is_braking = self.speed.abs() < before.speed.abs();
        let is_turned = self.speed != 0.0 && (self.speed > 0.0) != self.is_up;
        let cost = if is_slow {
            cost::CREEP
        } else if is_turned {
            cost::TURN
        } else if is_braking && before.speed.abs() - self.speed.abs() < 0.2 * before.top {
            cost::RIPPLE
        } else if is_braking {
            stage
        } else {
            0.0
        };
        Self {
            cost: self.cost + cost,
            creeps: is_slow || (is_braking && !is_turned && cost > cost::RIPPLE),
            is_slow,
            ..self
        }
    }

    /// What it costs if its latest change, `seconds` after its beginning, has ended it.
    pub fn closed(&self, prior: &Prior, seconds: f64) -> f64 {
        self.cost
            + cost::closing(self.speed, prior.tolerance(self.top, self.variance))
            + prior.implausible(self.top, self.farthest, seconds)
    }

    /// The cost of creeping until a time.
    pub fn creeping(&self, prior: &Prior, until: f64) -> f64 {
        let is_habit = prior.in_stages && !self.is_slow;
        if self.creeps && !is_habit {
            (cost::CREEP_SECOND * (until - self.since)).min(cost::MOST_CREEP)
        } else {
            0.0
        }
    }
}
