//! The autocorrelation of the sensor's noise, Fig. 1 of [^1]: theory and simulation.
//!
//! # Theory
//! Of the predictors of order 1, 2, …, p, which the step-down recursion takes from φ, the one of order
//! k satisfies the Yule–Walker equations up to lag k, so ρ_k = Σ_{j≤k} φ_j^{(k)} ρ_{k−j}; beyond p,
//! ρ_k = Σ φ_j ρ_{k−j}. For p = 2 that is ρ₁ = φ₁/(1 − φ₂), ρ_k = φ₁ρ_{k−1} + φ₂ρ_{k−2}. The last
//! coefficients κ_k = φ_k^{(k)} give σ_x²/σ_ξ² = ∏ 1/(1 − κ_k²).
//!
//! # Simulation
//! Of each record the products x_i x_{i−k} are averaged over the n − k that there are and divided by the
//! σ_x² of theory: the mean is known to be zero and nothing is divided by an estimate, so the estimator
//! has no bias at any length. The records are independent, and the interval is the normal one of
//! their mean.
//!
//! [^1]: see [`crate::signal`].

use crate::config::ExhibitConfig;
use crate::results::{Quantity, eight_digits};
use crate::rng::Stream;
use crate::signal::{Sensor, Transfer};
use crate::stats::normal::two_sided_quantile;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// One lag.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// k, in samples.
    pub lag: usize,
    /// ρ_k by the coefficients of the config's sensor.
    pub theory: f64,
    /// ρ_k by the coefficients that follow from (1).
    pub exact_transfer: f64,
    /// Mean of the records' estimates.
    pub estimate: f64,
    /// Its interval.
    pub low: f64,
    /// Its interval.
    pub high: f64,
}

/// (1), with the T₀ of (2).
const TRANSFER: Transfer = Transfer {
    a: 2.2e-10,
    b: 1.01e-6,
    c: 0.4,
    period: 6.25e-5,
};
/// The coefficients and the numerator that (2) prints.
const PRINTED: [f64; 2] = [-1.5365, -0.75056];
const PRINTED_NUMERATOR: f64 = 9.404e-6;
/// Records whose sums are kept at once.
const CHUNK: u64 = 1024;

/// Theory and simulation at lags 0 … `lags`, from the config's trials of `length` samples each.
pub fn rows(config: &ExhibitConfig, lags: usize, length: usize) -> Vec<Row> {
    let sensor = &config.scenario.sensor;
    let theory = autocorrelation(sensor.ar(), lags);
    let exact_transfer = autocorrelation(&transfer_ar(), lags);
    let spread = Spread::of_trials(config, &theory, length);
    let width = two_sided_quantile(config.confidence);
    (0..=lags)
        .map(|lag| {
            let (estimate, deviation) = spread.mean_and_deviation(lag, theory[lag]);
            Row {
                lag,
                theory: eight_digits(theory[lag]),
                exact_transfer: eight_digits(exact_transfer[lag]),
                estimate: eight_digits(estimate),
                low: eight_digits(estimate - width * deviation),
                high: eight_digits(estimate + width * deviation),
            }
        })
        .collect()
}

/// What (2) is worth, how far the simulation is from theory, what whitening gains.
pub fn quantities(config: &ExhibitConfig, rows: &[Row]) -> Vec<Quantity> {
    let exact = transfer_ar();
    let decay = TRANSFER.b / (2.0 * TRANSFER.a);
    let frequency = (TRANSFER.c / TRANSFER.a - decay * decay).sqrt();
    let bare = libm::exp(-decay * TRANSFER.period) * libm::sin(frequency * TRANSFER.period)
        / frequency
        / PRINTED_NUMERATOR;
    let sensor = &config.scenario.sensor;
    let variance = variance_ratio(sensor.ar());
    let gain = 20.0 * libm::log10(sensor.step_gain().abs() * variance.sqrt());
    let exactly = |name, value| Quantity::exact(name, eight_digits(value));
    vec![
        exactly(
            "phi_1_error_in_last_digits",
            (PRINTED[0] - exact[0]).abs() / 1e-4,
        ),
        exactly(
            "phi_2_error_in_last_digits",
            (PRINTED[1] - exact[1]).abs() / 1e-5,
        ),
        exactly("numerator_ratio", bare * TRANSFER.period / TRANSFER.a),
        exactly("numerator_ratio_without_factors", bare),
        exactly("variance_ratio", variance),
        largest_deviation(rows, config.confidence),
        exactly("whitening_gain_per_sample_db", gain),
    ]
}

