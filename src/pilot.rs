//! Decisions that no exact law gives: pilot runs whose trials are never those that measure the result.
//!
//! Two things are learnt from pilots.
//!
//! - The `likelihood-ratio` rule needs the probabilities of (W, T) under its alternative: a pilot in
//!   motion counts them, see [`LikelihoodOrder`].
//! - A *calibrated* design needs false-alarm rates of the real chain, fitted filter and all: pilots at
//!   rest count them.
//!
//! # A promise
//! `calibrate = true` promises a false-alarm rate of at most α under each of [`PROMISED_LAWS`], with
//! 99.9 % confidence. The regions of a rule at the nominal levels α·0.95^j are tested in the order
//! j = …, 1, 0, fixed before the run: each must be shown, under every law, to have a rate of at most α by an
//! exact one-sided test at 0.001, and the first that is not ends the ladder. To end with a region whose rate is
//! above α under some law, the first such region on the ladder must have passed under that law: probability
//! at most 0.001. So neither the number of rungs nor the number of laws needs a further correction. No
//! level above α is tried: what the exact law refuses stays refused. For a score the rungs are its
//! thresholds, and the order statistic that passes the same test under the worst of the laws is the last.
//!
//! The promise is about these laws and no other: heavier contamination than theirs breaks it, and
//! `configs/alpha_training.toml` shows how.
//!
//! # A measurement
//! `calibrate = { law, sensor }` makes the false-alarm rate that a pilot measures with that noise equal to α,
//! as nearly as can be. It promises nothing; it makes detectors comparable, but for the error of the
//! pilot itself, which is in no interval of the results.

use crate::binomial;
use crate::chain::{
    Calibration, Decision, Detector, Observation, Purpose, RecordTooLong, Scenario, Score,
};
use crate::detect::{Histogram, LikelihoodOrder, Method, NullLaws, Region, Ties};
use crate::ensemble::{Ensemble, Sink};
use crate::plan::{Design, Plan, Point};
use crate::signal::{Law, Noise};
use std::sync::Arc;

/// The laws of noise under which a calibrated design promises its level, and under no other.
pub const PROMISED_LAWS: [Law; 4] = [Law::Normal, Law::Laplace, Law::Uniform, Law::Cauchy];

/// The probability that a promise is not kept, at most.
pub const PROMISE_LEVEL: f64 = 1e-3;

/// A rate measured by fewer false alarms is none.
const FEWEST_FALSE_ALARMS: u64 = 20;

/// An order found in fewer trials is none.
const FEWEST_TRIALS: u64 = 1000;

/// The rungs of the ladder: nominal levels down to a millionth of α.
const RUNGS: i32 = 270;
const RUNG: f64 = 0.95;

/// Why no decision could be found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PilotError {
    /// A pilot's record does not fit in memory.
    #[error("pilot: {0}")]
    Record(#[from] RecordTooLong),
    /// Nothing keeps the level.
    #[error(
        "curve {curve}: detector: {pilot} pilot trials show no region or threshold of rule {rule} that keeps \
         alpha = {alpha} (raise pilot, training or alpha)"
    )]
    Nothing {
        /// The label of the first curve that needs it.
        curve: String,
        /// The rule.
        rule: String,
        /// Its level.
        alpha: f64,
        /// Trials of each pilot.
        pilot: u64,
    },
}

/// The pilots that a plan needs.
#[derive(Debug)]
pub struct Pilots<'a> {
    plan: &'a Plan,
    /// What has to be found, each once, and by which point.
    needs: Vec<Need>,
    need_of: Vec<Option<usize>>,
    motion: Stage,
    rest: Stage,
}

/// A decision to be found.
#[derive(Debug)]
struct Need {
    /// The label of the first curve that needs it.
    curve: String,
    /// At rest, in the noise that its pilots start from.
    scenario: Scenario,
    /// What decides, where it is no region.
    score: Option<Arc<Score>>,
    /// False alarms that a pilot at rest may count.
    allowed: u64,
    /// Trials of a pilot.
    pilot: u64,
    /// Its place among the pilots in motion.
    motion: Option<usize>,
    /// Its places among the pilots at rest.
    rest: Vec<usize>,
}

