//! Swings: pulses to and fro that carry the sensor nowhere. Somebody jumps or walks, a rope bounces.

use super::progress::Turned;
use super::pulse::Pulse;
use std::f64::consts::PI;

/// A swing has so many pulses at least, with pauses no longer than this and each no longer than this, s; what is
/// shorter carries the sensor no farther than this, m.
pub const LEAST_IN_SWING: usize = 5;
const LONGEST_PAUSE: f64 = 0.4;
const LONGEST_SWING: f64 = 1.3;
const FARTHEST_SWING: f64 = 0.5;

/// A slow swing, of a rope: its pulses are no longer than this, s; pauses are at most this share of them; each changes
/// the speed at most so many times as much as the one before; they leave at most this share of the largest; and they
/// carry the sensor back at least this share of the way forth, and no farther than this, m.
pub const LONGEST_SLOW_SWING: f64 = 6.0;
pub const PAUSE_SHARE: f64 = 0.2;
const MOST_UNLIKE: f64 = 2.5;
const LEFT: f64 = 0.6;
const BACK: f64 = 0.25;
const FARTHEST_SLOW_SWING: f64 = 2.0;

/// Pulses in a row that may be a disturbance: a jump, a swing of a rope, a push.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Swing {
    /// The speed that they leave, m/s.
    pub speed: f64,
    way: f64,
    /// End of the latest, s.
    to: Option<f64>,
}

impl Swing {
    /// Whether a pulse now could belong to one whose latest pulse ended then, s.
    pub fn lasts_from(to: f64, now: f64) -> bool {
        now - to <= LONGEST_PAUSE
    }

    /// Whether a pulse of so many seconds, as long as the latest, could still bring it to rest near enough.
    pub fn may_return(&self, seconds: f64) -> bool {
        (self.way + self.speed * seconds / 2.0).abs() <= FARTHEST_SWING
    }

    /// With another pulse, unless that is too late, too long or carries the sensor too far.
    pub fn with(self, pulse: &Turned) -> Option<Self> {
        let pause = self.to.map_or(0.0, |to| pulse.from - to);
        let length = pulse.to - pulse.from;
        let way = self.way + self.speed * pause + (self.speed + pulse.change / 2.0) * length;
        let is_swing =
            pause <= LONGEST_PAUSE && length <= LONGEST_SWING && way.abs() <= FARTHEST_SWING;
        is_swing.then_some(Self {
            speed: self.speed + pulse.change,
            way,
            to: Some(pulse.to),
        })
    }
}

/// How many pulses from the first on are one swing: those that are short, or alike and leave next to no speed. A lift
/// does not turn so often without a rest or a uniform motion in between.
pub fn in_one(pulses: &[Pulse]) -> usize {
    let turns = |pair: &[Pulse]| pair[0].change * pair[1].change < 0.0;
    let is_short = |pulse: &Pulse| pulse.seconds() <= LONGEST_SWING;
    let follows = |pair: &[Pulse]| {
        turns(pair) && pair[1].from - pair[0].to <= LONGEST_PAUSE && pair.iter().all(is_short)
    };
    let short = if is_short(&pulses[0]) {
        1 + pulses.windows(2).take_while(|pair| follows(pair)).count()
    } else {
        0
    };
    if short >= LEAST_IN_SWING {
        return short;
    }
    let is_like = |pair: &[Pulse]| {
        let ratio = pair[1].change.abs() / pair[0].change.abs();
        let longest = pair[0].seconds().max(pair[1].seconds());
        let pause = pair[1].from - pair[0].to;
        turns(pair)
            && pause <= LONGEST_PAUSE.max(PAUSE_SHARE * longest)
            && longest <= LONGEST_SLOW_SWING
            && (1.0 / MOST_UNLIKE..=MOST_UNLIKE).contains(&ratio)
    };
    let alike = 1 + pulses.windows(2).take_while(|pair| is_like(pair)).count();
    let is_swing = |count: &usize| {
        let pulses = &pulses[..*count];
        let most = pulses
            .iter()
            .map(|pulse| pulse.change.abs())
            .fold(0.0, f64::max);
        let left: f64 = pulses.iter().map(|pulse| pulse.change).sum();
        let parts = pulses.iter().map(|pulse| (pulse.seconds(), pulse.change));
        left.abs() <= LEFT * most && goes_back(parts)
    };
    (LEAST_IN_SWING..=alike)
        .rev()
        .find(is_swing)
        .unwrap_or(short)
}

/// Whether pulses, of so many seconds and with such changes of speed, carry the sensor back and forth, at least this
/// share as far, and never as far as to the next floor. Rides in one direction turn as often, but never go back.
pub fn goes_back(pulses: impl Iterator<Item = (f64, f64)>) -> bool {
    let (mut speed, mut back, mut forth, mut farthest) = (0.0f64, 0.0, 0.0, 0.0f64);
    let mut before: Option<f64> = None;
    for (seconds, change) in pulses {
        if let Some(before) = before {
            // Half a sine of speed, from the middle of one pulse to that of the other.
            let way = speed * (before + seconds) / PI;
            forth += way.max(0.0);
            back -= way.min(0.0);
            farthest = farthest.max(way.abs());
        }
        speed += change;
        before = Some(seconds);
    }
    farthest < FARTHEST_SLOW_SWING && back.min(forth) > BACK * back.max(forth)
}
