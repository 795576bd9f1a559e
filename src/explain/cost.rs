//! What each part of an explanation costs.
//!
//! Costs are in nats: a difference of 3 is a factor of 20 in plausibility. The terms with a deviation are half
//! squares of a normal error. The others are prior judgements about lifts, in one place, to be read and doubted.

use super::pulse::Pulse;
use libm::log1p;
use serde::{Deserialize, Serialize};

/// What is known of lifts beforehand.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Prior {
    /// The slowest trip, m/s.
    pub least_speed: f64,
    /// An acceleration that no lift has, m/s².
    pub most_acceleration: f64,
    /// The longest motion, s.
    pub longest_motion: f64,
    /// Share of the top speed that the sensor leaves at a stop.
    pub gain_error: f64,
    /// Whether the record begins at rest, if that is known.
    pub begins_at_rest: Option<bool>,
    /// Whether the lift speeds up in stages on its trips: it creeps out of a floor, or slows down half-way.
    pub in_stages: bool,
}

impl Default for Prior {
    fn default() -> Self {
        Self {
            least_speed: 0.2,
            most_acceleration: 2.5,
            longest_motion: 900.0,
            gain_error: 0.03,
            begins_at_rest: None,
            in_stages: false,
        }
    }
}

/// A trip that is complete in the record.
pub const TRIP: f64 = 1.0;

/// A motion that began before the record, or goes on after it.
pub const OPEN: f64 = 3.0;

/// A start or a stop within a hole: usually, less in one longer than a few seconds, more in one that can hardly hide a
/// change of speed, which lasts this long, s.
pub const IN_HOLE: f64 = 1.5;
const LONG_HOLE: f64 = 20.0;
const CHANGE_LASTS: f64 = 2.0;
const MOST_IN_HOLE: f64 = 3.0 * IN_HOLE;

/// A pulse that an end of a stretch cuts off is over just there.
const CUT_OFF: f64 = 1.75;

/// Somebody has the sensor in hand, between rides.
pub const IN_HAND: f64 = 1.5;

/// A pulse that an end of a stretch cuts off is no acceleration: the sensor was turned there, or warms up.
pub const TURNED: f64 = 5.0;

/// What is seen of the change is too slow for a trip.
pub const SLOW_PART: f64 = 2.0;

/// A motion that goes on across a hole: once, and for every so many seconds beyond the first few.
pub const ACROSS_HOLE: f64 = 0.3;
const MOTION_LASTS: f64 = 30.0;
const FEW: f64 = 5.0;

/// A cage hardly stops and starts again within this time, s.
const STOPOVER: f64 = 10.0;

/// What is all but impossible.
pub const ABSURD: f64 = 30.0;

/// A shock as a change of speed: a jam.
pub const VIOLENT: f64 = 4.0;

/// A weak pulse within this time of a stop, s, may belong to it by chance; where few show around it, s, that is
/// unlikely, and costs up to this much.
const BY_CHANCE: f64 = 5.0;
pub const AROUND: f64 = 60.0;
const MOST_CALM: f64 = 2.0;

/// Whoever starts or ends a recording, or whatever made a hole in it, moves the sensor for so long, s.
pub const HANDLED: f64 = 3.0;

/// A change of speed that leaves the cage at another speed and not at rest: a stage of braking.
pub const STAGE: f64 = 0.5;

/// One of acceleration, long after the first.
pub const LATE_STAGE: f64 = 6.0;

/// The cage creeps out of a floor at such a speed at most, m/s, then gains more than so many times that: what the stage
/// costs at most.
pub const CREPT_OUT: (f64, f64, f64) = (0.6, 1.5, 3.0);

/// A lift that speeds up in stages on its trips: few do.
pub const IN_STAGES: f64 = 7.0;

/// The least share of the speed that is a stage of such a lift.
pub const LEAST_STAGE: f64 = 0.2;

/// A second stage of acceleration as strong as the first. Two trips at one speed that are read as one always show it; a
/// lift that creeps out of a station hardly does.
pub const DOUBLED: f64 = 4.0;

/// A change of speed too small for a stage.
pub const RIPPLE: f64 = 0.1;

/// A change of speed that is half of a swing.
pub const HALF: f64 = 1.0;

/// The level of the sensor shifts for a while.
const SHIFT: f64 = 3.0;

/// What a single period of a slow swing costs beside the speed that it leaves.
pub const SLOW_SWING: f64 = 3.0;

/// The most a long swing costs, whatever speed it seems to leave.
const MOST_SWING: f64 = 6.0;

/// The cage creeps to the landing: once, and for every second.
pub const CREEP: f64 = 1.0;
pub const CREEP_SECOND: f64 = 0.2;
pub const MOST_CREEP: f64 = 4.0;

/// The cage goes through zero speed and on the other way without a stop.
pub const TURN: f64 = 6.0;

