//! Counts the decisions of the points of a family. For a pair of points, it counts how often only one of
//! them decided for H₁.

use super::targets::Subject;
use crate::chain::{Decision, Observation, Track, View};
use crate::counts::Sums;
use crate::detect::{Along, Region};
use crate::schedule::Gather;
use crate::simd::Vectors;

/// The decision of each point. Points that share a decision share one copy: a curve has one decision, and
/// a trial goes through all points of the curve.
#[derive(Clone, Debug)]
pub(super) struct Decisions {
    distinct: Vec<Decision>,
    of: Vec<u32>,
    /// For each point, the first point after it that decides differently.
    ends: Vec<usize>,
}

impl Decisions {
    pub fn new(decisions: impl IntoIterator<Item = Decision>) -> Self {
        let mut distinct: Vec<Decision> = Vec::new();
        let mut of: Vec<u32> = Vec::new();
        for decision in decisions {
            let known = distinct.iter().position(|known| known.is_same(&decision));
            of.push(known.unwrap_or(distinct.len()) as u32);
            if known.is_none() {
                distinct.push(decision);
            }
        }
        let alike = of.chunk_by(|a, b| a == b).map(<[u32]>::len);
        let mut ends = Vec::with_capacity(of.len());
        for length in alike {
            ends.resize(ends.len() + length, ends.len() + length);
        }
        Self { distinct, of, ends }
    }
}

/// The counts of some subjects of one family. Decisions of [`WORD`] trials are gathered as bits of a word
/// before they are counted, so that a pair of points is compared once per word and not once per trial.
pub(super) struct Tallies<'a> {
    decisions: &'a Decisions,
    subjects: &'a [Subject],
    /// Each point's decisions in the trials since the last count. The first trial is the lowest bit.
    decided: Vec<u64>,
    /// How many trials have been gathered.
    gathered: u32,
    /// For each subject, how often the point decided for H₁, or each of a pair alone.
    counts: Vec<[u64; 2]>,
}

/// The number of trials in a word, one bit each.
const WORD: u32 = u64::BITS;

impl<'a> Tallies<'a> {
    /// Tallies for subjects that include all points of the family.
    pub fn new(decisions: &'a Decisions, subjects: &'a [Subject]) -> Self {
        Self {
            decisions,
            subjects,
            decided: vec![0; decisions.of.len()],
            gathered: 0,
            counts: vec![[0; 2]; subjects.len()],
        }
    }

    /// The sums of each subject.
    pub fn sums(&self) -> Vec<Sums> {
        let each = self.subjects.iter().zip(&self.counts);
        each.map(|(subject, counts)| Sums::of(&counts[..subject.points().len()]))
            .collect()
    }

    /// Counts the gathered decisions.
    fn count(&mut self) {
        let decided = |place: usize| self.decided[place];
        for (subject, [one, other]) in self.subjects.iter().zip(&mut self.counts) {
            match *subject {
                Subject::Point(place) => *one += u64::from(decided(place).count_ones()),
                Subject::Pair(pair) => {
                    let [first, second] = pair.map(decided);
                    *one += u64::from((first & !second).count_ones());
                    *other += u64::from((second & !first).count_ones());
                }
            }
        }
        self.decided.fill(0);
        self.gathered = 0;
    }
}

impl View for Tallies<'_> {
    fn look(&mut self, place: usize, observation: &mut Observation) {
        let decision = &self.decisions.distinct[self.decisions.of[place] as usize];
        let is_h1 = decision.is_h1(observation);
        self.decided[place] |= u64::from(is_h1) << self.gathered;
    }

    fn look_along(&mut self, tracks: &[Track], along: &Along, _: &mut Observation) {
        for Track { first, places } in tracks {
            let (mut number, mut place) = (*first, places.start);
            while place < places.end {
                let end = self.decisions.ends[place].min(places.end);
                let Decision::Region { region, .. } =
                    &self.decisions.distinct[self.decisions.of[place] as usize]
                else {
                    unreachable!("a score looks at the samples")
                };
                let decided = &mut self.decided[place..end];
                decide(region, along, number, self.gathered, decided);
                (number, place) = (number + end - place, end);
            }
        }
    }
}

