//! The error of a trip by the air, a way to a series.

use super::table::{Point, Row};
use super::trial::Way;
use crate::plot::Plot;
use crate::study::dots;
use crate::study::outcomes::facts;

/// The picture of a study.
pub fn plot(rows: &[Row], points: &[Point], seed: u64) -> Plot {
    let named = points.iter().map(|point| {
        let estimates = Way::ALL.map(|way| {
            let outcome = format!("rms_{}", way.name());
            let here = |row: &&Row| {
                (row.temperature, row.pressure) == (point.temperature, point.pressure)
                    && row.outcome == outcome
            };
            let row = rows.iter().find(here);
            row.map(|row| [row.low, row.estimate, row.high])
        });
        let name = format!("{} °C, {} hPa", point.temperature, point.pressure);
        (name, estimates.to_vec())
    });
    let facts = facts(rows, "lifts", seed, "bars");
    let lift = "ten floors 4 m apart; MPU-6050, BMP180".to_owned();
    let caption = [vec![lift], facts.to_vec()].concat();
    let series = Way::ALL.map(|it| it.name().to_owned());
    dots::plot(
        &named.collect(),
        series.into(),
        "RMS error of a trip's height, m",
        &caption,
    )
}
