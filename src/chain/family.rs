//! The points that share one noise realisation, arranged so that little is computed twice: source →
//! branches (digitiser, filter) → courses (impulses, shape of the acceleration) → stages (Δ) →
//! places (points that decide on the same samples).

use crate::detect::{Samples, Ties};
use crate::rng::Stream;
use crate::scenario::Scenario;
use crate::signal::{Digitiser, Disturbance, During, Impulses, Noise, Sensor};
use crate::simd::LANES;
use crate::whiten::Whitening;

/// All points that share their noise.
#[derive(Clone, Debug)]
pub struct Family {
    pub(super) source: Source,
    subject: String,
    gigabytes: f64,
    pub(super) noise: Stream,
    pub(super) impulses: Stream,
    pub(super) ties: Stream,
    pub(super) footfalls: Stream,
    pub(super) branches: Vec<Branch>,
}

/// What the noise of a trial depends on, and how much of it there is.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Source {
    pub sensor: Sensor,
    pub noise: Noise,
    pub disturbance: Disturbance,
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
    /// Whether the record itself has to be written down: a point looks at it, or it is digitised and so
    /// not linear in Δ.
    pub needs_record: bool,
}

/// One pattern of impulses and shape of acceleration.
#[derive(Clone, Debug)]
pub(super) struct Course {
    pub impulses: Impulses,
    /// The acceleration in units of Δ, one value for each raw observation after X.
    pub shape: Vec<f64>,
    /// Its block means.
    pub observed_shape: Vec<f64>,
    /// In ascending order of Δ.
    pub stages: Vec<Stage>,
    /// Whether a point here looks at more than W and T.
    pub needs_samples: bool,
    /// Whether a point here looks at the record itself.
    pub needs_record: bool,
}

/// One Δ, as added to the record.
#[derive(Clone, Debug)]
pub(super) struct Stage {
    pub delta: f64,
    /// The points that look at it.
    pub places: Vec<usize>,
}

/// What a run is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// What is reported.
    Results,
    /// Ordering the cells of the plane of W and T against an alternative.
    Ordering,
    /// Finding the region or threshold that keeps a level. Neither may be tuned on the trials that
    /// measure it, nor the level be tested on those that gave the order.
    Calibration,
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

/// The most memory the buffers of one trial may take, in GB; every thread has its own.
const MEMORY_LIMIT: f64 = 0.5;

impl Family {
    /// Arranges `scenarios` into families; a scenario's place is its place in this list. With
    /// `common_random_numbers` points share noise wherever sensor, law, sizes and training length
    /// agree; without, every point that simulates anything different has noise of its own. `purpose`
    /// tells the draws of one run from those of another at the same seed.
    ///
    /// # Errors
    /// Where a record would not fit in memory: the first such scenario, and how much it takes.
    pub fn arrange<'a>(
        scenarios: impl IntoIterator<Item = &'a Scenario>,
        seed: u64,
        purpose: Purpose,
        common_random_numbers: bool,
    ) -> Result<Vec<Self>, (usize, RecordTooLong)> {
        let mut families: Vec<Self> = Vec::new();
        for (place, scenario) in scenarios.into_iter().enumerate() {
            let source = Source::new(scenario);
            let gigabytes = source
                .check_memory(scenario)
                .map_err(|refusal| (place, refusal))?;
            let subject = match common_random_numbers {
                true => source.subject(),
                false => source.subject_of_all(scenario),
            };
            let disturbance = source.disturbance;
            let family = find_or_push(
                &mut families,
                |family| family.subject == subject && family.source.disturbance == disturbance,
                || Self::new(source, seed, purpose, &subject),
            );
            family.gigabytes = family.gigabytes.max(gigabytes);
            family.insert(scenario, place);
        }
        Ok(families)
    }

    fn new(source: Source, seed: u64, purpose: Purpose, subject: &str) -> Self {
        let stream = |draws: &str| {
            let purpose = match purpose {
                Purpose::Results => draws.to_owned(),
                Purpose::Ordering => format!("ordering {draws}"),
                Purpose::Calibration => format!("calibration {draws}"),
            };
            Stream::new(seed, &purpose, subject)
        };
        Self {
            source,
            subject: subject.to_owned(),
            gigabytes: 0.0,
            noise: stream("noise"),
            impulses: stream("impulses"),
            ties: stream("ties"),
            footfalls: stream("footfalls"),
            branches: Vec::new(),
        }
    }

    /// How many (W, T) are computed in one trial.
    pub fn points_per_trial(&self) -> usize {
        let stages = |course: &Course| course.stages.len();
        let courses = self.branches.iter().flat_map(|branch| &branch.courses);
        courses.map(stages).sum()
    }

    /// Memory of the buffers of its trials, in GB; every thread has its own.
    pub fn gigabytes(&self) -> f64 {
        self.gigabytes
    }

    /// Whether anything in it vibrates.
    pub(super) fn has_impulses(&self) -> bool {
        let mut courses = self.branches.iter().flat_map(|branch| &branch.courses);
        courses.any(|course| !course.impulses.are_absent())
    }

    /// The places of its points.
    pub fn places(&self) -> impl Iterator<Item = usize> {
        let courses = self.branches.iter().flat_map(|branch| &branch.courses);
        let stages = courses.flat_map(|course| &course.stages);
        stages.flat_map(|stage| stage.places.iter().copied())
    }

    fn insert(&mut self, scenario: &Scenario, place: usize) {
        let branch = find_or_push(
            &mut self.branches,
            |b| b.digitiser == scenario.digitiser && b.whitening == scenario.whitening,
            || Branch {
                digitiser: scenario.digitiser,
                whitening: scenario.whitening,
                courses: Vec::new(),
                needs_record: false,
            },
        );
        let course = find_or_push(
            &mut branch.courses,
            |course| course.is_of(scenario),
            || Course::new(scenario),
        );
        let detector = &scenario.detector;
        course.needs_samples |= detector.method.needs_samples() || detector.ties != Ties::Random;
        course.needs_record |= detector.method.needs_record();
        course.stage(scenario.record_delta()).places.push(place);
        branch.needs_record |= !branch.digitiser.is_transparent() || detector.method.needs_record();
    }
}

