//! A filter whose order is chosen on a record of rest, and one of a given order.

use super::fit::Fitter;
use super::normal_equations::covariances;
use super::order::SAMPLES_PER_COEFFICIENT;
use super::schwarz::{Schwarz, is_constant};
use super::{Fit, Whitening};

/// A filter whose order was chosen on its record.
#[derive(Clone, Debug, PartialEq)]
pub struct Chosen {
    /// a_1 … a_m; empty if the record looks white.
    pub coefficients: Vec<f64>,
    /// The criterion of each order from 0 on.
    pub criteria: Vec<f64>,
}

/// Why no order could be chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum OrderError {
    /// Not enough samples for the highest order.
    #[error(
        "training: a choice among orders up to {most} needs at least {needed} samples, got {samples} \
         (train on a longer rest, or lower the highest order)"
    )]
    TooShort {
        /// The highest order.
        most: usize,
        /// The samples needed.
        needed: usize,
        /// The samples available.
        samples: usize,
    },
}

impl Chosen {
    /// Chooses among the orders 0 … `most` for this record of rest and fits the coefficients by `by`.
    ///
    /// # Errors
    /// If the record has fewer than five samples per coefficient of the highest order.
    pub fn new(record: &[f64], most: usize, by: Fit) -> Result<Self, OrderError> {
        let needed = SAMPLES_PER_COEFFICIENT * most.max(1);
        if record.len() < needed {
            return Err(OrderError::TooShort {
                most,
                needed,
                samples: record.len(),
            });
        }
        // Rounding may separate equal samples from their mean, and that difference is not noise to whiten.
        let mean = if is_constant(record.iter()) {
            record[0]
        } else {
            record.iter().sum::<f64>() / record.len() as f64
        };
        let mut schwarz = Schwarz::new(record.len(), most);
        covariances(record, mean, most, &mut schwarz.products);
        let order = schwarz.order();
        Ok(Self {
            coefficients: coefficients(record, order, by),
            criteria: schwarz.criteria,
        })
    }

    /// m.
    pub fn order(&self) -> usize {
        self.coefficients.len()
    }
}

/// a_1 … a_m of the filter of order `order` for this record of rest; empty for order 0. The record must be
/// long enough for the fit.
pub fn coefficients(record: &[f64], order: usize, by: Fit) -> Vec<f64> {
    if order == 0 {
        return Vec::new();
    }
    let whitening = Whitening::new(order, by, record.len(), false, 0)
        .expect("the record is long enough for the fit");
    Fitter::new(whitening, &[]).fit(record).to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::binomial;
    use crate::whiten::{tests, whiten};

    fn record(ar: &[f64], samples: usize, index: u64) -> Vec<f64> {
        tests::record(ar, samples, 2014, index)
    }

    /// Filters run over the common samples: no filter leaves less than the criterion says, and the one fitted to
    /// these samples leaves no more, up to the mean of the few samples before them: 0.01 of some hundreds here.
    #[test]
    fn criteria_are_those_of_fitted_filters() {
        let record = record(&[0.6, -0.3], 300, 0);
        let most = 6;
        let mean = record.iter().sum::<f64>() / 300.0;
        let centred: Vec<f64> = record.iter().map(|x| x - mean).collect();
        let chosen = Chosen::new(&record, most, Fit::LeastSquares).unwrap();
        let naive = |coefficients: &[f64]| {
            let mut errors = vec![0.0; 300 - most];
            whiten(coefficients, &centred, most, &mut errors);
            let n = errors.len() as f64;
            let energy: f64 = errors.iter().map(|e| e * e).sum();
            n * (energy / n).ln() + coefficients.len() as f64 * n.ln()
        };
        for (order, criterion) in chosen.criteria.iter().enumerate() {
            let of_these = naive(&coefficients(
                &record[most - order..],
                order,
                Fit::LeastSquares,
            ));
            println!("order {order}: {criterion:.6} {of_these:.6}");
            assert!(of_these > criterion - 1e-9 && of_these < criterion + 0.01);
            assert!(naive(&coefficients(&record, order, Fit::LeastSquares)) > criterion - 1e-9);
        }
        assert_eq!(
            chosen.coefficients,
            coefficients(&record, chosen.order(), Fit::LeastSquares)
        );
    }

    /// The true order is found in at least 95 % of records: at exactly 95 %, each of the three checks fails with
    /// probability 3e-7.
    #[test]
    fn finds_the_order() {
        let (trials, samples) = (300, 1000);
        let ars: [&[f64]; 3] = [&[], &[-1.5365, -0.75056], &[0.5, -0.2, 0.1, 0.0, 0.3]];
        for ar in ars {
            let found = |index| {
                let record = record(ar, samples, index);
                Chosen::new(&record, 20, Fit::LeastSquares).unwrap().order() == ar.len()
            };
            let hits = (0..trials).filter(|index| found(*index)).count() as u64;
            let p = binomial::lower_tail(hits, trials, 0.95);
            println!("order {}: {hits}/{trials}, p = {p:.3e}", ar.len());
            assert!(p > 3e-7);
        }
    }

    #[test]
    fn degenerate_records_have_an_order() {
        let constant = Chosen::new(&[0.1; 100], 5, Fit::LeastSquares).unwrap();
        assert_eq!(constant.order(), 0);
        let alternating: Vec<f64> = (0..100).map(|i| f64::from(i % 2)).collect();
        let alternating = Chosen::new(&alternating, 5, Fit::LeastSquares).unwrap();
        assert!(alternating.order() >= 1);
        assert!((alternating.coefficients[0] + 1.0).abs() < 1e-9);
        let record = record(&[], 10, 0);
        assert_eq!(
            Chosen::new(&record, 0, Fit::LeastSquares).unwrap().order(),
            0
        );
    }

    #[test]
    fn refusals() {
        let refused = Chosen::new(&[0.0; 99], 20, Fit::LeastSquares).unwrap_err();
        assert!(refused.to_string().contains("at least 100 samples, got 99"));
        assert!(Chosen::new(&[], 0, Fit::LeastSquares).is_err());
    }
}
