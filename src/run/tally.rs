//! What every point of a plan decides, counted; and for pairs of points that share their noise, how often only
//! the one of them decided for H₁.

use crate::chain::{Decision, Observation, View};
use crate::detect::{Region, Statistics};
use crate::plan::Plan;
use crate::schedule::Gather;
use crate::stats::tally::Tally;

/// What a run comes to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tallied {
    /// Of every point of the plan.
    pub tallies: Vec<Tally>,
    /// Of every pair: trials in which the first alone, the second alone decided for H₁; none where
    /// the two do not share their noise.
    pub discordant: Vec<Option<[u64; 2]>>,
}

/// Runs every trial of the plan on the current thread pool, each point deciding by its place in
/// `decisions`. `progress` hears of finished work; it adds up to that of the plan's schedule.
pub fn run(
    plan: &Plan,
    decisions: &[Decision],
    pairs: &[[usize; 2]],
    progress: impl Fn(u64) + Sync,
) -> Tallied {
    let families = Families::new(plan, pairs.to_vec());
    let decisions = Decisions::new(decisions.iter().cloned());
    let new = || Tallies::new(&decisions, &families);
    let counts = plan.schedule.run(new, progress);
    let trials = plan.schedule.trials;
    let tallies = counts.hits.iter();
    Tallied {
        tallies: tallies.map(|&hits| Tally { hits, trials }).collect(),
        discordant: (0..pairs.len())
            .map(|pair| families.share(pair).then(|| counts.discordant[pair]))
            .collect(),
    }
}

/// The points and pairs that are counted together.
#[derive(Clone, Debug)]
pub(crate) struct Families {
    pairs: Vec<[usize; 2]>,
    /// Of each family the pairs that lie within it.
    pub pairs_of: Vec<Vec<usize>>,
    /// Of each family its points.
    pub places_of: Vec<Vec<usize>>,
}

impl Families {
    pub fn new(plan: &Plan, pairs: Vec<[usize; 2]>) -> Self {
        let family_of = plan.families();
        let families = &plan.schedule.families;
        let mut pairs_of = vec![Vec::new(); families.len()];
        for (pair, [first, second]) in pairs.iter().enumerate() {
            if family_of[*first] == family_of[*second] {
                pairs_of[family_of[*first]].push(pair);
            }
        }
        let places_of = families.iter().map(|family| family.places().collect());
        Self {
            pairs,
            pairs_of,
            places_of: places_of.collect(),
        }
    }

    /// Whether the two points of a pair share their noise.
    fn share(&self, pair: usize) -> bool {
        self.pairs_of.iter().any(|family| family.contains(&pair))
    }
}

/// The decision of every point, those that points share kept once: a curve has one, and a trial goes through
/// all of its points.
#[derive(Clone, Debug)]
pub(crate) struct Decisions {
    distinct: Vec<Decision>,
    of: Vec<u32>,
}

impl Decisions {
    pub fn new(decisions: impl IntoIterator<Item = Decision>) -> Self {
        let mut distinct: Vec<Decision> = Vec::new();
        let mut of = Vec::new();
        for decision in decisions {
            let known = distinct.iter().position(|known| known.is_same(&decision));
            of.push(known.unwrap_or(distinct.len()) as u32);
            if known.is_none() {
                distinct.push(decision);
            }
        }
        Self { distinct, of }
    }
}

/// Counts that add. Decisions of [`WORD`] trials are gathered as bits of a word before they are counted,
/// so that a pair of points is compared once a word and not once a trial.
pub(crate) struct Tallies<'a> {
    decisions: &'a Decisions,
    families: &'a Families,
    /// What each point decided in the trials since the last count, the first in the lowest bit.
    decided: Vec<u64>,
    /// How many trials that are.
    gathered: u32,
    /// The family they are of.
    family: usize,
    pub hits: Vec<u64>,
    pub discordant: Vec<[u64; 2]>,
}

/// Trials that a word has bits for.
const WORD: u32 = u64::BITS;

impl<'a> Tallies<'a> {
    pub fn new(decisions: &'a Decisions, families: &'a Families) -> Self {
        let points = decisions.of.len();
        Self {
            decisions,
            families,
            decided: vec![0; points],
            gathered: 0,
            family: 0,
            hits: vec![0; points],
            discordant: vec![[0; 2]; families.pairs.len()],
        }
    }

    /// Counts what has been gathered.
    fn count(&mut self) {
        for &pair in &self.families.pairs_of[self.family] {
            let [first, second] = self.families.pairs[pair].map(|place| self.decided[place]);
            self.discordant[pair][0] += u64::from((first & !second).count_ones());
            self.discordant[pair][1] += u64::from((second & !first).count_ones());
        }
        for &place in &self.families.places_of[self.family] {
            self.hits[place] += u64::from(self.decided[place].count_ones());
            self.decided[place] = 0;
        }
        self.gathered = 0;
    }
}

impl View for Tallies<'_> {
    fn look(&mut self, place: usize, observation: &mut Observation) {
        let decision = &self.decisions.distinct[self.decisions.of[place] as usize];
        let is_h1 = decision.is_h1(observation);
        self.decided[place] |= u64::from(is_h1) << self.gathered;
    }

    fn look_along(&mut self, points: &[[u32; 2]], statistics: &[Statistics], _: &mut Observation) {
        let alike = |a: &[u32; 2], b: &[u32; 2]| {
            self.decisions.of[a[1] as usize] == self.decisions.of[b[1] as usize]
        };
        for points in points.chunk_by(alike) {
            let decision = self.decisions.of[points[0][1] as usize];
            match &self.decisions.distinct[decision as usize] {
                Decision::Region { region, .. } => {
                    decide(region, points, statistics, self.gathered, &mut self.decided);
                }
                Decision::Threshold { .. } => unreachable!("a score looks at the samples"),
            }
        }
    }
}

/// Sets bit `trial` of each point whose W and T lie in the region.
#[inline(never)]
fn decide(
    region: &Region,
    points: &[[u32; 2]],
    statistics: &[Statistics],
    trial: u32,
    decided: &mut [u64],
) {
    for &[number, place] in points {
        let is_h1 = region.contains(statistics[number as usize]);
        decided[place as usize] |= u64::from(is_h1) << trial;
    }
}

impl Gather for Tallies<'_> {
    fn end_trial(&mut self, family: usize) {
        self.family = family;
        self.gathered += 1;
        if self.gathered == WORD {
            self.count();
        }
    }

    fn end_block(&mut self) {
        self.count();
    }

    fn merge(&mut self, other: Self) {
        let pairs = self.discordant.as_flattened_mut().iter_mut();
        let pairs = pairs.zip(other.discordant.into_flattened());
        for (sum, more) in self.hits.iter_mut().zip(other.hits).chain(pairs) {
            *sum += more;
        }
    }
}
