//! What is wrong with the sensor itself: single samples that nothing moves it to, and stretches in which it repeats
//! one value although it scattered before. The first are replaced, the second left out, as if they were a hole.

use crate::recording::Sample;
use crate::stats::quantile::median;
use libm::log;
use std::borrow::Cow;
use std::ops::Range;

/// No shock is so far from both sides in one or two samples, m/s²; the others are near to each other, m/s².
const IMPOSSIBLE: f64 = 200.0;
const NEAR: f64 = 20.0;

/// The most samples of a glitch, and those looked at on either side.
const MOST: usize = 2;
const BESIDE: usize = 5;

/// A frozen sensor repeats its value for at least so long, s, and so often that chance does it once in e¹⁰ records.
const FROZEN: f64 = 1.5;
const CHANCE: f64 = 10.0;

/// A sensor that repeats itself more often than this is too coarse to tell.
const COARSE: f64 = 0.5;

/// What is wrong with the sensor.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Faults {
    /// The times of the samples that were replaced, s.
    pub glitches: Vec<f64>,
    /// From when to when one value is repeated, s.
    pub frozen: Vec<(f64, f64)>,
}

impl Faults {
    /// The samples without what is wrong with them, and that.
    pub fn removed(samples: &[Sample]) -> (Cow<'_, [Sample]>, Self) {
        let glitches: Vec<(Range<usize>, f64)> = (0..samples.len())
            .filter_map(|first| glitch(samples, first))
            .collect();
        let frozen = frozen(samples);
        let faults = Self {
            glitches: (glitches.iter())
                .flat_map(|glitch| glitch.0.clone().map(|place| samples[place].time))
                .collect(),
            frozen: (frozen.iter())
                .map(|run| (samples[run.start].time, samples[run.end - 1].time))
                .collect(),
        };
        if faults == Self::default() {
            return (Cow::Borrowed(samples), faults);
        }
        let mut sound = samples.to_vec();
        for (places, value) in glitches {
            let values = &mut sound[places];
            values
                .iter_mut()
                .for_each(|sample| sample.acceleration = value);
        }
        // Its first sample may have been read.
        for run in frozen.into_iter().rev() {
            sound.drain(run.start + 1..run.end);
        }
        (Cow::Owned(sound), faults)
    }
}

/// A glitch that begins with a sample, and what its neighbours read.
fn glitch(samples: &[Sample], first: usize) -> Option<(Range<usize>, f64)> {
    let leaps = |at: usize| {
        let step = samples[at].acceleration - samples[at - 1].acceleration;
        step.abs() > IMPOSSIBLE - NEAR
    };
    if first > 0 && !leaps(first) {
        return None;
    }
    (first + 1..=(first + MOST).min(samples.len())).find_map(|end| {
        let before = &samples[first.saturating_sub(BESIDE)..first];
        let after = &samples[end..(end + BESIDE).min(samples.len())];
        let beside = before.iter().chain(after).map(|sample| sample.acceleration);
        let middle = median(beside.clone().collect());
        let is_glitch = beside.clone().count() >= BESIDE
            && beside
                .into_iter()
                .all(|value| (value - middle).abs() < NEAR)
            && (samples[first..end].iter())
                .all(|sample| (sample.acceleration - middle).abs() > IMPOSSIBLE);
        is_glitch.then_some((first..end, middle))
    })
}

