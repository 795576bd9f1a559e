//! One point of a study: a drive, a cage with a sensor in it, and a monitor.

use super::keys::RideKeys;
use super::{MOST_TRIPS, Measure, RideProblem};
use crate::config::value::{Number, Whole};
use crate::monitor::Settings;
use crate::signal::{
    Digitiser, Disturbance, Drive, During, Ending, Impulses, Pickup, Ride, RideError, Sensor, Trip,
};
use toml::Spanned;

/// All that a trial needs beside its draws.
#[derive(Clone, Debug, PartialEq)]
pub struct RidePoint {
    /// What is asked of it.
    pub measure: Measure,
    /// Of every trip, m; up and down in turn.
    pub distance: f64,
    /// The limits of its motion.
    pub drive: Drive,
    /// How many there are.
    pub trips: usize,
    /// The shortest and the longest rest before, between and after them, s; uniformly random.
    pub rest: [f64; 2],
    /// How long a rest is that is watched for itself, s.
    pub length: f64,
    /// In how many s a jam brings the cage to a stand.
    pub jam_within: f64,
    /// How far from the truth, s, a start, a stop or a jam may be told to have been.
    pub tolerance: f64,
    /// Hz.
    pub rate: f64,
    /// In the cage.
    pub pickup: Pickup,
    /// What the monitor is told.
    pub settings: Settings,
    /// Whether it has learnt what rest is like, from another rest.
    pub learnt: bool,
    /// Whether it is told that the record begins at rest; what it is told need not be true.
    pub begins_at_rest: bool,
    /// Whether it is told that motion shows.
    pub motion_shows: bool,
}

/// The deviation of the noise where the file says nothing, m/s²: that of a good phone.
const SIGMA: f64 = 0.012;

impl RidePoint {
    pub(super) fn new(measure: Measure, keys: &RideKeys) -> Result<Self, RideProblem> {
        let drive = keys.drive()?;
        let rate = number(&keys.rate, 100.0);
        let point = Self {
            measure,
            distance: positive("distance", &keys.distance, 12.0)?,
            trips: keys.trips()?,
            rest: keys.rest()?,
            length: positive("length", &keys.length, 600.0)?,
            jam_within: positive("jam_within", &keys.jam_within, 0.1)?,
            tolerance: positive("tolerance", &keys.tolerance, 0.5)?,
            pickup: keys.pickup(&drive, rate)?,
            settings: keys.settings(),
            learnt: flag(&keys.learnt, false),
            begins_at_rest: flag(&keys.begins_at_rest, measure != Measure::SwitchedOn),
            motion_shows: flag(&keys.motion_shows, false),
            drive,
            rate,
        };
        point.check()?;
        Ok(point)
    }

    /// Whatever is drawn, a trial can be run: the longest can.
    fn check(&self) -> Result<(), RideProblem> {
        self.settings.at(self.rate)?;
        if self.measure.rests() {
            self.still()?;
        }
        if self.measure.rides() {
            let (from, to) = self.trip(0, Ending::Commanded).course()?.uniform_motion();
            let must_be_uniform = matches!(self.measure, Measure::Jam | Measure::SwitchedOn);
            if must_be_uniform && to - from < 1e-6 {
                return Err(RideProblem::NeverUniform(self.distance));
            }
            self.ride(|| 1.0)?;
        }
        Ok(())
    }

    /// A rest that is watched for itself.
    ///
    /// # Errors
    /// Where it is too long to be held.
    pub fn still(&self) -> Result<Ride, RideError> {
        Ride::still(self.rate, self.length)
    }

    /// A ride; its rests and the moment of a jam are drawn by `uniform`, numbers in [0, 1].
    ///
    /// # Errors
    /// Where it is too long to be held.
    pub fn ride(&self, mut uniform: impl FnMut() -> f64) -> Result<Ride, RideError> {
        let [shortest, longest] = self.rest;
        let rests = (0..=self.trips).map(|_| shortest + (longest - shortest) * uniform());
        let rests = rests.collect();
        let mut trips: Vec<Trip> = (0..self.trips)
            .map(|index| self.trip(index, Ending::Commanded))
            .collect();
        if let (Measure::Jam, Some(last)) = (self.measure, trips.last_mut()) {
            let refused = |reason| RideError::Trip { number: 1, reason };
            let (from, to) = last.course().map_err(refused)?.uniform_motion();
            last.ending = Ending::Jam {
                after: (from + (to - from) * uniform()).min(to),
                within: self.jam_within,
            };
        }
        Ride::new(self.rate, rests, trips)
    }

