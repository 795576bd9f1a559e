//! The points that share one noise realisation, arranged so that nothing is computed twice: source →
//! branches (digitiser, filter) → courses (impulses, shape of the acceleration) → stages (Δ) →
//! verdicts (regions).

use super::scenario::Scenario;
use super::trial::Trial;
use crate::detect::{Region, Samples};
use crate::rng::Stream;
use crate::signal::{Digitiser, During, Impulses, Motion, Noise, Sensor};
use crate::whiten::Whitening;
use serde::Serialize;
use std::sync::Arc;

/// All points that share their noise.
#[derive(Clone, Debug)]
pub struct Family {
    pub(super) source: Source,
    pub(super) noise: Stream,
    pub(super) impulses: Stream,
    pub(super) ties: Stream,
    pub(super) branches: Vec<Branch>,
}

/// What the noise of a trial depends on, and how much of it there is.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Source {
    pub sensor: Sensor,
    pub noise: Noise,
    pub samples: Samples,
    /// Observations before X.
    pub lead: usize,
}

/// One way of recording and whitening it.
#[derive(Clone, Debug)]
pub(super) struct Branch {
    pub digitiser: Digitiser,
    pub whitening: Whitening,
    pub courses: Vec<Course>,
}

/// One pattern of impulses and shape of acceleration.
#[derive(Clone, Debug)]
pub(super) struct Course {
    pub impulses: Impulses,
    /// The acceleration in units of Δ, one value for each raw observation after X.
    pub shape: Vec<f64>,
    pub stages: Vec<Stage>,
}

/// One Δ, as added to the record.
#[derive(Clone, Debug)]
pub(super) struct Stage {
    pub delta: f64,
    pub verdicts: Vec<Verdict>,
}

/// One region, and the counter of its decisions.
#[derive(Clone, Debug)]
pub(super) struct Verdict {
    pub region: Arc<Region>,
    pub counter: usize,
}

/// A record that does not fit in memory.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "one trial of {samples:.3e} raw samples needs {gigabytes:.1} GB, more than the {limit:.1} GB allowed \
     (lower training, order, the sample sizes, gap or decimation)"
)]
pub struct RecordTooLong {
    /// Raw samples in one trial.
    pub samples: f64,
    /// Its memory.
    pub gigabytes: f64,
    /// What is allowed.
    pub limit: f64,
}

/// The most memory one record may take.
const MEMORY_LIMIT: f64 = 5e8;

impl Family {
    /// Arranges `points` (scenario and region; a point's place is its counter) into families. With
    /// `common_random_numbers` points share noise wherever sensor, law, sizes and training length
    /// agree; without, every point that simulates anything different has noise of its own.
    ///
    /// # Errors
    /// Where a record would not fit in memory: the first such point, and how much it takes.
    pub fn arrange<'a>(
        points: impl IntoIterator<Item = (&'a Scenario, Arc<Region>)>,
        seed: u64,
        common_random_numbers: bool,
    ) -> Result<Vec<Self>, (usize, RecordTooLong)> {
        let mut families: Vec<Self> = Vec::new();
        for (counter, (scenario, region)) in points.into_iter().enumerate() {
            let source = Source::new(scenario);
            source
                .check_memory(scenario.whitening.order())
                .map_err(|refusal| (counter, refusal))?;
            let shares = |family: &&mut Self| {
                family.source == source && (common_random_numbers || family.simulates(scenario))
            };
            let verdict = Verdict { region, counter };
            match families.iter_mut().find(shares) {
                Some(family) => family.insert(scenario, verdict),
                None => {
                    let mut family = match common_random_numbers {
                        true => Self::new(source.clone(), seed, &source),
                        false => Self::new(source.clone(), seed, &Source::and_all(scenario)),
                    };
                    family.insert(scenario, verdict);
                    families.push(family);
                }
            }
        }
        Ok(families)
    }

    fn new(source: Source, seed: u64, subject: &impl Serialize) -> Self {
        Self {
            source,
            noise: Stream::new(seed, "noise", subject),
            impulses: Stream::new(seed, "impulses", subject),
            ties: Stream::new(seed, "ties", subject),
            branches: Vec::new(),
        }
    }

    /// Runs the first `trials` trials of `block`, whose first trial has index `first`, and adds each
    /// decision for H₁ to its counter. Trials of a block follow each other in one generator, so a
    /// block always starts at its first trial.
    pub fn run(&self, block: u64, first: u64, trials: u64, counters: &mut [u64]) {
        let mut trial = Trial::new(self);
        let mut noise = self.noise.at(block);
        let mut impulses = self.impulses.at(block);
        for index in first..first + trials {
            trial.run(index, &mut noise, &mut impulses, counters);
        }
    }

