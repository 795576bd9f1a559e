//! How high an endless shift can climb before it has become the reference.
//!
//! Shifted blocks enter the ranks too. Of a shift so large that every shifted block is above the N of the reference, the
//! j-th has U = (N + j w)/(N + j), with w uniform and independent of all before, by the theorem of
//! [ranks](super::ranks) among the shifted blocks alone. Without noise these are ties, and v takes the place of w. So the
//! law of what is climbed is exact. A smaller shift of the same noise gives a smaller U block by block, and climbs no higher.
//! The mean climb falls with j; of normal scores it is 0 for k = 0.8 where j ≈ N. A threshold counts as reached if S is there with a probability of 99 % before the mean climb has
//! fallen to 0.

use super::chart::Chart;
use super::score::{Law, Side};

/// The smallest probability with which the largest shift must be seen.
const SURE: f64 = 0.99;

/// The climb of an overwhelming shift.
pub(super) struct Reach<'a> {
    chart: &'a Chart,
    side: Side,
}

impl<'a> Reach<'a> {
    /// By the side of the chart that such a shift raises most.
    pub fn new(chart: &'a Chart) -> Self {
        let is_scale = chart.sides == [Side::Scale];
        let side = if is_scale { Side::Scale } else { Side::Up };
        Self { chart, side }
    }

    /// Whether S reaches `threshold`, in steps.
    pub fn reaches(&self, threshold: i32) -> bool {
        let allowance = self.chart.allowance;
        let mut sums = vec![0.0; threshold as usize];
        sums[0] = 1.0;
        for shifted in 1.. {
            let law = self.law(shifted);
            if law.mean() <= f64::from(allowance) {
                return false;
            }
            sums = moved(&sums, &law, allowance);
            if sums.iter().sum::<f64>() <= 1.0 - SURE {
                return true;
            }
        }
        false
    }

    /// The law of the score of a shifted block.
    fn law(&self, shifted: usize) -> Law {
        let (n, j) = (self.chart.reference as f64, shifted as f64);
        let below = |u: f64| ((u * (n + j) - n) / j).clamp(0.0, 1.0);
        self.chart.lattice.law(self.side, below)
    }
}

/// The law of S one block later, without alarms.
fn moved(sums: &[f64], law: &Law, allowance: i32) -> Vec<f64> {
    let states = 0..sums.len() as i32;
    let from = || states.clone().zip(sums).filter(|(_, mass)| **mass > 0.0);
    let to = |to: i32| match to {
        0 => from()
            .map(|(s, mass)| mass * law.at_most(allowance - s))
            .sum(),
        _ => from()
            .map(|(s, mass)| mass * law.mass(to - s + allowance))
            .sum(),
    };
    states.clone().map(to).collect()
}
