//! What the hypotheses of a monitor cost beside the costs that they share with a whole record's explanations.
//!
//! A monitor knows nothing of what comes, and its level may be wrong: soft pulses, brisk ones, and speeds that do not
//! match need prices of their own. In nats.

use crate::explain::{Prior, Progress, Turned, cost};
use serde::{Deserialize, Serialize};

/// Pulses that change the speed by less than this share of the least speed begin no motion.
const LEAST_START: f64 = 0.35;

/// What a trip below the least speed costs, at most.
const SLOW: f64 = 6.0;

/// A pulse longer than this, s, with less than the weakest usual acceleration times this is soft; few lifts are.
const SOFT: (f64, f64) = (2.0, 1.2);
const SOFT_COST: f64 = 2.5;

/// A cage that creeps out of its floor keeps its speed for so long, s; a soft start that turns out to be that was none.
pub const KEPT: f64 = 1.0;
pub const NOT_SOFT: f64 = -SOFT_COST;

/// A lift that starts softly and brakes hard, or the other way round, is rarer still.
const UNLIKE: f64 = 2.0;

/// A lasting change of the level, and one that ends; and what each m/s² beyond a usual one adds.
const SHIFT: f64 = 5.0;
const SHIFT_AND_BACK: f64 = 6.0;
const STRONG_SHIFT: (f64, f64) = (0.1, 20.0);

/// One that came at once, as when the sensor is turned.
pub const AT_ONCE: f64 = 2.0;

/// Which way a motion went that was not seen to begin.
pub const EITHER_WAY: f64 = 0.4;

/// The most that a closing speed costs, since the level may have shifted; beyond a speed, m/s, more.
const MISFIT: (f64, f64, f64) = (5.5, 6.0, 0.3);

/// Pulses that change no speed are scattered over this, m/s, so that a sum of zero is hardly chance: it makes a
/// stop cheaper, by at most so much.
const CHANCE: (f64, f64) = (0.15, -2.0);

/// A cage that levels gains no speed.
const AGAIN: f64 = 4.0;

/// No lift starts in less, s, at most at this cost; none levels sooner after its start, s, at this cost.
const BRISK: (f64, f64) = (0.7, 6.0);
const BRIEF: (f64, f64) = (2.0, 4.0);

/// What else a start by a shock costs.
const VIOLENT_START: f64 = 6.0;

/// A stage of the braking of a motion whose speed is unknown.
pub const OPEN_STAGE: f64 = 4.5;

/// Speeds at which a lift may level, m/s, and below which that is rare, with its cost.
const LEVELLING: [f64; 7] = [0.03, 0.05, 0.1, 0.15, 0.2, 0.3, 0.5];
const SELDOM: (f64, f64) = (0.1, 3.0);

/// Faster lifts hardly exist, m/s.
const FASTEST: f64 = 10.0;

/// Motions hardly last longer, s; what each second more costs, and all of them.
const LONG: f64 = 60.0;
const LONG_SECOND: f64 = 0.05;
const MOST_LONG: f64 = 4.0;

/// What a motion costs that is longer than the longest: it makes the state unknown, not rest.
pub const ENDLESS: f64 = 12.0;

/// Those below this speed hardly as long, m/s.
const SLOW_TOP: f64 = 0.4;

/// A change of speed that is not over.
pub const CHANGING: f64 = 0.3;

/// Changes of speed by less than this share of it are taken for noise, at this cost.
const RIPPLE: (f64, f64) = (0.08, 0.1);

/// By how much better a motion must be excluded that is faster than the least speed, m/s, by this; and all beyond the
/// least speed where the record is not well explained.
const FAST: (f64, f64) = (3.5, 0.5);
pub const STRAINED: f64 = 2.0;

/// By how much better motions must be excluded that go back to one that was not seen to begin: one trip read backwards
/// looks as good.
pub const GUESS: f64 = 2.0;

/// And back to one that may have begun in a hole.
pub const GUESS_IN_HOLE: f64 = 3.0;

/// A lift that speeds up again by habit does so so often in a motion.
pub const MOST_AGAIN: u8 = 2;

/// That everything so far was misread.
pub const RENEWAL: f64 = 10.0;

/// A change of speed that is not soft hardly lasts longer, s; what each second more costs, and all of them.
const LONGEST_CHANGE: f64 = 15.0;
const ENDLESS_SECOND: f64 = 0.5;
const MOST_ENDLESS: f64 = 8.0;

/// A disturbance that may still be going on.
pub const PENDING: f64 = 1.5;

/// What is known of the lift and its sensor.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Known {
    pub prior: Prior,
    /// Below this mean acceleration a long pulse is soft, m/s².
    pub soft: f64,
}

impl Known {
    /// With the least speed that begins a motion.
    pub fn closing(&self) -> Prior {
        Prior {
            least_speed: self.prior.least_speed * LEAST_START,
            ..self.prior
        }
    }

