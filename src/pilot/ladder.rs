//! The regions of one rule by nominal level, and the search for the largest that a pilot allows.

use crate::chain::Scenario;
use crate::detect::{Histogram, LikelihoodOrder, Method, NullLaws, Region};

/// The number of nominal levels, down to a millionth of α.
const RUNGS: i32 = 270;
const RUNG: f64 = 0.95;

/// The regions of one rule by nominal level.
pub(super) struct Ladder {
    pub laws: NullLaws,
    method: Method,
    order: Option<LikelihoodOrder>,
}

impl Ladder {
    pub fn new(scenario: &Scenario, motion: Option<&Histogram>) -> Self {
        let detector = &scenario.detector;
        let laws = NullLaws::new(
            detector.exceedances,
            detector.alternative,
            &scenario.samples,
        )
        .expect("the plan has made these laws before");
        let order = motion.map(|histogram| LikelihoodOrder::new(&laws, histogram));
        Self {
            laws,
            method: detector.method.clone(),
            order,
        }
    }

    /// The region at a nominal level; empty if the rule has none there.
    pub fn region(&self, level: f64) -> Region {
        let region = match (&self.method, &self.order) {
            (_, Some(order)) => Ok(self.laws.likelihood_region(order, level)),
            (Method::Rule(rule), None) => self.laws.region(rule, level),
            (_, None) => Ok(self.laws.empty_region()),
        };
        region.unwrap_or_else(|_| self.laws.empty_region())
    }

    /// The last region before the first that does not keep the level, or the empty region.
    pub fn climb(&self, alpha: f64, keeps: impl Fn(&Region) -> bool) -> Region {
        let rungs = (0..=RUNGS)
            .rev()
            .map(|rung| alpha * libm::pow(RUNG, rung.into()));
        let regions = rungs.map(|level| self.region(level));
        last_kept(regions, keeps).unwrap_or_else(|| self.laws.empty_region())
    }

    /// The largest region that keeps the level, at any nominal level. The bisection assumes that false alarms
    /// grow with the nominal level; if a rule's regions are not quite nested, it ends at one of the boundaries.
    pub fn search(&self, keeps: impl Fn(&Region) -> bool) -> Region {
        let (mut low, mut high) = (0.0, 1.0);
        let mut kept = self.laws.empty_region();
        // Forty halvings are finer than any pilot can resolve.
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

/// The last rung before the first that does not keep the level.
fn last_kept<R>(rungs: impl Iterator<Item = R>, keeps: impl Fn(&R) -> bool) -> Option<R> {
    rungs.take_while(|rung| keeps(rung)).last()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first failing rung ends the ladder even if later ones pass; the level of the promise relies on this.
    #[test]
    fn the_first_failure_ends_the_ladder() {
        let counts = [3, 5, 9, 4, 2, 8];
        let kept = |limit| last_kept(counts.into_iter(), |&count| count <= limit);
        assert_eq!(kept(5), Some(5));
        assert_eq!(kept(9), Some(8));
        assert_eq!(kept(2), None);
    }
}
