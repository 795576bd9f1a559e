//! Powers of a chain's matrix, by repeated squaring: P(an alarm within n steps) for any n, with all its digits.
//!
//! Aⁿ 1 = 1 − lₙ. The losses l begin as the alarms of one step and add up, l₂ₙ = lₙ + Aⁿ lₙ, so that rare ones are not the
//! small differences of large numbers. Every square is given the sums of its rows, 1 − l₂ₙ, which its rounding would
//! otherwise double with each step and let the rate drift.

use std::cell::RefCell;

/// A square matrix A, and A², A⁴, A⁸ … as far as they were asked for.
#[derive(Clone, Debug)]
pub(super) struct Powers {
    squares: RefCell<Vec<Power>>,
}

/// A row vector of state 0 times Aⁿ, and 1 less its sum.
#[derive(Clone, Debug)]
pub(super) struct Ahead {
    row: Vec<f64>,
    pub loss: f64,
}

/// Aⁿ row by row.
#[derive(Clone, Debug)]
struct Power {
    matrix: Vec<f64>,
    /// 1 less the sum of each row.
    losses: Vec<f64>,
}

impl Powers {
    /// Of a matrix row by row, and 1 less the sum of each row.
    pub fn new(matrix: Vec<f64>, losses: Vec<f64>) -> Self {
        Self {
            squares: RefCell::new(vec![Power { matrix, losses }]),
        }
    }

    /// At state 0.
    pub fn start(&self) -> Ahead {
        let size = self.squares.borrow()[0].losses.len();
        let mut row = vec![0.0; size];
        row[0] = 1.0;
        Ahead { row, loss: 0.0 }
    }

    /// 2^`exponent` steps later.
    pub fn advance(&self, from: &Ahead, exponent: usize) -> Ahead {
        let mut squares = self.squares.borrow_mut();
        while squares.len() <= exponent {
            let square = squares.last().expect("there is the matrix itself").square();
            squares.push(square);
        }
        squares[exponent].after(&from.row, from.loss)
    }
}

impl Power {
    fn square(&self) -> Self {
        let rows = self.matrix.chunks_exact(self.losses.len());
        let rows = rows.zip(&self.losses);
        let rows: Vec<Ahead> = rows.map(|(row, loss)| self.after(row, *loss)).collect();
        Self {
            losses: rows.iter().map(|row| row.loss).collect(),
            matrix: rows.into_iter().flat_map(|row| row.row).collect(),
        }
    }

    /// This row with this loss, so many steps later.
    fn after(&self, row: &[f64], loss: f64) -> Ahead {
        let mut product = vec![0.0; row.len()];
        let mut loss = loss;
        let rows = self.matrix.chunks_exact(row.len()).zip(&self.losses);
        for (factor, (to, lost)) in row.iter().zip(rows) {
            if *factor != 0.0 {
                let each = product.iter_mut().zip(to);
                each.for_each(|(sum, to)| *sum += factor * to);
                loss += factor * lost;
            }
        }
        product[0] += 1.0 - loss - product.iter().sum::<f64>();
        Ahead { row: product, loss }
    }
}
