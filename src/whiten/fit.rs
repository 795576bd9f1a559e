//! Fitting the filter's coefficients: least squares, Yule–Walker, Burg.

use super::order::Schwarz;
use super::{Fit, Order, Whitening};
use crate::simd::Value;
use std::ops::Range;

/// Fits coefficients without allocating: a [`Whitening`] with its scratch space.
#[derive(Clone, Debug)]
pub struct Fitter<V: Value = f64> {
    whitening: Whitening,
    coefficients: Vec<V>,
    products: Vec<V>,
    /// Where each trial chooses its order.
    choice: Option<Schwarz>,
    solver: Solver,
}

/// Solves for one trial after the other.
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
        let centred = training
            .iter()
            .map(|x| x.lanes()[lane] - mean.lanes()[lane]);
        let centre =
            |forward: &mut [f64]| forward.iter_mut().zip(centred).for_each(|(f, x)| *f = x);
        match self.whitening.fit {
            Fit::Known | Fit::None => {}
            Fit::LeastSquares if self.choice.is_some() => {
                centre(&mut solver.forward);
                solver.least_squares_of_record();
            }
            Fit::LeastSquares => {
                let products = self.products.iter().map(|product| product.lanes()[lane]);
                (solver.normal.iter_mut().zip(products)).for_each(|(to, product)| *to = product);
                solver.least_squares();
            }
            Fit::YuleWalker => {
                centre(&mut solver.forward);
                solver.yule_walker();
            }
            Fit::Burg => {
                centre(&mut solver.forward);
                solver.burg();
            }
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

    /// The same from the record in `forward`: products of a higher order leave out its first samples.
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

/// Σ x_i in four sums that need not wait for each other.
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

/// Σ (x_i − mean)(x_{i−lag} − mean) over `range`, in four sums that need not wait for each other.
#[inline(always)]
fn lagged_product<V: Value>(x: &[V], mean: V, lag: usize, range: Range<usize>) -> V {
    let late = &x[range.clone()];
    let early = &x[range.start - lag..range.end - lag];
    let (late, last) = late.as_chunks::<4>();
    let (early, first) = early.as_chunks::<4>();
    let mut sums = [V::default(); 4];
    for (late, early) in late.iter().zip(early) {
        for (sum, (a, b)) in sums.iter_mut().zip(late.iter().zip(early)) {
            *sum = *sum + (*a - mean) * (*b - mean);
        }
    }
    for (a, b) in last.iter().zip(first) {
        sums[0] = sums[0] + (*a - mean) * (*b - mean);
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3])
}

/// c_jk for j, k = 0…m, row by row. Products of one lag share the middle of the record and differ
/// only at its ends, so that m + 1 sums over the record serve all of them, and nothing is subtracted.
#[inline(always)]
pub(super) fn covariances<V: Value>(x: &[V], mean: V, order: usize, products: &mut [V]) {
    let length = x.len();
    for lag in 0..=order {
        let middle = lagged_product(x, mean, lag, order..length - order);
        for j in 0..=order - lag {
            let head = lagged_product(x, mean, lag, order - j..order);
            let tail = lagged_product(x, mean, lag, length - order..length - j);
            let sum = head + middle + tail;
            let k = j + lag;
            products[j * (order + 1) + k] = sum;
            products[k * (order + 1) + j] = sum;
        }
    }
}

