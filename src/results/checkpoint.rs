//! `counts.json`: the counts of an unfinished run or of one shard.
//!
//! One JSON object on one line: the counts and their SHA-256, so that a truncated or edited file is detected.

use super::{Origin, sha256};
use crate::counts::Counts;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::ops::Range;
use std::str::FromStr;

/// The counts of an unfinished run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    /// The experiment.
    pub origin: Origin,
    /// The shard that is run here; `None` for all trials.
    pub shard: Option<Shard>,
    /// Trials in a block; a shard consists of whole blocks.
    pub block: u64,
    /// The number of points counted, without pairs of points.
    pub points: usize,
    /// Wall clock of the simulation so far.
    pub seconds: f64,
    /// The counts.
    pub counts: Counts,
}

/// The content of the file.
#[derive(Serialize, Deserialize)]
struct Sealed<C> {
    /// The hash of the other member as this program writes it.
    sha256: String,
    checkpoint: C,
}

impl Checkpoint {
    /// Writes the file's text.
    pub fn to_json(&self) -> Vec<u8> {
        let sealed = Sealed {
            sha256: self.seal(),
            checkpoint: self,
        };
        let mut json = serde_json::to_vec(&sealed).expect("a checkpoint is plain data");
        json.push(b'\n');
        json
    }

    /// Reads the file's text.
    ///
    /// # Errors
    /// If the text is not a checkpoint, or its hash does not match.
    pub fn from_json(json: &[u8]) -> Result<Self, String> {
        let sealed: Sealed<Self> = serde_json::from_slice(json).map_err(|error| {
            let it: Option<serde_json::Value> = serde_json::from_slice(json).ok();
            match it.and_then(|it| it.get("counts").cloned()) {
                Some(_) => "another version of liftsim wrote it".to_owned(),
                None => error.to_string(),
            }
        })?;
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

    /// The trials to be counted here.
    pub fn wanted(&self) -> Range<u64> {
        match self.shard {
            Some(shard) => shard.trials(self.origin.trials, self.block),
            None => 0..self.origin.trials,
        }
    }

    /// The number of missing trials per counter, pairs included: an average, rounded up, so that zero means
    /// that nothing is missing.
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

/// One of `count` shards of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub struct Shard {
    /// From 1.
    pub number: u64,
    /// The number of shards.
    pub count: u64,
}

/// A text that names no shard.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a shard is i/n with i from 1 to n and n at most 100000, got {0:?}")]
pub struct NoShard(String);

/// The most shards of a run: more than there are cores, and few enough for `merge` to list the missing ones.
const MOST_SHARDS: u64 = 100_000;

impl Shard {
    /// The part of `trials` that belongs to this shard: whole blocks, as even as possible.
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
        /// Shards consist of whole blocks, and together they have every trial once.
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