/// A motion that goes on without any speed.
pub const STANDS: f64 = 4.0;

/// The cage gains speed again from where it crept.
pub const RESTART: f64 = 6.0;

/// The most a closing speed costs.
const MOST_CLOSING: f64 = 20.0;

/// What rounding leaves of the speed at a stop, m/s.
const ROUNDING: f64 = 0.015;

/// No trip is shorter than this, m.
const LEAST_DISTANCE: f64 = 0.5;
/// Floors are hardly nearer to each other, m.
const SHORT_DISTANCE: f64 = 2.0;

/// Nor briefer, s.
const LEAST_DURATION: f64 = 1.5;

/// Faster lifts hardly exist, m/s.
const FASTEST: f64 = 12.0;

/// Coming to rest with this speed left.
pub fn closing(speed: f64, tolerance: f64) -> f64 {
    ((speed / tolerance).powi(2) / 2.0).min(MOST_CLOSING)
}

/// A pulse is over just where an end of a stretch cuts it off, if one does.
pub fn cut_off(is_at_end: bool) -> f64 {
    if is_at_end { CUT_OFF } else { 0.0 }
}

/// A start or a stop within a hole of so many seconds.
pub fn in_hole(seconds: f64) -> f64 {
    let usual = log1p(LONG_HOLE / seconds).min(IN_HOLE);
    (usual * (1.0 + (CHANGE_LASTS / seconds).powi(4))).min(MOST_IN_HOLE)
}

/// A stop and the next start within one hole.
pub fn stopover(seconds: f64) -> f64 {
    2.0 * in_hole(seconds) + (STOPOVER / seconds).powi(2).min(ABSURD)
}

/// A second stage of acceleration, `gap` seconds after the first.
pub fn acceleration_stage(gap: f64) -> f64 {
    match gap {
        ..1.0 => 0.5,
        ..3.0 => 2.0,
        _ => LATE_STAGE,
    }
}

impl Prior {
    /// What a weak pulse costs at least if it is something else, where so many show in so many seconds. At a rate λ one
    /// comes by chance within t of a stop with odds of λt to 1.
    pub fn calm(seconds: f64, weak: usize) -> f64 {
        log1p(seconds / (BY_CHANCE * weak.max(1) as f64)).min(MOST_CALM)
    }

    /// Whether a pulse is one of those that anything near the sensor may leave.
    pub fn is_weak(&self, pulse: &Pulse) -> bool {
        let is_plain = !pulse.is_violent && !pulse.is_swing && pulse.shift == 0.0;
        is_plain && pulse.change.abs() < self.least_speed
    }

    /// A motion that goes on across a hole of so many seconds.
    pub fn across_hole(&self, seconds: f64) -> f64 {
        if seconds > self.longest_motion {
            return ABSURD;
        }
        let long = (seconds - FEW).max(0.0) / MOTION_LASTS;
        (ACROSS_HOLE + long).min(ABSURD)
    }

    /// The standard deviation of a sum of changes of speed, m/s.
    pub fn tolerance(&self, top: f64, variance: f64) -> f64 {
        ((self.gain_error * top).powi(2) + ROUNDING * ROUNDING + variance).sqrt()
    }

    /// A pulse that changes no speed: something else shook the sensor.
    pub fn ignored(&self, pulse: &Pulse) -> f64 {
        if pulse.is_swing {
            // A long one ends with a speed that the level's error alone may leave.
            let speed = (pulse.change.abs() - 2.0 * pulse.deviation).max(0.0);
            return self.disturbance(speed).min(MOST_SWING);
        }
        let ratio = pulse.change.abs() / self.least_speed;
        let cost = if ratio < 1.0 {
            0.2 + 3.8 * ratio * ratio
        } else {
            (4.0 + 5.0 * (ratio - 1.0)).min(14.0)
        };
        if pulse.is_violent {
            0.5 + cost / 4.0
        } else if pulse.shift != 0.0 {
            cost.min(SHIFT)
        } else {
            cost
        }
    }

    /// Pulses in a row that together leave this speed: a jump, a swing of the rope, a push.
    pub fn disturbance(&self, speed: f64) -> f64 {
        1.5 + 3.0 * (speed / self.least_speed).powi(2)
    }

    /// A motion that is too slow, too short or too fast for a trip.
    pub fn implausible(&self, top: f64, distance: f64, seconds: f64) -> f64 {
        let slow = if top < self.least_speed { ABSURD } else { 0.0 };
        let short = match distance.abs() {
            ..LEAST_DISTANCE => 8.0,
            ..SHORT_DISTANCE => 2.0,
            _ => 0.0,
        };
        let brief = if seconds < LEAST_DURATION { 8.0 } else { 0.0 };
        slow + short + brief + (top - FASTEST).clamp(0.0, ABSURD)
    }
}
