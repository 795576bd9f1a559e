//! One level of the sensor, the pulses that leave it, and the hypotheses on them.

use super::excursion::{Excursion, FAST, FOOT, Least, Part};
use super::hypotheses::Hypotheses;
use super::hypothesis::Hypothesis;
use super::noise::Noises;
use super::prices::{self, Known};
use super::recent::{SETTLED, Smooth};
use crate::explain::{Turned, is_at_once};
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;

/// How fast the level is followed: the time constant, s.
const FOLLOWS: f64 = 4.0;

/// It drifts no faster than this, m/s² a second: what moves faster may be a soft start.
const DRIFTS: f64 = 0.004;

/// How fast the noise of the longer time is.
const NOISE_FOLLOWS: f64 = 6.0;

/// What begins so soon after a swing, s, may be due to the hand that made it; what lasts longer than this is no part of it.
const AFTER_SWING: f64 = 1.0;
const OFF: f64 = 1.0;

/// So many changes at once are remembered: the largest of each of the latest pulses.
const MOST_TURNS: usize = 3;

/// A hand that turns a sensor overshoots: of the largest change at once so much may remain.
const OVERSHOT: f64 = 0.3;

/// What it costs that a sensor is turned as the cage starts, nats, where it may be: by more than this, m/s².
const STARTS: f64 = 3.0;
const BY_HAND: f64 = 0.1;

/// A change at once that may be one of the level.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Turn {
    /// m/s²
    by: f64,
    /// s
    at: f64,
    /// Whether a pulse began with it.
    is_first: bool,
    /// What had left the level when it came, and what was plausible before that.
    begun: Part,
    before: Vec<Hypothesis>,
}

/// Somebody who may have the sensor in hand.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct Hand {
    /// s
    pub since: f64,
    /// Whether there was another swing.
    pub swings_again: bool,
}

/// A level and what it implies.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Track {
    pub level: f64,
    pub hypotheses: Hypotheses,
    excursion: Excursion,
    noise: Noises,
    /// The latest changes at once in pulses that are over.
    turns: VecDeque<Turn>,
    /// Since when the record may be on this level, if it came to it at once, s.
    pub since: f64,
    /// Where the latest pulse ended at once, since when it was all a knock, s.
    knocked: Option<f64>,
    /// For how long there has been no pulse, s, but for one that goes on.
    quiet: f64,
}

impl Track {
    pub fn new(level: f64, noise: Noises, hypotheses: &[Hypothesis]) -> Self {
        Self {
            level,
            hypotheses: Hypotheses::new(hypotheses),
            excursion: Excursion::default(),
            noise,
            turns: VecDeque::with_capacity(MOST_TURNS),
            since: f64::NEG_INFINITY,
            knocked: None,
            quiet: 0.0,
        }
    }

    pub fn noise(&self) -> Noises {
        self.noise
    }

    /// How far a level may be from this one and be the same.
    pub fn nearness(&self) -> f64 {
        0.75 * Least::of(self.noise).slow
    }

    /// Takes a block, and the least noise that there is.
    pub fn step(&mut self, known: &Known, block: &Smooth, white: Noises) {
        self.noise.fast = white.fast;
        self.noise.slow = self.noise.slow.max(white.slow);
        let least = Least::of(self.noise);
        let off = Smooth {
            mean: block.mean - self.level,
            fast: block.fast - self.level,
            slow: block.slow - self.level,
            settled: block.settled - self.level,
            ..*block
        };
        if block.from < self.since + FOOT {
            // What is smoothed still holds what was before the turn.
            return self.excursion.gather(known, &off);
        }
        if self.excursion.is_followed(known, &off, least) {
            self.end(known, block.from);
        }
        if self.excursion.is_over(&off, least) {
            self.end(known, block.from);
        }
        self.excursion.add(known, &off, least);
        self.follow(&off);
    }

    /// Follows the noise, and the level, where there is no pulse.
    fn follow(&mut self, off: &Smooth) {
        if self.excursion.is_pulse {
            return;
        }
        let seconds = off.seconds;
        self.quiet += seconds;
        if self.quiet > 1.5 {
            let share = (seconds / NOISE_FOLLOWS).min(1.0);
            self.noise.slow += share * (1.25 * off.slow.abs() - self.noise.slow);
        }
        // A start may take a turned sensor back to the level, but neither for long nor at once.
        if self.quiet > SETTLED {
            self.turns.clear();
        } else if let Some(since) = self.knocked.filter(|_| self.quiet > FOOT) {
            self.turns.retain(|turn| turn.at + FOOT < since);
        }
        if self.quiet > SETTLED + 1.0 {
            // What is as far away as a shock is not of the level.
            let away = off.settled.clamp(-FAST.1, FAST.1);
            let step = (seconds / FOLLOWS).min(1.0) * away;
            self.level += step.clamp(-DRIFTS * seconds, DRIFTS * seconds);
        }
    }

