//! What one trial gives at one point.

use super::keys::Keys;
use crate::detect::{Forward, Pooled, Samples, Statistics, Ties};

/// One trial of one point: whitened samples, and the record where it was asked for.
pub struct Observation<'a, 'k> {
    /// X, Y₁ and Y₂, whitened; empty where all points need is W and T, and these are known.
    pub pooled: Pooled<'a>,
    /// Where they lie.
    pub samples: &'a Samples,
    /// The observed record, up to the last of X; empty unless a method here needs it.
    pub rest: &'a [f64],
    /// The same from there on, with the motion in it; likewise.
    pub motion: &'a [f64],
    pub(super) keys: &'a mut Keys<'k>,
    pub(super) statistics: Option<Statistics>,
    pub(super) scratch: &'a mut Scratch,
}

/// The space that statistics of the record work in.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    pub innovations: Vec<f64>,
    pub forward: Forward,
}

/// Who looks at a trial.
pub trait View {
    /// The point at `place` is shown what it sees.
    fn look(&mut self, place: usize, observation: &mut Observation);

    /// Points along Δ are shown what they see, all of whom look at W and T alone: each place comes after
    /// the number of its `statistics`.
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
    /// Nothing seen yet.
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
            // Studies of ties ask once a stage, so that these need not be remembered.
            Ties::ByPosition => self.pooled.statistics(|| self.keys.positions()),
            Ties::Strict => self.pooled.statistics_strictly(),
        }
    }
}
