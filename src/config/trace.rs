//! `[trace]`: a ride in phases, and how it is shown.

use super::drawing::{LONGEST, Refused, out_of_range, positive, whole};
use super::error::Problem;
use super::exhibit::ExhibitKind;
use super::file::File;
use super::value::{Number, Whole};
use crate::chain::Scenario;
use crate::detect::Samples;
use crate::signal::Phase;
use serde::Deserialize;
use toml::Spanned;

const KIND: &str = "trace";

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
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TraceTable {
    pub phases: Spanned<Vec<Spanned<PhaseTable>>>,
    pub rate: Option<Spanned<Number>>,
    pub sigma: Option<Spanned<Number>>,
    pub unit: Option<Spanned<String>>,
    pub vibration: Option<Spanned<Number>>,
    pub whitened: Option<Spanned<bool>>,
    pub drawn_from: Option<Spanned<Whole>>,
}

/// One of `trace.phases`, its length in samples.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum PhaseTable {
    Rest(Whole),
    Acceleration(Whole),
    Inertial(Whole),
    Braking(Whole),
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
}

pub(super) fn trace(table: &TraceTable) -> Result<ExhibitKind, Refused> {
    let parts: Vec<Part> = table
        .phases
        .get_ref()
        .iter()
        .map(part)
        .collect::<Result<_, _>>()?;
    let length = parts
        .iter()
        .fold(0usize, |sum, part| sum.saturating_add(part.length));
    if !(1..=LONGEST).contains(&length) {
        let rule = format!("hold 1 to {LONGEST} samples");
        let problem = out_of_range(KIND, "phases", rule, length.to_string());
        return Err((Some(table.phases.span()), problem));
    }
    let unit = table.unit.as_ref().map(|unit| unit.get_ref().trim());
    if let Some("") = unit {
        let problem = out_of_range(KIND, "unit", "have a name".to_owned(), "\"\"".to_owned());
        return Err((table.unit.as_ref().map(Spanned::span), problem));
    }
    Ok(ExhibitKind::Trace(Trace {
        rate: positive(KIND, "rate", &table.rate, 1.0)?,
        sigma: positive(KIND, "sigma", &table.sigma, 1.0)?,
        unit: unit.unwrap_or("σ_ξ").to_owned(),
        vibration: vibration(&table.vibration)?,
        whitened: table
            .whitened
            .as_ref()
            .is_some_and(|whitened| *whitened.get_ref()),
        drawn_from: whole(KIND, "drawn_from", &table.drawn_from, 0, 0..=length - 1)?,
        parts,
    }))
}

fn part(given: &Spanned<PhaseTable>) -> Result<Part, Refused> {
    let (phase, length) = match *given.get_ref() {
        PhaseTable::Rest(length) => (Phase::Rest, length),
        PhaseTable::Acceleration(length) => (Phase::Accelerating, length),
        PhaseTable::Inertial(length) => (Phase::Inertial, length),
        PhaseTable::Braking(length) => (Phase::Braking, length),
    };
    let length = length.size();
    if length == 0 {
        let rule = format!("give {} at least 1 sample", phase.name());
        let problem = out_of_range(KIND, "phases", rule, "0".to_owned());
        return Err((Some(given.span()), problem));
    }
    Ok(Part { phase, length })
}

fn vibration(given: &Option<Spanned<Number>>) -> Result<f64, Refused> {
    let value = given.as_ref().map_or(0.0, |value| value.get_ref().0);
    match value >= 0.0 {
        true => Ok(value),
        false => {
            let rule = "be zero or positive".to_owned();
            let problem = out_of_range(KIND, "vibration", rule, value.to_string());
            Err((given.as_ref().map(Spanned::span), problem))
        }
    }
}

/// Training, X, Y₁ and Y₂ must lie inside the ride.
pub(super) fn check_fit(trace: &Trace, scenario: &Scenario, file: &File) -> Result<(), Refused> {
    let refuse = |rule: String, got: usize, remedy| {
        let span = file
            .trace
            .as_ref()
            .map(|table| table.get_ref().phases.span());
        let problem = Problem::DrawingValue {
            kind: KIND,
            key: "phases",
            rule,
            got: got.to_string(),
            remedy,
        };
        Err((span, problem))
    };
    const LENGTHEN: &str = " (lengthen them, or leave whitened out)";
    let samples = &scenario.samples;
    let before = scenario.whitening.lead() + samples.reference();
    let Some(start) = trace.acceleration_start() else {
        let remedy = " (add one, or leave whitened out)";
        return refuse("hold an acceleration".to_owned(), 0, remedy);
    };
    if start < before {
        let rule = format!("hold {before} samples for training and X before the acceleration");
        return refuse(rule, start, LENGTHEN);
    }
    let (needed, after) = (samples.span() - samples.reference(), trace.length() - start);
    if after < needed {
        let rule = format!("hold {needed} samples for Y1 and Y2 from the acceleration on");
        return refuse(rule, after, LENGTHEN);
    }
    Ok(())
}
