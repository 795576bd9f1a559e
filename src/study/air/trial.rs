//! One lift, whose trips a barometer measures in every air.

use super::table::Point;
use crate::counts::{Shape, Sums};
use crate::rng::Stream;
use crate::signal::white_noise;
use crate::study::height::Watched;
use crate::study::trips::tracked;
use crate::track::{Climb, Climbs, Tracked, Unseen};
use libm::fabs;

/// How a height follows from two pressures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// By the standard atmosphere.
    Printed,
    /// By air of 20 °C.
    Usual,
    /// By air of the temperature that the trips give.
    Learnt,
    /// By air of the right temperature.
    Given,
}

impl Way {
    pub const ALL: [Self; 4] = [Self::Printed, Self::Usual, Self::Learnt, Self::Given];

    pub fn name(self) -> &'static str {
        match self {
            Self::Printed => "printed",
            Self::Usual => "usual",
            Self::Learnt => "learnt",
            Self::Given => "given",
        }
    }
}

/// For each way, the sums and the sums of squares of the scale, of the mean size of the error, of its mean square, and of the
/// share of trips within 1.96 deviations. Last those of the squared error of the learnt temperature.
pub(super) const PAIRS: usize = 4;

pub(super) fn shape() -> Shape {
    Shape {
        lengths: 2 * (PAIRS * Way::ALL.len() + 1),
        ..Shape::default()
    }
}

/// Of 95 %, in deviations.
const WITHIN: f64 = 1.96;

/// The deviation of the accelerometer's gain.
const GAIN: f64 = 0.01;

/// The deviation of a reading of a BMP180, Pa.
const NOISE: f64 = 3.0;

/// Air that is usual indoors, °C.
const USUAL: f64 = 20.0;

/// Beside a trip the car stands, s.
const BESIDE: f64 = 1.0;

/// The sums of these points, whose lifts are the same.
pub(super) fn run(trips: usize, points: &[&Point], seed: u64, trial: u64) -> Vec<Sums> {
    let watched = Watched::new(trips, seed, trial);
    let mut draws = Stream::new(seed, "air", "").at(trial);
    let gain = 1.0 + GAIN * white_noise(1, &mut draws)[0];
    let mut track = tracked(&watched.samples, watched.numbers.rate);
    for trip in &mut track.trips {
        trip.distance = trip.distance.map(|it| gain * it);
    }
    let unseen = Unseen::default();
    let truth: Vec<Option<f64>> = track.trips.iter().map(|it| went(it, &watched)).collect();
    let each = points.iter().map(|point| {
        let pascal = 100.0 * point.pressure;
        let barometer = watched.pressures(point.temperature, pascal, NOISE, 0.0);
        let climbs = |celsius| Climbs::of(&track.trips, &unseen, &barometer, 0.0, celsius);
        let learnt = climbs(None);
        let off = learnt.air.celsius - point.temperature;
        let mut sums = shape().empty().sums;
        sums.note(PAIRS * Way::ALL.len(), off * off);
        for (place, way) in Way::ALL.into_iter().enumerate() {
            let found = match way {
                Way::Learnt | Way::Printed => learnt.clone(),
                Way::Usual => climbs(Some(USUAL)),
                Way::Given => climbs(Some(point.temperature)),
            };
            let pairs = found.climbs.iter().zip(&truth);
            let pairs = pairs.filter_map(|(climb, truth)| Some(((*climb)?, (*truth)?)));
            add(&mut sums, place, way, &pairs.collect::<Vec<_>>());
        }
        sums
    });
    each.collect()
}

fn add(sums: &mut Sums, place: usize, way: Way, trips: &[(Climb, f64)]) {
    let height = |climb: &Climb| match way {
        Way::Printed => climb.height_printed,
        _ => climb.height,
    };
    let mean = |of: &dyn Fn(&(Climb, f64)) -> f64| {
        trips.iter().map(of).sum::<f64>() / trips.len().max(1) as f64
    };
    let error = |it: &(Climb, f64)| fabs(height(&it.0) - it.1);
    let scale = mean(&|it| height(&it.0) * it.1) / mean(&|it| it.1 * it.1).max(1e-9);
    let square = mean(&|it| error(it) * error(it));
    let within = mean(&|it| f64::from(u8::from(error(it) <= WITHIN * it.0.height_deviation)));
    let values = [scale, mean(&error), square, within];
    for (at, value) in values.into_iter().enumerate() {
        sums.note(PAIRS * place + at, value);
    }
}

/// How high a trip that was found went.
fn went(trip: &Tracked, watched: &Watched) -> Option<f64> {
    let at = |time: f64| {
        let place = (time * watched.numbers.rate).max(0.0) as usize;
        watched.truth[place.min(watched.truth.len() - 1)]
    };
    let (start, stop) = trip.trip.start.zip(trip.trip.stop)?;
    Some(at(stop + BESIDE) - at(start - BESIDE))
}
