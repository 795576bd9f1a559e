//! The motions that pulses may be part of.
//!
//! A motion begins with a pulse, and every later pulse either changes its speed, or is something else, or belongs
//! to a disturbance. It may end at a change that brings the speed back to zero. Motions that began before the
//! record are those of the reversed record that go on after its end: reversed, braking is a start.

use super::cost::{self, Prior};
use super::pulse::{FARTHEST_SWING, LONGEST_SWING, Pulse};
use std::collections::VecDeque;
use std::ops::Range;

/// The most partial motions kept at a pulse.
const WIDTH: usize = 24;

/// A motion costs at most this much more than the usual explanation before it is given up.
const HOPELESS: f64 = 24.0;

/// A motion is followed over so many pulses: one that is shaken more than that is left undecided.
const MOST_FOLLOWED: usize = 120;

/// A usual trip has fewer pulses than this.
const SHORT_TRIP: usize = 8;

/// The share of its top speed to which a motion that crept gains speed again.
const RESTARTED: f64 = 0.3;

/// The most pulses in a disturbance, since longer ones are one pulse already, and the longest pause in it, s.
const MOST_IN_DISTURBANCE: usize = 4;
const LONGEST_PAUSE: f64 = 0.4;

/// A motion as one explanation of pulses.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// The pulses from the first to the last that it explains.
    pub pulses: Range<usize>,
    /// Those that change its speed.
    pub changes: Vec<usize>,
    /// The speed left at its end, or for one that began before the record the speed at its beginning, m/s.
    pub speed: f64,
    /// The highest speed, m/s, up positive.
    pub top: f64,
    /// m, up positive.
    pub distance: f64,
    /// Whether it began before the stretch, and whether it goes on after it.
    pub is_open: (bool, bool),
    /// nats
    pub cost: f64,
}

/// A pulse in one direction of time.
#[derive(Clone, Copy, Debug)]
struct Turned {
    from: f64,
    to: f64,
    change: f64,
    variance: f64,
    ignored: f64,
    violent: f64,
}

/// The pulses of a stretch without holes.
pub struct Stretch<'a> {
    prior: &'a Prior,
    pulses: Vec<Turned>,
    /// For each pulse the disturbances that begin with it: the pulse after, and the cost.
    disturbances: Vec<Vec<(usize, f64)>>,
    /// What the usual explanation of the first pulses costs.
    usual: Vec<f64>,
    /// Its end, s.
    end: f64,
    /// Its beginning, s.
    begin: f64,
    /// Whether time runs backwards.
    is_reversed: bool,
}

/// A motion in progress.
#[derive(Clone, Copy, Debug)]
struct Progress {
    speed: f64,
    top: f64,
    variance: f64,
    cost: f64,
    /// End of the latest change, s.
    since: f64,
    distance: f64,
    creeps: bool,
    /// Whether it does so at hardly any speed.
    is_slow: bool,
    /// The latest change, in the list of all.
    latest: usize,
}

/// The changes of all motions in progress: the one before, and the pulse.
type Changes = Vec<(Option<usize>, usize)>;

impl<'a> Stretch<'a> {
    /// In the order of the record; `begin` and `end` in s.
    pub fn new(prior: &'a Prior, pulses: &[Pulse], (begin, end): (f64, f64)) -> Self {
        let turned = pulses.iter().map(|pulse| Turned {
            from: pulse.from,
            to: pulse.to,
            change: pulse.change,
            variance: pulse.deviation * pulse.deviation,
            ignored: prior.ignored(pulse),
            violent: if prior.is_violent(pulse) || pulse.is_swing {
                cost::VIOLENT
            } else {
                0.0
            },
        });
        Self::of(prior, turned.collect(), (begin, end), false)
    }

    /// The same with time reversed.
    pub fn reversed(&self) -> Self {
        let turned = self.pulses.iter().rev().map(|pulse| Turned {
            from: -pulse.to,
            to: -pulse.from,
            change: -pulse.change,
            ..*pulse
        });
        let ends = (-self.end, -self.begin);
        Self::of(self.prior, turned.collect(), ends, !self.is_reversed)
    }

    fn of(
        prior: &'a Prior,
        pulses: Vec<Turned>,
        (begin, end): (f64, f64),
        is_reversed: bool,
    ) -> Self {
        let disturbances = (0..pulses.len()).map(|first| disturbances(prior, &pulses, first));
        let mut stretch = Self {
            disturbances: disturbances.collect(),
            usual: Vec::new(),
            prior,
            pulses,
            begin,
            end,
            is_reversed,
        };
        stretch.usual = stretch.usual();
        stretch
    }

