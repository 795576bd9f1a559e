//! Powers of a chain's matrix, by repeated squaring: P(no alarm in n steps) for any n, and its quantiles.

use std::cell::RefCell;

/// A square matrix A, and A², A⁴, A⁸ … as far as they were asked for.
#[derive(Clone, Debug)]
pub(super) struct Powers {
    size: usize,
    squares: RefCell<Vec<Vec<f64>>>,
}

impl Powers {
    /// Of a matrix row by row.
    pub fn new(size: usize, matrix: Vec<f64>) -> Self {
        Self {
            size,
            squares: RefCell::new(vec![matrix]),
        }
    }

    /// The row vector of state 0.
    pub fn start(&self) -> Vec<f64> {
        let mut start = vec![0.0; self.size];
        start[0] = 1.0;
        start
    }

    /// row · A^(2^`exponent`).
    pub fn advance(&self, row: &[f64], exponent: usize) -> Vec<f64> {
        let mut squares = self.squares.borrow_mut();
        while squares.len() <= exponent {
            let last = squares.last().expect("there is the matrix itself");
            let square = last.chunks_exact(self.size);
            let square = square.flat_map(|row| self.times(row, last)).collect();
            squares.push(square);
        }
        self.times(row, &squares[exponent])
    }

    fn times(&self, row: &[f64], matrix: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; self.size];
        for (factor, from) in row.iter().zip(matrix.chunks_exact(self.size)) {
            if *factor != 0.0 {
                let each = product.iter_mut().zip(from);
                each.for_each(|(sum, to)| *sum += factor * to);
            }
        }
        product
    }
}
