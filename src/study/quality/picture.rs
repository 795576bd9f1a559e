//! The error of every figure over what it is, by condition, of the rides that are shaken most.

use super::row::Row;
use super::table::Point;
use crate::plot::Plot;
use crate::study::dots;
use crate::study::outcomes::facts;
use crate::track::quality::Measure;

/// The picture of a study.
pub fn plot(rows: &[Row], points: &[Point], seed: u64) -> Plot {
    let most = points.iter().map(|it| it.vibration).fold(0.0, f64::max);
    let shown: Vec<&Point> = points.iter().filter(|it| it.vibration == most).collect();
    let named = Measure::ALL.map(|measure| {
        let estimates = shown.iter().map(|point| {
            let row = |outcome: &str| {
                let name = format!("{outcome}_{}", measure.name());
                let here = |row: &&Row| {
                    row.condition == point.condition && row.vibration == most && row.outcome == name
                };
                rows.iter().find(here)
            };
            let (error, truth) = row("rms").zip(row("true"))?;
            Some([error.low, error.estimate, error.high].map(|it| it / truth.estimate))
        });
        (measure.name().replace('_', " "), estimates.collect())
    });
    let facts = facts(rows, "rides", seed, "bars");
    let caption = [
        vec![format!("rides of 20 m that shake with {most} m/s²")],
        facts.to_vec(),
    ]
    .concat();
    let series = shown
        .iter()
        .map(|it| it.condition.to_string().replace('_', " "));
    dots::plot(
        &named.into(),
        series.collect(),
        "RMS error over the figure",
        &caption,
    )
}
