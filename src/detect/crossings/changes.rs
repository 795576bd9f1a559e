//! The change in the number of ordered pairs from each Δ to the next.

/// Several arrays of counts, one after the other, used in turn and added at the end, so that two increments
/// of the same place need not wait for each other.
#[derive(Clone, Debug)]
pub(super) struct Changes {
    turns: Vec<i32>,
    /// The length of each array.
    length: usize,
}

/// The number of arrays.
const TURNS: usize = 4;

impl Changes {
    /// For `points` values of Δ. A change at `points` lies beyond the last of them.
    pub fn new(points: usize) -> Self {
        Self {
            turns: vec![0; TURNS * (points + 1)],
            length: points + 1,
        }
    }

    /// Counts pairs that are ordered at every Δ.
    #[inline(always)]
    pub fn start(&mut self, pairs: usize) {
        self.turns[0] += pairs as i32;
    }

    /// Counts pairs that become ordered at these places if `closing` is positive, and are ordered up to there if
    /// it is negative.
    #[inline(always)]
    pub fn add(&mut self, places: &[u32], closing: f64) {
        let falls = closing < 0.0;
        self.start(if falls { places.len() } else { 0 });
        let change = if falls { -1 } else { 1 };
        let (first, rest) = self.turns.split_at_mut(self.length);
        let (second, rest) = rest.split_at_mut(self.length);
        let (third, fourth) = rest.split_at_mut(self.length);
        let (fours, rest) = places.as_chunks::<TURNS>();
        for places in fours {
            first[places[0] as usize] += change;
            second[places[1] as usize] += change;
            third[places[2] as usize] += change;
            fourth[places[3] as usize] += change;
        }
        for &place in rest {
            first[place as usize] += change;
        }
    }

    /// Sets `sums` to the running sums from `start` on, and begins anew.
    #[inline(always)]
    pub fn sum(&mut self, start: u64, sums: &mut [u64]) {
        let (first, others) = self.turns.split_at_mut(self.length);
        for turn in others.chunks_exact_mut(self.length) {
            for (sum, more) in first.iter_mut().zip(turn) {
                *sum += *more;
                *more = 0;
            }
        }
        let mut running = start;
        for (sum, change) in sums.iter_mut().zip(&mut *first) {
            running = running.wrapping_add_signed((*change).into());
            *sum = running;
        }
        first.fill(0);
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
            lines in prop::collection::vec((prop::collection::vec(0u32..=9, 0..12), any::<bool>()), 0..6),
            always in 0usize..5,
        ) {
            let mut changes = Changes::new(9);
            for _ in 0..2 {
                changes.start(always);
                for (places, falls) in &lines {
                    changes.add(places, if *falls { -1.0 } else { 1.0 });
                }
                let mut sums = [0; 9];
                changes.sum(100, &mut sums);
                for (number, sum) in (0..).zip(sums) {
                    let ordered = lines.iter().map(|(places, falls)| {
                        places.iter().filter(|place| (number >= **place) != *falls).count()
                    });
                    prop_assert_eq!(sum, 100 + (always + ordered.sum::<usize>()) as u64);
                }
            }
        }
    }
}
