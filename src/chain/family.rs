//! The points that share one noise realisation, arranged so that little is computed twice: source →
//! branches (digitiser, filter) → courses (impulses, shape of the acceleration) → stages (Δ) →
//! places (points that decide on the same samples).

use super::source::{RecordTooLong, Source};
use crate::detect::{Exceedances, Samples, Ties};
use crate::rng::Stream;
use crate::scenario::Scenario;
use crate::signal::{Digitiser, During, Impulses};
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

/// One way of recording and whitening it.
#[derive(Clone, Debug)]
pub(super) struct Branch {
    pub digitiser: Digitiser,
    pub whitening: Whitening,
    pub courses: Vec<Course>,
    /// Whether the record itself is needed: a point uses it, or it is digitised and so not linear in Δ.
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
    /// Whether the course before it in the branch has the same shape.
    pub repeats_shape: bool,
    /// In ascending order of Δ.
    pub stages: Vec<Stage>,
    /// Whether a point here uses more than W and T.
    pub needs_samples: bool,
    /// Whether a point here uses T′.
    pub needs_shift_exceedances: bool,
    /// Whether a point here uses the record itself.
    pub needs_record: bool,
}

/// One Δ, as added to the record.
#[derive(Clone, Debug)]
pub(super) struct Stage {
    pub delta: f64,
    /// The points that use it.
    pub places: Vec<usize>,
}

/// The purpose of a run; every purpose has its own draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// The reported results.
    Results,
    /// Ordering the cells of the plane of W and T against an alternative.
    Ordering,
    /// Finding the region or threshold that keeps a level. Neither may be tuned on the trials that
    /// measure it, nor the level be tested on those that gave the order.
    Calibration,
}

impl Family {
    /// Arranges `scenarios` into families; a scenario's place is its place in this list. With
    /// `common_random_numbers` points share noise wherever sensor, law, sizes and training length
    /// agree; without, every point that simulates anything different has noise of its own. `purpose`
    /// separates the draws of pilots from those of the results at the same seed.
    ///
    /// # Errors
    /// If a record does not fit in memory: the first such scenario and its memory.
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
            let subject = if common_random_numbers {
                source.subject()
            } else {
                source.subject_of_all(scenario)
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

    /// The number of (W, T) computed in one trial.
    pub fn points_per_trial(&self) -> usize {
        self.courses().map(|(_, course)| course.stages.len()).sum()
    }

    /// Memory of the buffers of a trial, in GB per thread.
    pub fn gigabytes(&self) -> f64 {
        self.gigabytes
    }

    /// Whether any point has impulses.
    pub(super) fn has_impulses(&self) -> bool {
        (self.courses()).any(|(_, course)| !course.impulses.are_absent())
    }

    /// The places of its points.
    pub fn places(&self) -> impl Iterator<Item = usize> {
        self.courses()
            .flat_map(|(_, course)| &course.stages)
            .flat_map(|stage| stage.places.iter().copied())
    }

    /// Every course with its branch.
    pub(super) fn courses(&self) -> impl Iterator<Item = (&Branch, &Course)> {
        let branches = self.branches.iter();
        branches.flat_map(|branch| branch.courses.iter().map(move |course| (branch, course)))
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
        let last = branch.courses.last();
        let repeats_shape = last.is_some_and(|last| last.shape == scenario.shape());
        let course = find_or_push(
            &mut branch.courses,
            |course| course.is_of(scenario),
            || Course {
                repeats_shape,
                ..Course::new(scenario)
            },
        );
        let detector = &scenario.detector;
        course.needs_samples |= detector.method.needs_samples() || detector.ties != Ties::Random;
        course.needs_shift_exceedances |= detector.exceedances == Exceedances::Motion;
        course.needs_record |= detector.method.needs_record();
        course.stage(scenario.record_delta()).places.push(place);
        branch.needs_record |= !branch.digitiser.is_transparent() || detector.method.needs_record();
    }
}

impl Course {
    fn new(scenario: &Scenario) -> Self {
        let shape = scenario.shape();
        let decimation = scenario.samples.decimation();
        Self {
            impulses: scenario.impulses,
            observed_shape: (shape.chunks_exact(decimation))
                .map(|block| block.iter().sum::<f64>() / decimation as f64)
                .collect(),
            repeats_shape: false,
            shape,
            stages: Vec::new(),
            needs_samples: false,
            needs_shift_exceedances: false,
            needs_record: false,
        }
    }

    /// The stage of this Δ, added if missing.
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
        first_impulse(&self.impulses, samples) * samples.decimation()
    }
}

/// The first observation after X that may carry an impulse.
pub(super) fn first_impulse(impulses: &Impulses, samples: &Samples) -> usize {
    match impulses.during {
        During::Motion => 0,
        During::Inertial => samples.scale_range().start - samples.reference(),
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
