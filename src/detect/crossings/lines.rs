//! Samples as lines in Δ, and the crossings of those of Y₁ with another line.

use super::changes::{Changes, SPREAD};
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
    bases: Vec<f64>,
    slopes: Vec<f64>,
    /// Where each crosses the other line, as slots of [`Changes`].
    slots: Vec<[u32; SEVERAL]>,
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
            to.extend_from_slice(values);
            to.resize(arrays * SEVERAL, values[0]);
        }
        self.slots.resize(arrays, [0; SEVERAL]);
        self.nearest = Wide::all(f64::INFINITY);
    }

    /// Counts the lines above any other line, at every Δ.
    #[inline(always)]
    pub fn count(&mut self, grid: &Grid, base: f64, slope: f64, changes: &mut Changes) {
        let mut nearest = self.nearest;
        let (bases, slopes) = (self.bases.as_chunks().0, self.slopes.as_chunks().0);
        for ((bases, slopes), slots) in bases.iter().zip(slopes).zip(&mut self.slots) {
            let (ahead, closing) = (
                Wide::all(base) - Wide(*bases),
                Wide(*slopes) - Wide::all(slope),
            );
            let (places, gap) = grid.cross(ahead, closing);
            *slots = places.map(|place| place + SPREAD as u32);
            nearest = gap.least(nearest);
        }
        self.nearest = nearest;
        let slots = &self.slots.as_flattened()[..self.length];
        let slopes = &self.slopes[..self.length];
        for (slots, slopes) in slots.chunks(SEVERAL).zip(slopes.chunks(SEVERAL)) {
            if slopes.iter().all(|steep| *steep >= slope) {
                changes.add(slots, 1.0);
                continue;
            }
            for (slot, other) in slots.iter().zip(slopes) {
                // A steeper line is above from the crossing on, a flatter one up to there.
                changes.add(std::slice::from_ref(slot), other - slope);
            }
        }
    }

    /// The smallest distance between two lines at any Δ so far.
    #[inline(always)]
    pub fn nearest(&self) -> f64 {
        self.nearest.0.into_iter().fold(f64::INFINITY, least)
    }
}
