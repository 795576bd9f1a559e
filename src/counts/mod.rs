//! Counters that add: what has been counted so far, and in which trials.
//!
//! A counter is identified by what it counts, never by its place in a plan: see [`Key`]. It holds the indices
//! of the counted trials and their sums, nothing derived. Adding two sets of counts gives the counts of a run
//! of all their trials; overlapping trials are refused, so nothing is counted twice. A checkpoint is a file of
//! counts, resuming a run counts the missing trials, merging shards adds their counts, and raising the number
//! of trials extends the same counters.

mod ranges;
mod sums;

pub use ranges::{Overlap, Ranges, StretchError};
pub use sums::{Counter, Fixed, Shape, Sums, Values};

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;

/// The identity of a counter: a hash of everything its sums depend on except the trials.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub struct Key([u8; BYTES]);

/// Bytes of a key. With 96 bits, a billion counters collide with a probability of 1e-11.
const BYTES: usize = 12;

/// Hexadecimal digits of a key.
const DIGITS: usize = 2 * BYTES;

/// A text that is no key.
#[derive(Debug, thiserror::Error)]
#[error("a counter's key must be {DIGITS} hexadecimal digits")]
pub struct NoKey;

impl TryFrom<String> for Key {
    type Error = NoKey;

    fn try_from(text: String) -> Result<Self, NoKey> {
        let is_key = text.len() == DIGITS && text.bytes().all(|byte| byte.is_ascii_hexdigit());
        let number = is_key
            .then(|| u128::from_str_radix(&text, 16).ok())
            .flatten();
        let bytes = number.ok_or(NoKey)?.to_be_bytes();
        Ok(Self(*bytes.last_chunk().expect("more bytes than a key")))
    }
}

impl From<Key> for String {
    fn from(key: Key) -> Self {
        key.to_string()
    }
}

impl Key {
    /// The key of a counter that `text` identifies.
    pub fn of(text: &str) -> Self {
        let hash: [u8; 32] = Sha256::digest(text.as_bytes()).into();
        Self(*hash.first_chunk().expect("more bytes than a key"))
    }

    /// The key of a trial-by-trial comparison of two counters.
    pub fn pair([first, second]: [&Self; 2]) -> Self {
        Self::of(&format!("{first} against {second}"))
    }
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

/// How a point decides, as in `points.csv`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DecisionSummary {
    /// Exact probability of deciding H₁ at rest, where it is known.
    pub size: Option<f64>,
    /// The threshold of a score.
    pub threshold: Option<f64>,
    /// The smallest level that its rule can reach.
    pub reachable: Option<f64>,
}

impl DecisionSummary {
    /// The first difference from `other`, in words.
    fn difference(&self, other: &Self) -> Option<String> {
        let word = |value: Option<f64>| value.map_or("none".to_owned(), |value| value.to_string());
        let each = [
            ("size", self.size, other.size),
            ("threshold", self.threshold, other.threshold),
            ("reachable", self.reachable, other.reachable),
        ];
        let (name, here, there) = each.into_iter().find(|(_, here, there)| here != there)?;
        Some(format!("{name} is {} and {}", word(here), word(there)))
    }
}

/// Counters by their keys.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Counts {
    counters: BTreeMap<Key, Counter>,
    /// The decisions that pilot runs have found.
    pub decisions: BTreeMap<Key, DecisionSummary>,
}

/// Why counts cannot be added or used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[allow(missing_docs, reason = "the messages say it")]
pub enum CountsError {
    #[error("counter {key}: {overlap}")]
    Overlap { key: Key, overlap: Overlap },
    #[error("counter {0}: not as many sums as it should have")]
    Shape(Key),
    #[error("counter {key}: {count} of something that {trials} trials bring {most} of at most")]
    TooMany {
        key: Key,
        count: u64,
        most: u64,
        trials: u64,
    },
    #[error("counter {key}: trial {trial} of {wanted}")]
    Beyond { key: Key, trial: u64, wanted: u64 },
    #[error("counter {key}: trials {} to {} are of another shard", trials.start, trials.end - 1)]
    Elsewhere { key: Key, trials: Range<u64> },
    #[error("counter {0}: sums of no trials")]
    NoTrials(Key),
    #[error("counter {key}: it decides differently: {difference}")]
    Decision { key: Key, difference: String },
}

