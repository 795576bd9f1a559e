//! The trials of a sweep: families of points that share their noise, and the pilots before them.

use super::tally::{Decisions, Tallies};
use super::targets::{Subject, Sweep};
use crate::chain::{Decision, Family};
use crate::counts::{Counter, Counts, DecisionSummary, Key, Sums};
use crate::pilot::Pilots;
use crate::plan::Point;
use crate::run::{self, Group, Progress, StudyError, Target, Trials};
use crate::schedule::Schedule;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::sync::Arc;

/// A sweep, and how its points decide as far as this is known.
pub(super) struct Sampling<'a> {
    sweep: &'a Sweep,
    decisions: Vec<Option<Decision>>,
}

impl Sweep {
    /// Runs all of its trials at once and keeps the counts in memory.
    ///
    /// # Errors
    /// If a pilot shows no decision.
    pub fn counts(&self, progress: &dyn Progress) -> Result<Counts, StudyError> {
        let sampling = Box::new(Sampling::new(self));
        run::whole(sampling, self.plan.schedule.trials, progress)
    }
}

impl<'a> Sampling<'a> {
    pub fn new(sweep: &'a Sweep) -> Self {
        let decisions = vec![None; sweep.plan.points.len()];
        Self { sweep, decisions }
    }

    /// The points that some targets belong to, in the order of the plan.
    fn points(&self, targets: &[usize]) -> Vec<usize> {
        let each = targets
            .iter()
            .flat_map(|&at| self.sweep.subjects[at].points());
        each.copied()
            .collect::<BTreeSet<usize>>()
            .into_iter()
            .collect()
    }
}

impl Trials for Sampling<'_> {
    fn targets(&self) -> &[Target] {
        &self.sweep.targets
    }

    fn points(&self) -> usize {
        self.sweep.plan.points.len()
    }

    /// The number of trials that both points of a pair detected must be the same from either point.
    fn check(&self, counts: &Counts) -> Result<(), StudyError> {
        let Sweep {
            targets,
            subjects,
            keys,
            ..
        } = self.sweep;
        for (target, subject) in targets.iter().zip(subjects) {
            let Subject::Pair(points) = *subject else {
                continue;
            };
            if let Some(pair) = counts.get(&target.key) {
                check_pair(pair, points.map(|point| counts.get(&keys[point])))?;
            }
        }
        Ok(())
    }

    fn prepare(
        &mut self,
        targets: &[usize],
        progress: &dyn Progress,
    ) -> Result<BTreeMap<Key, DecisionSummary>, StudyError> {
        let plan = &self.sweep.plan;
        let places = self.points(targets);
        let points: Vec<Point> = places.iter().map(|&at| plan.points[at].clone()).collect();
        let pilots = Pilots::new(&points, plan.pilot, plan.seed)?;
        progress.begin("pilots", pilots.work(), plan.pilot);
        let decisions = pilots.decide(|work| progress.done(work));
        progress.end();
        let mut summaries = BTreeMap::new();
        for (at, decision) in places.into_iter().zip(decisions?) {
            summaries.insert(self.sweep.keys[at], decision.summary());
            self.decisions[at] = Some(decision);
        }
        Ok(summaries)
    }

    fn pretend(&mut self) -> Result<u64, StudyError> {
        let plan = &self.sweep.plan;
        let pilots = Pilots::new(&plan.points, plan.pilot, plan.seed)?;
        self.decisions = pilots.stand_ins().into_iter().map(Some).collect();
        Ok(pilots.work())
    }

    fn groups(&self, targets: &[usize]) -> Vec<Group<'_>> {
        let job = Arc::new(Job::new(self, targets));
        let families = job.schedule.families.iter().enumerate();
        let group = |(family, of): (usize, &Family)| {
            let (counters, job) = (job.targets[family].clone(), Arc::clone(&job));
            Group {
                work: of.points_per_trial() as u64,
                gigabytes: of.gigabytes(),
                ..Group::new(counters, move |trials| job.run(family, trials))
            }
        };
        families.map(group).collect()
    }
}

/// A pair and its points that cannot have been counted in the same trials.
#[derive(Debug, thiserror::Error)]
#[error(
    "{alone:?} trials decided at one point of a pair alone, of points of {hits:?} detections: the others must be as \
     many at both, and all no more than there are trials"
)]
struct Contradiction {
    hits: [Option<u64>; 2],
    alone: [u64; 2],
}

