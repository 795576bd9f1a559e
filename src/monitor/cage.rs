//! What the cage does, after the sequences of [^1]: rest → acceleration → inertial motion is a start,
//! inertial motion → braking → rest a stop.
//!
//! A pulse of acceleration says that the speed has changed, and by how much; the decision on X, Y₁ and
//! Y₂ says whether noise can explain it. Both are needed. Between pulses rest and smooth motion look
//! alike, so the state is remembered, and where it was never seen it is unknown.
//!
//! # Out of the unknown
//! Vibration cannot be trusted to tell: people who get in shake a cage more than many a motion does. What
//! tells is, in this order:
//!
//! - blocks like the reference of rest, where that is evidence, because motions of this cage have been
//!   seen to look different, or the record is known to begin at rest;
//! - a reversal. A motion at one speed leaves two pulses that cancel out. Of three pulses with signs + − −,
//!   the first two cancelling out and the last no weaker than half of them, the cage stood after the second: else it would have
//!   stood with two different speeds. So it moves now; and with − − + it stands now. Any other pulse
//!   in between, a weak one or a shock, and the count begins again;
//! - no pulse for as long as the longest motion takes.
//!
//! | state | leaves it when |
//! |---|---|
//! | unknown | see above |
//! | rest | a pulse changes the speed enough, and the decision forwards is H₁* with its sign |
//! | accelerating | the pulse ends |
//! | inertial | a pulse against the motion takes half of its speed, or as much as the slowest motion has |
//! | braking | the pulse has ended, no speed is left, and the decision backwards says that it was a stop; or some is left, and the cage creeps on |
//!
//! A braking that takes more speed than there was proves that something has been misunderstood, and the state
//! is unknown again. So it is after a motion longer than any, after a gap, and when a pulse does not
//! end, because the sensor's own level has changed.
//!
//! A pulse stronger than any acceleration of a lift is no start: at rest it is a shock, or, if it lasts,
//! somebody carrying the sensor. In motion and against it, it is a jam if it takes half of the speed, or if
//! the decision backwards says that the vibration of motion has ended with it (a sensor at its limit does
//! not see all of the speed go); else it was a shock, and the motion goes on.
//!
//! [^1]: see [`crate::signal`].

use super::event::{Alarm, Decision, Direction, Event, Kind, State};
use super::pulse::Pulse;
use super::scene::Scene;
use crate::signal::Phase;

/// Longer than this, s, a shock is somebody handling the sensor.
const LONGEST_SHOCK: f64 = 0.5;

/// What the cage does, with what must be remembered of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Cage {
    Unknown(Doubt),
    Rest,
    Moving(Motion),
}

/// Why it is not known what the cage does, and what may tell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Doubt {
    /// The first block without a pulse.
    still_since: u64,
    /// The block after the last one whose decision forwards was H₁*.
    calm_since: u64,
    /// The last two pulses, the older first.
    pulses: [Option<Pulse>; 2],
}

/// A motion under way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Motion {
    /// +1 up, −1 down.
    sign: f64,
    /// As far as pulses tell, m/s.
    speed: f64,
    /// The highest it has been, m/s.
    top_speed: f64,
    /// When it began, s.
    start: f64,
    /// Blocks of inertial motion.
    inertial: u64,
    /// For how many of the latest of them the decision forwards has been H₀*.
    calm: u64,
    /// Whether it has ever looked like rest for N blocks.
    looks_like_rest: bool,
    /// The pulse that began it, once it has ended.
    first: Option<Pulse>,
    /// Whether its pulses are those of a sensor behind a high-pass filter.
    decays: bool,
    leg: Leg,
}

/// The part of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Leg {
    Accelerating,
    Inertial,
    Braking,
    /// A pulse has ended that may have been the last.
    Stopping(Pulse),
}

impl Cage {
    /// Nothing is known from block `now` on.
    pub fn unknown(now: u64) -> Self {
        Self::Unknown(Doubt {
            still_since: now,
            calm_since: now,
            pulses: [None; 2],
        })
    }

    /// Its state in a word.
    pub fn state(&self) -> State {
        match self {
            Self::Unknown(_) => State::Unknown,
            Self::Rest => State::Known(Phase::Rest),
            Self::Moving(motion) => State::Known(match motion.leg {
                Leg::Accelerating => Phase::Accelerating,
                Leg::Inertial => Phase::Inertial,
                Leg::Braking | Leg::Stopping(_) => Phase::Braking,
            }),
        }
    }

    /// Of a motion under way with at least `blocks` of inertial motion, whether it has looked like rest.
    pub fn looks_like_rest(&self, blocks: u64) -> Option<bool> {
        let motion = self.motion().filter(|motion| motion.inertial >= blocks);
        motion.map(|motion| motion.looks_like_rest)
    }

