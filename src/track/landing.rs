//! The trips of a record among the floors of a building.

use super::filter::Uncertain;
use super::floors::{Floors, Judgement, Stop};
use super::record::{Track, Tracked};
use super::unseen::Unseen;
use crate::detection::Detection;
use crate::fields::names;
use crate::recording::Sample;
use serde_json::Value;

/// What the columns of a landing begin with.
const PREFIX: &str = "landing_";

/// What a barometer does not know better says nothing of floors, and what is less is no ride, m.
const VAGUE: f64 = 0.5;
const NO_RIDE: f64 = 1.5;

impl Track {
    /// Takes the car through the trips of these samples. Where nothing says how far it went it may be at any floor: where it
    /// went unseen, or on a trip that the record does not decide, or does not show from rest to rest. Only a barometer may. A hole may
    /// be before the last sample.
    pub fn land(&mut self, detection: &Detection, samples: &[Sample], floors: &mut Floors) {
        let unseen = Unseen::of(detection, samples);
        let goes_unseen = |from, to| unseen.within(from, to).next().is_some();
        let mut stood = f64::NEG_INFINITY;
        for it in &mut self.trips {
            let start = it.trip.start.unwrap_or(stood);
            let stop = it.trip.stop.unwrap_or(f64::INFINITY);
            if goes_unseen(stood, start) {
                go_unseen(floors, it.unseen);
            }
            let closed = it.closed(unseen.is_decided(&it.trip));
            it.landing = closed.map(|it| floors.step(it.mean, it.variance));
            match it.landing {
                Some(landing) => self.course.lay(stop, landing.position),
                None => floors.lose(),
            }
            stood = unseen.around(start, stop).end;
        }
        if goes_unseen(stood, f64::INFINITY) {
            floors.lose();
        }
    }
}

/// Takes a car as far as a barometer says that it went unseen.
fn go_unseen(floors: &mut Floors, gone: Option<Uncertain>) {
    match gone.filter(|gone| gone.variance < VAGUE * VAGUE) {
        Some(Uncertain { mean, variance }) if mean.abs() > NO_RIDE => {
            floors.step(mean, variance);
        }
        Some(_) => {}
        None => floors.lose(),
    }
}

impl Tracked {
    /// The distance from rest to rest, where that is decided, or else the height.
    fn closed(&self, is_decided: bool) -> Option<Uncertain> {
        self.trip.stop?;
        let distance = self.distance.zip(self.deviation).filter(|_| is_decided);
        let height = || self.climb.map(|it| (it.height, it.height_deviation));
        let (mean, deviation) = distance.or_else(height)?;
        Some(Uncertain {
            mean,
            variance: deviation * deviation,
        })
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
