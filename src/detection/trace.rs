//! What a picture of a recording shows, in memory of constant size: the lowest and the highest block of
//! each of a few thousand stretches of time.

use crate::monitor::Observation;

/// The record and the whitened record, thinned.
#[derive(Clone, Debug)]
pub struct Trace {
    columns: Vec<Column>,
    /// Blocks in a column.
    blocks: usize,
    /// Blocks in the last one.
    filled: usize,
}

/// A stretch of time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column {
    /// When it begins and ends, s.
    pub times: (f64, f64),
    /// The lowest and the highest block mean, m/s².
    pub record: (f64, f64),
    /// The same whitened.
    pub whitened: (f64, f64),
}

/// More than a picture can tell apart.
const MOST_COLUMNS: usize = 8192;

impl Default for Trace {
    fn default() -> Self {
        Self {
            columns: Vec::new(),
            blocks: 1,
            filled: 0,
        }
    }
}

impl Trace {
    /// In the order of time.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    pub(super) fn block(&mut self, block: &Observation) {
        let column = Column {
            times: block.times,
            record: (block.mean, block.mean),
            whitened: (block.whitened, block.whitened),
        };
        match self.columns.last_mut() {
            Some(last) if self.filled < self.blocks => *last = last.joined(&column),
            _ => {
                self.thin();
                self.columns.push(column);
                self.filled = 0;
            }
        }
        self.filled += 1;
    }

    /// Makes room by joining two and two.
    fn thin(&mut self) {
        if self.columns.len() == MOST_COLUMNS {
            let pairs = self.columns.chunks_exact(2);
            self.columns = pairs.map(|pair| pair[0].joined(&pair[1])).collect();
            self.blocks *= 2;
        }
    }
}

impl Column {
    fn joined(&self, later: &Self) -> Self {
        let span = |a: (f64, f64), b: (f64, f64)| (a.0.min(b.0), a.1.max(b.1));
        Self {
            times: (self.times.0, later.times.1),
            record: span(self.record, later.record),
            whitened: span(self.whitened, later.whitened),
        }
    }
}
