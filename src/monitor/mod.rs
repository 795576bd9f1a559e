//! Watching a lift, sample by sample: the state machine that [^1] was written for, with a decision at
//! every moment, memory of constant size, and a whitening filter and reference X that are learnt again at
//! every rest.
//!
//! # The flow
//! samples → blocks → whitened blocks → a decision on (X, Y₁, Y₂) at every block, and pulses
//! of acceleration → state → [`Event`]s. [`Monitor::step`] does all of it; reading a file is a loop over it.
//!
//! # Scope of the exact level
//! Each single decision keeps its level α if the whitened blocks at rest are exchangeable. In a real lift they
//! are only nearly so: people move, the filter is fitted, some colour is left. A monitor also makes twenty
//! decisions a second, each sharing most of its blocks with the one before, while X stays the same for
//! seconds. So α determines neither the number of wrong decisions nor that of false motions in an hour. The
//! rate at rest can be counted (`liftsim detect` prints it), and the time between false motions is simulated
//! (`configs/ride_*.toml`).
//!
//! # Conditions on a motion beside the decision
//! Ranks do not measure size: a tilt of the floor by a milliradian is as significant as a start. So a motion
//! must also change the speed by `least_speed`, in one pulse of acceleration.
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
mod lift_state;
mod pulse;
mod reference;
mod saved_state;
mod settings;
mod step_input;
#[cfg(test)]
mod tests;

pub use design::Design;
pub use event::{Alarm, Decision, Direction, Event, Kind, Span, State};
pub use reference::Reference;
pub use saved_state::{SavedState, SavedStateError};
pub use settings::{Level, Limits, MOST_ORDER, Settings, SettingsError, Sizes, Whitening};

use crate::explain::{Block, Blocks};
use crate::recording::Sample;
use decide::Windows;
pub(crate) use decide::{Decider, Verdict};
use history::History;
use lift_state::LiftState;
use pulse::{Cusum, is_level};
use serde::{Deserialize, Serialize};
pub(crate) use settings::LEAST_TRAINING;
use step_input::StepInput;

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
    /// Whether the reference is known to come from rest.
    is_rest: bool,
    /// Whether the cage is known to stand when the record begins.
    begins_at_rest: bool,
    /// Whether motions of this cage have looked different from rest.
    motion_shows: bool,
    blocks: Blocks,
    history: History,
    decider: Decider,
    /// The sums for up and down.
    cusums: [Cusum; 2],
    cage: LiftState,
    /// The first block that the next reference may be learnt from.
    learns_from: u64,
    /// The number of motions in a row that looked different from rest.
    shown: u32,
    /// Whether a motion has shown signs of a high-pass filter.
    is_high_passed: bool,
    /// The newest block, if a sample has just completed it.
    newest: Option<Observation>,
    /// The number of blocks in which the cage stood while the drum turned.
    slack: u64,
    events: Vec<Event>,
}

/// The longest start or braking, s. A longer pulse is a change of level.
const LONGEST_PULSE: f64 = 60.0;

/// The number of motions in a row that must look different from rest before blocks like rest are evidence.
const MOTIONS_TO_TRUST: u32 = 2;

impl Monitor {
    /// A monitor with this knowledge of its cage.
    pub fn new(design: Design, knowledge: Knowledge) -> Self {
        let Knowledge {
            reference,
            begins_at_rest,
            motion_shows,
        } = knowledge;
        let drift = design.settings.monitor.least_acceleration / 2.0;
        let patience = design.samples.shift();
        let cusum = |sign| Cusum::new(sign, drift, patience);
        let learnt = design.settings.whitening.training + design.samples.reference() + patience;
        let looked_back = 4 * design.samples.span() + (LONGEST_PULSE / design.block) as usize;
        Self {
            is_rest: reference.is_some(),
            reference,
            begins_at_rest,
            motion_shows,
            blocks: Blocks::new(design.samples.decimation(), design.block),
            history: History::new(learnt.max(looked_back)),
            decider: Decider::new(&design),
            cusums: [cusum(1.0), cusum(-1.0)],
            cage: LiftState::unknown(0),
            learns_from: 0,
            shown: 0,
            is_high_passed: false,
            newest: None,
            slack: 0,
            events: Vec::new(),
            design,
        }
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
        self.cage.change(time, time, None)
    }

    /// The current state of the cage.
    pub fn state(&self) -> State {
        self.cage.state()
    }

    /// Whether a motion has shown signs of a sensor behind a high-pass filter: pulses that decay and overshoot.
    pub fn is_high_passed(&self) -> bool {
        self.is_high_passed
    }

    /// The block that the last sample completed, if any.
    pub fn newest(&self) -> Option<&Observation> {
        self.newest.as_ref()
    }

    /// Takes the next sample and, if known, whether the drum turns; returns the new events.
    #[inline]
    pub fn step(&mut self, sample: Sample, drum_turns: Option<bool>) -> &[Event] {
        self.events.clear();
        self.newest = None;
        if self.blocks.is_gap(sample.time) {
            self.blocks.clear();
            self.lose_track(sample.time);
        }
        if let Some(block) = self.blocks.step(sample) {
            self.block(block);
            self.watch_drum(block.to, drum_turns);
        }
        &self.events
    }

