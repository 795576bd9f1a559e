//! One row of `points.csv`.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// One (w, t) with n(w) > 0 and n(t) > 0, at one set of sizes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// N.
    pub reference: usize,
    /// M₁.
    pub shift: usize,
    /// M₂.
    pub scale: usize,
    /// w.
    pub rank_sum: u64,
    /// t.
    pub exceedances: usize,
    /// n(w, t).
    pub count: u64,
    /// P(w)·P(t), the nearest f64.
    pub product: f64,
    /// P(w, t), the nearest f64.
    pub joint: f64,
}

/// The result of the enumeration of one set of sizes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Finding {
    /// N, M₁, M₂.
    pub sizes: [usize; 3],
    /// n.
    pub assignments: u64,
    /// Pairs (w, t) compared.
    pub cells: usize,
    /// The largest |n(w, t)·n − n(w)·n(t)|.
    pub largest_difference: u128,
}

/// The findings, in the order of the rows.
pub fn findings(rows: &[Row]) -> Vec<Finding> {
    rows.chunk_by(|a, b| a.sizes() == b.sizes())
        .map(finding)
        .collect()
}

impl Row {
    pub(super) fn sizes(&self) -> [usize; 3] {
        [self.reference, self.shift, self.scale]
    }
}

fn finding(rows: &[Row]) -> Finding {
    let (mut of_w, mut of_t) = (BTreeMap::new(), BTreeMap::new());
    for row in rows {
        *of_w.entry(row.rank_sum).or_insert(0u128) += u128::from(row.count);
        *of_t.entry(row.exceedances).or_insert(0u128) += u128::from(row.count);
    }
    let all: u128 = of_w.values().sum();
    let difference = |row: &Row| {
        let joint = u128::from(row.count) * all;
        joint.abs_diff(of_w[&row.rank_sum] * of_t[&row.exceedances])
    };
    Finding {
        sizes: rows[0].sizes(),
        assignments: all as u64,
        cells: rows.len(),
        largest_difference: rows.iter().map(difference).max().unwrap_or(0),
    }
}
