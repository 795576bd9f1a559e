//! Where rows stand in their panel.

use super::shown::{Kind, Shown};
use crate::config::{Measure, RideStudy};
use crate::figure::frame::Scale;
use crate::figure::panel::{Panel, Point};
use crate::figure::ruler::{around, is_long};
use crate::study::rows::Ride as Row;

/// Where rows stand.
pub(super) struct Places<'a> {
    study: &'a RideStudy,
    rows: &'a [Row],
    is_logarithmic: bool,
}

impl<'a> Places<'a> {
    pub fn new(study: &'a RideStudy, rows: &'a [Row]) -> Self {
        let values: Vec<f64> = rows.iter().map(|row| row.x).collect();
        Self {
            study,
            rows,
            is_logarithmic: study.measure != Measure::Tradeoff && is_long(&values),
        }
    }

    /// The rows of an outcome, in the order of the axis.
    fn of(&self, curve: usize, outcome: &str) -> Vec<&'a Row> {
        let rows = self.rows.iter();
        rows.filter(|row| row.curve == curve + 1 && row.outcome == outcome)
            .collect()
    }

    /// Those of a curve that lie on the paper.
    pub fn points(&self, shown: &Shown, curve: usize) -> Vec<Point> {
        let mut points = match shown.kind {
            Kind::Delay => self.delays(shown, curve),
            Kind::Share | Kind::Positive(_) => self.rates(shown, curve),
        };
        points.retain(|point| point.x.is_finite() && point.rate.is_finite());
        points
    }

    /// Medians, and bands to the quantiles on either side where both are finite.
    fn delays(&self, shown: &Shown, curve: usize) -> Vec<Point> {
        let quantiles = ["05", "50", "95"].map(|name| format!("{}_{name}", shown.outcome));
        let [low, middle, high] = quantiles.map(|outcome| self.of(curve, &outcome));
        let point = |(row, (low, high)): (&&Row, (&Row, &Row))| {
            let middle = row.estimate;
            let (low, high) = match high.estimate.is_finite() {
                true => (low.estimate, high.estimate),
                false => (middle, middle),
            };
            Point {
                x: self.x(row),
                rate: middle,
                low,
                high,
                bound: None,
            }
        };
        middle
            .iter()
            .zip(low.into_iter().zip(high))
            .map(point)
            .collect()
    }

    fn rates(&self, shown: &Shown, curve: usize) -> Vec<Point> {
        let rows = self.of(curve, shown.outcome);
        let places: Vec<f64> = match self.study.measure {
            Measure::Tradeoff => {
                let delays = self.of(curve, "start_delay_50");
                delays.iter().map(|row| row.estimate).collect()
            }
            _ => rows.iter().map(|row| self.x(row)).collect(),
        };
        let placed = rows.into_iter().zip(places);
        placed.map(|(row, x)| point(row, x, shown.kind)).collect()
    }

    fn x(&self, row: &Row) -> f64 {
        match self.is_logarithmic {
            true => libm::log10(row.x),
            false => row.x,
        }
    }

    /// From the first of them to the last.
    pub fn scale(&self, panels: &[Panel]) -> Scale {
        let curves = panels.iter().flat_map(|panel| &panel.curves);
        let drawn: Vec<f64> = curves
            .flat_map(|curve| curve.points.iter().map(|p| p.x))
            .collect();
        match drawn.is_empty() {
            true => Scale::single(0.0),
            false => around(&drawn, self.is_logarithmic),
        }
    }
}

/// A rate and its interval; on a logarithmic scale, where nothing was counted, an arrow, which tells more than a
/// band to the end of the paper.
fn point(row: &Row, x: f64, kind: Kind) -> Point {
    let mut point = Point {
        x,
        rate: row.estimate,
        low: row.low,
        high: row.high,
        bound: None,
    };
    if let Kind::Positive(bound) = kind {
        point.bound = (row.count == 0).then_some(bound);
        point.take_logarithms();
    }
    if point.bound.is_some() {
        (point.low, point.high) = (point.rate, point.rate);
    }
    point
}

/// From 0 to 1 for a probability; around what there is otherwise.
pub(super) fn scale(kind: Kind, panel: &Panel) -> Scale {
    let points = || panel.curves.iter().flat_map(|curve| &curve.points);
    let largest = |values: &mut dyn Iterator<Item = f64>| {
        values
            .filter(|value| value.is_finite())
            .fold(f64::NEG_INFINITY, f64::max)
    };
    let rates = || points().map(|point| point.rate);
    match kind {
        _ if points().next().is_none() => Scale::linear(0.0, 1.0, 5),
        Kind::Share => Scale {
            from: -0.03,
            to: 1.03,
            ..Scale::linear(0.0, 1.0, 5)
        },
        Kind::Delay => {
            let top = largest(&mut points().map(|point| point.high)).max(largest(&mut rates()));
            Scale::linear(0.0, 1.08 * top, 5)
        }
        Kind::Positive(_) => {
            let bottom = -largest(&mut rates().map(|rate| -rate));
            Scale::decades(bottom - 0.35, largest(&mut rates()) + 0.35)
        }
    }
}
