//! The observation of one trial at one point.

use super::keys::Keys;
use crate::detect::{Forward, Pooled, Samples, Statistics, Ties};

/// One trial of one point: the whitened samples, and the record if a method needs it.
pub struct Observation<'a, 'k> {
    /// X, Y₁ and Y₂, whitened; empty if the points need only W and T and these are known.
    pub pooled: Pooled<'a>,
    /// Their sizes and positions.
    pub samples: &'a Samples,
    /// The observed record, up to the last of X; empty unless a method here needs it.
    pub rest: &'a [f64],
    /// The observed record after X, with the motion in it; empty unless a method here needs it.
    pub motion: &'a [f64],
    pub(super) keys: &'a mut Keys<'k>,
    pub(super) statistics: Option<Statistics>,
    pub(super) scratch: &'a mut Scratch,
}

/// Scratch space for statistics of the record.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    pub innovations: Vec<f64>,
    pub forward: Forward,
}

/// A receiver of observations.
pub trait View {
    /// Takes the observation of the point at `place`.
    fn look(&mut self, place: usize, observation: &mut Observation);

    /// Takes the statistics of points along Δ that use only W and T: pairs of an index into `statistics` and
    /// a place.
    fn look_along(
        &mut self,
        points: &[[u32; 2]],
        statistics: &[Statistics],
        observation: &mut Observation,
    ) {
        for &[number, place] in points {
            observation.statistics = Some(statistics[number as usize]);
            self.look(place as usize, observation);
        }
    }
}

impl<F: FnMut(usize, &mut Observation)> View for F {
    fn look(&mut self, place: usize, observation: &mut Observation) {
        self(place, observation);
    }
}

impl<'a, 'k> Observation<'a, 'k> {
    /// An observation whose statistics have not been computed yet.
    pub(super) fn new(
        samples: &'a Samples,
        keys: &'a mut Keys<'k>,
        scratch: &'a mut Scratch,
    ) -> Self {
        Self {
            pooled: Pooled::default(),
            samples,
            rest: &[],
            motion: &[],
            keys,
            statistics: None,
            scratch,
        }
    }

    /// W and T.
    #[inline(always)]
    pub fn statistics(&mut self, ties: Ties) -> Statistics {
        match ties {
            Ties::Random => {
                let (pooled, keys) = (&self.pooled, &mut *self.keys);
                *self
                    .statistics
                    .get_or_insert_with(|| pooled.statistics(|| keys.random()))
            }
            // Only studies of ties ask for these, once per stage, so they are not cached.
            Ties::ByPosition => self.pooled.statistics(|| self.keys.positions()),
            Ties::Strict => self.pooled.statistics_strictly(),
        }
    }
}
