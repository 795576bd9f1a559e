//! Pulses of acceleration, found by Page's cumulative sum [^1].
//!
//! S_k = max(0, S_{k−1} + (s·e_k − h) t_k), where e is the acceleration above the level of rest, t the length of
//! a block in seconds, s the sign looked for and h half the weakest acceleration of a start. An excursion
//! of S from zero is a pulse: it begins where S left zero and ends where S was largest, and Σ s·e·t over it is
//! its change of speed.
//!
//! [^1]: E. S. Page, "Continuous inspection schemes", Biometrika 41, 1954.

/// An excursion in one direction. Positions count blocks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pulse {
    /// +1 or −1.
    pub sign: f64,
    /// Its first block.
    pub onset: u64,
    /// The first block after it so far.
    pub end: u64,
    /// The change of speed over it, m/s, positive.
    pub speed: f64,
    /// Its strongest block, m/s².
    pub peak: f64,
    /// Its centre of gravity, from 0 at the onset to 1 at the end.
    pub centre: f64,
}

impl Pulse {
    /// Whether `next` looks like the response of a high-pass filter to the end of this pulse: it follows at once
    /// with the opposite sign and decays instead of ending. A short trip without uniform motion also has two
    /// adjacent pulses, but of another shape: the pulses of real lifts have their centres between 0.40 and 0.55,
    /// and braking takes no longer than starting. Behind a filter with a time constant from 0.5 to 4 s the second
    /// pulse has its centre between 0.33 and 0.43 and is the longer one, or both have early centres.
    pub fn decays_into(&self, next: &Self, most_between: u64) -> bool {
        let follows = next.sign != self.sign && next.onset <= self.end + most_between;
        let both_die_away = self.centre + next.centre < 2.0 * EARLY_CENTRE;
        let is_longer = next.length() as f64 > LONGER * self.length() as f64;
        follows && (both_die_away || is_longer && next.centre < LATEST_CENTRE)
    }

    /// Blocks from onset to end.
    pub fn length(&self) -> u64 {
        self.end - self.onset
    }

    /// The change of speed with its sign, m/s.
    pub fn change(&self) -> f64 {
        self.sign * self.speed
    }
}

/// The latest mean centre of two pulses that both decay.
const EARLY_CENTRE: f64 = 0.39;

/// The latest centre of a pulse that decays after one that does not.
const LATEST_CENTRE: f64 = 0.43;

/// The factor by which such a pulse must be longer than the first.
const LONGER: f64 = 1.25;

/// Page's cumulative sum for pulses of one sign.
#[derive(Clone, Debug)]
pub(super) struct Cusum {
    sign: f64,
    /// h, m/s².
    drift: f64,
    /// Blocks without a new maximum after which a pulse is over.
    patience: u64,
    sum: f64,
    largest: f64,
    speed: f64,
    /// Σ speed · place, for the centre.
    moment: f64,
    pulse: Option<Pulse>,
}

impl Cusum {
    pub fn new(sign: f64, drift: f64, patience: usize) -> Self {
        Self {
            sign,
            drift,
            patience: patience as u64,
            sum: 0.0,
            largest: 0.0,
            speed: 0.0,
            moment: 0.0,
            pulse: None,
        }
    }

    /// The current pulse.
    pub fn pulse(&self) -> Option<&Pulse> {
        self.pulse.as_ref()
    }

    /// Takes block `index` with the acceleration `excess` above rest for `seconds`; returns the pulse that it
    /// ends, if any.
    pub fn step(&mut self, index: u64, excess: f64, seconds: f64) -> Option<Pulse> {
        let excess = self.sign * excess;
        self.sum += (excess - self.drift) * seconds;
        if self.sum <= 0.0 {
            return self.end();
        }
        self.speed += excess * seconds;
        let pulse = self.pulse.get_or_insert(Pulse {
            sign: self.sign,
            onset: index,
            end: index,
            speed: 0.0,
            peak: 0.0,
            centre: 0.5,
        });
        self.moment += excess * seconds * ((index - pulse.onset) as f64 + 0.5);
        pulse.peak = pulse.peak.max(excess);
        // Speed and centre are taken at the maximum, so the decline of S afterwards does not count.
        if self.sum > self.largest {
            self.largest = self.sum;
            pulse.end = index + 1;
            pulse.speed = self.speed;
            pulse.centre = self.moment / self.speed / (pulse.end - pulse.onset) as f64;
        }
        let is_over = index + 1 - pulse.end >= self.patience;
        if is_over { self.end() } else { None }
    }

