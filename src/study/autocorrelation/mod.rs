//! The autocorrelation of the sensor's noise, Fig. 1 of [^1]: theory and simulation.
//!
//! # Theory
//! The step-down recursion gives the predictors of order 1, 2, …, p from φ. The predictor of order k
//! satisfies the Yule–Walker equations up to lag k, so ρ_k = Σ_{j≤k} φ_j^{(k)} ρ_{k−j}. Beyond lag p,
//! ρ_k = Σ φ_j ρ_{k−j}. For p = 2 this gives ρ₁ = φ₁/(1 − φ₂) and ρ_k = φ₁ρ_{k−1} + φ₂ρ_{k−2}. The last
//! coefficients κ_k = φ_k^{(k)} give σ_x²/σ_ξ² = ∏ 1/(1 − κ_k²).
//!
//! # Simulation
//! For each record, the n − k products x_i x_{i−k} are averaged and divided by the theoretical σ_x². The
//! mean is known to be zero and the divisor is not an estimate, so the estimator has no bias at any
//! length. The records are independent, and the interval is the normal interval of their mean.
//!
//! [^1]: see [`crate::signal`].

pub(super) mod picture;
mod row;

pub use row::Row;

use crate::chain::Scenario;
use crate::config::Conflict;
use crate::counts::{Counter, Counts, Fixed, Shape, Sums};
use crate::experiment::Experiment;
use crate::figure::FigureError;
use crate::plot::Plot;
use crate::results::{Quantity, eight_digits};
use crate::rng::Stream;
use crate::rule::OutOfRange;
use crate::run::{Group, Identity, StudyError, Target, Trials};
use crate::signal::{Law, Sensor, Transfer, step_down};
use crate::stats::normal::two_sided_quantile;
use crate::study::kind::{Context, Counters, Study, counted};
use crate::study::rules::within;
use schemars::{JsonSchema, SchemaGenerator};
use serde::Deserialize;
use serde_json::Value;
use std::iter;
use std::ops::Range;

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
/// Trials in a block. A record takes a tenth of a millisecond.
const BLOCK: u64 = 16;

/// The autocorrelation of the sensor's noise: theory and simulation.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
struct Keys {
    /// The largest lag.
    lags: usize,
    /// Samples in one record.
    length: usize,
}

impl Default for Keys {
    fn default() -> Self {
        Self {
            lags: 40,
            length: 4096,
        }
    }
}

/// Theory and simulation at lags 0 … `lags`, from records of `length` samples each.
pub(super) struct Autocorrelation {
    context: Context,
    scenario: Scenario,
    lags: usize,
    length: usize,
    theory: Vec<f64>,
    counters: Counters,
}

const LONGEST: usize = 1_000_000;
const MOST_LAGS: usize = 10_000;

impl Keys {
    fn check(&self, scenario: &Scenario, context: Context) -> Result<(), Conflict> {
        within("autocorrelation.length", self.length, 2..=LONGEST)?;
        let most = self.length.min(MOST_LAGS) - 1;
        within("autocorrelation.lags", self.lags, 1..=most)?;
        if context.trials < 2 {
            let remedy = " (one record has no deviation)";
            let unfit = OutOfRange::new("trials", "be at least 2", context.trials);
            return Err(unfit.explained(remedy).into());
        }
        match Law::from(scenario.noise) {
            Law::Cauchy => {}
            Law::StudentT(freedom) if freedom <= 4.0 => {}
            _ => return Ok(()),
        }
        // The band needs the variance of squares, which a heavy tail does not have.
        let rule = "have a fourth moment, which the band of an autocorrelation needs";
        let unfit = OutOfRange::new("noise.law", rule, scenario.noise);
        let remedy = " (take another law, or a student_t above 4)";
        Err(unfit.explained(remedy).into())
    }
}

impl Autocorrelation {
    /// The sum of the deviations at each lag, and then of their squares.
    fn shape(&self) -> Shape {
        Shape {
            lengths: 2 * (self.lags + 1),
            ..Shape::default()
        }
    }
}

