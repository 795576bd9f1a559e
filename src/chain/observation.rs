//! The observation of one trial at one point.

use super::keys::Keys;
use crate::detect::{Along, Forward, Pooled, Samples, Statistics, Ties};
use std::ops::Range;

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

    /// Takes the statistics of points along Δ that use no more than these.
    fn look_along(&mut self, tracks: &[Track], along: &Along, observation: &mut Observation) {
        for track in tracks {
            for (number, place) in (track.first..).zip(track.places.clone()) {
                observation.statistics = Some(along.at(number));
                self.look(place, observation);
            }
        }
    }
}

/// Points at consecutive places and values of Δ.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// The number of the first Δ.
    pub first: usize,
    /// The points' places.
    pub places: Range<usize>,
}

impl Track {
    /// The fewest tracks through points with these numbers and places.
    pub(super) fn through(mut points: Vec<(usize, usize)>) -> Vec<Self> {
        points.sort_unstable_by_key(|&(number, place)| (place, number));
        let follows = |a: &(usize, usize), b: &(usize, usize)| *b == (a.0 + 1, a.1 + 1);
        let tracks = points.chunk_by(follows).map(|points| Self {
            first: points[0].0,
            places: points[0].1..points[0].1 + points.len(),
        });
        tracks.collect()
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Two curves along the same Δ, the second on fewer values, and a point apart.
    #[test]
    fn tracks_follow_places_and_deltas() {
        let points = vec![(0, 3), (1, 4), (1, 7), (2, 5), (2, 8), (5, 9)];
        let track = |first, places| Track { first, places };
        let expected = [track(0, 3..6), track(1, 7..9), track(5, 9..10)];
        assert_eq!(Track::through(points), expected);
    }
}
