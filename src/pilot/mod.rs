//! Decisions that no exact law gives: pilot runs whose trials are never those that measure the result.
//!
//! Two things are learnt from pilots.
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
    /// What has to be found, each once, and by which point.
    needs: Vec<Need>,
    need_of: Vec<Option<usize>>,
    motion: Stage,
    rest: Stage,
}

impl<'a> Pilots<'a> {
    /// What has to be run before the points can decide, in `trials` of each pilot.
    ///
    /// # Errors
    /// Where a pilot's record does not fit in memory, or a pilot is too short to show anything.
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

    /// What the progress of [`Pilots::decide`] adds up to.
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
    /// Where nothing keeps the level.
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
