//! The mean error along the drift, a way to a curve.

use super::row::Row;
use super::way::Way;
use crate::plot::{Limit, Plot};
use crate::study::along::{self, Kind, Outcome, Shown};
use crate::study::outcomes::facts;

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
    along::plot(
        outcomes,
        &labels,
        vec![shown],
        "drift of the weather, hPa an hour",
        &caption,
    )
}
