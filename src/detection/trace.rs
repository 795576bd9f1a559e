//! A recording thinned for a picture: the lowest and the highest block in each of a few thousand columns of time.

use crate::explain::Cut;

/// The record and the whitened record, thinned.
#[derive(Clone, Debug)]
pub struct Trace(Vec<Column>);

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

impl Trace {
    /// The columns in order of time.
    pub fn columns(&self) -> &[Column] {
        &self.0
    }

    pub(super) fn of(cut: &Cut, whitened: &[f64]) -> Self {
        let wide = cut.blocks.len().div_ceil(MOST_COLUMNS).max(1);
        let span = |values: &mut dyn Iterator<Item = f64>| {
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
                (low.min(value), high.max(value))
            })
        };
        let columns = cut.blocks.chunks(wide).zip(whitened.chunks(wide));
        Self(
            columns
                .map(|(blocks, whitened)| Column {
                    times: (blocks[0].from, blocks[blocks.len() - 1].to),
                    record: span(&mut blocks.iter().map(|block| block.mean)),
                    whitened: span(&mut whitened.iter().copied()),
                })
                .collect(),
        )
    }
}
