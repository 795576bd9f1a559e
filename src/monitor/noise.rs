//! The noise of a record, while it may move.

use serde::{Deserialize, Serialize};

/// What a bend changes the estimate by, as a share; in the beginning by more.
const LEAST_SHARE: f64 = 0.005;
const MOST_SHARE: f64 = 0.2;

/// So many bends in a row on one side of it are no pulse: the noise is another, and each of the next changes it by this.
const LONG_RUN: f64 = 60.0;
const HASTY_SHARE: f64 = 0.05;

/// So many bends tell something.
const ENOUGH: f64 = 30.0;

/// The deviation of means, from their bends: x − 2x′ + x″ of three in a row. Neither a level nor a ramp bends, and the
/// median of the bends is not moved by a few pulses.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Noise {
    median: f64,
    count: f64,
    /// How many bends in a row were above it, or below if negative.
    run: f64,
}

impl Noise {
    /// Takes the next bend: the median goes up where it is larger, else down, by a share of its own.
    pub fn step(&mut self, bend: f64) {
        self.count += 1.0;
        if self.count == 1.0 {
            self.median = bend.abs();
        }
        let side = if bend.abs() > self.median { 1.0 } else { -1.0 };
        self.run = if side * self.run > 0.0 {
            self.run + side
        } else {
            side
        };
        let share = if self.run.abs() > LONG_RUN {
            HASTY_SHARE
        } else {
            (1.0 / self.count).clamp(LEAST_SHARE, MOST_SHARE)
        };
        if side > 0.0 {
            self.median *= 1.0 + share;
        } else {
            self.median /= 1.0 + share;
        }
        // Bends of a coarse sensor may be zero for long.
        self.median = self.median.max(1e-6);
    }

    /// The deviation of a mean if the noise were white, in the unit of the bends; 0 until there are enough.
    pub fn deviation(&self) -> f64 {
        if self.count < ENOUGH {
            return 0.0;
        }
        1.4826 * self.median / 6f64.sqrt()
    }
}

/// The deviations of the smoothed record and of the mean of a longer time, m/s².
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct Noises {
    pub fast: f64,
    pub slow: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of uniform noise in ±1, with a pulse in a quarter of the time, within a quarter.
    #[test]
    fn pulses_do_not_move_it() {
        let mut state = 2014u64;
        let mut uniform = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 40) as f64 / f64::from(1 << 23) - 1.0
        };
        let pulse = |i: u32| if i % 400 < 100 { 5.0 } else { 0.0 };
        let values: Vec<f64> = (0..4000).map(|i| uniform() + pulse(i)).collect();
        let mut noise = Noise::default();
        for three in values.windows(3) {
            noise.step(three[2] - 2.0 * three[1] + three[0]);
        }
        let ratio = noise.deviation() * 3f64.sqrt();
        assert!((0.75..1.25).contains(&ratio), "{ratio}");
    }
}
