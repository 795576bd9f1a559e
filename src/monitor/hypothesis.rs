//! What the cage may be doing, and what that costs: the hypotheses of a monitor.
//!
//! A hypothesis explains all pulses so far. The next pulse is a change of speed, or something else, or one of
//! several that are together a disturbance; each choice makes a new hypothesis, dearer by the cost of the choice.

use super::event::Direction;
use super::prices::{self, Known};
use crate::explain::{Prior, Progress, Turned, cost};
use serde::{Deserialize, Serialize};

/// What the cage does.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum Cage {
    Rest,
    /// It moves, and was not seen to start.
    Open,
    Moves(Progress),
}

/// One explanation of everything so far.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Hypothesis {
    pub cage: Cage,
    pub cost: f64,
    /// When the motion, or the rest, began, s.
    pub since: f64,
    /// Whether the motion began softly.
    is_soft: bool,
    /// Whether there was a hole in the record since.
    pub is_across: bool,
    /// By how much better it must be excluded because it goes back to a motion that was not seen to begin, nats.
    guess: f64,
    /// Whether it holds that all before was misread.
    pub is_renewed: bool,
    /// How often its motion has sped up again.
    again: u8,
    /// The speed from which the lift has sped up again before, m/s; infinite where that may have been another start.
    habit: Option<f64>,
    /// Whether the rest began with a shock.
    pub is_jam: bool,
    /// What it has cost to take pulses of the motion, or the one before the rest, for something else.
    pub ignored: f64,
    /// The braking before the rest, s.
    pub braking: Option<(f64, f64)>,
}

impl Hypothesis {
    pub fn rest(since: f64, cost: f64) -> Self {
        Self {
            cage: Cage::Rest,
            cost,
            since,
            is_soft: false,
            is_across: false,
            guess: 0.0,
            is_renewed: false,
            again: 0,
            habit: None,
            is_jam: false,
            ignored: 0.0,
            braking: None,
        }
    }

    pub fn open(since: f64, cost: f64) -> Self {
        Self {
            cage: Cage::Open,
            guess: prices::GUESS,
            ..Self::rest(since, cost)
        }
    }

    /// A rest, if all that was believed at this cost is wrong.
    pub fn renewed(since: f64, cost: f64) -> Self {
        Self {
            is_renewed: true,
            ignored: prices::RENEWAL,
            ..Self::rest(since, cost + prices::RENEWAL)
        }
    }

    /// A motion that is known to have begun before.
    pub fn moving(since: f64) -> Self {
        Self {
            guess: 0.0,
            ..Self::open(since, 0.0)
        }
    }

    pub fn dearer(self, by: f64) -> Self {
        Self {
            cost: self.cost + by,
            ..self
        }
    }

    /// If the level has changed by so much since, at once or not.
    pub fn shifted(self, by: f64, at_once: bool) -> Self {
        let cost = prices::shift(by, at_once);
        Self {
            ignored: self.ignored + cost / 2.0,
            ..self.dearer(cost)
        }
    }

    pub fn is_rest(&self) -> bool {
        self.cage == Cage::Rest
    }

    /// Where it moves to, if that is known.
    pub fn direction(&self) -> Option<Direction> {
        match self.cage {
            Cage::Moves(progress) => Some(Direction::of(progress.speed)),
            Cage::Rest | Cage::Open => None,
        }
    }

    /// How much worse than others it is not to believe it, nats.
    pub fn danger(&self, known: &Known, is_strained: bool) -> f64 {
        let least = known.prior.least_speed;
        let (fast, is_fast) = match self.cage {
            Cage::Rest => return 0.0,
            Cage::Open => (0.0, true),
            Cage::Moves(progress) if progress.creeps => (0.0, false),
            Cage::Moves(progress) => {
                let speed = progress.speed.abs();
                (prices::fast_unseen(speed - least), speed > least)
            }
        };
        let strained = if is_strained && is_fast {
            prices::STRAINED
        } else {
            0.0
        };
        if self.guess > 0.0 {
            strained.max(self.guess)
        } else {
            strained + fast
        }
    }

    /// The motion that a pulse begins, if it is strong enough.
    pub fn started(&self, known: &Known, pulse: &Turned) -> Option<Self> {
        if !known.is_strong(pulse) {
            return None;
        }
        let progress = Progress::start(pulse);
        let is_soft = known.is_soft(pulse);
        let cost = progress.cost
            + known.slow(progress.top)
            + prices::violent_start(pulse)
            + known.endless(pulse)
            + prices::soft(is_soft);
        Some(self.then(Self {
            cage: Cage::Moves(progress),
            is_soft,
            guess: self.guess,
            ..Self::rest(pulse.from, self.cost + cost)
        }))
    }