impl Study for Autocorrelation {
    const NAME: &'static str = "autocorrelation";
    const USES: &'static [&'static str] = &["sensor", "noise.law"];
    const COUNTS_TRIALS: bool = true;
    type Row = Row;

    fn read(experiment: &Experiment, context: Context) -> Result<Self, StudyError> {
        let keys: Keys = experiment.read()?;
        let scenario = experiment.scenario()?;
        keys.check(&scenario, context)
            .map_err(|conflict| experiment.conflict(conflict))?;
        let mut study = Self {
            theory: autocorrelation(scenario.sensor.ar(), keys.lags),
            context,
            scenario,
            lags: keys.lags,
            length: keys.length,
            counters: Counters::default(),
        };
        study.counters = Counters::new(&study, context.seed, &study.shape());
        Ok(study)
    }

    fn schema(generator: &mut SchemaGenerator) -> Value {
        Keys::json_schema(generator).to_value()
    }

    fn identities(&self) -> Vec<Identity> {
        vec![Identity::new([
            ("lags", self.lags.to_string()),
            ("length", self.length.to_string()),
            ("sensor", self.scenario.sensor.to_string()),
            ("noise", self.scenario.noise.to_string()),
        ])]
    }

    fn trials(&self) -> Option<Box<dyn Trials + '_>> {
        Some(Box::new(self))
    }

    fn rows(&self, counts: &Counts) -> Vec<Row> {
        let exact_transfer = autocorrelation(&transfer_ar(), self.lags);
        let width = two_sided_quantile(self.context.confidence);
        let (records, sums) = counted(counts, &self.counters.keys[0], &self.shape());
        let (deviations, squares) = sums.lengths.split_at(self.lags + 1);
        (0..=self.lags)
            .map(|lag| {
                let theory = self.theory[lag];
                let (mean, deviation) = mean_and_deviation(records, deviations[lag], squares[lag]);
                let estimate = theory + mean;
                Row {
                    lag,
                    theory: eight_digits(theory),
                    exact_transfer: eight_digits(exact_transfer[lag]),
                    estimate: eight_digits(estimate),
                    low: eight_digits(estimate - width * deviation),
                    high: eight_digits(estimate + width * deviation),
                }
            })
            .collect()
    }

    fn quantities(&self, rows: &[Row]) -> Result<Vec<Quantity>, StudyError> {
        Ok(quantities(
            &self.scenario.sensor,
            self.context.confidence,
            rows,
        ))
    }

    fn plot(&self, rows: &[Row], seed: u64) -> Result<Plot, FigureError> {
        let records = picture::Records {
            sensor: &self.scenario.sensor,
            noise: &self.scenario.noise,
            trials: self.context.trials,
            length: self.length,
            confidence: self.context.confidence,
            seed,
        };
        Ok(picture::plot(rows, &records))
    }
}

/// The mean of a number of deviations, and the deviation of that mean.
fn mean_and_deviation(number: u64, sum: Fixed, squares: Fixed) -> (f64, f64) {
    let n = number as f64;
    let mean = sum.value() / n;
    let variance = (squares.value() / n - mean * mean).max(0.0) * n / (n - 1.0);
    (mean, (variance / n).sqrt())
}

impl Trials for &Autocorrelation {
    fn targets(&self) -> &[Target] {
        &self.counters.targets
    }

    fn block(&self) -> u64 {
        BLOCK
    }

    /// A mean square is at least the square of the mean.
    fn check(&self, counts: &Counts) -> Result<(), StudyError> {
        let key = &self.counters.keys[0];
        let Some(Counter { trials, sums }) = counts.get(key) else {
            return Ok(());
        };
        let (deviations, squares) = sums.lengths.split_at(self.lags + 1);
        let is_possible = |(sum, squares): (&Fixed, &Fixed)| {
            let (sum, squares) = (sum.value(), squares.value());
            // Each number is rounded to 2⁻⁶⁰, and the sums to doubles.
            let slack = 1e-9 * (1.0 + squares.abs());
            sum * sum <= trials.len() as f64 * (squares + slack)
        };
        if deviations.iter().zip(squares).all(is_possible) {
            return Ok(());
        }
        Err(format!("counter {key}: squares that are too small for their sum").into())
    }

