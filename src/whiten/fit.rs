//! Fitting the filter's coefficients: least squares, Yule–Walker, Burg.

use super::normal_equations::{covariances, lagged_product, solve_normal_equations};
use super::schwarz::Schwarz;
use super::{Fit, Order, Whitening};
use crate::simd::Value;

#[cfg(test)]
mod tests;

/// Fits coefficients without allocating: a [`Whitening`] with its scratch space.
#[derive(Clone, Debug)]
pub struct Fitter<V: Value = f64> {
    whitening: Whitening,
    coefficients: Vec<V>,
    products: Vec<V>,
    /// The choice of order, if each trial makes one.
    choice: Option<Schwarz>,
    solver: Solver,
}

/// Solves for the coefficients of one trial at a time.
#[derive(Clone, Debug)]
struct Solver {
    coefficients: Vec<f64>,
    forward: Vec<f64>,
    backward: Vec<f64>,
    scratch: Vec<f64>,
    normal: Vec<f64>,
}

impl<V: Value> Fitter<V> {
    /// A fitter for a sensor with the autoregression `known`.
    pub fn new(whitening: Whitening, known: &[f64]) -> Self {
        let order = whitening.highest_order();
        let mut coefficients = vec![V::default(); order];
        if whitening.fit == Fit::Known {
            for (coefficient, known) in coefficients.iter_mut().zip(known) {
                coefficient.lanes_mut().fill(*known);
            }
        }
        Self {
            whitening,
            coefficients,
            products: vec![V::default(); (order + 1) * (order + 1)],
            choice: (whitening.order == Order::Auto)
                .then(|| Schwarz::new(whitening.training, order)),
            solver: Solver {
                coefficients: vec![0.0; order],
                forward: vec![0.0; whitening.training],
                backward: vec![0.0; whitening.training],
                scratch: vec![0.0; order + 1],
                normal: vec![0.0; (order + 1) * (order + 1)],
            },
        }
    }

    /// a_1 … a_m for this training record. A record that determines fewer than m coefficients (a
    /// constant one, say) gets zeros for the rest, as does one whose chosen order is lower.
    #[inline(always)]
    pub fn fit(&mut self, training: &[V]) -> &[V] {
        if matches!(self.whitening.fit, Fit::Known | Fit::None) {
            return &self.coefficients;
        }
        let mut mean = sum(training);
        let length = training.len() as f64;
        mean.lanes_mut().iter_mut().for_each(|sum| *sum /= length);
        if self.whitening.fit == Fit::LeastSquares || self.choice.is_some() {
            let order = self.coefficients.len();
            covariances(training, mean, order, &mut self.products);
        }
        for lane in 0..mean.lanes().len() {
            if let Some(choice) = &mut self.choice {
                let order = choice.order_in(lane, training, &self.products);
                self.solver.coefficients.resize(order, 0.0);
                for beyond in &mut self.coefficients[order..] {
                    beyond.lanes_mut()[lane] = 0.0;
                }
            }
            self.solve(training, mean, lane);
        }
        &self.coefficients
    }

    fn solve(&mut self, training: &[V], mean: V, lane: usize) {
        let solver = &mut self.solver;
        let by_products = self.whitening.fit == Fit::LeastSquares && self.choice.is_none();
        if by_products {
            let products = self.products.iter().map(|product| product.lanes()[lane]);
            (solver.normal.iter_mut().zip(products)).for_each(|(to, product)| *to = product);
        } else {
            for (centred, x) in solver.forward.iter_mut().zip(training) {
                *centred = x.lanes()[lane] - mean.lanes()[lane];
            }
        }
        match self.whitening.fit {
            Fit::Known | Fit::None => {}
            Fit::LeastSquares if by_products => solver.least_squares(),
            Fit::LeastSquares => solver.least_squares_of_record(),
            Fit::YuleWalker => solver.yule_walker(),
            Fit::Burg => solver.burg(),
        }
        for (all, one) in self.coefficients.iter_mut().zip(&solver.coefficients) {
            all.lanes_mut()[lane] = *one;
        }
    }
}

impl Solver {
    /// Solves Σ_k c_jk a_k = c_j0, c_jk = Σ_{i=m}^{L−1} x_{i−j} x_{i−k}.
    fn least_squares(&mut self) {
        solve_normal_equations(&mut self.normal, &mut self.scratch, &mut self.coefficients);
    }

    /// The same from the record in `forward`, since products for a higher order leave out its first samples.
    fn least_squares_of_record(&mut self) {
        let order = self.coefficients.len();
        covariances(&self.forward, 0.0, order, &mut self.normal);
        self.least_squares();
    }

    /// Levinson's recursion on r_k = Σ x_i x_{i−k}.
    fn yule_walker(&mut self) {
        let order = self.coefficients.len();
        let correlation = &mut self.normal[..=order];
        for (lag, r) in correlation.iter_mut().enumerate() {
            *r = lagged_product(&self.forward, 0.0, lag, lag..self.forward.len());
        }
        self.coefficients.fill(0.0);
        let mut error = correlation[0];
        for m in 0..order {
            if error <= 0.0 {
                return;
            }
            let predicted: f64 = (0..m)
                .map(|p| self.coefficients[p] * correlation[m - p])
                .sum();
            let reflection = (correlation[m + 1] - predicted) / error;
            extend(&mut self.coefficients, &mut self.scratch, m, reflection);
            error *= 1.0 - reflection * reflection;
        }
    }

    /// Burg's recursion on forward (`forward`) and backward errors.
    fn burg(&mut self) {
        let length = self.forward.len();
        self.backward.copy_from_slice(&self.forward);
        self.coefficients.fill(0.0);
        for m in 0..self.coefficients.len() {
            let (mut product, mut energy) = (0.0, 0.0);
            for i in m + 1..length {
                let (f, b) = (self.forward[i], self.backward[i - 1]);
                product += f * b;
                energy += f * f + b * b;
            }
            if energy <= 0.0 {
                return;
            }
            let reflection = 2.0 * product / energy;
            extend(&mut self.coefficients, &mut self.scratch, m, reflection);
            for i in (m + 1..length).rev() {
                let (f, b) = (self.forward[i], self.backward[i - 1]);
                self.forward[i] = f - reflection * b;
                self.backward[i] = b - reflection * f;
            }
        }
    }
}

/// From order m to m + 1: a_p ← a_p − k a_{m+1−p}, a_{m+1} = k.
fn extend(coefficients: &mut [f64], scratch: &mut [f64], m: usize, reflection: f64) {
    scratch[..m].copy_from_slice(&coefficients[..m]);
    for p in 0..m {
        coefficients[p] -= reflection * scratch[m - 1 - p];
    }
    coefficients[m] = reflection;
}

/// Σ x_i in four independent sums, so that additions can overlap.
#[inline(always)]
fn sum<V: Value>(x: &[V]) -> V {
    let (fours, rest) = x.as_chunks::<4>();
    let mut sums = [V::default(); 4];
    for four in fours {
        for (sum, x) in sums.iter_mut().zip(four) {
            *sum = *sum + *x;
        }
    }
    for x in rest {
        sums[0] = sums[0] + *x;
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3])
}