    /// Whether a pulse is strong enough to begin or end a motion.
    pub fn is_strong(&self, pulse: &Turned) -> bool {
        pulse.change.abs() >= LEAST_START * self.prior.least_speed
    }

    /// Whether a pulse is long and weak.
    pub fn is_soft(&self, pulse: &Turned) -> bool {
        let seconds = pulse.to - pulse.from;
        seconds > SOFT.0 && pulse.change.abs() < SOFT.1 * self.soft * seconds
    }

    /// A change of speed that goes on and on, or to a speed of no lift: the sensor may have been turned.
    pub fn endless(&self, pulse: &Turned) -> f64 {
        let seconds = pulse.to - pulse.from;
        let endless = if self.is_soft(pulse) {
            0.0
        } else {
            (ENDLESS_SECOND * (seconds - LONGEST_CHANGE).max(0.0)).min(MOST_ENDLESS)
        };
        endless + fast(pulse.change.abs())
    }

    /// A motion with this top speed, m/s.
    pub fn slow(&self, top: f64) -> f64 {
        SLOW * (1.0 - top / self.prior.least_speed).max(0.0)
    }

    /// A pulse that is a passing change of the level, if it may be one.
    pub fn passing(&self, pulse: &Turned) -> f64 {
        if self.is_soft(pulse) {
            SHIFT_AND_BACK
        } else {
            f64::INFINITY
        }
    }
}

/// A soft start, or a soft stage.
pub fn soft(is_soft: bool) -> f64 {
    if is_soft { SOFT_COST } else { 0.0 }
}

/// A change of speed that is as soft as the start of the motion, or not.
pub fn unlike(start_is_soft: bool, is_soft: bool) -> f64 {
    match (start_is_soft, is_soft) {
        (false, true) => SOFT_COST + UNLIKE,
        (true, false) => UNLIKE,
        _ => 0.0,
    }
}

/// A start by a pulse as violent as this.
pub fn violent_start(pulse: &Turned) -> f64 {
    if pulse.is_shock() { VIOLENT_START } else { 0.0 }
}

/// A start as short as this pulse.
pub fn brisk(pulse: &Turned) -> f64 {
    BRISK.1 * (1.0 - (pulse.to - pulse.from) / BRISK.0).max(0.0)
}

/// A lasting change of the level by so much, m/s², that came at once or not.
pub fn shift(by: f64, at_once: bool) -> f64 {
    if at_once {
        return AT_ONCE;
    }
    SHIFT + STRONG_SHIFT.1 * (by.abs() - STRONG_SHIFT.0).clamp(0.0, 0.3)
}

/// The most that a closing speed costs, m/s.
pub fn misfit(speed: f64) -> f64 {
    MISFIT.0 + MISFIT.1 * (speed.abs() - MISFIT.2).max(0.0)
}

/// A stop within a tolerance of zero speed, m/s.
pub fn chance(tolerance: f64) -> f64 {
    libm::log(tolerance / CHANCE.0).clamp(CHANCE.1, 0.0)
}

/// Whether a change of speed is lost in a motion of this speed, m/s.
pub fn is_ripple(speed: f64, change: f64) -> bool {
    change.abs() < RIPPLE.0 * speed.abs().min(FASTEST)
}

/// Such a change, where it would cost this much to ignore it.
pub fn ripple(ignored: f64) -> f64 {
    ignored.min(RIPPLE.1)
}

/// A motion that gains speed again where it levelled.
pub fn again(motion: &Progress, change: f64) -> f64 {
    if motion.creeps && change * motion.speed > 0.0 {
        AGAIN
    } else {
        0.0
    }
}

/// Not believing a motion that is faster than the least speed by so much, m/s.
pub fn fast_unseen(by: f64) -> f64 {
    FAST.0 * (by / FAST.1).clamp(0.0, 1.0)
}

/// Levelling so many seconds after the start.
pub fn brief(seconds: f64) -> f64 {
    if seconds < BRIEF.0 { BRIEF.1 } else { 0.0 }
}

/// Levelling at a speed that may not be told from rest.
pub fn levelling(prior: &Prior, motion: &Progress) -> f64 {
    let tolerance = prior.tolerance(motion.top, motion.variance);
    let speed = if motion.is_up {
        motion.speed
    } else {
        -motion.speed
    };
    let costs = LEVELLING.iter().map(|at| {
        let seldom = SELDOM.1 * (1.0 - at / SELDOM.0).max(0.0);
        seldom + cost::closing(speed - at, tolerance)
    });
    costs.fold(f64::INFINITY, f64::min)
}

/// A motion that has lasted so long, s, at this top speed, m/s.
pub fn long(seconds: f64, top: f64) -> f64 {
    let usual = LONG * (top / SLOW_TOP).clamp(0.4, 1.0);
    (LONG_SECOND * (seconds - usual).max(0.0)).min(MOST_LONG)
}

/// A motion of this top speed, m/s.
pub fn fast(top: f64) -> f64 {
    (top - FASTEST).max(0.0)
}
