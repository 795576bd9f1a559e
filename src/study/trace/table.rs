//! `[trace]`: a ride in phases, and how it is shown.

use crate::config::{Conflict, Node, Value};
use crate::detect::Samples;
use crate::rule::OutOfRange;
use crate::scenario::Scenario;
use crate::signal::Phase;
use crate::values::{NonNegative, Positive, Size, number};
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer};
use std::ops::Range;

/// One realisation of a ride, phase by phase, and how it is shown.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Trace {
    /// The phases of the ride, each with its length in samples.
    #[serde(rename = "phases")]
    #[schemars(with = "Vec<PhaseTable>")]
    pub parts: Vec<Part>,
    /// Samples per second.
    #[serde(default = "one", deserialize_with = "number::<Positive, _>")]
    #[schemars(with = "Positive")]
    pub rate: f64,
    /// σ_ξ in `unit`.
    #[serde(default = "one", deserialize_with = "number::<Positive, _>")]
    #[schemars(with = "Positive")]
    pub sigma: f64,
    /// Of the record.
    #[serde(default = "sigma_xi", deserialize_with = "trimmed")]
    pub unit: String,
    /// Deviation of the vibration, white noise added in motion, σ_ξ.
    #[serde(default, deserialize_with = "number::<NonNegative, _>")]
    #[schemars(with = "NonNegative")]
    pub vibration: f64,
    /// Whether the record is also shown after whitening, with X, Y₁ and Y₂ marked.
    #[serde(default)]
    pub whitened: bool,
    /// The first sample in the picture.
    #[serde(default)]
    pub drawn_from: usize,
}

/// A part of a ride.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(from = "PhaseTable")]
pub struct Part {
    /// What the cage does.
    pub phase: Phase,
    /// For how many samples.
    pub length: usize,
}

/// A part as it is written, its length in samples.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum PhaseTable {
    /// The cage stands.
    Rest(Size),
    /// It gains speed.
    Acceleration(Size),
    /// It moves by itself.
    Inertial(Size),
    /// It loses speed.
    Braking(Size),
}

/// The longest ride. A longer one would take too long to draw.
const LONGEST: usize = 1_000_000;

fn one() -> f64 {
    1.0
}

fn trimmed<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    String::deserialize(deserializer).map(|text| text.trim().to_owned())
}

fn sigma_xi() -> String {
    "σ_ξ".to_owned()
}

impl From<PhaseTable> for Part {
    fn from(table: PhaseTable) -> Self {
        let (phase, length) = match table {
            PhaseTable::Rest(length) => (Phase::Rest, length),
            PhaseTable::Acceleration(length) => (Phase::Accelerating, length),
            PhaseTable::Inertial(length) => (Phase::Inertial, length),
            PhaseTable::Braking(length) => (Phase::Braking, length),
        };
        Self {
            phase,
            length: length.get(),
        }
    }
}

impl Trace {
    /// Samples of the whole ride.
    pub fn length(&self) -> usize {
        self.parts.iter().map(|part| part.length).sum()
    }

    /// The first sample of X. X ends where the first acceleration starts. `None` if the ride has no
    /// acceleration, or if the record before it is too short.
    pub fn reference_start(&self, samples: &Samples) -> Option<usize> {
        self.acceleration_start()?.checked_sub(samples.reference())
    }

    fn acceleration_start(&self) -> Option<usize> {
        let mut parts = self.parts.iter();
        let first = parts.position(|part| part.phase == Phase::Accelerating)?;
        Some(self.parts[..first].iter().map(|part| part.length).sum())
    }

    /// Checks that the values fit each other.
    pub fn check(&self) -> Result<(), Conflict> {
        let lengths = self.parts.iter().map(|part| part.length);
        let length = lengths.fold(0usize, usize::saturating_add);
        if !(1..=LONGEST).contains(&length) {
            let rule = format!("hold 1 to {LONGEST} samples");
            return Err(OutOfRange::new("trace.phases", rule, length).into());
        }
        if self.unit.is_empty() {
            return Err(OutOfRange::new("trace.unit", "have a name", "\"\"").into());
        }
        if self.drawn_from >= length {
            let rule = format!("lie in 0 to {}", length - 1);
            return Err(OutOfRange::new("trace.drawn_from", rule, self.drawn_from).into());
        }
        Ok(())
    }

    /// Overrides the sections: the acceleration lasts as long as its shortest phase.
    pub fn lay_over(&self, sections: &mut Node, table: &Range<usize>) {
        let accelerated = self.parts.iter().filter(|part| part.phase.sign() != 0.0);
        let shortest = accelerated.map(|part| part.length as i64).min();
        let value = Value::Integer(shortest.unwrap_or(1));
        sections.set(
            "motion.duration",
            Node {
                span: table.clone(),
                value,
            },
        );
    }

    /// Training, X, Y₁ and Y₂ of a whitened trace must lie inside the ride.
    pub fn check_fit(&self, scenario: &Scenario) -> Result<(), Conflict> {
        if !self.whitened {
            return Ok(());
        }
        const LENGTHEN: &str = " (lengthen them, or leave whitened out)";
        let refuse = |rule: String, got: usize, remedy| {
            let unfit = OutOfRange::new("trace.phases", rule, got);
            Err(unfit.explained(remedy).into())
        };
        let samples = &scenario.samples;
        let before = scenario.whitening.lead() + samples.reference();
        let Some(start) = self.acceleration_start() else {
            let remedy = " (add one, or leave whitened out)";
            return refuse("hold an acceleration".to_owned(), 0, remedy);
        };
        if start < before {
            let rule = format!("hold {before} samples for training and X before the acceleration");
            return refuse(rule, start, LENGTHEN);
        }
        let (needed, after) = (samples.span() - samples.reference(), self.length() - start);
        if after < needed {
            let rule = format!("hold {needed} samples for Y1 and Y2 from the acceleration on");
            return refuse(rule, after, LENGTHEN);
        }
        Ok(())
    }
}
