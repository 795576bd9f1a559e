//! The trials behind operating points: Δ by Δ on one noise for each size.

use super::grids::{Grids, OperatingPoint};
use super::search::Sized;
use crate::chain::{Observation, View};
use crate::counts::{Counts, Sums};
use crate::detect::{Region, Ties};
use crate::run::{Group, Simulation, Target, Trials};
use crate::schedule::{BLOCK, Gather, Schedule};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// All Δ of all sizes.
pub(super) struct Levels<'a>(pub &'a OperatingPoint);

impl Trials for Levels<'_> {
    fn targets(&self) -> &[Target] {
        &self.0.targets
    }

    fn block(&self) -> u64 {
        BLOCK
    }

    /// The coarse grids; once these are counted, the fine grids that they ask for.
    fn needed(&self, counts: &Counts) -> Vec<usize> {
        let study = self.0;
        let mut needed = BTreeSet::new();
        for size in 0..study.sized.len() {
            let mut deltas = study.sized[size].coarse.clone();
            let is_counted = |&delta: &f64| {
                let target = &study.targets[study.target(size, delta)];
                let wanted = 0..study.context.trials;
                counts.missing(&target.key, wanted).is_empty()
            };
            if deltas.iter().all(is_counted) {
                let mut grids = Grids::new(study, counts, size);
                for &power in &study.search.power {
                    // Asked for the sake of what it finds missing.
                    let _ = grids.row(power);
                }
                let fine = grids.asked.iter();
                deltas.extend(fine.flat_map(|&above| study.sized[size].fine(above)));
            }
            needed.extend(deltas.into_iter().map(|delta| study.target(size, delta)));
        }
        needed.into_iter().collect()
    }

    fn simulation<'a>(&'a self, targets: &[usize]) -> Box<dyn Simulation + 'a> {
        let study = self.0;
        let (mut parts, mut groups) = (Vec::new(), Vec::new());
        // What two sizes have in common is counted with the first of them.
        let mut left: BTreeMap<usize, usize> = targets.iter().copied().zip(0..).collect();
        for (sized, places) in study.sized.iter().zip(&study.places) {
            let here = places.iter().filter_map(|(&bits, place)| {
                let counter = left.remove(place)?;
                Some((f64::from_bits(bits), counter))
            });
            let (deltas, counters): (Vec<f64>, Vec<usize>) = here.unzip();
            if deltas.is_empty() {
                continue;
            }
            let schedule = sized.schedule(&deltas, study.context);
            let schedule = schedule.expect("the records fitted in memory on another grid");
            let family = &schedule.families[0];
            groups.push(Group {
                counters,
                work: family.points_per_trial() as u64,
                gigabytes: family.gigabytes(),
            });
            parts.push((sized, schedule));
        }
        Box::new(Curves { parts, groups })
    }
}

/// Some Δ of some sizes.
struct Curves<'a> {
    parts: Vec<(&'a Sized, Schedule)>,
    groups: Vec<Group>,
}

impl Simulation for Curves<'_> {
    fn groups(&self) -> &[Group] {
        &self.groups
    }

    fn run(&self, group: usize, trials: Range<u64>) -> Vec<Sums> {
        let (sized, schedule) = &self.parts[group];
        let mut hits = Hits {
            region: &sized.region,
            ties: sized.scenario.detector.ties,
            hits: vec![0; self.groups[group].counters.len()],
        };
        schedule.run_block(0, trials, &mut hits);
        hits.hits.iter().map(|&hits| Sums::of(&[hits])).collect()
    }
}

/// Detections at each Δ.
struct Hits<'a> {
    region: &'a Region,
    ties: Ties,
    hits: Vec<u64>,
}

impl View for Hits<'_> {
    fn look(&mut self, place: usize, observation: &mut Observation) {
        let is_h1 = self.region.contains(observation.statistics(self.ties));
        self.hits[place] += u64::from(is_h1);
    }
}

impl Gather for Hits<'_> {}