    /// What follows if these pulses are one event, which costs `ignored` where it changes no speed.
    pub fn explain(
        &self,
        known: &Known,
        pulses: &[Turned],
        ignored: f64,
        take: &mut impl FnMut(Self),
    ) {
        let total: f64 = pulses.iter().map(|pulse| pulse.change).sum();
        if let Cage::Moves(progress) = self.cage
            && prices::is_ripple(progress.speed, total)
            && (pulses.iter())
                .all(|it| it.is_shock() || prices::is_ripple(progress.speed, it.change))
        {
            let variance = progress.variance + total * total / 2.0;
            return take(Self {
                cage: Cage::Moves(Progress {
                    variance,
                    ..progress
                }),
                ..self.dearer(prices::ripple(ignored))
            });
        }
        take(Self {
            ignored: if self.is_rest() {
                self.ignored
            } else {
                self.ignored + ignored
            },
            ..self.dearer(ignored)
        });
        match (self.cage, pulses) {
            (Cage::Rest, [pulse]) => {
                let started = self.started(known, pulse);
                let started = started.map(|it| it.dearer(prices::brisk(pulse)));
                started.into_iter().for_each(take);
            }
            (Cage::Open, [pulse]) if known.is_strong(pulse) => {
                let soft = prices::soft(known.is_soft(pulse));
                let slow = known.slow(pulse.change.abs());
                take(self.stopped(pulses, self.cost + prices::EITHER_WAY + soft + slow));
                take(self.dearer(prices::OPEN_STAGE + soft));
            }
            (Cage::Moves(progress), _) => {
                let is_soft = pulses.iter().any(|it| known.is_soft(it));
                let soft = if self.is_soft && !is_soft && Self::is_stage(&progress, total, pulses) {
                    prices::NOT_SOFT
                } else if self.is_soft && self.has_habit() {
                    0.0
                } else {
                    prices::unlike(self.is_soft, is_soft)
                };
                let endless: f64 = pulses.iter().map(|it| known.endless(it)).sum();
                let before = Progress {
                    cost: self.cost + soft + endless + self.again(&progress, total),
                    ..progress
                };
                let changed = before.changed(&self.prior(known), pulses);
                take(self.stopped(pulses, self.closing(known, pulses, &changed)));
                take(self.going_on(known, pulses, changed, &progress));
            }
            _ => {}
        }
    }

    /// The rest after a motion that pulses have ended.
    fn stopped(&self, pulses: &[Turned], cost: f64) -> Self {
        let (first, last) = (&pulses[0], &pulses[pulses.len() - 1]);
        self.then(Self {
            guess: self.guess,
            is_jam: pulses.iter().any(|pulse| pulse.is_shock()),
            ignored: self.ignored,
            braking: Some((first.from, last.to)),
            ..Self::rest(last.to, cost)
        })
    }

    /// The cost of the rest after a motion whose speed pulses have changed like this.
    fn closing(&self, known: &Known, pulses: &[Turned], changed: &Progress) -> f64 {
        let closing = known.closing();
        let tolerance = closing.tolerance(changed.top, changed.variance);
        let error = cost::closing(changed.speed, tolerance);
        let chance = if self.is_across {
            0.0
        } else {
            prices::chance(tolerance)
        };
        let violent: f64 = pulses.iter().map(|pulse| pulse.violent).sum();
        let seconds = pulses[pulses.len() - 1].to - self.since;
        let stop = changed.closed(&closing, seconds) - violent / 2.0;
        stop - error + error.min(prices::misfit(changed.speed)) + chance
    }

    /// The motion that goes on after such a change.
    fn going_on(
        &self,
        known: &Known,
        pulses: &[Turned],
        changed: Progress,
        before: &Progress,
    ) -> Self {
        let closing = known.closing();
        let mut onwards = changed.going_on(&closing, before, cost::STAGE);
        if onwards.creeps {
            onwards.cost += prices::brief(pulses[pulses.len() - 1].to - self.since);
        }
        if onwards.is_slow {
            onwards.cost += prices::levelling(&closing, &onwards);
        }
        let total = onwards.speed - before.speed;
        let is_stage =
            total.abs() > cost::LEAST_STAGE * onwards.top && Self::is_stage(before, total, pulses);
        // One as strong as the start may be another start, and back to the same speed is a stop.
        let tolerance = closing.tolerance(onwards.top, onwards.variance);
        let is_doubled = !before.creeps && (total - before.speed).abs() < 2.0 * tolerance;
        let is_braking = onwards.speed.abs() < before.speed.abs();
        // That it brakes to the speed at which it crept out is hardly chance either.
        if let Some(habit) = self.habit.filter(|_| is_braking) {
            let error = cost::closing(onwards.speed.abs() - habit, tolerance);
            onwards.cost += (error + prices::chance(tolerance)).min(0.0);
        }
        Self {
            again: self.again.saturating_add(u8::from(is_stage)),
            habit: if !is_stage {
                self.habit
            } else if is_doubled {
                Some(f64::INFINITY)
            } else {
                Some(before.speed.abs())
            },
            cage: Cage::Moves(onwards),
            cost: onwards.cost,
            ..*self
        }
    }

