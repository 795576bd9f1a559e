//! `[axis]`: how often each point of each curve decides for H₁, along an axis.

mod labels;
pub(super) mod picture;
mod trials;
mod x_axis;

use super::{Study, TooMany, counted};
use crate::claim::{self, Evidence, Outcome, Pair, Scope};
use crate::counts::{Counts, DecisionSummary, Key, Shape, Sums};
use crate::experiment::{Config, Curve};
use crate::figure::FigureError;
use crate::plan::{Hypothesis, Plan, Point};
use crate::plot::Plot;
use crate::results::{self, Comparison, Quantity, Row};
use crate::run::{Identity, StudyError, Target, Trials};
use crate::stats::tally::Tally;
use std::collections::{BTreeMap, BTreeSet};

/// A plan, and what its claims compare.
pub(super) struct Sweep {
    config: Config,
    plan: Plan,
    /// Pairs of points that claims compare.
    pairs: Vec<Pair>,
    /// Of each pair what it is compared by.
    compared: Vec<Compared>,
    /// The counter of every point.
    keys: Vec<Key>,
    /// Every counter once, in the order of the keys, and what it counts.
    targets: Vec<Target>,
    subjects: Vec<Subject>,
}

/// What a counter counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Subject {
    /// How often a point of the plan decides for H₁.
    Point(usize),
    /// Of two points that share their noise, how often only the first, only the second does.
    Pair([usize; 2]),
}

/// How two points are compared.
#[derive(Clone, Debug)]
enum Compared {
    /// They are the same and never differ.
    Itself,
    /// By the trials of the noise they share.
    Paired(Key, [usize; 2]),
    /// By their rates alone.
    Apart,
}

impl Subject {
    fn shape(self) -> Shape {
        Shape::events(match self {
            Self::Point(_) => 1,
            Self::Pair(_) => 2,
        })
    }
}

impl Sweep {
    /// # Errors
    /// Where a parameter of a point is out of range, no region or record can be made for it, or there is more
    /// than can be planned, compared or drawn.
    pub fn new(config: &Config) -> Result<Self, StudyError> {
        check_sizes(config)?;
        let plan = Plan::new(config)?;
        let keys: Vec<Key> = identities(&plan)
            .map(|identity| identity.key(Self::NAME, plan.seed, plan.common_random_numbers))
            .collect();
        let pairs = plan.pairs(config);
        let family_of = plan.families();
        let compared: Vec<Compared> = pairs
            .iter()
            .map(|pair| Compared::new([pair.first, pair.second], &keys, &family_of))
            .collect();
        let points = keys.iter().cloned().zip((0..).map(Subject::Point));
        let of_pairs = compared.iter().filter_map(|compared| match compared {
            Compared::Paired(key, places) => Some((key.clone(), Subject::Pair(*places))),
            Compared::Itself | Compared::Apart => None,
        });
        let each: BTreeMap<Key, Subject> = points.chain(of_pairs).collect();
        let target = |(key, subject): (&Key, &Subject)| Target {
            key: key.clone(),
            shape: subject.shape(),
        };
        Ok(Self {
            targets: each.iter().map(target).collect(),
            subjects: each.into_values().collect(),
            config: config.clone(),
            plan,
            pairs,
            compared,
            keys,
        })
    }

    /// How a point decides, as far as that is known.
    fn decision(&self, point: &Point, key: &Key, counts: &Counts) -> DecisionSummary {
        let known = counts.decisions.get(key).copied();
        known.unwrap_or_else(|| Row::new(point, None, NOTHING, 0.5).decision())
    }
}

const MOST_POINTS: usize = 20_000;
/// An interval takes a millisecond.
const MOST_COMPARISONS: usize = 50_000;
/// A panel takes 16 MB while it is drawn.
const MOST_PANELS: usize = 12;

/// Refuses what would take hours or gigabytes, before anything is paid for.
fn check_sizes(config: &Config) -> Result<(), TooMany> {
    let (curves, values) = (config.curves.len(), config.axis.values.len());
    let points = curves.saturating_mul(values);
    TooMany::check("points", points, MOST_POINTS, "take fewer curves or values")?;
    let comparisons = claim::number_of_pairs(&config.narrative.claims, &config.scope());
    let remedy = "make fewer claims, or of fewer curves";
    TooMany::check("comparisons", comparisons, MOST_COMPARISONS, remedy)?;
    let panels: BTreeSet<_> = config.curves.iter().map(|curve| &curve.panel).collect();
    TooMany::check("panels", panels.len(), MOST_PANELS, "split the config")
}

