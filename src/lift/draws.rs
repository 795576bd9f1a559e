//! The random numbers behind a plan.

use crate::rng::{self, Generator};
use libm::{log, pow};

pub(super) struct Draws(pub Generator);

impl Draws {
    /// Uniform in [0, 1).
    fn unit(&mut self) -> f64 {
        rng::unit(&mut self.0)
    }

    /// Uniform.
    pub fn within(&mut self, [least, most]: [f64; 2]) -> f64 {
        least + (most - least) * self.unit()
    }

    /// Its logarithm is uniform.
    pub fn decades(&mut self, [least, most]: [f64; 2]) -> f64 {
        least * pow(most / least, self.unit())
    }

    /// Any of these with equal probability.
    pub fn whole(&mut self, [least, most]: [usize; 2]) -> usize {
        let choices = (most - least + 1) as f64;
        (least + (self.unit() * choices) as usize).min(most)
    }

    pub fn holds(&mut self, probability: f64) -> bool {
        self.unit() < probability
    }

    /// 1 or −1.
    pub fn sign(&mut self) -> f64 {
        if self.holds(0.5) { 1.0 } else { -1.0 }
    }

    /// The time to the next event of a Poisson process.
    pub fn gap(&mut self, events_per_second: f64) -> f64 {
        -log(1.0 - self.unit()) / events_per_second
    }
}