    fn end(&mut self, known: &Known, now: f64) {
        if self.excursion.is_pulse {
            let since = self.excursion.part.from - 2.0 * FOOT;
            self.knocked = self.excursion.ends_at_once().then_some(since);
            if self.excursion.jump.by > 0.0 {
                self.turns.truncate(MOST_TURNS - 1);
                self.turns.push_front(self.turn());
            }
        }
        if let Some(pulse) = self.pulse(known, &self.excursion.part) {
            self.quiet = 0.0;
            self.hypotheses.take(known, &pulse);
        }
        self.excursion = self.excursion.next(now);
    }

    fn pulse(&self, known: &Known, part: &Part) -> Option<Turned> {
        self.excursion.pulse(known, part, self.noise.slow)
    }

    /// The current pulse so far. While it goes on, one that began at once may be another level.
    pub fn current(&self, known: &Known) -> Option<Turned> {
        let mut pulse = self.pulse(known, &self.excursion.part)?;
        if self.excursion.begins_at_once() {
            pulse.ignored = pulse.ignored.min(prices::AT_ONCE);
        }
        Some(pulse)
    }

    /// The largest change at once in the current pulse.
    fn turn(&self) -> Turn {
        let jump = self.excursion.jump;
        Turn {
            by: self.excursion.sign() * jump.by,
            at: jump.at,
            is_first: self.excursion.begins_at_once(),
            begun: jump.before,
            before: self.hypotheses.now.clone(),
        }
    }

    /// Itself on another level, to which a change at once that is not older than a time may have brought the record. What did
    /// not come at once may be a start, from the level to which that has brought it.
    pub fn turned(&self, level: f64, oldest: f64) -> Vec<Self> {
        let by = level - self.level;
        let mut turned = Vec::new();
        for turn in self.turns.iter().cloned().chain([self.turn()]) {
            let is_like = turn.by * by > 0.0 && is_at_once(turn.by, by, 0.0);
            if !is_like || by.abs() <= OVERSHOT * turn.by.abs() || turn.at < oldest {
                continue;
            }
            turned.push(self.after(&turn, level, 0.0));
            if (turn.by - by).abs() > self.nearness() && turn.by.abs() > BY_HAND {
                turned.push(self.after(&turn, self.level + turn.by, STARTS));
            }
        }
        turned
    }

    /// Itself on the level to which a turn has brought it, if that costs so much more.
    fn after(&self, turn: &Turn, level: f64, cost: f64) -> Self {
        let by = level - self.level;
        let shifted = |it: &Hypothesis| it.shifted(by, true).dearer(cost);
        let hypotheses: Vec<Hypothesis> = turn.before.iter().map(shifted).collect();
        Self {
            since: turn.at,
            excursion: Excursion::of(turn.begun),
            ..Self::new(level, self.noise, &hypotheses)
        }
    }

    /// When a pulse first began as if the sensor had been turned, if that neither went back to the level for long nor at once, s;
    /// infinite if none did.
    pub fn turned_at(&self) -> f64 {
        let is_now = self.excursion.is_pulse && self.excursion.begins_at_once();
        let now = is_now.then_some(self.excursion.jump.at);
        let first = self.turns.iter().filter(|turn| turn.is_first);
        let times = first.map(|turn| turn.at).chain(now);
        times.fold(f64::INFINITY, f64::min)
    }

    /// For how long there has been no pulse, s.
    pub fn quiet(&self) -> f64 {
        if self.excursion.is_pulse {
            0.0
        } else {
            self.quiet
        }
    }

    /// Whether no pulse is going on, nor was lately.
    pub fn is_settled(&self) -> bool {
        self.quiet() > 1.0
    }

    /// Whether a pulse has been going on since a time.
    pub fn is_in_pulse_since(&self, time: f64) -> bool {
        self.excursion.is_pulse && self.excursion.part.from <= time
    }

    /// Whether a pulse has been going on since a time that may be this level, which was not tried before; it is from now on.
    pub fn doubts(&mut self, time: f64, level: f64) -> bool {
        let is_near = |other: f64| (other - level).abs() < self.nearness();
        let doubts = self.is_in_pulse_since(time) && !self.excursion.instead.is_some_and(is_near);
        if doubts {
            self.excursion.instead = Some(level);
        }
        doubts
    }

    /// Somebody may have the sensor in hand: after a swing it has not come back to the level for some time.
    pub fn hand(&self) -> Option<Hand> {
        let it = &self.excursion;
        let is_off = it.is_pulse && it.part.seconds > OFF;
        let mut swings = self.hypotheses.swings();
        let swing = swings.find(|swing| it.part.from - swing.1 < AFTER_SWING);
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
        self.turns.clear();
        (self.since, self.knocked) = (f64::NEG_INFINITY, None);
        self.excursion = Excursion::default();
        self.quiet = 0.0;
    }
}
