//! Statistics that replace W and T.

use super::family::first_impulse;
use super::observation::{Observation, Scratch};
use crate::detect::{
    Alternative, Baseline, Clairvoyant, Method, Pooled, block_means, student_t, variance_ratio,
};
use crate::scenario::Scenario;
use crate::whiten::{step, whiten};

/// A statistic that replaces W and T, ready for one scenario: large values speak for H₁.
#[derive(Clone, Debug, PartialEq)]
pub enum Score {
    /// Student's t of the whitened samples.
    StudentT(Alternative),
    /// The variance ratio of the whitened samples.
    VarianceRatio,
    /// The standardised block mean of the record.
    BlockMeans(Alternative),
    /// The likelihood ratio of the record, whitened with the filter `ar`.
    Clairvoyant {
        /// The sensor's autoregression.
        ar: Vec<f64>,
        /// The statistic of the innovations.
        statistic: Clairvoyant,
    },
}

impl Score {
    /// The score of the scenario's method; `None` for a region.
    pub fn new(scenario: &Scenario) -> Option<Self> {
        let detector = &scenario.detector;
        match detector.method {
            Method::Baseline(Baseline::StudentT) => Some(Self::StudentT(detector.alternative)),
            Method::Baseline(Baseline::VarianceRatio) => Some(Self::VarianceRatio),
            Method::Baseline(Baseline::BlockMeans) => Some(Self::BlockMeans(detector.alternative)),
            Method::Baseline(Baseline::Clairvoyant) => Some(Self::Clairvoyant {
                ar: scenario.sensor.ar().to_vec(),
                statistic: clairvoyant(scenario)?,
            }),
            Method::Rule(_) | Method::LikelihoodRatio => None,
        }
    }

    /// The value of the score; −∞ where it is undefined, as for a constant record.
    #[inline(never)]
    pub fn of(&self, observation: &mut Observation) -> f64 {
        let Pooled {
            reference,
            shift,
            scale,
        } = observation.pooled;
        let value = match self {
            Self::StudentT(alternative) => {
                alternative.directed(student_t(shift, [reference, scale]))
            }
            Self::VarianceRatio => variance_ratio(reference, scale),
            Self::BlockMeans(alternative) => {
                let (samples, rest) = (observation.samples, observation.rest);
                let (shifted, from) = (samples.shift_range(), samples.reference());
                let shifted = &observation.motion[shifted.start - from..shifted.end - from];
                alternative.directed(block_means(rest, shifted))
            }
            Self::Clairvoyant { ar, statistic } => {
                let Scratch {
                    innovations,
                    forward,
                } = &mut *observation.scratch;
                innovate(ar, observation.rest, observation.motion, innovations);
                statistic.log_likelihood_ratio(innovations, forward)
            }
        };
        // The sign of a NaN depends on the machine, so NaNs must not be sorted.
        if value.is_nan() {
            f64::NEG_INFINITY
        } else {
            value
        }
    }
}

/// The clairvoyant statistic of the scenario's stated motion.
fn clairvoyant(scenario: &Scenario) -> Option<Clairvoyant> {
    let (motion, impulses) = scenario.detector.stated?;
    let stated = Scenario {
        motion,
        impulses,
        ..scenario.clone()
    };
    let ar = scenario.sensor.ar();
    let shape = stated.shape();
    let mut shift = vec![0.0; shape.len()];
    whiten(ar, &shape, 0, &mut shift);
    let delta = stated.record_delta();
    shift.iter_mut().for_each(|d| *d *= delta);
    let first_impulse = first_impulse(&impulses, &scenario.samples);
    let (nu, theta) = (impulses.nu.get(), impulses.theta.get());
    Some(Clairvoyant::new(shift, first_impulse, nu, theta, ar))
}

/// Whitens `motion`, which follows `rest`, with the filter `ar`.
fn innovate(ar: &[f64], rest: &[f64], motion: &[f64], innovations: &mut Vec<f64>) {
    let past = &rest[rest.len() - ar.len()..];
    innovations.clear();
    for i in 0..motion.len() {
        // The filter of the first samples reaches back into the rest.
        let (near, far) = ar.split_at(i.min(ar.len()));
        let near = step(near, &motion[..i], motion[i]);
        innovations.push(step(far, past, near));
    }
}