/// Sets bit `trial` of each point whose statistics lie in the region. The points follow each other along Δ,
/// from the value of this number on.
fn decide(region: &Region, along: &Along, number: usize, trial: u32, decided: &mut [u64]) {
    Vectors::widest().run(
        #[inline(always)]
        || {
            let numbers = number..number + decided.len();
            along.for_each_stretch(
                numbers,
                #[inline(always)]
                |numbers, statistics| {
                    let bounds = region.bounds(statistics);
                    let decided = &mut decided[numbers.start - number..numbers.end - number];
                    for (decided, &rank_sum) in decided.iter_mut().zip(along.rank_sums(numbers)) {
                        *decided |= u64::from(bounds.decide(rank_sum)) << trial;
                    }
                },
            );
        },
    );
}

impl Gather for Tallies<'_> {
    fn end_trial(&mut self) {
        self.gathered += 1;
        if self.gathered == WORD {
            self.count();
        }
    }

    fn end_block(&mut self) {
        self.count();
    }
}

#[cfg(test)]
mod tests {
    use crate::chain::{Observation, Trial};
    use crate::claim::{Pair, Place};
    use crate::experiment::SweepConfig;
    use crate::pilot::Pilots;
    use crate::plan::Plan;
    use crate::study::{Study, Sweep};

    /// Compares a pair's discordant counts with their definition. Two separate runs give the decisions of
    /// the two points, trial by trial.
    #[test]
    fn discordant_trials_are_those_on_which_two_points_differ() {
        let text = "question = \"?\"\nseed = 3\ntrials = 3000\n[axis]\ndelta = [0.2, 0.5]\n\
                    [[curve]]\n[[curve]]\nimpulses = { nu = 0.3, theta = 9.0 }\n\
                    [[curve]]\nnoise = { law = \"laplace\" }\n\
                    [[claim]]\nclaim = \"?\"\ntest = \"grows\"\n";
        let config = SweepConfig::parse("test", text).unwrap();
        let plan = Plan::new(&config).unwrap();
        let places = plan.points.len();
        let nowhere = || Place {
            curve: String::new(),
            value: String::new(),
        };
        let pairs = (0..places).flat_map(|first| {
            (0..places).map(move |second| Pair {
                claim: 0,
                first,
                second,
                places: [nowhere(), nowhere()],
            })
        });
        let pairs = pairs.collect();
        let sweep = Sweep::comparing(config, plan, pairs);
        let counts = sweep.counts(&()).unwrap();
        let comparisons = sweep.comparisons(&sweep.rows(&counts), &counts);
        let plan = &sweep.plan;
        let pilots = Pilots::new(&plan.points, plan.pilot, plan.seed).unwrap();
        let decisions = pilots.decide(|_| {}).unwrap();
        let mut decided = vec![vec![false; 3000]; places];
        for family in &plan.schedule.families {
            let mut trial = Trial::new(family);
            for index in 0..3000 {
                trial.run(index, &mut |place: usize, observation: &mut Observation| {
                    decided[place][index as usize] = decisions[place].is_h1(observation);
                });
            }
        }
        assert_eq!(comparisons.len(), places * places);
        for (&Pair { first, second, .. }, comparison) in sweep.pairs.iter().zip(&comparisons) {
            let of_law = |place: usize| plan.points[place].scenario.noise;
            let alone = |a: usize, b: usize| {
                let trials = decided[a].iter().zip(&decided[b]);
                trials.filter(|(a, b)| **a && !**b).count() as u64
            };
            let is_shared = of_law(first) == of_law(second);
            let expected = is_shared.then(|| [alone(first, second), alone(second, first)]);
            let discordant = comparison.first_only.zip(comparison.second_only);
            assert_eq!(
                discordant.map(<[u64; 2]>::from),
                expected,
                "{first} {second}"
            );
        }
    }
}
