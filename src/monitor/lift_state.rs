//! The state of the cage, after the sequences of [^1]: rest → acceleration → inertial motion is a start,
//! inertial motion → braking → rest a stop.
//!
//! A pulse of acceleration measures a change of speed; the decision on X, Y₁ and Y₂ says whether noise can
//! explain it. Both are needed. Between pulses rest and smooth motion look alike, so the state is remembered;
//! if it was never observed, it is unknown.
//!
//! # Leaving the unknown state
//! Vibration alone is not reliable: people who get in may shake a cage more than a motion does. The state
//! becomes known by, in this order:
//!
//! - blocks like the reference of rest, if motions of this cage have looked different from rest, or if the
//!   record is known to begin at rest;
//! - a reversal. A motion at one speed leaves two pulses that cancel. Take three pulses with signs + − −, of
//!   which the first two cancel and the last is at least half as strong: the cage stood after the second,
//!   otherwise it would have two different speeds at rest. So it moves now; after − − + it stands now. Any
//!   other pulse in between, a weak one or a shock, restarts the count;
//! - no pulse for as long as the longest motion takes.
//!
//! | state | ends when |
//! |---|---|
//! | unknown | see above |
//! | rest | a pulse changes the speed enough, and the decision forwards is H₁* with its sign |
//! | acceleration | the pulse ends |
//! | inertial | a pulse against the motion takes half of its speed, or as much as the slowest motion has |
//! | braking | the pulse has ended, no speed is left, and the decision backwards says that it was a stop; or some is left, and the cage creeps on |
//!
//! A braking that takes more speed than there was contradicts the state, which becomes unknown. The same
//! happens after a motion longer than the longest, after a gap, and when a pulse does not end because the
//! level of the sensor has changed.
//!
//! A pulse stronger than any acceleration of a lift does not start a motion: at rest it is a shock, or, if it
//! lasts, the sensor is being carried. In motion and against it, it is a jam if it takes half of the speed, or
//! if the backward decision says that the vibration of motion has ended with it (a saturated sensor does not
//! measure all of the lost speed); otherwise it was a shock, and the motion continues.
//!
//! [^1]: see [`crate::signal`].

use super::event::{Alarm, Decision, Direction, Event, Kind, State};
use super::pulse::Pulse;
use super::step_input::StepInput;
use crate::signal;

/// A shock longer than this, s, means that the sensor is being handled.
const LONGEST_SHOCK: f64 = 0.5;

/// The state of the cage, with the memory that its transitions need.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum LiftState {
    Unknown(Unknown),
    Rest,
    Moving(Motion),
}

/// The unknown state, with the evidence gathered so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Unknown {
    /// The first block without a pulse.
    still_since: u64,
    /// The block after the last one whose forward decision was H₁*.
    calm_since: u64,
    /// The last two pulses, the older first.
    pulses: [Option<Pulse>; 2],
}

/// A current motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Motion {
    /// +1 up, −1 down.
    sign: f64,
    /// The speed according to the pulses, m/s.
    speed: f64,
    /// The highest speed so far, m/s.
    top_speed: f64,
    /// Its start, s.
    start: f64,
    /// Blocks of inertial motion.
    inertial: u64,
    /// The number of latest inertial blocks in a row with the forward decision H₀*.
    calm: u64,
    /// Whether it has looked like rest for N blocks at any time.
    looks_like_rest: bool,
    /// The pulse that began it, once it has ended.
    first: Option<Pulse>,
    /// Whether its pulses are those of a sensor behind a high-pass filter.
    decays: bool,
    phase: Phase,
}

/// The phase of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Phase {
    Accelerating,
    Inertial,
    Braking,
    /// A pulse has ended that may have been the last.
    Stopping(Pulse),
}

impl LiftState {
    /// The unknown state from block `now` on, without evidence.
    pub fn unknown(now: u64) -> Self {
        Self::Unknown(Unknown {
            still_since: now,
            calm_since: now,
            pulses: [None; 2],
        })
    }

    /// The state without its memory.
    pub fn state(&self) -> State {
        match self {
            Self::Unknown(_) => State::Unknown,
            Self::Rest => State::Known(signal::Phase::Rest),
            Self::Moving(motion) => State::Known(match motion.phase {
                Phase::Accelerating => signal::Phase::Accelerating,
                Phase::Inertial => signal::Phase::Inertial,
                Phase::Braking | Phase::Stopping(_) => signal::Phase::Braking,
            }),
        }
    }

    /// Whether the current motion has looked like rest; `None` unless it has at least `blocks` inertial blocks.
    pub fn looks_like_rest(&self, blocks: u64) -> Option<bool> {
        let motion = self.motion().filter(|motion| motion.inertial >= blocks);
        motion.map(|motion| motion.looks_like_rest)
    }

    /// Whether the pulses of the current motion are those of a sensor behind a high-pass filter.
    pub fn decays(&self) -> bool {
        self.motion().is_some_and(|motion| motion.decays)
    }

