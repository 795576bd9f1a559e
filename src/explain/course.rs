//! Speed and position by integration: zero speed at rest, and between rests the sum of what the record shows.

use super::{Explanation, Trip};
use std::ops::Range;

/// The cage at the end of a block.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Place {
    /// m/s, up positive.
    pub speed: f64,
    /// From where the record begins, m, up positive.
    pub position: f64,
}

impl Explanation {
    /// The blocks of a trip, to the ends of its stretch where it is open.
    pub fn blocks_of(&self, trip: &Trip) -> Range<usize> {
        let cut = &self.record.cut;
        let first = self.record.pulses[trip.pulses.start].blocks.start;
        let last = self.record.pulses[trip.pulses.end - 1].blocks.end;
        let before = cut.ends.iter().copied().rfind(|end| *end <= first);
        let after = cut.ends.iter().copied().find(|end| *end >= last);
        let from = if trip.start.is_some() {
            first
        } else {
            before.unwrap_or(0)
        };
        let to = if trip.stop.is_some() {
            last
        } else {
            after.unwrap_or(last)
        };
        from..to
    }

    /// The place of the cage at every block. What a trip's changes of speed do not sum to is taken off evenly; a trip
    /// that is open at its start is summed from its stop backwards.
    pub fn course(&self) -> Vec<Place> {
        let blocks = &self.record.cut.blocks;
        let mut speeds = vec![0.0; blocks.len()];
        for trip in &self.reading.trips {
            let range = self.blocks_of(trip);
            let shifts = trip.changes.iter().map(|pulse| &self.record.pulses[*pulse]);
            let shifts: Vec<_> = shifts.filter(|pulse| pulse.shift != 0.0).collect();
            let mut speed = 0.0;
            for block in range.clone() {
                speed += self.record.change(block..block + 1);
                let shifts = shifts.iter().filter(|pulse| pulse.blocks.contains(&block));
                speed += shifts.map(|pulse| pulse.shift).sum::<f64>() * blocks[block].seconds;
                speeds[block] = speed;
            }
            let is_open = (trip.start.is_none(), trip.stop.is_none());
            let length = range.len() as f64;
            for (place, block) in range.enumerate() {
                speeds[block] -= match is_open {
                    (false, false) => speed * (place + 1) as f64 / length,
                    (true, _) => speed,
                    (false, true) => 0.0,
                };
            }
        }
        let mut position = 0.0;
        let places = speeds.into_iter().zip(blocks).map(|(speed, block)| {
            position += speed * block.seconds;
            Place { speed, position }
        });
        places.collect()
    }
}
