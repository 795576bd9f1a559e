//! The counters that a plan wants.

use super::NOTHING;
use crate::claim::Pair;
use crate::ledger::{Key, Ledger};
use crate::plan::Plan;
use crate::results::{Checkpoint, Row};
use crate::run::{Lack, Subject};
use std::collections::BTreeMap;

/// The counters of a plan.
#[derive(Clone, Debug)]
pub(super) struct Wanted {
    /// Of every point.
    pub points: Vec<Key>,
    /// Of every pair.
    pub pairs: Vec<Compared>,
}

/// How two points are compared.
#[derive(Clone, Debug)]
pub(super) enum Compared {
    /// They are the same and never differ.
    Itself,
    /// By the trials of the noise they share.
    Paired(Key, [usize; 2]),
    /// By their rates alone.
    Apart,
}

impl Wanted {
    pub fn new(plan: &Plan, pairs: &[Pair]) -> Self {
        let key = |row: &Row| row.key(plan.seed, plan.common_random_numbers);
        let rows = plan.points.iter().map(|p| Row::new(p, None, NOTHING, 0.5));
        let points: Vec<Key> = rows.map(|row| key(&row)).collect();
        let family_of = plan.families();
        let compared = |pair: &Pair| {
            let places = [pair.first, pair.second];
            let keys = places.map(|place| &points[place]);
            let [first, second] = places.map(|place| family_of[place]);
            match (keys[0] == keys[1], first == second) {
                (true, _) => Compared::Itself,
                (_, true) => Compared::Paired(Key::pair(keys), places),
                _ => Compared::Apart,
            }
        };
        Self {
            pairs: pairs.iter().map(compared).collect(),
            points,
        }
    }

    /// Every counter once, and what it counts.
    pub fn subjects(&self) -> BTreeMap<&Key, Subject> {
        let points = self.points.iter().enumerate();
        let points = points.map(|(place, key)| (key, Subject::Point(place)));
        let pairs = self.pairs.iter().filter_map(|pair| match pair {
            Compared::Paired(key, places) => Some((key, Subject::Pair(*places))),
            Compared::Itself | Compared::Apart => None,
        });
        points.chain(pairs).collect()
    }

    /// What is not counted yet.
    pub fn lacks(&self, state: &Checkpoint) -> Vec<Lack> {
        let lack = |(key, subject): (&Key, Subject)| Lack {
            trials: state.counters.missing(key, state.wanted()),
            key: key.clone(),
            subject,
        };
        let lacks = self.subjects().into_iter().map(lack);
        lacks.filter(|lack| !lack.trials.is_empty()).collect()
    }

    /// Enters every counter, so that a ledger tells how much there is to do.
    pub fn expect_in(&self, ledger: &mut Ledger) {
        for (key, subject) in self.subjects() {
            ledger.expect(key, subject.counts());
        }
    }
}