    fn motion(&self) -> Option<&Motion> {
        match self {
            Self::Moving(motion) => Some(motion),
            Self::Unknown(_) | Self::Rest => None,
        }
    }

    /// The event of a change to this state at `time`, reported at `reported`.
    pub fn change(&self, time: f64, reported: f64, decision: Option<Decision>) -> Event {
        let motion = self.motion();
        let kind = Kind::Change {
            state: self.state(),
            direction: motion.map(|motion| Direction::of(motion.sign)),
            speed: motion.map(|motion| motion.speed),
            decision,
        };
        Event {
            time,
            reported,
            kind,
        }
    }

    /// The state after the newest block; changes and alarms are added to `events`.
    pub fn step(self, input: &mut StepInput, events: &mut Vec<Event>) -> Self {
        let (next, time, decision) = match self {
            Self::Unknown(unknown) => unknown.step(input, events),
            Self::Rest => start(input),
            Self::Moving(motion) => motion.step(input, events),
        };
        if next.state() != self.state() {
            events.push(next.change(time, input.time, decision));
        }
        next
    }
}

/// The next state, the time of its start, and the decision behind it.
type Next = (LiftState, f64, Option<Decision>);

impl Unknown {
    fn step(mut self, input: &StepInput, events: &mut Vec<Event>) -> Next {
        if input.verdict.moves {
            self.calm_since = input.now;
        }
        let calm = input.now - self.calm_since;
        let stands_still = input.begins_at_rest && self.pulses == [None; 2];
        if (input.calm_is_rest || stands_still) && calm >= input.reference_length() {
            let seen = self.calm_since.saturating_sub(input.scale_length());
            return (LiftState::Rest, input.starts(seen), None);
        }
        for pulse in input.ended.into_iter().flatten() {
            if let Some(next) = self.take(&pulse, input, events) {
                return next;
            }
        }
        let still = (input.now - self.still_since) as f64 * input.design.block;
        let next = if still > input.longest_motion() {
            LiftState::Rest
        } else {
            LiftState::Unknown(self)
        };
        (next, input.time, None)
    }

    /// Takes a completed pulse and returns the state that it and the last two pulses prove, if any.
    fn take(&mut self, pulse: &Pulse, input: &StepInput, events: &mut Vec<Event>) -> Option<Next> {
        let c = input.whole(pulse);
        if c.speed < input.least_speed() / 2.0 {
            return None;
        }
        self.still_since = input.now;
        if !Self::is_significant(&c, input) {
            self.pulses = [None; 2];
            return None;
        }
        let cancel = |a: &Pulse, b: &Pulse| {
            let largest = a.speed.max(b.speed);
            (a.change() + b.change()).abs() <= input.rounding(largest)
        };
        let [before, last] = self.pulses;
        self.pulses = [last, Some(c)];
        let (a, b) = (before?, last?);
        if b.sign == c.sign && cancel(&a, &b) && c.speed >= b.speed / 2.0 {
            let motion = Motion::from_pulse(&c, input.starts(c.onset));
            events.push(LiftState::Moving(motion).change(motion.start, input.time, None));
            return Some(motion.on(Phase::Inertial, input.ends(c.end)));
        }
        let stands = a.sign == b.sign && cancel(&b, &c) && a.speed >= b.speed / 2.0;
        stands.then(|| (LiftState::Rest, input.ends(c.end), None))
    }

    /// Whether a pulse that has ended is more than noise, sway or a shock.
    fn is_significant(pulse: &Pulse, input: &StepInput) -> bool {
        let is_decided = input.verdict.moves && input.verdict.sign == pulse.sign;
        is_decided && pulse.speed >= input.least_speed() && !input.is_violent(pulse)
    }
}

/// The transition from rest.
fn start(input: &mut StepInput) -> Next {
    let stay = (LiftState::Rest, input.time, None);
    let under_way = [1.0, -1.0].into_iter().filter_map(|sign| input.pulse(sign));
    let Some(pulse) = under_way
        .filter(|pulse| pulse.speed >= input.least_speed())
        .max_by(|a, b| a.speed.total_cmp(&b.speed))
    else {
        return stay;
    };
    let start = input.starts(pulse.onset);
    if input.is_violent(&pulse) {
        let is_carried = input.lasts(&pulse) > LONGEST_SHOCK;
        return if is_carried {
            (LiftState::unknown(input.now), start, None)
        } else {
            stay
        };
    }
    if !(input.verdict.moves && input.verdict.sign == pulse.sign) {
        return stay;
    }
    let motion = Motion::from_pulse(&pulse, start);
    (
        LiftState::Moving(motion),
        start,
        Some(input.forward_decision()),
    )
}

impl Motion {
    /// A motion started by a pulse.
    fn from_pulse(pulse: &Pulse, start: f64) -> Self {
        Self {
            sign: pulse.sign,
            speed: pulse.speed,
            top_speed: pulse.speed,
            start,
            inertial: 0,
            calm: 0,
            looks_like_rest: false,
            first: None,
            decays: false,
            phase: Phase::Accelerating,
        }
    }

