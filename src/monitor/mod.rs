//! Watching a lift, sample by sample: the state machine that [^1] was written for, with a decision at
//! every moment, memory of constant size, and a whitening filter and reference X that are learnt again at
//! every rest.
//!
//! # The flow
//! samples → blocks → pulses of acceleration → hypotheses → state → [`Event`]s, and blocks → whitened blocks → a
//! decision on (X, Y₁, Y₂) at every block. [`Monitor::step`] does all of it; reading a file is a loop over it.
//!
//! # What it says
//! An accelerometer cannot tell a cage that stands from one that moves uniformly; it shows pulses, and a motion is
//! pulses whose changes of speed sum to zero. So a monitor follows all plausible explanations of the pulses so far
//! (`hypothesis`) on all plausible levels of the sensor (`track`, `live`), with the costs of [`crate::explain`]. It
//! says what all plausible ones agree on (`statement`), and otherwise `unknown` and why. `rest` is said only where none
//! moves; `slack` is raised unless all do.
//!
//! # Scope of the exact level
//! Each single decision keeps its level α if the whitened blocks at rest are exchangeable. In a real lift they
//! are only nearly so: people move, the filter is fitted, some colour is left. A monitor also makes twenty
//! decisions a second, each sharing most of its blocks with the one before, while X stays the same for
//! seconds. So α determines neither the number of wrong decisions nor that of false motions in an hour. The
//! rate at rest can be counted (`liftsim detect` prints it), and the time between false motions is simulated
//! (`configs/ride_*.toml`).
//!
//! ```
//! use liftsim::monitor::{Knowledge, Monitor, Settings};
//! use liftsim::recording::Sample;
//!
//! let mut monitor = Monitor::new(Settings::default().at(100.0)?, Knowledge::default());
//! for i in 0..1000 {
//!     let acceleration = 9.81 + 0.01 * f64::from(i * 7919 % 101 - 50) / 50.0;
//!     let sample = Sample { time: f64::from(i) * 0.01, acceleration };
//!     // Without a reference of rest a monitor cannot know that this cage stands.
//!     assert!(monitor.step(sample, None).is_empty());
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [^1]: see [`crate::signal`].

mod decide;
mod design;
mod event;
mod history;
mod hypotheses;
mod hypothesis;
mod live;
mod noise;
mod reference;
mod saved_state;
mod sensor;
mod settings;
mod statement;
#[cfg(test)]
mod tests;
mod track;

pub use design::Design;
pub use event::{Alarm, Decision, Direction, Doubt, Event, Fault, Kind, Span, State};
pub use reference::Reference;
pub use saved_state::{SavedState, SavedStateError};
pub use sensor::SET_BACK;
pub use settings::{Level, Limits, MOST_ORDER, Settings, SettingsError, Sizes, Whitening};

use crate::explain::{Block, Blocks, Prior};
use crate::recording::Sample;
use decide::Windows;
pub(crate) use decide::{Decider, Verdict};
use history::History;
use hypothesis::{Hypothesis, Known};
use live::{Belief, Live};
use sensor::{Health, Sensor};
use serde::{Deserialize, Serialize};
pub(crate) use settings::LEAST_TRAINING;
use statement::Statement;
use std::ops::Range;

/// Knowledge of a cage before its record begins.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Knowledge {
    /// Its reference of rest.
    pub reference: Option<Reference>,
    /// Whether it stands when the record begins.
    pub begins_at_rest: bool,
    /// Whether its motions look different from rest, so that blocks like rest are evidence of rest.
    pub motion_shows: bool,
}

/// A block and its decision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observation {
    /// Times of its first and last sample, s.
    pub times: (f64, f64),
    /// The mean as measured, m/s².
    pub mean: f64,
    /// The mean centred and whitened, m/s².
    pub whitened: f64,
    /// Whether the forward decision is H₁*, once there are enough blocks.
    pub moves: Option<bool>,
}

/// A monitor of one cage.
#[derive(Clone, Debug)]
pub struct Monitor {
    design: Design,
    reference: Option<Reference>,
    blocks: Blocks,
    history: History,
    decider: Decider,
    live: Live,
    sensor: Sensor,
    /// Whether the noise hides a start.
    is_noisy: bool,
    /// Whether motions of this cage look different from rest, and the mean square of whitened blocks, in that of the
    /// reference.
    motion_shows: bool,
    strength: f64,
    said: Statement,
    /// The last time that the decision was H₁*, or could not be made, s.
    moved: f64,
    /// The level when it was last certain, m/s².
    level: Option<f64>,
    /// Time of the last sample, s.
    last: Option<f64>,
    /// The first block that the next reference may be learnt from.
    learns_from: u64,
    /// The newest block, if a sample has just completed it.
    newest: Option<Observation>,
    /// Since when the drum turns, s, and since when it does so beside a cage that may stand.
    turns: Option<f64>,
    slack: Option<f64>,
    is_slack_told: bool,
    /// The latest jam that was told, s.
    jam: f64,
    events: Vec<Event>,
}

