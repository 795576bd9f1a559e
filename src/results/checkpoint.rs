//! `counts.json`: the counts of a run that is not over, or of one share of a run.
//!
//! One JSON object on one line. Its last member is the SHA-256 of all the text before that member, so that
//! neither half a file nor an edited one is taken for counts.

use super::{Origin, Told, sha256};
use crate::ensemble::BLOCK;
use crate::ledger::{Key, Ledger};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;
use std::str::FromStr;

/// What `counts.json` holds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    /// Of which experiment.
    pub origin: Origin,
    /// The share of the trials that is run here; all of them where there is none.
    pub shard: Option<Shard>,
    /// Wall clock of the simulation so far.
    pub seconds: f64,
    /// What each point's decision is known by, once it is.
    pub told: BTreeMap<Key, Told>,
    /// The counts.
    pub counters: Ledger,
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

/// No share of a run.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a shard is i/n with i from 1 to n, got {0:?}")]
pub struct NoShard(String);

const SEAL: &str = ",\"sha256\":\"";
const SEAL_LENGTH: usize = SEAL.len() + 64 + "\"}\n".len();

impl Checkpoint {
    /// The file's text.
    pub fn to_json(&self) -> Vec<u8> {
        let mut json = serde_json::to_vec(self).expect("a checkpoint is plain data");
        json.pop();
        let seal = format!("{SEAL}{}\"}}\n", sha256(&json));
        json.extend(seal.bytes());
        json
    }

    /// What the text says; what is wrong with it.
    ///
    /// # Errors
    /// Where a byte is not as it was written.
    pub fn from_json(json: &[u8]) -> Result<Self, String> {
        let body = json.len().saturating_sub(SEAL_LENGTH);
        let (body, seal) = json.split_at(body);
        if seal != format!("{SEAL}{}\"}}\n", sha256(body)).as_bytes() {
            return Err("its bytes are not those that its own sha256 vouches for".to_owned());
        }
        serde_json::from_slice(json).map_err(|error| error.to_string())
    }

    /// The trials that are to be counted here.
    pub fn wanted(&self) -> Range<u64> {
        match self.shard {
            Some(shard) => shard.trials(self.origin.trials),
            None => 0..self.origin.trials,
        }
    }
}

impl Shard {
    /// Its trials of `trials`: whole blocks, as evenly as can be.
    pub fn trials(self, trials: u64) -> Range<u64> {
        let blocks = u128::from(trials.div_ceil(BLOCK));
        let cut = |number: u64| {
            let block = blocks * u128::from(number) / u128::from(self.count);
            trials.min(block as u64 * BLOCK)
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
            (1 <= number && number <= count).then_some(Self { number, count })
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
        fn shards_share_the_trials(trials in 1..50_000u64, count in 1..70u64) {
            let mut next = 0;
            for number in 1..=count {
                let share = Shard { number, count }.trials(trials);
                prop_assert_eq!(share.start, next);
                prop_assert!(share.end.is_multiple_of(BLOCK) || share.end == trials);
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
