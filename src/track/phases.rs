//! A trip whose phases are known, and the trip filter told by them when the cage stands and when it moves uniformly.
//!
//! Whoever has the whole record sees every moment from both sides, and so knows more than a detector that looks ahead for a
//! third of a second: that a plateau is no uniform motion, and that levelling is no stop.

use super::filter::{TripFilter, Uncertain, Update};
use super::integrals::{integrated, moments};
use super::settings::TrackSettings;
use super::steps::{HOLE, Step, Steps};
use super::travelled::Travelled;
use crate::recording::Sample;
use std::ops::Range;

/// When the cage stands and moves uniformly, beyond doubt, before, in and after a trip, s. Any may be empty.
#[derive(Clone, Debug, PartialEq)]
pub struct Phases {
    /// At rest before the trip; it ends before the trip begins.
    pub before: Range<f64>,
    /// At full speed, and levelling.
    pub uniform: [Range<f64>; 2],
    /// At rest after the trip.
    pub after: Range<f64>,
}

/// How the distance of a trip is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// By the trip filter.
    Filter,
    /// By the moment formula: the bound.
    Moments,
    /// By integration, with the drift of the speed removed linearly.
    DriftRemoved,
    /// By plain integration.
    Integrated,
}

impl Phases {
    /// From the last moment of rest before the trip to the first after it, s.
    pub fn trip(&self) -> Range<f64> {
        self.before.end..self.after.start
    }

    /// When its speed may change, in order of time.
    pub fn changes(&self) -> Vec<Range<f64>> {
        let trip = self.trip();
        let mut from = trip.start;
        let mut changes = Vec::new();
        for uniform in self.uniform.iter().filter(|part| !part.is_empty()) {
            changes.push(from..uniform.start);
            from = uniform.end;
        }
        changes.push(from..trip.end);
        changes
    }

    /// Its changes of speed, where the acceleration of a trip without uniform motion is one and its braking another.
    fn split(&self) -> Vec<Range<f64>> {
        let top = f64::midpoint(self.uniform[0].start, self.uniform[0].end);
        let cut = |part: Range<f64>| {
            let inside = part.start < top && top < part.end;
            let at = if inside { top } else { part.end };
            [part.start..at, at..part.end]
        };
        let parts = self.changes().into_iter().flat_map(cut);
        parts.filter(|part| !part.is_empty()).collect()
    }

    /// The deviation of the distance, m, where the sensor has steps so coarse, m/s², that each change of speed is read
    /// wrong by a part of one all the time.
    pub(super) fn error_of_steps(&self, step: f64) -> f64 {
        let changes = self.split();
        let length = |part: &Range<f64>| part.end - part.start;
        let moment = |part: &Range<f64>| f64::midpoint(part.start, part.end) * length(part);
        let seconds: f64 = changes.iter().map(length).sum();
        let middle = changes.iter().map(moment).sum::<f64>() / seconds;
        let levers = changes
            .iter()
            .map(|part| moment(part) - middle * length(part));
        step / 12f64.sqrt() * levers.map(|lever| lever * lever).sum::<f64>().sqrt()
    }

    /// The distance by any method, m.
    pub fn distance(
        &self,
        method: Method,
        samples: &[Sample],
        bias: Uncertain,
        settings: &TrackSettings,
    ) -> Uncertain {
        if method == Method::Filter {
            return self.measure(samples, bias, settings, |_, _, _| {}).distance;
        }
        let steps: Vec<Step> = Steps::of(self.part(samples)).collect();
        let seconds: f64 = steps.iter().map(|step| step.seconds).sum();
        let density = settings.noise.density(seconds / steps.len() as f64);
        match method {
            Method::Integrated => integrated(&steps, &self.trip(), bias, density),
            Method::DriftRemoved => moments(&steps, &[self.trip()], density),
            Method::Filter | Method::Moments => moments(&steps, &self.changes(), density),
        }
    }

    /// Measures the trip by the filter, and shows every step to `watch`.
    pub fn measure(
        &self,
        samples: &[Sample],
        bias: Uncertain,
        settings: &TrackSettings,
        mut watch: impl FnMut(&Step, Update, &TripFilter),
    ) -> Travelled {
        let mut filter = TripFilter::new(settings.noise, bias);
        let mut closing = None;
        for step in Steps::of(self.part(samples)) {
            let update = self.update(step.time);
            // In a hole of a uniform motion the sensor would have read its bias.
            let is_hole = update == Update::Uniform && step.seconds > HOLE;
            let bias = is_hole.then(|| filter.bias().mean);
            filter.shake(settings.shaken(update));
            filter.predict(bias.unwrap_or(step.acceleration), step.seconds);
            if closing.is_none() && self.after.contains(&step.time) {
                closing = Some(filter.standing(step.seconds, 0.0));
            }
            filter.update(update, step.seconds);
            if self.before.contains(&step.time) {
                filter.restart();
            }
            watch(&step, update, &filter);
        }
        let trip = self.trip();
        let closing =
            closing.map(|closing| Travelled::closing(closing, trip.end - trip.start, settings));
        closing.unwrap_or_default().plus(filter.distance())
    }

    fn part<'a>(&self, samples: &'a [Sample]) -> &'a [Sample] {
        let place = |time: f64| samples.partition_point(|sample| sample.time < time);
        &samples[place(self.before.start)..place(self.after.end)]
    }

    fn update(&self, time: f64) -> Update {
        if self.before.contains(&time) || self.after.contains(&time) {
            Update::Standing
        } else if self.uniform.iter().any(|part| part.contains(&time)) {
            Update::Uniform
        } else {
            Update::None
        }
    }
}