/// The longest braking whose decision is made, s.
const LONGEST_BRAKING: f64 = 60.0;

/// The error of a speed as a share of the highest. Start and stop are measured by one sensor, whose gain cancels.
const GAIN_ERROR: f64 = 0.015;

/// What it costs that a record begins in motion.
const BEGINS_IN_MOTION: f64 = 3.0;

/// The deviation of the smoothed record in which starts are not seen, m/s², and below which they are again.
const NOISY: (f64, f64) = (0.1, 0.08);

/// Blocks look like rest if their mean square is at most this many times that of the reference; it is followed over
/// this time, s, and single ones count for at most so much.
const CALM: (f64, f64, f64) = (2.0, 2.0, 9.0);

/// A sensor was moved if its level jumps by this much, m/s².
const MOVED: f64 = 0.15;

/// By how much a slack alarm may go back before the doubt, s.
const LOOKS_BACK: f64 = 1.5;

impl Monitor {
    /// A monitor with this knowledge of its cage.
    pub fn new(design: Design, knowledge: Knowledge) -> Self {
        let limits = &design.settings.monitor;
        let known = Known {
            prior: Prior {
                least_speed: limits.least_speed,
                most_acceleration: limits.most_acceleration,
                longest_motion: limits.longest_motion,
                gain_error: GAIN_ERROR,
                begins_at_rest: None,
            },
            soft: limits.least_acceleration,
        };
        let begins = if knowledge.begins_at_rest {
            vec![Hypothesis::rest(0.0, 0.0)]
        } else {
            vec![
                Hypothesis::rest(0.0, 0.0),
                Hypothesis::open(0.0, BEGINS_IN_MOTION),
            ]
        };
        let level = knowledge
            .reference
            .as_ref()
            .map(|reference| reference.level);
        let (samples, block) = (&design.samples, design.block);
        let learnt = design.settings.whitening.training + samples.reference() + samples.shift();
        let looked_back = 4 * samples.span() + (LONGEST_BRAKING / block) as usize;
        Self {
            blocks: Blocks::new(samples.decimation(), block),
            history: History::new(learnt.max(looked_back)),
            decider: Decider::new(&design),
            live: Live::new(known, block, begins, level),
            sensor: Sensor::default(),
            is_noisy: false,
            motion_shows: knowledge.motion_shows && knowledge.reference.is_some(),
            strength: CALM.2,
            said: Statement::unknown(0.0, Doubt::Beginning),
            moved: f64::NEG_INFINITY,
            level: None,
            last: None,
            learns_from: 0,
            newest: None,
            turns: None,
            slack: None,
            is_slack_told: false,
            jam: f64::NEG_INFINITY,
            events: Vec::with_capacity(8),
            reference: knowledge.reference,
            design,
        }
    }

    /// Tells it, before the first sample, that the cage moves.
    pub fn begin_in_motion(&mut self) {
        self.live.begin(vec![Hypothesis::moving(0.0)]);
    }

    /// The settings, at the rate of the samples.
    pub fn design(&self) -> &Design {
        &self.design
    }

    /// The reference of rest, if it has one.
    pub fn reference(&self) -> Option<&Reference> {
        self.reference.as_ref()
    }

    /// The event before the first sample, which is taken at `time`.
    pub fn beginning(&self, time: f64) -> Event {
        Statement::unknown(time, Doubt::Beginning).event(time)
    }

    /// The current state of the cage.
    pub fn state(&self) -> State {
        self.said.state
    }

    /// The block that the last sample completed, if any.
    pub fn newest(&self) -> Option<&Observation> {
        self.newest.as_ref()
    }

