//! The Markov chain of one CUSUM [^1] whose scores are independent and of one law.
//!
//! States S = 0 … h − 1 in steps; from i to j > 0 with P(score = j − i + k), to 0 with P(score ≤ k − i), to an alarm with
//! P(score ≥ h − i + k). Scores are integers, so nothing is discretised.
//!
//! The mean m₀ of the time from S = 0 to an alarm solves m = 1 + Q m. The states are eliminated from the largest down by
//! the rule of Grassmann, Taksar and Heyman [^2]: the pivot is the sum of what leads elsewhere, not 1 less what stays. No
//! two numbers are subtracted, so m₀ has nearly all digits however rare the alarm is.
//!
//! [^1]: D. Brook, D. A. Evans, "An approach to the probability distribution of cusum run length", Biometrika 59, 1972.
//! [^2]: W. K. Grassmann, M. I. Taksar, D. P. Heyman, "Regenerative analysis and steady state distributions for Markov
//!     chains", Operations Research 33, 1985.

use super::score::Law;

/// Probabilities from each state.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Chain {
    /// h.
    pub states: usize,
    /// Q, row by row: to each state.
    pub moves: Vec<f64>,
    /// To an alarm.
    pub alarms: Vec<f64>,
}

impl Chain {
    /// The chain with allowance k and threshold h ≥ 1, in steps.
    pub fn new(law: &Law, allowance: i32, threshold: i32) -> Self {
        let states = 0..threshold;
        let moves = states.clone().flat_map(|from| {
            let to = states.clone();
            to.map(move |to| match to {
                0 => law.at_most(allowance - from),
                _ => law.mass(to - from + allowance),
            })
        });
        let alarms = states.clone();
        let alarms = alarms.map(|from| law.at_least(threshold - from + allowance));
        Self {
            states: threshold as usize,
            moves: moves.collect(),
            alarms: alarms.collect(),
        }
    }

    /// Probabilities one step later, without those of an alarm.
    pub fn after(&self, masses: &[f64]) -> Vec<f64> {
        let mut after = vec![0.0; self.states];
        for (mass, row) in masses.iter().zip(self.moves.chunks_exact(self.states)) {
            let each = after.iter_mut().zip(row);
            each.for_each(|(sum, to)| *sum += mass * to);
        }
        after
    }

    /// The mean number of steps from 0 to an alarm.
    pub fn mean(&self) -> f64 {
        let (n, mut moves) = (self.states, self.moves.clone());
        let (mut alarms, mut times) = (self.alarms.clone(), vec![1.0; n]);
        for out in (1..n).rev() {
            let (above, row) = moves.split_at_mut(out * n);
            let row = &row[..out];
            let leaves = row.iter().sum::<f64>() + alarms[out];
            for from in 0..out {
                let visits = above[from * n + out] / leaves;
                if visits > 0.0 {
                    let target = &mut above[from * n..][..out];
                    let each = target.iter_mut().zip(row);
                    each.for_each(|(sum, to)| *sum += visits * to);
                    alarms[from] += visits * alarms[out];
                    times[from] += visits * times[out];
                }
            }
        }
        times[0] / alarms[0]
    }
}
