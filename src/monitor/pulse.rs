//! Pulses of acceleration, found by Page's cumulative sum [^1].
//!
//! S_k = max(0, S_{k−1} + s·e_k − h), where e is the acceleration above the level of rest, s the sign
//! looked for and h half the weakest acceleration of a start. An excursion of S from zero is a pulse: it
//! begins where S left zero, ends where S was largest, and Σ s·e over it, times the length of a block,
//! is the change of speed it stands for.
//!
//! [^1]: E. S. Page, "Continuous inspection schemes", Biometrika 41, 1954.

/// An excursion in one direction. Places count blocks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pulse {
    /// +1 or −1.
    pub sign: f64,
    /// Its first block.
    pub onset: u64,
    /// The first block after it, as far as it has been seen.
    pub end: u64,
    /// The change of speed over it, m/s, positive.
    pub speed: f64,
    /// Its strongest block, m/s².
    pub peak: f64,
    /// Its centre of gravity, from 0 at the onset to 1 at the end.
    pub centre: f64,
}

impl Pulse {
    /// Whether `next` looks like what a high-pass filter makes of the end of this pulse: it follows at once with
    /// the opposite sign and dies away instead of ending. So does a hop of a lift that never moves
    /// uniformly, but for its shape: the pulses of real lifts have their centres between 0.40 and 0.55, and braking
    /// takes no longer than starting. Behind a filter with a time constant from 0.5 to 4 s the second pulse has
    /// its centre between 0.33 and 0.43 and is the longer one, or both have early centres.
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

    /// Whether two pulses leave no more than a quarter of the larger one's change of speed.
    pub fn cancels(&self, other: &Self) -> bool {
        let left = self.sign * self.speed + other.sign * other.speed;
        left.abs() <= self.speed.max(other.speed) / 4.0
    }
}

/// Where two pulses that both die away have their centres, on average, at the latest.
const EARLY_CENTRE: f64 = 0.39;

/// The latest centre of a pulse that dies away after one that does not.
const LATEST_CENTRE: f64 = 0.43;

/// How much longer than the first such a pulse must be.
const LONGER: f64 = 1.25;

/// Looks for pulses of one sign.
#[derive(Clone, Debug)]
pub(super) struct Cusum {
    sign: f64,
    /// h, m/s².
    drift: f64,
    /// Seconds in a block.
    block: f64,
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
    pub fn new(sign: f64, drift: f64, block: f64, patience: usize) -> Self {
        Self {
            sign,
            drift,
            block,
            patience: patience as u64,
            sum: 0.0,
            largest: 0.0,
            speed: 0.0,
            moment: 0.0,
            pulse: None,
        }
    }

    /// The pulse under way.
    pub fn pulse(&self) -> Option<&Pulse> {
        self.pulse.as_ref()
    }

    /// Takes block `index` of acceleration `excess`; the pulse that has just ended, where one has.
    pub fn step(&mut self, index: u64, excess: f64) -> Option<Pulse> {
        let excess = self.sign * excess;
        self.sum += excess - self.drift;
        if self.sum <= 0.0 {
            return self.end();
        }
        self.speed += excess * self.block;
        let pulse = self.pulse.get_or_insert(Pulse {
            sign: self.sign,
            onset: index,
            end: index,
            speed: 0.0,
            peak: 0.0,
            centre: 0.5,
        });
        self.moment += excess * self.block * ((index - pulse.onset) as f64 + 0.5);
        pulse.peak = pulse.peak.max(excess);
        if self.sum > self.largest {
            self.largest = self.sum;
            pulse.end = index + 1;
            pulse.speed = self.speed;
            pulse.centre = self.moment / self.speed / (pulse.end - pulse.onset) as f64;
        }
        match index + 1 - pulse.end >= self.patience {
            true => self.end(),
            false => None,
        }
    }

    /// Forgets the pulse under way.
    pub fn reset(&mut self) {
        self.end();
    }

    fn end(&mut self) -> Option<Pulse> {
        (self.sum, self.largest, self.speed, self.moment) = (0.0, 0.0, 0.0, 0.0);
        self.pulse.take()
    }
}

/// Whether a record of block means stays at one level: no excursion from its mean changes the speed by
/// `speed`.
pub(super) fn is_level(record: &[f64], drift: f64, block: f64, speed: f64) -> bool {
    let level = record.iter().sum::<f64>() / record.len() as f64;
    [1.0, -1.0].iter().all(|sign| {
        let mut sum: f64 = 0.0;
        record.iter().all(|mean| {
            sum = (sum + sign * (mean - level) - drift).max(0.0);
            sum * block < speed
        })
    })
}