    /// Takes the next sample and, if known, whether the drum turns; returns the new events. A time that is no number
    /// is passed over; one that lies before the last by a second or more is taken for a clock that was set back.
    #[inline]
    pub fn step(&mut self, sample: Sample, drum_turns: Option<bool>) -> &[Event] {
        self.events.clear();
        self.newest = None;
        let now = sample.time;
        if !(now.is_finite() && sample.acceleration.is_finite()) {
            return &self.events;
        }
        if self.sensor.is_set_back(now) {
            self.cross(now, now, Fault::Clock);
        } else if self.blocks.is_gap(now) {
            self.cross(self.last.unwrap_or(now), now, Fault::Silent);
        }
        self.last = Some(now);
        let health = self.sensor.step(sample);
        if health.begins.is_some() || health.ends {
            self.take_health(health, now);
        }
        if let Some(block) = self.blocks.step(sample) {
            self.block(block, health.fault.is_some());
        }
        if drum_turns.is_some() {
            self.watch_drum(now, drum_turns == Some(true));
        }
        &self.events
    }

    /// Handles a hole in the record: what the cage did in it is not known.
    fn cross(&mut self, from: f64, now: f64, fault: Fault) {
        self.report(fault, from, now);
        self.blocks.clear();
        self.sensor.cross();
        self.forget(now, (now - from).max(0.0));
        if fault == Fault::Clock {
            (self.turns, self.slack, self.jam) = (None, None, f64::NEG_INFINITY);
        }
        self.say(Statement::unknown(now, Doubt::Hole), now);
    }

    fn forget(&mut self, now: f64, seconds: f64) {
        // A clock that was set back hides a hole of unknown length.
        self.live.cross(
            now,
            if seconds > 0.0 {
                seconds
            } else {
                f64::INFINITY
            },
        );
        self.history.clear();
        self.moved = f64::NEG_INFINITY;
        self.learns_from = 0;
    }

    fn report(&mut self, fault: Fault, time: f64, now: f64) {
        self.events.push(Event {
            time,
            reported: now,
            kind: Kind::Sensor(fault),
        });
    }

    fn take_health(&mut self, health: Health, now: f64) {
        if let Some((fault, since)) = health.begins {
            self.report(fault, since, now);
            self.say(Statement::unknown(now, Doubt::Sensor), now);
        }
        if health.ends {
            self.blocks.clear();
            self.forget(now, f64::INFINITY);
        }
    }

    fn block(&mut self, block: Block, is_faulty: bool) {
        self.history.push(block, self.reference.as_ref());
        self.decide();
        if is_faulty {
            return;
        }
        self.live.step(block);
        let belief = self.live.belief(self.is_calm());
        let now = block.to;
        let was_noisy = self.is_noisy;
        self.judge_noise(&belief, now);
        let statement = if self.is_noisy || was_noisy {
            Statement::unknown(now, Doubt::Sensor)
        } else {
            self.confirmed(Statement::of(&belief, now), now)
        };
        self.alarm_of_jam(&statement, now);
        self.say(statement, now);
        self.judge_level(&belief, now);
        if belief.in_pulse {
            self.learns_from = self.history.end();
        }
        if self.said.state == State::REST {
            self.learns_from = self.learns_from.max(self.history.at(self.said.since));
            self.learn();
        }
    }

    /// A motion that begins is told only once a decision was H₁* since its start, where decisions can be made.
    fn confirmed(&self, statement: Statement, now: f64) -> Statement {
        let is_new = !self.said.state.moves();
        match statement.start {
            Some(start) if is_new && self.moved < start => Statement::unknown(now, Doubt::Pulse),
            _ => statement,
        }
    }

    /// Whether the record looks like rest, if motions of the cage do not.
    fn is_calm(&self) -> Option<bool> {
        self.motion_shows.then_some(self.strength < CALM.0)
    }

    /// Makes the decision at the newest block.
    fn decide(&mut self) {
        let Some(reference) = &self.reference else {
            self.moved = self.history.newest().0.to;
            return;
        };
        let windows = Windows::forwards(&self.design, self.history.end());
        let verdict = windows.and_then(|windows| {
            (self.decider).decide(&self.design, reference, &self.history, &windows)
        });
        let block = self.history.newest();
        let ratio = (block.1 / reference.deviation).powi(2).min(CALM.2);
        if ratio.is_finite() {
            self.strength += self.design.block / CALM.1 * (ratio - self.strength);
        }
        if verdict.as_ref().is_none_or(|verdict| verdict.moves) {
            self.moved = block.0.to;
        }
        self.newest = Some(Observation {
            times: (block.0.from, block.0.to),
            mean: block.0.mean,
            whitened: block.1,
            moves: verdict.map(|verdict| verdict.moves),
        });
    }

