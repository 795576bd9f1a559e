//! Samples that are missing, by the clock of those that are there.
//!
//! Of a sensor that samples evenly an interval of k periods lacks k − 1 samples. The period is the mean of the usual
//! intervals, as long as fewer than half of all samples are missing; their median alone would be 2 % off where a
//! clock of 60 Hz ticks in milliseconds.
//!
//! A stamp that only comes late makes an interval longer too, and the next ones shorter. So of a run of intervals none
//! of which is usual the whole counts: usual is from 0.5 to 1.5 periods, or where the clock is uneven up to ten
//! deviations of an interval over one period. A law of any shape is beyond ten deviations with a probability of 0.01 at
//! most, and a normal one never.

use super::sample::Sample;

/// The deviation of an interval, in periods, up to which every one with a lost sample is unusual.
pub(super) const SURE: f64 = 0.05;

/// How many samples are missing among these, whose period, s, has a deviation of `jitter` periods.
pub(super) fn missing(samples: &[Sample], period: f64, jitter: f64) -> u64 {
    let usual = 0.5..=1.0 + 10.0 * SURE.max(jitter);
    let (mut missing, mut surplus) = (0.0, 0.0);
    for pair in samples.windows(2) {
        let periods = (pair[1].time - pair[0].time) / period;
        if usual.contains(&periods) {
            missing += f64::max(surplus, 0.0).round();
            surplus = 0.0;
        } else {
            surplus += periods - 1.0;
        }
    }
    (missing + f64::max(surplus, 0.0).round()) as u64
}

#[cfg(test)]
mod tests {
    use super::super::{Reading, Recording, Warning};
    use crate::rng::Stream;
    use rand::Rng;

    /// Uniform in [0, 1).
    fn draws(name: &str) -> impl FnMut() -> f64 {
        let mut generator = Stream::new(2026, "missing", name).at(0);
        move || (generator.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A record of these times, s.
    fn recorded(times: &[f64]) -> Recording {
        let rows = times.iter().zip(0..);
        let rows: String = rows.map(|(t, i)| format!("{t:.6},{}\n", i % 7)).collect();
        Recording::from_bytes("ride", rows.into_bytes(), &Reading::default()).unwrap()
    }

    fn is_said(recording: &Recording) -> bool {
        let mut warnings = recording.warnings().iter();
        warnings.any(|warning| matches!(warning, Warning::Missing { .. }))
    }

    const SAMPLES: usize = 6000;

    /// Samples of a clock, each late by up to `jitter` periods in either direction, those that are `lost` left out.
    /// Returns how many are lost between the first and the last that are not, too.
    fn clock(rate: f64, jitter: f64, mut lost: impl FnMut(usize) -> bool) -> (Vec<f64>, u64) {
        let mut late = draws("late");
        let times = (0..SAMPLES).map(|i| (i as f64 + jitter * (2.0 * late() - 1.0)) / rate);
        let times: Vec<f64> = times.collect();
        let kept: Vec<usize> = (0..SAMPLES).filter(|i| !lost(*i)).collect();
        let between = kept[kept.len() - 1] - kept[0] + 1 - kept.len();
        (kept.iter().map(|i| times[*i]).collect(), between as u64)
    }

    /// On a clock that strays by more some are not told from late stamps: their number is said to be a least one.
    #[test]
    fn what_may_be_more_is_said_to_be_a_least_number() {
        for jitter in [0.1, 0.15, 0.2] {
            let mut draw = draws("lost");
            let (times, lost) = clock(100.0, jitter, |_| draw() < 0.1);
            let recording = recorded(&times);
            assert!((1..=lost).contains(&recording.facts().missing), "{jitter}");
            let mut warnings = recording.warnings().iter();
            let said = warnings.find(|it| matches!(it, Warning::Missing { .. }));
            let said = said.map_or(String::new(), ToString::to_string);
            assert!(said.starts_with("at least "), "{jitter}: {said}");
        }
    }

    /// At every rate of loss, evenly or in bursts, on exact clocks and on those that stray by 5 % of a period.
    #[test]
    fn every_lost_sample_is_counted() {
        for (loss, jitter) in [0.001, 0.01, 0.1, 0.3, 0.4]
            .into_iter()
            .flat_map(|loss| [0.0, 0.01, 0.05].map(|jitter| (loss, jitter)))
        {
            let mut draw = draws("lost");
            let (times, lost) = clock(100.0, jitter, |_| draw() < loss);
            let facts = recorded(&times).facts().clone();
            assert_eq!(facts.missing, lost, "{loss} at random, {jitter}");
            assert!(lost > 0 && (facts.rate - 100.0).abs() < 5.0);

            // Bursts of 2 to 40.
            let (mut draw, mut left) = (draws("bursts"), 0);
            let (times, lost) = clock(100.0, jitter, |_| {
                if left == 0 && draw() < loss / 20.0 {
                    left = 2 + (39.0 * draw()) as usize;
                }
                left = usize::saturating_sub(left, 1);
                left > 0
            });
            let recording = recorded(&times);
            assert_eq!(
                recording.facts().missing,
                lost,
                "{loss} in bursts, {jitter}"
            );
        }
    }

    #[test]
    fn what_matters_is_said() {
        let (times, _) = clock(100.0, 0.0, |i| i % 10 == 5);
        let recording = recorded(&times);
        assert_eq!(recording.facts().missing, 600);
        assert!((recording.facts().missing_share() - 0.1).abs() < 1e-12);
        let text = recording.warnings()[0].to_string();
        assert!(
            text.starts_with("10.0 % of the samples are missing: 600, the longest gap is 0.020 s"),
            "{text}"
        );
        // One in six thousand does not.
        let (times, _) = clock(100.0, 0.0, |i| i == 1000);
        let recording = recorded(&times);
        assert_eq!(recording.facts().missing, 1);
        assert!(!is_said(&recording));
    }

    /// Stamps that stray, that come late and catch up, that tick coarsely, that repeat, and that drift: nothing is missing.
    #[test]
    fn a_late_stamp_is_no_missing_sample() {
        let whole = |_| false;
        for jitter in [0.01, 0.1, 0.2, 0.3, 0.45] {
            let (times, _) = clock(50.0, jitter, whole);
            assert_eq!(recorded(&times).facts().missing, 0, "{jitter}");
        }
        let (even, _) = clock(60.0, 0.0, whole);
        let ticks: Vec<f64> = even.iter().map(|t| (1e3 * t).round() / 1e3).collect();
        assert_eq!(recorded(&ticks).facts().missing, 0);
        let drifting: Vec<f64> = even.iter().map(|t| t * (1.0 + 1e-3 * t)).collect();
        assert_eq!(recorded(&drifting).facts().missing, 0);
        let twice: Vec<f64> = (even.iter())
            .enumerate()
            .flat_map(|(i, t)| vec![*t; 1 + usize::from(i % 50 == 0)])
            .collect();
        assert_eq!(recorded(&twice).facts().missing, 0);
        for (every, periods) in [(20, 0.6), (50, 0.9), (90, 5.0)] {
            // Those that would come before it wait for the late one.
            let mut latest = 0.0;
            let late = |(i, t): (usize, &f64)| {
                let late = if i % every == 0 { periods / 60.0 } else { 0.0 };
                latest = f64::max(t + late, latest + 1e-4);
                latest
            };
            let late: Vec<f64> = even.iter().enumerate().map(late).collect();
            assert_eq!(recorded(&late).facts().missing, 0, "{periods} periods");
        }
    }
}
