//! What a monitor says: what all plausible hypotheses agree on.

use super::event::{Decided, Direction, Doubt, Event, Kind, State};
use super::hypothesis::{Cage, Hypothesis};
use super::live::Belief;
use crate::signal::Phase;
use serde::{Deserialize, Serialize};

/// A hypothesis dearer than the cheapest by more than this is not plausible, nats.
const MARGIN: f64 = 4.0;

/// What came at once no later than so long after the beginning of a motion, s, may be all that there was of that.
const BESIDE: f64 = 1.0;

/// A rest after a motion in which pulses were taken for something else must be likelier by what that has cost, at most
/// by this: one of them may have been the stop.
const MOST_IGNORED: f64 = 4.0;

/// The state of the cage, and since when.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Statement {
    pub state: State,
    /// s
    pub since: f64,
    pub direction: Option<Direction>,
    pub speed: Option<f64>,
    pub reason: Option<Doubt>,
    /// When the shock was that may have ended the motion, s.
    pub jam: Option<f64>,
    /// When the motion began, if it was seen to begin, s.
    pub start: Option<f64>,
    /// The braking that ended the motion, s.
    pub braking: Option<(f64, f64)>,
    /// When the rest that may be the case began, s.
    pub rest: Option<f64>,
}

impl Statement {
    pub fn unknown(since: f64, reason: Doubt) -> Self {
        Self {
            state: State::Unknown,
            since,
            direction: None,
            speed: None,
            reason: Some(reason),
            jam: None,
            start: None,
            braking: None,
            rest: None,
        }
    }

    /// What follows from a belief, and from whether rest was known since the record began or went on: before, a trip that is
    /// read backwards looks as good for as long as nothing says otherwise.
    pub fn of(belief: &Belief, knows_rest: bool, now: f64) -> Self {
        let cost = |best: Option<(Hypothesis, f64)>| best.map_or(f64::INFINITY, |best| best.1);
        let (rest, motion) = (cost(belief.rest), cost(belief.motion));
        let plausible = belief
            .rest
            .filter(|_| rest < motion + MARGIN)
            .map(|best| best.0);
        let statement = match (belief.rest, belief.motion) {
            (Some((it, _)), _) if belief.threat > rest + MARGIN + it.ignored.min(MOST_IGNORED) => {
                Self {
                    state: State::REST,
                    since: it.since.min(now),
                    braking: it.braking,
                    reason: None,
                    ..Self::unknown(now, Doubt::Beginning)
                }
            }
            (_, Some((it, _))) if rest > motion + MARGIN => {
                let moving = Self::moving(&it, belief, now);
                let is_turn = belief.turned_at < it.since + BESIDE;
                let is_one_way = belief.otherwise > motion + MARGIN && !is_turn;
                if knows_rest && is_one_way {
                    moving
                } else {
                    moving.without_direction(now)
                }
            }
            (_, Some((it, _))) => Self::unknown(now, doubt(&it, belief)),
            _ => Self::unknown(now, Doubt::Beginning),
        };
        Self {
            jam: plausible.filter(|it| it.is_jam).map(|it| it.since),
            rest: plausible.map(|it| it.since),
            ..statement
        }
    }

    fn moving(motion: &Hypothesis, belief: &Belief, now: f64) -> Self {
        let (phase, since, speed) = match (motion.cage, belief.change) {
            (Cage::Moves(progress), Some((from, change))) => {
                let gains = change * progress.speed > 0.0;
                let speed = progress.speed + if motion.since < from { change } else { 0.0 };
                let phase = if gains {
                    Phase::Accelerating
                } else {
                    Phase::Braking
                };
                (phase, from, Some(speed))
            }
            (Cage::Moves(progress), None) => {
                let phase = if progress.creeps {
                    Phase::Levelling
                } else {
                    Phase::Inertial
                };
                (phase, progress.since, Some(progress.speed))
            }
            _ if motion.is_across => (Phase::Inertial, now, None),
            _ => (Phase::Inertial, motion.since, None),
        };
        Self {
            state: State::Known(phase),
            since: since.min(now),
            start: matches!(motion.cage, Cage::Moves(_)).then_some(motion.since),
            direction: motion.direction(),
            speed: speed.map(f64::abs),
            reason: None,
            ..Self::unknown(now, Doubt::Beginning)
        }
    }

    /// The same of a cage that may as well go the other way: one starts as the other brakes, and all that is known is that it
    /// moves now.
    fn without_direction(self, now: f64) -> Self {
        Self {
            state: State::Known(Phase::Inertial),
            since: now,
            direction: None,
            speed: None,
            ..self
        }
    }

    /// The start of the motion, where its direction is known and it is in a later phase than that.
    pub fn start_of_motion(&self) -> Option<Self> {
        let is_later = self.state != State::Known(Phase::Accelerating);
        let start = self.start.filter(|start| is_later && *start < self.since)?;
        self.direction.map(|direction| Self {
            state: State::Known(Phase::Accelerating),
            since: start,
            direction: Some(direction),
            reason: None,
            ..Self::unknown(start, Doubt::Beginning)
        })
    }

    pub fn event(&self, decision: Option<Decided>, now: f64) -> Event {
        Event {
            time: self.since.min(now),
            reported: now,
            kind: Kind::Change {
                state: self.state,
                direction: self.direction,
                speed: self.speed,
                reason: self.reason,
                decision,
            },
        }
    }
}

fn doubt(motion: &Hypothesis, belief: &Belief) -> Doubt {
    match motion.cage {
        Cage::Open if motion.is_across => Doubt::Hole,
        Cage::Open | Cage::Rest => Doubt::Beginning,
        Cage::Moves(_) if belief.is_shifted => Doubt::Level,
        Cage::Moves(progress) if progress.creeps && belief.change.is_none() => Doubt::Creep,
        Cage::Moves(_) => Doubt::Pulse,
    }
}
