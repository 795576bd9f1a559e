//! Trips as they happen, from the acceleration alone: the trip filter with a detector of uniform motion, and ξ_d to tell
//! which of it is standing.
//!
//! ξ_d = s²/(P_ss + R_0 + (ε s_max)²) below γ_d is a stop, with s_max the trip's highest speed. A motion that is uniform
//! but slow for longer than a levelling lasts is taken for a stop too, and so is one that lasts too long: the trip is then
//! not closed. Without these a speed that drifts past the gate would be uniform motion for ever.

use super::filter::{TripFilter, Uncertain, Update};
use super::settings::TrackSettings;
use super::steps::{HOLE, Step, Steps};
use super::travelled::Travelled;
use super::uniform::UniformDetector;
use crate::recording::Sample;

/// A trip that has ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LiveTrip {
    /// s.
    pub start: f64,
    /// s.
    pub stop: f64,
    /// How far it went.
    pub travelled: Travelled,
    /// Whether its speed came back to zero; else it was taken for a stop for want of patience, or at a gap.
    pub is_closed: bool,
}

/// What the cage does, as far as the filter can tell.
#[derive(Clone, Copy, Debug)]
enum Cage {
    Stands,
    Moves {
        start: f64,
        highest: f64,
        /// Since when uniformly.
        uniform: Option<f64>,
    },
    /// It stands, and its trip is not yet told.
    Arrived(LiveTrip),
}

/// A cage that is followed sample by sample; it stands at first.
#[derive(Clone, Debug)]
pub struct LiveTrips {
    settings: TrackSettings,
    steps: Steps,
    detector: UniformDetector,
    filter: TripFilter,
    cage: Cage,
}

impl LiveTrips {
    /// Follows a cage whose sensor has about this bias, m/s².
    pub fn new(settings: TrackSettings, bias: f64) -> Self {
        let bias = Uncertain {
            mean: bias,
            variance: settings.bias_error.powi(2),
        };
        Self {
            steps: Steps::default(),
            detector: UniformDetector::new(settings.uniform),
            filter: TripFilter::new(settings.noise, bias),
            cage: Cage::Stands,
            settings,
        }
    }

    /// How much later than its samples the filter is, s, and the sample after these.
    pub fn delay(&self) -> f64 {
        UniformDetector::delay(&self.settings.uniform)
    }

    /// The filter's estimate, `delay` ago.
    pub fn filter(&self) -> &TripFilter {
        &self.filter
    }

    /// Takes a sample; a trip is told a second after its stop, or when the next begins.
    #[inline]
    pub fn step(&mut self, sample: Sample) -> Option<LiveTrip> {
        let step = self.steps.step(sample)?;
        if step.seconds > HOLE {
            return self.lose(step.time);
        }
        let bias = self.filter.bias();
        let uniform = &self.settings.uniform;
        let of_mean = self.settings.noise.density(step.seconds) / uniform.window;
        let deviation = (of_mean + bias.variance).sqrt();
        let limit = uniform.least.max(uniform.deviations * deviation);
        self.detector.push(step, bias.mean, limit);
        let mut told = None;
        while let Some((step, is_uniform)) = self.detector.judged() {
            told = self.advance(step, is_uniform).or(told);
        }
        told
    }

    /// The record ends: tells the trip that is not told yet.
    pub fn end(mut self) -> Option<LiveTrip> {
        let last = self.steps.end();
        let unused = UniformDetector::new(self.settings.uniform);
        let detector = std::mem::replace(&mut self.detector, unused);
        let mut time = 0.0;
        for step in detector.left().chain(last) {
            self.filter.predict(step.acceleration, step.seconds);
            time = step.time;
        }
        self.lose(time)
    }

    fn advance(&mut self, step: Step, is_uniform: bool) -> Option<LiveTrip> {
        self.filter.predict(step.acceleration, step.seconds);
        let told = match self.cage {
            Cage::Arrived(trip)
                if !is_uniform || step.time > trip.stop + self.settings.settling =>
            {
                self.tell(trip)
            }
            _ => None,
        };
        let speed = self.filter.speed().mean.abs();
        self.cage = match self.cage {
            cage if !is_uniform => cage.moving(step.time, speed),
            Cage::Moves {
                start,
                highest,
                uniform,
            } => {
                let since = uniform.unwrap_or(step.time);
                self.arrived(step, start, highest, since).map_or(
                    Cage::Moves {
                        start,
                        highest,
                        uniform: Some(since),
                    },
                    Cage::Arrived,
                )
            }
            cage => cage,
        };
        let update = match self.cage {
            _ if !is_uniform => Update::None,
            Cage::Moves { .. } => Update::Uniform,
            Cage::Stands | Cage::Arrived(_) => Update::Standing,
        };
        self.filter.update(update, step.seconds);
        if let Cage::Stands = self.cage {
            self.filter.restart();
        }
        told
    }

    /// The trip, if the cage that has moved uniformly `since` stands.
    fn arrived(&self, step: Step, start: f64, highest: f64, since: f64) -> Option<LiveTrip> {
        let uniform = &self.settings.uniform;
        let gain_error = self.settings.gain_error * highest;
        let agrees = self.filter.standing(step.seconds, gain_error * gain_error);
        let is_slow = agrees.value.abs() < uniform.slow * highest;
        let patience = if is_slow {
            uniform.patience
        } else {
            uniform.longest
        };
        let is_closed = agrees.nis() <= self.settings.gate;
        let stands = is_closed || step.time - since > patience;
        let closing = self.filter.standing(step.seconds, 0.0);
        stands.then(|| LiveTrip {
            start,
            stop: since,
            travelled: Travelled::closing(closing, since - start, &self.settings),
            is_closed,
        })
    }

    /// A trip that the filter has settled on, if it is one.
    fn tell(&mut self, trip: LiveTrip) -> Option<LiveTrip> {
        let distance = self.filter.distance();
        self.filter.restart();
        self.cage = Cage::Stands;
        (distance.mean.abs() > self.settings.least_distance).then(|| LiveTrip {
            travelled: trip.travelled.plus(distance),
            ..trip
        })
    }

    /// Nothing is known from here on, but for the bias.
    fn lose(&mut self, time: f64) -> Option<LiveTrip> {
        let told = match self.cage {
            Cage::Stands => None,
            Cage::Arrived(trip) => self.tell(trip),
            Cage::Moves { start, .. } => self.tell(LiveTrip {
                start,
                stop: time,
                travelled: Travelled::default(),
                is_closed: false,
            }),
        };
        self.detector = UniformDetector::new(self.settings.uniform);
        self.filter = TripFilter::new(self.settings.noise, self.filter.bias());
        self.cage = Cage::Stands;
        told
    }
}

impl Cage {
    fn moving(self, time: f64, speed: f64) -> Self {
        let (start, highest) = match self {
            Self::Moves { start, highest, .. } => (start, highest.max(speed)),
            Self::Stands | Self::Arrived(_) => (time, speed),
        };
        Self::Moves {
            start,
            highest,
            uniform: None,
        }
    }
}