    /// The cost of a pulse that is not part of any motion.
    pub fn ignored(&self, pulse: usize) -> f64 {
        self.pulses[pulse].ignored
    }

    /// The disturbances that begin with a pulse: the pulse after, and the cost.
    pub fn disturbances(&self, first: usize) -> &[(usize, f64)] {
        &self.disturbances[first]
    }

    /// What an explanation of the first pulses costs that knows short trips only: a bound for what is worth following.
    fn usual(&self) -> Vec<f64> {
        let count = self.pulses.len();
        let mut usual = vec![f64::INFINITY; count + 1];
        usual[0] = 0.0;
        for first in 0..count {
            let so_far = usual[first];
            let mut note = |end: usize, cost: f64| usual[end] = usual[end].min(so_far + cost);
            note(first + 1, self.pulses[first].ignored);
            for &(after, cost) in &self.disturbances[first] {
                note(after, cost);
            }
            let far = (first + SHORT_TRIP).min(count);
            self.follow(
                first,
                far,
                |_, _| f64::INFINITY,
                &mut |motion, last, is_open, _| {
                    if !is_open {
                        note(last + 1, motion.cost);
                    }
                },
            );
        }
        usual
    }

    /// How much dearer than the usual explanation of its pulses a motion is.
    pub fn excess(&self, pulses: Range<usize>, cost: f64) -> f64 {
        let (start, end) = if self.is_reversed {
            (
                self.pulses.len() - pulses.end,
                self.pulses.len() - pulses.start,
            )
        } else {
            (pulses.start, pulses.end)
        };
        cost - (self.usual[end] - self.usual[start])
    }

    /// The motions that begin with a pulse: those that end within the stretch, and those that go on.
    pub fn motions(&self, first: usize, take: &mut impl FnMut(Motion, bool)) {
        let most = |first: usize, pulse: usize| self.usual[pulse] - self.usual[first] + HOPELESS;
        let far = self.pulses.len().min(first + MOST_FOLLOWED);
        self.follow(first, far, most, &mut |motion, last, is_open, changes| {
            let cost = motion.cost;
            take(self.motion(motion, first..last + 1, cost, changes), is_open);
        });
    }

    /// Follows the motions that begin with a pulse over those before `far`, while they cost less than `most` of the first
    /// pulse and the next. Takes each at its last pulse, with its whole cost.
    fn follow(
        &self,
        first: usize,
        far: usize,
        most: impl Fn(usize, usize) -> f64,
        take: &mut impl FnMut(&Progress, usize, bool, &Changes),
    ) {
        let Some(start) = self.start(first) else {
            return;
        };
        let mut changes: Changes = vec![(None, first)];
        let mut waiting = VecDeque::from([vec![start]]);
        for pulse in first + 1..far {
            let mut here = waiting.pop_front().unwrap_or_default();
            here.sort_by(|a, b| a.cost.total_cmp(&b.cost));
            here.truncate(WIDTH);
            here.retain(|motion| motion.cost < most(first, pulse));
            let is_over =
                self.pulses[pulse].from - self.pulses[first].from > self.prior.longest_motion;
            if is_over || (here.is_empty() && waiting.iter().all(Vec::is_empty)) {
                return;
            }
            for motion in here {
                let mut wait = |until: usize, motion: Progress| {
                    let place = until - pulse - 1;
                    if waiting.len() <= place {
                        waiting.resize(place + 1, Vec::new());
                    }
                    waiting[place].push(motion);
                };
                let cost = motion.cost + self.pulses[pulse].ignored;
                wait(pulse + 1, Progress { cost, ..motion });
                for &(after, cost) in &self.disturbances[pulse] {
                    let cost = motion.cost + cost;
                    wait(after, Progress { cost, ..motion });
                }
                let disturbances = self.disturbances[pulse].iter().map(|it| it.0);
                for after in [pulse + 1].into_iter().chain(disturbances) {
                    let mut changed = self.changed(&motion, pulse..after);
                    for change in pulse..after {
                        changes.push((Some(changed.latest), change));
                        changed.latest = changes.len() - 1;
                    }
                    take(
                        &self.closed(&changed, first, after - 1),
                        after - 1,
                        false,
                        &changes,
                    );
                    wait(after, self.going_on(changed, &motion, first));
                }
            }
        }
        if far < self.pulses.len() {
            return;
        }
        for motion in waiting.front().into_iter().flatten() {
            let slow = self
                .prior
                .implausible(motion.top, f64::INFINITY, f64::INFINITY);
            let cost = motion.cost + creeping(motion, self.end) + slow;
            take(
                &Progress { cost, ..*motion },
                self.pulses.len() - 1,
                true,
                &changes,
            );
        }
    }

