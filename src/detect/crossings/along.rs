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

    /// Calls `take` for each Δ of `range` with its place and the statistics there.
    #[inline(always)]
    pub fn each<T>(
        &self,
        range: Range<usize>,
        places: &mut [T],
        take: impl Fn(&mut T, Statistics),
    ) {
        for (i, &(first, statistics)) in self.stretches.iter().enumerate() {
            let next = self.stretches.get(i + 1).map_or(range.end, |next| next.0);
            let (from, to) = (first.max(range.start), next.min(range.end));
            if from >= to {
                continue;
            }
            let places = &mut places[from - range.start..to - range.start];
            for (place, &rank_sum) in places.iter_mut().zip(&self.rank_sums[from..to]) {
                let statistics = Statistics {
                    rank_sum,
                    ..statistics
                };
                take(place, statistics);
            }
        }
    }
}
