//! How high an endless shift can climb before it has become the reference.
//!
//! Shifted blocks enter the ranks too. Of a shift so large that every shifted block is above the N of the reference, the
//! j-th has U = (N + j w)/(N + j), with w uniform and independent of all before, by the theorem of
//! [ranks](super::ranks) among the shifted blocks alone. Without noise these are ties, and v takes the place of w. So the
//! law of what is climbed is exact. A smaller shift of the same noise gives a smaller U block by block, and climbs no higher.
//!
//! Vibration puts blocks above and below the reference. Where they do so by turns, (j + 1)/2 of the first j lie on the side
//! of an odd j-th, which is uniform among those: so |2U − 1| is uniform from (N − 1)/(N + j) to 1, and of an even j from
//! N/(N + j). It climbs as high as a shift does where the side is up. Where the blocks of vibration are independent the two
//! sides are not as even, and it climbs nearly as high.
//!
//! The mean climb falls with j; of normal scores it is 0 for k = 0.8 where j ≈ N. A threshold counts as reached if S is
//! there with a probability of 99 % before the mean climb has fallen to 0.

use super::chart::Chart;
use super::score::{Law, Side};

/// The smallest probability with which the largest shift must be seen.
const SURE: f64 = 0.99;

/// The climb of an overwhelming shift; of vibration, where only that is looked for.
pub(super) struct Reach<'a> {
    chart: &'a Chart,
    is_vibration: bool,
}

impl<'a> Reach<'a> {
    pub fn new(chart: &'a Chart) -> Self {
        Self {
            chart,
            is_vibration: chart.sides == [Side::Scale],
        }
    }

    /// Whether S reaches `threshold`, in steps.
    pub fn reaches(&self, threshold: i32) -> bool {
        let allowance = self.chart.allowance;
        let mut sums = vec![0.0; threshold as usize];
        sums[0] = 1.0;
        for j in 1.. {
            let law = self.law(j);
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

    /// The law of the score of the j-th block.
    fn law(&self, j: usize) -> Law {
        let n = self.chart.reference;
        let beyond = j + usize::from(self.is_vibration && j % 2 == 1);
        let from = 1.0 - beyond as f64 / (n + j) as f64;
        let below = |u: f64| ((u - from) / (1.0 - from)).clamp(0.0, 1.0);
        self.chart.lattice.law(Side::Up, below)
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
