//! Times that many samples share: stamps of whole seconds, spread evenly; or single repetitions, left out.

use super::sample::Sample;

/// Fewer samples than this are not enough to see that each stamp stands for many.
const FEWEST: usize = 8;

/// What became of times that repeat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Repeats {
    /// So many samples had the time of the one before and were left out.
    LeftOut(u64),
    /// So many samples shared each stamp, and were spread to the next.
    Spread(usize),
}

/// Makes times strictly increasing.
///
/// Where the median stamp has two samples or more, the samples of a stamp stand in the middles of equal parts of
/// the usual time between stamps. The first stamp may have begun before the record, so that its samples
/// stand at its end; the last may go on after it.
pub(super) fn spread(samples: &mut Vec<Sample>) -> Repeats {
    if samples.windows(2).all(|pair| pair[0].time != pair[1].time) {
        return Repeats::LeftOut(0);
    }
    let groups: Vec<usize> = samples
        .chunk_by(|a, b| a.time == b.time)
        .map(<[_]>::len)
        .collect();
    let stamps = samples
        .chunk_by(|a, b| a.time == b.time)
        .map(|group| group[0].time);
    let stamps: Vec<f64> = stamps.collect();
    let usual = median(groups.clone());
    if groups.len() < 2 || usual < 2 || samples.len() < FEWEST {
        let before = samples.len();
        // Of several readings at one time the first is kept, since nothing shows which one is right.
        samples.dedup_by(|next, kept| next.time == kept.time);
        return Repeats::LeftOut((before - samples.len()) as u64);
    }
    let mut lengths: Vec<f64> = stamps.windows(2).map(|pair| pair[1] - pair[0]).collect();
    lengths.sort_by(f64::total_cmp);
    let length = lengths[lengths.len() / 2];
    let mut place = 0;
    for (index, (&count, &stamp)) in groups.iter().zip(&stamps).enumerate() {
        let next = stamps
            .get(index + 1)
            .map_or(stamp + length, |next| next.min(stamp + length));
        let is_end = index == 0 || index + 1 == groups.len();
        let parts = if is_end { count.max(usual) } else { count };
        let first = if index == 0 { parts - count } else { 0 };
        for (sample, part) in samples[place..place + count].iter_mut().zip(first..) {
            sample.time = stamp + (next - stamp) * (part as f64 + 0.5) / parts as f64;
        }
        place += count;
    }
    // Where stamps lie closer than doubles resolve.
    samples.dedup_by(|next, kept| next.time <= kept.time);
    Repeats::Spread(usual)
}

fn median(mut values: Vec<usize>) -> usize {
    values.sort_unstable();
    values.get(values.len() / 2).copied().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn times(stamps: &[f64]) -> (Repeats, Vec<f64>) {
        let sample = |&time: &f64| Sample {
            time,
            acceleration: 0.0,
        };
        let mut samples: Vec<Sample> = stamps.iter().map(sample).collect();
        let repeats = spread(&mut samples);
        (repeats, samples.iter().map(|sample| sample.time).collect())
    }

    #[test]
    fn stamps_are_spread_and_repetitions_left_out() {
        let (repeats, spread) = times(&[0.0, 1.0, 1.0, 2.0, 2.0, 5.0, 5.0, 6.0]);
        assert_eq!(repeats, Repeats::Spread(2));
        assert_eq!(spread, [0.75, 1.25, 1.75, 2.25, 2.75, 5.25, 5.75, 6.25]);
        let (repeats, kept) = times(&[0.0, 1.0, 1.0, 2.0, 3.0]);
        assert_eq!(
            (repeats, kept),
            (Repeats::LeftOut(1), vec![0.0, 1.0, 2.0, 3.0])
        );
    }
}