    /// Whether the pulses of a motion under way are those of a sensor behind a high-pass filter.
    pub fn decays(&self) -> bool {
        self.motion().is_some_and(|motion| motion.decays)
    }

    fn motion(&self) -> Option<&Motion> {
        match self {
            Self::Moving(motion) => Some(motion),
            Self::Unknown(_) | Self::Rest => None,
        }
    }

    /// A change to this state at `time`, said at `reported`.
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

    /// What comes after the newest block; what happened is said in `events`.
    pub fn step(self, scene: &mut Scene, events: &mut Vec<Event>) -> Self {
        let (next, time, decision) = match self {
            Self::Unknown(doubt) => doubt.step(scene, events),
            Self::Rest => start(scene),
            Self::Moving(motion) => motion.step(scene, events),
        };
        if next.state() != self.state() {
            events.push(next.change(time, scene.time, decision));
        }
        next
    }
}

/// The next state, when it began, and what decided it.
type Next = (Cage, f64, Option<Decision>);

impl Doubt {
    fn step(mut self, scene: &Scene, events: &mut Vec<Event>) -> Next {
        if scene.verdict.moves {
            self.calm_since = scene.now;
        }
        let calm = scene.now - self.calm_since;
        let stands_still = scene.begins_at_rest && self.pulses == [None; 2];
        if (scene.calm_is_rest || stands_still) && calm >= scene.reference_length() {
            let seen = self.calm_since.saturating_sub(scene.scale_length());
            return (Cage::Rest, scene.starts(seen), None);
        }
        for pulse in scene.ended.into_iter().flatten() {
            if let Some(next) = self.take(&pulse, scene, events) {
                return next;
            }
        }
        let still = (scene.now - self.still_since) as f64 * scene.design.block;
        match still > scene.longest_motion() {
            true => (Cage::Rest, scene.time, None),
            false => (Cage::Unknown(self), scene.time, None),
        }
    }

    /// What a pulse that has ended tells together with those before it.
    fn take(&mut self, pulse: &Pulse, scene: &Scene, events: &mut Vec<Event>) -> Option<Next> {
        let c = scene.whole(pulse);
        if c.speed < scene.least_speed() / 2.0 {
            return None;
        }
        self.still_since = scene.now;
        if !Self::is_significant(&c, scene) {
            self.pulses = [None; 2];
            return None;
        }
        let cancel = |a: &Pulse, b: &Pulse| {
            let largest = a.speed.max(b.speed);
            (a.change() + b.change()).abs() <= scene.rounding(largest)
        };
        let [before, last] = self.pulses;
        self.pulses = [last, Some(c)];
        let (a, b) = (before?, last?);
        if b.sign == c.sign && cancel(&a, &b) && c.speed >= b.speed / 2.0 {
            let motion = Motion::from_pulse(&c, scene.starts(c.onset));
            events.push(Cage::Moving(motion).change(motion.start, scene.time, None));
            return Some(motion.on(Leg::Inertial, scene.ends(c.end)));
        }
        let stands = a.sign == b.sign && cancel(&b, &c) && a.speed >= b.speed / 2.0;
        stands.then(|| (Cage::Rest, scene.ends(c.end), None))
    }

    /// Whether a pulse that has ended is more than noise, sway or a shock.
    fn is_significant(pulse: &Pulse, scene: &Scene) -> bool {
        let is_decided = scene.verdict.moves && scene.verdict.sign == pulse.sign;
        is_decided && pulse.speed >= scene.least_speed() && !scene.is_violent(pulse)
    }
}

/// From rest.
fn start(scene: &mut Scene) -> Next {
    let stay = (Cage::Rest, scene.time, None);
    let under_way = [1.0, -1.0].into_iter().filter_map(|sign| scene.pulse(sign));
    let Some(pulse) = under_way
        .filter(|pulse| pulse.speed >= scene.least_speed())
        .max_by(|a, b| a.speed.total_cmp(&b.speed))
    else {
        return stay;
    };
    let start = scene.starts(pulse.onset);
    if scene.is_violent(&pulse) {
        return match scene.lasts(&pulse) > LONGEST_SHOCK {
            true => (Cage::unknown(scene.now), start, None),
            false => stay,
        };
    }
    if !(scene.verdict.moves && scene.verdict.sign == pulse.sign) {
        return stay;
    }
    let motion = Motion::from_pulse(&pulse, start);
    (Cage::Moving(motion), start, Some(scene.forward_decision()))
}

