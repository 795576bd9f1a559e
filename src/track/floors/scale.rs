//! By how much trips are noisier than they claim.

use std::collections::VecDeque;

/// The median of χ² with one degree of freedom.
const MEDIAN: f64 = 0.454_936_423_119_572_7;
/// The fewest values that say something.
const FEWEST: usize = 10;

/// The running median of ξ. It does not feel the few stops that are off every floor.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Scale {
    window: usize,
    recent: VecDeque<f64>,
}

impl Scale {
    /// Over the last `window` values; 0 never scales.
    pub fn new(window: usize, recent: impl IntoIterator<Item = f64>) -> Self {
        let mut scale = Self {
            window,
            recent: VecDeque::new(),
        };
        recent.into_iter().for_each(|xi| scale.push(xi));
        scale
    }

    pub fn push(&mut self, xi: f64) {
        self.recent.push_back(xi);
        while self.recent.len() > self.window {
            self.recent.pop_front();
        }
    }

    /// The oldest first.
    pub fn recent(&self) -> impl Iterator<Item = f64> {
        self.recent.iter().copied()
    }

    /// κ, at least 1.
    pub fn factor(&self) -> f64 {
        let n = self.recent.len();
        if n < FEWEST {
            return 1.0;
        }
        let mut sorted: Vec<f64> = self.recent().collect();
        let (_, upper, _) = sorted.select_nth_unstable_by(n / 2, f64::total_cmp);
        let upper = *upper;
        let lower = sorted[..n / 2].iter().copied().fold(0.0, f64::max);
        let median = if n.is_multiple_of(2) {
            f64::midpoint(lower, upper)
        } else {
            upper
        };
        (median / MEDIAN).max(1.0)
    }
}