impl Source {
    pub fn new(scenario: &Scenario) -> Self {
        Self {
            sensor: scenario.sensor.clone(),
            noise: scenario.noise,
            disturbance: scenario.disturbance,
            samples: scenario.samples,
            lead: scenario.whitening.lead(),
        }
    }

    /// What tells the noise of one source from another's, in the words of the results: a disturbed rest
    /// is the same rest disturbed. Part of every draw's coordinates: changing it changes results.
    fn subject(&self) -> String {
        let Self {
            sensor,
            noise,
            samples,
            lead,
            disturbance: _,
        } = self;
        let (gap, decimation) = (samples.gap(), samples.decimation());
        format!("{sensor} {noise} lead {lead} samples {samples} gap {gap} decimation {decimation}")
    }

    /// The same with everything else a scenario simulates, decisions apart: the subject of noise that
    /// nothing shares.
    fn subject_of_all(&self, scenario: &Scenario) -> String {
        let (motion, impulses) = (&scenario.motion, &scenario.impulses);
        let (whitening, digitiser) = (&scenario.whitening, &scenario.digitiser);
        format!(
            "{} whitening {} {} {} {} digitiser {:?} {:?} motion {} {} {} {} impulses {} {} {}",
            self.subject(),
            whitening.fit(),
            whitening.order(),
            whitening.training(),
            whitening.includes_reference(),
            digitiser.quantum(),
            digitiser.range(),
            scenario.record_delta(),
            motion.profile,
            motion.duration,
            motion.offset,
            impulses.nu(),
            impulses.theta(),
            impulses.during(),
        )
    }

    /// Raw samples before the record proper: none where the noise starts out stationary.
    pub fn burn_in(&self) -> usize {
        match self.noise.is_normal() {
            true => 0,
            false => self.sensor.burn_in(),
        }
    }

    /// Observations of a trial.
    pub fn observations(&self) -> usize {
        self.lead + self.samples.span()
    }

    /// Observations up to the last of X.
    pub fn rest(&self) -> usize {
        self.lead + self.samples.reference()
    }

    /// Raw samples of a trial without the burn-in.
    pub fn raw_length(&self) -> usize {
        self.observations() * self.samples.decimation()
    }

    /// Observations after X.
    pub fn motion_observations(&self) -> usize {
        self.samples.span() - self.samples.reference()
    }

    /// Refuses a trial whose buffers would not fit in memory: raw noise, what is observed and whitened
    /// of it, the same again for the motion, and the fit.
    fn check_memory(&self, scenario: &Scenario) -> Result<f64, RecordTooLong> {
        let decimation = self.samples.decimation() as f64;
        let span = self.samples.span() as f64;
        let after = span - self.samples.reference() as f64;
        let observations = self.lead as f64 + span;
        let samples = observations * decimation + self.burn_in() as f64;
        let whitening = &scenario.whitening;
        let fit =
            2.0 * whitening.training() as f64 + (whitening.highest_order() as f64 + 3.0).powi(2);
        let wide = samples + 2.0 * observations + 3.0 * span + whitening.training() as f64;
        let values =
            LANES as f64 * wide + samples + after * (LANES as f64 * decimation + 10.0) + fit;
        let gigabytes = 8.0 * values / 1e9;
        match gigabytes > MEMORY_LIMIT {
            true => Err(RecordTooLong {
                samples,
                gigabytes,
                limit: MEMORY_LIMIT,
            }),
            false => Ok(gigabytes),
        }
    }
}

impl Course {
    fn new(scenario: &Scenario) -> Self {
        let shape = scenario.shape();
        let decimation = scenario.samples.decimation();
        let mean = |block: &[f64]| block.iter().sum::<f64>() / decimation as f64;
        Self {
            impulses: scenario.impulses,
            observed_shape: shape.chunks_exact(decimation).map(mean).collect(),
            shape,
            stages: Vec::new(),
            needs_samples: false,
            needs_record: false,
        }
    }

    /// The stage of this Δ, new where there is none.
    fn stage(&mut self, delta: f64) -> &mut Stage {
        let index = self.stages.partition_point(|stage| stage.delta < delta);
        if self
            .stages
            .get(index)
            .is_none_or(|stage| stage.delta != delta)
        {
            let places = Vec::new();
            self.stages.insert(index, Stage { delta, places });
        }
        &mut self.stages[index]
    }

    fn is_of(&self, scenario: &Scenario) -> bool {
        self.impulses == scenario.impulses && self.shape == scenario.shape()
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
