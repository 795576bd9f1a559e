//! The exact law of the time to a false alarm, in monitored blocks from S = 0.
//!
//! At rest the number of every side is uniform, so one [chain](super::chain) serves all of them: the run of one side has
//! mean L₁ and P(run > n) = e₀ᵀ Qⁿ 1, whatever the noise is and however long the reference.
//!
//! # Up and down together
//! *They do not interfere:* when S⁺ reaches h, S⁻ is 0. For let both be above 0 after a block, and let σ be the later of
//! the moments at which one of them was last 0. Since then neither was cut off at 0, and their scores are opposite, so
//! S⁺ + S⁻ is what the other was at σ less 2k for every block since: below h, as it did not alarm. An alarm of one thus
//! finds the other where the alarm leaves it, at 0. So with f the generating function of the run of one side, and a that of the runs
//! that up ends, f = a + a f (up was first, or down was and up began anew), and the run of both has g = 2a = 2f/(1 + f).
//! Hence 1/L = 2/L₁, and by the formula of Sherman and Morrison for (1 − g)/(1 − z)
//!
//! P(run > n) = e₀ᵀ (Q − q e₀ᵀ)ⁿ 1,
//!
//! q the probabilities of an alarm: the chain of one side, that returns from an alarm to 0 with a minus sign. The formula
//! of the mean is van Dobben de Bruyn's [^1].
//!
//! # Any sides together
//! *The promise:* the expected number of false alarms in n monitored blocks is at most n Σ 1/L_i = n·(sides)/L₁. Compare
//! one side's (alarms so far, S), in lexicographic order, with the same side if no other side ever alarmed, on the same
//! scores. A step keeps the order: of equal counts the larger S stays the larger and alarms first, and a smaller count
//! that catches up does so with S = 0. Where another side's alarm sets S to 0, this only lowers it. So the counts are at
//! most those of the side alone. Alone, the first alarm after block n comes on average m(S) ≤ m(0) = L₁ blocks later, and
//! by Wald's identity L₁ (E count + 1) ≤ n + L₁. The blocks of new references are not monitored, and lower the rate per
//! hour further.
//!
//! For the first alarm of up, down and scale, P(run ≤ n) is at most the sum of those of (up and down) and of scale. Both
//! bounds are far from sharp where one block far out raises up and scale at once.
//!
//! [^1]: C. S. van Dobben de Bruyn, "Cumulative Sum Tests", 1968.

use super::chain::Chain;
use super::chart::Chart;
use super::powers::{Ahead, Powers};
use super::score::Side;
use libm::{exp2, log1p};

/// The mean of one side's run, in blocks, from which on it counts as exponential.
pub(super) const RARE: f64 = 1e9;

/// The law of the time to a false alarm, for one threshold.
#[derive(Clone, Debug)]
pub struct RunLength {
    /// The number of sides.
    sides: usize,
    chain: Chain,
    /// What the sides are made of: pairs of up and down, and single ones.
    parts: Vec<Powers>,
}

impl RunLength {
    /// The law of a chart with threshold h ≥ 1, in steps.
    pub(super) fn new(chart: &Chart, threshold: i32) -> Self {
        let law = chart.lattice.law(Side::Up, |u| u);
        let chain = Chain::new(&law, chart.allowance, threshold);
        let has = |side| chart.sides.contains(&side);
        let is_pair = has(Side::Up) && has(Side::Down);
        let singles = chart.sides.len() - 2 * usize::from(is_pair);
        let pair = is_pair.then(|| Powers::new(signed(&chain), doubled(&chain)));
        let single = Powers::new(chain.moves.clone(), chain.alarms.clone());
        let parts = pair.into_iter().chain(vec![single; singles]);
        Self {
            sides: chart.sides.len(),
            parts: parts.collect(),
            chain,
        }
    }

    /// L₁, the mean of one side.
    pub fn one_side(&self) -> f64 {
        self.chain.mean()
    }

    /// L₁ over the number of sides: the mean blocks between false alarms that all sides together keep. Without scale it is
    /// exact.
    pub fn promised(&self) -> f64 {
        self.one_side() / self.sides as f64
    }

    /// Whether survival and quantiles are exact. If not, false alarms are rarer than they say.
    pub fn is_exact(&self) -> bool {
        self.parts.len() == 1
    }

    /// The monitored blocks after which S has forgotten that it began at 0: a block then alarms with its long-run probability
    /// 1/L₁, within a thousandth of it.
    pub fn settled(&self) -> u64 {
        let Chain { alarms, states, .. } = &self.chain;
        let mut sums = vec![0.0; *states];
        sums[0] = 1.0;
        let mean = self.one_side();
        let mut next = |_: &u64| {
            let rate: f64 = sums
                .iter()
                .zip(alarms)
                .map(|(mass, alarm)| mass * alarm)
                .sum();
            sums = self.chain.after(&sums);
            sums[0] += rate;
            (rate * mean - 1.0).abs() < 1e-3
        };
        (0..)
            .find(|block| next(block))
            .expect("the chain is ergodic")
    }

    /// P(no false alarm in `blocks` monitored blocks), to 13 decimals; so many digits has the probability of one, however
    /// rare it is.
    pub fn survival(&self, blocks: u64) -> f64 {
        let bits = (0..64).filter(|bit| blocks >> bit & 1 == 1);
        let ahead = bits.fold(self.start(), |ahead, bit| self.advance(&ahead, bit));
        1.0 - alarmed(&ahead)
    }

    /// The largest number of blocks that pass without a false alarm with a probability of 1 − `p` or more, 0 < `p` < 1.
    ///
    /// Where the mean is 10⁹ or more it is that of an exponential law. P(run > n) is P(run > m) P(run > n − m) but
    /// for climbs under way after m blocks that end in an alarm. Their probability is about (blocks in a climb that ends
    /// in an alarm)·(blocks between visits of 0)/L₁, below 1000/L₁. So `p` is off by less than 1e-6.
    pub fn quantile(&self, p: f64) -> f64 {
        if self.one_side() >= RARE {
            return (-log1p(-p) * self.promised()).floor();
        }
        let passes = |ahead: &[Ahead]| alarmed(ahead) <= p;
        let bits = (0..).find(|bit| !passes(&self.advance(&self.start(), *bit)));
        let (mut ahead, mut blocks) = (self.start(), 0.0);
        for bit in (0..bits.expect("an alarm comes at last")).rev() {
            let later = self.advance(&ahead, bit);
            if passes(&later) {
                ahead = later;
                blocks += exp2(bit as f64);
            }
        }
        blocks
    }

    fn start(&self) -> Vec<Ahead> {
        self.parts.iter().map(Powers::start).collect()
    }

    fn advance(&self, ahead: &[Ahead], bit: usize) -> Vec<Ahead> {
        let each = self.parts.iter().zip(ahead);
        each.map(|(part, ahead)| part.advance(ahead, bit)).collect()
    }
}

/// Q − q e₀ᵀ.
fn signed(chain: &Chain) -> Vec<f64> {
    let mut moves = chain.moves.clone();
    let rows = moves.chunks_exact_mut(chain.states).zip(&chain.alarms);
    rows.for_each(|(row, alarm)| row[0] -= alarm);
    moves
}

/// 1 less the sums of its rows.
fn doubled(chain: &Chain) -> Vec<f64> {
    chain.alarms.iter().map(|alarm| 2.0 * alarm).collect()
}

/// The alarms of all parts.
fn alarmed(ahead: &[Ahead]) -> f64 {
    let sum: f64 = ahead.iter().map(|part| part.loss).sum();
    sum.min(1.0)
}
