//! What the cage may be doing, and what that costs: the hypotheses of a monitor.
//!
//! A hypothesis explains all pulses so far. The next pulse is a change of speed, or something else, or one of
//! several that are together a disturbance; each choice makes a new hypothesis, dearer by the cost of the choice.

use crate::explain::{Prior, Progress, Turned, cost};

/// Pulses that change the speed by less than this share of the least speed begin no motion.
const LEAST_START: f64 = 0.35;

/// What a trip below the least speed costs, at most.
const SLOW: f64 = 6.0;

/// A pulse longer than this, s, with less than the weakest usual acceleration times this is soft; few lifts are.
const SOFT: (f64, f64) = (2.0, 1.2);
const SOFT_COST: f64 = 2.5;

/// A lift that starts softly and brakes hard, or the other way round, is rarer still.
const UNLIKE: f64 = 2.0;

/// A lasting change of the level, and one that ends; and what each m/s² beyond a usual one adds.
const SHIFT: f64 = 5.0;
const SHIFT_AND_BACK: f64 = 6.0;
const STRONG_SHIFT: (f64, f64) = (0.1, 20.0);

/// Which way a motion went that was not seen to begin.
const EITHER_WAY: f64 = 0.4;

/// The most that a closing speed costs, since the level may have shifted; beyond a speed, m/s, more.
const MISFIT: (f64, f64, f64) = (5.5, 6.0, 0.3);

/// Pulses that change no speed are scattered over this, m/s, so that a sum of zero is hardly chance: it makes a
/// stop cheaper, by at most so much.
const CHANCE: (f64, f64) = (0.15, -2.0);

/// A cage that levels gains no speed.
const AGAIN: f64 = 4.0;

/// No lift starts in less, s, at most at this cost; none levels sooner after its start, s, at this cost.
const BRISK: (f64, f64) = (0.7, 6.0);
const BRIEF: (f64, f64) = (2.0, 4.0);

/// What else a start by a shock costs.
const VIOLENT_START: f64 = 6.0;

/// A stage of the braking of a motion whose speed is unknown.
const OPEN_STAGE: f64 = 4.5;

/// Speeds at which a lift may level, m/s, and below which that is rare, with its cost.
const LEVELLING: [f64; 7] = [0.03, 0.05, 0.1, 0.15, 0.2, 0.3, 0.5];
const SELDOM: (f64, f64) = (0.1, 3.0);

/// Faster lifts hardly exist, m/s.
const FASTEST: f64 = 10.0;

/// Motions hardly last longer, s; what each second more costs, and all of them.
const LONG: f64 = 60.0;
const LONG_SECOND: f64 = 0.05;
const MOST_LONG: f64 = 4.0;

/// What a motion costs that is longer than the longest: it makes the state unknown, not rest.
const ENDLESS: f64 = 12.0;

/// Those below this speed hardly as long, m/s.
const SLOW_TOP: f64 = 0.4;

/// A change of speed that is not over.
const CHANGING: f64 = 0.3;

/// Changes of speed by less than this share of it are taken for noise, at this cost.
const RIPPLE: (f64, f64) = (0.08, 0.1);

/// By how much better a motion beyond the least speed must be excluded.
const FAST: f64 = 2.0;

/// By how much better motions must be excluded that go back to one that was not seen to begin: one trip read backwards
/// looks as good.
const GUESS: f64 = 2.0;

/// A disturbance that may still be going on.
pub(super) const PENDING: f64 = 1.5;

/// What is known of the lift and its sensor.
#[derive(Clone, Copy, Debug)]
pub(super) struct Known {
    pub prior: Prior,
    /// Below this mean acceleration a long pulse is soft, m/s².
    pub soft: f64,
}

/// What the cage does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Cage {
    Rest,
    /// It moves, and was not seen to start.
    Open,
    Moves(Progress),
}

