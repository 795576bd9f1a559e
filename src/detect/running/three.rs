//! The three samples sliding along means of 0.12 s: X of 24, Y₁ of 12, and Y₂, the newest 12.
//!
//! The score is −ln(p_W p_T), two-sided in W; with T′ for T that of the mended rule. A region of rule `product` is where it
//! reaches a value. Ties are broken by random keys.

use super::blocks::Score;
use crate::detect::{Alternative, Exceedances, NullLaws, Pooled, Samples, Statistics};
use crate::rng::Generator;
use libm::log;
use rand::Rng;
use std::sync::Arc;

/// Samples of a block.
pub const BLOCK: usize = 12;

/// N, M₁, M₂ in blocks.
const SIZES: [usize; 3] = [24, 12, 12];
const ALL: usize = SIZES[0] + SIZES[1] + SIZES[2];

/// −ln of the p-values of W and T, and of W and T′.
#[derive(Clone, Debug)]
pub struct Tables([Arc<Table>; 2]);

#[derive(Debug)]
struct Table {
    of: Exceedances,
    /// From the smallest W on.
    rank_sum: Vec<f64>,
    first: u64,
    exceedances: Vec<f64>,
}

impl Default for Tables {
    fn default() -> Self {
        Self([Exceedances::Scale, Exceedances::Motion].map(|of| Arc::new(Table::new(of))))
    }
}

impl Tables {
    pub(super) fn start(&self, of: Exceedances, ties: Generator) -> ThreeSamples {
        let table = self.0.iter().find(|table| table.of == of);
        ThreeSamples {
            table: Arc::clone(table.expect("there is one of each")),
            newest: Vec::with_capacity(ALL),
            ties,
        }
    }
}

impl Table {
    fn new(of: Exceedances) -> Self {
        let [x, y, z] = SIZES;
        let samples = Samples::contiguous(x, y, z).expect("none is 0");
        let laws = NullLaws::new(of, Alternative::TwoSided, &samples).expect("they are small");
        let (first, last) = (laws.rank_sum().first(), laws.rank_sum().last());
        let score = |w| Alternative::TwoSided.score(w, first + last);
        let exceedances = laws.exceedances();
        Self {
            of,
            rank_sum: (first..=last)
                .map(|w| -log(laws.score.tail(score(w))))
                .collect(),
            first,
            exceedances: (0..=exceedances.last())
                .map(|t| -log(exceedances.tail(t)))
                .collect(),
        }
    }

    fn score(&self, statistics: Statistics) -> f64 {
        let w = (statistics.rank_sum - self.first) as usize;
        self.rank_sum[w] + self.exceedances[self.of.of(statistics)]
    }
}

/// The newest blocks.
#[derive(Clone, Debug)]
pub struct ThreeSamples {
    table: Arc<Table>,
    newest: Vec<f64>,
    ties: Generator,
}

impl Score for ThreeSamples {
    fn step(&mut self, x: f64) -> f64 {
        if self.newest.len() == ALL {
            self.newest.rotate_left(1);
            self.newest[ALL - 1] = x;
        } else {
            self.newest.push(x);
        }
        if self.newest.len() < ALL {
            return f64::NEG_INFINITY;
        }
        let (reference, motion) = self.newest.split_at(SIZES[0]);
        let (shift, scale) = motion.split_at(SIZES[1]);
        let pooled = Pooled {
            reference,
            shift,
            scale,
        };
        let mut keys = [0; ALL];
        let statistics = pooled.statistics(|| {
            keys.fill_with(|| self.ties.next_u64());
            &keys
        });
        self.table.score(statistics)
    }
}
