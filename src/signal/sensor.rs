//! The sensor as an autoregression, eqs (1)–(3) of [^1]: x_i = Σ φ_p x_{i−p} + ξ_i.
//!
//! A second-order element K(p) = 1/(a p² + b p + c) sampled by impulse invariance at period T₀ has
//! its poles at e^{(−σ ± jω)T₀} with σ = b/2a and ω² = c/a − σ², so φ₁ = 2e^{−σT₀} cos ωT₀ and
//! φ₂ = −e^{−2σT₀}. The numerator only scales the signal; here it is 1, which makes σ_ξ the unit.
//! (The numerator printed in (2) lacks the factors 1/a and T₀; nothing here depends on it.)
//!
//! [^1]: see [`crate::signal`].

use crate::simd::Value;
use schemars::JsonSchema;
use serde::de::{Deserializer, Error};
use serde::{Deserialize, Serialize};
use std::fmt;

/// A stable autoregression driven by unit-scale white noise.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(from = "Choice")]
pub struct Sensor {
    /// φ₁, φ₂, …; empty for a sensor whose noise is already white.
    ar: Vec<f64>,
    /// What the first samples of a stationary record are given those before them, one by one.
    starts: Vec<Start>,
    burn_in: usize,
}

/// The best prediction of a stationary sample from all before it, and the deviation of its error.
#[derive(Clone, Debug, PartialEq)]
struct Start {
    ar: Vec<f64>,
    deviation: f64,
}

/// K(p) = 1/(a p² + b p + c) and the sampling period, eq. (1).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Transfer {
    /// Coefficient of p², s².
    pub a: f64,
    /// Coefficient of p, s.
    pub b: f64,
    /// Stiffness, dimensionless.
    pub c: f64,
    /// T₀, s.
    pub period: f64,
}

/// The ways to say what a sensor is, of which a file takes one.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Choice {
    /// A sensor by its name.
    Model(Model),
    /// φ₁, φ₂, … of x_i = φ₁ x_(i−1) + φ₂ x_(i−2) + … + ξ_i; none for white noise.
    Ar(
        #[serde(deserialize_with = "coefficients")]
        #[schemars(with = "Vec<f64>")]
        Sensor,
    ),
    /// K(p) = 1/(a p² + b p + c), sampled with a period in s.
    Transfer(
        #[serde(deserialize_with = "transfer")]
        #[schemars(with = "Transfer")]
        Sensor,
    ),
}

/// A sensor by its name.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Model {
    /// The coefficients printed in (2).
    Adxl105,
}

impl From<Choice> for Sensor {
    fn from(choice: Choice) -> Self {
        match choice {
            Choice::Model(Model::Adxl105) => Self::adxl105(),
            Choice::Ar(sensor) | Choice::Transfer(sensor) => sensor,
        }
    }
}

impl Default for Sensor {
    fn default() -> Self {
        Self::adxl105()
    }
}

fn coefficients<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Sensor, D::Error> {
    Sensor::from_ar(Vec::deserialize(deserializer)?).map_err(D::Error::custom)
}

fn transfer<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Sensor, D::Error> {
    Sensor::from_transfer(Transfer::deserialize(deserializer)?).map_err(D::Error::custom)
}

/// Why a sensor was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SensorError {
    /// A coefficient is NaN or infinite.
    #[error("coefficients must be finite numbers, got {0}")]
    NotFinite(f64),
    /// More coefficients than any sensor has.
    #[error("must have at most {MOST_COEFFICIENTS} coefficients, got {0}")]
    TooMany(usize),
    /// A pole lies on or outside the unit circle.
    #[error(
        "unstable autoregression {ar:?}: reflection coefficient {index} is {reflection}, outside (-1, 1) \
         (in x_i = ar[0] x_(i-1) + ar[1] x_(i-2) + ... every pole must lie inside the unit circle)"
    )]
    Unstable {
        /// The coefficients as given.
        ar: Vec<f64>,
        /// Which reflection coefficient fails, from 1.
        index: usize,
        /// Its value.
        reflection: f64,
    },
    /// The state needs too many samples to become stationary.
    #[error(
        "autoregression {ar:?} needs more than {limit} samples to become stationary \
         (move its poles away from the unit circle)"
    )]
    BarelyStable {
        /// The coefficients as given.
        ar: Vec<f64>,
        /// The longest burn-in allowed.
        limit: usize,
    },
    /// a, c or the period is not positive.
    #[error("transfer.{name} must be positive, got {value}")]
    NotPositive {
        /// Which one.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// b² ≥ 4ac.
    #[error(
        "transfer has real poles: b^2 = {square:e} is not below 4ac = {bound:e} \
         (the model is an oscillator; lower b)"
    )]
    RealPoles {
        /// b².
        square: f64,
        /// 4ac.
        bound: f64,
    },
}

