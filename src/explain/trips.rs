//! The motions that pulses may be part of.
//!
//! A motion begins with a pulse, and every later pulse either changes its speed, or is something else, or belongs
//! to a disturbance. It may end at a change that brings the speed back to zero. Motions that began before the
//! record are those of the reversed record that go on after its end: reversed, braking is a start.

use super::cost;
use super::progress::Progress;
use super::pulse::Pulse;
use super::stretch::Stretch;
use std::collections::{BTreeMap, VecDeque};
use std::ops::Range;

/// The most partial motions kept at a pulse.
const WIDTH: usize = 32;

/// A motion is given up that costs this much more than the usual explanation of its pulses up to here, and up to each of
/// so many more: it may end at one that is dear to explain otherwise.
const HOPELESS: f64 = 12.0;
const AHEAD: usize = 6;

/// A motion is followed over so many pulses: one that is shaken more than that is left undecided.
const MOST_FOLLOWED: usize = 120;

/// A usual trip has fewer pulses than this.
const SHORT_TRIP: usize = 8;

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

impl Motion {
    /// How many of its changes are stages of acceleration after the first change; of one that was not seen to begin,
    /// stages of braking before the last.
    pub fn late_stages(&self, pulses: &[Pulse]) -> usize {
        let changes = self.changes.iter().map(|pulse| pulses[*pulse].change);
        let mut changes: Vec<f64> = changes.collect();
        if self.is_open.0 {
            changes.reverse();
        }
        let (mut speed, least) = (0.0, cost::LEAST_STAGE * self.top.abs());
        let is_late = |change: &&f64| {
            let is_late = **change * speed > 0.0 && change.abs() > least;
            speed += **change;
            is_late
        };
        changes.iter().filter(is_late).count()
    }
}

/// A motion in progress, and its latest change in the list of all.
#[derive(Clone, Copy, Debug)]
struct Listed {
    progress: Progress,
    latest: usize,
}

impl Listed {
    fn dearer(self, by: f64) -> Self {
        let cost = self.progress.cost + by;
        Self {
            progress: Progress {
                cost,
                ..self.progress
            },
            ..self
        }
    }
}

/// The changes of all motions in progress: the one before, and the pulse.
type Changes = Vec<(Option<usize>, usize)>;

/// The motions of a stretch.
pub struct Motions<'a> {
    stretch: Stretch<'a>,
    /// What the usual explanation of the first pulses costs.
    usual: Vec<f64>,
}

impl<'a> Motions<'a> {
    /// Those of a stretch, with which the record begins or not.
    pub fn new(stretch: Stretch<'a>, is_first: bool) -> Self {
        let usual = Vec::new();
        let mut motions = Self { stretch, usual };
        motions.usual = motions.usual();
        if is_first {
            // The first pulses may end a motion that began before the record: none costs more than with those after it.
            // So may those after a hole; but there it doubts one trip in twelve more, and mends one in 350.
            let count = motions.stretch.pulses.len();
            for first in (0..SHORT_TRIP.min(count)).rev() {
                motions.usual[first] = motions.usual[first].min(motions.usual[first + 1]);
            }
        }
        motions
    }

    /// What an explanation of the first pulses costs that knows short trips only: a bound for what is worth following.
    fn usual(&self) -> Vec<f64> {
        let count = self.stretch.pulses.len();
        let mut usual = vec![f64::INFINITY; count + 1];
        usual[0] = 0.0;
        for first in 0..count {
            let so_far = usual[first];
            let mut note = |end: usize, cost: f64| usual[end] = usual[end].min(so_far + cost);
            note(first + 1, self.stretch.pulses[first].ignored);
            for (after, cost) in self.stretch.disturbances(first) {
                note(after, cost);
            }
            let far = (first + SHORT_TRIP).min(count);
            self.follow(
                first,
                far,
                |_, _| f64::INFINITY,
                &mut |_, cost, last, is_open| {
                    if !is_open {
                        note(last + 1, cost);
                    }
                },
            );
        }
        usual
    }

    /// The motions that begin with a pulse: those that end within the stretch, and those that go on; of those over the
    /// same pulses the cheapest. One much dearer than the usual explanation of its pulses cannot matter.
    pub fn of(&self, first: usize, take: &mut impl FnMut(Motion, bool)) {
        let most = |first: usize, pulse: usize| {
            let ends = &self.usual[pulse..=(pulse + AHEAD).min(self.stretch.pulses.len())];
            ends.iter().copied().fold(0.0, f64::max) - self.usual[first] + HOPELESS
        };
        let far = self.stretch.pulses.len().min(first + MOST_FOLLOWED);
        // By where they end: which was found when, its cost, and the motion.
        let mut cheapest: BTreeMap<(usize, bool), (usize, f64, Listed)> = BTreeMap::new();
        let mut found = 0;
        let changes = self.follow(first, far, most, &mut |motion, cost, last, is_open| {
            found += 1;
            let known = cheapest.get(&(last, is_open));
            if cost - (self.usual[last + 1] - self.usual[first]) <= HOPELESS
                && known.is_none_or(|known| cost < known.1)
            {
                cheapest.insert((last, is_open), (found, cost, *motion));
            }
        });
        let mut cheapest: Vec<_> = cheapest.into_iter().collect();
        cheapest.sort_unstable_by_key(|it| it.1.0);
        for ((last, is_open), (_, cost, motion)) in cheapest {
            let pulses = first..last + 1;
            take(self.motion(&motion, cost, pulses, &changes), is_open);
        }
    }

    /// Whether motions that begin with a pulse are followed to the end of the stretch, so that one may go on after it.
    pub fn reach_the_end(&self, first: usize) -> bool {
        first + MOST_FOLLOWED >= self.stretch.pulses.len()
    }

