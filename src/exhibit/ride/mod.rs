//! Whole rides before the monitor: is every trip found, how late, how often does rest look like motion, does a jam
//! alarm, and what becomes of a monitor that is switched on in motion?
//!
//! A trial is one ride, one rest, or both, simulated, watched, and compared with the truth. Every point sees the
//! same draws of a trial, so points that differ in strength or in the monitor's settings alone are compared on the
//! same noise.
//!
//! | outcome | of | is |
//! |---|---|---|
//! | `found` | trials | rides of which every trip is found: start and stop reported within the tolerance of the truth, in the right direction |
//! | `start_delay_05`, `_50`, `_95` | trips | quantiles of the time from a start to its report |
//! | `stop_delay_…` | trips | the same for stops |
//! | `false_motions` | hours | starts reported while the cage stood, of a time when it stood, per hour for which the monitor said `rest` of a cage at rest |
//! | `hours_between` | hours | the mean time between them |
//! | `disturbed` | trials | rests with a false motion |
//! | `alarmed` | trials | jams with an alarm that comes after them, of no later time than the stand |
//! | `alarm_delay_…` | jams | the time from a jam to its alarm |
//! | `false_alarms` | trials | jam alarms without a jam, per trial |
//! | `misled` | trials | switched on in motion, the monitor said `rest` before the cage stood |
//! | `knew_soon`, `knew` | trials | it said `rest` when the next trip began, and when the record ended |
//!
//! What was never reported took infinitely long: a quantile beyond the share that was reported is infinite.

mod account;
mod estimate;
mod row;
mod sums;
#[cfg(test)]
mod tests;
mod trial;

pub use row::Row;
pub use sums::RideSums;

use crate::config::{ExhibitConfig, RideStudy};
use crate::results::Quantity;
use rayon::prelude::*;
use trial::PointTrials;

/// All outcomes of every point, in the order of curves and values.
pub fn rows(config: &ExhibitConfig, study: &RideStudy) -> Vec<Row> {
    let curves = study.curves.iter().enumerate();
    let points = curves.flat_map(|(index, curve)| curve.points.iter().map(move |at| (index, at)));
    points
        .flat_map(|(index, (x, point))| {
            let trials = PointTrials::new(point, config.seed);
            let estimates = estimate::of(
                study.measure,
                &sums(&trials, config.trials),
                config.confidence,
            );
            estimates.into_iter().map(move |estimate| {
                Row::new(study, index, *x, point, trials.size(), estimate, config)
            })
        })
        .collect()
}

fn sums(point: &PointTrials, trials: u64) -> RideSums {
    (0..trials)
        .into_par_iter()
        .fold(RideSums::default, |mut sums, trial| {
            sums.count(&point.trial(trial));
            sums
        })
        .reduce(RideSums::default, |mut sums, other| {
            sums += other;
            sums
        })
}

/// Every outcome by name: that of the outcome, of its curve and of its place on the axis.
pub fn quantities(study: &RideStudy, rows: &[Row]) -> Vec<Quantity> {
    let quantity = |row: &Row| {
        let curve = study.curves[row.curve - 1].name();
        let x = row.x.to_string().replace('.', "_");
        Quantity {
            name: format!("{}_{curve}_at_{x}", row.outcome),
            value: row.estimate,
            low: row.low,
            high: row.high,
        }
    };
    rows.iter().map(quantity).collect()
}