impl Counts {
    /// Every counter.
    pub fn iter(&self) -> impl Iterator<Item = (&Key, &Counter)> {
        self.counters.iter()
    }

    /// One counter.
    pub fn get(&self, key: &Key) -> Option<&Counter> {
        self.counters.get(key)
    }

    /// Adds an empty counter unless it exists.
    pub fn expect(&mut self, &key: &Key, shape: &Shape) {
        self.counters.entry(key).or_insert_with(|| shape.empty());
    }

    /// Adds the sums of further trials.
    ///
    /// # Errors
    /// If some of them were counted before, or the shapes of the sums differ.
    pub fn add(&mut self, &key: &Key, trials: Range<u64>, sums: &Sums) -> Result<(), CountsError> {
        let counter = self.counters.entry(key);
        let counter = counter.or_insert_with(|| sums.shape().empty());
        if counter.sums.lengths() != sums.lengths() {
            return Err(CountsError::Shape(key));
        }
        (counter.trials.add(trials)).map_err(|overlap| CountsError::Overlap { key, overlap })?;
        counter.sums.add(sums);
        Ok(())
    }

    /// Adds other counts, in time proportional to their number.
    ///
    /// # Errors
    /// If a trial is in both, or a point decides differently; some counters may already have been added.
    pub fn merge(&mut self, other: &Self) -> Result<(), CountsError> {
        for (key, Counter { trials, sums }) in other.iter() {
            self.expect(key, &sums.shape());
            // The sums belong to all ranges together, so they are added once, with the first range.
            let nothing = sums.shape().empty().sums;
            let each = std::iter::once(sums).chain(std::iter::repeat(&nothing));
            for (range, sums) in trials.iter().zip(each) {
                self.add(key, range, sums)?;
            }
        }
        for (&key, there) in &other.decisions {
            let here = self.decisions.entry(key).or_insert(*there);
            if let Some(difference) = here.difference(there) {
                return Err(CountsError::Decision { key, difference });
            }
        }
        Ok(())
    }

    /// The wanted trials that a counter lacks.
    pub fn missing(&self, key: &Key, wanted: Range<u64>) -> Ranges {
        match self.get(key) {
            Some(counter) => counter.trials.missing(wanted),
            None => wanted.into(),
        }
    }

    /// Whether every trial of every counter of `other` is also in this one.
    pub fn covers(&self, other: &Self) -> bool {
        other.iter().all(|(key, there)| {
            let here = self.get(key).map(|here| &here.trials);
            let none = Ranges::default();
            there.trials.without(here.unwrap_or(&none)).is_empty()
        })
    }

    /// Keeps only the selected counters.
    pub fn retain(&mut self, is_wanted: impl Fn(&Key) -> bool) {
        self.counters.retain(|key, _| is_wanted(key));
        self.decisions.retain(|key, _| is_wanted(key));
    }

