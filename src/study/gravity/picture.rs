//! Conditions one under the other, an estimator to a series.

use super::condition::Condition;
use super::row::Row;
use crate::plot::Plot;
use crate::study::dots;
use crate::study::outcomes::facts;
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
    let facts = facts(rows, "windows", seed, "bars");
    let caption = [
        vec!["gravity from 2 s of an MPU-6050 at rest".to_owned()],
        facts.to_vec(),
    ]
    .concat();
    let series = Estimator::ALL.map(|it| it.name().to_owned());
    dots::plot(
        &named.collect(),
        series.into(),
        "RMS error, mm/s²",
        &caption,
    )
}