/// Pilots that run together.
#[derive(Debug)]
struct Stage {
    scenarios: Vec<Scenario>,
    gauges: Vec<Gauge>,
    ensemble: Option<Ensemble>,
}

/// What a pilot looks at.
#[derive(Clone, Debug)]
enum Gauge {
    Statistics(Ties),
    /// A score, and how many of its largest values matter.
    Score(Arc<Score>, usize),
}

/// What it has seen.
#[derive(Clone, Debug)]
enum Gathered {
    Statistics(Histogram),
    Scores(Largest),
}

/// The largest so many of the values that have come by.
#[derive(Clone, Debug)]
struct Largest {
    keep: usize,
    values: Vec<f64>,
}

impl<'a> Pilots<'a> {
    /// What has to be run before the plan's points can decide.
    ///
    /// # Errors
    /// Where a pilot's record does not fit in memory, or a pilot is too short to show anything.
    pub fn new(plan: &'a Plan) -> Result<Self, PilotError> {
        let mut needs: Vec<Need> = Vec::new();
        let (mut motion, mut rest) = (Stage::new(), Stage::new());
        let mut need_of = Vec::new();
        for point in &plan.points {
            need_of.push(match point.design {
                Design::Region(_) => None,
                Design::Pilot => {
                    let scenario = believed(&point.scenario);
                    let known = needs.iter().position(|need| need.scenario == scenario);
                    Some(match known {
                        Some(known) => known,
                        None => {
                            needs.push(Need::new(
                                point,
                                scenario,
                                plan.pilot,
                                &mut motion,
                                &mut rest,
                            )?);
                            needs.len() - 1
                        }
                    })
                }
            });
        }
        motion.arrange(plan, Purpose::Ordering)?;
        rest.arrange(plan, Purpose::Calibration)?;
        Ok(Self {
            plan,
            needs,
            need_of,
            motion,
            rest,
        })
    }

    /// What the progress of [`Pilots::decide`] adds up to.
    pub fn work(&self) -> u64 {
        let stages = [&self.motion, &self.rest].into_iter();
        let ensembles = stages.filter_map(|stage| stage.ensemble.as_ref());
        ensembles.map(Ensemble::work).sum()
    }

    /// Decisions that cost as much time as the real ones and never decide H₁, for timing a run.
    pub fn stand_ins(&self) -> Vec<Decision> {
        let stand_in = |point: &Point| match (&point.design, Score::new(&point.scenario)) {
            (Design::Region(region), _) => region_decision(region.clone(), point),
            (Design::Pilot, Some(score)) => Decision::Threshold {
                score: Arc::new(score),
                threshold: f64::INFINITY,
            },
            (Design::Pilot, None) => {
                let ladder = Ladder::new(&point.scenario, None);
                region_decision(Arc::new(ladder.laws.empty_region()), point)
            }
        };
        self.plan.points.iter().map(stand_in).collect()
    }

    /// Runs the pilots and returns the decision of every point.
    ///
    /// # Errors
    /// Where nothing keeps the level.
    pub fn decide(&self, progress: impl Fn(u64) + Sync) -> Result<Vec<Decision>, PilotError> {
        let motion = self.motion.run(&progress);
        let rest = self.rest.run(&progress);
        let found: Vec<Decision> = self
            .needs
            .iter()
            .map(|need| need.decide(&motion, &rest))
            .collect::<Result<_, _>>()?;
        let points = self.plan.points.iter().zip(&self.need_of);
        Ok(points
            .map(|(point, need)| match (&point.design, need) {
                (Design::Region(region), _) => region_decision(region.clone(), point),
                (Design::Pilot, need) => found[need.expect("a pilot was planned")].clone(),
            })
            .collect())
    }
}

fn region_decision(region: Arc<Region>, point: &Point) -> Decision {
    let ties = point.scenario.detector.ties;
    Decision::Region { region, ties }
}

/// The scenario at rest, with the sensor and law that its calibration starts from.
fn believed(scenario: &Scenario) -> Scenario {
    let mut rest = scenario.at_rest();
    match &scenario.detector.calibration {
        Calibration::None => {}
        Calibration::Promise => rest.noise = law(PROMISED_LAWS[0]),
        Calibration::Measured { sensor, noise } => {
            (rest.sensor, rest.noise) = (sensor.clone(), *noise);
        }
    }
    rest
}

