//! Detectors of a start as running statistics: a score after every sample, large where there is motion.
//!
//! A detector alarms where its score reaches a threshold. None of the thresholds is exact for all of them, so they are
//! measured at one rate of false alarms. Samples are in deviations of the noise; the bias is 0, and those that are told σ
//! take it for 1.
//!
//! | detector | score | learns |
//! |---|---|---|
//! | `three_sample` | −ln(p_W p_T) of [`Exceedances::Scale`], sliding | X |
//! | `mended` | −ln(p_W p_T′) of [`Exceedances::Motion`], sliding | X |
//! | `ranks` | CUSUMs of [sequential ranks](super::sequential) | all blocks |
//! | `cusum`, `glr` | CUSUMs and generalised likelihood ratio of a mean | mean and σ of blocks |
//! | `cusum_variance`, `glr_variance` | of mean and variance | mean and σ of blocks |
//! | `zero_rule` | the largest size of n samples | nothing: is told bias and σ |
//! | `uniform` | the size of the mean of 0.5 s | nothing: is told bias and σ |
//! | `clairvoyant` | matched filter | nothing: is told shape, sign, σ and colour |
//!
//! Times are those of 100 samples a second: blocks of 0.2 s, those of the three samples of 0.12 s. The three-sample rule
//! and the zero rule are published; for the others see their files.

mod blocks;
mod matched;
mod plain;
mod ranks;
mod standard;
#[cfg(test)]
mod tests;
mod three;

pub use blocks::RATE;
pub use matched::Told;
pub use three::Tables;

use super::rule::Exceedances;
use crate::rng::Generator;
use blocks::{Blocks, Score};
use matched::Matched;
use plain::{Uniform, ZeroRule};
use ranks::SequentialRanks;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use standard::{Chart, Standard};
use std::fmt;
use three::ThreeSamples;

/// A detector has learnt after so many samples: a reference of 12 s and a gap of 3 s.
pub const LEARNING: usize = blocks::BLOCK * (blocks::REFERENCE + blocks::GAP);

/// Which detector.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "snake_case")]
pub enum Detector {
    /// W and T.
    ThreeSample,
    /// W and T′.
    Mended,
    /// CUSUMs of sequential ranks.
    Ranks,
    /// CUSUMs of a shift of the mean.
    Cusum,
    /// CUSUMs of a shift of the mean with more variance.
    CusumVariance,
    /// Generalised likelihood ratio of a mean.
    Glr,
    /// Generalised likelihood ratio of mean and variance.
    GlrVariance,
    /// Not all of n samples below a threshold.
    ZeroRule,
    /// Change of the local mean.
    Uniform,
    /// Told all but when.
    Clairvoyant,
}

/// A detector at work.
#[derive(Clone, Debug)]
pub struct Running(Kind);

#[derive(Clone, Debug)]
enum Kind {
    Three(Blocks<ThreeSamples>),
    Ranks(Blocks<SequentialRanks>),
    Standard(Blocks<Standard>),
    Zero(ZeroRule),
    Uniform(Uniform),
    Matched(Matched),
}

impl Detector {
    /// Whether it is told the shape of the start, so that its threshold depends on it.
    pub fn knows_start(self) -> bool {
        self == Self::Clairvoyant
    }

    /// Sets it to work. `told` serves the clairvoyant, `ties` breaks ties between blocks.
    pub fn start(self, tables: &Tables, told: &Told, ties: Generator) -> Running {
        let three = |of| Kind::Three(Blocks::new(three::BLOCK, tables.start(of, ties.clone())));
        let standard = |chart| Kind::Standard(Blocks::new(blocks::BLOCK, Standard::new(chart)));
        Running(match self {
            Self::ThreeSample => three(Exceedances::Scale),
            Self::Mended => three(Exceedances::Motion),
            Self::Ranks => Kind::Ranks(Blocks::new(blocks::BLOCK, SequentialRanks::new(ties))),
            Self::Cusum => standard(Chart::cusum()),
            Self::CusumVariance => standard(Chart::cusum_variance()),
            Self::Glr => standard(Chart::glr()),
            Self::GlrVariance => standard(Chart::glr_variance()),
            Self::ZeroRule => Kind::Zero(ZeroRule::default()),
            Self::Uniform => Kind::Uniform(Uniform::default()),
            Self::Clairvoyant => Kind::Matched(Matched::new(told)),
        })
    }
}

impl Running {
    /// Takes in samples up to the first after which the score is what is looked for. The score is −∞ before there is one;
    /// between blocks the last stands.
    pub fn find(&mut self, samples: &[f64], is_it: impl FnMut(f64) -> bool) -> Option<usize> {
        match &mut self.0 {
            Kind::Three(it) => it.find(samples, is_it),
            Kind::Ranks(it) => it.find(samples, is_it),
            Kind::Standard(it) => it.find(samples, is_it),
            Kind::Zero(it) => it.find(samples, is_it),
            Kind::Uniform(it) => it.find(samples, is_it),
            Kind::Matched(it) => it.find(samples, is_it),
        }
    }

    /// Takes in all of them and returns the largest score of those after the first `skipped`.
    pub fn largest(&mut self, samples: &[f64], skipped: usize) -> f64 {
        let (before, after) = samples.split_at(skipped);
        self.learn(before);
        let mut largest = f64::NEG_INFINITY;
        self.find(after, |score| {
            largest = largest.max(score);
            false
        });
        largest
    }

    /// Takes in all of them.
    pub fn learn(&mut self, samples: &[f64]) {
        self.find(samples, |_| false);
    }
}

impl fmt::Display for Detector {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}
