//! Sets of trials as disjoint ranges.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::ops::Range;

/// A set of trial indices, as the fewest disjoint ranges.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(into = "Vec<[u64; 2]>", try_from = "Vec<[u64; 2]>")]
pub struct Ranges {
    /// The end of each range by its start; no two ranges touch.
    ends: BTreeMap<u64, u64>,
}

/// Trials that were counted twice.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("trials {} to {} are counted twice", .0.start, .0.end - 1)]
pub struct Overlap(pub Range<u64>);

/// Why a list of ranges is not a set of trials.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[allow(missing_docs, reason = "the messages say it")]
pub enum StretchError {
    #[error(transparent)]
    Overlap(#[from] Overlap),
    #[error("a stretch of trials must end after its start, got {0} to {1}")]
    Empty(u64, u64),
}

impl Ranges {
    /// How many trials.
    pub fn len(&self) -> u64 {
        self.iter().map(|range| range.end - range.start).sum()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The index after the last trial.
    pub fn end(&self) -> Option<u64> {
        self.ends.last_key_value().map(|(_, &end)| end)
    }

    /// The ranges in ascending order.
    pub fn iter(&self) -> impl Iterator<Item = Range<u64>> + '_ {
        self.ends.iter().map(|(&start, &end)| start..end)
    }

    /// Adds trials, none of which may be in the set.
    ///
    /// # Errors
    /// The first trials that are in the set already; then nothing is added.
    pub fn add(&mut self, range: Range<u64>) -> Result<(), Overlap> {
        if range.is_empty() {
            return Ok(());
        }
        // Mostly the next trials are added to a single range.
        if let Some(mut last) = self.ends.last_entry()
            && *last.get() == range.start
        {
            last.insert(range.end);
            return Ok(());
        }
        if let Some(both) = self.overlap(&range) {
            return Err(Overlap(both));
        }
        let end = self.ends.remove(&range.end).unwrap_or(range.end);
        match self.ends.range_mut(..range.start).next_back() {
            Some((_, before)) if *before == range.start => *before = end,
            _ => drop(self.ends.insert(range.start, end)),
        }
        Ok(())
    }

    /// The first part of `range` that is in the set.
    pub fn overlap(&self, range: &Range<u64>) -> Option<Range<u64>> {
        let before = self.ends.range(..=range.start).next_back();
        let within = self.ends.range(range.start..range.end).next();
        let mut near = before.into_iter().chain(within);
        near.find_map(|(&start, &end)| {
            let both = start.max(range.start)..end.min(range.end);
            (!both.is_empty()).then_some(both)
        })
    }

    /// The part of `wanted` that is not in the set.
    pub fn missing(&self, wanted: Range<u64>) -> Self {
        let mut missing = Self::default();
        let mut from = wanted.start;
        let first = self.ends.range(..=wanted.start).next_back();
        let first = first.map_or(wanted.start, |(&start, _)| start);
        for (&start, &end) in self.ends.range(first..wanted.end) {
            if from < start {
                missing.ends.insert(from, start);
            }
            from = from.max(end);
        }
        if from < wanted.end {
            missing.ends.insert(from, wanted.end);
        }
        missing
    }

    /// The trials of this set that are not in `other`.
    pub fn without(&self, other: &Self) -> Self {
        let each = self.iter().flat_map(|range| other.missing(range).ends);
        Self {
            ends: each.collect(),
        }
    }
}

impl From<Range<u64>> for Ranges {
    fn from(range: Range<u64>) -> Self {
        let stretch = (!range.is_empty()).then_some((range.start, range.end));
        Self {
            ends: stretch.into_iter().collect(),
        }
    }
}

impl From<Ranges> for Vec<[u64; 2]> {
    fn from(ranges: Ranges) -> Self {
        ranges
            .iter()
            .map(|range| [range.start, range.end])
            .collect()
    }
}

impl TryFrom<Vec<[u64; 2]>> for Ranges {
    type Error = StretchError;

    fn try_from(stretches: Vec<[u64; 2]>) -> Result<Self, StretchError> {
        let mut ranges = Self::default();
        for [start, end] in stretches {
            if end <= start {
                return Err(StretchError::Empty(start, end));
            }
            ranges.add(start..end)?;
        }
        Ok(ranges)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::collections::BTreeSet;

    const MOST: u64 = 60;

    fn stretches() -> impl Strategy<Value = Vec<Range<u64>>> {
        proptest::collection::vec((0..MOST, 0..12u64), 0..12).prop_map(|all| {
            all.into_iter()
                .map(|(from, len)| from..from + len)
                .collect()
        })
    }

    /// Adds the ranges that do not overlap, to `Ranges` and to a plain set.
    fn both(stretches: &[Range<u64>]) -> (Ranges, BTreeSet<u64>) {
        let (mut ranges, mut set) = (Ranges::default(), BTreeSet::new());
        for stretch in stretches {
            let twice = stretch.clone().find(|trial| set.contains(trial));
            let added = ranges.add(stretch.clone());
            assert_eq!(added.err().map(|Overlap(range)| range.start), twice);
            if twice.is_none() {
                set.extend(stretch.clone());
            }
        }
        (ranges, set)
    }

    proptest! {
        /// Against a set of single trials.
        #[test]
        fn a_set_of_trials(added in stretches(), from in 0..MOST, len in 0..MOST) {
            let (ranges, set) = both(&added);
            let trials = |ranges: &Ranges| ranges.iter().flatten().collect::<Vec<_>>();
            prop_assert_eq!(trials(&ranges), set.iter().copied().collect::<Vec<_>>());
            prop_assert_eq!(ranges.len(), set.len() as u64);
            let wanted = from..from + len;
            let missing = ranges.missing(wanted.clone());
            let expected: Vec<u64> = wanted.filter(|trial| !set.contains(trial)).collect();
            prop_assert_eq!(trials(&missing), expected);
            let ends: Vec<_> = ranges.iter().collect();
            prop_assert!(ends.windows(2).all(|two| two[0].end < two[1].start), "fewest stretches");
        }

        /// Against the difference of two sets of single trials.
        #[test]
        fn a_difference(added in stretches(), others in stretches()) {
            let ((ranges, set), (others, other)) = (both(&added), both(&others));
            let left: Vec<u64> = ranges.without(&others).iter().flatten().collect();
            prop_assert_eq!(left, set.difference(&other).copied().collect::<Vec<_>>());
        }

        /// Neither the order of additions nor a round trip through a file changes the set.
        #[test]
        fn order_does_not_matter(added in stretches()) {
            let (ranges, _) = both(&added);
            let mut backwards = Ranges::default();
            for range in ranges.iter().collect::<Vec<_>>().into_iter().rev() {
                let middle = range.start + (range.end - range.start) / 2;
                backwards.add(middle..range.end).unwrap();
                backwards.add(range.start..middle).unwrap();
            }
            prop_assert_eq!(&backwards, &ranges);
            let json = serde_json::to_string(&ranges).unwrap();
            prop_assert_eq!(&serde_json::from_str::<Ranges>(&json).unwrap(), &ranges);
            prop_assert!(backwards.without(&ranges).is_empty());
        }
    }
}
