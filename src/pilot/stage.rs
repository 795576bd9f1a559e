//! Pilots that run together.

use super::gather::{Gauge, Gauges};
use crate::chain::{Purpose, RecordTooLong, Scenario};
use crate::schedule::Schedule;

/// Pilots that run together.
#[derive(Debug, Default)]
pub(super) struct Stage {
    scenarios: Vec<Scenario>,
    /// The empty gauge of each scenario.
    gauges: Vec<Gauge>,
    schedule: Option<Schedule>,
}

impl Stage {
    /// Adds a pilot and returns its index.
    pub fn add(&mut self, scenario: Scenario, gauge: Gauge) -> usize {
        self.scenarios.push(scenario);
        self.gauges.push(gauge);
        self.gauges.len() - 1
    }

    pub fn arrange(
        &mut self,
        trials: u64,
        seed: u64,
        purpose: Purpose,
    ) -> Result<(), RecordTooLong> {
        if !self.scenarios.is_empty() {
            let schedule = Schedule::new(&self.scenarios, trials, seed, purpose, true);
            self.schedule = Some(schedule.map_err(|(_, refusal)| refusal)?);
        }
        Ok(())
    }

    /// The total that the progress of [`run`](Self::run) reaches.
    pub fn work(&self) -> u64 {
        self.schedule.as_ref().map_or(0, Schedule::work)
    }

    /// Runs all trials and returns the gauges.
    pub fn run(&self, progress: impl Fn(u64) + Sync) -> Vec<Gauge> {
        let new = || Gauges(self.gauges.clone());
        let schedule = self.schedule.as_ref();
        schedule.map_or(Vec::new(), |schedule| {
            schedule.run(new, Gauges::merged, progress).0
        })
    }
}