/// The runs of one value that are too long for the rest of the record, in order of time.
fn frozen(samples: &[Sample]) -> Vec<Range<usize>> {
    let mut repeats = 0;
    let mut runs: Vec<Range<usize>> = Vec::new();
    let mut first = 0;
    for equal in samples.chunk_by(|a, b| a.acceleration == b.acceleration) {
        let run = first..first + equal.len();
        first = run.end;
        repeats += equal.len() - 1;
        if equal[equal.len() - 1].time - equal[0].time >= FROZEN {
            runs.push(run);
        }
    }
    // The longest first: what is frozen says nothing of how often a sound sensor repeats itself.
    runs.sort_by_key(|run| std::cmp::Reverse(run.len()));
    let mut pairs = samples.len().saturating_sub(1);
    let mut is_frozen = |run: &Range<usize>| {
        let here = run.len() - 1;
        let (others, of) = ((repeats - here) as f64, (pairs - here) as f64);
        let share = (others + 1.0) / (of + 2.0);
        let is_chance = here as f64 * -log(share) < log(samples.len() as f64) + CHANCE;
        let is_frozen = share < COARSE && !is_chance;
        if is_frozen {
            (repeats, pairs) = (repeats - here, pairs - here);
        }
        is_frozen
    };
    let mut frozen: Vec<Range<usize>> = runs.into_iter().take_while(|run| is_frozen(run)).collect();
    frozen.sort_by_key(|run| run.start);
    frozen
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Twenty seconds of noise in steps of 0.01 m/s² at 50 Hz.
    fn noise() -> Vec<Sample> {
        let value = |i: u32| f64::from((i.wrapping_mul(2_654_435_761) >> 16) % 8) / 100.0;
        let sample = |i: u32| Sample {
            time: f64::from(i) / 50.0,
            acceleration: value(i),
        };
        (0..1000).map(sample).collect()
    }

    #[test]
    fn a_sound_record_is_left_alone() {
        let samples = noise();
        let (sound, faults) = Faults::removed(&samples);
        assert!(matches!(sound, Cow::Borrowed(_)));
        assert_eq!(faults, Faults::default());
    }

    /// One or two samples are a glitch, wherever they are; three, or one of 20 g in a row of strong ones, are not.
    #[test]
    fn glitches_are_replaced() {
        for place in [0, 1, 500, 998, 999] {
            for length in [1, 2, 3] {
                let mut samples = noise();
                let end = (place + length).min(1000);
                samples[place..end]
                    .iter_mut()
                    .for_each(|sample| sample.acceleration = 9000.0);
                let (sound, faults) = Faults::removed(&samples);
                let is_glitch = end - place <= MOST;
                let most = sound
                    .iter()
                    .fold(0.0f64, |most, it| most.max(it.acceleration));
                assert_eq!(most < 0.08, is_glitch, "{place} {length}");
                assert_eq!(
                    faults.glitches.len(),
                    if is_glitch { end - place } else { 0 }
                );
            }
        }
        let mut samples = noise();
        for (i, sample) in samples[500..506].iter_mut().enumerate() {
            sample.acceleration = 60.0 * i as f64;
        }
        assert_eq!(Faults::removed(&samples).1, Faults::default());
    }

    /// A value that is repeated is left out but for its first sample, at either end and in the middle.
    #[test]
    fn a_frozen_sensor_leaves_a_hole() {
        for (from, to) in [(0, 200), (400, 600), (100, 1000)] {
            let mut samples = noise();
            let value = samples[from].acceleration;
            samples[from..to]
                .iter_mut()
                .for_each(|sample| sample.acceleration = value);
            let (sound, faults) = Faults::removed(&samples);
            let [frozen] = faults.frozen[..] else {
                panic!("{faults:?}");
            };
            assert!((frozen.0 - samples[from].time).abs() < 0.05, "{frozen:?}");
            assert!((frozen.1 - samples[to - 1].time).abs() < 0.05, "{frozen:?}");
            assert!((1000 - sound.len()).abs_diff(to - from) < 3);
        }
    }

    /// A sensor whose steps are larger than its noise stands still at rest.
    #[test]
    fn a_coarse_sensor_is_not_frozen() {
        let mut samples = noise();
        for (i, sample) in samples.iter_mut().enumerate() {
            let moves = (400..500).contains(&i) || i % 61 == 0;
            sample.acceleration = if moves { sample.acceleration } else { 0.0 };
        }
        assert_eq!(Faults::removed(&samples).1, Faults::default());
    }
}
