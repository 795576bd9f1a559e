//! What one trial gives at one point, and the decision on it.

use super::trial::Keys;
use crate::detect::{
    Alternative, Baseline, Clairvoyant, Forward, Method, Pooled, Region, Samples, Statistics, Ties,
    block_means, student_t, variance_ratio,
};
use crate::scenario::Scenario;
use crate::signal::During;
use crate::whiten::{step, whiten};
use std::sync::Arc;

/// One trial of one point: whitened samples, and the record where it was asked for.
pub struct Observation<'a, 'k> {
    /// X, Y₁ and Y₂, whitened; empty where all points need is W and T, and these are known.
    pub pooled: Pooled<'a>,
    /// Where they lie.
    pub samples: &'a Samples,
    /// The observed record, up to the last of X; empty unless a method here needs it.
    pub rest: &'a [f64],
    /// The same from there on, with the motion in it; likewise.
    pub motion: &'a [f64],
    pub(super) keys: &'a mut Keys<'k>,
    pub(super) statistics: Option<Statistics>,
    pub(super) scratch: &'a mut Scratch,
}

/// The space that statistics of the record work in.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    innovations: Vec<f64>,
    forward: Forward,
}

/// Who looks at a trial.
pub trait View {
    /// The point at `place` is shown what it sees.
    fn look(&mut self, place: usize, observation: &mut Observation);

    /// Points along Δ are shown what they see, all of whom look at W and T alone: each place comes after
    /// the number of its `statistics`.
    fn look_along(
        &mut self,
        points: &[[u32; 2]],
        statistics: &[Statistics],
        observation: &mut Observation,
    ) {
        for &[number, place] in points {
            observation.statistics = Some(statistics[number as usize]);
            self.look(place as usize, observation);
        }
    }
}

impl<F: FnMut(usize, &mut Observation)> View for F {
    fn look(&mut self, place: usize, observation: &mut Observation) {
        self(place, observation);
    }
}

impl<'a, 'k> Observation<'a, 'k> {
    /// Nothing seen yet.
    pub(super) fn new(
        samples: &'a Samples,
        keys: &'a mut Keys<'k>,
        scratch: &'a mut Scratch,
    ) -> Self {
        Self {
            pooled: Pooled::none(),
            samples,
            rest: &[],
            motion: &[],
            keys,
            statistics: None,
            scratch,
        }
    }

    /// W and T.
    #[inline(always)]
    pub fn statistics(&mut self, ties: Ties) -> Statistics {
        match ties {
            Ties::Random => {
                let (pooled, keys) = (&self.pooled, &mut *self.keys);
                *self
                    .statistics
                    .get_or_insert_with(|| pooled.statistics(|| keys.random()))
            }
            // Studies of ties ask once a stage, so that these need not be remembered.
            Ties::ByPosition => self.pooled.statistics(|| self.keys.positions()),
            Ties::Strict => self.pooled.statistics_strictly(),
        }
    }
}

/// A statistic that replaces W and T, ready for one scenario: large values speak for H₁.
#[derive(Clone, Debug, PartialEq)]
pub enum Score {
    /// Of the whitened samples.
    StudentT(Alternative),
    /// Of the whitened samples.
    VarianceRatio,
    /// Of the record.
    BlockMeans(Alternative),
    /// Of the record, whitened with the filter `ar`.
    Clairvoyant {
        /// The sensor's autoregression.
        ar: Vec<f64>,
        /// The statistic of its innovations.
        statistic: Clairvoyant,
    },
}

impl Score {
    /// That of the scenario's method, if it is one.
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

    /// Its value; negative infinity where it has none, as in a record of one value.
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
        // The sign of a NaN is the machine's own, so it must not be sorted.
        if value.is_nan() {
            f64::NEG_INFINITY
        } else {
            value
        }
    }
}

/// The clairvoyant of the scenario's stated motion.
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
    let samples = &scenario.samples;
    let first_impulse = match impulses.during() {
        During::Motion => 0,
        During::Inertial => samples.scale_range().start - samples.reference(),
    };
    let (nu, theta) = (impulses.nu(), impulses.theta());
    Some(Clairvoyant::new(shift, first_impulse, nu, theta, ar))
}

/// Whitens `motion`, which follows `rest`, with the filter `ar`.
fn innovate(ar: &[f64], rest: &[f64], motion: &[f64], innovations: &mut Vec<f64>) {
    let past = &rest[rest.len() - ar.len()..];
    innovations.clear();
    for i in 0..motion.len() {
        // The first few look back into the rest.
        let (near, far) = ar.split_at(i.min(ar.len()));
        let near = step(near, &motion[..i], motion[i]);
        innovations.push(step(far, past, near));
    }
}

/// What decides between H₀ and H₁ at a point.
#[derive(Clone, Debug, PartialEq)]
pub enum Decision {
    /// Whether (W, T) lies in ϑ.
    Region {
        /// ϑ.
        region: Arc<Region>,
        /// What becomes of equal values.
        ties: Ties,
    },
    /// Whether a score lies above a threshold.
    Threshold {
        /// The score.
        score: Arc<Score>,
        /// What it must exceed.
        threshold: f64,
    },
}

impl Decision {
    /// Whether it decides H₁.
    #[inline(always)]
    pub fn is_h1(&self, observation: &mut Observation) -> bool {
        match self {
            Self::Region { region, ties } => region.contains(observation.statistics(*ties)),
            Self::Threshold { score, threshold } => score.of(observation) > *threshold,
        }
    }

    /// Whether both are one and the same.
    pub fn is_same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Region { region, ties }, Self::Region { region: r, ties: t }) => {
                Arc::ptr_eq(region, r) && ties == t
            }
            (
                Self::Threshold { score, threshold },
                Self::Threshold {
                    score: s,
                    threshold: t,
                },
            ) => Arc::ptr_eq(score, s) && threshold == t,
            _ => false,
        }
    }

    /// P(H₁* | H₀) by the exact laws, where they say.
    pub fn size(&self) -> Option<f64> {
        match self {
            Self::Region { region, .. } => Some(region.size()),
            Self::Threshold { .. } => None,
        }
    }

    /// The smallest level that its rule can reach, where the exact laws say.
    pub fn reachable(&self) -> Option<f64> {
        match self {
            Self::Region { region, .. } => region.reachable(),
            Self::Threshold { .. } => None,
        }
    }

    /// What a score must exceed.
    pub fn threshold(&self) -> Option<f64> {
        match self {
            Self::Region { .. } => None,
            Self::Threshold { threshold, .. } => Some(*threshold),
        }
    }
}