    fn start(&self, first: usize) -> Option<Progress> {
        let pulse = self.pulses[first];
        let is_strong = pulse.change.abs() >= self.prior.least_speed / 8.0;
        is_strong.then(|| Progress {
            speed: pulse.change,
            top: pulse.change.abs(),
            variance: pulse.variance,
            cost: cost::TRIP + pulse.violent,
            since: pulse.to,
            distance: pulse.change * (pulse.to - pulse.from) / 2.0,
            creeps: false,
            is_slow: false,
            latest: 0,
        })
    }

    /// The motion after pulses that together change its speed.
    fn changed(&self, motion: &Progress, pulses: Range<usize>) -> Progress {
        let pause = self.pulses[pulses.start].from - motion.since;
        let mut changed = *motion;
        let mut total = 0.0;
        for pulse in &self.pulses[pulses.clone()] {
            let coast = pulse.from - changed.since;
            changed.distance += changed.speed * coast
                + (changed.speed + pulse.change / 2.0) * (pulse.to - pulse.from);
            changed.speed += pulse.change;
            changed.variance += pulse.variance;
            changed.cost += pulse.violent;
            changed.since = pulse.to;
            total += pulse.change;
        }
        changed.top = changed.top.max(changed.speed.abs());
        changed.cost += creeping(motion, self.pulses[pulses.start].from);
        if motion.is_slow && changed.speed.abs() > RESTARTED * changed.top {
            changed.cost += cost::RESTART;
        } else if total * motion.speed > 0.0 {
            changed.cost += cost::acceleration_stage(pause);
        }
        if self.is_half(pulses.end) {
            changed.cost += cost::HALF;
        }
        changed
    }

    /// Whether the pulse before this one and it are a swing to and fro.
    fn is_half(&self, next: usize) -> bool {
        let Some(after) = self.pulses.get(next) else {
            return false;
        };
        let before = self.pulses[next - 1];
        let is_swing = self.disturbances[next - 1]
            .iter()
            .any(|it| it.0 == next + 1);
        is_swing
            && after.change * before.change < 0.0
            && after.change.abs() > 0.3 * before.change.abs()
    }

    /// A motion that goes on after a change.
    fn going_on(&self, changed: Progress, before: &Progress, first: usize) -> Progress {
        let tolerance = self.prior.tolerance(changed.top, changed.variance);
        let is_slow = changed.speed.abs() < 2.0 * tolerance;
        let is_braking = changed.speed.abs() < before.speed.abs();
        let cost = if is_slow {
            cost::CREEP
        } else if changed.speed * self.pulses[first].change < 0.0 {
            cost::TURN
        } else if is_braking && before.speed.abs() - changed.speed.abs() < 0.2 * before.top {
            cost::RIPPLE
        } else if is_braking {
            if self.is_reversed {
                cost::acceleration_stage(f64::INFINITY) / 2.0
            } else {
                cost::STAGE
            }
        } else {
            0.0
        };
        Progress {
            cost: changed.cost + cost,
            creeps: is_slow || (is_braking && cost > cost::RIPPLE),
            is_slow,
            ..changed
        }
    }

    /// A motion that ends with a pulse.
    fn closed(&self, motion: &Progress, first: usize, last: usize) -> Progress {
        let seconds = self.pulses[last].to - self.pulses[first].from;
        let tolerance = self.prior.tolerance(motion.top, motion.variance);
        let cost = motion.cost
            + cost::closing(motion.speed, tolerance)
            + self.prior.implausible(motion.top, motion.distance, seconds);
        Progress { cost, ..*motion }
    }

    /// As it is in the order of the record.
    fn motion(
        &self,
        motion: &Progress,
        pulses: Range<usize>,
        cost: f64,
        changes: &Changes,
    ) -> Motion {
        let mut list = Vec::new();
        let mut place = Some(motion.latest);
        while let Some(index) = place {
            list.push(changes[index].1);
            place = changes[index].0;
        }
        let sign = self.pulses[pulses.start].change.signum();
        let count = self.pulses.len();
        let (pulses, changes) = if self.is_reversed {
            let turned = list.into_iter().map(|pulse| count - 1 - pulse);
            (count - pulses.end..count - pulses.start, turned.collect())
        } else {
            list.reverse();
            (pulses, list)
        };
        Motion {
            pulses,
            changes,
            speed: motion.speed,
            top: sign * motion.top,
            distance: motion.distance,
            is_open: (false, false),
            cost,
        }
    }
}

