//! Conditions one under the other, an estimator to a series.

use super::condition::Condition;
use super::row::Row;
use crate::format::thousands;
use crate::plot::Plot;
use crate::study::dots;
use crate::track::gravity::Estimator;

/// The picture of a study.
pub fn plot(rows: &[Row], conditions: &[Condition], seed: u64) -> Plot {
    let named = conditions.iter().map(|condition| {
        let estimates = Estimator::ALL.map(|estimator| {
            let outcome = format!("error_{}", estimator.name());
            let here = |row: &&Row| row.condition == *condition && row.outcome == outcome;
            let row = rows.iter().find(here);
            row.map(|row| [row.low, row.estimate, row.high])
        });
        (condition.to_string().replace('_', " "), estimates.to_vec())
    });
    let caption = [
        "gravity from 2 s of an MPU-6050 at rest".to_owned(),
        format!("{} windows a point", thousands(rows[0].trials)),
        format!("seed {seed}"),
        format!("bars: {} % intervals", 100.0 * rows[0].confidence),
    ];
    let series = Estimator::ALL.map(|it| it.name().to_owned());
    dots::plot(
        &named.collect(),
        series.into(),
        "RMS error, mm/s²",
        &caption,
    )
}
