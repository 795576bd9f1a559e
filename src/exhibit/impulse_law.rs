//! The laws of one impulse λ_i and of the sum S_i, eqs (5) and (6) of [^1], against simulation.
//!
//! (5): P(λ_i = ±θ) = ν/2, P(λ_i = 0) = 1 − ν, exact at every i. (6), P(S_i = 0) = ½, is the limit: S
//! returns to zero or leaves it with every impulse, so P(S_i = 0) is the probability of an even number
//! of them, (1 + (1 − 2ν)^i)/2.
//!
//! All ν are decided by the same draws, one a sample.
//!
//! [^1]: see [`crate::signal`].

use crate::config::ExhibitConfig;
use crate::results::{Quantity, eight_digits};
use crate::rng::Stream;
use crate::signal::ImpulseMemory;
use crate::stats::tally::Tally;
use rand::Rng;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// One ν at one sample. Each law has its exact value, how often the event came up in `trials`, and the
/// exact interval of its probability.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the columns of three laws are alike")]
pub struct Row {
    pub nu: f64,
    pub sample: usize,
    pub trials: u64,
    pub zero_sum: f64,
    pub zero_sum_count: u64,
    pub zero_sum_rate: f64,
    pub zero_sum_low: f64,
    pub zero_sum_high: f64,
    pub positive: f64,
    pub positive_count: u64,
    pub positive_rate: f64,
    pub positive_low: f64,
    pub positive_high: f64,
    pub none: f64,
    pub none_count: u64,
    pub none_rate: f64,
    pub none_low: f64,
    pub none_high: f64,
}

/// How often each event came up at one sample.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Counts {
    zero_sum: u64,
    positive: u64,
    none: u64,
}

/// Every ν at samples 1 … `length`.
pub fn rows(config: &ExhibitConfig, nu: &[f64], length: usize) -> Vec<Row> {
    let counts = simulate(config, nu, length);
    let places = nu
        .iter()
        .flat_map(|&nu| (1..=length).map(move |sample| (nu, sample)));
    let cells: Vec<((f64, usize), Counts)> = places.zip(counts).collect();
    cells
        .into_par_iter()
        .map(|((nu, sample), counts)| row(config, nu, sample, counts))
        .collect()
}

/// How far the simulation is from (5) and from the closed form of (6), and when (6) holds to 1 %.
pub fn quantities(rows: &[Row], confidence: f64) -> Vec<Quantity> {
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

/// P(S_i = 0) from S = 0.
pub fn zero_sum(nu: f64, sample: usize) -> f64 {
    f64::midpoint(1.0, libm::pow(1.0 - 2.0 * nu, sample as f64))
}

/// The first i with |P(S_i = 0) − ½| ≤ 0.005, that is |1 − 2ν|^i ≤ 0.01.
fn samples_to_one_percent(nu: f64) -> f64 {
    let shrinks = (1.0 - 2.0 * nu).abs();
    // The logarithm of `shrinks`, also where that rounds to 1.
    let decay = libm::log1p(-2.0 * nu.min(1.0 - nu));
    let rough = (libm::log(0.01) / decay).floor().max(1.0);
    // A last bit of the quotient must not decide.
    let is_enough = |i: f64| libm::pow(shrinks, i) <= 0.01;
    [rough, rough + 1.0]
        .into_iter()
        .find(|&i| is_enough(i))
        .unwrap_or(rough + 2.0)
}

/// The largest |rate − probability|, its interval from intervals of all rates that hold together
/// (Bonferroni): from zero where every one of them covers its probability.
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

/// The counts of every ν and sample, ν by ν.
fn simulate(config: &ExhibitConfig, nu: &[f64], length: usize) -> Vec<Counts> {
    let stream = Stream::new(config.seed, "impulse law", "");
    let none = || vec![Counts::default(); nu.len() * length];
    (0..config.trials)
        .into_par_iter()
        .fold(none, |mut counts, trial| {
            let mut generator = stream.at(trial);
            let mut memories = vec![ImpulseMemory::default(); nu.len()];
            for sample in 0..length {
                let draw = generator.next_u64();
                for (index, memory) in memories.iter_mut().enumerate() {
                    let impulse = memory.step(nu[index], draw);
                    counts[index * length + sample].add(impulse, memory.sum());
                }
            }
            counts
        })
        .reduce(none, |mut sum, counts| {
            for (sum, counts) in sum.iter_mut().zip(counts) {
                sum.zero_sum += counts.zero_sum;
                sum.positive += counts.positive;
                sum.none += counts.none;
            }
            sum
        })
}

fn row(config: &ExhibitConfig, nu: f64, sample: usize, counts: Counts) -> Row {
    let trials = config.trials;
    let interval = |hits| {
        let (low, high) = Tally { hits, trials }.interval(config.confidence);
        [eight_digits(low), eight_digits(high)]
    };
    let rate = |hits| Tally { hits, trials }.rate();
    let [zero_sum_low, zero_sum_high] = interval(counts.zero_sum);
    let [positive_low, positive_high] = interval(counts.positive);
    let [none_low, none_high] = interval(counts.none);
    Row {
        nu,
        sample,
        trials,
        zero_sum: eight_digits(zero_sum(nu, sample)),
        zero_sum_count: counts.zero_sum,
        zero_sum_rate: rate(counts.zero_sum),
        zero_sum_low,
        zero_sum_high,
        positive: nu / 2.0,
        positive_count: counts.positive,
        positive_rate: rate(counts.positive),
        positive_low,
        positive_high,
        none: 1.0 - nu,
        none_count: counts.none,
        none_rate: rate(counts.none),
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

impl Counts {
    #[inline]
    fn add(&mut self, impulse: f64, sum: f64) {
        self.zero_sum += u64::from(sum == 0.0);
        self.positive += u64::from(impulse > 0.0);
        self.none += u64::from(impulse == 0.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Experiment;
    use crate::stats::binomial;

    fn config(trials: u64) -> ExhibitConfig {
        let text = format!(
            "question = \"?\"\nseed = 2014\ntrials = {trials}\n[impulse_law]\nnu = [0.1]\n"
        );
        match Experiment::parse("test", &text) {
            Ok(Experiment::Exhibit(config)) => *config,
            other => panic!("{other:?}"),
        }
    }

    /// Against the chain itself: P(0) and P(±θ) taken step by step from (4)'s rule.
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
        // ln 100 / 2ν where 1 − 2ν is 1 to every digit.
        let many = samples_to_one_percent(1e-17);
        assert!((many / 2.302_585_093e17 - 1.0).abs() < 1e-9, "{many}");
    }

    /// 2 · 20 · 3 exact tests, each failing with probability 5e-9 at most: 6e-7 in all.
    #[test]
    fn simulation_follows_the_laws() {
        let trials = 20_000;
        for row in rows(&config(trials), &[0.1, 0.6], 20) {
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

    /// The same draws, one trial after another.
    #[test]
    fn counts_are_those_of_a_plain_loop() {
        let stream = Stream::new(2014, "impulse law", "");
        let mut counts = vec![Counts::default(); 7];
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
                counts.zero_sum += u64::from(sum == 0);
                counts.positive += u64::from(impulse == 1);
                counts.none += u64::from(impulse == 0);
            }
        }
        assert_eq!(simulate(&config(300), &[0.3], 7), counts);
    }
}
