//! T and T′ along Δ: the samples of Y₂ and of Y₁ outside the range of X.

use crate::detect::Statistics;

/// Counts samples outside X's range.
#[derive(Clone, Debug)]
pub(super) struct Outside {
    /// T and T′ before any crossing.
    start: [i32; 2],
    /// How they change at each Δ.
    changes: Vec<[i32; 2]>,
    /// One bit for every 2^`shared` values of Δ: whether they may change there. A single word is kept in a
    /// register while lines pass, where an array of words would wait for each store.
    touched: u64,
    shared: u32,
}

/// The sample that a line belongs to.
#[derive(Clone, Copy, Debug)]
pub(super) enum Sample {
    Scale = 0,
    Shift = 1,
}

impl Outside {
    /// For `points` values of Δ. A change at `points` lies beyond the last of them.
    pub fn new(points: usize) -> Self {
        Self {
            start: [0; 2],
            changes: vec![[0; 2]; points + 1],
            touched: 0,
            shared: (points / 64 + 1).next_power_of_two().ilog2(),
        }
    }

    /// A line without slope.
    #[inline(always)]
    pub fn stay(&mut self, sample: Sample, value: f64, [low, high]: [f64; 2]) {
        self.start[sample as usize] += i32::from((value < low) | (value > high));
    }

    /// A line with a slope, which crosses min X and max X at these places.
    #[inline(always)]
    pub fn pass(&mut self, sample: Sample, slope: f64, [low, high]: [u32; 2]) {
        let (enters, leaves) = if slope > 0.0 {
            (low, high)
        } else {
            (high, low)
        };
        self.start[sample as usize] += 1;
        for (place, change) in [(enters, -1), (leaves, 1)] {
            self.changes[place as usize][sample as usize] += change;
            self.touched |= 1 << (place >> self.shared);
        }
    }

    /// Sets `stretches` to the statistics, but for W, from each change on, and begins anew.
    #[inline(always)]
    pub fn sum(&mut self, stretches: &mut Vec<(usize, Statistics)>) {
        let mut counts = std::mem::take(&mut self.start);
        let of = |[exceedances, shift_exceedances]: [i32; 2]| Statistics {
            rank_sum: 0,
            exceedances: exceedances as usize,
            shift_exceedances: shift_exceedances as usize,
        };
        stretches.clear();
        stretches.push((0, of(counts)));
        let mut touched = std::mem::take(&mut self.touched);
        while touched != 0 {
            let first = (touched.trailing_zeros() as usize) << self.shared;
            let last = (first + (1 << self.shared)).min(self.changes.len());
            for place in first..last {
                let changes = std::mem::take(&mut self.changes[place]);
                if changes != [0; 2] {
                    counts = [counts[0] + changes[0], counts[1] + changes[1]];
                    stretches.push((place, of(counts)));
                }
            }
            touched &= touched - 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Along;
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Samples counted one by one at every Δ, on more values than a word has bits.
        #[test]
        fn agree_with_counting(
            lines in prop::collection::vec((any::<bool>(), any::<bool>(), 0u32..=100, 0u32..=100), 0..9),
        ) {
            let mut outside = Outside::new(100);
            let mut along = Along { rank_sums: vec![7; 100], stretches: Vec::new() };
            for _ in 0..2 {
                for &(of_shift, falls, a, b) in &lines {
                    let (first, last) = (a.min(b), a.max(b));
                    let sample = if of_shift { Sample::Shift } else { Sample::Scale };
                    let (slope, ends) = if falls { (-1.0, [last, first]) } else { (1.0, [first, last]) };
                    outside.pass(sample, slope, ends);
                }
                outside.stay(Sample::Shift, 3.0, [1.0, 2.0]);
                outside.stay(Sample::Scale, 1.5, [1.0, 2.0]);
                outside.sum(&mut along.stretches);
                for number in 0..100 {
                    let count = |wanted: bool| {
                        let lines = lines.iter().filter(|line| line.0 == wanted);
                        let is_outside = |line: &&(bool, bool, u32, u32)| {
                            (number < line.2.min(line.3)) | (number >= line.2.max(line.3))
                        };
                        lines.filter(is_outside).count()
                    };
                    let expected = Statistics {
                        rank_sum: 7,
                        exceedances: count(false),
                        shift_exceedances: count(true) + 1,
                    };
                    prop_assert_eq!(along.at(number as usize), expected);
                }
            }
        }
    }
}
