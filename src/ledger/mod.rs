//! What has been counted so far, and of which trials: counters that add.
//!
//! A counter is known by what it counts, never by its place in a plan: see [`Key`]. It holds the trials
//! that were counted and the counts, nothing derived. Two ledgers add up to the ledger of a run that
//! did the trials of both; trials that are in both are refused, so nothing is ever counted twice. To
//! checkpoint is to write a ledger, to resume is to count what one lacks, to run in shards is to add the
//! ledgers of many machines, to raise the number of trials is to want more of the same counters.

mod ranges;

pub use ranges::{Overlap, Ranges};

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;

/// The name of a counter: a hash of all that its counts depend on, but the trials.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Key(String);

impl Key {
    /// The key of what `text` tells from everything else.
    pub fn of(text: &str) -> Self {
        // 96 bits: a billion counters collide with a probability of 1e-11.
        let hash = Sha256::digest(text.as_bytes());
        Self(
            hash[..12]
                .iter()
                .map(|byte| format!("{byte:02x}"))
                .collect(),
        )
    }

    /// The key of two counters compared trial by trial.
    pub fn pair([first, second]: [&Self; 2]) -> Self {
        Self::of(&format!("{first} against {second}"))
    }
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// Counts, and the trials that they are of.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counter {
    /// Every trial that was counted.
    pub trials: Ranges,
    /// Of one point: trials that decided for H₁. Of two: those in which only the first, only the second
    /// did.
    pub counts: Vec<u64>,
}

/// Counters by what they count.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Ledger {
    counters: BTreeMap<Key, Counter>,
}

/// Why counts do not add.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("counter {key}: {refusal}")]
pub struct LedgerError {
    /// Of which counter.
    pub key: Key,
    /// Why not.
    pub refusal: Refusal,
}

/// What is wrong with an addition.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Refusal {
    /// Trials that were counted before.
    #[error(transparent)]
    Overlap(#[from] Overlap),
    /// One point's counts and two points'.
    #[error("{held} counts and {more} do not add")]
    Kind {
        /// Counts there.
        held: usize,
        /// Counts to be added.
        more: usize,
    },
}

impl Ledger {
    /// Every counter.
    pub fn iter(&self) -> impl Iterator<Item = (&Key, &Counter)> {
        self.counters.iter()
    }

    /// One counter.
    pub fn get(&self, key: &Key) -> Option<&Counter> {
        self.counters.get(key)
    }

    /// Makes sure of a counter, of nothing yet where it is new.
    pub fn expect(&mut self, key: &Key, counts: usize) {
        if !self.counters.contains_key(key) {
            let (trials, counts) = (Ranges::default(), vec![0; counts]);
            self.counters
                .insert(key.clone(), Counter { trials, counts });
        }
    }

    /// Adds what was counted in further trials.
    ///
    /// # Errors
    /// Where some of them were counted before.
    pub fn add(
        &mut self,
        key: &Key,
        trials: Range<u64>,
        counts: &[u64],
    ) -> Result<(), LedgerError> {
        self.expect(key, counts.len());
        let counter = self.counters.get_mut(key).expect("it was made sure of");
        let added = match counter.counts.len() == counts.len() {
            true => counter.trials.add(trials).map_err(Refusal::from),
            false => Err(Refusal::Kind {
                held: counter.counts.len(),
                more: counts.len(),
            }),
        };
        added.map_err(|refusal| LedgerError {
            key: key.clone(),
            refusal,
        })?;
        (counter.counts.iter_mut().zip(counts)).for_each(|(sum, more)| *sum += more);
        Ok(())
    }

    /// Adds another ledger. Takes time in proportion to that one.
    ///
    /// # Errors
    /// Where a trial is in both; some counters may have been added then.
    pub fn merge(&mut self, other: &Self) -> Result<(), LedgerError> {
        for (key, Counter { trials, counts }) in other.iter() {
            self.expect(key, counts.len());
            let mut counts = &counts[..];
            let nothing = vec![0; counts.len()];
            for range in trials.iter() {
                // The counts are those of all stretches together.
                self.add(key, range, counts)?;
                counts = &nothing;
            }
        }
        Ok(())
    }

    /// What of the wanted trials a counter lacks.
    pub fn missing(&self, key: &Key, wanted: Range<u64>) -> Ranges {
        match self.get(key) {
            Some(counter) => counter.trials.missing(wanted),
            None => wanted.into(),
        }
    }

    /// Whether every trial of every counter of `other` is here too.
    pub fn covers(&self, other: &Self) -> bool {
        let is_covered = |(key, counter): (&Key, &Counter)| {
            counter.trials.is_empty()
                || (self.get(key)).is_some_and(|held| held.trials.covers(&counter.trials))
        };
        other.iter().all(is_covered)
    }

    /// Drops the counters that are not wanted.
    pub fn retain(&mut self, is_wanted: impl Fn(&Key) -> bool) {
        self.counters.retain(|key, _| is_wanted(key));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Parts add up to the whole in any order, once.
        #[test]
        fn ledgers_add(hits in proptest::collection::vec(0..3u64, 1..20), turn in 0..20usize) {
            let keys = [Key::of("a"), Key::of("b")];
            let part = |(index, hits): (usize, &u64)| {
                let (mut part, index) = (Ledger::default(), index as u64);
                part.add(&keys[0], 8 * index..8 * index + 8, &[*hits]).unwrap();
                part.add(&keys[1], 8 * index..8 * index + 8, &[*hits, 1]).unwrap();
                part
            };
            let mut parts: Vec<Ledger> = hits.iter().enumerate().map(part).collect();
            let turn = turn % parts.len();
            parts.rotate_left(turn);
            let mut sum = Ledger::default();
            parts.iter().for_each(|part| sum.merge(part).unwrap());
            let all = 8 * hits.len() as u64;
            prop_assert_eq!(&sum.get(&keys[0]).unwrap().counts, &[hits.iter().sum::<u64>()]);
            prop_assert_eq!(&sum.get(&keys[1]).unwrap().counts[1], &(all / 8));
            prop_assert_eq!(sum.missing(&keys[0], 0..all + 5), Ranges::from(all..all + 5));
            prop_assert!(parts.iter().all(|part| sum.covers(part)));
            prop_assert!(sum.clone().merge(&parts[0]).is_err());
        }
    }
}
