//! What a run leaves behind: `points.csv`, `figure.png`, `figure.svg`, `run.json` in one directory.
//!
//! The CSV holds counts and every resolved parameter, and no clock or host, so that the same config
//! and seed give the same bytes anywhere. Files are written beside their place and renamed into it,
//! all after the last trial: a run that fails leaves what was there before.

use crate::binomial;
use crate::plan::{Hypothesis, Plan, Point};
use crate::tally::Tally;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// One row of `points.csv`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the columns are the config's own words")]
pub struct Row {
    /// From 1.
    pub curve: usize,
    pub label: String,
    pub hypothesis: String,
    pub delta: f64,
    pub nu: f64,
    pub theta: f64,
    pub noise: String,
    pub order: usize,
    pub training: usize,
    pub reference: usize,
    pub shift: usize,
    pub scale: usize,
    pub rule: String,
    pub alpha: f64,
    pub size: f64,
    pub trials: u64,
    pub detections: u64,
    pub rate: f64,
    pub low: f64,
    pub high: f64,
    pub confidence: f64,
    pub alternative: String,
    pub sensor: String,
    pub quantum: Option<f64>,
    pub range: Option<f64>,
    pub fit: String,
    pub includes_reference: bool,
    pub gap: usize,
    pub decimation: usize,
    pub delta_at: String,
    pub profile: String,
    pub duration: usize,
    pub offset: usize,
    pub during: String,
}
