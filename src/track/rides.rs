//! When a detection says that the cage stands and moves uniformly, around each of its trips.

use super::phases::Phases;
use super::settings::TrackSettings;
use crate::detection::{Detection, Trip};
use std::ops::Range;

/// After a trip that something disturbs at once so much is taken for rest, s: the cage stands there, it is said.
const LEAST_REST: f64 = 0.05;

/// What moves the sensor in a record, and where its stretches without holes are. Times in s.
pub(super) struct Surroundings {
    busy: Vec<Range<f64>>,
    stretches: Vec<Range<f64>>,
}

impl Surroundings {
    pub fn new(detection: &Detection, stretches: Vec<Range<f64>>) -> Self {
        let events = detection.events.iter().map(|it| it.from..it.to);
        let undecided = detection.undecided.iter().map(|it| it.from..it.to);
        let trips = (detection.trips.iter()).map(|trip| {
            trip.start.unwrap_or(f64::NEG_INFINITY)..trip.stop.unwrap_or(f64::INFINITY)
        });
        Self {
            busy: events.chain(undecided).chain(trips).collect(),
            stretches,
        }
    }

    /// The phases of a trip whose start is recorded.
    pub fn phases(&self, trip: &Trip, settings: &TrackSettings) -> Option<Phases> {
        let margin = settings.margin;
        let start = trip.start?;
        let after = match trip.stop {
            Some(stop) => self.rest_after(stop, settings),
            None => {
                let end = self.stretch(start).end;
                end..end
            }
        };
        let within =
            |from: Option<f64>, to: f64| from.map_or(to, |from| from + margin)..to - margin;
        let stop = trip.stop.unwrap_or(after.end + margin);
        let uniform = within(trip.inertial, trip.braking.unwrap_or(stop));
        Some(Phases {
            before: self.rest_before(start, settings),
            uniform: [
                uniform,
                within(trip.levelling, trip.landing.unwrap_or(stop)),
            ],
            after,
        })
    }

    /// When nothing moves the sensor.
    pub fn rests(&self, settings: &TrackSettings) -> Vec<Range<f64>> {
        let margin = settings.margin;
        let mut busy: Vec<&Range<f64>> = self.busy.iter().collect();
        busy.sort_by(|a, b| a.start.total_cmp(&b.start));
        let ends = self.stretches.first().zip(self.stretches.last());
        let (mut from, last) = ends.map_or((0.0, 0.0), |(first, last)| (first.start, last.end));
        let mut rests = Vec::new();
        for it in busy {
            rests.push(from..it.start - margin);
            from = from.max(it.end + margin);
        }
        rests.push(from..last);
        rests.retain(|part| !part.is_empty());
        rests
    }

    /// The uniform motions of trips, without creep, which shakes the sensor less.
    pub fn uniform(&self, trips: &[Trip], settings: &TrackSettings) -> Vec<Range<f64>> {
        let phases = trips.iter().filter_map(|trip| self.phases(trip, settings));
        let uniform = phases.map(|phases| phases.uniform[0].clone());
        uniform.filter(|part| !part.is_empty()).collect()
    }

    fn rest_before(&self, start: f64, settings: &TrackSettings) -> Range<f64> {
        let to = start - settings.foot;
        let first = self.stretch(start).start.max(to - settings.rest);
        let busy = self.busy.iter().filter(|busy| busy.start < to);
        let from = busy.map(|busy| busy.end).fold(first, f64::max);
        from.min(to)..to
    }

    fn rest_after(&self, stop: f64, settings: &TrackSettings) -> Range<f64> {
        let from = stop + settings.foot;
        let last = self.stretch(stop).end.min(from + settings.settling);
        let busy = self.busy.iter().filter(|busy| busy.start >= stop);
        let to = busy.map(|busy| busy.start).fold(last, f64::min);
        if to - from >= LEAST_REST {
            return from..to;
        }
        let from = from.min(last - LEAST_REST).max(stop);
        from..from + LEAST_REST
    }

    /// The stretch without holes around a time.
    fn stretch(&self, time: f64) -> &Range<f64> {
        let place = self.stretches.partition_point(|it| it.end < time);
        &self.stretches[place.min(self.stretches.len() - 1)]
    }
}
