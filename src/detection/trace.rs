//! A recording thinned for a picture: the lowest and the highest block in each of a few thousand columns of time.

use crate::explain::{Block, Place};

/// The record, the record whitened, and the course of the cage, thinned.
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
    /// The lowest and the highest speed, m/s.
    pub speed: (f64, f64),
    /// The lowest and the highest position, m.
    pub position: (f64, f64),
}

/// More columns than a picture resolves.
const MOST_COLUMNS: usize = 8192;

impl Trace {
    /// The columns in order of time.
    pub fn columns(&self) -> &[Column] {
        &self.0
    }

    pub(super) fn of(blocks: &[Block], whitened: &[f64], course: &[Place]) -> Self {
        let wide = blocks.len().div_ceil(MOST_COLUMNS).max(1);
        let columns = (0..blocks.len()).step_by(wide).map(|from| {
            let range = from..(from + wide).min(blocks.len());
            let span = |value: &dyn Fn(usize) -> f64| {
                let ends = (f64::INFINITY, f64::NEG_INFINITY);
                range
                    .clone()
                    .map(value)
                    .fold(ends, |(low, high), value| (low.min(value), high.max(value)))
            };
            Column {
                times: (blocks[from].from, blocks[range.end - 1].to),
                record: span(&|block| blocks[block].mean),
                whitened: span(&|block| whitened[block]),
                speed: span(&|block| course[block].speed),
                position: span(&|block| course[block].position),
            }
        });
        Self(columns.collect())
    }
}