/// max |estimate − theory|, its interval from intervals of all lags that hold together (Bonferroni).
fn largest_deviation(rows: &[Row], confidence: f64) -> Quantity {
    let together = 1.0 - (1.0 - confidence) / rows.len() as f64;
    let wider = two_sided_quantile(together) / two_sided_quantile(confidence);
    let (mut value, mut low, mut high) = (0.0f64, 0.0f64, 0.0f64);
    for row in rows {
        let deviation = (row.estimate - row.theory).abs();
        let half_width = wider * (row.high - row.low) / 2.0;
        value = value.max(deviation);
        low = low.max(deviation - half_width);
        high = high.max(deviation + half_width);
    }
    Quantity {
        name: "largest_deviation".to_owned(),
        value: eight_digits(value),
        low: eight_digits(low),
        high: eight_digits(high),
    }
}

fn transfer_ar() -> Vec<f64> {
    let sensor = Sensor::from_transfer(TRANSFER).expect("the sensor of (1) is stable");
    sensor.ar().to_vec()
}

/// The predictors of order 1 … p that end in `ar`.
fn predictors(ar: &[f64]) -> Vec<Vec<f64>> {
    let mut orders = vec![ar.to_vec()];
    for order in (1..ar.len()).rev() {
        let longer = &orders[orders.len() - 1];
        let last = longer[order];
        let scale = 1.0 - last * last;
        let shorter = (0..order)
            .map(|p| (longer[p] + last * longer[order - 1 - p]) / scale)
            .collect();
        orders.push(shorter);
    }
    orders.reverse();
    orders
}

/// ρ₀ … ρ_lags of the stable autoregression `ar`.
fn autocorrelation(ar: &[f64], lags: usize) -> Vec<f64> {
    let predictors = predictors(ar);
    let mut rho = vec![1.0];
    for lag in 1..=lags {
        let predictor = predictors
            .get(lag - 1)
            .map_or(ar, |predictor| &predictor[..]);
        let past = rho.iter().rev();
        rho.push(predictor.iter().zip(past).map(|(phi, rho)| phi * rho).sum());
    }
    rho
}

/// σ_x²/σ_ξ².
fn variance_ratio(ar: &[f64]) -> f64 {
    let orders = predictors(ar).into_iter();
    orders
        .filter_map(|predictor| predictor.last().copied())
        .fold(1.0, |ratio, last| ratio / (1.0 - last * last))
}

/// Sums over records of the deviation of each lag's estimate from theory, and of its square.
struct Spread {
    records: f64,
    sums: Vec<f64>,
    squares: Vec<f64>,
}

impl Spread {
    fn of_trials(config: &ExhibitConfig, theory: &[f64], length: usize) -> Self {
        let sensor = &config.scenario.sensor;
        let subject = format!("{sensor} {} length {length}", config.scenario.noise);
        let stream = Stream::new(config.seed, "autocorrelation", &subject);
        let variance = variance_ratio(sensor.ar());
        let mut spread = Self {
            records: config.trials as f64,
            sums: vec![0.0; theory.len()],
            squares: vec![0.0; theory.len()],
        };
        let mut first = 0;
        while first < config.trials {
            let last = config.trials.min(first + CHUNK);
            let estimates: Vec<Vec<f64>> = (first..last)
                .into_par_iter()
                .map(|trial| {
                    let record = record(config, &stream, trial, length);
                    estimate(&record, theory.len() - 1, variance)
                })
                .collect();
            for estimate in &estimates {
                spread.add(estimate, theory);
            }
            first = last;
        }
        spread
    }

    fn add(&mut self, estimate: &[f64], theory: &[f64]) {
        for (lag, (estimate, theory)) in estimate.iter().zip(theory).enumerate() {
            let deviation = estimate - theory;
            self.sums[lag] += deviation;
            self.squares[lag] += deviation * deviation;
        }
    }

    /// The mean estimate at a lag and the deviation of that mean.
    fn mean_and_deviation(&self, lag: usize, theory: f64) -> (f64, f64) {
        let n = self.records;
        let mean = self.sums[lag] / n;
        let variance = (self.squares[lag] / n - mean * mean).max(0.0) * n / (n - 1.0);
        (theory + mean, (variance / n).sqrt())
    }
}

