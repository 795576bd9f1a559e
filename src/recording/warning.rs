//! Warnings about the quality of a recording, and about what was assumed in reading it.

use super::axis::Axis;
use super::facts::{Facts, Gap};
use super::names::Role;
use super::spread::Repeats;
use super::table::Columns;
use super::unit::Unit;
use super::vertical::{Reason, Vertical};

/// A warning about the quality of a recording, or about an assumption.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "what a message says is not said again")]
pub enum Warning {
    #[error(
        "the columns have no names: they were taken for {0} (--time and --acceleration choose others)"
    )]
    NoNames(&'static str),
    #[error(
        "no unit is named, and the mean is {mean:.3}, as {unit} have it: this was assumed (--unit m/s^2, g, mg, or \
         counts with --scale, says otherwise)"
    )]
    UnitAssumed { mean: f64, unit: String },
    #[error(
        "Sensor Logger writes {unit} without gravity on {platform}: this was assumed by the size of the pulses \
         (--unit {other} says otherwise)"
    )]
    PlatformAssumed {
        unit: Unit,
        other: Unit,
        platform: &'static str,
    },
    #[error(
        "each time stands for {rows} rows: they were spread evenly to the next (--rate HZ, if they come at a rate)"
    )]
    Spread { rows: usize },
    #[error("the clock of 32 bits began again {0} times; its times were continued")]
    Wrapped(u64),
    #[error("vertical: {0}")]
    Vertical(Vertical),
    #[error(
        "the sensor is tilted: the vertical lies {from:.0} degrees from the axis that is read, so that speeds and distances \
         are {} % too small (lay it flat, or record all axes in every row)",
        too_small(*.from)
    )]
    Tilted { from: f64 },
    #[error(
        "the sensor is tilted: the vertical lies {from:.0} degrees from {axis}, as {by} along all three axes show, so that \
         speeds and distances are {} % too small (leave out --axis: then the three are projected)",
        too_small(*.from)
    )]
    TiltedAxis {
        axis: Axis,
        from: f64,
        by: &'static str,
    },
    #[error("column \"{0}\" is a magnitude: it cannot tell up from down (--acceleration COLUMN)")]
    Magnitude(String),
    #[error("the mean is {0:.1} m/s^2, that of gravity 9.8 (give the unit with --unit)")]
    PerhapsCounts(f64),
    #[error("sampling is uneven: intervals deviate by {:.1} % (--resample HZ evens it out)", 100.0 * .jitter)]
    Uneven { jitter: f64 },
    #[error(
        "{}{:.1} % of the samples are missing: {count}, the longest gap is {:.3} s, after {:.3} s (a lower rate of \
         recording often helps)",
        if *.may_be_more { "at least " } else { "" },
        100.0 * .share,
        .longest.length,
        .longest.start
    )]
    Missing {
        count: u64,
        share: f64,
        longest: Gap,
        may_be_more: bool,
    },
    #[error("line {line}: time repeats {} (the first reading is kept)", repeats(*.count))]
    RepeatedTimes { count: u64, line: u64 },
    #[error(
        "{count} rows have no time or no acceleration, {samples} have both (the others are left out)"
    )]
    BlankRows { count: u64, samples: u64 },
    #[error("rows with NaN for the acceleration: {0} (they are left out)")]
    MissingRows(u64),
    #[error("line {line}: the file ends within this row (it is left out)")]
    CutOff { line: u64 },
    #[error(
        "the sensor was at its limit in {:.2} % of the samples, which span {least} to {greatest} m/s^2",
        100.0 * .share
    )]
    Saturated {
        share: f64,
        least: f64,
        greatest: f64,
    },
    #[error(
        "the sensor's step of {quantum:.3} m/s^2 is coarse: {:.0} % of the samples equal the one before (an acceleration of one \
         step may be taken for the level)",
        100.0 * .repeats
    )]
    CoarseStep { quantum: f64, repeats: f64 },
    #[error(
        "{:.0} % of the samples equal the one before (a slow sensor was probably read too often)",
        100.0 * .repeats
    )]
    Held { repeats: f64 },
}

/// By how much a reading along an axis is too small that lies so many degrees from the vertical, %.
fn too_small(degrees: f64) -> f64 {
    (100.0 * (1.0 - libm::cos(degrees.to_radians()))).round()
}

fn repeats(count: u64) -> String {
    match count {
        1 => "once".to_owned(),
        _ => format!("here, {count} times in all"),
    }
}

/// The smallest jitter with a warning. Sensors with their own clock stay below 0.1 %; apps that record the time
/// of their call are above 10 %.
const UNEVEN: f64 = 0.05;

