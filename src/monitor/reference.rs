//! The reference of rest: the level, the whitening filter and the sample X.

use super::design::Design;
use crate::whiten::{self, Chosen, Fit, LjungBox, Order};
use serde::{Deserialize, Serialize};

/// The most blocks that ranks begin with: 38 s of 0.05 s each.
pub(super) const MOST_RANKED: usize = 768;

/// A reference learnt from a record of rest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reference {
    /// The mean of the record, m/s²: the sensor's offset, plus gravity if it is measured.
    pub level: f64,
    /// a₁ … a_m.
    pub coefficients: Vec<f64>,
    /// The deviation of the whitened record, m/s²: σ_ξ of block means.
    pub deviation: f64,
    /// The p-value of the Ljung–Box test of the whitened record; `None` if the record is too short for the
    /// test, or constant.
    pub whiteness: Option<f64>,
    /// Blocks it was fitted to.
    pub training: usize,
    /// Start and end of the rest it was learnt from, s; `None` if that was all rest of a record.
    pub span: Option<(f64, f64)>,
    /// X: whitened blocks, N of them.
    pub sample: Vec<f64>,
    /// The whitened blocks that sequential ranks begin with, where they decide.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ranked: Vec<f64>,
}

impl Reference {
    /// Learns from the latest block means of a rest: X is the last N, and the filter is fitted to those before.
    pub(super) fn from_rest(record: &[f64], span: (f64, f64), design: &Design) -> Self {
        let n = design.samples.reference();
        let training = &record[..record.len() - n];
        let level = training.iter().sum::<f64>() / training.len() as f64;
        let centred: Vec<f64> = record.iter().map(|mean| mean - level).collect();
        let filter = Filter::fit(&[&centred[..training.len()]], design);
        let mut sample = vec![0.0; n];
        whiten::whiten(&filter.coefficients, &centred, training.len(), &mut sample);
        let ranked = match design.ranks {
            Some(_) => [&filter.whitened[..], &sample].concat(),
            None => Vec::new(),
        };
        let reference = filter.into_reference(level, Some(span), training.len(), sample);
        Self {
            ranked,
            ..reference
        }
    }

    /// Learns from all stretches of rest in a record. X is taken at even distances from all of them, so that it
    /// represents the whole rest; the filter is fitted to the same blocks.
    pub(crate) fn from_stretches(stretches: &[Vec<f64>], design: &Design) -> Self {
        let blocks: usize = stretches.iter().map(Vec::len).sum();
        let level = stretches.iter().flatten().sum::<f64>() / blocks as f64;
        let centre = |stretch: &Vec<f64>| stretch.iter().map(|mean| mean - level).collect();
        let centred: Vec<Vec<f64>> = stretches.iter().map(centre).collect();
        let slices: Vec<&[f64]> = centred.iter().map(Vec::as_slice).collect();
        let filter = Filter::fit(&slices, design);
        let sample = spread(&filter.whitened, design.samples.reference());
        let ranked = match design.ranks {
            Some(_) => spread(&filter.whitened, MOST_RANKED.min(filter.whitened.len())),
            None => Vec::new(),
        };
        let reference = filter.into_reference(level, None, blocks, sample);
        Self {
            ranked,
            ..reference
        }
    }
}

/// `n` blocks at even distances.
fn spread(blocks: &[f64], n: usize) -> Vec<f64> {
    let each = (0..n).map(|i| blocks[(2 * i + 1) * blocks.len() / (2 * n)]);
    each.collect()
}

/// A filter and the record it was fitted to, whitened.
struct Filter {
    coefficients: Vec<f64>,
    whitened: Vec<f64>,
}

impl Filter {
    /// Fits by Burg's method, which is stable for every record: a filter with a negative response to a constant
    /// would reverse the sign of a start.
    fn fit(stretches: &[&[f64]], design: &Design) -> Self {
        let joined = stretches.concat();
        let coefficients = match design.settings.whitening.order {
            Order::Fixed(order) => whiten::coefficients(&joined, order, Fit::Burg),
            Order::Auto => {
                let most = Order::Auto.highest(joined.len());
                let chosen = Chosen::new(&joined, most, Fit::Burg);
                chosen.expect("as high as the record allows").coefficients
            }
        };
        let order = coefficients.len();
        let mut whitened = Vec::new();
        for stretch in stretches {
            let mut part = vec![0.0; stretch.len() - order];
            whiten::whiten(&coefficients, stretch, order, &mut part);
            whitened.append(&mut part);
        }
        Self {
            coefficients,
            whitened,
        }
    }

    fn into_reference(
        self,
        level: f64,
        span: Option<(f64, f64)>,
        training: usize,
        sample: Vec<f64>,
    ) -> Reference {
        let squares: f64 = self.whitened.iter().map(|y| y * y).sum();
        Reference {
            level,
            deviation: (squares / self.whitened.len() as f64).sqrt(),
            whiteness: LjungBox::of_residuals(&self.whitened, self.coefficients.len())
                .ok()
                .map(|test| test.p_value),
            coefficients: self.coefficients,
            training,
            span,
            sample,
            ranked: Vec::new(),
        }
    }
}
