//! What every single trial gave: W, the exceedances and the decision.

use super::Sweep;
use crate::chain::{Decision, Observation, View};
use crate::pilot::Pilots;
use crate::plan::Point;
use crate::run::{Progress, StudyError};
use crate::schedule::{BLOCK, Gather};
use rayon::prelude::*;
use std::ops::Range;

/// The outcomes of consecutive trials of one point.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TrialOutcomes {
    /// W.
    pub rank_sums: Vec<u64>,
    /// T, or T′ where the config counts those of all of the motion.
    pub exceedances: Vec<u32>,
    /// Whether the decision was H₁.
    pub h1: Vec<bool>,
}

impl Sweep {
    /// The outcomes of some points, by their numbers in ascending order, in a range of trials: those that a run counts,
    /// simulated again.
    ///
    /// # Errors
    /// If a pilot shows no decision.
    pub fn trial_outcomes(
        &self,
        places: &[usize],
        trials: &Range<u64>,
        progress: &dyn Progress,
    ) -> Result<Vec<TrialOutcomes>, StudyError> {
        let plan = &self.plan;
        let points: Vec<Point> = places.iter().map(|&at| plan.points[at].clone()).collect();
        let pilots = Pilots::new(&points, plan.pilot, plan.seed)?;
        progress.begin("pilots", pilots.work(), plan.pilot);
        let decisions = pilots.decide(|work| progress.done(work));
        progress.end();
        let decisions = decisions?;
        let schedule = plan.schedule_of(places);
        let length = trials.end - trials.start;
        progress.begin("trials", length * points.len() as u64, length);
        let mut all = vec![TrialOutcomes::default(); points.len()];
        let firsts: Vec<u64> = trials.clone().step_by(BLOCK as usize).collect();
        let parts = schedule.families.iter().enumerate();
        for ((number, family), firsts) in
            parts.flat_map(|of| firsts.chunks(AT_ONCE).map(move |at| (of, at)))
        {
            let blocks = firsts.par_iter().map(|&first| {
                let block = first..trials.end.min(first + BLOCK);
                let mut watched = Watched {
                    points: &points,
                    decisions: &decisions,
                    seen: vec![TrialOutcomes::default(); points.len()],
                };
                let work = (block.end - block.start) * family.points_per_trial() as u64;
                schedule.run_block(number, block, &mut watched);
                progress.done(work);
                watched.seen
            });
            for block in blocks.collect::<Vec<_>>() {
                for (all, seen) in all.iter_mut().zip(block) {
                    all.rank_sums.extend(seen.rank_sums);
                    all.exceedances.extend(seen.exceedances);
                    all.h1.extend(seen.h1);
                }
            }
        }
        progress.end();
        Ok(all)
    }
}

/// Blocks of trials whose outcomes wait to be put together.
const AT_ONCE: usize = 64;

/// Keeps the outcomes of each point.
struct Watched<'a> {
    points: &'a [Point],
    decisions: &'a [Decision],
    seen: Vec<TrialOutcomes>,
}

impl View for Watched<'_> {
    fn look(&mut self, place: usize, observation: &mut Observation) {
        let detector = &self.points[place].scenario.detector;
        let statistics = observation.statistics(detector.ties);
        let seen = &mut self.seen[place];
        seen.rank_sums.push(statistics.rank_sum);
        let exceedances = detector.exceedances.of(statistics);
        seen.exceedances.push(exceedances as u32);
        seen.h1.push(self.decisions[place].is_h1(observation));
    }
}

impl Gather for Watched<'_> {}