/// One stationary record.
fn record(config: &ExhibitConfig, stream: &Stream, trial: u64, length: usize) -> Vec<f64> {
    let sensor = &config.scenario.sensor;
    let mut record = vec![0.0; sensor.burn_in() + length];
    (config.scenario.noise).fill(&mut stream.at(trial), &mut record);
    sensor.colour(&mut record);
    record.split_off(sensor.burn_in())
}

/// Mean product at each lag over the known variance.
fn estimate(record: &[f64], lags: usize, variance: f64) -> Vec<f64> {
    let mean_product = |lag: usize| {
        let pairs = record[lag..].iter().zip(record);
        let sum: f64 = pairs.map(|(late, early)| late * early).sum();
        sum / (record.len() - lag) as f64
    };
    (0..=lags).map(|lag| mean_product(lag) / variance).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Experiment;

    fn config(rest: &str) -> ExhibitConfig {
        let text = format!("question = \"?\"\nseed = 2014\n{rest}");
        match Experiment::parse("test", &text) {
            Ok(Experiment::Exhibit(config)) => *config,
            other => panic!("{other:?}"),
        }
    }

    /// γ_k/γ_0 and γ_0 from the response ψ to one innovation: γ_k = Σ ψ_i ψ_{i+k}.
    fn by_response(ar: &[f64], lags: usize) -> (Vec<f64>, f64) {
        let mut response = vec![1.0];
        for i in 1..4000usize {
            let next = (1..=ar.len().min(i)).map(|p| ar[p - 1] * response[i - p]);
            response.push(next.sum());
        }
        let product = |k: usize| -> f64 {
            let pairs = response[k..].iter().zip(&response);
            pairs.map(|(a, b)| a * b).sum()
        };
        let rho = (0..=lags).map(|k| product(k) / product(0)).collect();
        (rho, product(0))
    }

    /// Against the infinite moving average; 4000 terms of a response that falls by 0.5 % a sample at
    /// the slowest leave less than 1e-15.
    #[test]
    fn theory_is_that_of_the_response() {
        for ar in [
            vec![],
            vec![0.9],
            vec![-1.5365, -0.75056],
            vec![0.5, -0.3, 0.1],
            vec![1.2, -0.6, 0.3, -0.1, 0.05],
        ] {
            let (expected, variance) = by_response(&ar, 30);
            for (rho, expected) in autocorrelation(&ar, 30).iter().zip(expected) {
                assert!((rho - expected).abs() < 1e-12, "{ar:?}: {rho} {expected}");
            }
            assert!((variance_ratio(&ar) / variance - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn closed_form_of_the_second_order() {
        let [first, second] = PRINTED;
        let rho = autocorrelation(&PRINTED, 3);
        assert!((rho[1] - first / (1.0 - second)).abs() < 1e-15);
        assert!((rho[3] - (first * rho[2] + second * rho[1])).abs() < 1e-15);
        let variance =
            (1.0 - second) / ((1.0 + second) * ((1.0 - second) * (1.0 - second) - first * first));
        assert!((variance_ratio(&PRINTED) / variance - 1.0).abs() < 1e-12);
        assert!((variance - 9.97).abs() < 0.01);
    }

    /// 31 means of 4000 short records, where an estimator with a bias of 1/length would be off by six
    /// deviations or more. Every |z| below 6: fails with probability below 31 · 2e-9 = 7e-8.
    #[test]
    fn the_estimator_has_no_bias() {
        let config = config("trials = 4000\n[autocorrelation]\nlength = 60\nlags = 30\n");
        let width = two_sided_quantile(config.confidence);
        for row in rows(&config, 30, 60) {
            let deviation = (row.high - row.low) / 2.0 / width;
            let z = (row.estimate - row.theory) / deviation;
            println!("lag {}: n = 4000, z = {z:.2}", row.lag);
            assert!(z.abs() < 6.0, "lag {}: {z}", row.lag);
        }
    }

    #[test]
    fn what_the_second_equation_is_worth() {
        let config = config("trials = 20\n[autocorrelation]\nlength = 100\nlags = 5\n");
        let quantities = quantities(&config, &rows(&config, 5, 100));
        let value = |name: &str| {
            let found = quantities.iter().find(|quantity| quantity.name == name);
            found.unwrap().value
        };
        assert!(value("phi_1_error_in_last_digits") < 0.5);
        assert!(value("phi_2_error_in_last_digits") < 0.5);
        assert!((value("numerator_ratio_without_factors") - 1.0).abs() < 1e-3);
        assert!(value("numerator_ratio") > 1e5);
        assert!((value("whitening_gain_per_sample_db") - 20.3).abs() < 0.05);
    }
}
