//! A recording thinned for a picture, in constant memory: the lowest and the highest block in each of a few
//! thousand columns of time.

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

/// A column of time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column {
    /// When it begins and ends, s.
    pub times: (f64, f64),
    /// The lowest and the highest block mean, m/s².
    pub record: (f64, f64),
    /// The lowest and the highest whitened block, m/s².
    pub whitened: (f64, f64),
}

/// More columns than a picture resolves.
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
    /// The columns in order of time.
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

    /// Makes room by joining columns in pairs.
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