/// One explanation of everything so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hypothesis {
    pub cage: Cage,
    pub cost: f64,
    /// When the motion, or the rest, began, s.
    pub since: f64,
    /// Whether the motion began softly.
    is_soft: bool,
    /// Whether there was a hole in the record since.
    pub is_across: bool,
    /// Whether it goes back to a motion that was not seen to begin.
    is_guess: bool,
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
            is_guess: false,
            is_jam: false,
            ignored: 0.0,
            braking: None,
        }
    }

    pub fn open(since: f64, cost: f64) -> Self {
        Self {
            cage: Cage::Open,
            is_guess: true,
            ..Self::rest(since, cost)
        }
    }

    /// A motion that is known to have begun before.
    pub fn moving(since: f64) -> Self {
        Self {
            is_guess: false,
            ..Self::open(since, 0.0)
        }
    }

    pub fn dearer(self, by: f64) -> Self {
        Self {
            cost: self.cost + by,
            ..self
        }
    }

    /// If the level has changed by so much since.
    pub fn shifted(self, by: f64) -> Self {
        let cost = SHIFT + STRONG_SHIFT.1 * (by.abs() - STRONG_SHIFT.0).clamp(0.0, 0.5);
        Self {
            ignored: self.ignored + cost / 2.0,
            ..self.dearer(cost)
        }
    }

    pub fn is_rest(&self) -> bool {
        self.cage == Cage::Rest
    }

    /// How much worse than others it is not to believe it, nats.
    pub fn danger(&self, known: &Known, is_strained: bool) -> f64 {
        let fast = match self.cage {
            Cage::Rest => return 0.0,
            Cage::Open => FAST,
            Cage::Moves(progress) => {
                let is_fast = progress.speed.abs() > known.prior.least_speed;
                if is_fast && !progress.creeps {
                    FAST
                } else {
                    0.0
                }
            }
        };
        let guess = if self.is_guess { GUESS } else { 0.0 };
        if is_strained { fast.max(guess) } else { guess }
    }

    /// The motion that a pulse begins, if it is strong enough.
    pub fn started(&self, known: &Known, pulse: &Turned) -> Option<Self> {
        let least = known.prior.least_speed;
        if pulse.change.abs() < LEAST_START * least {
            return None;
        }
        let progress = Progress::start(pulse);
        let is_soft = is_soft(known, pulse);
        let slow = SLOW * (1.0 - progress.top / least).max(0.0);
        let violent = if pulse.violent > 0.0 {
            VIOLENT_START
        } else {
            0.0
        };
        let cost = progress.cost + slow + violent + if is_soft { SOFT_COST } else { 0.0 };
        Some(Self {
            cage: Cage::Moves(progress),
            cost: self.cost + cost,
            is_soft,
            is_guess: self.is_guess,
            ..Self::rest(pulse.from, 0.0)
        })
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
        match self.cage {
            Cage::Moves(progress) if self.is_ripple(total) => {
                let variance = progress.variance + total * total / 2.0;
                return take(Self {
                    cage: Cage::Moves(Progress {
                        variance,
                        ..progress
                    }),
                    ..self.dearer(ignored.min(RIPPLE.1))
                });
            }
            Cage::Rest => take(self.dearer(ignored)),
            _ => take(Self {
                ignored: self.ignored + ignored,
                ..self.dearer(ignored)
            }),
        }
        let (first, last) = (&pulses[0], &pulses[pulses.len() - 1]);
        match self.cage {
            Cage::Rest => {
                if pulses.len() == 1 {
                    let brisk = BRISK.1 * (1.0 - (first.to - first.from) / BRISK.0).max(0.0);
                    let started = self.started(known, first).map(|it| it.dearer(brisk));
                    started.into_iter().for_each(take);
                }
            }
            Cage::Open => {
                if pulses.len() == 1 && first.change.abs() >= LEAST_START * known.prior.least_speed
                {
                    let soft = if is_soft(known, first) {
                        SOFT_COST
                    } else {
                        0.0
                    };
                    let slow = SLOW * (1.0 - first.change.abs() / known.prior.least_speed).max(0.0);
                    let stop = self.cost + EITHER_WAY + soft + slow;
                    take(Self {
                        is_jam: first.violent > 0.0,
                        braking: Some((first.from, last.to)),
                        is_guess: self.is_guess,
                        ..Self::rest(last.to, stop)
                    });
                    take(self.dearer(OPEN_STAGE + soft));
                }
            }
            Cage::Moves(progress) => {
                let closing = Prior {
                    least_speed: known.prior.least_speed * LEAST_START,
                    ..known.prior
                };
                let soft = match (self.is_soft, pulses.iter().any(|it| is_soft(known, it))) {
                    (false, true) => SOFT_COST + UNLIKE,
                    (true, false) => UNLIKE,
                    _ => 0.0,
                };
                let before = Progress {
                    cost: self.cost + soft + again(&progress, total),
                    ..progress
                };
                let changed = before.changed(pulses);
                let tolerance = closing.tolerance(changed.top, changed.variance);
                let error = cost::closing(changed.speed, tolerance);
                let shifted = MISFIT.0 + MISFIT.1 * (changed.speed.abs() - MISFIT.2).max(0.0);
                let match_ = if self.is_across {
                    0.0
                } else {
                    libm::log(tolerance / CHANCE.0).clamp(CHANCE.1, 0.0)
                };
                let violent: f64 = pulses.iter().map(|pulse| pulse.violent).sum();
                let stop = changed.closed(&closing, last.to - self.since) - violent / 2.0;
                take(Self {
                    is_guess: self.is_guess,
                    ignored: self.ignored,
                    is_jam: violent > 0.0,
                    braking: Some((first.from, last.to)),
                    ..Self::rest(last.to, stop - error + error.min(shifted) + match_)
                });
                let mut onwards = changed.going_on(&closing, &progress, cost::STAGE);
                if onwards.creeps && last.to - self.since < BRIEF.0 {
                    onwards.cost += BRIEF.1;
                }
                if onwards.is_slow {
                    onwards.cost += levelling(&closing, &onwards);
                }
                take(Self {
                    cage: Cage::Moves(onwards),
                    cost: onwards.cost,
                    ..*self
                });
            }
        }
    }

    /// The cost of a motion while a pulse changes its speed.
    pub fn changing(&self, known: &Known, pulse: &Turned) -> f64 {
        let soft = if is_soft(known, pulse) && !self.is_soft {
            SOFT_COST
        } else {
            0.0
        };
        let Cage::Moves(progress) = self.cage else {
            return self.cost + CHANGING + soft;
        };
        let changed = progress.changed(&[*pulse]);
        let is_turned =
            changed.speed.abs() > 0.2 * changed.top && (changed.speed > 0.0) != changed.is_up;
        let turned = if is_turned {
            cost::TURN
        } else {
            again(&progress, pulse.change)
        };
        self.cost + changed.cost - progress.cost + CHANGING + soft + turned
    }

    /// What time adds to the cost.
    pub fn aged(&self, prior: &Prior, now: f64) -> f64 {
        let lasted = now - self.since;
        let is_over = lasted > prior.longest_motion;
        match self.cage {
            Cage::Rest => self.cost,
            Cage::Open => self.cost + if is_over { cost::ABSURD } else { 0.0 },
            Cage::Moves(progress) => {
                let usual = LONG * (progress.top / SLOW_TOP).clamp(0.4, 1.0);
                let long = (LONG_SECOND * (lasted - usual).max(0.0)).min(MOST_LONG);
                let endless = if is_over { ENDLESS } else { 0.0 };
                let fast = (progress.top - FASTEST).max(0.0);
                self.cost + progress.creeping(now) + long + fast + endless
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
            take(Self {
                is_across: true,
                ..Self::open(now, self.cost + change)
            });
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
            take(Self {
                is_across: true,
                ..Self::open(self.since, self.cost + change)
            });
            take(Self::rest(now, self.cost + change));
        }
    }

    /// Whether a change of speed is lost in the motion.
    pub fn is_ripple(&self, change: f64) -> bool {
        matches!(self.cage, Cage::Moves(progress) if change.abs() < RIPPLE.0 * progress.speed.abs())
    }

    /// Whether another says the same.
    pub fn is_like(&self, other: &Self) -> bool {
        match (self.cage, other.cage) {
            (Cage::Rest, Cage::Rest) | (Cage::Open, Cage::Open) => true,
            (Cage::Moves(one), Cage::Moves(other)) => {
                (one.speed - other.speed).abs() < 0.01
                    && (one.top - other.top).abs() < 0.02
                    && one.creeps == other.creeps
            }
            _ => false,
        }
    }
}

/// What a pulse costs that is a passing change of the level, if it may be one.
pub(super) fn passing(known: &Known, pulse: &Turned) -> f64 {
    if is_soft(known, pulse) {
        SHIFT_AND_BACK
    } else {
        f64::INFINITY
    }
}

/// What a levelling cage pays that gains speed again.
fn again(motion: &Progress, change: f64) -> f64 {
    if motion.creeps && change * motion.speed > 0.0 {
        AGAIN
    } else {
        0.0
    }
}

fn is_soft(known: &Known, pulse: &Turned) -> bool {
    let seconds = pulse.to - pulse.from;
    seconds > SOFT.0 && pulse.change.abs() < SOFT.1 * known.soft * seconds
}

/// What it costs to level at a speed that may not be told from rest.
fn levelling(prior: &Prior, motion: &Progress) -> f64 {
    let tolerance = prior.tolerance(motion.top, motion.variance);
    let speed = if motion.is_up {
        motion.speed
    } else {
        -motion.speed
    };
    let costs = LEVELLING.iter().map(|at| {
        let seldom = SELDOM.1 * (1.0 - at / SELDOM.0).max(0.0);
        seldom + cost::closing(speed - at, tolerance)
    });
    costs.fold(f64::INFINITY, f64::min)
}
