//! The grid of values of Δ, and where two lines cross on it.

use crate::simd::{Wide, least};

/// The values of Δ, in ascending order.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    pub deltas: Vec<f64>,
    pub even: Option<Even>,
}

/// A grid of equal steps.
#[derive(Clone, Copy, Debug)]
pub(super) struct Even {
    pub start: f64,
    pub step: f64,
    pub steps_per_unit: f64,
    pub last: f64,
}

impl Grid {
    pub fn new(deltas: Vec<f64>) -> Self {
        let (start, last) = (deltas[0], deltas.len() - 1);
        let largest = start.abs().max(deltas[last].abs());
        let step = (deltas[last] - start) / last as f64;
        let is_even =
            |(i, delta): (usize, &f64)| (start + i as f64 * step - delta).abs() <= 1e-14 * largest;
        let even = Even {
            start,
            step,
            steps_per_unit: 1.0 / step,
            last: last as f64,
        };
        Self {
            even: deltas.iter().enumerate().all(is_even).then_some(even),
            deltas,
        }
    }

    /// The index of the first Δ from `ahead` / `closing` on, and the smallest |Δ · `closing` − `ahead`| on the
    /// grid.
    #[inline(always)]
    pub fn cross<const N: usize>(&self, ahead: Wide<N>, closing: Wide<N>) -> ([u32; N], Wide<N>) {
        match self.even {
            Some(even) => even.cross(ahead, closing),
            None => self.search(ahead, closing),
        }
    }

    fn search<const N: usize>(&self, ahead: Wide<N>, closing: Wide<N>) -> ([u32; N], Wide<N>) {
        let mut nearest = Wide::all(f64::INFINITY);
        let behind = std::array::from_fn(|lane| {
            let (ahead, closing) = (ahead.0[lane], closing.0[lane]);
            let first = (self.deltas).partition_point(|&delta| delta < ahead / closing);
            for delta in &self.deltas[first.saturating_sub(1)..self.deltas.len().min(first + 1)] {
                nearest.0[lane] = least((ahead - closing * delta).abs(), nearest.0[lane]);
            }
            first as u32
        });
        (behind, nearest)
    }
}

impl Even {
    #[inline(always)]
    pub fn cross<const N: usize>(&self, ahead: Wide<N>, closing: Wide<N>) -> ([u32; N], Wide<N>) {
        let (start, step) = (Wide::all(self.start), Wide::all(self.step));
        let place = self.clamp((ahead / closing - start) * self.steps_per_unit);
        // On an even grid only the point nearest to the crossing can be a near tie.
        let nearby = start + step * round(place).least(Wide::all(self.last));
        (round_up(place), (ahead - closing * nearby).abs())
    }

    /// Moves crossings beyond the grid to half a step outside, where they count the same.
    #[inline(always)]
    fn clamp<const N: usize>(&self, place: Wide<N>) -> Wide<N> {
        place
            .greatest(Wide::all(-0.5))
            .least(Wide::all(self.last + 0.5))
    }
}

/// Adding this to a number below 2⁵¹ rounds it to a whole number, held in the lowest bits of the sum.
pub(super) const ROUND: f64 = 1.5 * (1u64 << 52) as f64;

#[inline(always)]
fn round<const N: usize>(place: Wide<N>) -> Wide<N> {
    (place + Wide::all(ROUND)) - Wide::all(ROUND)
}

/// Rounds up; a whole number may go to either neighbour, because it is a near tie anyway.
#[inline(always)]
fn round_up<const N: usize>(place: Wide<N>) -> [u32; N] {
    ((place + Wide::all(0.5)) + Wide::all(ROUND)).low_bits()
}
