//! The record around a ride, even in time.

use super::weighting::Weighting;
use crate::recording::Sample;
use crate::track::phases::Phases;
use crate::track::steps::HOLE;
use std::ops::Range;

/// The shortest stretch in which vibration is looked at, and the least rest around a ride, s.
pub(super) const SHORTEST: f64 = 1.0;

/// One direction of the record around a ride, even in time, without what rest reads.
pub(super) struct Signal {
    from: f64,
    pub rate: f64,
    pub values: Vec<f64>,
    /// Before the ride.
    pub rest: Range<f64>,
}

impl Signal {
    /// Samples joined by straight lines; none if there is a hole, or too little rest.
    pub fn of(samples: &[Sample], rate: f64, phases: &Phases) -> Option<Self> {
        let (from, to) = (phases.before.start, phases.after.end);
        let first = samples
            .partition_point(|it| it.time <= from)
            .saturating_sub(1);
        let part = &samples[first..];
        let part = &part[..(part.partition_point(|it| it.time < to) + 1).min(part.len())];
        if part
            .windows(2)
            .any(|pair| pair[1].time - pair[0].time > HOLE)
        {
            return None;
        }
        let mut next = 0;
        let number = ((to - from) * rate).floor() as usize + 1;
        let value = |place: usize| {
            let time = from + place as f64 / rate;
            while next < part.len() && part[next].time < time {
                next += 1;
            }
            let [last, next] =
                [next.saturating_sub(1), next].map(|at| part.get(at).or(part.last()));
            let (last, next) = last.zip(next)?;
            let seconds = next.time - last.time;
            let share = if seconds > 0.0 {
                (time - last.time) / seconds
            } else {
                0.0
            };
            Some(
                last.acceleration + share.clamp(0.0, 1.0) * (next.acceleration - last.acceleration),
            )
        };
        let values: Option<Vec<f64>> = (0..number).map(value).collect();
        let mut signal = Self {
            from,
            rate,
            values: values?,
            rest: phases.before.clone(),
        };
        let rests = [&phases.before, &phases.after].map(|it| signal.at(it));
        let number = rests.iter().map(|it| it.len()).sum::<usize>();
        if (number as f64) < SHORTEST * rate {
            return None;
        }
        let level = rests.iter().flat_map(|it| it.iter()).sum::<f64>() / number as f64;
        signal.values.iter_mut().for_each(|it| *it -= level);
        Some(signal)
    }

    pub fn places(&self, part: &Range<f64>) -> Range<usize> {
        let place = |time: f64| {
            (((time - self.from) * self.rate).ceil().max(0.0) as usize).min(self.values.len())
        };
        place(part.start)..place(part.end).max(place(part.start))
    }

    pub fn at(&self, part: &Range<f64>) -> &[f64] {
        &self.values[self.places(part)]
    }

    pub fn weighted(&self, weighting: Weighting) -> Self {
        Self {
            values: weighting.apply(&self.values, self.rate),
            rest: self.rest.clone(),
            ..*self
        }
    }

    /// The speeds of a cage that stands at both ends, m/s.
    pub fn speeds(&self, trip: &Range<usize>) -> Vec<f64> {
        let values = &self.values[trip.clone()];
        let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
        let steps = values.iter().scan(0.0, |speed, value| {
            *speed += (value - mean) / self.rate;
            Some(*speed)
        });
        steps.collect()
    }
}
