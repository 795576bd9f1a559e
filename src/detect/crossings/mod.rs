//! W and T along Δ: where pairs of samples change their order.
//!
//! A whitened sample is a line in Δ, a + Δ g. Sample y exceeds sample z of slope h < g from
//!
//! Δ* = (a_z − a_y)/(g − h)
//!
//! on, and of slope h > g up to there. W and T count such pairs: W those of Y₁ over all others, T those
//! of min X over Y₂ and of Y₂ over max X. Every crossing is found once and counted at the first Δ after it;
//! a running sum gives the number of ordered pairs at each Δ. So all values of Δ cost little more than one.
//! Neither statistic needs to be monotone in Δ: the first samples of Y₂ have a slope too.
//!
//! The counts equal those of comparing the samples at every Δ. If two samples nearly tie at some Δ, so that
//! rounding could matter, nothing is returned and the samples have to be compared.

mod grid;
mod lines;

pub use lines::Lines;

use super::statistics::{Statistics, smallest_rank_sum};
use crate::simd::{Vectors, Wide, greatest, least};
use grid::Grid;
use lines::{Field, SEVERAL};

/// The order of two samples nearer than this share of the largest value may depend on rounding: each value
/// has an error of two units in the last place, each crossing one of ten.
const DOUBT: f64 = 1e-11;

/// Counts W and T at every Δ of a list.
#[derive(Clone, Debug)]
pub struct Crossings {
    vectors: Vectors,
    grid: Grid,
    shift: Field,
    rank_sums: Changes,
    exceedances: Changes,
    statistics: Vec<Statistics>,
}

/// The change in the number of ordered pairs from each Δ to the next.
#[derive(Clone, Debug)]
struct Changes {
    /// Several arrays of counts, one after the other, used in turn and added at the end, so that two
    /// increments of the same place need not wait for each other.
    turns: Vec<i32>,
    /// The length of each array.
    length: usize,
}

/// The number of arrays for W, which has many crossings.
const TURNS: usize = 4;

impl Crossings {
    /// A counter for at least two distinct `deltas` in ascending order.
    pub fn new(vectors: Vectors, deltas: Vec<f64>) -> Self {
        let length = deltas.len() + 1;
        let changes = |turns: usize| Changes {
            turns: vec![0; turns * length],
            length,
        };
        Self {
            vectors,
            shift: Field::default(),
            rank_sums: changes(TURNS),
            exceedances: changes(1),
            statistics: Vec::with_capacity(deltas.len()),
            grid: Grid::new(deltas),
        }
    }

    /// W and T at every Δ, where X is at rest; `None` if a near tie makes one of them uncertain.
    pub fn count(
        &mut self,
        reference: &[f64],
        shift: Lines,
        scale: Lines,
    ) -> Option<&[Statistics]> {
        let vectors = self.vectors;
        let is_certain = vectors.run(
            #[inline(always)]
            || self.find(reference, shift, scale),
        );
        is_certain.then_some(&self.statistics)
    }

    /// Finds and counts all crossings; returns whether all of them are certain.
    #[inline(always)]
    fn find(&mut self, reference: &[f64], shift: Lines, scale: Lines) -> bool {
        self.rank_sums.turns.fill(0);
        self.exceedances.turns.fill(0);
        self.shift.take(shift, &self.grid);
        // X has slope 0, so its crossings need no division.
        for &x in reference {
            self.shift.meet_still(&self.grid, x);
            self.rank_sums.count(&self.shift, 0.0);
        }
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for &x in reference {
            low = least(low, x);
            high = greatest(high, x);
        }
        let mut nearest = f64::INFINITY;
        for (&y, &slope) in scale.base.iter().zip(scale.slope) {
            if slope == 0.0 {
                self.shift.meet_still(&self.grid, y)
            } else {
                self.shift.meet(&self.grid, y, slope)
            }
            self.rank_sums.count(&self.shift, slope);
            // T: above max X, and below min X.
            for (above, ahead) in [(1, high - y), (-1, low - y)] {
                nearest = least(
                    nearest,
                    self.exceedances.cross(&self.grid, ahead, slope, above),
                );
            }
        }
        self.sum(shift.base.len());
        for gap in self.shift.nearest.0 {
            nearest = least(nearest, gap);
        }
        let largest = greatest(shift.largest(&self.grid), scale.largest(&self.grid));
        nearest > DOUBT * greatest(largest, greatest(-low, high))
    }

    /// Sets the statistics to running sums of the changes.
    #[inline(always)]
    fn sum(&mut self, shift: usize) {
        let mut rank_sum = smallest_rank_sum(shift);
        let mut outside = 0usize;
        self.statistics.clear();
        let points = self.grid.deltas.len();
        let changes = self.rank_sums.total().iter().zip(self.exceedances.total());
        self.statistics.extend(changes.take(points).map(
            #[inline(always)]
            |(&pairs, &exceedances)| {
                rank_sum = rank_sum.wrapping_add_signed(pairs.into());
                outside = outside.wrapping_add_signed(exceedances as isize);
                Statistics {
                    rank_sum,
                    exceedances: outside,
                }
            },
        ));
    }
}