    fn step(self, input: &mut StepInput, events: &mut Vec<Event>) -> Next {
        if input.time - self.start > input.longest_motion() {
            return (LiftState::unknown(input.now), input.time, None);
        }
        match self.phase {
            Phase::Accelerating => self.accelerate(input),
            Phase::Inertial => self.go_on(input),
            Phase::Braking => self.brake(input),
            Phase::Stopping(pulse) => self.stop(&pulse, input, events),
        }
    }

    fn on(self, phase: Phase, time: f64) -> Next {
        (LiftState::Moving(Self { phase, ..self }), time, None)
    }

    fn stay(self, input: &StepInput) -> Next {
        self.on(self.phase, input.time)
    }

    /// The current pulse against the motion, if it is stronger than sway.
    fn against(&self, input: &StepInput) -> Option<Pulse> {
        let enough = input.least_speed().min(self.speed / 2.0);
        input
            .pulse(-self.sign)
            .filter(|pulse| pulse.speed >= enough)
    }

    /// The transition from acceleration, which ends by itself or is cut short by a braking.
    fn accelerate(mut self, input: &StepInput) -> Next {
        let cut_short = || self.against(input).and(input.pulse(self.sign));
        let Some(pulse) = input.ended(self.sign).or_else(cut_short) else {
            return self.stay(input);
        };
        if input.is_violent(&pulse) && input.lasts(&pulse) > LONGEST_SHOCK {
            return (LiftState::unknown(input.now), input.time, None);
        }
        self.speed = input.whole(&pulse).speed;
        self.top_speed = self.speed;
        self.first = Some(pulse);
        self.on(Phase::Inertial, input.ends(pulse.end))
    }

    fn go_on(mut self, input: &StepInput) -> Next {
        self.calm = if input.verdict.moves {
            0
        } else {
            self.calm + 1
        };
        self.looks_like_rest |= self.calm >= input.reference_length();
        // A pulse cut short by a braking ends only now, but has been counted already.
        let is_new = |pulse: &Pulse| self.first.is_none_or(|first| pulse.onset >= first.end);
        if let Some(pulse) = input.ended(self.sign).filter(is_new)
            && pulse.speed >= input.least_speed() / 2.0
        {
            self.speed += input.whole(&pulse).speed;
            self.top_speed = self.top_speed.max(self.speed);
        }
        match self.against(input) {
            Some(pulse) => self.on(Phase::Braking, input.starts(pulse.onset)),
            None => self.stay(input),
        }
    }

    /// The transition from braking. A pulse that takes only part of the speed leaves a creeping cage; one that
    /// takes more than all of it was not a braking of this motion.
    fn brake(mut self, input: &StepInput) -> Next {
        let Some(pulse) = input.ended(-self.sign) else {
            return self.stay(input);
        };
        let at_once = input.blocks(LONGEST_SHOCK);
        let decays = |first: Pulse| first.decays_into(&pulse, at_once);
        self.decays = self.first.is_some_and(decays);
        if input.is_violent(&pulse) {
            return self.on(Phase::Stopping(pulse), input.time);
        }
        let left = self.speed - input.whole(&pulse).speed;
        let rounding = input.rounding(self.top_speed);
        match left {
            _ if left > rounding => {
                self.speed = left;
                self.on(Phase::Inertial, input.ends(pulse.end))
            }
            _ if left < -rounding => (LiftState::unknown(input.now), input.time, None),
            _ => self.on(Phase::Stopping(pulse), input.time),
        }
    }

    /// The transition after a possible stop, decided N blocks after the last pulse.
    fn stop(self, pulse: &Pulse, input: &mut StepInput, events: &mut Vec<Event>) -> Next {
        if !input.is_after(pulse) {
            return self.stay(input);
        }
        let decision = input.backward_decision(pulse);
        let stopped = (LiftState::Rest, input.ends(pulse.end), decision);
        if input.is_violent(pulse) {
            if decision.is_none() && !self.is_spent(pulse, input) {
                return self.on(Phase::Inertial, input.time);
            }
            events.push(Event {
                time: input.starts(pulse.onset),
                reported: input.time,
                kind: Kind::Alarm(Alarm::Jam),
            });
            return stopped;
        }
        let is_late = input.now > pulse.end + 3 * input.reference_length();
        match decision {
            Some(_) => stopped,
            None if is_late => (LiftState::unknown(input.now), input.time, None),
            None => self.stay(input),
        }
    }

    /// Whether a shock has taken half of the speed. A shock at a rail joint takes none, because it swings back.
    fn is_spent(&self, pulse: &Pulse, input: &StepInput) -> bool {
        let end = pulse.end + input.blocks(LONGEST_SHOCK).min(input.reference_length());
        let change = input.change_of_speed(pulse.onset..end);
        change.is_some_and(|change| -self.sign * change > self.speed / 2.0)
    }
}
