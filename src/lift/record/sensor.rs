//! What a sensor makes of it.

use super::cage::Cage;
use super::class::{Class, Ranges};
use crate::lift::draws::Draws;
use crate::recording::GRAVITY;
use crate::rng::Generator;
use crate::signal::{Noise, Sensor, white_noise};
use libm::{exp, sqrt};

/// A sensor in a cage, and what is wrong with it.
pub(super) struct Mounted {
    pub rate: f64,
    /// Deviation of a sample in the band of motion, m/s².
    sigma: f64,
    /// Of the noise: x_i = φ x_(i−1) + (1 − φ) σ ξ_i, so that its density near 0 Hz is that of σ.
    phi: f64,
    /// Deviation at the lift's speed, σ.
    vibration: f64,
    /// Deviation at rest, σ.
    people: f64,
    bias: f64,
    quantum: f64,
    /// How fast the level rises, m/s², by the start of each 15 s; empty for none.
    pub slopes: Vec<f64>,
    /// By how much its level settles, m/s², and with which time constant, s.
    warm_up: (f64, f64),
    /// Time constant of its high pass, s.
    pub tau: Option<f64>,
    /// It repeats its value from then on, s.
    pub frozen: f64,
    /// Stretches that are missing, s.
    pub holes: Vec<(f64, f64)>,
    /// Where the record begins and ends, s.
    pub window: (f64, f64),
}

/// How long a slope of the level lasts, s.
const STRETCH: f64 = 15.0;

impl Mounted {
    pub fn draw(class: Class, ranges: &Ranges, cage: &Cage, draws: &mut Draws) -> Self {
        let rate = draws.decades(ranges.rate);
        let density = 1e-6 * GRAVITY * draws.decades(ranges.density);
        let until = cage.until();
        let mut sensor = Self {
            rate,
            sigma: density * sqrt(rate / 2.0),
            phi: if draws.holds(0.3) {
                draws.within([-0.5, 0.7])
            } else {
                0.0
            },
            vibration: draws.within(ranges.vibration),
            people: draws.within(ranges.people),
            bias: if draws.holds(0.5) { GRAVITY } else { 0.0 } + draws.within([-0.3, 0.3]),
            quantum: draws.decades(ranges.quantum),
            slopes: Vec::new(),
            warm_up: (0.0, 1.0),
            tau: None,
            frozen: f64::INFINITY,
            holes: Vec::new(),
            window: (0.0, until),
        };
        match class {
            Class::Drift => sensor.slopes = slopes(until, draws),
            Class::WarmUp => {
                let settles = draws.sign() * draws.within([0.05, 0.25]);
                sensor.warm_up = (settles, draws.within([5.0, 40.0]));
            }
            Class::HighPass => sensor.tau = Some(draws.decades([0.5, 16.0])),
            Class::Frozen => sensor.frozen = draws.within([6.0, until]),
            Class::Holes => sensor.holes = holes(3, [0.3, 5.0], [0.0, until], draws),
            Class::Gaps => sensor.holes = holes(2, [0.5, 20.0], [6.0, until], draws),
            Class::Cut => sensor.window = window(cage, draws),
            _ => {}
        }
        sensor
    }

    /// The samples of a cage.
    pub fn read(&self, cage: &Cage, generator: &mut Generator) -> Vec<f64> {
        let mut record = vec![0.0; self.samples(cage)];
        self.add_noise(&mut record, generator);
        self.add_vibration(cage, &mut record, generator);
        for pulse in cage.motion.iter().chain(&cage.disturbances) {
            pulse.add_to(&mut record, self.rate, self.rate);
        }
        self.drift(&mut record);
        match self.tau {
            Some(tau) => high_pass(&mut record, self.rate * tau),
            None => record.iter_mut().for_each(|a| *a += self.bias),
        }
        for a in &mut record {
            *a = (*a / self.quantum).round() * self.quantum;
        }
        let frozen = ((self.frozen * self.rate) as usize).min(record.len());
        if let Some(&last) = record[..frozen].last() {
            record[frozen..].fill(last);
        }
        record
    }

    /// Whether a sample at a time is in the record.
    pub fn has(&self, time: f64) -> bool {
        let (from, to) = self.window;
        let is_missing = |&(from, to): &(f64, f64)| from <= time && time < to;
        from <= time && time <= to && !self.holes.iter().any(is_missing)
    }

    pub fn samples(&self, cage: &Cage) -> usize {
        (cage.until() * self.rate).round() as usize
    }

    fn add_noise(&self, record: &mut [f64], generator: &mut Generator) {
        Noise::default().fill(generator, record);
        Sensor::from_ar(vec![self.phi])
            .expect("φ lies within the unit circle")
            .colour_stationary(record);
        let scale = self.sigma * (1.0 - self.phi);
        record.iter_mut().for_each(|x| *x *= scale);
    }

    /// White noise, in motion in proportion to the speed, at rest that of people.
    fn add_vibration(&self, cage: &Cage, record: &mut [f64], generator: &mut Generator) {
        let draws = white_noise(record.len(), generator);
        let full = cage.lift.drive.speed;
        for (i, (a, draw)) in record.iter_mut().zip(draws).enumerate() {
            let speed = cage.speed_at(i as f64 / self.rate).abs();
            let strength = if speed > 0.0 {
                self.vibration * speed / full
            } else {
                self.people
            };
            *a += self.sigma * strength * draw;
        }
    }

    fn drift(&self, record: &mut [f64]) {
        let mut level = 0.0;
        let (settles, tau) = self.warm_up;
        for (i, a) in record.iter_mut().enumerate() {
            let time = i as f64 / self.rate;
            let slope = self.slopes.get((time / STRETCH) as usize);
            level += slope.unwrap_or(&0.0) / self.rate;
            *a += level + settles * exp(-time / tau);
        }
    }
}

/// y = a − l, where l follows a by a first-order low pass whose time constant is `tau` samples, exactly for a
/// signal that is constant between samples.
pub(super) fn high_pass(record: &mut [f64], tau: f64) {
    let share = 1.0 - exp(-1.0 / tau);
    let mut low = 0.0;
    for a in record {
        let high = *a - low;
        low += share * high;
        *a = high;
    }
}

/// A line, or a smooth random walk: up to 0.1 m/s² a minute.
fn slopes(until: f64, draws: &mut Draws) -> Vec<f64> {
    const STEEPEST: f64 = 0.1 / 60.0;
    let stretches = (until / STRETCH) as usize + 1;
    if draws.holds(0.5) {
        return vec![draws.sign() * draws.within([0.3, 1.0]) * STEEPEST; stretches];
    }
    let slopes = (0..stretches).map(|_| STEEPEST * draws.within([-1.0, 1.0]));
    slopes.collect()
}

fn holes(most: usize, seconds: [f64; 2], within: [f64; 2], draws: &mut Draws) -> Vec<(f64, f64)> {
    let holes = (0..draws.whole([1, most])).map(|_| {
        let from = draws.within(within);
        (from, from + draws.within(seconds))
    });
    holes.collect()
}

/// From within the first trip, to within the last, or both.
fn window(cage: &Cage, draws: &mut Draws) -> (f64, f64) {
    let case = draws.whole([0, 2]);
    let mut within = |trip: Option<&crate::lift::Journey>| {
        let span = trip.map_or([0.0, 0.0], |trip| [trip.start, trip.stop]);
        draws.within(span)
    };
    let (first, last) = (within(cage.journeys.first()), within(cage.journeys.last()));
    (
        if case == 1 { 0.0 } else { first },
        if case == 0 { cage.until() } else { last },
    )
}