    fn trip(&self, index: usize, ending: Ending) -> Trip {
        let sign = if index.is_multiple_of(2) { 1.0 } else { -1.0 };
        Trip {
            distance: sign * self.distance,
            drive: self.drive,
            ending,
        }
    }
}

impl RideKeys {
    fn drive(&self) -> Result<Drive, RideProblem> {
        Ok(Drive {
            speed: positive("speed", &self.speed, 1.0)?,
            acceleration: positive("acceleration", &self.acceleration, 0.6)?,
            jerk: positive("jerk", &self.jerk, 0.8)?,
        })
    }

    fn trips(&self) -> Result<usize, RideProblem> {
        match whole(&self.trips, 2) {
            trips @ 1..=MOST_TRIPS => Ok(trips),
            trips => Err(RideProblem::Trips(trips)),
        }
    }

    fn rest(&self) -> Result<[f64; 2], RideProblem> {
        let given = self.rest.as_ref().map(|rest| *rest.get_ref());
        let [shortest, longest] = given.map_or([10.0, 20.0], |rest| rest.map(|length| length.0));
        match 0.0 < shortest && shortest <= longest {
            true => Ok([shortest, longest]),
            false => Err(RideProblem::Rests(shortest, longest)),
        }
    }

    fn sigma(&self, drive: &Drive, rate: f64) -> Result<f64, RideProblem> {
        let given = |key: &Option<Spanned<Number>>| key.as_ref().map(|key| key.get_ref().0);
        match (
            given(&self.sigma),
            given(&self.density),
            given(&self.delta_over_sigma),
        ) {
            (None, None, None) => Ok(SIGMA),
            (Some(sigma), None, None) => Ok(sigma),
            (None, Some(_), None) => {
                let density = positive("density", &self.density, 0.0)?;
                Ok(density * libm::sqrt(rate / 2.0))
            }
            (None, None, Some(_)) => {
                let ratio = positive("delta_over_sigma", &self.delta_over_sigma, 0.0)?;
                Ok(drive.acceleration / ratio)
            }
            _ => Err(RideProblem::Strength),
        }
    }

    fn pickup(&self, drive: &Drive, rate: f64) -> Result<Pickup, RideProblem> {
        let ar = self.ar.as_ref().map(|ar| ar.get_ref().as_slice());
        let ar = ar.unwrap_or_default().iter().map(|phi| phi.0).collect();
        let quantum = self.quantum.as_ref().map(|quantum| quantum.get_ref().0);
        let (nu, theta) = (number(&self.nu, 0.0), number(&self.theta, 2.0));
        let (footfalls, jolt) = (number(&self.footfalls, 0.0), number(&self.jolt, 10.0));
        Ok(Pickup {
            sensor: Sensor::from_ar(ar)?,
            digitiser: Digitiser::new(quantum, None)?,
            vibration: number(&self.vibration, 0.0),
            impulses: Impulses::new(nu, theta, During::Motion)?,
            disturbance: Disturbance::new(0.0, 1.0, footfalls, jolt)?,
            ..Pickup::white(self.sigma(drive, rate)?)
        }
        .checked()?)
    }

    fn settings(&self) -> Settings {
        let usual = Settings::default();
        Settings {
            block: number(&self.block, usual.block),
            reference: whole(&self.reference, usual.reference),
            shift: whole(&self.shift, usual.shift),
            scale: whole(&self.scale, usual.scale),
            gap: whole(&self.gap, usual.gap),
            alpha: number(&self.alpha, usual.alpha),
            training: whole(&self.training, usual.training),
            order: (self.order.as_ref()).map_or(usual.order, |order| *order.get_ref()),
            least_speed: number(&self.least_speed, usual.least_speed),
            least_acceleration: number(&self.least_acceleration, usual.least_acceleration),
            most_acceleration: number(&self.most_acceleration, usual.most_acceleration),
            ..usual
        }
    }
}

fn number(given: &Option<Spanned<Number>>, default: f64) -> f64 {
    given.as_ref().map_or(default, |value| value.get_ref().0)
}

fn positive(
    key: &'static str,
    given: &Option<Spanned<Number>>,
    default: f64,
) -> Result<f64, RideProblem> {
    match number(given, default) {
        value if value > 0.0 => Ok(value),
        value => Err(RideProblem::NotPositive { key, value }),
    }
}

fn whole(given: &Option<Spanned<Whole>>, default: usize) -> usize {
    given
        .as_ref()
        .map_or(default, |value| value.get_ref().size())
}

fn flag(given: &Option<Spanned<bool>>, default: bool) -> bool {
    given.as_ref().map_or(default, |value| *value.get_ref())
}
