//! The trials of a sweep: families of points that share their noise, and the pilots before them.

use super::targets::{NOTHING, Subject, Sweep};
use crate::chain::Decision;
use crate::counts::{Counts, DecisionSummary, Key, Sums};
use crate::pilot::Pilots;
use crate::plan::Plan;
use crate::results::Row;
use crate::run::tally::{Decisions, Families, Tallies};
use crate::run::{Group, Progress, Simulation, StudyError, Target, Trials};
use crate::schedule::BLOCK;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// A sweep, and how its points decide as far as that is known.
pub(super) struct Sampling<'a> {
    sweep: &'a Sweep,
    decisions: Vec<Option<Decision>>,
}

impl<'a> Sampling<'a> {
    pub fn new(sweep: &'a Sweep) -> Self {
        let decisions = vec![None; sweep.plan.points.len()];
        Self { sweep, decisions }
    }

    /// The points that some targets are of, in the order of the plan.
    fn points(&self, targets: &[usize]) -> Vec<usize> {
        let each = targets
            .iter()
            .flat_map(|&at| self.sweep.subjects[at].points());
        each.collect::<BTreeSet<usize>>().into_iter().collect()
    }
}

impl Subject {
    fn points(self) -> Vec<usize> {
        match self {
            Self::Point(point) => vec![point],
            Self::Pair(points) => points.to_vec(),
        }
    }
}

impl Trials for Sampling<'_> {
    fn targets(&self) -> &[Target] {
        &self.sweep.targets
    }

    fn points(&self) -> usize {
        self.sweep.plan.points.len()
    }

    fn block(&self) -> u64 {
        BLOCK
    }

    /// What both points of a pair detected is the same of either.
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
            let each = points.map(|point| counts.get(&keys[point]));
            let (Some(pair), [Some(first), Some(second)]) = (counts.get(&target.key), each) else {
                continue;
            };
            let alone = [pair.sums.counts[0], pair.sums.counts[1]];
            let hits = [first.sums.counts[0], second.sums.counts[0]];
            let both = [0, 1].map(|at: usize| hits[at].checked_sub(alone[at]));
            let is_of_same = pair.trials == first.trials && pair.trials == second.trials;
            if is_of_same && (both[0].is_none() || both[0] != both[1]) {
                return Err(Contradiction { hits, alone }.into());
            }
        }
        Ok(())
    }

    fn prepare(
        &mut self,
        targets: &[usize],
        progress: &dyn Progress,
    ) -> Result<BTreeMap<Key, DecisionSummary>, StudyError> {
        let points = self.points(targets);
        let plan = self.sweep.plan.subset(&points);
        let pilots = Pilots::new(&plan)?;
        progress.begin("pilots", pilots.work(), plan.pilot);
        let decisions = pilots.decide(|work| progress.done(work));
        progress.end();
        let mut summaries = BTreeMap::new();
        for ((&at, point), decision) in points.iter().zip(&plan.points).zip(decisions?) {
            let row = Row::new(point, Some(&decision), NOTHING, 0.5);
            summaries.insert(self.sweep.keys[at].clone(), row.decision());
            self.decisions[at] = Some(decision);
        }
        Ok(summaries)
    }

    fn pretend(&mut self) -> Result<u64, StudyError> {
        let pilots = Pilots::new(&self.sweep.plan)?;
        self.decisions = pilots.stand_ins().into_iter().map(Some).collect();
        Ok(pilots.work())
    }

    fn simulation<'a>(&'a self, targets: &[usize]) -> Box<dyn Simulation + 'a> {
        Box::new(Job::new(self, targets))
    }
}

/// A pair and its points that cannot have been counted in the same trials.
#[derive(Debug, thiserror::Error)]
#[error(
    "points of {hits:?} detections, of which {alone:?} at one of them alone: the others must be as many at both"
)]
struct Contradiction {
    hits: [u64; 2],
    alone: [u64; 2],
}

/// Some of the points, arranged by the noise they share.
struct Job {
    plan: Plan,
    /// None before the pilots.
    decisions: Option<Decisions>,
    families: Families,
    groups: Vec<Group>,
    /// Of each counter of each group what it counts: a place in this plan, or a pair of `families`.
    counted: Vec<Vec<Counted>>,
}

#[derive(Clone, Copy)]
enum Counted {
    Point(usize),
    Pair(usize),
}

impl Job {
    fn new(sampling: &Sampling, targets: &[usize]) -> Self {
        let points = sampling.points(targets);
        let here = |point: usize| points.binary_search(&point).expect("it is among them");
        let subjects = targets.iter().map(|&at| sampling.sweep.subjects[at]);
        let pairs = subjects.clone().filter_map(|subject| match subject {
            Subject::Pair(points) => Some(points.map(here)),
            Subject::Point(_) => None,
        });
        let plan = sampling.sweep.plan.subset(&points);
        let families = Families::new(&plan, pairs.collect());
        let decisions: Option<Vec<Decision>> = points
            .iter()
            .map(|&point| sampling.decisions[point].clone())
            .collect();
        let mut groups: Vec<Group> = (plan.schedule.families.iter())
            .map(|family| Group {
                counters: Vec::new(),
                work: family.points_per_trial() as u64,
                gigabytes: family.gigabytes(),
            })
            .collect();
        let mut counted = vec![Vec::new(); groups.len()];
        let family_of = plan.families();
        let mut pair = 0..;
        for (counter, subject) in subjects.enumerate() {
            let (family, what) = match subject {
                Subject::Point(point) => (family_of[here(point)], Counted::Point(here(point))),
                Subject::Pair([first, _]) => {
                    let pair = pair.next().expect("there is no end to numbers");
                    (family_of[here(first)], Counted::Pair(pair))
                }
            };
            groups[family].counters.push(counter);
            counted[family].push(what);
        }
        Self {
            plan,
            decisions: decisions.map(Decisions::new),
            families,
            groups,
            counted,
        }
    }
}

impl Simulation for Job {
    fn groups(&self) -> &[Group] {
        &self.groups
    }

    fn run(&self, group: usize, trials: Range<u64>) -> Vec<Sums> {
        let decisions = self.decisions.as_ref().expect("the pilots have run");
        let mut tallies = Tallies::new(decisions, &self.families);
        self.plan.schedule.run_block(group, trials, &mut tallies);
        let counted = self.counted[group].iter();
        counted
            .map(|counted| match *counted {
                Counted::Point(place) => Sums::of(&tallies.hits[place..=place]),
                Counted::Pair(pair) => Sums::of(&tallies.discordant[pair]),
            })
            .collect()
    }
}
