//! One trial of a family: from the noise of its batch to the observation of every point, in buffers that
//! are allocated once.

use super::batch::{Batch, observe};
use super::family::{Branch, Course, Family};
use super::keys::Keys;
use super::motion::{Motion, pool};
use super::observation::{Observation, Scratch, Track, View};
use super::source::Source;
use crate::detect::Crossings;
use crate::simd::Vectors;
use crate::whiten::whiten;

/// The buffers of a trial. Records start at the first observation, or, if named `motion`, at the first
/// after X.
pub struct Trial<'a> {
    family: &'a Family,
    pub(super) batch: Batch<'a>,
    record: Record,
    pub(super) motion: Motion,
    /// One for every course of every branch; `None` where counting along Δ does not apply or does not pay.
    curves: Vec<Option<Curve>>,
    pub(super) keys: Keys<'a>,
    scratch: Scratch,
}

/// The record itself, if a point needs it.
struct Record {
    /// Raw samples at rest.
    raw: Vec<f64>,
    /// Observations at rest, followed by the last observations in motion.
    observed: Vec<f64>,
    /// The raw record with the motion in it, from the first sample after X.
    raw_motion: Vec<f64>,
    /// The observed record with the motion in it, from the first after X.
    motion: Vec<f64>,
}

/// Counts the statistics along Δ, with the points that use them.
struct Curve {
    crossings: Crossings,
    tracks: Vec<Track>,
}

/// The number of values of Δ from which crossings are cheaper than comparing the samples at each.
const CROSSINGS_PAY: usize = 4;

impl<'a> Trial<'a> {
    /// The buffers for trials of `family`.
    pub fn new(family: &'a Family) -> Self {
        let source = &family.source;
        let after = source.motion_observations();
        let raw_after = after * source.samples.decimation();
        let looks = family.branches.iter().any(|branch| branch.needs_record);
        let recorded = |length: usize| vec![0.0; if looks { length } else { 0 }];
        Self {
            family,
            batch: Batch::new(family),
            record: Record {
                raw: recorded(source.raw_length()),
                observed: recorded(source.observations()),
                raw_motion: recorded(raw_after),
                motion: recorded(after),
            },
            motion: Motion::new(raw_after, after),
            curves: (family.courses())
                .map(|(branch, course)| Curve::new(branch, course))
                .collect(),
            keys: Keys::new(&family.ties, source.samples.span()),
            scratch: Scratch::default(),
        }
    }

    /// Draws the noise of trial `index` and passes the observation of every point to `view`. Consecutive
    /// trials are cheapest.
    pub fn run(&mut self, index: u64, view: &mut impl View) {
        let lane = self.batch.seek(index);
        let Self {
            family,
            batch,
            record,
            motion,
            curves,
            keys,
            scratch,
        } = self;
        let source = &family.source;
        keys.start(index);
        let mut curves = curves.iter_mut();
        for (number, branch) in family.branches.iter().enumerate() {
            let (coefficients, rest) = batch.rest(number, lane);
            let is_linear = branch.digitiser.is_transparent();
            if branch.needs_record {
                record.observe(batch.raw(lane), branch, source);
            }
            for course in &branch.courses {
                let curve = curves.next().expect("one for each course");
                motion.draw_impulses(course, batch.impulses(lane), source);
                if is_linear {
                    motion.respond(course, coefficients, source, rest);
                }
                if let Some(Curve { crossings, tracks }) = curve
                    && let Some(counted) = motion.count(crossings, &source.samples, rest)
                {
                    let mut observation = Observation::new(&source.samples, keys, scratch);
                    view.look_along(tracks, counted, &mut observation);
                    continue;
                }
                for stage in &course.stages {
                    if is_linear {
                        motion.add_step(stage.delta);
                    } else {
                        record.write(branch, course, stage.delta, source, &motion.pattern);
                        let whitened = &mut motion.whitened;
                        whiten(coefficients, &record.observed, source.rest(), whitened);
                    }
                    let mut observation = Observation::new(&source.samples, keys, scratch);
                    observation.pooled = pool(&source.samples, rest, &motion.whitened);
                    if course.needs_record {
                        record.keep(
                            is_linear,
                            course,
                            stage.delta,
                            source,
                            motion.observed(source),
                        );
                        observation.rest = &record.observed[..source.rest()];
                        observation.motion = &record.motion;
                    }
                    for &place in &stage.places {
                        view.look(place, &mut observation);
                    }
                }
            }
        }
    }
}

impl Curve {
    /// `Some` if the whitened samples are lines in Δ, there are enough values of it, and no point uses more
    /// than the statistics.
    fn new(branch: &Branch, course: &Course) -> Option<Self> {
        let pays = course.stages.len() >= CROSSINGS_PAY;
        if !pays || course.needs_samples || !branch.digitiser.is_transparent() {
            return None;
        }
        let deltas = course.stages.iter().map(|stage| stage.delta).collect();
        let points = (course.stages.iter().enumerate())
            .flat_map(|(number, stage)| stage.places.iter().map(move |&place| (number, place)));
        Some(Self {
            crossings: Crossings::new(Vectors::widest(), deltas, course.needs_shift_exceedances),
            tracks: Track::through(points.collect()),
        })
    }
}

impl Record {
    /// Observes the rest by the branch's digitiser.
    fn observe(&mut self, raw: impl Iterator<Item = f64>, branch: &Branch, source: &Source) {
        self.raw.iter_mut().zip(raw).for_each(|(x, raw)| *x = raw);
        let decimation = source.samples.decimation();
        observe(&branch.digitiser, decimation, &self.raw, &mut self.observed);
    }

    /// Adds the motion to the raw record and digitises it.
    fn write(
        &mut self,
        branch: &Branch,
        course: &Course,
        delta: f64,
        source: &Source,
        pattern: &[f64],
    ) {
        let theta = course.impulses.theta.get();
        let rest = &self.raw[self.raw.len() - self.raw_motion.len()..];
        for (i, r) in self.raw_motion.iter_mut().enumerate() {
            *r = rest[i] + delta * course.shape[i] + theta * pattern[i];
        }
        let observed = &mut self.observed[source.rest()..];
        let decimation = source.samples.decimation();
        observe(&branch.digitiser, decimation, &self.raw_motion, observed);
    }

    /// Keeps the observed record of this stage: already there on the direct path, a sum on the linear one.
    fn keep(
        &mut self,
        is_linear: bool,
        course: &Course,
        delta: f64,
        source: &Source,
        impulses: &[f64],
    ) {
        let observed = &self.observed[source.rest()..];
        if !is_linear {
            self.motion.copy_from_slice(observed);
            return;
        }
        let theta = course.impulses.theta.get();
        let motion = course.observed_shape.iter().zip(impulses);
        for ((r, x), (shape, impulse)) in self.motion.iter_mut().zip(observed).zip(motion) {
            *r = x + delta * shape + theta * impulse;
        }
    }
}
