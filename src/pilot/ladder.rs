//! The regions of one rule by their nominal level, and how far up a pilot lets one go.

use crate::chain::Scenario;
use crate::detect::{Histogram, LikelihoodOrder, Method, NullLaws, Region};

/// The rungs of the ladder: nominal levels down to a millionth of α.
const RUNGS: i32 = 270;
const RUNG: f64 = 0.95;

/// The regions of one rule by their nominal level.
pub(super) struct Ladder {
    pub laws: NullLaws,
    method: Method,
    order: Option<LikelihoodOrder>,
}

impl Ladder {
    pub fn new(scenario: &Scenario, motion: Option<&Histogram>) -> Self {
        let detector = &scenario.detector;
        let laws = NullLaws::new(detector.alternative, &scenario.samples)
            .expect("the plan has made these laws before");
        let order = motion.map(|histogram| LikelihoodOrder::new(&laws, histogram));
        Self {
            laws,
            method: detector.method.clone(),
            order,
        }
    }

    /// The region of a nominal level; empty where the rule has none.
    pub fn region(&self, level: f64) -> Region {
        let region = match (&self.method, &self.order) {
            (_, Some(order)) => Ok(self.laws.likelihood_region(order, level)),
            (Method::Rule(rule), None) => self.laws.region(rule, level),
            (_, None) => Ok(self.laws.empty_region()),
        };
        region.unwrap_or_else(|_| self.laws.empty_region())
    }

    /// The last rung below the first that does not keep the level; the empty region below the ladder.
    pub fn climb(&self, alpha: f64, keeps: impl Fn(&Region) -> bool) -> Region {
        let rungs = (0..=RUNGS)
            .rev()
            .map(|rung| alpha * libm::pow(RUNG, rung.into()));
        let regions = rungs.map(|level| self.region(level));
        last_kept(regions, keeps).unwrap_or_else(|| self.laws.empty_region())
    }

    /// The largest region that keeps the level, whatever its nominal one. The halving takes for granted that
    /// false alarms grow with the nominal level; where a rule's regions are not quite nested it ends at one
    /// of the boundaries.
    pub fn search(&self, keeps: impl Fn(&Region) -> bool) -> Region {
        let (mut low, mut high) = (0.0, 1.0);
        let mut kept = self.laws.empty_region();
        // Forty halvings resolve any level that a pilot could tell apart.
        for _ in 0..40 {
            let middle = f64::midpoint(low, high);
            let region = self.region(middle);
            if keeps(&region) {
                (low, kept) = (middle, region)
            } else {
                high = middle
            }
        }
        kept
    }
}

/// The last of the ladder's rungs before the first that is not kept.
fn last_kept<R>(rungs: impl Iterator<Item = R>, keeps: impl Fn(&R) -> bool) -> Option<R> {
    rungs.take_while(|rung| keeps(rung)).last()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One rung that fails ends the ladder, whatever comes after it: that is what keeps the promise.
    #[test]
    fn the_first_failure_ends_the_ladder() {
        let counts = [3, 5, 9, 4, 2, 8];
        let kept = |limit| last_kept(counts.into_iter(), |&count| count <= limit);
        assert_eq!(kept(5), Some(5));
        assert_eq!(kept(9), Some(8));
        assert_eq!(kept(2), None);
    }
}
