//! The trips of a record among the floors of a building.

use super::floors::{Floors, Judgement, Stop};
use super::record::{Track, Tracked};
use crate::detection::Detection;
use crate::fields::names;
use serde_json::Value;

/// What the columns of a landing begin with.
const PREFIX: &str = "landing_";

impl Track {
    /// Takes the car through its trips. Where one is not measured from rest to rest, or the record does not decide what
    /// the cage did, it may be at any floor.
    pub fn land(&mut self, detection: &Detection, floors: &mut Floors) {
        let is_undecided = |from: f64, to: f64| {
            let mut stretches = detection.undecided.iter();
            stretches.any(|it| it.from < to && it.to > from)
        };
        let mut stood = f64::NEG_INFINITY;
        for it in &mut self.trips {
            let start = it.trip.start.unwrap_or(stood);
            let stop = it.trip.stop.unwrap_or(f64::INFINITY);
            if is_undecided(stood, stop) {
                floors.lose();
            }
            it.landing = it
                .closed()
                .filter(|_| !is_undecided(start, stop))
                .map(|(distance, deviation)| floors.step(distance, deviation * deviation));
            match it.landing {
                Some(landing) => self.course.lay(stop, landing.position),
                None => floors.lose(),
            }
            stood = stop;
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
