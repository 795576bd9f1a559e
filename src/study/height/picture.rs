//! The mean error along the drift, and below it how often it is how large where the weather drifts most; a way to a curve.

use super::row::Row;
use super::way::{SHARES, Way};
use crate::plot::{Axis, Curve, Limit, Mark, Panel, Plot, Point, Style, add_bands, ends};
use crate::study::along::{self, Kind, Outcome, Shown};
use crate::study::outcomes::facts;
use libm::log10;

/// The least error that is drawn, m: those of trials are in steps of it.
const LEAST: f64 = 1e-3;

/// The picture of a study.
pub fn plot(rows: &[Row], seed: u64) -> Plot {
    let each = (1..).zip(Way::ALL);
    let outcomes = each.flat_map(|(curve, way)| {
        let name = format!("error_{}", way.name());
        let here = rows.iter().filter(move |row| row.outcome == name);
        here.map(move |row| Outcome {
            name: "error",
            ..Outcome::of(row, curve, row.drift)
        })
    });
    let labels = Way::ALL.map(|it| it.name().replace('_', " ").replace(" q", " Q"));
    let shown = Shown::new(
        "error",
        "mean error of the height, m",
        Kind::Positive(Limit::Upper),
        230.0,
    );
    let facts = facts(rows, "lifts", seed, "bands");
    let caption = [
        vec!["ten floors 4 m apart; MPU-6050, BMP180".to_owned()],
        facts.to_vec(),
    ]
    .concat();
    let axis = "drift of the weather, hPa an hour";
    let mut plot = along::plot(outcomes, &labels, vec![shown], axis, &caption);
    add_distribution(&mut plot, rows);
    plot
}

/// Adds the panel of the share of the time, by the error that it stays within.
fn add_distribution(plot: &mut Plot, rows: &[Row]) {
    let drift = rows.iter().map(|row| row.drift).fold(0.0, f64::max);
    let curves = (0..).zip(Way::ALL).map(|(index, way)| {
        let point = |share: u8| {
            let outcome = format!("error_{share}_{}", way.name());
            let mut rows = rows.iter();
            let row = rows.find(|row| row.drift == drift && row.outcome == outcome)?;
            let error = log10(row.estimate.max(LEAST));
            let place = (error, f64::from(share) / 100.0);
            error.is_finite().then_some(Point::at(place))
        };
        Curve {
            style: Style::of(index),
            points: SHARES.into_iter().filter_map(point).collect(),
        }
    });
    let curves: Vec<Curve> = curves.collect();
    let errors = curves.iter().flat_map(|it| &it.points).map(|it| it.x);
    let (low, high) = ends(errors);
    let (low, high) = if low < high { (low, high) } else { (-2.0, 0.0) };
    let x = format!("error of the height, m, where the weather drifts by {drift} hPa an hour");
    let x = Axis::decades(low - 0.1, high + 0.1).labelled(x);
    let y = Axis::linear(0.0, 1.0, 5).labelled("share of the time");
    plot.panels.push(Panel::new(150.0, x, y));
    let panel = plot.panels.len() - 1;
    plot.add(panel, Mark::Grid);
    add_bands(plot, panel, &curves);
    plot.add(panel, Mark::Axes);
}