fn law(law: Law) -> Noise {
    Noise::new(law).expect("the promised laws have no parameters out of range")
}

impl Stage {
    fn new() -> Self {
        Self {
            scenarios: Vec::new(),
            gauges: Vec::new(),
            ensemble: None,
        }
    }

    /// Adds a pilot and returns its place.
    fn add(&mut self, scenario: Scenario, gauge: Gauge) -> usize {
        self.scenarios.push(scenario);
        self.gauges.push(gauge);
        self.gauges.len() - 1
    }

    fn arrange(&mut self, plan: &Plan, purpose: Purpose) -> Result<(), RecordTooLong> {
        if !self.scenarios.is_empty() {
            let (trials, seed) = (plan.pilot, plan.seed);
            let ensemble = Ensemble::new(&self.scenarios, trials, seed, purpose, true);
            self.ensemble = Some(ensemble.map_err(|(_, refusal)| refusal)?);
        }
        Ok(())
    }

    fn run(&self, progress: impl Fn(u64) + Sync) -> Vec<Gathered> {
        let new = || Gatherer {
            gauges: &self.gauges,
            gathered: self.gauges.iter().map(Gauge::nothing).collect(),
        };
        let ensemble = self.ensemble.as_ref();
        ensemble.map_or(Vec::new(), |ensemble| ensemble.run(new, progress).gathered)
    }
}

impl Need {
    fn new(
        point: &Point,
        scenario: Scenario,
        pilot: u64,
        motion: &mut Stage,
        rest: &mut Stage,
    ) -> Result<Self, PilotError> {
        let detector = &scenario.detector;
        let curve = point.label.clone();
        let is_too_short = detector.method == Method::LikelihoodRatio && pilot < FEWEST_TRIALS;
        let allowed = allowed(detector, pilot).filter(|_| !is_too_short);
        let Some(allowed) = allowed else {
            return Err(nothing(curve, detector, pilot));
        };
        let score = Score::new(&scenario).map(Arc::new);
        let gauge = match &score {
            Some(score) => Gauge::Score(score.clone(), allowed as usize + 1),
            None => Gauge::Statistics(detector.ties),
        };
        let stated = detector
            .stated
            .filter(|_| detector.method == Method::LikelihoodRatio);
        let moving = stated.map(|(motion, impulses)| Scenario {
            motion,
            impulses,
            ..scenario.clone()
        });
        Ok(Self {
            motion: moving.map(|moving| motion.add(moving, gauge.clone())),
            rest: resting(&scenario)
                .into_iter()
                .map(|resting| rest.add(resting, gauge.clone()))
                .collect(),
            curve,
            scenario,
            score,
            allowed,
            pilot,
        })
    }

    fn decide(&self, motion: &[Gathered], rest: &[Gathered]) -> Result<Decision, PilotError> {
        let detector = &self.scenario.detector;
        let rest: Vec<&Gathered> = self.rest.iter().map(|&place| &rest[place]).collect();
        if let Some(score) = &self.score {
            let thresholds = rest.iter().map(|gathered| gathered.threshold());
            return Ok(Decision::Threshold {
                score: score.clone(),
                threshold: thresholds.fold(f64::NEG_INFINITY, f64::max),
            });
        }
        let ladder = Ladder::new(&self.scenario, self.motion.map(|place| &motion[place]));
        let keeps = |region: &Region| {
            let mut counts = rest.iter().map(|gathered| gathered.count(region));
            counts.all(|count| count <= self.allowed)
        };
        let region = match detector.calibration {
            Calibration::None => ladder.region(detector.alpha),
            Calibration::Promise => ladder.climb(detector.alpha, keeps),
            Calibration::Measured { .. } => ladder.search(keeps),
        };
        match region.size() > 0.0 {
            true => Ok(Decision::Region {
                region: Arc::new(region),
                ties: detector.ties,
            }),
            false => Err(nothing(self.curve.clone(), detector, self.pilot)),
        }
    }
}

/// The rests on which its level is to be measured.
fn resting(scenario: &Scenario) -> Vec<Scenario> {
    match scenario.detector.calibration {
        Calibration::None => Vec::new(),
        Calibration::Measured { .. } => vec![scenario.clone()],
        Calibration::Promise => {
            let under = |of| Scenario {
                noise: law(of),
                ..scenario.clone()
            };
            PROMISED_LAWS.map(under).to_vec()
        }
    }
}

