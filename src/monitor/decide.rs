//! Decisions on X, Y₁ and Y₂, with X the reference of rest.
//!
//! Forward, Y₂ is the newest blocks and Y₁ those before them, with one decision at every block. A stop is a start
//! reversed in time: Y₁ is the middle of the braking and Y₂ the motion before it.

use super::design::Design;
use super::event::{Decision, Span};
use super::history::History;
use super::reference::Reference;
use crate::detect::{Pooled, Statistics};
use crate::rng::Stream;
use rand::Rng;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// W, T and the decision.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Verdict {
    pub statistics: Statistics,
    /// Whether (W, T) lies in ϑ.
    pub moves: bool,
    /// The sign of Δ, from the side of its mean that W lies on.
    pub sign: f64,
}

/// The positions of Y₁ and Y₂.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Windows {
    pub shift: Range<u64>,
    pub scale: Range<u64>,
}

/// Makes decisions, with random keys for ties.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Decider {
    ties: Stream,
    keys: Vec<u64>,
}

impl Windows {
    /// Compares the newest blocks before `end` with the reference.
    pub fn forwards(design: &Design, end: u64) -> Option<Self> {
        let samples = &design.samples;
        let scale = end.checked_sub(samples.scale() as u64)?;
        let after = scale.checked_sub(samples.gap() as u64)?;
        let shift = after.checked_sub(samples.shift() as u64)?;
        Some(Self {
            shift: shift..after,
            scale: scale..end,
        })
    }

    /// Compares the middle of a braking, and the motion before it, with the reference. It takes the middle because
    /// whitening gives the ends of a pulse the opposite sign.
    pub fn backwards(design: &Design, braking: Range<u64>) -> Option<Self> {
        let samples = &design.samples;
        let [m1, m2, gap] =
            [samples.shift(), samples.scale(), samples.gap()].map(|size| size as u64);
        let shift = u64::midpoint(braking.start, braking.end).checked_sub(m1 / 2)?;
        let before = braking.start.min(shift.checked_sub(gap)?);
        Some(Self {
            shift: shift..shift + m1,
            scale: before.checked_sub(m2)?..before,
        })
    }
}

impl Verdict {
    /// With its threshold, and the times of its samples.
    pub fn decision(
        &self,
        design: &Design,
        reference: Option<Span>,
        [shift, scale]: [Span; 2],
    ) -> Decision {
        let exceedances = self.statistics.exceedances;
        let (lower, upper) = design.region.critical_values()[exceedances];
        Decision {
            rank_sum: self.statistics.rank_sum,
            exceedances,
            lower,
            upper,
            alpha: design.settings.detector.alpha,
            reference,
            shift,
            scale,
        }
    }
}

impl Decider {
    pub fn new(design: &Design) -> Self {
        let samples = &design.samples;
        let pooled = samples.reference() + samples.shift() + samples.scale();
        Self {
            ties: Stream::new(0, "ties", "monitor"),
            keys: vec![0; pooled],
        }
    }

    /// The decision at these windows; `None` if a block is not in the history.
    pub(super) fn decide(
        &mut self,
        design: &Design,
        reference: &Reference,
        history: &History,
        windows: &Windows,
    ) -> Option<Verdict> {
        let pooled = Pooled {
            reference: &reference.sample,
            shift: history.whitened(windows.shift.clone())?,
            scale: history.whitened(windows.scale.clone())?,
        };
        Some(self.verdict(design, &pooled, history.end()))
    }

    /// The decision on three samples; `number` chooses the keys of ties.
    pub fn verdict(&mut self, design: &Design, pooled: &Pooled, number: u64) -> Verdict {
        let (ties, keys) = (&self.ties, &mut self.keys);
        let statistics = pooled.statistics(|| {
            let mut generator = ties.at(number);
            keys.fill_with(|| generator.next_u64());
            keys
        });
        let samples = &design.samples;
        let others = samples.reference() + samples.scale();
        let twice_mean = (samples.shift() * (samples.shift() + others + 1)) as u64;
        Verdict {
            statistics,
            moves: design.region.contains(statistics),
            sign: match (2 * statistics.rank_sum).cmp(&twice_mean) {
                std::cmp::Ordering::Less => -1.0,
                std::cmp::Ordering::Equal => 0.0,
                std::cmp::Ordering::Greater => 1.0,
            },
        }
    }
}
