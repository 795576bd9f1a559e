//! Where points and rows stand on the axis.

use crate::experiment::{Axis, Config, Parameter};
use crate::plan::{Hypothesis, Point};
use crate::results::Row;

/// The point of a curve at a value of the axis (from 0): the one in motion, or the one at rest where
/// nothing in the curve moves. What is the same at rest is planned once, under the first curve.
pub(super) fn point_at(
    config: &Config,
    points: &[Point],
    label: &str,
    value: usize,
) -> Option<usize> {
    let curve = config
        .curves
        .iter()
        .position(|curve| curve.label == label)?;
    let moving = |point: &Point| point.curve == curve && point.hypothesis == Hypothesis::H1;
    let of_curve: Vec<usize> = (0..points.len()).filter(|&i| moving(&points[i])).collect();
    if !of_curve.is_empty() {
        return of_curve.get(value).copied();
    }
    let scenario = config.scenario(curve, &config.axis.values[value]).ok()?;
    let at_rest = scenario.at_rest();
    points
        .iter()
        .position(|point| point.hypothesis == Hypothesis::H0 && point.scenario == at_rest)
}

/// The rows of a curve, in motion or at rest, each with its value on the axis.
///
/// A curve with a row for each value is placed by the values themselves, which a row need not repeat;
/// at rest equal points are told once, and the rows must do.
pub fn placed<'a>(
    axis: Option<&Axis>,
    rows: &'a [Row],
    label: &str,
    is_at_rest: bool,
) -> Vec<(String, &'a Row)> {
    let of_curve = rows
        .iter()
        .filter(|row| row.label == label && row.is_at_rest() == is_at_rest);
    let of_curve: Vec<&Row> = of_curve.collect();
    let count = of_curve.len();
    let value = |(index, row): (usize, &Row)| match axis {
        Some(axis) if axis.values.len() == count => axis.values[index].to_string(),
        Some(axis) => column(row, axis.parameter),
        None => String::new(),
    };
    let rows = of_curve.into_iter().enumerate();
    rows.map(|(index, row)| (value((index, row)), row))
        .collect()
}

/// The value of the axis at a row, as an axis prints it.
fn column(row: &Row, parameter: Parameter) -> String {
    match (parameter, row.on_axis(parameter.name())) {
        (Parameter::Rule, _) => row.rule_name().to_owned(),
        (_, Some(number)) => number.to_string(),
        (_, None) => "none".to_owned(),
    }
}
