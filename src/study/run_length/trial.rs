//! One record at rest.

use super::table::{Blocks, Watch};
use crate::detect::sequential::Step;
use crate::rng::{Generator, Stream, unit};
use libm::{round, sqrt};

/// Draws at a time.
const RECORD: usize = 256;

impl Watch {
    /// The false alarms of one trial, after a warm-up.
    pub fn false_alarms(&self, noise: &Blocks, seed: u64, trial: u64) -> u64 {
        let mut detector = self.chart.detector(self.threshold);
        let mut record = Record::new(noise, seed, trial);
        let (mut alarms, mut blocks) = (0, 0);
        while blocks < self.warm_up + self.blocks {
            let (x, v) = record.next();
            let step = detector.step(x, v);
            blocks += u64::from(step != Step::Reference);
            let counts = matches!(step, Step::Alarm(_)) && blocks > self.warm_up;
            alarms += u64::from(counts);
        }
        alarms
    }
}

/// Blocks at rest, each with its v.
struct Record<'a> {
    noise: &'a Blocks,
    noise_draws: Generator,
    ties: Generator,
    driving: Vec<f64>,
    used: usize,
    /// x of the colour; none before the first.
    last: Option<f64>,
}

impl<'a> Record<'a> {
    fn new(noise: &'a Blocks, seed: u64, trial: u64) -> Self {
        let draws = |purpose| Stream::new(seed, purpose, &noise.subject()).at(trial);
        Self {
            noise,
            noise_draws: draws("run_length"),
            ties: draws("run_length ties"),
            driving: vec![0.0; RECORD],
            used: RECORD,
            last: None,
        }
    }

    fn next(&mut self) -> (f64, f64) {
        let x = self.coloured();
        let step = self.noise.quantum;
        let x = if step > 0.0 {
            round(x / step) * step
        } else {
            x
        };
        (x, 1.0 - unit(&mut self.ties))
    }

    /// Stationary from its first value on, if the driving noise is normal.
    fn coloured(&mut self) -> f64 {
        let (e, colour) = (self.driving(), self.noise.colour);
        let x = match self.last {
            None => e / sqrt(1.0 - colour * colour),
            Some(last) => colour * last + e,
        };
        self.last = Some(x);
        x
    }

    fn driving(&mut self) -> f64 {
        if self.used == RECORD {
            let law = self.noise.law;
            law.fill(&mut self.noise_draws, &mut self.driving);
            self.used = 0;
        }
        self.used += 1;
        self.driving[self.used - 1]
    }
}
