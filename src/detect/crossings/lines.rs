//! Samples as lines in Δ, and where those of Y₁ cross another.

use super::grid::{Grid, round, round_up};
use crate::simd::{Wide, greatest, least};

/// Samples as lines in Δ.
#[derive(Clone, Copy, Debug)]
pub struct Lines<'a> {
    /// Their values at Δ = 0, finite.
    pub base: &'a [f64],
    /// What Δ = 1 adds to them.
    pub slope: &'a [f64],
}

impl Lines<'_> {
    /// The largest value that any of them may have on the grid.
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

/// Y₁: lines that all others are compared with, one after the other; the last array is filled up with
/// copies.
#[derive(Clone, Debug, Default)]
pub(super) struct Field {
    /// How many are no copies.
    pub length: usize,
    pub lines: Vec<Several>,
    pub least_slope: f64,
    /// The first Δ behind each crossing with the other line.
    pub behind: Vec<[u32; SEVERAL]>,
    /// How near any line has come to another at any Δ.
    pub nearest: Wide<SEVERAL>,
}

/// Lines side by side.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Several {
    base: Wide<SEVERAL>,
    pub slope: Wide<SEVERAL>,
    /// Steps of the grid for each unit that a line without slope is ahead.
    pace: Wide<SEVERAL>,
    /// What one step is worth: |slope| · step; where that is nothing, 1 stands in `flat`.
    stride: Wide<SEVERAL>,
    flat: Wide<SEVERAL>,
}

/// Three times this are the samples of Fig. 6.
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

    /// Finds the crossings with a line that has no slope, of this value.
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