    /// The decision at a start, on the newest blocks, or at a stop, on its braking.
    fn decision(&mut self, braking: Option<(f64, f64)>) -> Option<Decision> {
        let reference = self.reference.as_ref()?;
        let windows = match braking {
            None => Windows::forwards(&self.design, self.history.end()),
            Some((from, to)) => {
                Windows::backwards(&self.design, self.history.at(from)..self.history.at(to))
            }
        }?;
        let verdict = (self.decider).decide(&self.design, reference, &self.history, &windows)?;
        let span = |blocks: &Range<u64>| {
            (
                self.history.starts(blocks.start),
                self.history.ends(blocks.end),
            )
        };
        let spans = [span(&windows.shift), span(&windows.scale)];
        Some(verdict.decision(&self.design, reference.span, spans))
    }

    /// Reports a statement that differs from the last.
    fn say(&mut self, statement: Statement, now: f64) {
        let was = self.said;
        self.said = statement;
        if was.state == statement.state {
            return;
        }
        let mut event = statement.event(now);
        let braking = statement.braking.filter(|_| statement.state == State::REST);
        let starts = !was.state.moves() && statement.state.moves();
        if let Kind::Change { decision, .. } = &mut event.kind
            && (starts || braking.is_some())
        {
            *decision = self.decision(braking);
        }
        self.events.push(event);
    }

    /// Raises the alarm if a shock has ended the motion, or may have.
    fn alarm_of_jam(&mut self, statement: &Statement, now: f64) {
        let Some(time) = statement.jam.filter(|time| *time > self.jam) else {
            return;
        };
        self.jam = time;
        self.alarm(
            Alarm::Jam,
            time.min(now),
            now,
            statement.state == State::REST,
        );
    }

    fn alarm(&mut self, alarm: Alarm, time: f64, reported: f64, certain: bool) {
        self.events.push(Event {
            time,
            reported,
            kind: Kind::Alarm { alarm, certain },
        });
    }

    fn judge_noise(&mut self, belief: &Belief, now: f64) {
        let was = self.is_noisy;
        self.is_noisy = belief.noise > if was { NOISY.1 } else { NOISY.0 };
        if self.is_noisy && !was {
            self.report(Fault::Noisy, now, now);
        }
        if was && !self.is_noisy {
            // Nothing that was seen in the noise counts.
            self.forget(now, f64::INFINITY);
        }
    }

    /// Reports a jump of the level where it is certain.
    fn judge_level(&mut self, belief: &Belief, now: f64) {
        if self.said.state == State::Unknown || belief.in_pulse {
            return;
        }
        let has_jumped = self
            .level
            .is_some_and(|level| (level - belief.level).abs() > MOVED);
        self.level = Some(belief.level);
        if has_jumped {
            self.report(Fault::Moved, now, now);
        }
    }

    /// Learns the filter and X again from the latest blocks, if the cage has stood quietly for long enough.
    fn learn(&mut self) {
        let samples = &self.design.samples;
        let needed = (self.design.settings.whitening.training + samples.reference()) as u64;
        // Leave out the newest blocks: they may belong to a start that is not seen yet.
        let to = self.history.end().saturating_sub(samples.shift() as u64);
        if to < self.learns_from + needed {
            return;
        }
        let Some(record) = self.history.blocks(to - needed..to) else {
            return;
        };
        let span = (record[0].from, record[record.len() - 1].to);
        let record: Vec<f64> = record.iter().map(|block| block.mean).collect();
        let learnt = Reference::from_rest(&record, span, &self.design);
        self.history.whiten(&learnt);
        self.reference = Some(learnt);
        self.learns_from = self.history.end();
    }

    /// Raises the alarm if the drum pays out rope for too long and the cage may stand.
    fn watch_drum(&mut self, now: f64, turns: bool) {
        if !turns || self.said.state.moves() {
            self.slack = None;
            self.is_slack_told = false;
            if !turns {
                self.turns = None;
            } else {
                self.turns.get_or_insert(now);
            }
            return;
        }
        let turns = *self.turns.get_or_insert(now);
        // Where the motion has become doubtful, the cage may have stood since before.
        let stands = self.said.rest.unwrap_or(now).clamp(now - LOOKS_BACK, now);
        let since = *self.slack.get_or_insert(stands.max(turns));
        let longest = self.design.settings.monitor.longest_slack;
        if now - since >= longest - 1e-9 && !self.is_slack_told {
            self.is_slack_told = true;
            self.alarm(Alarm::Slack, since, now, self.said.state == State::REST);
        }
    }
}