const NOTHING: Tally = Tally { hits: 0, trials: 1 };

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

/// Every parameter of every point, its place among the curves apart.
fn identities(plan: &Plan) -> impl Iterator<Item = Identity> + '_ {
    plan.points.iter().map(|point| Identity {
        parameters: results::parameters(&point.scenario),
        place: format!(", in curve {}", point.curve + 1),
    })
}

impl Study for Sweep {
    const NAME: &'static str = "axis";
    type Row = Row;

    fn identities(&self) -> Vec<Identity> {
        identities(&self.plan).collect()
    }

    fn trials(&self) -> Option<Box<dyn Trials + '_>> {
        Some(Box::new(trials::Sampling::new(self)))
    }

    fn rows(&self, counts: &Counts) -> Vec<Row> {
        let points = self.plan.points.iter().zip(&self.keys);
        let shape = Subject::Point(0).shape();
        points
            .map(|(point, key)| {
                let (trials, sums) = counted(counts, key, &shape);
                let hits = sums.counts[0];
                let decision = self.decision(point, key, counts);
                let tally = Tally { hits, trials };
                Row::summarised(point, &decision, tally, self.config.confidence)
            })
            .collect()
    }

    fn comparisons(&self, rows: &[Row], counts: &Counts) -> Vec<Comparison> {
        let tallies: Vec<Tally> = rows.iter().map(|row| row.tally).collect();
        let discordant = |compared: &Compared| match compared {
            Compared::Itself => Some([0, 0]),
            Compared::Paired(key, places) => {
                let (_, sums) = counted(counts, key, &Subject::Pair(*places).shape());
                Some([sums.counts[0], sums.counts[1]])
            }
            Compared::Apart => None,
        };
        let discordant: Vec<_> = self.compared.iter().map(discordant).collect();
        let claims = &self.config.narrative.claims;
        claim::comparisons(claims, &self.pairs, &tallies, &discordant)
    }

    /// The numbers that claims of gains ask for.
    fn quantities(&self, rows: &[Row]) -> Result<Vec<Quantity>, StudyError> {
        let (scope, outcomes) = self.curves(rows);
        let evidence = Evidence {
            scope,
            outcomes,
            ..Evidence::default()
        };
        Ok(claim::gains(&self.config.narrative.claims, &evidence)?)
    }

    fn recall(&self, rows: &[Row], comparisons: &[Comparison]) -> Option<Counts> {
        if rows.len() != self.keys.len() {
            return None;
        }
        let mut counts = Counts::default();
        let mut add = |key: &Key, trials: u64, sums: &[u64]| {
            if counts.get(key).is_none() {
                let added = counts.add(key, 0..trials, &Sums::of(sums));
                added.expect("a key is added once");
            }
        };
        for (key, row) in self.keys.iter().zip(rows) {
            add(key, row.tally.trials, &[row.tally.hits]);
        }
        if comparisons.len() == self.compared.len() {
            for (compared, row) in self.compared.iter().zip(comparisons) {
                if let Compared::Paired(key, _) = compared {
                    add(key, row.trials, &[row.first_only?, row.second_only?]);
                }
            }
        }
        let decisions = self
            .keys
            .iter()
            .cloned()
            .zip(rows.iter().map(Row::decision));
        counts.decisions = decisions.collect();
        Some(counts)
    }

    fn plot(&self, rows: &[Row], seed: u64) -> Result<Plot, FigureError> {
        let values = &self.config.axis.values;
        let curve = |(index, curve): (usize, &Curve)| picture::SweepCurve {
            panel: curve.panel.clone(),
            series: curve.series.clone(),
            step_gain: (values.first())
                .and_then(|value| self.config.scenario(index, value).ok())
                .map(|scenario| scenario.sensor.step_gain()),
        };
        let sweep = picture::Sweep {
            axis: self.config.parameter(),
            values: values.iter().filter_map(|value| value.number()).collect(),
            curves: self.config.curves.iter().enumerate().map(curve).collect(),
        };
        picture::plot(&sweep, rows, seed)
    }

    fn points(&self) -> String {
        let points = &self.plan.points;
        let at_rest = points
            .iter()
            .filter(|p| p.hypothesis == Hypothesis::H0)
            .count();
        format!(
            "{} in motion, {at_rest} at rest, of {} curves",
            points.len() - at_rest,
            self.config.curves.len()
        )
    }

    fn curves(&self, rows: &[Row]) -> (Scope, Vec<Outcome>) {
        let parameter = self.config.parameter();
        let outcomes = rows.iter().map(|row| row.outcome(parameter));
        (self.config.scope(), outcomes.collect())
    }
}
