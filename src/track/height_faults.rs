//! What is wrong with a barometer: where it freezes, falls silent or jumps.

use super::air::{INDOORS, metres};
use super::column::{Column, UNLIKE, WEATHER};
use super::height_warning::HeightWarning;
use super::record::Tracked;
use super::still::{Rest, is_frozen, silence, usual_interval};
use super::unseen::Unseen;
use crate::recording::Pressure;
use libm::exp;

/// In a storm the weather is so many times as fast.
const STORM: f64 = 10.0;

/// What is wrong with a barometer with this noise of a second, these steps, and this error of a difference by them.
pub(super) fn faults(
    trips: &[Tracked],
    rests: &[[Rest; 2]],
    unseen: &Unseen,
    readings: &[Pressure],
    (second, step, rounded): (f64, f64, f64),
) -> Vec<HeightWarning> {
    let usual = usual_interval(readings);
    let jumps = |log: f64| log.abs() > Rest::jump(step);
    let of_trips = trips
        .iter()
        .zip(rests)
        .zip(1..)
        .flat_map(|((trip, [before, after]), next)| {
            let ride = trip.trip.ride;
            let frozen = is_frozen(trip, readings, step);
            let frozen = frozen.then_some(HeightWarning::Frozen {
                ride,
                distance: trip.distance,
            });
            let silent = silence(trip, readings, usual)
                .map(|seconds| HeightWarning::Silent { ride, seconds });
            let within = [before, after].map(|it| it.jump);
            // The rest after it, which may be too long to be looked at as a whole.
            let across = rests.get(next).and_then(|[other, _]| {
                // What went unseen may be a ride.
                let (from, to) = (trip.trip.stop?, trips[next].trip.start?);
                if unseen.within(from, to).next().is_some() {
                    return None;
                }
                let column = Column::between(after, other, second, rounded)?;
                let is_clear = column.log_ratio.abs() > UNLIKE * column.deviation;
                let is_within = after.jump.or(other.jump).is_some();
                // A barometer that drifts does not jump.
                let seconds = other.read.time - after.read.time;
                let storm = STORM * WEATHER * seconds / exp(after.read.mean);
                let is_jump = jumps(column.log_ratio) && column.log_ratio.abs() > storm;
                (is_clear && !is_within && is_jump).then_some(column.log_ratio)
            });
            let jumped = within.into_iter().chain([across]).flatten();
            let jumped = jumped.map(move |log| HeightWarning::Jump {
                ride,
                metres: metres(log, INDOORS.0),
            });
            frozen
                .into_iter()
                .chain(silent)
                .chain(jumped)
                .collect::<Vec<_>>()
        });
    of_trips.collect()
}
