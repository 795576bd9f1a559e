//! A realisation of a ride.
//!
//! Each kind of draw has its own stream, so that rides that differ only in strength share their draws: the
//! same noise serves every Δ/σ.

use super::pulse::add_speed;
use super::{Course, Journey, Pickup, Ride, Stretch};
use crate::rng::{Generator, Stream};
use crate::signal::{During, ImpulseMemory, Phase, white_noise};
use libm::sqrt;
use rand::Rng;
use std::ops::Range;

/// A simulated record and its truth.
#[derive(Clone, Debug, PartialEq)]
pub struct Simulated {
    /// Hz: sample i belongs to the time i/rate.
    pub rate: f64,
    /// m/s².
    pub record: Vec<f64>,
    /// The phases of the cage in order.
    pub truth: Vec<Stretch>,
    /// The trips.
    pub journeys: Vec<Journey>,
}

impl Ride {
    /// Realisation number `index` of the draws of `seed`.
    pub fn simulate(&self, pickup: &Pickup, seed: u64, index: u64) -> Simulated {
        let mut record = vec![0.0; self.samples()];
        let generator = |purpose: &str| {
            let subject = format!("{} {}", pickup.sensor, pickup.noise);
            Stream::new(seed, purpose, &subject).at(index)
        };
        add_noise(pickup, &mut generator("ride noise"), &mut record);
        let mut footfalls = generator("ride footfalls");
        let disturbance = &pickup.disturbance;
        disturbance.act(&mut record, 0, || footfalls.next_u64());
        self.vibrate(pickup, &mut generator("ride vibration"), &mut record);
        self.knock(pickup, &mut generator("ride impulses"), &mut record);
        self.accelerate(pickup, &mut record);
        wander(pickup, self.rate, &mut generator("ride bias"), &mut record);
        write_down(pickup, &mut record);
        Simulated {
            rate: self.rate,
            record,
            truth: self.truth(),
            journeys: self.journeys(),
        }
    }

    /// The times of the samples on the record's clock, s: they vary with a deviation of `jitter`, cut off so that they
    /// increase. A record says when its samples were stored, not when they were taken.
    pub fn clock(&self, jitter: f64, seed: u64) -> Vec<f64> {
        let mut generator = Stream::new(seed, "ride clock", "").at(0);
        let late = if jitter > 0.0 {
            white_noise(self.samples(), &mut generator)
        } else {
            vec![0.0; self.samples()]
        };
        let most = 0.4 / self.rate;
        let times = late.iter().enumerate();
        times
            .map(|(i, late)| (i as f64 + 0.5) / self.rate + (jitter * late).clamp(-most, most))
            .collect()
    }

    fn vibrate(&self, pickup: &Pickup, generator: &mut Generator, record: &mut [f64]) {
        if pickup.vibration == 0.0 {
            return;
        }
        for ((start, course), trip) in self.started().zip(&self.trips) {
            let range = self.in_motion(start, course, record.len());
            let draws = white_noise(range.len(), generator);
            let strength = pickup.vibration / trip.drive.speed;
            for (i, draw) in range.zip(draws) {
                let speed = course.speed_at(i as f64 / self.rate - start).abs();
                record[i] += strength * speed * draw;
            }
        }
    }

    fn knock(&self, pickup: &Pickup, generator: &mut Generator, record: &mut [f64]) {
        let impulses = &pickup.impulses;
        if impulses.are_absent() {
            return;
        }
        for (start, course) in self.started() {
            let mut memory = ImpulseMemory::default();
            for i in self.in_motion(start, course, record.len()) {
                let draw = generator.next_u64();
                let phase = course.phase_at(i as f64 / self.rate - start);
                if impulses.during == During::Motion || phase == Phase::Inertial {
                    record[i] += impulses.theta.get() * memory.step(impulses.nu.get(), draw);
                }
            }
        }
    }

    /// The samples whose times lie in a trip.
    fn in_motion(&self, start: f64, course: &Course, samples: usize) -> Range<usize> {
        let first = |time: f64| ((time * self.rate).ceil() as usize).min(samples);
        first(start)..first(start + course.duration())
    }

    /// The mean acceleration of the cage around each sample, m/s².
    pub(crate) fn acceleration(&self) -> Vec<f64> {
        let mut acceleration = vec![0.0; self.samples()];
        self.travel(self.rate, &mut acceleration);
        acceleration
    }

    /// Adds the acceleration of the trips, `scale` to a change of 1 m/s in a sample.
    fn travel(&self, scale: f64, record: &mut [f64]) {
        for (start, course) in self.started() {
            let span = (start, start + course.duration());
            let speed_at = |time| course.speed_at(time - start);
            add_speed(record, self.rate, scale, span, speed_at);
        }
    }

    fn accelerate(&self, pickup: &Pickup, record: &mut [f64]) {
        let scale = self.rate * pickup.cosine / pickup.sigma;
        self.travel(scale, record);
        let across = self.rate * pickup.across / pickup.sigma;
        for (pulses, scale) in self.shocks.iter().zip([scale, across]) {
            for pulse in pulses {
                pulse.add_to(record, self.rate, scale);
            }
        }
    }
}

/// The random walk of the bias.
fn wander(pickup: &Pickup, rate: f64, generator: &mut Generator, record: &mut [f64]) {
    if pickup.walk == 0.0 {
        return;
    }
    let steps = white_noise(record.len(), generator);
    let scale = pickup.walk / sqrt(rate) / pickup.sigma;
    let mut bias = 0.0;
    for (r, step) in record.iter_mut().zip(steps) {
        bias += scale * step;
        *r += bias;
    }
}

/// x, stationary from the first sample.
fn add_noise(pickup: &Pickup, generator: &mut Generator, record: &mut Vec<f64>) {
    if pickup.noise.is_normal() {
        pickup.noise.fill(generator, record);
        return pickup.sensor.colour_stationary(record);
    }
    let burn_in = pickup.sensor.burn_in();
    record.resize(record.len() + burn_in, 0.0);
    pickup.noise.fill(generator, record);
    pickup.sensor.colour(record);
    record.drain(..burn_in);
}

/// Digitises the record and converts it from σ to m/s².
fn write_down(pickup: &Pickup, record: &mut [f64]) {
    let (digitiser, bias) = (&pickup.digitiser, pickup.bias / pickup.sigma);
    let unit = digitiser.unit() * pickup.sigma;
    for r in record {
        *r = digitiser.code(*r + bias) * unit;
    }
}
