//! W, T and T′ along Δ: where pairs of samples change their order.
//!
//! A whitened sample is a line in Δ, a + Δ g. Sample y exceeds sample z of slope h < g from
//!
//! Δ* = (a_z − a_y)/(g − h)
//!
//! on, and of slope h > g up to there. W, T and T′ count such pairs: W those of Y₁ over all others, T those
//! of min X over Y₂ and of Y₂ over max X, T′ adds those of Y₁. Every crossing is found once and counted at the
//! first Δ after it; a running sum gives the number of ordered pairs at each Δ. So all values of Δ cost little
//! more than one. No statistic needs to be monotone in Δ: the first samples of Y₂ have a slope too.
//!
//! Most samples are levels: X and most of Y₂ do not change with Δ. On an even grid the lines of Y₁ that share
//! a slope cross all levels at the cost of a subtraction for each pair.
//!
//! The counts equal those of comparing the samples at every Δ. If two samples nearly tie at some Δ, so that
//! rounding could matter, nothing is returned and the samples have to be compared.

mod along;
mod changes;
mod grid;
mod levels;
mod lines;
mod outside;
#[cfg(test)]
mod tests;

pub use along::Along;
pub use lines::Lines;

use super::statistics::smallest_rank_sum;
use crate::simd::{Vectors, Wide, greatest, least};
use changes::Changes;
use grid::{Even, Grid};
use levels::{Levels, Pencil};
use lines::Field;
use outside::{Outside, Sample};

/// The order of two samples nearer than this share of the largest value may depend on rounding: each value
/// has an error of two units in the last place, each crossing one of ten.
const DOUBT: f64 = 1e-11;

/// Counts W, T and T′ at every Δ of a list.
#[derive(Clone, Debug)]
pub struct Crossings {
    vectors: Vectors,
    grid: Grid,
    /// Whether T′ is wanted.
    of_shift: bool,
    levels: Levels,
    shift: Field,
    rank_sums: Changes,
    outside: Outside,
    along: Along,
}

impl Crossings {
    /// A counter for at least two distinct `deltas` in ascending order. T′ is counted if `of_shift`, else left
    /// at T.
    pub fn new(vectors: Vectors, deltas: Vec<f64>, of_shift: bool) -> Self {
        let points = deltas.len();
        Self {
            vectors,
            grid: Grid::new(deltas),
            of_shift,
            levels: Levels::default(),
            shift: Field::default(),
            rank_sums: Changes::new(points),
            outside: Outside::new(points),
            along: Along {
                rank_sums: vec![0; points],
                stretches: Vec::new(),
            },
        }
    }

    /// The statistics at every Δ, where X is at rest; `None` if a near tie makes one of them uncertain.
    pub fn count(&mut self, reference: &[f64], shift: Lines, scale: Lines) -> Option<&Along> {
        let vectors = self.vectors;
        let is_certain = vectors.run(
            #[inline(always)]
            || self.find(reference, shift, scale),
        );
        is_certain.then_some(&self.along)
    }

    /// Finds and counts all crossings; returns whether all of them are certain.
    #[inline(always)]
    fn find(&mut self, reference: &[f64], shift: Lines, scale: Lines) -> bool {
        self.levels.clear();
        self.levels.add(reference);
        let (low, high) = (f64::INFINITY, f64::NEG_INFINITY);
        let ends = [
            reference.iter().copied().fold(low, least),
            reference.iter().copied().fold(high, greatest),
        ];
        self.shift.take(shift);
        let mut nearest = self.meet_scale(ends, scale);
        nearest = match self.grid.even {
            Some(even) => least(nearest, self.meet_levels(even, ends, shift)),
            None => least(nearest, self.meet_one_by_one(ends, shift)),
        };
        nearest = least(nearest, self.shift.nearest());
        let start = smallest_rank_sum(shift.base.len());
        self.rank_sums.sum(start, &mut self.along.rank_sums);
        self.outside.sum(&mut self.along.stretches);
        let largest = greatest(shift.largest(&self.grid), scale.largest(&self.grid));
        nearest > DOUBT * greatest(largest, greatest(-ends[0], ends[1]))
    }

    /// Takes Y₂: levels among the others, and crossings with lines. Returns the smallest distance between Y₂
    /// and an end of X.
    #[inline(always)]
    fn meet_scale(&mut self, ends: [f64; 2], scale: Lines) -> f64 {
        let mut nearest = f64::INFINITY;
        for (&base, &slope) in scale.base.iter().zip(scale.slope) {
            nearest = least(nearest, self.leave(Sample::Scale, ends, base, slope));
            if slope == 0.0 {
                self.levels.add(&[base]);
            } else {
                self.shift
                    .count(&self.grid, base, slope, &mut self.rank_sums);
            }
        }
        self.levels.close();
        nearest
    }

    /// Counts a line outside X; returns its smallest distance to an end of X.
    #[inline(always)]
    fn leave(&mut self, sample: Sample, ends: [f64; 2], base: f64, slope: f64) -> f64 {
        let ahead = Wide(ends) - Wide::all(base);
        if slope == 0.0 {
            self.outside.stay(sample, base, ends);
            return least(ahead.0[0].abs(), ahead.0[1].abs());
        }
        let (places, gap) = self.grid.cross(ahead, Wide::all(slope));
        self.outside.pass(sample, slope, places);
        least(gap.0[0], gap.0[1])
    }

    /// Counts Y₁ against all levels on an even grid; returns the smallest distance.
    #[inline(always)]
    fn meet_levels(&mut self, even: Even, ends: [f64; 2], shift: Lines) -> f64 {
        let mut nearest = f64::INFINITY;
        let mut bases = shift.base;
        for slopes in shift.slope.chunk_by(|a, b| a == b) {
            let (alike, others) = bases.split_at(slopes.len());
            bases = others;
            if slopes[0] == 0.0 {
                for &base in alike {
                    nearest = least(nearest, self.stay(ends, base));
                }
                continue;
            }
            let pencil = Pencil::new(even, slopes[0]);
            nearest = least(nearest, self.levels.meet(&pencil, alike));
            if self.of_shift {
                let ends = pencil.scale(Wide(ends));
                for &base in alike {
                    let (places, _) = pencil.cross(ends, base);
                    self.outside.pass(Sample::Shift, slopes[0], places);
                }
            }
        }
        self.levels.count(&mut self.rank_sums);
        nearest
    }

    /// Counts a sample of Y₁ without slope against all levels; returns the smallest distance.
    #[inline(always)]
    fn stay(&mut self, ends: [f64; 2], value: f64) -> f64 {
        let mut nearest = f64::INFINITY;
        for level in self.levels.values() {
            self.rank_sums.start(usize::from(value > *level));
            nearest = least(nearest, (value - level).abs());
        }
        if self.of_shift {
            self.outside.stay(Sample::Shift, value, ends);
        }
        nearest
    }

    /// Counts all levels against Y₁ on an uneven grid; returns the smallest distance of Y₁ to an end of X.
    #[inline(always)]
    fn meet_one_by_one(&mut self, ends: [f64; 2], shift: Lines) -> f64 {
        for &level in self.levels.values() {
            self.shift
                .count(&self.grid, level, 0.0, &mut self.rank_sums);
        }
        let mut nearest = f64::INFINITY;
        if self.of_shift {
            for (&base, &slope) in shift.base.iter().zip(shift.slope) {
                nearest = least(nearest, self.leave(Sample::Shift, ends, base, slope));
            }
        }
        nearest
    }
}
