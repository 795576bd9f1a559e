//! Warnings about the quality of a recording.

use super::column::Role;
use super::facts::Facts;
use super::intervals::Gap;
use super::layout::Layout;
use super::vertical::{Direction, Reason, Vertical};
use std::fmt;

/// A warning about the quality of a recording.
#[derive(Clone, Debug, PartialEq)]
pub enum Warning {
    /// Samples are unevenly spaced.
    Uneven {
        /// [`Facts::jitter`].
        jitter: f64,
    },
    /// Samples are missing.
    Gaps {
        /// Their number.
        count: u64,
        /// The longest of them.
        longest: Gap,
    },
    /// Several rows have one time; the first of them is kept.
    RepeatedTimes {
        /// Rows left out.
        count: u64,
        /// The line of the first.
        line: u64,
    },
    /// Rows without time or acceleration.
    BlankRows {
        /// Their number.
        count: u64,
        /// The number of the others.
        samples: u64,
    },
    /// The file ends within a row, which is left out.
    CutOff {
        /// The last line.
        line: u64,
    },
    /// The sensor was at its limit.
    Saturated {
        /// The share of samples at the limit.
        share: f64,
        /// m/s².
        least: f64,
        /// m/s².
        greatest: f64,
    },
    /// The sensor's step is as coarse as its noise, so that many samples are equal.
    CoarseStep {
        /// m/s².
        quantum: f64,
        /// The share of samples that equal the one before.
        repeats: f64,
    },
    /// Many samples equal the one before without a grid: a slow sensor was read too often.
    Held {
        /// The share of samples that equal the one before.
        repeats: f64,
    },
    /// No axis stands out.
    NearTie(Vertical),
    /// The nearest axis is far from gravity.
    Tilted {
        /// Degrees.
        angle: f64,
    },
    /// A magnitude has no sign.
    Magnitude {
        /// Its name.
        column: String,
    },
    /// The mean is far beyond gravity's.
    PerhapsCounts {
        /// The mean as read.
        mean: f64,
    },
    /// The header names no unit, and the mean is 1.
    PerhapsGravity {
        /// The mean as read.
        mean: f64,
    },
}

/// The smallest jitter with a warning. Sensors with their own clock stay below 0.1 %; apps that record the time
/// of their call are above 10 %.
const UNEVEN: f64 = 0.05;

/// The share of equal neighbours from which a step counts as coarse. For normal noise of standard deviation s
/// and steps q the share is 0.28 q/s: here q is 0.7 s.
const COARSE: f64 = 0.2;

/// Degrees.
const TILTED: f64 = 25.0;

/// A mean that no recording of a lift has, m/s²: twice gravity.
const BEYOND_GRAVITY: f64 = 20.0;

impl Warning {
    /// All that apply.
    pub(super) fn all(facts: &Facts, layout: &Layout, vertical: &Vertical) -> Vec<Self> {
        let columns = layout.acceleration.columns();
        let magnitude = columns.iter().map(|&index| &layout.columns[index]);
        let magnitude = magnitude
            .filter(|column| column.role == Role::Magnitude)
            .map(|column| Self::Magnitude {
                column: column.name.clone(),
            })
            .next();
        let may_be_g = !layout.is_unit_stated && (0.9..=1.1).contains(&facts.mean.abs());
        let tilt = match (&vertical.direction, vertical.reason) {
            (Direction::Along { .. }, Reason::Gravity(angle)) => Some(angle),
            _ => None,
        };
        // Samples at a limit are equal too, but for another reason.
        let is_held = facts.repeats - facts.saturated.unwrap_or(0.0) >= COARSE;
        let found = [
            magnitude,
            may_be_g.then_some(Self::PerhapsGravity { mean: facts.mean }),
            (facts.mean.abs() > BEYOND_GRAVITY).then_some(Self::PerhapsCounts { mean: facts.mean }),
            (vertical.reason == Reason::NearTie).then(|| Self::NearTie(vertical.clone())),
            tilt.filter(|angle| *angle > TILTED)
                .map(|angle| Self::Tilted { angle }),
            (facts.jitter > UNEVEN).then_some(Self::Uneven {
                jitter: facts.jitter,
            }),
            (facts.gaps > 0).then_some(Self::Gaps {
                count: facts.gaps,
                longest: facts.longest_gap,
            }),
            facts.first_repeated_time.map(|line| Self::RepeatedTimes {
                count: facts.repeated_times,
                line,
            }),
            (facts.blank_rows > 0).then_some(Self::BlankRows {
                count: facts.blank_rows,
                samples: facts.samples,
            }),
            facts.cut_line.map(|line| Self::CutOff { line }),
            facts.saturated.map(|share| Self::Saturated {
                share,
                least: facts.least,
                greatest: facts.greatest,
            }),
            match facts.quantum {
                Some(quantum) if is_held => Some(Self::CoarseStep {
                    quantum,
                    repeats: facts.repeats,
                }),
                None if is_held => Some(Self::Held {
                    repeats: facts.repeats,
                }),
                _ => None,
            },
        ];
        found.into_iter().flatten().collect()
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let percent = |share: f64| 100.0 * share;
        match self {
            Self::Uneven { jitter } => write!(
                f,
                "sampling is uneven: intervals deviate by {:.1} % (--resample HZ evens it out)",
                percent(*jitter)
            ),
            Self::Gaps { count, longest } => write!(
                f,
                "samples are missing: {count} gaps, the longest {:.3} s after {:.3} s",
                longest.length, longest.start
            ),
            Self::RepeatedTimes { count: 1, line } => write!(
                f,
                "line {line}: time repeats once (the first reading is kept)"
            ),
            Self::RepeatedTimes { count, line } => write!(
                f,
                "line {line}: time repeats here, {count} times in all (the first reading is kept)"
            ),
            Self::BlankRows { count, samples } => write!(
                f,
                "{count} rows have no time or no acceleration, {samples} have both (the others are left out)"
            ),
            Self::CutOff { line } => {
                write!(
                    f,
                    "line {line}: the file ends within this row (it is left out)"
                )
            }
            Self::Saturated {
                share,
                least,
                greatest,
            } => write!(
                f,
                "the sensor was at its limit in {:.2} % of the samples, which span {least} to {greatest} m/s^2",
                percent(*share)
            ),
            Self::CoarseStep { quantum, repeats } => write!(
                f,
                "the sensor's step of {quantum:.3} m/s^2 is coarse: {:.0} % of the samples equal the one before",
                percent(*repeats)
            ),
            Self::Held { repeats } => write!(
                f,
                "{:.0} % of the samples equal the one before (a slow sensor was probably read too often)",
                percent(*repeats)
            ),
            Self::NearTie(vertical) => write!(f, "vertical axis: {vertical} (--axis x, y or z)"),
            Self::Tilted { angle } => write!(
                f,
                "the vertical axis lies {angle:.0} degrees from gravity, and the axes stand in different \
                 rows, so they cannot be turned"
            ),
            Self::Magnitude { column } => write!(
                f,
                "column \"{column}\" is a magnitude: it cannot tell up from down (--acceleration COLUMN)"
            ),
            Self::PerhapsCounts { mean } => write!(
                f,
                "the mean is {mean:.1} m/s^2, that of gravity 9.8 (give the unit with --unit)"
            ),
            Self::PerhapsGravity { mean } => write!(
                f,
                "no unit is named, and the mean is {mean:.3} m/s^2 (--unit g, if readings are in g)"
            ),
        }
    }
}