fn nothing(curve: String, detector: &Detector, pilot: u64) -> PilotError {
    PilotError::Nothing {
        curve,
        rule: detector.method.to_string(),
        alpha: detector.alpha,
        pilot,
    }
}

/// How many false alarms a pilot at rest may count; none where it is too short to show anything.
fn allowed(detector: &Detector, pilot: u64) -> Option<u64> {
    let expected = (detector.alpha * pilot as f64).floor() as u64;
    match detector.calibration {
        Calibration::None => return Some(0),
        Calibration::Measured { .. } => {
            return (expected >= FEWEST_FALSE_ALARMS).then_some(expected);
        }
        Calibration::Promise => {}
    }
    // Counts that a rate of α would reach or undercut with probability 0.001 at most.
    let is_shown = |count: u64| binomial::lower_tail(count, pilot, detector.alpha) <= PROMISE_LEVEL;
    let (mut shown, mut not_shown) = (0, expected + 1);
    while shown < not_shown {
        let middle = shown + (not_shown - shown) / 2;
        match is_shown(middle) {
            true => shown = middle + 1,
            false => not_shown = middle,
        }
    }
    shown.checked_sub(1)
}

/// The regions of one rule by their nominal level.
struct Ladder {
    laws: NullLaws,
    method: Method,
    order: Option<LikelihoodOrder>,
}

impl Ladder {
    fn new(scenario: &Scenario, motion: Option<&Gathered>) -> Self {
        let detector = &scenario.detector;
        let laws = NullLaws::new(detector.alternative, &scenario.samples)
            .expect("the plan has made these laws before");
        let order = motion.map(|gathered| match gathered {
            Gathered::Statistics(histogram) => LikelihoodOrder::new(&laws, histogram),
            Gathered::Scores(_) => unreachable!("a likelihood ratio of W and T"),
        });
        Self {
            laws,
            method: detector.method.clone(),
            order,
        }
    }

    /// The region of a nominal level; empty where the rule has none.
    fn region(&self, level: f64) -> Region {
        let region = match (&self.method, &self.order) {
            (_, Some(order)) => Ok(self.laws.likelihood_region(order, level)),
            (Method::Rule(rule), None) => self.laws.region(rule, level),
            (_, None) => Ok(self.laws.empty_region()),
        };
        region.unwrap_or_else(|_| self.laws.empty_region())
    }

    /// The last rung below the first that does not keep the level; the empty region below the ladder.
    fn climb(&self, alpha: f64, keeps: impl Fn(&Region) -> bool) -> Region {
        let rungs = (0..=RUNGS)
            .rev()
            .map(|rung| alpha * libm::pow(RUNG, rung.into()));
        let regions = rungs.map(|level| self.region(level));
        last_kept(regions, keeps).unwrap_or_else(|| self.laws.empty_region())
    }

    /// The largest region that keeps the level, whatever its nominal one. The halving takes for granted that
    /// false alarms grow with the nominal level; where a rule's regions are not quite nested it ends at one
    /// of the boundaries.
    fn search(&self, keeps: impl Fn(&Region) -> bool) -> Region {
        let (mut low, mut high) = (0.0, 1.0);
        let mut kept = self.laws.empty_region();
        // Forty halvings resolve any level that a pilot could tell apart.
        for _ in 0..40 {
            let middle = f64::midpoint(low, high);
            let region = self.region(middle);
            match keeps(&region) {
                true => (low, kept) = (middle, region),
                false => high = middle,
            }
        }
        kept
    }
}

/// The last of the ladder's rungs before the first that is not kept.
fn last_kept<R>(rungs: impl Iterator<Item = R>, keeps: impl Fn(&R) -> bool) -> Option<R> {
    rungs.take_while(|rung| keeps(rung)).last()
}

impl Gauge {
    fn nothing(&self) -> Gathered {
        match self {
            Self::Statistics(_) => Gathered::Statistics(Histogram::default()),
            Self::Score(_, keep) => Gathered::Scores(Largest {
                keep: *keep,
                values: Vec::new(),
            }),
        }
    }
}

