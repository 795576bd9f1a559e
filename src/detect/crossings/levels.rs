//! Where lines of Y₁ cross samples that do not change with Δ, on an even grid.
//!
//! A line a + Δ g crosses the level z at the place (z − a) s + ½ − start/step, rounded, with s = 1/(g · step).
//! So lines of one slope share the products z s, and each pair costs one subtraction.

use super::grid::{Even, ROUND};
use crate::simd::{LANES, Wide, greatest};

/// Samples that do not change with Δ: those of X, then some of Y₂.
#[derive(Clone, Debug, Default)]
pub(super) struct Levels {
    values: Vec<f64>,
    length: usize,
    scaled: Vec<Wide>,
    places: Vec<[u32; LANES]>,
}

/// Lines of one slope.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pencil {
    even: Even,
    slope: f64,
    /// Steps of the grid for each unit that a line is behind.
    pace: f64,
}

impl Levels {
    pub fn clear(&mut self) {
        self.values.clear();
    }

    pub fn add(&mut self, values: &[f64]) {
        self.values.extend_from_slice(values);
    }

    /// Fills the last array up with levels that are never reached.
    #[inline(always)]
    pub fn close(&mut self) {
        self.length = self.values.len();
        let arrays = self.length.div_ceil(LANES);
        self.values.resize(arrays * LANES, f64::NAN);
        self.scaled.resize(arrays, Wide::default());
        self.places.resize(arrays, [0; LANES]);
    }

    pub fn values(&self) -> &[f64] {
        &self.values[..self.length]
    }

    /// Prepares for lines of this slope.
    #[inline(always)]
    pub fn scale(&mut self, pencil: &Pencil) {
        let (arrays, _) = self.values.as_chunks::<LANES>();
        for (scaled, levels) in self.scaled.iter_mut().zip(arrays) {
            *scaled = pencil.scale(Wide(*levels));
        }
    }

    /// Finds the places where a line of the slope scaled for crosses each level, and the smallest distance
    /// between them at any Δ.
    #[inline(always)]
    pub fn meet(&mut self, pencil: &Pencil, base: f64) -> (&[u32], f64) {
        let mut farthest = Wide::all(0.0);
        for (levels, places) in self.scaled.iter().zip(&mut self.places) {
            let (crossed, off) = pencil.cross(*levels, base);
            *places = crossed;
            farthest = off.greatest(farthest);
        }
        let farthest = farthest.0.into_iter().fold(0.0, greatest);
        let nearest = (0.5 - farthest) * (pencil.slope * pencil.even.step).abs();
        (&self.places.as_flattened()[..self.length], nearest)
    }
}

impl Pencil {
    /// Lines of this slope, which is not zero.
    #[inline(always)]
    pub fn new(even: Even, slope: f64) -> Self {
        Self {
            even,
            slope,
            pace: even.steps_per_unit / slope,
        }
    }

    #[inline(always)]
    pub fn slope(&self) -> f64 {
        self.slope
    }

    /// z s + ½ − start/step of levels z.
    #[inline(always)]
    pub fn scale<const N: usize>(&self, levels: Wide<N>) -> Wide<N> {
        levels * self.pace + Wide::all(0.5 - self.even.start * self.even.steps_per_unit)
    }

    /// The index of the first Δ after each crossing with scaled levels, and how far, in steps, the place is
    /// off a whole number: half a step at a tie.
    #[inline(always)]
    pub fn cross<const N: usize>(&self, scaled: Wide<N>, base: f64) -> ([u32; N], Wide<N>) {
        let last = Wide::all(self.even.last + 1.0);
        // In this order a level that is no number lies beyond the last Δ.
        let place = (scaled - Wide::all(base * self.pace))
            .least(last)
            .greatest(Wide::all(0.0));
        let raised = place + Wide::all(ROUND);
        (
            raised.low_bits(),
            (place - (raised - Wide::all(ROUND))).abs(),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::super::grid::Grid;
    use super::*;
    use crate::simd::Vectors;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig { rng_seed: prop::test_runner::RngSeed::Fixed(2014), cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

        /// Places by searching the grid for the crossing, distances by comparing at every Δ near it.
        #[test]
        fn agree_with_searching(
            (start, step, points) in (-2.0..1.0, 0.01..0.5, 2usize..70),
            values in prop::collection::vec(-6.0..6.0, 1..30),
            base in -6.0f64..6.0,
            slope in prop_oneof![-3.0..-0.1, 0.1..3.0],
        ) {
            let deltas: Vec<f64> = (0..points).map(|i| start + i as f64 * step).collect();
            let even = Grid::new(deltas.clone()).even.expect("equal steps");
            let behind = |z: f64| deltas.partition_point(|&delta| delta < (z - base) / slope);
            let expected: Vec<u32> = values.iter().map(|&z| behind(z) as u32).collect();
            let gap = |delta: f64, z: f64| f64::abs(base + delta * slope - z);
            let gaps = values.iter().flat_map(|&z| deltas.iter().map(move |&delta| gap(delta, z)));
            // Beyond half a step from every crossing the distance only has to be no smaller than there.
            let bound = f64::abs(0.5 * step * slope);
            let smallest = gaps.fold(bound, f64::min);
            for vectors in Vectors::available() {
                let mut levels = Levels::default();
                levels.add(&values);
                levels.close();
                let pencil = Pencil::new(even, slope);
                let (places, nearest) = vectors.run(
                    #[inline(always)]
                    || {
                        levels.scale(&pencil);
                        levels.meet(&pencil, base)
                    },
                );
                prop_assert_eq!(places, &expected[..]);
                // Ten roundings of numbers below 6 + 33 · 3.
                prop_assert!(f64::abs(nearest - smallest) < 1e-12, "{} {}", nearest, smallest);
            }
        }
    }
}
