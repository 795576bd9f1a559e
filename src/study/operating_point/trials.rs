//! The trials behind operating points. For each size, all Δ share one noise.

use super::grids::{Grids, OperatingPoint};
use crate::chain::{Observation, View};
use crate::counts::{Counts, Sums};
use crate::detect::{Region, Ties};
use crate::run::{Group, Target, Trials};
use crate::schedule::Gather;
use std::collections::BTreeSet;

impl Trials for &OperatingPoint {
    fn targets(&self) -> &[Target] {
        &self.targets
    }

    /// The coarse grids; once these are counted, the fine grids that they ask for.
    fn needed(&self, counts: &Counts) -> Vec<usize> {
        let study: &OperatingPoint = self;
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
                    // The row is not used: the call records the fine grids that it needs.
                    let _ = grids.row(power);
                }
                let fine = grids.asked.iter();
                deltas.extend(fine.flat_map(|&above| study.sized[size].fine(above)));
            }
            needed.extend(deltas.into_iter().map(|delta| study.target(size, delta)));
        }
        needed.into_iter().collect()
    }

    /// One group for each size. All of its Δ share one noise.
    fn groups(&self, targets: &[usize]) -> Vec<Group<'_>> {
        // A target that two sizes share is counted with the first of them.
        let mut left: BTreeSet<usize> = targets.iter().copied().collect();
        let mut groups = Vec::new();
        for (sized, places) in self.sized.iter().zip(&self.places) {
            let here = places.iter().filter(|(_, place)| left.remove(place));
            let here = here.map(|(&bits, &place)| (f64::from_bits(bits), place));
            let (deltas, counters): (Vec<f64>, Vec<usize>) = here.unzip();
            if deltas.is_empty() {
                continue;
            }
            let schedule = sized.schedule(&deltas, self.context);
            let schedule = schedule.expect("the records fitted in memory on another grid");
            let family = &schedule.families[0];
            groups.push(Group {
                work: family.points_per_trial() as u64,
                gigabytes: family.gigabytes(),
                ..Group::new(counters, move |trials| {
                    let mut hits = Hits {
                        region: &sized.region,
                        ties: sized.scenario.detector.ties,
                        hits: vec![0; deltas.len()],
                    };
                    schedule.run_block(0, trials, &mut hits);
                    hits.hits.iter().map(|&hits| Sums::of(&[hits])).collect()
                })
            });
        }
        groups
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
