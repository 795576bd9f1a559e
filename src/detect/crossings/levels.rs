//! Where lines of Y₁ cross samples that do not change with Δ, on an even grid.
//!
//! A line a + Δ g crosses the level z at the place (z − a) s + ½ − start/step, rounded, with s = 1/(g · step).
//! So lines of one slope share the products z s, and each pair costs one subtraction.

use super::changes::{Changes, SPREAD};
use super::grid::{Even, ROUND};
use crate::simd::{LANES, Wide, greatest};

/// Samples that do not change with Δ: those of X, then some of Y₂.
#[derive(Clone, Debug, Default)]
pub(super) struct Levels {
    values: Vec<f64>,
    length: usize,
    scaled: Vec<Wide>,
    /// Where lines cross the levels, as slots of [`Changes`], which are counted after all have been found: read
    /// sooner, they would wait to be written.
    rising: Vec<[u32; LANES]>,
    falling: Vec<[u32; LANES]>,
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
        self.rising.clear();
        self.falling.clear();
    }

    pub fn add(&mut self, values: &[f64]) {
        self.values.extend_from_slice(values);
    }

    /// Fills the last array up with levels that no line is above.
    #[inline(always)]
    pub fn close(&mut self) {
        self.length = self.values.len();
        let arrays = self.length.div_ceil(LANES);
        self.values.resize(arrays * LANES, f64::INFINITY);
        self.scaled.resize(arrays, Wide::default());
    }

    pub fn values(&self) -> &[f64] {
        &self.values[..self.length]
    }

    /// Finds where lines of one slope cross each level. Returns the smallest distance between them at any Δ, or
    /// at a few values beyond the grid if it is smaller there.
    #[inline(always)]
    pub fn meet(&mut self, pencil: &Pencil, bases: &[f64]) -> f64 {
        let (arrays, _) = self.values.as_chunks::<LANES>();
        for (scaled, levels) in self.scaled.iter_mut().zip(arrays) {
            *scaled = pencil.scale(Wide(*levels)) + Wide::all(SPREAD as f64);
        }
        let (first, beyond) = (SPREAD as f64, SPREAD as f64 + pencil.even.last + 1.0);
        let ends = [
            Wide(std::array::from_fn(|lane| first - lane as f64)),
            Wide(std::array::from_fn(|lane| beyond + lane as f64)),
        ];
        let slots = if pencil.slope > 0.0 {
            &mut self.rising
        } else {
            &mut self.falling
        };
        let found = slots.len();
        slots.resize(found + bases.len() * arrays.len(), [0; LANES]);
        let mut farthest = Wide::all(0.0);
        for (base, slots) in bases.iter().zip(slots[found..].chunks_mut(arrays.len())) {
            for (levels, slots) in self.scaled.iter().zip(slots) {
                let (crossed, off) = pencil.cross_within(ends, *levels, *base);
                *slots = crossed;
                farthest = off.greatest(farthest);
            }
        }
        let farthest = farthest.0.into_iter().fold(0.0, greatest);
        (0.5 - farthest) * (pencil.slope * pencil.even.step).abs()
    }

    /// Counts the pairs of a line and a level below it.
    #[inline(always)]
    pub fn count(&self, changes: &mut Changes) {
        changes.add(self.rising.as_flattened(), 1.0);
        changes.add(self.falling.as_flattened(), -1.0);
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

    /// z s + ½ − start/step of levels z.
    #[inline(always)]
    pub fn scale<const N: usize>(&self, levels: Wide<N>) -> Wide<N> {
        levels * self.pace + Wide::all(0.5 - self.even.start * self.even.steps_per_unit)
    }

    /// The index of the first Δ after each crossing with scaled levels, and how far, in steps, the place is
    /// off a whole number: half a step at a tie.
    #[inline(always)]
    pub fn cross<const N: usize>(&self, scaled: Wide<N>, base: f64) -> ([u32; N], Wide<N>) {
        let ends = [Wide::all(0.0), Wide::all(self.even.last + 1.0)];
        self.cross_within(ends, scaled, base)
    }

    /// The same, with crossings off the grid moved to these ends.
    #[inline(always)]
    fn cross_within<const N: usize>(
        &self,
        [first, last]: [Wide<N>; 2],
        scaled: Wide<N>,
        base: f64,
    ) -> ([u32; N], Wide<N>) {
        let place = (scaled - Wide::all(base * self.pace))
            .least(last)
            .greatest(first);
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
            let expected: Vec<usize> = values.iter().map(|&z| behind(z)).collect();
            let gap = |delta: f64, z: f64| f64::abs(base + delta * slope - z);
            // Beyond half a step from every crossing the distance only has to be no smaller than there.
            let bound = f64::abs(0.5 * step * slope);
            let smallest = |grid: std::ops::Range<isize>| {
                let deltas = grid.map(|i| start + i as f64 * step);
                let gaps = deltas.flat_map(|delta| values.iter().map(move |&z| gap(delta, z)));
                gaps.fold(bound, f64::min)
            };
            let (last, spread) = (points as isize, SPREAD as isize);
            let (smallest, at_least) = (smallest(0..last), smallest(-spread..last + spread));
            for vectors in Vectors::available() {
                let mut levels = Levels::default();
                levels.add(&values);
                levels.close();
                let pencil = Pencil::new(even, slope);
                let nearest = vectors.run(
                    #[inline(always)]
                    || levels.meet(&pencil, &[base]),
                );
                let slots = if slope > 0.0 { &levels.rising } else { &levels.falling };
                let place = |&slot: &u32| (slot as usize).saturating_sub(SPREAD).min(points);
                let places: Vec<usize> = slots.as_flattened().iter().map(place).collect();
                let (places, pads) = places.split_at(values.len());
                // At a tie the place may be on either side.
                prop_assert!(smallest < 1e-12 || places == expected, "{:?} {:?}", places, expected);
                let never = if slope > 0.0 { points } else { 0 };
                prop_assert!(pads.iter().all(|place| *place == never));
                // Ten roundings of numbers below 6 + 33 · 3.
                prop_assert!(nearest < smallest + 1e-12, "{} {}", nearest, smallest);
                prop_assert!(nearest > at_least - 1e-12, "{} {}", nearest, at_least);
            }
        }
    }
}