impl Changes {
    /// Counts the lines of `field` above a line of this slope, at every Δ.
    #[inline(always)]
    fn count(&mut self, field: &Field, slope: f64) {
        let behind = &field.behind.as_flattened()[..field.length];
        if field.least_slope >= slope {
            let (first, rest) = self.turns.split_at_mut(self.length);
            let (second, rest) = rest.split_at_mut(self.length);
            let (third, fourth) = rest.split_at_mut(self.length);
            let (fours, rest) = behind.as_chunks::<TURNS>();
            for places in fours {
                first[places[0] as usize] += 1;
                second[places[1] as usize] += 1;
                third[places[2] as usize] += 1;
                fourth[places[3] as usize] += 1;
            }
            for &place in rest {
                first[place as usize] += 1;
            }
            return;
        }
        for (i, &place) in behind.iter().enumerate() {
            // A steeper line is above from the crossing on, a flatter one up to there.
            let falls = field.lines[i / SEVERAL].slope.0[i % SEVERAL] < slope;
            self.turns[0] += i32::from(falls);
            self.turns[place as usize] += if falls { -1 } else { 1 };
        }
    }

    /// Counts where a line of this slope is above (`above` = 1) or below (−1) a line of slope zero, which is
    /// `ahead` of it at Δ = 0. Returns their smallest distance at any Δ.
    #[inline(always)]
    fn cross(&mut self, grid: &Grid, ahead: f64, slope: f64, above: i32) -> f64 {
        let counts = &mut self.turns;
        counts[0] += if above < 0 { 1 } else { 0 };
        if slope == 0.0 {
            counts[0] += if ahead < 0.0 { above } else { 0 };
            return ahead.abs();
        }
        let ([place], Wide([gap])) = grid.cross(Wide([ahead]), Wide([slope]));
        counts[0] += if slope < 0.0 { above } else { 0 };
        counts[place as usize] += if slope < 0.0 { -above } else { above };
        gap
    }

    /// The changes, summed over the arrays.
    #[inline(always)]
    fn total(&mut self) -> &[i32] {
        let (sums, others) = self.turns.split_at_mut(self.length);
        for turn in others.chunks_exact(self.length) {
            for (sum, more) in sums.iter_mut().zip(turn) {
                *sum += more;
            }
        }
        sums
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::detect::Pooled;
    use proptest::prelude::*;

    /// W and T at every Δ by comparing the samples there.
    fn compared(deltas: &[f64], reference: &[f64], shift: Lines, scale: Lines) -> Vec<Statistics> {
        let at = |lines: Lines, delta: f64| -> Vec<f64> {
            let lines = lines.base.iter().zip(lines.slope);
            lines.map(|(base, slope)| base + delta * slope).collect()
        };
        let statistics = |&delta: &f64| {
            let (shift, scale) = (at(shift, delta), at(scale, delta));
            let pooled = Pooled {
                reference,
                shift: &shift,
                scale: &scale,
            };
            pooled.statistics(|| unreachable!("no ties"))
        };
        deltas.iter().map(statistics).collect()
    }

    /// A few slopes, some zero or negative, as the first samples of Y₂ and late motions have.
    fn slopes() -> impl Strategy<Value = f64> {
        prop_oneof![Just(0.0), Just(3.287), -2.0..4.0]
    }

    fn grids() -> impl Strategy<Value = Vec<f64>> {
        let even = (-2.0..1.0, 0.01..0.5, 2usize..70).prop_map(|(start, step, points)| {
            (0..points).map(|i| start + i as f64 * step).collect()
        });
        let uneven = prop::collection::btree_set(-300i32..300, 2..40)
            .prop_map(|set| set.into_iter().map(|i| f64::from(i) / 97.0).collect());
        prop_oneof![even, uneven]
    }

    proptest! {
        #![proptest_config(ProptestConfig { rng_seed: prop::test_runner::RngSeed::Fixed(2014), cases: 3000, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn agree_with_comparing(
            deltas in grids(),
            sizes in (1usize..14, 1usize..14, 1usize..14),
            values in prop::collection::vec(-6.0..6.0, 42),
            slopes in prop::collection::vec(slopes(), 28),
        ) {
            let (n, m1, m2) = sizes;
            let shift = Lines { base: &values[14..14 + m1], slope: &slopes[..m1] };
            let scale = Lines { base: &values[28..28 + m2], slope: &slopes[14..14 + m2] };
            let expected = compared(&deltas, &values[..n], shift, scale);
            for vectors in Vectors::available() {
                let mut crossings = Crossings::new(vectors, deltas.clone());
                // Twice, because nothing of one trial may leak into the next.
                for _ in 0..2 {
                    let counted = crossings.count(&values[..n], shift, scale);
                    prop_assert_eq!(counted, Some(&expected[..]));
                }
            }
        }
    }

    /// Ties at a Δ, or close to one, are left undecided.
    #[test]
    fn near_ties_are_in_doubt() {
        let mut even = Crossings::new(Vectors::Baseline, vec![0.0, 0.5, 1.0, 1.5]);
        let mut uneven = Crossings::new(Vectors::Baseline, vec![0.0, 0.4, 1.0, 1.5]);
        let scale = Lines {
            base: &[7.0],
            slope: &[0.0],
        };
        let of = |crossings: &mut Crossings, x: f64, slope: f64, scale| {
            let shift = Lines {
                base: &[-2.0],
                slope: &[slope],
            };
            crossings.count(&[x, -5.0], shift, scale).is_some()
        };
        for crossings in [&mut even, &mut uneven] {
            assert!(of(crossings, 0.1, 2.0, scale));
            assert!(!of(crossings, 0.0, 2.0, scale));
            assert!(!of(crossings, 1e-13, 2.0, scale));
            assert!(!of(crossings, -2.0, 0.0, scale));
            assert!(!of(
                crossings,
                0.1,
                2.0,
                Lines {
                    base: &[0.1],
                    slope: &[0.0]
                }
            ));
            assert!(!of(
                crossings,
                0.1,
                2.0,
                Lines {
                    base: &[1.1],
                    slope: &[-1.0]
                }
            ));
        }
    }
}
