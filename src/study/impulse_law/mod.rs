//! The laws of one impulse λ_i and of the sum S_i, eqs (5) and (6) of [^1], against simulation.
//!
//! (5) says P(λ_i = ±θ) = ν/2 and P(λ_i = 0) = 1 − ν, which is exact at every i. (6) says
//! P(S_i = 0) = ½, which is a limit: S returns to zero or leaves it with every impulse, so P(S_i = 0)
//! is the probability of an even number of impulses, (1 + (1 − 2ν)^i)/2.
//!
//! All ν use the same draws, one per sample.
//!
//! [^1]: see [`crate::signal`].

pub(super) mod picture;
mod row;

pub use row::Row;

use crate::config::Conflict;
use crate::counts::{Counter, Counts, Shape, Sums};
use crate::experiment::Experiment;
use crate::figure::FigureError;
use crate::plot::Plot;
use crate::results::{Comparison, Quantity, eight_digits};
use crate::rng::Stream;
use crate::rule::OutOfRange;
use crate::run::{Group, Identity, StudyError, Target, Trials};
use crate::signal::ImpulseMemory;
use crate::stats::tally::Tally;
use crate::study::kind::{Context, Counters, Study, counted};
use crate::study::rules::{distinct, each, within};
use rand::Rng;
use rayon::prelude::*;
use schemars::{JsonSchema, SchemaGenerator};
use serde::Deserialize;
use serde_json::Value;
use std::ops::Range;

/// The laws of an impulse and of the sum of impulses, against simulation.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Keys {
    /// ν, strictly between 0 and 1.
    nu: Vec<f64>,
    /// Samples of one realisation.
    #[serde(default = "two_hundred")]
    length: usize,
}

fn two_hundred() -> usize {
    200
}

/// A reader cannot distinguish more curves than this.
const MOST_CURVES: usize = 36;
const LONGEST: usize = 10_000;

impl Keys {
    fn check(&self) -> Result<(), Conflict> {
        const NU: &str = "impulse_law.nu";
        let words = ["probability", "probabilities"];
        distinct(NU, words, MOST_CURVES, &self.nu, f64::to_string)?;
        each(NU, &self.nu, "lie strictly between 0 and 1", |nu| {
            *nu > 0.0 && *nu < 1.0
        })?;
        within("impulse_law.length", self.length, 1..=LONGEST)
    }
}

/// The study: every ν at samples 1 … `length`.
pub(super) struct ImpulseLaw {
    context: Context,
    nu: Vec<f64>,
    length: usize,
    counters: Counters,
}

impl ImpulseLaw {
    pub fn new(context: Context, nu: Vec<f64>, length: usize) -> Self {
        let mut study = Self {
            context,
            nu,
            length,
            counters: Counters::default(),
        };
        study.counters = Counters::new(&study, context.seed, &study.shape());
        study
    }

    /// Three counts per sample: how often S was zero, λ was positive and λ was zero.
    fn shape(&self) -> Shape {
        Shape::events(3 * self.length)
    }
}

impl Study for ImpulseLaw {
    const NAME: &'static str = "impulse_law";
    const USES: &'static [&'static str] = &[];
    const COUNTS_TRIALS: bool = true;
    type Row = Row;

    fn read(experiment: &Experiment, context: Context) -> Result<Self, StudyError> {
        let keys: Keys = experiment.read()?;
        (keys.check()).map_err(|conflict| experiment.conflict(conflict))?;
        Ok(Self::new(context, keys.nu, keys.length))
    }

    fn schema(generator: &mut SchemaGenerator) -> Value {
        Keys::json_schema(generator).to_value()
    }

    fn identities(&self) -> Vec<Identity> {
        let length = self.length.to_string();
        let identity =
            |nu: &f64| Identity::new([("nu", nu.to_string()), ("length", length.clone())]);
        self.nu.iter().map(identity).collect()
    }

    fn trials(&self) -> Option<Box<dyn Trials + '_>> {
        Some(Box::new(self))
    }

    fn rows(&self, counts: &Counts) -> Vec<Row> {
        let each = self.nu.par_iter().zip(&self.counters.keys);
        each.flat_map_iter(|(&nu, key)| {
            let (trials, sums) = counted(counts, key, &self.shape());
            let confidence = self.context.confidence;
            (1..=self.length).map(move |sample| {
                row(
                    nu,
                    sample,
                    trials,
                    &sums.counts[3 * sample - 3..],
                    confidence,
                )
            })
        })
        .collect()
    }

    fn quantities(&self, rows: &[Row]) -> Result<Vec<Quantity>, StudyError> {
        Ok(quantities(rows, self.context.confidence))
    }

    fn recall(&self, rows: &[Row], _comparisons: &[Comparison]) -> Option<Counts> {
        let mut counts = Counts::default();
        if rows.len() != self.nu.len() * self.length {
            return None;
        }
        for (&point, target) in self.counters.points.iter().zip(&self.counters.targets) {
            let rows = &rows[point * self.length..(point + 1) * self.length];
            let events = |row: &Row| [row.zero_sum_count, row.positive_count, row.none_count];
            let sums: Vec<u64> = rows.iter().flat_map(events).collect();
            let added = counts.add(&target.key, 0..rows[0].trials, &Sums::of(&sums));
            added.expect("a key is added once");
        }
        Some(counts)
    }

    fn plot(&self, rows: &[Row], seed: u64) -> Result<Plot, FigureError> {
        Ok(picture::plot(rows, self.context.confidence, seed))
    }
}