    /// Raw samples in one trial, burn-in included.
    pub fn samples_per_trial(&self) -> usize {
        self.source.burn_in() + self.source.raw_length()
    }

    /// How many (W, T) are computed in one trial.
    pub fn points_per_trial(&self) -> usize {
        let stages = |course: &Course| course.stages.len();
        let courses = self.branches.iter().flat_map(|branch| &branch.courses);
        courses.map(stages).sum()
    }

    /// Whether this family is the one of exactly this simulation.
    pub(super) fn simulates(&self, scenario: &Scenario) -> bool {
        self.branches.iter().all(|branch| {
            branch.digitiser == scenario.digitiser
                && branch.whitening == scenario.whitening
                && branch.courses.iter().all(|course| {
                    let delta = scenario.record_delta();
                    course.is_of(scenario) && course.stages.iter().all(|s| s.delta == delta)
                })
        })
    }

    fn insert(&mut self, scenario: &Scenario, verdict: Verdict) {
        let branch = find_or_push(
            &mut self.branches,
            |b| b.digitiser == scenario.digitiser && b.whitening == scenario.whitening,
            || Branch {
                digitiser: scenario.digitiser,
                whitening: scenario.whitening,
                courses: Vec::new(),
            },
        );
        let course = find_or_push(
            &mut branch.courses,
            |course| course.is_of(scenario),
            || Course::new(scenario),
        );
        let delta = scenario.record_delta();
        let stage = find_or_push(
            &mut course.stages,
            |stage| stage.delta == delta,
            || Stage {
                delta,
                verdicts: Vec::new(),
            },
        );
        stage.verdicts.push(verdict);
    }
}

impl Source {
    pub fn new(scenario: &Scenario) -> Self {
        Self {
            sensor: scenario.sensor.clone(),
            noise: scenario.noise,
            samples: scenario.samples,
            lead: scenario.whitening.lead(),
        }
    }

    /// Everything a scenario simulates, decisions apart: the subject of noise that nothing shares.
    fn and_all(scenario: &Scenario) -> (Self, Digitiser, Motion, Impulses, Whitening) {
        (
            Self::new(scenario),
            scenario.digitiser,
            scenario.motion,
            scenario.impulses,
            scenario.whitening,
        )
    }

    /// Raw samples before the record proper.
    pub fn burn_in(&self) -> usize {
        self.sensor.burn_in()
    }

    /// Observations of a trial.
    pub fn observations(&self) -> usize {
        self.lead + self.samples.span()
    }

    /// Raw samples of a trial without the burn-in.
    pub fn raw_length(&self) -> usize {
        self.observations() * self.samples.decimation()
    }

    /// Observations after X.
    pub fn motion_observations(&self) -> usize {
        self.samples.span() - self.samples.reference()
    }

    fn check_memory(&self, order: usize) -> Result<(), RecordTooLong> {
        let observations = self.lead as f64 + self.samples.span() as f64;
        let samples = observations * self.samples.decimation() as f64 + self.burn_in() as f64;
        let normal_equations = (order as f64 + 1.0).powi(2);
        let bytes = 16.0 * samples + 8.0 * normal_equations;
        if bytes > MEMORY_LIMIT {
            return Err(RecordTooLong {
                samples,
                gigabytes: bytes / 1e9,
                limit: MEMORY_LIMIT / 1e9,
            });
        }
        Ok(())
    }
}

impl Course {
    fn new(scenario: &Scenario) -> Self {
        Self {
            impulses: scenario.impulses,
            shape: shape(scenario),
            stages: Vec::new(),
        }
    }

    fn is_of(&self, scenario: &Scenario) -> bool {
        self.impulses == scenario.impulses && self.shape == shape(scenario)
    }

    /// The first raw observation after X that may carry an impulse.
    pub fn first_impulse(&self, samples: &Samples) -> usize {
        match self.impulses.during() {
            During::Motion => 0,
            During::Inertial => {
                (samples.scale_range().start - samples.reference()) * samples.decimation()
            }
        }
    }
}

/// The acceleration in units of Δ at the middle of each raw observation after X.
fn shape(scenario: &Scenario) -> Vec<f64> {
    let samples = &scenario.samples;
    let decimation = samples.decimation();
    let raw = (samples.span() - samples.reference()) * decimation;
    (0..raw)
        .map(|i| scenario.motion.shape((i as f64 + 0.5) / decimation as f64))
        .collect()
}

impl Scenario {
    fn record_delta(&self) -> f64 {
        self.motion.record_delta(self.sensor.step_gain())
    }
}

fn find_or_push<T>(
    items: &mut Vec<T>,
    is_it: impl Fn(&T) -> bool,
    make: impl FnOnce() -> T,
) -> &mut T {
    let index = items.iter().position(is_it).unwrap_or_else(|| {
        items.push(make());
        items.len() - 1
    });
    &mut items[index]
}
