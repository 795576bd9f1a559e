//! Watching a lift, sample by sample: the state machine that [^1] was written for, with a decision at
//! every moment, memory of constant size, and a whitening filter and reference X that are learnt again at
//! every rest.
//!
//! # The flow
//! samples → blocks → pulses of acceleration → hypotheses → state → [`Event`]s, and blocks → whitened blocks → a
//! decision at every block, by sequential ranks or on (X, Y₁, Y₂). [`Monitor::step`] does all of it; reading a file is a
//! loop over it.
//!
//! # What it says
//! An accelerometer cannot tell a cage that stands from one that moves uniformly; it shows pulses, and a motion is
//! pulses whose changes of speed sum to zero. So a monitor follows all plausible explanations of the pulses so far
//! (`hypothesis`) on all plausible levels of the sensor (`track`, `live`), with the costs of [`crate::explain`]. It
//! says what all plausible ones agree on (`statement`), and otherwise `unknown` and why. `rest` is said only where none
//! moves; `slack` is raised unless all do.
//!
//! # Scope of the exact level
//! Ranks alarm at most α times per block of rest, on average, if the whitened blocks are exchangeable. In a real lift they
//! are only nearly so: people move, the filter is fitted, some colour is left. A single decision on three samples keeps its
//! level α on the same condition, but neighbouring ones share most of their blocks, so that α does not determine how many
//! times an hour they go wrong. Both can be counted at rest (`liftsim detect` prints it); the time between false motions is
//! simulated (`configs/ride_*.toml`).
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
mod decisions;
mod design;
mod drum;
mod event;
mod excursion;
mod history;
mod hypotheses;
mod hypothesis;
mod live;
mod noise;
mod prices;
mod ranked;
mod recent;
mod reference;
mod running;
mod saved_state;
mod sensor;
mod settings;
mod statement;
#[cfg(test)]
mod tests;
mod track;

pub use decisions::Observation;
pub use design::Design;
pub use event::{
    Alarm, Decided, Decision, Direction, Doubt, Event, Fault, Kind, RankDecision, Span, State,
};
pub use reference::Reference;
pub use running::{Running, RunningError};
pub use saved_state::{SavedState, SavedStateError};
pub use sensor::SET_BACK;
pub use settings::{
    DecisionRule, Level, Limits, MOST_ORDER, Settings, SettingsError, Sizes, Whitening,
};

use crate::explain::{Block, Blocks, Prior};
use crate::recording::Sample;
pub(crate) use decide::{Decider, Verdict};
use decisions::Decisions;
use drum::Drum;
use hypothesis::Hypothesis;
use live::{Belief, Live};
use prices::Known;
pub(crate) use ranked::Ranked;
use sensor::{Health, Sensor};
use serde::{Deserialize, Serialize};
pub(crate) use settings::LEAST_TRAINING;
use statement::Statement;

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

/// A monitor of one cage.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Monitor {
    decisions: Decisions,
    blocks: Blocks,
    live: Live,
    sensor: Sensor,
    /// Whether the noise hides a start.
    is_noisy: bool,
    /// Whether motions of this cage look different from rest.
    motion_shows: bool,
    said: Statement,
    /// Whether rest was told since the record began, or went on after a hole.
    knows_rest: bool,
    /// When the record began, or went on after a hole, s.
    begun: f64,
    /// When a motion was last told with its direction, s.
    last_told: (f64, Option<Direction>),
    /// The level when it was last certain, m/s².
    level: Option<f64>,
    /// Time of the last sample, s.
    last: Option<f64>,
    /// The newest block, if a sample has just completed it.
    newest: Option<Observation>,
    drum: Drum,
    /// The latest jam that was told, s.
    jam: f64,
    #[serde(skip)]
    events: Vec<Event>,
}

/// The error of a speed as a share of the highest. Start and stop are measured by one sensor, whose gain cancels.
const GAIN_ERROR: f64 = 0.015;

/// What it costs that a record begins in motion.
const BEGINS_IN_MOTION: f64 = 3.0;

/// The deviation of the smoothed record in which starts are not seen, m/s², and below which they are again.
const NOISY: (f64, f64) = (0.1, 0.08);

