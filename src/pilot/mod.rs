//! Decisions without an exact law: pilot runs, on trials that are never used for the result.
//!
//! Pilots have two uses.
//!
//! - The `likelihood-ratio` rule needs the probabilities of (W, T) under its alternative: a pilot in
//!   motion counts them, see [`LikelihoodOrder`](crate::detect::LikelihoodOrder).
//! - A *calibrated* design needs false-alarm rates of the real chain, fitted filter and all: pilots at
//!   rest count them.
//!
//! # A promise
//! `calibrate = true` promises a false-alarm rate of at most α under each of [`PROMISED_LAWS`], with
//! 99.9 % confidence. The regions of a rule at the nominal levels α·0.95^j are tested in the order
//! j = …, 1, 0, fixed before the run: each must be shown, under every law, to have a rate of at most α by an
//! exact one-sided test at 0.001, and the first failure ends the procedure. To end with a region whose rate is
//! above α under some law, the first such region must have passed under that law: probability at most 0.001.
//! So neither the number of levels nor the number of laws needs a further correction. No level above α is
//! tried: a region that the exact law refuses stays refused. For a score the thresholds take the place of the
//! levels, and the last one is the order statistic that passes the same test under the worst of the laws.
//!
//! The promise covers only these laws: heavier contamination breaks it, as `configs/alpha_training.toml`
//! shows.
//!
//! # A measurement
//! `calibrate = { law, sensor }` makes the false-alarm rate that a pilot measures with that noise equal to α,
//! as nearly as possible. It promises nothing. It makes detectors comparable up to the sampling error of the
//! pilot, which the intervals of the results do not include.

mod gather;
mod ladder;
mod need;
mod stage;

pub use need::{PROMISE_LEVEL, PROMISED_LAWS, PilotError};

use crate::chain::{Decision, Purpose, Score};
use crate::detect::Region;
use crate::plan::{Design, Point};
use ladder::Ladder;
use need::{Need, believed};
use stage::Stage;
use std::sync::Arc;

/// The pilots that some points need.
#[derive(Debug)]
pub struct Pilots<'a> {
    points: &'a [Point],
    /// The distinct decisions to be found.
    needs: Vec<Need>,
    need_of: Vec<Option<usize>>,
    motion: Stage,
    rest: Stage,
}

impl<'a> Pilots<'a> {
    /// Collects the pilots that the points need, of so many `trials` each.
    ///
    /// # Errors
    /// If a pilot's record does not fit in memory, or a pilot is too short to show anything.
    pub fn new(points: &'a [Point], trials: u64, seed: u64) -> Result<Self, PilotError> {
        let mut needs: Vec<Need> = Vec::new();
        let (mut motion, mut rest) = (Stage::default(), Stage::default());
        let mut need_of = Vec::new();
        for point in points {
            need_of.push(match point.design {
                Design::Region(_) => None,
                Design::Pilot => {
                    let scenario = believed(&point.scenario);
                    let known = needs.iter().position(|need| need.scenario == scenario);
                    Some(match known {
                        Some(known) => known,
                        None => {
                            needs.push(Need::new(point, scenario, trials, &mut motion, &mut rest)?);
                            needs.len() - 1
                        }
                    })
                }
            });
        }
        motion.arrange(trials, seed, Purpose::Ordering)?;
        rest.arrange(trials, seed, Purpose::Calibration)?;
        Ok(Self {
            points,
            needs,
            need_of,
            motion,
            rest,
        })
    }

    /// The total that the progress of [`Pilots::decide`] reaches.
    pub fn work(&self) -> u64 {
        self.motion.work() + self.rest.work()
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
        self.points.iter().map(stand_in).collect()
    }

    /// Runs the pilots and returns the decision of every point.
    ///
    /// # Errors
    /// If no region or threshold keeps the level.
    pub fn decide(&self, progress: impl Fn(u64) + Sync) -> Result<Vec<Decision>, PilotError> {
        let motion = self.motion.run(&progress);
        let rest = self.rest.run(&progress);
        let found: Vec<Decision> = self
            .needs
            .iter()
            .map(|need| need.decide(&motion, &rest))
            .collect::<Result<_, _>>()?;
        let points = self.points.iter().zip(&self.need_of);
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
