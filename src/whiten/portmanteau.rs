//! The portmanteau test of Ljung and Box [^1] for residual colour after a filter.
//!
//! Q = n(n + 2) Σ_{k=1}^{h} ρ_k²/(n − k) over the correlations of n residuals of a filter of order m is
//! nearly χ² with h − m degrees of freedom if they are white. Many lags dilute a lack of fit, few miss it,
//! and the law needs n ≫ h. Here h = m + 20, and at most a fifth of the residuals.
//!
//! [^1]: G. M. Ljung, G. E. P. Box, "On a measure of lack of fit in time series models", Biometrika 65, 1978.

use crate::stats::chi_squared;

/// The result of the test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LjungBox {
    /// h.
    pub lags: usize,
    /// h − m.
    pub degrees: usize,
    /// Q.
    pub statistic: f64,
    /// The probability of a Q at least as large for white residuals.
    pub p_value: f64,
}

/// Why residuals could not be tested.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PortmanteauError {
    /// Too few lags beyond the order, or too few residuals for them.
    #[error(
        "ljung-box: lags must exceed the order {order} and stay below the {residuals} residuals, got {lags} \
         (give more residuals)"
    )]
    Lags {
        /// m.
        order: usize,
        /// n.
        residuals: usize,
        /// h.
        lags: usize,
    },
    /// Residuals without variance have no correlations.
    #[error("ljung-box: residuals must differ, got {0} equal ones")]
    Constant(usize),
}

/// Lags beyond the order of the filter.
const LAGS_BEYOND_ORDER: usize = 20;

impl LjungBox {
    /// Tests residuals of a filter of order `order`, by as many lags as their number allows.
    ///
    /// # Errors
    /// If the order is at least a fifth of the number of residuals, or all residuals are equal.
    pub fn of_residuals(residuals: &[f64], order: usize) -> Result<Self, PortmanteauError> {
        let lags = (order + LAGS_BEYOND_ORDER).min(residuals.len() / 5);
        Self::new(residuals, order, lags)
    }

    /// Tests residuals of a filter of order `order` by their first `lags` correlations.
    ///
    /// # Errors
    /// If `lags` is not between the order and the number of residuals, or all residuals are equal.
    pub fn new(residuals: &[f64], order: usize, lags: usize) -> Result<Self, PortmanteauError> {
        let length = residuals.len();
        if !(lags > order && lags < length) {
            return Err(PortmanteauError::Lags {
                order,
                residuals: length,
                lags,
            });
        }
        let n = length as f64;
        let mean = residuals.iter().sum::<f64>() / n;
        let centred: Vec<f64> = residuals.iter().map(|e| e - mean).collect();
        let covariance = |lag: usize| -> f64 {
            let pairs = centred[lag..].iter().zip(&centred);
            pairs.map(|(a, b)| a * b).sum()
        };
        if residuals.iter().all(|e| *e == residuals[0]) {
            return Err(PortmanteauError::Constant(length));
        }
        let variance = covariance(0);
        let sum: f64 = (1..=lags)
            .map(|lag| {
                let rho = covariance(lag) / variance;
                rho * rho / (n - lag as f64)
            })
            .sum();
        let statistic = n * (n + 2.0) * sum;
        let degrees = lags - order;
        Ok(Self {
            lags,
            degrees,
            statistic,
            p_value: chi_squared::upper_tail(statistic, degrees),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::binomial;
    use crate::whiten::{Chosen, Fit, Fitter, Whitening, tests, whiten};

    fn record(ar: &[f64], samples: usize, index: u64) -> Vec<f64> {
        tests::record(ar, samples, 2015, index)
    }

    /// Tests the residuals of a record whitened by a filter with these coefficients.
    fn of_filter(coefficients: &[f64], record: &[f64]) -> Result<LjungBox, PortmanteauError> {
        let order = coefficients.len();
        let mut residuals = vec![0.0; record.len().saturating_sub(order)];
        if !residuals.is_empty() {
            whiten(coefficients, record, order, &mut residuals);
        }
        LjungBox::of_residuals(&residuals, order)
    }

    /// By the definition in numpy 2, the tail by scipy's chi2.sf.
    #[test]
    fn agrees_with_numpy_and_scipy() {
        let residuals = [1.0, 3.0, 2.0, 5.0, 4.0, 4.0, 2.0, 1.0, 3.0, 6.0, 5.0, 2.0];
        for (order, p_value) in [(0, 0.09561380490995502), (1, 0.04829634087735252)] {
            let test = LjungBox::new(&residuals, order, 4).unwrap();
            assert!((test.statistic - 7.892043206971879).abs() < 1e-13);
            assert!((test.p_value - p_value).abs() < 1e-14, "{test:?}");
            assert_eq!((test.lags, test.degrees), (4, 4 - order));
        }
    }

    /// How often the test rejects at .05 in `trials` records, and the two-sided exact p-value of that.
    fn rejections(trials: u64, p_value: impl Fn(u64) -> f64) -> (u64, f64) {
        let hits = (0..trials).filter(|index| p_value(*index) < 0.05).count() as u64;
        let low = binomial::lower_tail(hits, trials, 0.05);
        (
            hits,
            2.0 * low.min(binomial::upper_tail(hits, trials, 0.05)),
        )
    }

    /// White residuals, and those of a filter of the right order. If χ² were exact at n = 2000, each check would
    /// fail with probability 1e-6.
    #[test]
    fn holds_its_level() {
        let n = 2000;
        let white = |index| {
            let test = of_filter(&[], &record(&[], n, index));
            test.unwrap().p_value
        };
        let fitted = |index| {
            let record = record(&[-1.5365, -0.75056], n, index);
            let whitening = Whitening::new(2, Fit::LeastSquares, n, false, 2).unwrap();
            let mut fitter = Fitter::new(whitening, &[]);
            let test = of_filter(fitter.fit(&record), &record);
            test.unwrap().p_value
        };
        for (name, (hits, p)) in [
            ("white", rejections(1000, white)),
            ("fitted", rejections(1000, fitted)),
        ] {
            println!("{name}: {hits}/1000 at .05, p = {p:.3}");
            assert!(p > 5e-7);
        }
    }

    #[test]
    fn sees_what_a_short_filter_leaves() {
        let record = record(&[-1.5365, -0.75056], 500, 0);
        let test = of_filter(&[], &record).unwrap();
        assert!(test.p_value < 1e-12, "{test:?}");
        let chosen = Chosen::new(&record, 10, Fit::LeastSquares).unwrap();
        let test = of_filter(&chosen.coefficients, &record).unwrap();
        assert_eq!((chosen.order(), test.lags, test.degrees), (2, 22, 20));
        assert!(test.p_value > 1e-3, "{test:?}");
    }

    #[test]
    fn refusals() {
        let new = |residuals: &[f64], order, lags| LjungBox::new(residuals, order, lags);
        assert!(new(&[1.0, 2.0, 3.0], 1, 1).is_err());
        assert!(new(&[1.0, 2.0, 3.0], 1, 3).is_err());
        assert_eq!(new(&[0.1; 9], 0, 3), Err(PortmanteauError::Constant(9)));
        let short = of_filter(&[0.5], &[1.0]).unwrap_err();
        assert!(short.to_string().contains("the 0 residuals, got 0"));
    }
}