/// Predictors of every lower order are kept, so memory grows with the square.
const MOST_COEFFICIENTS: usize = 1000;

/// The longest burn-in that a trial may spend.
const LONGEST_BURN_IN: usize = 1_000_000;

/// The share of the stationary variance that the start of a record may lack.
const BURN_IN_DEFICIT: f64 = 1e-9;

impl Sensor {
    /// The ADXL105 by the coefficients printed in (2).
    pub fn adxl105() -> Self {
        Self::from_ar(vec![-1.5365, -0.75056]).expect("a stable autoregression")
    }

    /// φ₁, φ₂, … as given; none for white noise.
    ///
    /// # Errors
    /// Where a pole is not inside the unit circle, or so close to it that no record would be long
    /// enough.
    pub fn from_ar(ar: Vec<f64>) -> Result<Self, SensorError> {
        if ar.len() > MOST_COEFFICIENTS {
            return Err(SensorError::TooMany(ar.len()));
        }
        if let Some(&value) = ar.iter().find(|value| !value.is_finite()) {
            return Err(SensorError::NotFinite(value));
        }
        let starts = match starts(&ar) {
            Ok(starts) => starts,
            Err((index, reflection)) => {
                return Err(SensorError::Unstable {
                    ar,
                    index,
                    reflection,
                });
            }
        };
        let burn_in = burn_in(&ar);
        match burn_in > LONGEST_BURN_IN {
            true => Err(SensorError::BarelyStable {
                ar,
                limit: LONGEST_BURN_IN,
            }),
            false => Ok(Self {
                ar,
                starts,
                burn_in,
            }),
        }
    }

    /// By impulse invariance from the transfer function, eq. (1) → eq. (2).
    ///
    /// # Errors
    /// Where a, c or the period is not positive, the poles are real, or the system is unstable.
    pub fn from_transfer(transfer: Transfer) -> Result<Self, SensorError> {
        let Transfer { a, b, c, period } = transfer;
        for (name, value) in [("a", a), ("c", c), ("period", period)] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(SensorError::NotPositive { name, value });
            }
        }
        if !b.is_finite() {
            return Err(SensorError::NotFinite(b));
        }
        let (square, bound) = (b * b, 4.0 * a * c);
        if square >= bound {
            return Err(SensorError::RealPoles { square, bound });
        }
        let decay = b / (2.0 * a);
        let frequency = (c / a - decay * decay).sqrt();
        let radius = libm::exp(-decay * period);
        Self::from_ar(vec![
            2.0 * radius * libm::cos(frequency * period),
            -radius * radius,
        ])
    }

    /// φ₁, φ₂, …
    pub fn ar(&self) -> &[f64] {
        &self.ar
    }

    /// 1 − β = 1 − Σ φ_p: what whitening with the true coefficients makes of a unit step, eq. (9).
    pub fn step_gain(&self) -> f64 {
        1.0 - self.ar.iter().sum::<f64>()
    }

    /// The next sample after `past` (oldest first, at least the sensor's order) for one innovation.
    #[inline]
    pub fn step(&self, past: &[f64], innovation: f64) -> f64 {
        predict(&self.ar, past, innovation)
    }

    /// Turns white noise into sensor noise in place, from the zero state.
    #[inline(always)]
    pub fn colour<V: Value>(&self, record: &mut [V]) {
        self.continue_from(0, record);
    }

    /// Turns white normal noise into stationary sensor noise in place: the first samples are normal
    /// with the deviations and correlations that all later ones have. For other laws of noise such a
    /// start is not known; they need [`Sensor::burn_in`].
    #[inline(always)]
    pub fn colour_stationary<V: Value>(&self, record: &mut [V]) {
        let starts = self.starts.len().min(record.len());
        for (i, start) in self.starts[..starts].iter().enumerate() {
            record[i] = predict(&start.ar, &record[..i], record[i] * start.deviation);
        }
        self.continue_from(starts, record);
    }

    /// The recursion from sample `first` on.
    #[inline(always)]
    fn continue_from<V: Value>(&self, first: usize, record: &mut [V]) {
        if let [phi_1, phi_2] = self.ar[..] {
            let back = |p: usize| {
                if first >= p {
                    record[first - p]
                } else {
                    V::default()
                }
            };
            let (mut x1, mut x2) = (back(1), back(2));
            for x in &mut record[first..] {
                // The newest sample is added last: the next step waits for that alone.
                let next = (*x + x2 * phi_2) + x1 * phi_1;
                (x2, x1) = (x1, next);
                *x = next;
            }
            return;
        }
        for i in first..record.len() {
            record[i] = predict(
                &self.ar,
                &record[i.saturating_sub(self.ar.len())..i],
                record[i],
            );
        }
    }

    /// Samples after the zero state until the noise is stationary but for a billionth of its variance.
    pub fn burn_in(&self) -> usize {
        self.burn_in
    }
}