    /// Follows the motions that begin with a pulse over those before `far`, while they cost less than `most` of the first
    /// pulse and the next. Takes each at its last pulse, with its whole cost; returns their changes.
    fn follow(
        &self,
        first: usize,
        far: usize,
        most: impl Fn(usize, usize) -> f64,
        take: &mut impl FnMut(&Listed, f64, usize, bool),
    ) -> Changes {
        let Some(progress) = self.stretch.start(first) else {
            return Changes::new();
        };
        let mut changes: Changes = vec![(None, first)];
        let mut waiting = VecDeque::from([vec![Listed {
            progress,
            latest: 0,
        }]]);
        for pulse in first + 1..far {
            let mut here = waiting.pop_front().unwrap_or_default();
            let most = most(first, pulse);
            here.retain(|motion| motion.progress.cost < most);
            here.sort_by(|a, b| a.progress.cost.total_cmp(&b.progress.cost));
            here.truncate(WIDTH);
            let is_over = self.stretch.pulses[pulse].from - self.stretch.pulses[first].from
                > self.stretch.prior.longest_motion;
            if is_over || (here.is_empty() && waiting.iter().all(Vec::is_empty)) {
                return changes;
            }
            for motion in here.drain(..) {
                let mut wait = |until: usize, motion: Listed| {
                    let place = until - pulse - 1;
                    if waiting.len() <= place {
                        waiting.resize(place + 1, Vec::new());
                    }
                    waiting[place].push(motion);
                };
                wait(pulse + 1, motion.dearer(self.stretch.ignored(pulse)));
                for (after, cost) in self.stretch.disturbances(pulse) {
                    wait(after, motion.dearer(cost));
                }
                let disturbances = self.stretch.disturbances(pulse).map(|it| it.0);
                for after in [pulse + 1].into_iter().chain(disturbances) {
                    let progress = self.stretch.changed(&motion.progress, pulse..after);
                    let mut latest = motion.latest;
                    for change in pulse..after {
                        changes.push((Some(latest), change));
                        latest = changes.len() - 1;
                    }
                    let changed = Listed { progress, latest };
                    let cost = self.stretch.closed(&progress, first, after - 1);
                    take(&changed, cost, after - 1, false);
                    let progress = self.stretch.going_on(progress, &motion.progress, after);
                    wait(after, Listed { progress, latest });
                }
            }
            waiting.push_back(here);
        }
        if far == self.stretch.pulses.len() {
            for motion in waiting.front().into_iter().flatten() {
                let cost = self.stretch.open(&motion.progress);
                take(motion, cost, self.stretch.pulses.len() - 1, true);
            }
        }
        changes
    }

    /// As it is in the order of the record.
    fn motion(
        &self,
        &Listed { progress, latest }: &Listed,
        cost: f64,
        pulses: Range<usize>,
        changes: &Changes,
    ) -> Motion {
        let mut list = Vec::new();
        let mut place = Some(latest);
        while let Some(index) = place {
            list.push(changes[index].1);
            place = changes[index].0;
        }
        let sign = self.stretch.pulses[pulses.start].change.signum();
        let count = self.stretch.pulses.len();
        let (pulses, changes) = if self.stretch.is_reversed {
            let turned = list.into_iter().map(|pulse| count - 1 - pulse);
            (count - pulses.end..count - pulses.start, turned.collect())
        } else {
            list.reverse();
            (pulses, list)
        };
        Motion {
            pulses,
            changes,
            speed: progress.speed,
            top: sign * progress.top,
            distance: progress.distance,
            is_open: (false, false),
            cost,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::cost::Prior;
    use super::super::pulse::Pulse;
    use super::*;
    use proptest::prelude::*;

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
                    is_violent: false,
                    is_swing: false,
                    shift: 0.0,
                    is_level: false,
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
                note((next, true), stretch.open(&motion));
                continue;
            }
            let others = [(next + 1, stretch.ignored(next))].into_iter();
            for (after, cost) in others.chain(stretch.disturbances(next)) {
                let cost = motion.cost + cost;
                waiting.push((Progress { cost, ..motion }, after));
                let changed = stretch.changed(&motion, next..after);
                let closed = stretch.closed(&changed, first, after - 1);
                note((after, false), closed);
                waiting.push((stretch.going_on(changed, &motion, after), after));
            }
        }
        best
    }

    proptest! {
        /// What is given up early would not have been the cheapest, unless it is hopeless. No two are over the same
        /// pulses: a record of a few kilobytes that is all pulses would have a million.
        #[test]
        fn the_cheapest_motions_are_found(pulses in pulses()) {
            let prior = Prior::default();
            let end = pulses.last().map_or(0.0, |pulse| pulse.to + 3.0);
            let forwards = Stretch::new(&prior, &pulses, (0.0, end));
            for stretch in [forwards.reversed(), forwards] {
                let motions = Motions::new(stretch, true);
                let stretch = &motions.stretch;
                for first in 0..pulses.len() {
                    let mut found = BTreeMap::new();
                    motions.of(first, &mut |motion, is_open| {
                        let edge = if stretch.is_reversed {
                            pulses.len() - motion.pulses.start
                        } else {
                            motion.pulses.end
                        };
                        let known = found.insert((edge, is_open), motion.cost);
                        assert_eq!(known, None, "one for each end");
                    });
                    for (key, cost) in exhaustive(stretch, first) {
                        if cost < motions.usual[key.0] - motions.usual[first] + 8.0 {
                            let found = found.get(&key).copied().unwrap_or(f64::INFINITY);
                            prop_assert!((found - cost).abs() < 1e-9, "{:?}: {} for {}", key, found, cost);
                        }
                    }
                }
            }
        }
    }
}
