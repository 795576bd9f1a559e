//! One trial of one point with the values of every stage.

use super::batch::observe;
use super::decision::Decision;
use super::family::{Family, Purpose};
use super::observation::Observation;
use super::source::RecordTooLong;
use super::trial::Trial;
use crate::detect::{Samples, Statistics, Ties};
use crate::scenario::Scenario;
use crate::simd::{LANES, Wide};
use crate::whiten::Order;

/// Every stage of a trial, in the order of computation. Raw samples run from the first of the record
/// to the last of Y₂; observations are their block means.
#[derive(Clone, Debug, PartialEq)]
pub struct Replay {
    /// ξ, the driving noise, with the burn-in in front if there is one.
    pub innovations: Vec<f64>,
    /// x with its disturbance: one value for each raw sample.
    pub noise: Vec<f64>,
    /// Δ times the shape of the acceleration: one value for each raw sample.
    pub acceleration: Vec<f64>,
    /// λ: one value for each raw sample.
    pub impulses: Vec<f64>,
    /// r as recorded, digitised and averaged over blocks: one value for each observation.
    pub record: Vec<f64>,
    /// a_1 … a_m.
    pub coefficients: Vec<f64>,
    /// y, from the first observation of X on.
    pub whitened: Vec<f64>,
    /// The rank of each whitened sample among X, Y₁ and Y₂, from 1; `None` in a gap.
    pub ranks: Vec<Option<usize>>,
    /// W and T.
    pub statistics: Statistics,
    /// Whether the trial decided H₁.
    pub is_h1: bool,
    /// The positions of X, Y₁ and Y₂ among the whitened samples.
    pub samples: Samples,
    /// Observations before X.
    pub lead: usize,
}

impl Replay {
    /// Trial `index` of `scenario`, the same as in any run with this seed.
    ///
    /// # Errors
    /// If its record does not fit in memory.
    pub fn new(
        scenario: &Scenario,
        decision: &Decision,
        seed: u64,
        common_random_numbers: bool,
        index: u64,
    ) -> Result<Self, RecordTooLong> {
        let families = Family::arrange([scenario], seed, Purpose::Results, common_random_numbers);
        let family = &families.map_err(|(_, refusal)| refusal)?[0];
        let mut trial = Trial::new(family);
        let mut decided = None;
        trial.run(index, &mut |_: usize, observation: &mut Observation| {
            let statistics = observation.statistics(scenario.detector.ties);
            decided = Some((statistics, decision.is_h1(observation)));
        });
        let (statistics, is_h1) = decided.expect("a family of one point shows one");

        let source = &family.source;
        let lane = (index % LANES as u64) as usize;
        let noise: Vec<f64> = trial.batch.raw(lane).collect();
        let after = noise.len() - trial.motion.pattern.len();
        let added = |values: &[f64], factor: f64| {
            let mut all = vec![0.0; after];
            all.extend(values.iter().map(|value| factor * value));
            all
        };
        let acceleration = added(&scenario.shape(), scenario.record_delta());
        let impulses = added(&trial.motion.pattern, scenario.impulses.theta.get());
        let parts = noise.iter().zip(&acceleration).zip(&impulses);
        let raw: Vec<f64> = parts
            .map(|((x, step), impulse)| x + step + impulse)
            .collect();
        let mut record = vec![0.0; source.observations()];
        observe(
            &scenario.digitiser,
            source.samples.decimation(),
            &raw,
            &mut record,
        );

        let (coefficients, rest) = trial.batch.rest(0, lane);
        let mut whitened = rest[..source.samples.reference()].to_vec();
        whitened.extend_from_slice(&trial.motion.whitened);
        let chosen = match scenario.whitening.order {
            Order::Fixed(order) => order,
            // Coefficients beyond the chosen order are zero.
            Order::Auto => {
                (coefficients.iter().rposition(|a| *a != 0.0)).map_or(0, |last| last + 1)
            }
        };
        let coefficients = coefficients[..chosen].to_vec();
        let keys = match scenario.detector.ties {
            Ties::Random => trial.keys.random(),
            Ties::ByPosition | Ties::Strict => trial.keys.positions(),
        };
        Ok(Self {
            innovations: innovations(family, index),
            ranks: ranks(&whitened, &source.samples, keys),
            noise,
            acceleration,
            impulses,
            record,
            coefficients,
            whitened,
            statistics,
            is_h1,
            samples: source.samples,
            lead: source.lead,
        })
    }
}

/// The draws that the noise of a trial starts from.
fn innovations(family: &Family, index: u64) -> Vec<f64> {
    let source = &family.source;
    let (batch, lane) = (index / LANES as u64, (index % LANES as u64) as usize);
    let mut all = vec![Wide::<LANES>::default(); source.burn_in() + source.raw_length()];
    source.noise.fill(&mut family.noise.at(batch), &mut all);
    all.iter().map(|wide| wide.0[lane]).collect()
}

/// Ranks among X, Y₁ and Y₂ by the order of (value, key); keys are in the order X, Y₁, Y₂.
fn ranks(whitened: &[f64], samples: &Samples, keys: &[u64]) -> Vec<Option<usize>> {
    let places = samples.reference_range();
    let places = places
        .chain(samples.shift_range())
        .chain(samples.scale_range());
    let mut order: Vec<(usize, u64)> = places.zip(keys.iter().copied()).collect();
    order.sort_by(|a, b| whitened[a.0].total_cmp(&whitened[b.0]).then(a.1.cmp(&b.1)));
    let mut ranks = vec![None; whitened.len()];
    for (rank, (place, _)) in (1..).zip(order) {
        ranks[place] = Some(rank);
    }
    ranks
}
