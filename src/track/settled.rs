//! Where a uniform motion really begins and ends.
//!
//! A drive may overshoot its speed and come back to it, for a second or two and with a twentieth of its acceleration. That is
//! no pulse to whoever looks for rides, but a speed that is taken for constant too early is wrong for all of the trip.

use crate::recording::Sample;
use std::ops::Range;

/// Means are taken over this, s.
const BLOCK: f64 = 0.5;

/// So many of them at either end may belong to the change of speed; so many between show what uniform motion reads.
const ENDS: usize = 4;
const LEAST_BETWEEN: usize = 8;

/// What an end reads differs from that by more than so many deviations.
const DEVIATIONS: f64 = 4.0;

/// A uniform motion, s, without what at its ends still changes the speed.
pub(super) fn settled(samples: &[Sample], uniform: &Range<f64>) -> Range<f64> {
    let means = means(samples, uniform).unwrap_or_default();
    if means.len() < 2 * ENDS + LEAST_BETWEEN {
        return uniform.clone();
    }
    let between = &means[ENDS..means.len() - ENDS];
    let number = between.len() as f64;
    let level = between.iter().sum::<f64>() / number;
    let squares: f64 = between.iter().map(|it| (it - level).powi(2)).sum();
    let deviation = (squares / (number - 1.0)).sqrt();
    // The sum of the first blocks grows as long as they differ.
    let unsettled = |end: &mut dyn Iterator<Item = &f64>| {
        let mut sum = 0.0;
        let sums = end.take(ENDS).zip(1_u32..).map(|(mean, blocks)| {
            sum += mean - level;
            let spread =
                deviation * f64::from(blocks).sqrt() * (1.0 + f64::from(blocks) / number).sqrt();
            (f64::abs(sum) / spread, blocks)
        });
        let most = sums.max_by(|a, b| a.0.total_cmp(&b.0));
        let blocks = most
            .filter(|most| most.0 > DEVIATIONS)
            .map_or(0, |most| most.1);
        BLOCK * f64::from(blocks)
    };
    let from = uniform.start + unsettled(&mut means.iter());
    from..uniform.end - unsettled(&mut means.iter().rev())
}

/// Of whole blocks, those at the end counted from there; none if one is in a hole.
fn means(samples: &[Sample], uniform: &Range<f64>) -> Option<Vec<f64>> {
    let place = |time: f64| samples.partition_point(|sample| sample.time < time);
    let number = ((uniform.end - uniform.start) / BLOCK).floor().max(0.0) as usize;
    let mean = |block: usize| {
        let from = if block < number / 2 {
            uniform.start + BLOCK * block as f64
        } else {
            uniform.end - BLOCK * (number - block) as f64
        };
        let part = &samples[place(from)..place(from + BLOCK)];
        let sum: f64 = part.iter().map(|it| it.acceleration).sum();
        (!part.is_empty()).then(|| sum / part.len() as f64)
    };
    (0..number).map(mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Stream;
    use crate::signal::white_noise;

    const RATE: f64 = 50.0;

    /// 20 s of noise about a level, with so much more in its first second, and as much less in its last.
    fn motion(seed: u64, off: f64) -> Vec<Sample> {
        let mut draws = Stream::new(seed, "settled", "").at(0);
        let noise = white_noise(1000, &mut draws);
        let samples = noise.iter().enumerate().map(|(place, noise)| {
            let time = place as f64 / RATE;
            let end = f64::from(time < 1.0) - f64::from(time >= 19.0);
            Sample {
                time,
                acceleration: 0.3 + 0.02 * noise + off * end,
            }
        });
        samples.collect()
    }

    #[test]
    fn an_overshoot_is_no_uniform_motion() {
        for seed in 0..50 {
            for off in [0.05, -0.05] {
                assert_eq!(settled(&motion(seed, off), &(0.0..20.0)), 1.0..19.0);
            }
        }
    }

    /// Of 1000 ends some are off by more than four deviations of 32 blocks; more than 20 would be once in 10⁹.
    #[test]
    fn noise_is_left_alone() {
        let cut = |seed| {
            let Range { start, end } = settled(&motion(seed, 0.0), &(0.0..20.0));
            usize::from(start > 0.0) + usize::from(end < 20.0)
        };
        let cut: usize = (0..500).map(cut).sum();
        assert!(cut < 20, "{cut}");
    }

    /// A motion too short to show what it reads is left as it is.
    #[test]
    fn a_short_motion_is_believed() {
        assert_eq!(settled(&motion(0, 0.05), &(0.0..7.9)), 0.0..7.9);
    }
}
