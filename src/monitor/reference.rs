//! What a monitor knows of rest: the level, the whitening filter and the sample X.

use super::settings::Design;
use crate::whiten::{self, Fit, Fitter, Whitening};
use serde::{Deserialize, Serialize};

/// What has been learnt from a record of rest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reference {
    /// The mean of the record, m/s²: the sensor's offset, gravity included where the record has it.
    pub level: f64,
    /// a₁ … a_m.
    pub coefficients: Vec<f64>,
    /// The deviation of the whitened record, m/s²: σ_ξ of block means.
    pub deviation: f64,
    /// The p-value of the Ljung–Box test of the whitened record: how plausible it is that no colour is left.
    pub whiteness: f64,
    /// Blocks it was fitted to.
    pub training: usize,
    /// From when to when it was recorded, s.
    pub span: (f64, f64),
    /// X: whitened blocks, N of them.
    pub sample: Vec<f64>,
}

impl Reference {
    /// From block means of rest, the last N of which become X.
    pub fn from_rest(record: &[f64], span: (f64, f64), design: &Design) -> Self {
        let n = design.samples.reference();
        let (training, _) = record.split_at(record.len() - n);
        let mut this = Self::fit(training, design);
        let mut sample = vec![0.0; n];
        let centred: Vec<f64> = record.iter().map(|mean| mean - this.level).collect();
        whiten::whiten(&this.coefficients, &centred, record.len() - n, &mut sample);
        this.span = span;
        this.sample = sample;
        this
    }

    fn fit(training: &[f64], design: &Design) -> Self {
        let level = training.iter().sum::<f64>() / training.len() as f64;
        let order = design.settings.order.unwrap_or(2);
        let w = Whitening::new(order, Fit::Burg, training.len(), false, 0).unwrap();
        let coefficients = Fitter::new(w, &[]).fit(training).to_vec();
        let centred: Vec<f64> = training.iter().map(|mean| mean - level).collect();
        let mut residual = vec![0.0; training.len() - order];
        whiten::whiten(&coefficients, &centred, order, &mut residual);
        let deviation =
            (residual.iter().map(|y| y * y).sum::<f64>() / residual.len() as f64).sqrt();
        Self {
            level,
            coefficients,
            deviation,
            whiteness: 1.0,
            training: training.len(),
            span: (0.0, 0.0),
            sample: Vec::new(),
        }
    }
}
