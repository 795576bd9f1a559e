//! `[run_length]`: the detector, the noise, and the columns of `points.csv`.

use crate::detect::sequential::{Chart, Rate, Score, Side, units};
use crate::rule::{OutOfRange, Rule};
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
    /// Blocks that are monitored before the first that counts.
    pub warm_up: u64,
    /// Monitored blocks that count.
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
    /// Checks what the detector does not.
    ///
    /// # Errors
    /// If a number breaks its rule, a point has no name of its own, or something is promised of coloured noise.
    pub fn check(&self) -> Result<(), OutOfRange> {
        let blocks = Rule::Within(1.0, 1e7, "");
        blocks.check("blocks", &(self.blocks as f64))?;
        for (place, noise) in self.noise.iter().enumerate() {
            let within = |error: OutOfRange| error.under(format!("noise[{place}]"));
            noise.check().map_err(within)?;
            let before = &self.noise[..place];
            if before.iter().any(|other| noise.is_named_like(other)) {
                let rule = "differ from point to point";
                return Err(within(OutOfRange::new("label", rule, &noise.label)));
            }
        }
        match self.noise.len() {
            0 => Err(OutOfRange::new("noise", "name a noise", "none")),
            _ => Ok(()),
        }
    }

    /// The detector and its false alarms per block: what is promised, and what the exact law says.
    ///
    /// # Errors
    /// If there is none with these keys, or none that keeps the rate.
    pub fn detector(&self) -> Result<(Watch, [f64; 2]), OutOfRange> {
        let rate = Rate::new(self.per_hour, self.rate)?;
        // Each record begins with a reference: longer ones take hours, and the law is the same.
        Rule::Within(1.0, 1e4, "blocks").check("reference", &self.reference)?;
        let chart = Chart::new(self.score, &self.sides, self.k, self.reference)?;
        let threshold = rate.threshold(&chart)?;
        let law = chart.run_length(threshold);
        let rates = [rate.per_block(), 1.0 / law.promised()];
        let detector = Watch {
            chart,
            threshold,
            warm_up: law.settled(),
            blocks: self.blocks,
        };
        Ok((detector, rates))
    }
}

impl Blocks {
    fn check(&self) -> Result<(), OutOfRange> {
        let quantum = Rule::Within(0.0, 1e3, "");
        quantum.check("quantum", &self.quantum)?;
        if self.quantum > 0.0 && self.quantum < 1e-9 {
            let rule = "be 0 or at least 1e-9";
            return Err(OutOfRange::new("quantum", rule, self.quantum));
        }
        let colour = Rule::Within(-0.999, 0.999, "");
        colour.check("colour", &self.colour)?;
        if self.colour != 0.0 && self.promised {
            let remedy = " (set promised = false: coloured blocks are not exchangeable)";
            let error = OutOfRange::new("colour", "be 0 where a rate is promised", self.colour);
            return Err(error.explained(remedy));
        }
        match name_of(&self.label).is_empty() {
            true => {
                let rule = "have a letter or a digit";
                Err(OutOfRange::new("label", rule, &self.label))
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