/// Whether the counts of a pair and of its points can agree. A point's detections, less those that it
/// alone made, are the trials in which both points decided for H₁. If point and pair counted the same
/// trials, both points must give the same number. Each trial that only the point or only the pair
/// counted leaves this number uncertain by one.
fn check_pair(pair: &Counter, points: [Option<&Counter>; 2]) -> Result<(), Contradiction> {
    let alone = [pair.sums.counts[0], pair.sums.counts[1]];
    let hits = points.map(|point| point.map(|point| point.sums.counts[0]));
    let number = |number| i128::from(number);
    let others = number(pair.trials.len()) - number(alone[0]) - number(alone[1]);
    let (mut least, mut most) = (0, others);
    for (point, alone) in points.into_iter().zip(alone) {
        let Some(point) = point else {
            continue;
        };
        let both = number(point.sums.counts[0]) - number(alone);
        least = least.max(both - number(point.trials.without(&pair.trials).len()));
        most = most.min(both + number(pair.trials.without(&point.trials).len()));
    }
    if least > most {
        return Err(Contradiction { hits, alone });
    }
    Ok(())
}

/// Some of the points, arranged by the noise they share.
struct Job {
    schedule: Schedule,
    /// `None` before the pilots have run.
    decisions: Option<Decisions>,
    /// The targets of each family.
    targets: Vec<Vec<usize>>,
    /// What each target counts, with points by their places in the schedule.
    subjects: Vec<Vec<Subject>>,
}

impl Job {
    fn new(sampling: &Sampling, targets: &[usize]) -> Self {
        let points = sampling.points(targets);
        let schedule = sampling.sweep.plan.schedule_of(&points);
        let decisions = points
            .iter()
            .map(|&point| sampling.decisions[point].clone());
        let decisions: Option<Vec<Decision>> = decisions.collect();
        let family_of = schedule.family_of();
        let mut of_family = vec![Vec::new(); schedule.families.len()];
        let mut subjects = vec![Vec::new(); schedule.families.len()];
        for &target in targets {
            let here = |point: usize| points.binary_search(&point).expect("it is among them");
            let subject = sampling.sweep.subjects[target].map(here);
            let family = family_of[subject.points()[0]];
            of_family[family].push(target);
            subjects[family].push(subject);
        }
        Self {
            schedule,
            decisions: decisions.map(Decisions::new),
            targets: of_family,
            subjects,
        }
    }

    fn run(&self, group: usize, trials: Range<u64>) -> Vec<Sums> {
        let decisions = self.decisions.as_ref().expect("the pilots have run");
        let mut tallies = Tallies::new(decisions, &self.subjects[group]);
        self.schedule.run_block(group, trials, &mut tallies);
        tallies.sums()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::counts::Shape;
    use proptest::prelude::*;

    proptest! {
        /// A pair and its points may count any trials, and their counts are accepted. Counts that differ from
        /// these by more than the number of unshared trials are refused.
        #[test]
        fn a_pair_and_its_points(
            trials in proptest::collection::vec(any::<[bool; 5]>(), 1..40),
            shared in any::<bool>(),
        ) {
            // Each trial holds what the two points decide, and whether the points and their pair count it.
            let count = |who: usize, shape: &Shape, events: &dyn Fn([bool; 2]) -> Vec<bool>| {
                let mut counter = shape.empty();
                for (trial, &[first, second, ref counted @ ..]) in (0..).zip(&trials) {
                    if shared || counted[who] {
                        counter.trials.add(trial..trial + 1).unwrap();
                        let events = events([first, second]).into_iter().map(u64::from);
                        counter.sums.add(&Sums::of(&events.collect::<Vec<_>>()));
                    }
                }
                counter
            };
            let first = count(0, &Shape::events(1), &|[first, _]| vec![first]);
            let second = count(1, &Shape::events(1), &|[_, second]| vec![second]);
            let alone = |[first, second]: [bool; 2]| vec![first && !second, second && !first];
            let pair = count(2, &Shape::events(2), &alone);
            prop_assert!(check_pair(&pair, [Some(&first), Some(&second)]).is_ok());
            let apart = |point: &Counter| {
                point.trials.without(&pair.trials).len() + pair.trials.without(&point.trials).len()
            };
            let unshared = apart(&first) + apart(&second);
            for at in [0, 1] {
                let mut other = pair.clone();
                other.sums.counts[at] += unshared + 1;
                prop_assert!(check_pair(&other, [Some(&first), Some(&second)]).is_err());
            }
        }
    }
}