    /// Handles a gap in the record: the reference stays, the state of the cage becomes unknown.
    fn lose_track(&mut self, time: f64) {
        self.history.clear();
        self.cusums.iter_mut().for_each(Cusum::reset);
        self.learns_from = 0;
        self.begins_at_rest = false;
        let state = self.cage.state();
        self.cage = LiftState::unknown(0);
        if state != State::Unknown {
            self.events.push(self.cage.change(time, time, None));
        }
    }

    fn block(&mut self, block: Block) {
        self.history.push(block, self.reference.as_ref());
        let now = self.history.end();
        if self.reference.is_some() {
            self.decide_block(now, &block);
            self.doubt_level(now, &block);
        }
        self.learn(now);
    }

    /// Makes the decision at a block and updates the pulses and the state.
    fn decide_block(&mut self, now: u64, block: &Block) {
        let Some(reference) = &self.reference else {
            return;
        };
        let excess = block.mean - reference.level;
        let ended =
            (self.cusums.each_mut()).map(|cusum| cusum.step(now - 1, excess, block.seconds));
        let windows = Windows::forwards(&self.design, now);
        let verdict = windows.as_ref().and_then(|windows| {
            (self.decider).decide(&self.design, reference, &self.history, windows)
        });
        self.newest = Some(Observation {
            times: (block.from, block.to),
            mean: block.mean,
            whitened: self.history.newest(),
            moves: verdict.map(|verdict| verdict.moves),
        });
        let (Some(windows), Some(verdict)) = (windows, verdict) else {
            return;
        };
        let mut input = StepInput {
            design: &self.design,
            history: &self.history,
            reference,
            calm_is_rest: self.is_rest && self.motion_shows,
            begins_at_rest: self.is_rest && self.begins_at_rest,
            decider: &mut self.decider,
            cusums: &self.cusums,
            ended,
            windows,
            verdict,
            now,
            time: block.to,
        };
        let was = self.cage;
        self.cage = was.step(&mut input, &mut self.events);
        self.remember(was, now);
    }

    /// Handles a pulse that does not end: the level of the sensor has changed, and the state becomes unknown.
    fn doubt_level(&mut self, now: u64, block: &Block) {
        let longest = (LONGEST_PULSE / self.design.block) as u64;
        let mut pulses = self.cusums.iter().filter_map(Cusum::pulse);
        if pulses.any(|pulse| now - pulse.onset > longest) {
            self.lose_track(block.to);
            self.reference = None;
            self.is_rest = false;
        }
    }

    /// Learns from a change of state whether motions of this cage look different from rest.
    fn remember(&mut self, was: LiftState, now: u64) {
        self.is_high_passed |= self.cage.decays();
        if self.cage.state() != was.state() {
            self.learns_from = now;
        }
        if self.cage != LiftState::Rest {
            return;
        }
        self.begins_at_rest = false;
        let enough = 2 * self.design.samples.reference() as u64;
        if let Some(looks_like_rest) = was.looks_like_rest(enough) {
            self.shown = if looks_like_rest { 0 } else { self.shown + 1 };
            self.motion_shows = self.shown >= MOTIONS_TO_TRUST;
        }
    }

    /// Learns the filter and X again from the latest blocks, if there are enough of them: while the cage stands,
    /// or, without a better reference, while the state is unknown.
    fn learn(&mut self, now: u64) {
        let samples = &self.design.samples;
        let needed = (self.design.settings.whitening.training + samples.reference()) as u64;
        // Leave out the newest blocks: they may belong to a start that is not detected yet.
        let lag = samples.shift() as u64;
        if now < self.learns_from + needed + lag || self.cage.state().moves() {
            return;
        }
        // A new level would distort a current pulse, which was measured from the old one.
        if self.cusums.iter().any(|cusum| cusum.pulse().is_some()) {
            return;
        }
        let stands = self.cage == LiftState::Rest;
        let blocks = now - lag - needed..now - lag;
        let Some(record) = self.history.blocks(blocks.clone()) else {
            return;
        };
        let record: Vec<f64> = record.iter().map(|block| block.mean).collect();
        // If learning fails, do not retry at every block.
        self.learns_from += needed / 4;
        let drift = self.design.settings.monitor.least_acceleration / 2.0;
        let bound = self.design.settings.monitor.least_speed / 2.0;
        if !is_level(&record, drift, self.design.block, bound) {
            return;
        }
        let span = (
            self.history.starts(blocks.start),
            self.history.ends(blocks.end),
        );
        let learnt = Reference::from_rest(&record, span, &self.design);
        // A reference of rest is replaced only by another one, or when the sensor has been moved.
        let fits = |known: &Reference| (learnt.level - known.level).abs() < drift;
        if !stands && self.is_rest && self.reference.as_ref().is_some_and(fits) {
            return;
        }
        self.history.whiten(&learnt);
        self.reference = Some(learnt);
        // Knowledge of the beginning applies only to blocks from the beginning.
        self.is_rest = stands || (self.begins_at_rest && blocks.start == 0);
        self.learns_from = now;
    }

    /// Raises the alarm if the cage stands while the rope is paid out.
    fn watch_drum(&mut self, time: f64, drum_turns: Option<bool>) {
        let is_slack = drum_turns == Some(true) && self.cage == LiftState::Rest;
        self.slack = if is_slack { self.slack + 1 } else { 0 };
        let longest = self.design.settings.monitor.longest_slack;
        if self.slack == (longest / self.design.block).ceil() as u64 {
            self.events.push(Event {
                time: time - longest,
                reported: time,
                kind: Kind::Alarm(Alarm::Slack),
            });
        }
    }
}