impl fmt::Display for Sensor {
    /// `ar(-1.5365 -0.75056)`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let coefficients: Vec<String> = self.ar.iter().map(f64::to_string).collect();
        write!(f, "ar({})", coefficients.join(" "))
    }
}

/// How many samples after the zero state lack no more than a billionth of the stationary variance:
/// the tail Σ_{k≥n} h_k² of the impulse response, whose decay the poles set.
fn burn_in(ar: &[f64]) -> usize {
    if ar.is_empty() {
        return 0;
    }
    let mut response = vec![1.0];
    let mut energy = vec![0.0, 1.0];
    let mut quiet = 0;
    while response.len() <= 2 * LONGEST_BURN_IN && quiet < 64 + ar.len() {
        let next = predict(ar, &response, 0.0);
        response.push(next);
        let total = energy[energy.len() - 1] + next * next;
        energy.push(total);
        quiet = match next * next < 1e-20 * total {
            true => quiet + 1,
            false => 0,
        };
    }
    let total = energy[energy.len() - 1];
    energy.partition_point(|&sum| total - sum > BURN_IN_DEFICIT * total)
}

/// Σ φ_p x_{i−p} + ξ, where `past` ends with x_{i−1} and what precedes it counts as zero.
#[inline(always)]
fn predict<V: Value>(ar: &[f64], past: &[V], innovation: V) -> V {
    let mut sum = innovation;
    for (phi, x) in ar.iter().zip(past.iter().rev()) {
        sum = sum + *x * *phi;
    }
    sum
}