impl Motion {
    /// One that a pulse begins.
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
            leg: Leg::Accelerating,
        }
    }

    fn step(self, scene: &mut Scene, events: &mut Vec<Event>) -> Next {
        if scene.time - self.start > scene.longest_motion() {
            return (Cage::unknown(scene.now), scene.time, None);
        }
        match self.leg {
            Leg::Accelerating => self.accelerate(scene),
            Leg::Inertial => self.go_on(scene),
            Leg::Braking => self.brake(scene),
            Leg::Stopping(pulse) => self.stop(&pulse, scene, events),
        }
    }

    fn on(self, leg: Leg, time: f64) -> Next {
        (Cage::Moving(Self { leg, ..self }), time, None)
    }

    fn stay(self, scene: &Scene) -> Next {
        self.on(self.leg, scene.time)
    }

    /// The pulse under way against the motion, when it is no mere sway.
    fn against(&self, scene: &Scene) -> Option<Pulse> {
        let enough = scene.least_speed().min(self.speed / 2.0);
        scene
            .pulse(-self.sign)
            .filter(|pulse| pulse.speed >= enough)
    }

    /// The acceleration ends by itself, or a braking cuts it short.
    fn accelerate(mut self, scene: &Scene) -> Next {
        let cut_short = || self.against(scene).and(scene.pulse(self.sign));
        let Some(pulse) = scene.ended(self.sign).or_else(cut_short) else {
            return self.stay(scene);
        };
        if scene.is_violent(&pulse) && scene.lasts(&pulse) > LONGEST_SHOCK {
            return (Cage::unknown(scene.now), scene.time, None);
        }
        self.speed = scene.whole(&pulse).speed;
        self.top_speed = self.speed;
        self.first = Some(pulse);
        self.on(Leg::Inertial, scene.ends(pulse.end))
    }

    fn go_on(mut self, scene: &Scene) -> Next {
        self.calm = if scene.verdict.moves {
            0
        } else {
            self.calm + 1
        };
        self.looks_like_rest |= self.calm >= scene.reference_length();
        // A pulse that a braking cut short ends only now, and has been counted.
        let is_new = |pulse: &Pulse| self.first.is_none_or(|first| pulse.onset >= first.end);
        if let Some(pulse) = scene.ended(self.sign).filter(is_new)
            && pulse.speed >= scene.least_speed() / 2.0
        {
            self.speed += scene.whole(&pulse).speed;
            self.top_speed = self.top_speed.max(self.speed);
        }
        match self.against(scene) {
            Some(pulse) => self.on(Leg::Braking, scene.starts(pulse.onset)),
            None => self.stay(scene),
        }
    }

    /// What does not take all of the speed leaves a creeping cage, and what takes more than all of it was
    /// no braking of this motion.
    fn brake(mut self, scene: &Scene) -> Next {
        let Some(pulse) = scene.ended(-self.sign) else {
            return self.stay(scene);
        };
        let at_once = scene.blocks(LONGEST_SHOCK);
        let decays = |first: Pulse| first.decays_into(&pulse, at_once);
        self.decays = self.first.is_some_and(decays);
        if scene.is_violent(&pulse) {
            return self.on(Leg::Stopping(pulse), scene.time);
        }
        let left = self.speed - scene.whole(&pulse).speed;
        let rounding = scene.rounding(self.top_speed);
        match left {
            _ if left > rounding => {
                self.speed = left;
                self.on(Leg::Inertial, scene.ends(pulse.end))
            }
            _ if left < -rounding => (Cage::unknown(scene.now), scene.time, None),
            _ => self.on(Leg::Stopping(pulse), scene.time),
        }
    }

    /// N blocks after the last pulse it shows what it was.
    fn stop(self, pulse: &Pulse, scene: &mut Scene, events: &mut Vec<Event>) -> Next {
        if !scene.is_after(pulse) {
            return self.stay(scene);
        }
        let decision = scene.backward_decision(pulse);
        let stopped = (Cage::Rest, scene.ends(pulse.end), decision);
        if scene.is_violent(pulse) {
            if decision.is_none() && !self.is_spent(pulse, scene) {
                return self.on(Leg::Inertial, scene.time);
            }
            events.push(Event {
                time: scene.starts(pulse.onset),
                reported: scene.time,
                kind: Kind::Alarm(Alarm::Jam),
            });
            return stopped;
        }
        let is_late = scene.now > pulse.end + 3 * scene.reference_length();
        match decision {
            Some(_) => stopped,
            None if is_late => (Cage::unknown(scene.now), scene.time, None),
            None => self.stay(scene),
        }
    }

    /// Whether a shock has taken half of the speed. One at a joint of the rails takes none: it swings back.
    fn is_spent(&self, pulse: &Pulse, scene: &Scene) -> bool {
        let end = pulse.end + scene.blocks(LONGEST_SHOCK).min(scene.reference_length());
        let change = scene.change_of_speed(pulse.onset..end);
        change.is_some_and(|change| -self.sign * change > self.speed / 2.0)
    }
}
