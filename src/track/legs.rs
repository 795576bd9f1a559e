//! The trips of a record with what a barometer reads around them, and where the car stands after each.

use super::air::FREEZING;
use super::climb::Standing;
use super::column::GAIN;
use super::filter::Uncertain;
use super::fusion::{Leg, UNKNOWN, stays};
use super::height::Climbs;
use super::height_warning::HeightWarning;
use super::record::{Track, Tracked};
use super::unseen::Unseen;
use libm::hypot;

/// What is not known better is not said, m.
const VAGUE: f64 = 30.0;

impl Track {
    /// Gives each trip its height, and the position after it, as far as that is known, unless the barometer froze.
    pub fn rise(&mut self, climbs: &Climbs, unseen: &Unseen) {
        for (trip, climb) in self.trips.iter_mut().zip(&climbs.climbs) {
            trip.climb = *climb;
        }
        let is_frozen = |it: &HeightWarning| matches!(it, HeightWarning::Frozen { .. });
        if climbs.faults.iter().any(is_frozen) {
            return;
        }
        let stays = stays(&climbs.legs(&self.trips, unseen), |_| None);
        // An error of the air's temperature is one of all heights.
        let scale = climbs.air.deviation / (climbs.air.celsius + FREEZING);
        for (trip, stays) in self.trips.iter_mut().zip(stays.windows(2)) {
            let Uncertain { mean, variance } = stays[1].begin;
            let is_known = trip.trip.stop.is_some() && variance < VAGUE * VAGUE;
            trip.unseen = stays[0].unseen;
            trip.standing = is_known.then(|| Standing {
                position: mean,
                position_deviation: hypot(variance.sqrt(), scale * mean),
            });
        }
    }
}

impl Climbs {
    /// The trips with what the barometer reads around them. Where two rests are one it is read once.
    pub fn legs(&self, trips: &[Tracked], unseen: &Unseen) -> Vec<Leg> {
        // A temperature that is learnt of trips has the gain of the accelerometer.
        let gain = if self.air.learnt > 0 { 0.0 } else { GAIN };
        let mut read = f64::NEG_INFINITY;
        let mut stood = f64::NEG_INFINITY;
        let legs = trips.iter().zip(&self.rests).map(|(it, [before, after])| {
            let start = it.trip.start.unwrap_or(stood);
            let distance = it.distance.zip(it.deviation);
            let is_known = it.trip.stop.is_some() && unseen.is_decided(&it.trip);
            let distance = distance
                .filter(|_| is_known)
                .map(|(mean, deviation)| Uncertain {
                    mean,
                    variance: deviation.powi(2) + (gain * mean).powi(2),
                });
            let before = before.filter(|it| it.times.0 > read);
            read = after.map_or(read, |it| it.times.1);
            let around = unseen.around(start, it.trip.stop.unwrap_or(f64::INFINITY));
            let is_unseen = unseen.within(stood, around.start).next().is_some();
            stood = around.end;
            Leg {
                distance: distance.unwrap_or(UNKNOWN),
                before: before.map(|it| it.reading),
                after: after.map(|it| it.reading),
                is_unseen,
            }
        });
        legs.collect()
    }
}