/// The best predictors of order 0, 1, … below that of `ar`, by the step-down recursion from it: the last
/// coefficient k of each order is a reflection coefficient, and the error's variance grows by
/// 1/(1 − k²) with every order taken away.
///
/// # Errors
/// The first reflection coefficient outside (−1, 1), with its index: then nothing is stationary.
fn starts(ar: &[f64]) -> Result<Vec<Start>, (usize, f64)> {
    let mut predictor = ar.to_vec();
    let mut variance = 1.0;
    let mut starts = Vec::new();
    while let Some(reflection) = predictor.pop() {
        let order = predictor.len();
        if reflection.is_nan() || reflection.abs() >= 1.0 {
            return Err((order + 1, reflection));
        }
        let scale = 1.0 - reflection * reflection;
        predictor = (0..order)
            .map(|p| (predictor[p] + reflection * predictor[order - 1 - p]) / scale)
            .collect();
        variance /= scale;
        starts.push(Start {
            ar: predictor.clone(),
            deviation: libm::sqrt(variance),
        });
    }
    starts.reverse();
    Ok(starts)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (2) follows from (1): 1.5365 and 0.75056 as printed, 1.536538 and 0.750563 to six digits.
    #[test]
    fn transfer_gives_the_printed_coefficients() {
        let sensor = Sensor::from_transfer(Transfer {
            a: 2.2e-10,
            b: 1.01e-6,
            c: 0.4,
            period: 6.25e-5,
        })
        .unwrap();
        assert!((sensor.ar()[0] + 1.536538).abs() < 5e-7, "{sensor:?}");
        assert!((sensor.ar()[1] + 0.750563).abs() < 5e-7, "{sensor:?}");
        for (exact, printed) in sensor.ar().iter().zip(Sensor::adxl105().ar()) {
            assert!((exact - printed).abs() < 5e-5);
        }
        assert!((Sensor::adxl105().step_gain() - 3.28706).abs() < 1e-12);
    }

    /// Impulse invariance means the continuous impulse response at kT₀: e^{−σt} sin ωt.
    #[test]
    fn transfer_samples_the_impulse_response() {
        let (a, b, c, period) = (1.0, 0.6, 4.0, 0.3);
        let sensor = Sensor::from_transfer(Transfer { a, b, c, period }).unwrap();
        let (decay, frequency) = (0.3, (4.0f64 - 0.09).sqrt());
        let sampled = |k: usize| {
            let t = k as f64 * period;
            (-decay * t).exp() * (frequency * t).sin()
        };
        for k in 2..40 {
            let predicted = sensor.step(&[sampled(k - 2), sampled(k - 1)], 0.0);
            assert!((predicted - sampled(k)).abs() < 1e-14, "{k}");
        }
    }

    #[test]
    fn step_and_colour_agree() {
        for ar in [
            vec![],
            vec![0.5],
            vec![-1.5365, -0.75056],
            vec![0.2, 0.1, -0.3],
        ] {
            let sensor = Sensor::from_ar(ar).unwrap();
            let white: Vec<f64> = (0..50).map(|i| f64::from(i * 37 % 11) - 5.0).collect();
            let mut batch = white.clone();
            sensor.colour(&mut batch);
            let mut record: Vec<f64> = Vec::new();
            for innovation in white {
                record.push(sensor.step(&record, innovation));
            }
            for (a, b) in batch.iter().zip(&record) {
                assert!((a - b).abs() < 1e-12, "{a} {b}");
            }
        }
    }

    /// |pole|² = 0.75056, so the deficit falls by that factor a sample: 1e-9 takes about 72.
    #[test]
    fn burn_in_follows_from_the_poles() {
        let burn_in = Sensor::adxl105().burn_in();
        assert!((68..78).contains(&burn_in), "{burn_in}");
        assert_eq!(Sensor::from_ar(vec![]).unwrap().burn_in(), 0);
        assert!(Sensor::from_ar(vec![0.999]).unwrap().burn_in() > 10_000);
    }

    /// The start of a stationary record in closed form, as its response to each innovation alone: the
    /// covariances of the first samples are the autocovariances that the recursion keeps, at every lag
    /// r_k = Σ φ_p r_{k−p}, and at lag 0 with one more for the innovation.
    #[test]
    fn stationary_start_has_the_autocovariances() {
        for ar in [
            vec![],
            vec![0.5],
            vec![-1.5365, -0.75056],
            vec![0.2, 0.1, -0.3],
        ] {
            let sensor = Sensor::from_ar(ar.clone()).unwrap();
            let length = 8;
            let response = |innovation: usize| {
                let mut record = vec![0.0; length];
                record[innovation] = 1.0;
                sensor.colour_stationary(&mut record);
                record
            };
            let responses: Vec<Vec<f64>> = (0..length).map(response).collect();
            let covariance = |i: usize, j: usize| -> f64 {
                responses
                    .iter()
                    .map(|response| response[i] * response[j])
                    .sum()
            };
            for i in 0..length {
                for j in 0..=i {
                    let lag = i - j;
                    assert!(
                        (covariance(i, j) - covariance(lag, 0)).abs() < 1e-12,
                        "{ar:?}"
                    );
                    let predicted: f64 = (1..=ar.len())
                        .map(|p| ar[p - 1] * covariance(lag.abs_diff(p), 0))
                        .sum();
                    let innovation = if lag == 0 { 1.0 } else { 0.0 };
                    assert!(
                        (covariance(i, j) - predicted - innovation).abs() < 1e-12,
                        "{ar:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn refusals() {
        let unstable = |ar: &[f64]| Sensor::from_ar(ar.to_vec()).unwrap_err();
        assert!(matches!(
            unstable(&[1.0]),
            SensorError::Unstable { index: 1, .. }
        ));
        assert!(matches!(
            unstable(&[0.0, -1.2]),
            SensorError::Unstable { index: 2, .. }
        ));
        assert!(matches!(
            unstable(&[2.0, -0.5]),
            SensorError::Unstable { index: 1, .. }
        ));
        assert!(matches!(unstable(&[f64::NAN]), SensorError::NotFinite(_)));
        assert!(matches!(
            unstable(&[1.0 - 1e-9]),
            SensorError::BarelyStable { .. }
        ));
        let transfer = |a, b, c, period| Sensor::from_transfer(Transfer { a, b, c, period });
        assert!(matches!(
            transfer(1.0, 4.0, 4.0, 1.0),
            Err(SensorError::RealPoles { .. })
        ));
        assert!(matches!(
            transfer(1.0, -0.1, 4.0, 1.0),
            Err(SensorError::Unstable { .. })
        ));
        assert!(matches!(
            transfer(0.0, 1.0, 1.0, 1.0),
            Err(SensorError::NotPositive { name: "a", .. })
        ));
    }
}
