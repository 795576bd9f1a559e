//! The statistics at every value of Δ.

use crate::detect::Statistics;
use std::ops::Range;

/// W, T and T′ along Δ. Only W changes at most values of Δ.
#[derive(Clone, Debug)]
pub struct Along {
    /// W at each Δ.
    pub(super) rank_sums: Vec<u64>,
    /// The statistics from some Δ up to the next of these, but for W.
    pub(super) stretches: Vec<(usize, Statistics)>,
}

impl Along {
    /// The statistics at one Δ.
    pub fn at(&self, number: usize) -> Statistics {
        let stretch = self
            .stretches
            .partition_point(|&(first, _)| first <= number)
            - 1;
        Statistics {
            rank_sum: self.rank_sums[number],
            ..self.stretches[stretch].1
        }
    }

    /// The stretches within `range`: the values of Δ, and the statistics there but for W.
    #[inline(always)]
    pub fn stretches(
        &self,
        range: Range<usize>,
    ) -> impl Iterator<Item = (Range<usize>, Statistics)> {
        let ends = self.stretches.iter().skip(1).map(|next| next.0);
        let each = self.stretches.iter().zip(ends.chain([usize::MAX]));
        each.map(
            #[inline(always)]
            move |(&(first, statistics), next)| {
                (first.max(range.start)..next.min(range.end), statistics)
            },
        )
        .filter(|(numbers, _)| !numbers.is_empty())
    }

    /// W at these values of Δ.
    #[inline(always)]
    pub fn rank_sums(&self, range: Range<usize>) -> &[u64] {
        &self.rank_sums[range]
    }
}