/// Solves Σ_k c_jk a_k = c_j0 for j, k = 1…m by elimination in place. The matrix is positive
/// semidefinite, so no row needs exchanging; a pivot that rounding has swallowed (below 1e-14 of
/// what stood there) drops its coefficient.
pub(super) fn solve_normal_equations(
    normal: &mut [f64],
    diagonal: &mut [f64],
    solution: &mut [f64],
) {
    let order = solution.len();
    let at = |row: usize, column: usize| row * (order + 1) + column;
    for k in 0..=order {
        diagonal[k] = normal[at(k, k)];
    }
    for k in 1..=order {
        let pivot = normal[at(k, k)];
        if pivot <= 1e-14 * diagonal[k] {
            normal[at(k, k)] = 0.0;
            continue;
        }
        for j in k + 1..=order {
            let factor = normal[at(j, k)] / pivot;
            normal[at(j, 0)] -= factor * normal[at(k, 0)];
            for i in k..=order {
                normal[at(j, i)] -= factor * normal[at(k, i)];
            }
        }
    }
    for k in (1..=order).rev() {
        let pivot = normal[at(k, k)];
        let known: f64 = (k + 1..=order)
            .map(|i| normal[at(k, i)] * solution[i - 1])
            .sum();
        solution[k - 1] = match pivot > 0.0 {
            true => (normal[at(k, 0)] - known) / pivot,
            false => 0.0,
        };
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Chosen, WhiteningError, step, whiten};
    use super::*;
    use crate::rng::Stream;
    use crate::signal::{Law, Noise, Sensor};
    use crate::simd::{LANES, Wide};

    fn record(ar: &[f64], length: usize, position: u64) -> Vec<f64> {
        let sensor = Sensor::from_ar(ar.to_vec()).unwrap();
        let mut record = vec![0.0; length + sensor.burn_in()];
        let mut generator = Stream::new(2014, "whiten", "test").at(position);
        Noise::new(Law::Normal)
            .unwrap()
            .fill(&mut generator, &mut record);
        sensor.colour(&mut record);
        record.split_off(sensor.burn_in())
    }

    fn fit(fit: Fit, order: usize, training: &[f64]) -> Vec<f64> {
        let whitening = Whitening::new(order, fit, training.len(), false, 2).unwrap();
        Fitter::new(whitening, &[]).fit(training).to_vec()
    }

    const FITS: [Fit; 3] = [Fit::LeastSquares, Fit::YuleWalker, Fit::Burg];

    /// Estimates of φ are asymptotically normal with covariance (1 − φ₂²)/n and correlation
    /// ρ₁, here deviation 0.66/√n each; a bound of 6 deviations fails with probability 2e-9 a
    /// coefficient, 12 coefficients. The extra coefficients of a longer filter tend to zero.
    #[test]
    fn recovers_known_coefficients() {
        let n = 100_000;
        let training = record(&[-1.5365, -0.75056], n, 0);
        let bound = 6.0 / (n as f64).sqrt();
        for method in FITS {
            let short = fit(method, 2, &training);
            println!(
                "{method}: n = {n}, a = {short:?}, bound {:.5}",
                0.661 * bound
            );
            assert!((short[0] + 1.5365).abs() < 0.661 * bound);
            assert!((short[1] + 0.75056).abs() < 0.661 * bound);
            for extra in &fit(method, 4, &training)[2..] {
                assert!(extra.abs() < 2.0 * bound, "{method} {extra}");
            }
        }
    }

    /// The three differ by O(m/n) on one record.
    #[test]
    fn fits_agree_on_long_records() {
        let n = 100_000;
        let training = record(&[0.5, -0.3, 0.1], n, 1);
        let fits = FITS.map(|method| fit(method, 3, &training));
        for other in &fits[1..] {
            for (a, b) in fits[0].iter().zip(other) {
                assert!((a - b).abs() < 20.0 / n as f64, "{a} {b}");
            }
        }
    }

    /// Against the definition: the gradient of Σ_{i≥m} y_i² vanishes at the solution.
    #[test]
    fn least_squares_is_the_minimum() {
        for (order, length) in [(1, 3), (2, 5), (3, 12), (8, 40)] {
            let training = record(&[-1.5365, -0.75056], length, 2);
            let a = fit(Fit::LeastSquares, order, &training);
            let mean = training.iter().sum::<f64>() / length as f64;
            let x: Vec<f64> = training.iter().map(|x| x - mean).collect();
            let energy: f64 = x.iter().map(|x| x * x).sum();
            for p in 1..=order {
                let gradient: f64 = (order..length)
                    .map(|i| step(&a, &x[..i], x[i]) * x[i - p])
                    .sum();
                assert!(gradient.abs() < 1e-9 * energy, "{order} {p}: {gradient}");
            }
        }
    }

    /// Yule–Walker against its own equations, Burg against order 1 in closed form.
    #[test]
    fn recursions_solve_their_equations() {
        let training = record(&[-1.5365, -0.75056], 60, 3);
        let mean = training.iter().sum::<f64>() / 60.0;
        let x: Vec<f64> = training.iter().map(|x| x - mean).collect();
        let r = |k: usize| lagged_product(&x, 0.0, k, k..60);
        let a = fit(Fit::YuleWalker, 4, &training);
        for j in 1..=4usize {
            let sum: f64 = (1..=4usize).map(|k| a[k - 1] * r(j.abs_diff(k))).sum();
            assert!((sum - r(j)).abs() < 1e-10 * r(0), "{j}");
        }
        let burg = fit(Fit::Burg, 1, &training)[0];
        let energy = 2.0 * r(0) - x[0] * x[0] - x[59] * x[59];
        assert!((burg - 2.0 * r(1) / energy).abs() < 1e-14);
    }

    #[test]
    fn mean_does_not_reach_the_fit() {
        let training = record(&[0.5], 200, 4);
        let shifted: Vec<f64> = training.iter().map(|x| x + 1000.0).collect();
        for method in FITS {
            let (a, b) = (fit(method, 2, &training), fit(method, 2, &shifted));
            assert!((a[0] - b[0]).abs() < 1e-9 && (a[1] - b[1]).abs() < 1e-9);
        }
    }

    #[test]
    fn degenerate_records_get_finite_coefficients() {
        for training in [vec![3.0; 20], vec![0.0; 20], {
            let mut one = vec![0.0; 20];
            one[19] = 1.0;
            one
        }] {
            for method in FITS {
                assert!(fit(method, 4, &training).iter().all(|a| a.is_finite()));
            }
        }
    }

    #[test]
    fn step_and_batch_agree_and_whitening_undoes_colour() {
        let sensor = Sensor::adxl105();
        let white: Vec<f64> = (0..40).map(|i| f64::from(i * 29 % 13) - 6.0).collect();
        let mut coloured = white.clone();
        sensor.colour(&mut coloured);
        let mut whitened = vec![0.0; 40];
        whiten(sensor.ar(), &coloured, 0, &mut whitened);
        for i in 0..40 {
            assert!((whitened[i] - white[i]).abs() < 1e-12);
            assert_eq!(whitened[i], step(sensor.ar(), &coloured[..i], coloured[i]));
        }
    }

    /// An impulse becomes λ_i − Σ a_p λ_{i−p}: the sign that (9) prints is wrong.
    #[test]
    fn impulse_spreads_with_a_minus() {
        let mut whitened = [0.0; 4];
        whiten(
            &[-1.5365, -0.75056],
            &[1.0, 0.0, 0.0, 0.0],
            0,
            &mut whitened,
        );
        assert_eq!(whitened, [1.0, 1.5365, 0.75056, 0.0]);
        let mut step_response = [0.0; 5];
        whiten(&[-1.5365, -0.75056], &[1.0; 5], 0, &mut step_response);
        assert!((step_response[4] - Sensor::adxl105().step_gain()).abs() < 1e-15);
    }

    #[test]
    fn refusals() {
        let new = |order, fit, training| Whitening::new(order, fit, training, false, 2);
        assert_eq!(new(0, Fit::Burg, 10), Err(WhiteningError::NoOrder));
        assert!(new(2, Fit::LeastSquares, 4).is_err());
        assert!(new(2, Fit::LeastSquares, 5).is_ok());
        assert!(new(1, Fit::Known, 0).is_err());
        assert_eq!(new(2, Fit::Known, 256).unwrap().training(), 0);
        let auto = |fit, training| Whitening::new(Order::Auto, fit, training, false, 2);
        assert!(auto(Fit::Burg, 4).is_err());
        assert_eq!(auto(Fit::Burg, 5).unwrap().highest_order(), 1);
        for fit in [Fit::Known, Fit::None] {
            assert_eq!(auto(fit, 256), Err(WhiteningError::NothingToChoose(fit)));
        }
    }

    /// Side by side or alone, a record gets the filter of the order chosen for it, zeros behind.
    #[test]
    fn each_record_gets_the_order_chosen_for_it() {
        let records: [Vec<f64>; LANES] = std::array::from_fn(|lane| match lane {
            0 => vec![0.1; 60],
            1 => record(&[], 60, 10),
            2 => record(&[0.7], 60, 11),
            _ => record(&[-1.5365, -0.75056], 60, 9 + lane as u64),
        });
        let together: Vec<Wide> = (0..60)
            .map(|i| Wide(std::array::from_fn(|lane| records[lane][i])))
            .collect();
        for method in FITS {
            let auto = Whitening::new(Order::Auto, method, 60, false, 2).unwrap();
            let mut fitter = Fitter::<Wide>::new(auto, &[]);
            for _ in 0..2 {
                let fitted = fitter.fit(&together);
                for (lane, record) in records.iter().enumerate() {
                    let mut expected = Chosen::new(record, 8, method).unwrap().coefficients;
                    expected.resize(8, 0.0);
                    let got: Vec<f64> = fitted.iter().map(|a| a.0[lane]).collect();
                    assert_eq!(got, expected, "{method}, record {lane}");
                }
            }
        }
    }
}