impl Gathered {
    /// False alarms of a region.
    fn count(&self, region: &Region) -> u64 {
        match self {
            Self::Statistics(histogram) => {
                histogram.count(|statistics| region.contains(statistics))
            }
            Self::Scores(_) => unreachable!("a region of W and T"),
        }
    }

    /// The smallest of the largest that were kept: what as many as are allowed exceed, or fewer where
    /// some are equal.
    fn threshold(&self) -> f64 {
        match self {
            Self::Statistics(_) => unreachable!("a threshold of a score"),
            Self::Scores(largest) => largest.smallest(),
        }
    }
}

impl Largest {
    fn add(&mut self, value: f64) {
        self.values.push(value);
        // Sorted out now and then, so that the cost of a value stays small and so does the memory.
        if self.values.len() > 2 * self.keep + 1024 {
            self.sort_out();
        }
    }

    fn sort_out(&mut self) {
        self.values.sort_unstable_by(|a, b| b.total_cmp(a));
        self.values.truncate(self.keep);
    }

    fn smallest(&self) -> f64 {
        let mut sorted = self.clone();
        sorted.sort_out();
        sorted.values.last().copied().unwrap_or(f64::NEG_INFINITY)
    }
}

/// Gathers what the gauges show.
struct Gatherer<'a> {
    gauges: &'a [Gauge],
    gathered: Vec<Gathered>,
}

impl Sink for Gatherer<'_> {
    fn take(&mut self, place: usize, observation: &mut Observation) {
        match (&self.gauges[place], &mut self.gathered[place]) {
            (Gauge::Statistics(ties), Gathered::Statistics(histogram)) => {
                histogram.add(observation.statistics(*ties));
            }
            (Gauge::Score(score, _), Gathered::Scores(largest)) => {
                largest.add(score.of(observation))
            }
            _ => unreachable!("what is gathered is what the gauge shows"),
        }
    }

    fn merge(&mut self, other: Self) {
        for (sum, more) in self.gathered.iter_mut().zip(other.gathered) {
            match (sum, more) {
                (Gathered::Statistics(sum), Gathered::Statistics(more)) => sum.merge(&more),
                (Gathered::Scores(sum), Gathered::Scores(more)) => {
                    more.values.into_iter().for_each(|value| sum.add(value));
                }
                _ => unreachable!("both come from the same gauges"),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Config;

    /// One rung that fails ends the ladder, whatever comes after it: that is what keeps the promise.
    #[test]
    fn the_first_failure_ends_the_ladder() {
        let counts = [3, 5, 9, 4, 2, 8];
        let kept = |limit| last_kept(counts.into_iter(), |&count| count <= limit);
        assert_eq!(kept(5), Some(5));
        assert_eq!(kept(9), Some(8));
        assert_eq!(kept(2), None);
    }

    /// Against the definition by sums of exact masses: the largest count that a rate of α would reach or
    /// undercut with probability 0.001 at most; none where no count would do.
    #[test]
    fn allowed_counts_are_exact() {
        let detector = |calibrate: &str| {
            let text = format!(
                "question = \"?\"\nseed = 1\n[detector]\ncalibrate = {calibrate}\n[axis]\ndelta = [1.0]\n"
            );
            let config = Config::parse("test", &text).unwrap();
            config.scenario(0, &config.axis.values[0]).unwrap().detector
        };
        let promise = detector("true");
        for pilot in [700u64, 1000, 5000, 20_000] {
            let cumulative = |count: u64| {
                (0..=count)
                    .map(|k| binomial::mass(k, pilot, 0.01))
                    .sum::<f64>()
            };
            let expected = (0..pilot)
                .take_while(|&count| cumulative(count) <= 1e-3)
                .last();
            assert_eq!(allowed(&promise, pilot), expected, "{pilot}");
        }
        assert_eq!(allowed(&promise, 500), None);
        assert_eq!(allowed(&detector("{}"), 5000), Some(50));
        assert_eq!(allowed(&detector("{}"), 1000), None);
    }

    /// What is kept of many values are the largest, whatever their order.
    #[test]
    fn largest_are_kept() {
        let mut largest = Largest {
            keep: 5,
            values: Vec::new(),
        };
        (0..9000u64).for_each(|i| largest.add((i * 7919 % 9000) as f64));
        assert_eq!(largest.smallest(), 8995.0);
    }
}