impl Trials for &ImpulseLaw {
    fn targets(&self) -> &[Target] {
        &self.counters.targets
    }

    /// λ is positive, negative or zero, so positive and zero together occur at most once per trial.
    fn check(&self, counts: &Counts) -> Result<(), StudyError> {
        for key in &self.counters.keys {
            let Some(Counter { trials, sums }) = counts.get(key) else {
                continue;
            };
            let events = sums.counts.chunks_exact(3);
            let mut impulses = events.map(|event| event[1].saturating_add(event[2]));
            if let Some(got) = impulses.find(|impulses| *impulses > trials.len()) {
                let rule = format!("be at most {}", trials.len());
                let what = format!("counter {key}: positive and absent impulses");
                return Err(OutOfRange::new(what, rule, got).into());
            }
        }
        Ok(())
    }

    fn groups(&self, targets: &[usize]) -> Vec<Group<'_>> {
        let stream = Stream::new(self.context.seed, "impulse law", "");
        let nu = |&at: &usize| self.nu[self.counters.points[at]];
        let nu: Vec<f64> = targets.iter().map(nu).collect();
        let run = move |trials| count(&stream, &nu, self.length, trials);
        vec![Group::new(targets.to_vec(), run)]
    }
}

/// Counts several ν on the same draws.
fn count(stream: &Stream, nu: &[f64], length: usize, trials: Range<u64>) -> Vec<Sums> {
    let mut counts = vec![vec![[0u64; 3]; length]; nu.len()];
    for trial in trials {
        let mut generator = stream.at(trial);
        let mut memories = vec![ImpulseMemory::default(); nu.len()];
        for sample in 0..length {
            let draw = generator.next_u64();
            for ((memory, nu), counts) in memories.iter_mut().zip(nu).zip(&mut counts) {
                let impulse = memory.step(*nu, draw);
                let [zero_sum, positive, none] = &mut counts[sample];
                *zero_sum += u64::from(memory.sum() == 0.0);
                *positive += u64::from(impulse > 0.0);
                *none += u64::from(impulse == 0.0);
            }
        }
    }
    let sums = |counts: &Vec<[u64; 3]>| Sums::of(counts.as_flattened());
    counts.iter().map(sums).collect()
}

/// How far the simulation is from (5) and from the closed form of (6), and when (6) holds to 1 %.
fn quantities(rows: &[Row], confidence: f64) -> Vec<Quantity> {
    let sums = |row: &Row| vec![(row.tally(row.zero_sum_count), row.zero_sum)];
    let impulses = |row: &Row| {
        let negative = row.trials - row.positive_count - row.none_count;
        vec![
            (row.tally(row.positive_count), row.positive),
            (row.tally(negative), row.positive),
            (row.tally(row.none_count), row.none),
        ]
    };
    let impulses: Vec<_> = rows.iter().flat_map(impulses).collect();
    let sums: Vec<_> = rows.iter().flat_map(sums).collect();
    let mut quantities = vec![
        largest_deviation("eq5_largest_deviation", &impulses, confidence),
        largest_deviation("eq6_largest_deviation_from_closed_form", &sums, confidence),
    ];
    for row in rows.iter().filter(|row| row.sample == 1) {
        let name = format!("eq6_samples_to_one_percent_nu_{}", row.nu).replace('.', "_");
        quantities.push(Quantity::exact(&name, samples_to_one_percent(row.nu)));
    }
    quantities
}

/// P(S_i = 0) after a start from S = 0.
fn zero_sum(nu: f64, sample: usize) -> f64 {
    f64::midpoint(1.0, libm::pow(1.0 - 2.0 * nu, sample as f64))
}

/// The first i with |P(S_i = 0) − ½| ≤ 0.005, that is |1 − 2ν|^i ≤ 0.01.
fn samples_to_one_percent(nu: f64) -> f64 {
    let shrinks = (1.0 - 2.0 * nu).abs();
    // This is the logarithm of `shrinks`. It stays accurate where `shrinks` rounds to 1.
    let decay = libm::log1p(-2.0 * nu.min(1.0 - nu));
    let rough = (libm::log(0.01) / decay).floor().max(1.0);
    // The quotient is rounded, so its neighbours are tried as well.
    let is_enough = |i: f64| libm::pow(shrinks, i) <= 0.01;
    [rough, rough + 1.0]
        .into_iter()
        .find(|&i| is_enough(i))
        .unwrap_or(rough + 2.0)
}

