//! Samples as lines in Δ, and the crossings of those of Y₁ with another line.

use super::grid::{Grid, round, round_up};
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
    pub length: usize,
    pub lines: Vec<Several>,
    pub least_slope: f64,
    /// The index of the first Δ after each crossing with the other line.
    pub behind: Vec<[u32; SEVERAL]>,
    /// The smallest distance between two lines at any Δ so far.
    pub nearest: Wide<SEVERAL>,
}

/// Several lines side by side.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Several {
    base: Wide<SEVERAL>,
    pub slope: Wide<SEVERAL>,
    /// Steps of the grid until the crossing, for each unit that a line without slope is ahead.
    pace: Wide<SEVERAL>,
    /// The change in one step, |slope| · step; for a zero slope `flat` is 1.
    stride: Wide<SEVERAL>,
    flat: Wide<SEVERAL>,
}

/// Lines in an array. The 12 samples of Fig. 6 fill three arrays.
pub(super) const SEVERAL: usize = 4;

impl Field {
    #[inline(always)]
    pub fn take(&mut self, lines: Lines, grid: &Grid) {
        self.length = lines.base.len();
        let arrays = self.length.div_ceil(SEVERAL);
        self.lines.resize(arrays, Several::default());
        self.behind.resize(arrays, [0; SEVERAL]);
        self.nearest = Wide::all(f64::INFINITY);
        self.least_slope = f64::INFINITY;
        let (step, steps) = grid
            .even
            .map_or((1.0, 1.0), |even| (even.step, even.steps_per_unit));
        for (array, several) in self.lines.iter_mut().enumerate() {
            for lane in 0..SEVERAL {
                let line = array * SEVERAL + lane;
                let line = if line < self.length { line } else { 0 };
                several.base.0[lane] = lines.base[line];
                several.slope.0[lane] = lines.slope[line];
                self.least_slope = least(self.least_slope, lines.slope[line]);
                several.flat.0[lane] = if lines.slope[line] == 0.0 { 1.0 } else { 0.0 };
            }
            several.pace = Wide::all(steps) / several.slope;
            several.stride = several.slope.abs() * step;
        }
    }

    /// Finds the crossings with a line of slope zero and this value.
    #[inline(always)]
    pub fn meet_still(&mut self, grid: &Grid, value: f64) {
        let Some(even) = grid.even else {
            return self.meet(grid, value, 0.0);
        };
        let (value, start) = (
            Wide::all(value),
            Wide::all(even.start * even.steps_per_unit),
        );
        let mut nearest = self.nearest;
        for (several, behind) in self.lines.iter().zip(&mut self.behind) {
            let ahead = value - several.base;
            let place = even.clamp(ahead * several.pace - start);
            *behind = round_up(place);
            // Steps to the nearest grid point times the change in a step: no division, unlike `meet`.
            let gap = (place - round(place)).abs() * several.stride + ahead.abs() * several.flat;
            nearest = gap.least(nearest);
        }
        self.nearest = nearest;
    }

    /// Finds the crossings with any line.
    #[inline(always)]
    pub fn meet(&mut self, grid: &Grid, base: f64, slope: f64) {
        let mut nearest = self.nearest;
        for (several, behind) in self.lines.iter().zip(&mut self.behind) {
            let ahead = Wide::all(base) - several.base;
            let closing = several.slope - Wide::all(slope);
            let (first, gap) = grid.cross(ahead, closing);
            *behind = first;
            nearest = gap.least(nearest);
        }
        self.nearest = nearest;
    }
}
