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

    /// Shows the stretches within `range`: the values of Δ, and the statistics there but for W.
    #[inline(always)]
    pub fn for_each_stretch(
        &self,
        range: Range<usize>,
        mut show: impl FnMut(Range<usize>, Statistics),
    ) {
        let mut rest = &self.stretches[..];
        while let [(first, statistics), following @ ..] = rest {
            let next = following.first().map_or(usize::MAX, |next| next.0);
            let numbers = range.start.max(*first)..range.end.min(next);
            if !numbers.is_empty() {
                show(numbers, *statistics);
            }
            rest = following;
        }
    }

    /// W at these values of Δ.
    #[inline(always)]
    pub fn rank_sums(&self, range: Range<usize>) -> &[u64] {
        &self.rank_sums[range]
    }
}