/// The cost of creeping until a time.
fn creeping(motion: &Progress, until: f64) -> f64 {
    if motion.creeps {
        (cost::CREEP_SECOND * (until - motion.since)).min(cost::MOST_CREEP)
    } else {
        0.0
    }
}

fn disturbances(prior: &Prior, pulses: &[Turned], first: usize) -> Vec<(usize, f64)> {
    let (mut speed, mut way, mut found) = (0.0f64, 0.0f64, Vec::new());
    let last = pulses.len().min(first + MOST_IN_DISTURBANCE);
    for index in first..last {
        let pulse = pulses[index];
        let pause = if index > first {
            pulse.from - pulses[index - 1].to
        } else {
            0.0
        };
        let length = pulse.to - pulse.from;
        way += speed * pause + (speed + pulse.change / 2.0) * length;
        speed += pulse.change;
        if pause > LONGEST_PAUSE || length > LONGEST_SWING || way.abs() > FARTHEST_SWING {
            break;
        }
        if index > first {
            found.push((index + 1, prior.disturbance(speed)));
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::collections::BTreeMap;

    /// A few pulses in a row, some of them close to each other.
    pub(crate) fn pulses() -> impl Strategy<Value = Vec<Pulse>> {
        let pulse = (
            0.1..4.0f64,
            0.2..2.0f64,
            prop::sample::select(vec![-1.0, -0.7, -0.3, -0.05, 0.05, 0.3, 0.7, 1.0]),
        );
        prop::collection::vec(pulse, 1..7).prop_map(|parts| {
            let mut time = 1.0;
            let pulses = parts.into_iter().map(|(pause, length, change)| {
                let from = time + pause;
                time = from + length;
                Pulse {
                    blocks: 0..1,
                    from,
                    to: time,
                    change,
                    deviation: 0.01,
                    peak: 1.0,
                    is_swing: false,
                }
            });
            pulses.collect()
        })
    }

    /// Every motion that begins with a pulse, without giving any up: the cheapest for each end.
    fn exhaustive(stretch: &Stretch, first: usize) -> BTreeMap<(usize, bool), f64> {
        let mut best = BTreeMap::new();
        let mut note = |key: (usize, bool), cost: f64| {
            let known = best.entry(key).or_insert(f64::INFINITY);
            *known = known.min(cost);
        };
        let Some(start) = stretch.start(first) else {
            return best;
        };
        let mut waiting = vec![(start, first + 1)];
        while let Some((motion, next)) = waiting.pop() {
            if next == stretch.pulses.len() {
                let slow = stretch
                    .prior
                    .implausible(motion.top, f64::INFINITY, f64::INFINITY);
                note(
                    (next, true),
                    motion.cost + creeping(&motion, stretch.end) + slow,
                );
                continue;
            }
            let others = [(next + 1, stretch.ignored(next))].into_iter();
            for (after, cost) in others.chain(stretch.disturbances(next).iter().copied()) {
                let cost = motion.cost + cost;
                waiting.push((Progress { cost, ..motion }, after));
                let changed = stretch.changed(&motion, next..after);
                let closed = stretch.closed(&changed, first, after - 1);
                note((after, false), closed.cost);
                waiting.push((stretch.going_on(changed, &motion, first), after));
            }
        }
        best
    }

    proptest! {
        /// What is given up early would not have been the cheapest, unless it is hopeless.
        #[test]
        fn the_cheapest_motions_are_found(pulses in pulses()) {
            let prior = Prior::default();
            let end = pulses.last().map_or(0.0, |pulse| pulse.to + 3.0);
            let forwards = Stretch::new(&prior, &pulses, (0.0, end));
            for stretch in [forwards.reversed(), forwards] {
                for first in 0..pulses.len() {
                    let mut found = BTreeMap::new();
                    stretch.motions(first, &mut |motion, is_open| {
                        let edge = if stretch.is_reversed {
                            pulses.len() - motion.pulses.start
                        } else {
                            motion.pulses.end
                        };
                        let known = found.entry((edge, is_open)).or_insert(f64::INFINITY);
                        *known = motion.cost.min(*known);
                    });
                    for (key, cost) in exhaustive(&stretch, first) {
                        if cost < stretch.usual[key.0] - stretch.usual[first] + 8.0 {
                            let found = found.get(&key).copied().unwrap_or(f64::INFINITY);
                            prop_assert!((found - cost).abs() < 1e-9, "{:?}: {} for {}", key, found, cost);
                        }
                    }
                }
            }
        }
    }
}