/// The smallest share of missing samples with a warning, unless some of them leave a gap.
const MISSING: f64 = 0.01;

/// The share of equal neighbours from which a step counts as coarse. For normal noise of standard deviation s
/// and steps q the share is 0.28 q/s: here q is 0.7 s.
const COARSE: f64 = 0.2;

/// Degrees: a tenth is missing.
const TILTED: f64 = 25.0;

/// The same for an axis that was chosen where the vertical is known: 3 % are missing, a few times what the direction of
/// pulses may be off by.
const TILTED_AXIS: f64 = 15.0;

/// A mean that no recording of a lift has, m/s²: twice gravity.
pub(super) const BEYOND_GRAVITY: f64 = 20.0;

/// The warnings about a table and its rows, of which `samples` were not blank.
pub(super) fn of_rows(columns: &Columns, repeats: Repeats, samples: u64) -> Vec<Warning> {
    let (layout, skipped) = (&columns.parser.layout, &columns.skipped);
    let mut warnings = Vec::new();
    if layout.is_guessed {
        warnings.push(Warning::NoNames(if layout.time.is_some() {
            "time, x, y and z"
        } else {
            "x, y and z"
        }));
    }
    let mut read = layout
        .axes
        .iter()
        .map(|(_, column)| &layout.columns[*column]);
    let magnitude = read.find(|column| column.role == Role::Magnitude);
    warnings.extend(magnitude.map(|column| Warning::Magnitude(column.name.clone())));
    match (repeats, skipped.first_repeat) {
        (Repeats::LeftOut(count @ 1..), Some(line)) => {
            warnings.push(Warning::RepeatedTimes { count, line });
        }
        (Repeats::Spread(rows), _) => warnings.push(Warning::Spread { rows }),
        _ => {}
    }
    if columns.parser.clock.wraps > 0 {
        warnings.push(Warning::Wrapped(columns.parser.clock.wraps));
    }
    if skipped.blank > 0 {
        let count = skipped.blank;
        warnings.push(Warning::BlankRows { count, samples });
    }
    if skipped.missing > 0 {
        warnings.push(Warning::MissingRows(skipped.missing));
    }
    warnings.extend(skipped.cut.map(|line| Warning::CutOff { line }));
    warnings
}

/// The warning about an axis that was chosen, beside what all three show.
pub(super) fn of_axis(axis: Axis, index: usize, shown: &Vertical) -> Option<Warning> {
    let by = match shown.reason {
        Reason::Gravity { .. } => "readings",
        Reason::Pulses => "pulses",
        _ => return None,
    };
    let from = libm::acos(shown.up[index].abs().min(1.0)).to_degrees();
    (from > TILTED_AXIS).then_some(Warning::TiltedAxis { axis, from, by })
}

/// The warnings about the vertical and the signal, which will be resampled if it `is_even`.
pub(super) fn of_signal(
    facts: &Facts,
    vertical: &Vertical,
    is_reversed: bool,
    is_even: bool,
) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let is_turned = matches!(vertical.reason, Reason::Gravity { turned, .. } if turned > 0.0);
    if is_reversed || is_turned || vertical.reason == Reason::Nothing {
        warnings.push(Warning::Vertical(vertical.clone()));
    }
    match (vertical.column, vertical.reason) {
        (Some(_), Reason::Gravity { from, .. }) if from > TILTED => {
            warnings.push(Warning::Tilted { from });
        }
        _ => {}
    }
    if facts.mean.abs() > BEYOND_GRAVITY {
        warnings.push(Warning::PerhapsCounts(facts.mean));
    }
    if facts.jitter > UNEVEN && !is_even {
        let jitter = facts.jitter;
        warnings.push(Warning::Uneven { jitter });
    }
    let share = facts.missing_share();
    if facts.gaps > 0 || share >= MISSING {
        let (count, longest) = (facts.missing, facts.longest_gap);
        warnings.push(Warning::Missing {
            count,
            share,
            longest,
            may_be_more: facts.may_lack_more(),
        });
    }
    warnings.extend(facts.saturated.map(|share| Warning::Saturated {
        share,
        least: facts.least,
        greatest: facts.greatest,
    }));
    // Samples at a limit are equal too, but for another reason.
    let repeats = facts.repeats;
    if repeats - facts.saturated.unwrap_or(0.0) >= COARSE {
        warnings.push(match facts.quantum {
            Some(quantum) => Warning::CoarseStep { quantum, repeats },
            None => Warning::Held { repeats },
        });
    }
    warnings
}
