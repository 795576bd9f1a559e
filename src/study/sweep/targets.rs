//! What a sweep counts: its points, and the pairs of points that claims compare.

use crate::claim::{self, Pair};
use crate::counts::{Key, Shape};
use crate::experiment::{ConfigError, SWEEP, SweepConfig};
use crate::plan::Plan;
use crate::results;
use crate::run::{Identity, Target};
use crate::study::kind::TooMany;
use std::collections::{BTreeMap, BTreeSet};
use std::slice;

/// A plan, and the pairs of points that its claims compare.
pub struct Sweep {
    /// The config as its author wrote it.
    pub config: SweepConfig,
    /// Its points.
    pub plan: Plan,
    /// Pairs of points that claims compare.
    pub pairs: Vec<Pair>,
    /// How each pair is compared.
    pub(super) compared: Vec<Compared>,
    /// The counter of each point.
    pub(super) keys: Vec<Key>,
    /// Every counter once, in the order of the keys, and what it counts.
    pub(super) targets: Vec<Target>,
    pub(super) subjects: Vec<Subject>,
}

/// What a counter counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Subject {
    /// How often a point of the plan decides for H₁.
    Point(usize),
    /// For two points that share their noise, how often only the first and only the second decides for H₁.
    Pair([usize; 2]),
}

/// How two points are compared.
#[derive(Clone, Debug)]
pub(super) enum Compared {
    /// The two points are the same and never differ.
    Itself,
    /// The points are compared trial by trial on the noise that they share.
    Paired(Key, [usize; 2]),
    /// The points are compared by their rates alone.
    Apart,
}

impl Subject {
    /// The shape of its counter.
    pub fn shape(self) -> Shape {
        Shape::events(match self {
            Self::Point(_) => 1,
            Self::Pair(_) => 2,
        })
    }

    /// The points that it belongs to.
    pub fn points(&self) -> &[usize] {
        match self {
            Self::Point(point) => slice::from_ref(point),
            Self::Pair(points) => points,
        }
    }

    /// The same subject, with its points at other places.
    pub fn map(self, place: impl Fn(usize) -> usize) -> Self {
        match self {
            Self::Point(point) => Self::Point(place(point)),
            Self::Pair(points) => Self::Pair(points.map(place)),
        }
    }
}

impl Sweep {
    /// Plans a config.
    ///
    /// # Errors
    /// If a parameter of a point is out of range, or no region or record can be made for it.
    pub fn new(config: SweepConfig) -> Result<Self, ConfigError> {
        let plan = Plan::new(&config)?;
        let pairs = plan.pairs(&config);
        Ok(Self::comparing(config, plan, pairs))
    }

    /// The sweep of a plan that compares these pairs of points.
    pub(super) fn comparing(config: SweepConfig, plan: Plan, pairs: Vec<Pair>) -> Self {
        let keys: Vec<Key> = identities(&plan)
            .map(|identity| identity.key(SWEEP, plan.seed, plan.common_random_numbers))
            .collect();
        let family_of = plan.schedule.family_of();
        let compared: Vec<Compared> = pairs
            .iter()
            .map(|pair| Compared::new([pair.first, pair.second], &keys, &family_of))
            .collect();
        let points = keys.iter().copied().zip((0..).map(Subject::Point));
        let of_pairs = compared.iter().filter_map(|compared| match compared {
            Compared::Paired(key, places) => Some((*key, Subject::Pair(*places))),
            Compared::Itself | Compared::Apart => None,
        });
        let each: BTreeMap<Key, Subject> = points.chain(of_pairs).collect();
        let target = |(key, subject): (&Key, &Subject)| Target {
            key: *key,
            shape: subject.shape(),
        };
        Self {
            targets: each.iter().map(target).collect(),
            subjects: each.into_values().collect(),
            config,
            plan,
            pairs,
            compared,
            keys,
        }
    }
}

/// The most comparisons. Each interval takes a millisecond.
const MOST_COMPARISONS: usize = 50_000;
/// The most panels. Each takes 16 MB while it is drawn.
const MOST_PANELS: usize = 12;

/// Refuses a sweep that would take hours or gigabytes, before any work starts.
pub(super) fn check_sizes(config: &SweepConfig) -> Result<(), TooMany> {
    let comparisons = claim::number_of_pairs(&config.narrative.claims, &config.scope);
    let remedy = "make fewer claims, or of fewer curves";
    TooMany::check("comparisons", comparisons, MOST_COMPARISONS, remedy)?;
    let panels: BTreeSet<_> = config
        .scope
        .curves
        .iter()
        .map(|curve| &curve.panel)
        .collect();
    TooMany::check("panels", panels.len(), MOST_PANELS, "split the config")
}

impl Compared {
    fn new(places: [usize; 2], keys: &[Key], family_of: &[usize]) -> Self {
        let pair = places.map(|place| &keys[place]);
        let [first, second] = places.map(|place| family_of[place]);
        match (pair[0] == pair[1], first == second) {
            (true, _) => Self::Itself,
            (_, true) => Self::Paired(Key::pair(pair), places),
            _ => Self::Apart,
        }
    }
}

/// Every parameter of each point, except its place among the curves.
pub(super) fn identities(plan: &Plan) -> impl Iterator<Item = Identity> + '_ {
    plan.points.iter().map(|point| Identity {
        parameters: results::parameters(&point.scenario),
        place: format!(", in curve {}", point.curve + 1),
    })
}
