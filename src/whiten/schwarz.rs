//! The order of the filter by Schwarz's criterion (BIC) [^1]: the m that minimises n ln σ̂²_m + m ln n.
//!
//! σ̂²_m is the mean square error of the least-squares filter of order m over the samples from the highest
//! order on, the same n for every order, so that the criteria can be compared. One matrix of products serves
//! all orders: order m uses its leading block. The filter of the chosen order is then fitted to the whole
//! record. Order 0 is a filter without coefficients, which changes nothing.
//!
//! On white noise a useless coefficient is accepted if its likelihood ratio, χ²₁, exceeds ln n: in 1 % of
//! records of 1000 samples.
//!
//! [^1]: G. Schwarz, "Estimating the dimension of a model", Ann. Statist. 6, 1978.

use super::normal_equations::solve_normal_equations;
use crate::simd::Value;
use libm::log;

/// Chooses the order of one record after the other, without allocating.
#[derive(Clone, Debug)]
pub(super) struct Schwarz {
    /// c_jk for j, k = 0 … the highest order, row by row; to be set before [`Schwarz::order`].
    pub products: Vec<f64>,
    /// Samples that every order is compared on.
    samples: f64,
    /// The criterion of each order from 0 on.
    pub criteria: Vec<f64>,
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

    /// Chooses the order for the record of the trial in `lane`.
    pub fn order_in<V: Value>(&mut self, lane: usize, record: &[V], products: &[V]) -> usize {
        // Rounding may separate equal samples from their mean, and that difference is not noise to whiten.
        if is_constant(record.iter().map(|x| &x.lanes()[lane])) {
            return 0;
        }
        for (to, product) in self.products.iter_mut().zip(products) {
            *to = product.lanes()[lane];
        }
        self.order()
    }

    /// Chooses the order by the products, the lowest in a tie.
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
        // The solver works in place, so it gets a copy of the block.
        self.block.clear();
        self.block.extend(rows.flat_map(|row| &row[..=order]));
        let coefficients = &mut self.coefficients[..order];
        solve_normal_equations(&mut self.block, &mut self.diagonal, coefficients);
        let explained: f64 = (coefficients.iter().zip(&self.products[1..]))
            .map(|(a, c)| *a * c)
            .sum();
        // Rounding may make the residual of a perfect fit negative.
        (self.products[0] - explained).max(0.0)
    }
}

/// Whether all values are equal.
pub(super) fn is_constant<'a>(mut values: impl Iterator<Item = &'a f64>) -> bool {
    let first = values.next();
    values.all(|value| Some(value) == first)
}