    fn groups(&self, targets: &[usize]) -> Vec<Group<'_>> {
        let Scenario { sensor, noise, .. } = &self.scenario;
        let subject = format!("{sensor} {noise} length {}", self.length);
        let stream = Stream::new(self.context.seed, "autocorrelation", &subject);
        let run = move |trials| vec![self.sums(&stream, trials)];
        vec![Group::new(targets.to_vec(), run)]
    }
}

impl Autocorrelation {
    /// Sums over the records, one after the other.
    fn sums(&self, stream: &Stream, trials: Range<u64>) -> Sums {
        let variance = variance_ratio(self.scenario.sensor.ar());
        let mut sums = self.shape().empty().sums;
        let (deviations, squares) = sums.lengths.split_at_mut(self.lags + 1);
        for trial in trials {
            let record = self.record(stream, trial);
            for (lag, theory) in self.theory.iter().enumerate() {
                let deviation = mean_product(&record, lag) / variance - theory;
                deviations[lag] += Fixed::new(deviation);
                squares[lag] += Fixed::new(deviation * deviation);
            }
        }
        sums
    }

    /// One stationary record.
    fn record(&self, stream: &Stream, trial: u64) -> Vec<f64> {
        let Scenario { sensor, noise, .. } = &self.scenario;
        let mut record = vec![0.0; sensor.burn_in() + self.length];
        noise.fill(&mut stream.at(trial), &mut record);
        sensor.colour(&mut record);
        record.split_off(sensor.burn_in())
    }
}

fn mean_product(record: &[f64], lag: usize) -> f64 {
    let pairs = record[lag..].iter().zip(record);
    let sum: f64 = pairs.map(|(late, early)| late * early).sum();
    sum / (record.len() - lag) as f64
}

/// How accurate (2) is, how far the simulation is from theory, and what whitening gains.
fn quantities(sensor: &Sensor, confidence: f64, rows: &[Row]) -> Vec<Quantity> {
    let exact = transfer_ar();
    let decay = TRANSFER.b / (2.0 * TRANSFER.a);
    let frequency = (TRANSFER.c / TRANSFER.a - decay * decay).sqrt();
    let bare = libm::exp(-decay * TRANSFER.period) * libm::sin(frequency * TRANSFER.period)
        / frequency
        / PRINTED_NUMERATOR;
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
        largest_deviation(rows, confidence),
        exactly("whitening_gain_per_sample_db", gain),
    ]
}

/// max |estimate − theory|. Its interval follows from simultaneous intervals at all lags (Bonferroni).
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
    let below = |longer: &Vec<f64>| (longer.len() > 1).then(|| step_down(longer));
    let mut orders: Vec<_> = iter::successors(Some(ar.to_vec()), below).collect();
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::tests::{read, rows};

    /// The study of a short config, and its rows.
    fn study(trials: u64, length: usize, lags: usize) -> (Autocorrelation, Vec<Row>) {
        let text = format!(
            "question = \"?\"\nseed = 2014\ntrials = {trials}\n\
             [autocorrelation]\nlength = {length}\nlags = {lags}\n"
        );
        let study: Autocorrelation = read(&text);
        let rows = rows(&study, trials);
        (study, rows)
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

    /// Compares theory with the infinite moving average. The response falls by at least 0.5 % per sample,
    /// so 4000 terms leave less than 1e-15.
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

    /// Takes 31 means of 4000 short records. An estimator with a bias of 1/length would be off by six
    /// deviations or more. The test requires |z| < 6 everywhere: it fails with probability below
    /// 31 · 2e-9 = 7e-8.
    #[test]
    fn the_estimator_has_no_bias() {
        let (study, rows) = study(4000, 60, 30);
        let width = two_sided_quantile(study.context.confidence);
        for row in rows {
            let deviation = (row.high - row.low) / 2.0 / width;
            let z = (row.estimate - row.theory) / deviation;
            println!("lag {}: n = 4000, z = {z:.2}", row.lag);
            assert!(z.abs() < 6.0, "lag {}: {z}", row.lag);
        }
    }

    #[test]
    fn what_the_second_equation_is_worth() {
        let (study, rows) = study(20, 100, 5);
        let quantities = study.quantities(&rows).unwrap();
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
