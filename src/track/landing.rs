//! The trips of a record among the floors of a building.

use super::floors::{Floors, Judgement, Stop};
use super::record::{Track, Tracked};
use crate::detection::Detection;
use crate::fields::names;
use crate::recording::Sample;
use serde_json::Value;

/// What the columns of a landing begin with.
const PREFIX: &str = "landing_";

/// A longer hole may hide a ride of one floor, s.
const HIDES: f64 = 4.0;

/// Whether nothing says what the cage did between two samples that follow each other.
pub(super) fn hides(one: Sample, next: Sample) -> bool {
    let since = next.time - one.time;
    since <= 0.0 || since > HIDES
}

impl Track {
    /// Takes the car through the trips of these samples. Where one is not measured from rest to rest, the record does not
    /// decide what the cage did, or a hole may hide it, the car may be at any floor. A hole may be before the last sample.
    pub fn land(&mut self, detection: &Detection, samples: &[Sample], floors: &mut Floors) {
        let undecided = detection.undecided.iter().map(|it| (it.from, it.to));
        let pairs = samples.windows(2).map(|pair| (pair[0], pair[1]));
        let holes = pairs.filter(|(one, next)| hides(*one, *next));
        // A clock that was set back hides what comes after.
        let holes = holes.map(|(one, next)| (one.time, next.time.max(one.time)));
        let holes: Vec<(f64, f64)> = holes.collect();
        let undecided: Vec<(f64, f64)> = undecided.collect();
        let is_in = |spans: &[(f64, f64)], from: f64, to: f64| {
            spans.iter().any(|span| span.0 < to && span.1 > from)
        };
        let mut stood = f64::NEG_INFINITY;
        for it in &mut self.trips {
            let start = it.trip.start.unwrap_or(stood);
            let stop = it.trip.stop.unwrap_or(f64::INFINITY);
            if is_in(&undecided, stood, stop) || is_in(&holes, stood, start) {
                floors.lose();
            }
            it.landing = it
                .closed()
                .filter(|_| !is_in(&undecided, start, stop))
                .map(|(distance, deviation)| floors.step(distance, deviation * deviation));
            match it.landing {
                Some(landing) => self.course.lay(stop, landing.position),
                None => floors.lose(),
            }
            stood = stop;
        }
        if is_in(&undecided, stood, f64::INFINITY) || is_in(&holes, stood, f64::INFINITY) {
            floors.lose();
        }
    }
}

impl Tracked {
    /// The distance from rest to rest, and its deviation.
    fn closed(&self) -> Option<(f64, f64)> {
        self.trip.stop?;
        self.distance.zip(self.deviation)
    }

    /// The value of a column of [`columns`]; null if it has none, nothing of another column.
    pub(super) fn landing_column(&self, name: &str) -> Option<Value> {
        let name = name.strip_prefix(PREFIX)?;
        let landing = serde_json::to_value(self.landing).expect("a landing is plain data");
        let nested = || {
            let (of, field) = name.split_once('_')?;
            landing.get(of)?.get(field)
        };
        let value = landing.get(name).or_else(nested);
        Some(value.cloned().unwrap_or_default())
    }
}

/// The columns that a trip gains among floors: the fields of [`Stop`], and those of its judgements.
pub(super) fn columns() -> impl Iterator<Item = String> {
    let nested = |name: &str| {
        let fields = names::<Judgement>().iter();
        fields
            .map(|field| format!("{PREFIX}{name}_{field}"))
            .collect()
    };
    let stop = names::<Stop>().iter();
    stop.flat_map(move |name| match *name {
        "judgement" | "earlier" => nested(name),
        name => vec![format!("{PREFIX}{name}")],
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_columns_are_the_fields() {
        let columns: Vec<String> = columns().collect();
        assert_eq!(
            columns.join(",").replace(PREFIX, ""),
            "position,deviation,from,floor,probability,\
             judgement_floor,judgement_offset,judgement_deviation,judgement_xi,judgement_fault,\
             earlier_floor,earlier_offset,earlier_deviation,earlier_xi,earlier_fault,added"
        );
    }
}
