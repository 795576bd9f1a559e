//! The RMS error over the bound: of every way under the first condition, then of `track` under the others.

use super::condition::Condition;
use super::row::Row;
use super::trial::Way;
use crate::plot::Plot;
use crate::study::dots;
use crate::study::outcomes::facts;

/// The picture of a study.
pub fn plot(rows: &[Row], conditions: &[Condition], seed: u64) -> Plot {
    let over = |condition: Condition, way: Way| {
        let outcome = format!("over_bound_{}", way.name());
        let here = |row: &&Row| row.condition == condition && row.outcome == outcome;
        let name = format!("{condition}, {}", way.name()).replace('_', " ");
        let estimates = rows.iter().filter(here);
        let estimates =
            estimates.map(|row| (row.count > 0).then_some([row.low, row.estimate, row.high]));
        (name, estimates.collect())
    };
    let ways = Way::ALL.map(|way| over(conditions[0], way)).into_iter();
    let others = conditions[1..].iter().map(|it| over(*it, Way::Track));
    let mut lengths: Vec<f64> = rows.iter().map(|row| row.distance).collect();
    lengths.sort_unstable_by(f64::total_cmp);
    lengths.dedup();
    let lengths = lengths.iter().map(|length| format!("{length} m"));
    let facts = facts(rows, "trips", seed, "bars");
    let caption = [
        vec!["each trip simulated with its accelerometer record".to_owned()],
        facts.to_vec(),
    ]
    .concat();
    let named = ways.chain(others).collect();
    dots::plot(
        &named,
        lengths.collect(),
        "RMS error over the bound",
        &caption,
    )
}