/// A sensor was moved if its level jumps by this much, m/s².
const MOVED: f64 = 0.15;

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
                ..Prior::default()
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
        Self {
            blocks: Blocks::new(design.samples.decimation(), design.block),
            live: Live::new(known, design.block, begins, level),
            sensor: Sensor::new(1.0 / design.rate),
            is_noisy: false,
            motion_shows: knowledge.motion_shows && knowledge.reference.is_some(),
            said: Statement::unknown(0.0, Doubt::Beginning),
            knows_rest: knowledge.begins_at_rest,
            begun: f64::NEG_INFINITY,
            last_told: (f64::NEG_INFINITY, None),
            level: None,
            last: None,
            newest: None,
            drum: Drum::default(),
            jam: f64::NEG_INFINITY,
            events: Vec::with_capacity(8),
            decisions: Decisions::new(design, knowledge.reference),
        }
    }

    /// Tells it, before the first sample, that the cage moves.
    pub fn begin_in_motion(&mut self) {
        self.live.begin(vec![Hypothesis::moving(0.0)]);
    }

    /// The settings, at the rate of the samples.
    pub fn design(&self) -> &Design {
        &self.decisions.design
    }

    /// The reference of rest, if it has one.
    pub fn reference(&self) -> Option<&Reference> {
        self.decisions.reference.as_ref()
    }

    /// The event before the first sample, which is taken at `time`.
    pub fn beginning(&self, time: f64) -> Event {
        Statement::unknown(time, Doubt::Beginning).event(None, time)
    }

    /// The current state of the cage.
    pub fn state(&self) -> State {
        self.said.state
    }

    /// For how long nothing has left the sensor's level, s: the cage stands or moves uniformly.
    #[inline]
    pub fn quiet(&self) -> f64 {
        self.live.quiet()
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
        if self.last.replace(now).is_none() {
            self.begun = now + self.design().block;
        }
        let health = self.sensor.step(sample);
        if health.begins.is_some() || health.ends {
            self.take_health(health, now);
        }
        if let Some(block) = self.blocks.step(sample) {
            self.block(block, &health);
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
            (self.drum, self.jam) = (Drum::default(), f64::NEG_INFINITY);
            self.last_told = (f64::NEG_INFINITY, None);
        }
        self.say(Statement::unknown(now, Doubt::Hole), now);
    }

    fn forget(&mut self, now: f64, seconds: f64) {
        // A clock that was set back hides a hole of unknown length.
        let seconds = if seconds > 0.0 {
            seconds
        } else {
            f64::INFINITY
        };
        self.live.cross(now, seconds);
        (self.knows_rest, self.begun) = (false, now + self.design().block);
        self.decisions.forget();
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

    fn block(&mut self, block: Block, health: &Health) {
        self.newest = self.decisions.step(block);
        if health.fault.is_some() {
            return;
        }
        self.live.step(block);
        let is_calm = self.motion_shows.then(|| self.decisions.is_calm());
        let belief = self.live.belief(is_calm);
        let now = block.to;
        let was_blind = self.is_blind();
        self.judge_noise(&belief, now);
        self.judge_hand(now);
        let statement = if was_blind || self.is_blind() {
            Statement::unknown(now, Doubt::Sensor)
        } else {
            self.confirmed(Statement::of(&belief, self.knows_rest, now), now)
        };
        self.alarm_of_jam(&statement, now);
        self.say(
            if health.is_proven {
                statement
            } else {
                Statement::unknown(now, Doubt::Beginning)
            },
            now,
        );
        self.judge_level(&belief, now);
        if belief.in_pulse {
            self.decisions.learn_no_earlier();
        }
        if self.said.state == State::REST {
            self.decisions.learn(self.said.since);
        }
    }

    /// A motion that begins is told only once a decision was for it since its start, where decisions can be made.
    fn confirmed(&self, statement: Statement, now: f64) -> Statement {
        let is_new = !self.said.state.moves();
        match statement.start {
            Some(start) if is_new && !self.decisions.agree_since(start) => {
                Statement::unknown(now, Doubt::Pulse)
            }
            _ => statement,
        }
    }

    /// Reports a statement that differs from the last.
    fn say(&mut self, statement: Statement, now: f64) {
        let was = self.said;
        self.said = statement;
        self.knows_rest |= statement.state == State::REST;
        if (was.state, was.direction) == (statement.state, statement.direction) {
            return;
        }
        if was.state.moves() && !statement.state.moves() {
            self.decisions.begin_again();
        }
        let mut decision = match statement.braking {
            Some(braking) if statement.state == State::REST => self.decisions.at_stop(braking),
            _ if !was.state.moves() && statement.state.moves() => self
                .decisions
                .at_start(statement.start, statement.direction),
            _ => None,
        };
        let (told, way) = self.last_told;
        let is_new = |start: &Statement| start.since > told || start.direction != way;
        let has_begun = |start: &Statement| start.since > self.begun;
        let start = statement.start_of_motion().filter(has_begun);
        if let Some(start) = start.filter(is_new) {
            self.events.push(start.event(decision.take(), now));
        }
        if statement.direction.is_some() {
            self.last_told = (now, statement.direction);
        }
        self.events.push(statement.event(decision, now));
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

    /// Whether nothing can be known for now.
    fn is_blind(&self) -> bool {
        self.is_noisy || self.live.is_in_hand()
    }

    fn judge_hand(&mut self, now: f64) {
        let was = self.live.is_in_hand();
        self.live.judge_hand(now);
        match (was, self.live.is_in_hand()) {
            (false, true) => {
                self.level = None;
                self.report(Fault::Moved, now, now);
            }
            (true, false) => self.decisions.forget(),
            _ => {}
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

    /// Raises the alarm if the drum pays out rope for too long and the cage may stand.
    fn watch_drum(&mut self, now: f64, turns: bool) {
        let longest = self.design().settings.monitor.longest_slack;
        let Statement { state, rest, .. } = self.said;
        let slack = (self.drum).step(now, turns, state.moves(), rest, longest);
        if let Some(since) = slack {
            self.alarm(Alarm::Slack, since, now, state == State::REST);
        }
    }
}
