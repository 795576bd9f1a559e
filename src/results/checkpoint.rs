//! `counts.json`: the counts of a run that is not over, or of one share of a run.
//!
//! One JSON object on one line: the counts and their SHA-256, so that neither half a file nor an edited one is
//! taken for counts.

use super::{Origin, sha256};
use crate::counts::Counts;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::ops::Range;
use std::str::FromStr;

/// The counts of a run that is not over.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    /// Of which experiment.
    pub origin: Origin,
    /// The share of the trials that is run here; all of them where there is none.
    pub shard: Option<Shard>,
    /// Trials that are run together: a share has whole blocks.
    pub block: u64,
    /// How many points are counted, pairs of points apart.
    pub points: usize,
    /// Wall clock of the simulation so far.
    pub seconds: f64,
    /// The counts.
    pub counts: Counts,
}

/// What the file holds.
#[derive(Serialize, Deserialize)]
struct Sealed<C> {
    /// Of the other member as this program writes it.
    sha256: String,
    checkpoint: C,
}

impl Checkpoint {
    /// The file's text.
    pub fn to_json(&self) -> Vec<u8> {
        let sealed = Sealed {
            sha256: self.seal(),
            checkpoint: self,
        };
        let mut json = serde_json::to_vec(&sealed).expect("a checkpoint is plain data");
        json.push(b'\n');
        json
    }

    /// What the text says; what is wrong with it.
    ///
    /// # Errors
    /// If it is not as it was written.
    pub fn from_json(json: &[u8]) -> Result<Self, String> {
        let sealed: Sealed<Self> =
            serde_json::from_slice(json).map_err(|error| error.to_string())?;
        if sealed.checkpoint.seal() != sealed.sha256 {
            return Err("its counts are not those that its sha256 vouches for".to_owned());
        }
        match sealed.checkpoint.block {
            0 => Err("block must be at least 1, got 0".to_owned()),
            _ => Ok(sealed.checkpoint),
        }
    }

    fn seal(&self) -> String {
        sha256(&serde_json::to_vec(self).expect("a checkpoint is plain data"))
    }

    /// The trials that are to be counted here.
    pub fn wanted(&self) -> Range<u64> {
        match self.shard {
            Some(shard) => shard.trials(self.origin.trials, self.block),
            None => 0..self.origin.trials,
        }
    }

    /// Trials that are wanted and not there: of all counters, those of pairs among them, on average and rounded
    /// up, so that zero means that nothing is missing.
    pub fn lacking(&self) -> u64 {
        let wanted = self.wanted();
        let counters = self.counts.iter().map(|(_, counter)| &counter.trials);
        let missing = counters.map(|trials| u128::from(trials.missing(wanted.clone()).len()));
        let (number, missing) = missing.fold((0u128, 0u128), |(n, sum), more| (n + 1, sum + more));
        match number {
            0 => wanted.end - wanted.start,
            _ => missing.div_ceil(number) as u64,
        }
    }
}

/// A share of the blocks of a run: `number` of `count`, from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub struct Shard {
    /// From 1.
    pub number: u64,
    /// Of all the shards.
    pub count: u64,
}

/// Not a share of a run.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a shard is i/n with i from 1 to n and n at most 100000, got {0:?}")]
pub struct NoShard(String);

/// More than there are cores; `merge` lists those that are not there.
const MOST_SHARDS: u64 = 100_000;

impl Shard {
    /// Its trials of `trials`: whole blocks, as evenly as can be.
    pub fn trials(self, trials: u64, block: u64) -> Range<u64> {
        let blocks = u128::from(trials.div_ceil(block));
        let cut = |number: u64| {
            let at = blocks * u128::from(number) / u128::from(self.count);
            trials.min((at as u64).saturating_mul(block))
        };
        cut(self.number - 1)..cut(self.number)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.count)
    }
}

impl FromStr for Shard {
    type Err = NoShard;

    fn from_str(text: &str) -> Result<Self, NoShard> {
        let parse = |(number, count): (&str, &str)| {
            let (number, count) = (number.parse().ok()?, count.parse().ok()?);
            (1 <= number && number <= count && count <= MOST_SHARDS)
                .then_some(Self { number, count })
        };
        let shard = text.split_once('/').and_then(parse);
        shard.ok_or_else(|| NoShard(text.to_owned()))
    }
}

impl From<Shard> for String {
    fn from(shard: Shard) -> Self {
        shard.to_string()
    }
}

impl TryFrom<String> for Shard {
    type Error = NoShard;

    fn try_from(text: String) -> Result<Self, NoShard> {
        text.parse()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Shards are whole blocks, and all of them together every trial once.
        #[test]
        fn shards_share_the_trials(trials in 1..50_000u64, count in 1..70u64, block in 1..2000u64) {
            let mut next = 0;
            for number in 1..=count {
                let share = Shard { number, count }.trials(trials, block);
                prop_assert_eq!(share.start, next);
                prop_assert!(share.end.is_multiple_of(block) || share.end == trials);
                next = share.end;
            }
            prop_assert_eq!(next, trials);
        }
    }

    #[test]
    fn a_shard_is_a_fraction() {
        for text in ["", "1", "0/4", "5/4", "1/0", "a/b", "1/2/3", "-1/2"] {
            assert!(text.parse::<Shard>().is_err(), "{text}");
        }
        let shard: Shard = "3/8".parse().unwrap();
        assert_eq!(shard.to_string(), "3/8");
    }
}
