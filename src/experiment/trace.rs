//! `[trace]`: a ride in phases, and how it is shown.

use super::tables::LONGEST;
use crate::config::{Conflict, Node, Unfit, Value};
use crate::detect::Samples;
use crate::scenario::Scenario;
use crate::signal::Phase;
use crate::values::{NonNegative, Positive, Size};
use schemars::JsonSchema;
use serde::Deserialize;
use std::ops::Range;

/// A ride and how it is shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// In the order of time.
    pub parts: Vec<Part>,
    /// Samples per second.
    pub rate: f64,
    /// σ_ξ in `unit`.
    pub sigma: f64,
    /// Of the record.
    pub unit: String,
    /// Deviation of the vibration, white noise added in motion, in σ_ξ.
    pub vibration: f64,
    /// Whether the record is also shown after whitening, with X, Y₁ and Y₂ marked.
    pub whitened: bool,
    /// The first sample in the picture.
    pub drawn_from: usize,
}

/// A part of a ride.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// What the cage does.
    pub phase: Phase,
    /// For how many samples.
    pub length: usize,
}

/// `[trace]`
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct TraceTable {
    /// The phases of the ride, each with its length in samples.
    phases: Vec<PhaseTable>,
    /// Samples per second.
    #[serde(default = "one")]
    rate: Positive,
    /// σ_ξ in `unit`.
    #[serde(default = "one")]
    sigma: Positive,
    /// Of the record.
    #[serde(default = "sigma_xi")]
    unit: String,
    /// Deviation of the vibration, white noise added in motion, σ_ξ.
    #[serde(default = "still")]
    vibration: NonNegative,
    /// Whether the record is also shown after whitening, with X, Y₁ and Y₂ marked.
    #[serde(default)]
    whitened: bool,
    /// The first sample in the picture.
    #[serde(default)]
    drawn_from: usize,
}

/// One of `trace.phases`, its length in samples.
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

fn one() -> Positive {
    Positive::new(1.0).expect("it is in its range")
}

fn still() -> NonNegative {
    NonNegative::new(0.0).expect("it is in its range")
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

    /// Where the first of X lies: X ends where the first acceleration starts. `None` where there is
    /// no acceleration, or not enough of a record before it.
    pub fn reference_start(&self, samples: &Samples) -> Option<usize> {
        self.acceleration_start()?.checked_sub(samples.reference())
    }

    pub(super) fn acceleration_start(&self) -> Option<usize> {
        let mut parts = self.parts.iter();
        let first = parts.position(|part| part.phase == Phase::Accelerating)?;
        Some(self.parts[..first].iter().map(|part| part.length).sum())
    }

    /// The ride of a table whose values fit each other.
    pub(super) fn checked(table: TraceTable) -> Result<Self, Conflict> {
        let trace = Self {
            parts: table.phases.into_iter().map(Part::from).collect(),
            rate: table.rate.get(),
            sigma: table.sigma.get(),
            unit: table.unit.trim().to_owned(),
            vibration: table.vibration.get(),
            whitened: table.whitened,
            drawn_from: table.drawn_from,
        };
        let lengths = trace.parts.iter().map(|part| part.length);
        let length = lengths.fold(0usize, usize::saturating_add);
        if !(1..=LONGEST).contains(&length) {
            let rule = format!("hold 1 to {LONGEST} samples");
            return Err(Unfit::new("trace.phases", rule, length).into());
        }
        if trace.unit.is_empty() {
            return Err(Unfit::new("trace.unit", "have a name", "\"\"").into());
        }
        if trace.drawn_from >= length {
            let rule = format!("lie in 0 to {}", length - 1);
            return Err(Unfit::new("trace.drawn_from", rule, trace.drawn_from).into());
        }
        Ok(trace)
    }

    /// Lays over the sections that the acceleration lasts as long as its shortest phase.
    pub(super) fn lay_over(&self, sections: &mut Node, table: &Range<usize>) {
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

    /// Training, X, Y₁ and Y₂ must lie inside the ride.
    pub(super) fn check_fit(&self, scenario: &Scenario) -> Result<(), Conflict> {
        const LENGTHEN: &str = " (lengthen them, or leave whitened out)";
        let refuse = |rule: String, got: usize, remedy| {
            let unfit = Unfit::new("trace.phases", rule, got);
            Err(Unfit { remedy, ..unfit }.into())
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