/// The largest |rate − probability|. Its interval follows from simultaneous intervals of all rates
/// (Bonferroni). It starts at zero if every one of them covers its probability.
fn largest_deviation(name: &str, compared: &[(Tally, f64)], confidence: f64) -> Quantity {
    let together = 1.0 - (1.0 - confidence) / compared.len() as f64;
    let deviations = compared.par_iter().map(|&(tally, probability)| {
        let (low, high) = tally.interval(together);
        [
            (tally.rate() - probability).abs(),
            (low - probability).max(probability - high).max(0.0),
            (high - probability).max(probability - low),
        ]
    });
    let largest = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|i| a[i].max(b[i]));
    let [value, low, high] = deviations.reduce(|| [0.0; 3], largest);
    Quantity {
        name: name.to_owned(),
        value: eight_digits(value),
        low: eight_digits(low),
        high: eight_digits(high),
    }
}

fn row(nu: f64, sample: usize, trials: u64, counts: &[u64], confidence: f64) -> Row {
    let interval = |hits| {
        let (low, high) = Tally { hits, trials }.interval(confidence);
        [eight_digits(low), eight_digits(high)]
    };
    let rate = |hits| Tally { hits, trials }.rate();
    let [zero_sum_low, zero_sum_high] = interval(counts[0]);
    let [positive_low, positive_high] = interval(counts[1]);
    let [none_low, none_high] = interval(counts[2]);
    Row {
        nu,
        sample,
        trials,
        zero_sum: eight_digits(zero_sum(nu, sample)),
        zero_sum_count: counts[0],
        zero_sum_rate: rate(counts[0]),
        zero_sum_low,
        zero_sum_high,
        positive: nu / 2.0,
        positive_count: counts[1],
        positive_rate: rate(counts[1]),
        positive_low,
        positive_high,
        none: 1.0 - nu,
        none_count: counts[2],
        none_rate: rate(counts[2]),
        none_low,
        none_high,
    }
}

impl Row {
    fn tally(&self, hits: u64) -> Tally {
        let trials = self.trials;
        Tally { hits, trials }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::whole;
    use crate::stats::binomial;
    use crate::study::tests::rows;

    fn study(trials: u64, nu: &[f64], length: usize) -> ImpulseLaw {
        let context = Context {
            seed: 2014,
            trials,
            confidence: 0.95,
        };
        ImpulseLaw::new(context, nu.to_vec(), length)
    }

    /// Compares the closed form with the chain: P(0) and P(±θ) follow step by step from the rule of (4).
    #[test]
    fn closed_form_is_that_of_the_chain() {
        for nu in [0.01, 0.3, 0.5, 0.9] {
            let mut at_zero = 1.0;
            for sample in 1..=50 {
                at_zero = at_zero * (1.0 - nu) + (1.0 - at_zero) * nu;
                assert!((zero_sum(nu, sample) - at_zero).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn one_percent_by_trying() {
        for nu in [0.01, 0.1, 0.3, 0.499, 0.5, 0.7, 0.995] {
            let tried = (1..).find(|&i| (zero_sum(nu, i) - 0.5).abs() <= 0.005);
            assert_eq!(samples_to_one_percent(nu), tried.unwrap() as f64, "{nu}");
        }
        // The answer is ln 100 / 2ν where 1 − 2ν rounds to 1.
        let many = samples_to_one_percent(1e-17);
        assert!((many / 2.302_585_093e17 - 1.0).abs() < 1e-9, "{many}");
    }

    /// Makes 2 · 20 · 3 exact tests. Each fails with probability 5e-9 at most: 6e-7 in all.
    #[test]
    fn simulation_follows_the_laws() {
        let trials = 20_000;
        for row in rows(&study(trials, &[0.1, 0.6], 20), trials) {
            for (count, probability) in [
                (row.zero_sum_count, zero_sum(row.nu, row.sample)),
                (row.positive_count, row.positive),
                (row.none_count, row.none),
            ] {
                let below = binomial::lower_tail(count, trials, probability);
                let above = binomial::upper_tail(count, trials, probability);
                let p = 2.0 * below.min(above);
                println!("n = {trials}, count {count} at {probability:.4}: p = {p:.3}");
                assert!(p > 5e-9, "{row:?}");
            }
        }
    }

    /// Counts the same draws again, one trial after another.
    #[test]
    fn counts_are_those_of_a_plain_loop() {
        let stream = Stream::new(2014, "impulse law", "");
        let mut counts = [[0; 3]; 7];
        for trial in 0..300 {
            let mut generator = stream.at(trial);
            let mut sum = 0i32;
            for counts in &mut counts {
                let draw = generator.next_u64();
                let carries = ((draw >> 11) as f64) < 0.3 * (1u64 << 53) as f64;
                let fresh = if draw & 1 == 1 { 1 } else { -1 };
                let impulse = match (carries, sum) {
                    (false, _) => 0,
                    (true, 0) => fresh,
                    (true, sum) => -sum,
                };
                sum += impulse;
                counts[0] += u64::from(sum == 0);
                counts[1] += u64::from(impulse == 1);
                counts[2] += u64::from(impulse == 0);
            }
        }
        let study = study(300, &[0.3], 7);
        let counted = whole(study.trials().unwrap(), 300, &()).unwrap();
        let counter = counted.get(&study.counters.keys[0]).unwrap();
        assert_eq!(counter.sums, Sums::of(counts.as_flattened()));
    }
}
