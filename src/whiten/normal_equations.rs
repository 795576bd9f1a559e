//! The normal equations of a filter's coefficients: Σ_k c_jk a_k = c_j0 for j, k = 1…m, with
//! c_jk = Σ_{i=m}^{L−1} x_{i−j} x_{i−k}.

use crate::simd::Value;
use std::ops::Range;

/// Σ (x_i − mean)(x_{i−lag} − mean) over `range`, in four independent sums, so that additions can overlap.
#[inline(always)]
pub fn lagged_product<V: Value>(x: &[V], mean: V, lag: usize, range: Range<usize>) -> V {
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
pub fn covariances<V: Value>(x: &[V], mean: V, order: usize, products: &mut [V]) {
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
/// semidefinite, so no pivoting is needed; a pivot lost to rounding (below 1e-14 of its original
/// diagonal element) sets its coefficient to zero.
pub fn solve_normal_equations(normal: &mut [f64], diagonal: &mut [f64], solution: &mut [f64]) {
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
        solution[k - 1] = if pivot > 0.0 {
            (normal[at(k, 0)] - known) / pivot
        } else {
            0.0
        };
    }
}
