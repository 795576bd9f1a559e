//! Noise: white of some law, coloured, in steps. Before it is rounded to steps its deviation is 1.

use crate::rng::{Generator, Stream};
use crate::rule::{OutOfRange, Rule};
use crate::signal::{self, Sensor};
use libm::{round, sqrt};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The law of a record at rest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Noise {
    /// Its name.
    pub label: String,
    /// Law of the white noise that drives it.
    #[serde(default)]
    #[schemars(with = "crate::signal::Law")]
    pub law: signal::Noise,
    /// φ₁, φ₂ … of x_i = Σ φ_p x_{i−p} + ξ_i, from sample to sample; none: white.
    #[serde(default)]
    pub ar: Vec<f64>,
    /// Readings are rounded to multiples of this, in deviations; 0: not at all.
    #[serde(default)]
    pub quantum: f64,
    /// Δ/σ for this noise, instead of those of the table.
    #[serde(default)]
    pub delta: Option<Vec<f64>>,
}

impl Noise {
    /// White and normal.
    pub fn white() -> Self {
        Self {
            label: "white".to_owned(),
            law: signal::Noise::default(),
            ar: Vec::new(),
            quantum: 0.0,
            delta: None,
        }
    }

    /// # Errors
    /// If it has no variance, or is not stationary, or its step is out of range.
    pub fn check(&self) -> Result<(), OutOfRange> {
        let quantum = Rule::Within(0.0, 100.0, "");
        quantum.check("detectors.noise.quantum", &self.quantum)?;
        let refuse = |key: &str, rule: &str, got: String| Err(OutOfRange::new(key, rule, got));
        if !self.has_variance() {
            let rule = "have a variance";
            return refuse("detectors.noise.law", rule, self.law.to_string());
        }
        if !self.ar.is_empty() && !self.law.is_normal() {
            let rule = "be normal where ar is given";
            return refuse("detectors.noise.law", rule, self.law.to_string());
        }
        match Sensor::from_ar(self.ar.clone()) {
            Err(error) => refuse("detectors.noise.ar", "be stationary", error.to_string()),
            Ok(_) => Ok(()),
        }
    }

    fn has_variance(&self) -> bool {
        match self.law.into() {
            signal::Law::Cauchy => false,
            signal::Law::StudentT(freedom) => freedom > 2.0,
            _ => true,
        }
    }

    /// Everything but its name and Δ.
    pub fn subject(&self) -> String {
        format!("{} ar {:?} quantum {}", self.law, self.ar, self.quantum)
    }

    pub fn is_white(&self) -> bool {
        self.ar.is_empty()
    }

    /// What draws it in one trial.
    pub fn draws(&self, purpose: &str, seed: u64, trial: u64) -> Generator {
        Stream::new(seed, purpose, &self.subject()).at(trial)
    }

    /// What drives it, in its deviations.
    pub fn deviation(&self) -> f64 {
        1.0 / sqrt(self.energy())
    }

    /// Σ h², of the response h to one impulse.
    fn energy(&self) -> f64 {
        let sensor = self.sensor();
        let mut response = vec![0.0; LONGEST];
        response[0] = 1.0;
        sensor.colour(&mut response);
        response.iter().map(|h| h * h).sum()
    }

    fn sensor(&self) -> Sensor {
        Sensor::from_ar(self.ar.clone()).expect("it was checked")
    }

    /// So many samples, not yet rounded.
    pub fn record(&self, samples: usize, draws: &mut Generator) -> Vec<f64> {
        let mut record = vec![0.0; samples];
        self.law.fill(draws, &mut record);
        if !self.is_white() {
            self.sensor().colour_stationary(&mut record);
            let deviation = self.deviation();
            record.iter_mut().for_each(|x| *x *= deviation);
        }
        record
    }

    /// As it is read.
    pub fn read(&self, x: f64) -> f64 {
        if self.quantum > 0.0 {
            round(x / self.quantum) * self.quantum
        } else {
            x
        }
    }
}

/// Of a response: at φ = 0.999 it misses 2 % of the energy, at 0.99 nothing.
const LONGEST: usize = 2000;