    /// Whether pulses speed a cage up that has kept its speed before.
    fn is_stage(before: &Progress, change: f64, pulses: &[Turned]) -> bool {
        change * before.speed > 0.0 && pulses[0].from - before.since > prices::KEPT
    }

    /// Another motion or rest of the same lift, which keeps its habit.
    fn then(&self, next: Self) -> Self {
        Self {
            habit: self.habit,
            is_renewed: self.is_renewed,
            ..next
        }
    }

    /// Whether it may speed up again by habit.
    fn has_habit(&self) -> bool {
        self.habit.is_some() && self.again < prices::MOST_AGAIN
    }

    /// What is known of the lift, with its habit.
    fn prior(&self, known: &Known) -> Prior {
        Prior {
            in_stages: self.has_habit(),
            ..known.prior
        }
    }

    /// What a change of speed costs where the cage levelled.
    fn again(&self, progress: &Progress, change: f64) -> f64 {
        if self.has_habit() {
            0.0
        } else {
            prices::again(progress, change)
        }
    }

    /// The cost of a motion while a pulse changes its speed.
    pub fn changing(&self, known: &Known, pulse: &Turned) -> f64 {
        let soft = prices::soft(known.is_soft(pulse) && !self.is_soft) + known.endless(pulse);
        let Cage::Moves(progress) = self.cage else {
            return self.cost + prices::CHANGING + soft;
        };
        let changed = progress.changed(&self.prior(known), &[*pulse]);
        let is_turned =
            changed.speed.abs() > 0.2 * changed.top && (changed.speed > 0.0) != changed.is_up;
        let turned = if is_turned {
            cost::TURN
        } else {
            self.again(&progress, pulse.change)
        };
        self.cost + changed.cost - progress.cost + prices::CHANGING + soft + turned
    }

    /// What time adds to the cost.
    pub fn aged(&self, known: &Known, now: f64) -> f64 {
        let prior = self.prior(known);
        let lasted = now - self.since;
        let is_over = lasted > prior.longest_motion;
        match self.cage {
            Cage::Rest => self.cost,
            Cage::Open => self.cost + if is_over { cost::ABSURD } else { 0.0 },
            Cage::Moves(progress) => {
                let long = prices::long(lasted, progress.top);
                let endless = if is_over { prices::ENDLESS } else { 0.0 };
                let fast = prices::fast(progress.top);
                self.cost + progress.creeping(&prior, now) + long + fast + endless
            }
        }
    }

    /// After a hole in the record.
    pub fn across(&self, now: f64, is_brief: bool, in_pulse: bool, take: &mut impl FnMut(Self)) {
        let change = match (in_pulse, is_brief) {
            (true, _) => 0.5,
            (false, true) => 3.0 * cost::IN_HOLE,
            (false, false) => cost::IN_HOLE,
        };
        if self.is_rest() {
            take(*self);
            take(self.then(Self {
                is_across: true,
                guess: prices::GUESS_IN_HOLE,
                ..Self::open(now, self.cost + change)
            }));
        } else {
            let goes_on = if is_brief {
                cost::ACROSS_HOLE
            } else {
                cost::IN_HOLE / 2.0
            };
            take(Self {
                is_across: !is_brief,
                ..self.dearer(goes_on)
            });
            take(self.then(Self {
                is_across: true,
                guess: prices::GUESS_IN_HOLE,
                ..Self::open(self.since, self.cost + change)
            }));
            take(self.then(Self::rest(now, self.cost + change)));
        }
    }

    /// Whether a change of speed is lost in the motion.
    pub fn is_ripple(&self, change: f64) -> bool {
        matches!(self.cage, Cage::Moves(progress) if prices::is_ripple(progress.speed, change))
    }

    /// Whether another says the same.
    pub fn is_like(&self, other: &Self) -> bool {
        let does_the_same = match (self.cage, other.cage) {
            (Cage::Rest, Cage::Rest) | (Cage::Open, Cage::Open) => true,
            (Cage::Moves(one), Cage::Moves(other)) => {
                (one.speed - other.speed).abs() < 0.01
                    && (one.top - other.top).abs() < 0.02
                    && one.creeps == other.creeps
            }
            _ => false,
        };
        does_the_same && self.habit.is_some() == other.habit.is_some()
    }
}