    /// Discards the current pulse.
    pub fn reset(&mut self) {
        self.end();
    }

    fn end(&mut self) -> Option<Pulse> {
        (self.sum, self.largest, self.speed, self.moment) = (0.0, 0.0, 0.0, 0.0);
        self.pulse.take()
    }
}

/// Whether a record of means over `seconds` each stays at one level: no excursion from its mean changes the
/// speed by `speed`.
pub(super) fn is_level(record: &[f64], drift: f64, seconds: f64, speed: f64) -> bool {
    let level = record.iter().sum::<f64>() / record.len() as f64;
    [1.0, -1.0].iter().all(|sign| {
        let mut sum: f64 = 0.0;
        record.iter().all(|mean| {
            sum = (sum + sign * (mean - level) - drift).max(0.0);
            sum * seconds < speed
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Pulses by their definition: excursions of S from zero, ended after `patience` blocks without a new maximum,
    /// each from sums over its own blocks.
    fn naive(sign: f64, drift: f64, patience: usize, record: &[f64]) -> Vec<Pulse> {
        let mut pulses = Vec::new();
        let mut onset = 0;
        while onset < record.len() {
            let sums: Vec<f64> = (record[onset..].iter())
                .scan(0.0, |sum, e| {
                    *sum += sign * e - drift;
                    Some(*sum)
                })
                .collect();
            if sums[0] <= 0.0 {
                onset += 1;
                continue;
            }
            let largest = |length: usize| {
                let mut best = 0;
                for i in 1..length {
                    if sums[i] > sums[best] {
                        best = i;
                    }
                }
                best
            };
            let over = |i: usize| sums[i] <= 0.0 || i - largest(i + 1) >= patience;
            let Some(last) = (0..sums.len()).find(|i| over(*i)) else {
                break;
            };
            // The block at which S falls to zero does not belong to it.
            let taken = if sums[last] <= 0.0 { last } else { last + 1 };
            let length = largest(taken) + 1;
            let own = &record[onset..onset + length];
            let speed: f64 = own.iter().map(|e| sign * e * 0.0625).sum();
            let moment: f64 = (own.iter().enumerate())
                .map(|(i, e)| sign * e * 0.0625 * (i as f64 + 0.5))
                .sum();
            let peaks = record[onset..onset + taken].iter().map(|e| sign * e);
            pulses.push(Pulse {
                sign,
                onset: onset as u64,
                end: (onset + length) as u64,
                speed,
                peak: peaks.fold(0.0, f64::max),
                centre: moment / speed / length as f64,
            });
            onset += last + 1;
        }
        pulses
    }

    proptest! {
        #![proptest_config(ProptestConfig { rng_seed: prop::test_runner::RngSeed::Fixed(2014), cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn pulses_are_the_excursions_of_their_sum(
            record in prop::collection::vec(-8i8..=8, 1..60),
            patience in 1usize..8,
            sign in prop::sample::select(vec![1.0, -1.0]),
        ) {
            let record: Vec<f64> = record.into_iter().map(|e| f64::from(e) / 16.0).collect();
            let mut cusum = Cusum::new(sign, 0.0625, patience);
            let found: Vec<Pulse> = (0..).zip(&record).filter_map(|(i, e)| cusum.step(i, *e, 0.0625)).collect();
            let expected = naive(sign, 0.0625, patience, &record);
            prop_assert_eq!(found.len(), expected.len());
            for (a, b) in found.iter().zip(&expected) {
                prop_assert_eq!((a.onset, a.end, a.peak), (b.onset, b.end, b.peak));
                prop_assert!((a.speed - b.speed).abs() < 1e-12);
                prop_assert!((a.centre - b.centre).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn a_level_is_no_pulse_and_a_step_is_one() {
        let level = [9.8; 40];
        assert!(is_level(&level, 0.05, 0.05, 0.1));
        let mut step = level;
        step[20..].fill(10.2);
        assert!(!is_level(&step, 0.05, 0.05, 0.1));
    }
}
