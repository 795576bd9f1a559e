//! Two hops that may be one ride behind a high-pass filter.
//!
//! Behind a filter whose time constant τ is short beside the pulses of a ride, its start to a speed v reads as a hop
//! that is τ v long, and its stop as one back. Where that filter cannot be told from the record, nor can the ride.

use super::pulse::Record;
use super::reading::Trip;
use super::restore::has_level;
use super::{Cause, Doubt};

/// A hop is no farther than this, m, and as far as the one back but for this share.
const FARTHEST: f64 = 4.0;
const UNLIKE: f64 = 0.25;

impl Record {
    /// The doubts about trips in pairs there and back, if all are and the sensor reads nothing on average.
    pub fn hops(&self, trips: &[Trip]) -> Vec<Doubt> {
        let (pairs, rest) = trips.as_chunks::<2>();
        let are_hops = |[out, back]: &[Trip; 2]| {
            let [out, back] = [out, back].map(|trip| self.distance(trip));
            let farthest = out.abs().max(back.abs());
            farthest <= FARTHEST && (out + back).abs() <= UNLIKE * farthest
        };
        if !rest.is_empty() || !pairs.iter().all(are_hops) || has_level(&self.cut) {
            return Vec::new();
        }
        let doubt = |[out, back]: &[Trip; 2]| Doubt {
            trips: vec![out.clone(), back.clone()],
            instead: vec![Trip {
                braking: back.start,
                levelling: None,
                stop: back.stop,
                pulses: out.pulses.start..back.pulses.end,
                changes: [&out.changes[..], &back.changes].concat(),
                ..out.clone()
            }],
            margin: 0.0,
            cause: Cause::Filter,
        };
        pairs.iter().map(doubt).collect()
    }

    /// About how far a trip goes, m, up positive: at its speed from the middle of its first change to that of its last.
    fn distance(&self, trip: &Trip) -> f64 {
        let middle = |change: usize| {
            let pulse = &self.pulses[change];
            (pulse.from + pulse.to) / 2.0
        };
        let changes = trip.changes.first().zip(trip.changes.last());
        let seconds = changes.map_or(0.0, |(first, last)| middle(*last) - middle(*first));
        if trip.is_up {
            trip.speed * seconds
        } else {
            -trip.speed * seconds
        }
    }
}
