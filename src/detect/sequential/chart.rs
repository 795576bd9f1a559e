//! What a sequential detector is made of.

use super::change::Change;
use super::score::{Lattice, STEPS, Score, Side};
use crate::rule::{OutOfRange, Rule};

/// Score, sides, k and N of a detector; all but its threshold.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    pub(super) lattice: Lattice,
    pub(super) sides: Vec<Side>,
    /// k, in steps.
    pub(super) allowance: i32,
    /// N, blocks.
    pub(super) reference: usize,
}

impl Chart {
    /// A chart of these sides with k = `allowance`, a multiple of 1/40, and a reference of N blocks.
    ///
    /// # Errors
    /// If a side is named twice or none is, k is not between 0 and the largest score or not on the lattice, or N is 0.
    pub fn new(
        score: Score,
        sides: &[Side],
        allowance: f64,
        reference: usize,
    ) -> Result<Self, OutOfRange> {
        let mut distinct = sides.to_vec();
        distinct.sort();
        distinct.dedup();
        if sides.is_empty() || distinct.len() < sides.len() {
            let named: Vec<String> = sides.iter().map(Side::to_string).collect();
            let got = format!("\"{}\"", named.join(","));
            return Err(OutOfRange::new("sides", "name each side once", got));
        }
        Rule::Within(1.0, 1e6, "blocks").check("reference", &reference)?;
        Ok(Self {
            lattice: Lattice::new(score),
            sides: distinct,
            allowance: steps(score, allowance)?,
            reference,
        })
    }

    /// The sides, in the order up, down, scale.
    pub fn sides(&self) -> &[Side] {
        &self.sides
    }

    /// A change with its shift the way that is looked for: down, if only down is.
    pub fn towards(&self, change: Change) -> Change {
        let looks = |side| self.sides.contains(&side);
        let is_down = looks(Side::Down) && !looks(Side::Up);
        let sign = if is_down { -1.0 } else { 1.0 };
        Change {
            shift: sign * change.shift,
            ..change
        }
    }

    /// N.
    pub fn reference(&self) -> usize {
        self.reference
    }
}

/// k in steps.
fn steps(score: Score, allowance: f64) -> Result<i32, OutOfRange> {
    let most = f64::from(score.most() - 1) / f64::from(STEPS);
    Rule::Within(0.0, most, "").check("k", &allowance)?;
    let steps = (allowance * f64::from(STEPS)).round();
    if (steps / f64::from(STEPS) - allowance).abs() > 1e-9 {
        return Err(OutOfRange::new("k", "be a multiple of 0.025", allowance));
    }
    Ok(steps as i32)
}

/// Steps of the lattice in units of score.
pub fn units(steps: i32) -> f64 {
    f64::from(steps) / f64::from(STEPS)
}
