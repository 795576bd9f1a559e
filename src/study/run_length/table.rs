//! `[run_length]`: the detector, the noise, and the columns of `points.csv`.

use crate::detect::sequential::{Chart, Score, Side, units};
use crate::rule::{Explained, OutOfRange, Rule};
use crate::signal::Noise;
use crate::study::curves::name_of;
use crate::study::outcomes::outcome_row;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// CUSUMs of sequential ranks on blocks at rest, of several kinds of noise.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Table {
    /// The false alarms per hour that are promised, all sides together.
    per_hour: f64,
    /// Blocks per second.
    rate: f64,
    /// N, the blocks of a reference.
    #[serde(default = "usual_reference")]
    reference: usize,
    /// What a rank scores.
    #[serde(default)]
    score: Score,
    /// Which changes are looked for.
    #[serde(default = "usual_sides")]
    sides: Vec<Side>,
    /// k, a multiple of 0.025.
    #[serde(default = "usual_k")]
    k: f64,
    /// Monitored blocks in a trial.
    pub blocks: u64,
    /// The noise of each point: x ← `colour`·x + e with e of `law`, rounded to multiples of `quantum`. With `promised` =
    /// false it is counted but not tested, as coloured noise must be.
    pub noise: Vec<Blocks>,
}

/// The law of blocks at rest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Blocks {
    /// Its name.
    pub label: String,
    /// Law of what drives it.
    #[schemars(with = "crate::signal::Law")]
    pub law: Noise,
    /// Blocks are rounded to multiples of this; 0: not at all.
    #[serde(default)]
    pub quantum: f64,
    /// φ of x ← φ x + e.
    #[serde(default)]
    pub colour: f64,
    /// Whether the rate is promised and tested; false of coloured noise.
    #[serde(default = "yes")]
    pub promised: bool,
}

/// A detector and how long it watches.
#[derive(Clone, Debug)]
pub struct Watch {
    pub chart: Chart,
    /// h, in steps.
    pub threshold: i32,
    /// Monitored blocks.
    pub blocks: u64,
}

fn usual_reference() -> usize {
    60
}

fn usual_sides() -> Vec<Side> {
    vec![Side::Up, Side::Down]
}

fn usual_k() -> f64 {
    0.8
}

fn yes() -> bool {
    true
}

outcome_row! {
    |noise: &Blocks, detector: &Watch|
    label: String = noise.label.clone();
    law: String = noise.law.to_string();
    quantum: f64 = noise.quantum;
    colour: f64 = noise.colour;
    promised: bool = noise.promised;
    threshold: f64 = units(detector.threshold);
    ..
}

impl Table {
    /// The false alarms per block that are promised.
    pub fn promised(&self) -> f64 {
        self.per_hour / (3600.0 * self.rate)
    }

    /// Checks what the detector does not.
    ///
    /// # Errors
    /// If a number breaks its rule, a point has no name of its own, or something is promised of coloured noise.
    pub fn check(&self) -> Result<(), OutOfRange> {
        Rule::Positive.check("run_length.per_hour", &self.per_hour)?;
        Rule::Positive.check("run_length.rate", &self.rate)?;
        let blocks = Rule::Within(1.0, 1e7, "");
        blocks.check("run_length.blocks", &(self.blocks as f64))?;
        for (place, noise) in self.noise.iter().enumerate() {
            noise.check()?;
            let before = &self.noise[..place];
            if before.iter().any(|other| noise.is_named_like(other)) {
                let rule = "differ from point to point";
                let error = OutOfRange::new("run_length.noise.label", rule, &noise.label);
                return Err(error);
            }
        }
        match self.noise.len() {
            0 => Err(OutOfRange::new("run_length.noise", "name a noise", "none")),
            _ => Ok(()),
        }
    }

    /// The detector, and its false alarms per block by the exact law.
    ///
    /// # Errors
    /// If there is none with these keys, or none that keeps the rate.
    pub fn detector(&self) -> Result<(Watch, f64), OutOfRange> {
        let chart = Chart::new(self.score, &self.sides, self.k, self.reference);
        let chart = chart.map_err(|error| OutOfRange {
            key: format!("run_length.{}", error.key),
            ..error
        })?;
        let threshold = chart.threshold(1.0 / self.promised());
        let keys = ["run_length.per_hour", "run_length.reference"];
        let threshold = threshold.map_err(|error| error.per_hour(keys, 3600.0 * self.rate))?;
        let exact = 1.0 / chart.run_length(threshold).promised();
        let blocks = self.blocks;
        let detector = Watch {
            chart,
            threshold,
            blocks,
        };
        Ok((detector, exact))
    }
}

impl Blocks {
    fn check(&self) -> Result<(), OutOfRange> {
        let quantum = Rule::Within(0.0, 1e3, "");
        quantum.check("run_length.noise.quantum", &self.quantum)?;
        let colour = Rule::Within(-0.999, 0.999, "");
        colour.check("run_length.noise.colour", &self.colour)?;
        if self.colour != 0.0 && self.promised {
            let free = Explained(
                Rule::Within(0.0, 0.0, ""),
                " (set promised = false: coloured blocks are not exchangeable)",
            );
            free.check("run_length.noise.colour", &self.colour)?;
        }
        match name_of(&self.label).is_empty() {
            true => {
                let rule = "have a letter or a digit";
                Err(OutOfRange::new("run_length.noise.label", rule, &self.label))
            }
            false => Ok(()),
        }
    }

    fn is_named_like(&self, other: &Self) -> bool {
        name_of(&self.label) == name_of(&other.label)
    }

    /// Everything but its name.
    pub fn subject(&self) -> String {
        let Self {
            law,
            quantum,
            colour,
            ..
        } = self;
        format!("{law} quantum {quantum} colour {colour}")
    }
}
