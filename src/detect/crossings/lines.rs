//! Samples as lines in Δ, and the crossings of those of Y₁ with another line.

use super::changes::Changes;
use super::grid::Grid;
use crate::simd::{Wide, greatest, least};

/// Samples as lines in Δ.
#[derive(Clone, Copy, Debug)]
pub struct Lines<'a> {
    /// The values at Δ = 0, finite.
    pub base: &'a [f64],
    /// The slopes: the change for Δ = 1.
    pub slope: &'a [f64],
}

impl Lines<'_> {
    /// An upper bound of their absolute values on the grid.
    #[inline(always)]
    pub(super) fn largest(self, grid: &Grid) -> f64 {
        let delta = grid.deltas[0]
            .abs()
            .max(grid.deltas[grid.deltas.len() - 1].abs());
        let (mut base, mut slope) = (0.0, 0.0);
        for value in self.base {
            base = greatest(base, value.abs());
        }
        for value in self.slope {
            slope = greatest(slope, value.abs());
        }
        base + delta * slope
    }
}

/// Y₁ in arrays: the lines that all others are compared with. The last array is filled up with copies.
#[derive(Clone, Debug, Default)]
pub(super) struct Field {
    /// The number of lines without the copies.
    length: usize,
    bases: Vec<Wide<SEVERAL>>,
    slopes: Vec<Wide<SEVERAL>>,
    least_slope: f64,
    /// The index of the first Δ after each crossing with the other line.
    behind: Vec<[u32; SEVERAL]>,
    /// The smallest distance between two lines at any Δ so far.
    nearest: Wide<SEVERAL>,
}

/// Lines in an array. The 12 samples of Fig. 6 fill three arrays.
const SEVERAL: usize = 4;

impl Field {
    #[inline(always)]
    pub fn take(&mut self, lines: Lines) {
        self.length = lines.base.len();
        let arrays = self.length.div_ceil(SEVERAL);
        for (to, values) in [
            (&mut self.bases, lines.base),
            (&mut self.slopes, lines.slope),
        ] {
            to.clear();
            for several in values.chunks(SEVERAL) {
                let mut wide = Wide::all(values[0]);
                wide.0[..several.len()].copy_from_slice(several);
                to.push(wide);
            }
        }
        self.behind.resize(arrays, [0; SEVERAL]);
        self.nearest = Wide::all(f64::INFINITY);
        self.least_slope = lines.slope.iter().copied().fold(f64::INFINITY, least);
    }

    /// Counts the lines above any other line, at every Δ.
    #[inline(always)]
    pub fn count(&mut self, grid: &Grid, base: f64, slope: f64, changes: &mut Changes) {
        let mut nearest = self.nearest;
        let lines = self.bases.iter().zip(&self.slopes);
        for ((bases, slopes), behind) in lines.zip(&mut self.behind) {
            let (ahead, closing) = (Wide::all(base) - *bases, *slopes - Wide::all(slope));
            let (first, gap) = grid.cross(ahead, closing);
            *behind = first;
            nearest = gap.least(nearest);
        }
        self.nearest = nearest;
        let behind = &self.behind.as_flattened()[..self.length];
        if self.least_slope >= slope {
            return changes.add(behind, 1.0);
        }
        for (line, place) in behind.iter().enumerate() {
            // A steeper line is above from the crossing on, a flatter one up to there.
            let closing = self.slopes[line / SEVERAL].0[line % SEVERAL] - slope;
            changes.add(std::slice::from_ref(place), closing);
        }
    }

    /// The smallest distance between two lines at any Δ so far.
    #[inline(always)]
    pub fn nearest(&self) -> f64 {
        self.nearest.0.into_iter().fold(f64::INFINITY, least)
    }
}
