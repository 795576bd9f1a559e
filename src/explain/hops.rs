//! Two hops that may be one ride behind a high-pass filter.
//!
//! Behind a filter whose time constant τ is short beside the pulses of a ride, its start to a speed v reads as a hop
//! that is τ v long, and its stop as one back. Where that filter cannot be told from the record, nor can the ride.

use super::pulse::Pulse;
use super::reading::Trip;
use super::record::Record;
use super::restore::is_near_zero;
use super::{Cause, Doubt};

/// A hop is as far as the one back but for this share.
const UNLIKE: f64 = 0.25;

/// It is no farther than this, m, and lasts no longer than an acceleration, so that its two changes of speed follow within
/// this time, s: of any shape, and where both decay like the tails behind a filter.
const ANY: (f64, f64) = (4.0, 6.0);
const TAILS: (f64, f64) = (8.0, 10.0);

/// The first half of a tail changes the speed by so many times the second.
const DECAYS: f64 = 2.0;

impl Record {
    /// The doubts about hops there and back, if the sensor reads nothing on average.
    pub fn hops(&self, trips: &[Trip]) -> Vec<Doubt> {
        let mut doubts = Vec::new();
        let mut rest = if is_near_zero(&self.cut) { trips } else { &[] };
        while let [out, back, ..] = rest {
            let are_hops = self.are_hops(out, back);
            if are_hops {
                doubts.push(one_ride(out, back));
            }
            rest = &rest[if are_hops { 2 } else { 1 }..];
        }
        doubts
    }

    fn are_hops(&self, out: &Trip, back: &Trip) -> bool {
        let (Some(there), Some(again)) = (self.hop(out), self.hop(back)) else {
            return false;
        };
        out.is_up != back.is_up && (there - again).abs() <= UNLIKE * there.max(again)
    }

    /// About how far a trip goes if it is a hop, m: at its speed from the middle of its first change to that of its last.
    fn hop(&self, trip: &Trip) -> Option<f64> {
        trip.start.and(trip.stop)?;
        let (first, last) = (trip.changes.first()?, trip.changes.last()?);
        let (first, last) = (&self.pulses[*first], &self.pulses[*last]);
        let middle = (last.from + last.to - first.from - first.to) / 2.0;
        let distance = trip.speed * middle;
        let (farthest, pause) = if self.is_tail(first) && self.is_tail(last) {
            TAILS
        } else {
            ANY
        };
        (last.from - first.to <= pause && distance <= farthest).then_some(distance)
    }

    /// Whether a pulse decays like the tail behind a filter.
    fn is_tail(&self, pulse: &Pulse) -> bool {
        let (from, to) = (pulse.blocks.start, pulse.blocks.end);
        let middle = (from + to) / 2;
        let [first, second] = [from..middle, middle..to].map(|half| self.change_by(pulse, half));
        (first - DECAYS * second) * pulse.change > 0.0
    }
}

/// The doubt that two hops are a ride which starts with one and stops with the other.
fn one_ride(out: &Trip, back: &Trip) -> Doubt {
    Doubt {
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
    }
}
