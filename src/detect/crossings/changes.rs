//! The change in the number of ordered pairs from each Δ to the next.

use crate::simd::LANES;

/// An array of counts, with slots before and after those of the grid. Crossings off the grid count alike in
/// any of these, and most pairs cross there: spread over several slots, their increments need not wait for
/// each other.
#[derive(Clone, Debug)]
pub(super) struct Changes {
    slots: Vec<i32>,
}

/// The number of slots before that of the first Δ, and of those after the first beyond the last.
pub(super) const SPREAD: usize = LANES - 1;

impl Changes {
    /// For `points` values of Δ.
    pub fn new(points: usize) -> Self {
        Self {
            slots: vec![0; SPREAD + points + 1 + SPREAD],
        }
    }

    /// Counts pairs that are ordered at every Δ.
    #[inline(always)]
    pub fn start(&mut self, pairs: usize) {
        self.slots[0] += pairs as i32;
    }

    /// Counts pairs that become ordered at some Δ if `closing` is positive, and are ordered up to there if it
    /// is negative. The number of the Δ is the slot less [`SPREAD`].
    #[inline(always)]
    pub fn add(&mut self, slots: &[u32], closing: f64) {
        let falls = closing < 0.0;
        self.start(if falls { slots.len() } else { 0 });
        let change = if falls { -1 } else { 1 };
        let changes = &mut self.slots[..];
        for &slot in slots {
            changes[slot as usize] += change;
        }
    }

    /// Sets `sums` to the running sums from `start` on, and begins anew.
    #[inline(always)]
    pub fn sum(&mut self, start: u64, sums: &mut [u64]) {
        let (before, grid) = self.slots.split_at(SPREAD);
        let before: i32 = before.iter().sum();
        let mut running = start.wrapping_add_signed(before.into());
        for (sum, change) in sums.iter_mut().zip(grid) {
            running = running.wrapping_add_signed((*change).into());
            *sum = running;
        }
        self.slots.fill(0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Pairs counted one by one at every Δ, twice, because nothing of one trial may leak into the next.
        #[test]
        fn agree_with_counting(
            lines in prop::collection::vec(
                (prop::collection::vec(0..9 + 2 * LANES as u32 - 1, 0..12), any::<bool>()),
                0..6,
            ),
            always in 0usize..5,
        ) {
            let mut changes = Changes::new(9);
            for _ in 0..2 {
                changes.start(always);
                for (slots, falls) in &lines {
                    changes.add(slots, if *falls { -1.0 } else { 1.0 });
                }
                let mut sums = [0; 9];
                changes.sum(100, &mut sums);
                for (slot, sum) in (SPREAD as u32..).zip(sums) {
                    let ordered = lines.iter().map(|(slots, falls)| {
                        slots.iter().filter(|crossing| (slot >= **crossing) != *falls).count()
                    });
                    prop_assert_eq!(sum, 100 + (always + ordered.sum::<usize>()) as u64);
                }
            }
        }
    }
}