    /// Checks that a counter is plausible for a `share` of `wanted` trials: its sums have the given shape, no
    /// count is larger than its trials allow, and it has no trial from outside the share.
    ///
    /// # Errors
    /// If the counter is not plausible.
    pub fn check(
        &self,
        key: &Key,
        shape: &Shape,
        share: Range<u64>,
        wanted: u64,
    ) -> Result<(), CountsError> {
        let Some(Counter { trials, sums }) = self.get(key) else {
            return Ok(());
        };
        let key = *key;
        if !shape.fits(sums) {
            return Err(CountsError::Shape(key));
        }
        if let Some(trial) = trials.end().filter(|end| *end > wanted) {
            let trial = trial - 1;
            return Err(CountsError::Beyond { key, trial, wanted });
        }
        if let Some(trials) = trials.without(&share.into()).iter().next() {
            return Err(CountsError::Elsewhere { key, trials });
        }
        let trials = trials.len();
        if trials == 0
            && sums
                .lengths
                .iter()
                .any(|length| *length != Fixed::default())
        {
            return Err(CountsError::NoTrials(key));
        }
        match shape.excess(sums, trials) {
            Some([count, most]) => Err(CountsError::TooMany {
                key,
                count,
                most,
                trials,
            }),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Parts add up to the whole in any order, once.
        #[test]
        fn counts_add(hits in proptest::collection::vec(0..3u64, 1..20), turn in 0..20usize) {
            let keys = [Key::of("a"), Key::of("b")];
            let part = |(index, hits): (usize, &u64)| {
                let (mut part, index) = (Counts::default(), index as u64);
                let trials = 8 * index..8 * index + 8;
                part.add(&keys[0], trials.clone(), &Sums::of(&[*hits])).unwrap();
                part.add(&keys[1], trials, &Sums::of(&[*hits, 1])).unwrap();
                part
            };
            let mut parts: Vec<Counts> = hits.iter().enumerate().map(part).collect();
            let turn = turn % parts.len();
            parts.rotate_left(turn);
            let mut sum = Counts::default();
            parts.iter().for_each(|part| sum.merge(part).unwrap());
            let all = 8 * hits.len() as u64;
            prop_assert_eq!(&sum.get(&keys[0]).unwrap().sums.counts, &[hits.iter().sum::<u64>()]);
            prop_assert_eq!(&sum.get(&keys[1]).unwrap().sums.counts[1], &(all / 8));
            prop_assert_eq!(sum.missing(&keys[0], 0..all + 5), Ranges::from(all..all + 5));
            prop_assert!(parts.iter().all(|part| sum.covers(part)));
            prop_assert!(sum.clone().merge(&parts[0]).is_err());
        }
    }

    /// Merging never overwrites a decision by a different one.
    #[test]
    fn decisions_that_differ_do_not_add() {
        let key = Key::of("a");
        let part = |size, threshold| Counts {
            decisions: BTreeMap::from([(
                key,
                DecisionSummary {
                    size,
                    threshold,
                    reachable: None,
                },
            )]),
            ..Counts::default()
        };
        let known = part(Some(0.05), None);
        for (other, words) in [
            (part(Some(0.04), None), "size is 0.05 and 0.04"),
            (part(Some(0.05), Some(2.5)), "threshold is none and 2.5"),
        ] {
            let mut sum = known.clone();
            sum.merge(&known).unwrap();
            let error = sum.merge(&other).unwrap_err().to_string();
            assert!(error.contains(words), "{error}");
        }
    }

    #[test]
    fn what_cannot_be_counted_is_refused() {
        let key = Key::of("a");
        let mut counts = Counts::default();
        counts.add(&key, 0..10, &Sums::of(&[10, 4])).unwrap();
        let check = |most: &[Option<u64>], wanted| {
            let shape = Shape {
                most: most.to_vec(),
                ..Shape::default()
            };
            counts.check(&key, &shape, 0..wanted, wanted)
        };
        assert_eq!(check(&[Some(1), None], 10), Ok(()));
        assert!(matches!(check(&[Some(1)], 10), Err(CountsError::Shape(_))));
        assert!(matches!(
            check(&[None, None], 9),
            Err(CountsError::Beyond { trial: 9, .. })
        ));
        let shape = Shape::events(2);
        for (share, trials) in [(0..8, 8..10), (2..20, 0..2), (0..0, 0..10), (4..6, 0..4)] {
            let checked = counts.check(&key, &shape, share, 20);
            assert_eq!(checked, Err(CountsError::Elsewhere { key, trials }));
        }
        let too_many = check(&[Some(1), Some(0)], 10);
        assert!(matches!(
            too_many,
            Err(CountsError::TooMany {
                count: 4,
                most: 0,
                ..
            })
        ));
    }
}
