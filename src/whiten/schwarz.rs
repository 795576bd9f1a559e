//! The order of the filter by Schwarz's criterion [^1]: the m that makes n ln σ̂²_m + m ln n least.
//!
//! σ̂²_m is the mean square error of the least-squares filter of order m over the samples from the highest
//! order on, the same n for every order, so that the criteria can be compared: one matrix of products serves
//! all, order m has its leading block. The filter of the chosen order is then fitted to the whole record as
//! anywhere else. Order 0 is a filter without coefficients, which changes nothing.
//!
//! On a record of white noise a useless coefficient is let in where its likelihood ratio, χ²₁, exceeds
//! ln n: in 1 % of records of 1000 samples.
//!
//! [^1]: G. Schwarz, "Estimating the dimension of a model", Ann. Statist. 6, 1978.

use super::fit::{covariances, solve_normal_equations};
use super::{Fit, Fitter, Whitening};
use crate::simd::Value;
use libm::log;

/// The filter of the order that a record asks for.
#[derive(Clone, Debug, PartialEq)]
pub struct Chosen {
    /// a_1 … a_m; none where the record looks white.
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
        /// What it needs.
        needed: usize,
        /// What there is.
        samples: usize,
    },
}

/// Samples for each coefficient of the highest order, below which the likelihood ratio is far from its
/// limit law and the criterion adds coefficients as it likes.
pub const SAMPLES_PER_COEFFICIENT: usize = 5;

impl Chosen {
    /// The best of the orders 0 … `most` for this record of rest, its coefficients by `fit`.
    ///
    /// # Errors
    /// Where the record has fewer than five samples per coefficient of the highest order.
    pub fn new(record: &[f64], most: usize, by: Fit) -> Result<Self, OrderError> {
        let needed = SAMPLES_PER_COEFFICIENT * most.max(1);
        if record.len() < needed {
            return Err(OrderError::TooShort {
                most,
                needed,
                samples: record.len(),
            });
        }
        // The mean of equal samples may miss them by a rounding, which is no noise to whiten.
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

/// a_1 … a_m of the filter of order `order` for this record of rest; none of order 0. The record must be long
/// enough for the fit.
pub fn coefficients(record: &[f64], order: usize, by: Fit) -> Vec<f64> {
    if order == 0 {
        return Vec::new();
    }
    let whitening = Whitening::new(order, by, record.len(), false, 0)
        .expect("the record is long enough for the fit");
    Fitter::new(whitening, &[]).fit(record).to_vec()
}

/// Chooses the order of one record after the other, without allocating.
#[derive(Clone, Debug)]
pub(super) struct Schwarz {
    /// c_jk for j, k = 0 … the highest order, row by row: to be filled in.
    pub products: Vec<f64>,
    /// Samples that every order is compared on.
    samples: f64,
    criteria: Vec<f64>,
    block: Vec<f64>,
    diagonal: Vec<f64>,
    coefficients: Vec<f64>,
}

impl Schwarz {
    /// For records of `length` samples and the orders 0 … `most`.
    pub fn new(length: usize, most: usize) -> Self {
        let size = (most + 1) * (most + 1);
        Self {
            products: vec![0.0; size],
            samples: (length - most) as f64,
            criteria: vec![0.0; most + 1],
            block: Vec::with_capacity(size),
            diagonal: vec![0.0; most + 1],
            coefficients: vec![0.0; most],
        }
    }

    /// The order that the record of the trial in `lane` asks for.
    pub fn order_in<V: Value>(&mut self, lane: usize, record: &[V], products: &[V]) -> usize {
        // Around the mean of equal samples there may be roundings, which are no noise to whiten.
        if is_constant(record.iter().map(|x| &x.lanes()[lane])) {
            return 0;
        }
        for (to, product) in self.products.iter_mut().zip(products) {
            *to = product.lanes()[lane];
        }
        self.order()
    }

    /// The order that the products ask for, the lowest of equals.
    pub fn order(&mut self) -> usize {
        let mut best = 0;
        for order in 0..self.criteria.len() {
            self.criteria[order] = self.criterion(order);
            if self.criteria[order] < self.criteria[best] {
                best = order;
            }
        }
        best
    }

    fn criterion(&mut self, order: usize) -> f64 {
        let variance = self.residual_energy(order) / self.samples;
        self.samples * log(variance) + order as f64 * log(self.samples)
    }

    /// c_00 − Σ a_k c_0k of the filter of order `order`, which the leading block of the products determines.
    fn residual_energy(&mut self, order: usize) -> f64 {
        let rows = self.products.chunks(self.criteria.len()).take(order + 1);
        self.block.clear();
        self.block.extend(rows.flat_map(|row| &row[..=order]));
        let coefficients = &mut self.coefficients[..order];
        solve_normal_equations(&mut self.block, &mut self.diagonal, coefficients);
        let explained: f64 = (coefficients.iter().zip(&self.products[1..]))
            .map(|(a, c)| *a * c)
            .sum();
        // Where nothing is left, rounding may have taken more.
        (self.products[0] - explained).max(0.0)
    }
}

/// Whether all values are equal.
pub(super) fn is_constant<'a>(mut values: impl Iterator<Item = &'a f64>) -> bool {
    let first = values.next();
    values.all(|value| Some(value) == first)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::binomial;
    use crate::whiten::{tests, whiten};

    fn record(ar: &[f64], samples: usize, index: u64) -> Vec<f64> {
        tests::record(ar, samples, 2014, index)
    }

    /// Filters run over the common samples: none leaves less than the criterion says, and the one fitted to
    /// these samples no more, but for the mean of the few before them: 0.01 of some hundreds here.
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

    /// The true order is found in 95 % of records or more: at 95 % exactly, as few hits as this bound lets
    /// through happen once in three million, three times.
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
